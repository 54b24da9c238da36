#pragma once

#include <numbers>
#include <utility>

#include "io/scene/scene_fields.hpp"

namespace polynya::io {

// What the parts of the table of scene_fields.hpp are written with, and the parts.

inline constexpr double kLargestCoordinate = 1e6;  ///< [m]
inline constexpr double kLargestCount = 1e6;

inline Range above(double low, double high) {
  return {low, high, true, false};
}
inline Range from(double low, double high) {
  return {low, high, false, false};
}
inline Range below(double low, double high) {
  return {low, high, false, true};
}
inline Range coordinate() {
  return {-kLargestCoordinate, kLargestCoordinate, false, false};
}

/// A line of a table. An aggregate's braces would be set one member a line.
inline Field field(std::string_view key, FieldKind kind, std::string_view unit, Range range,
                   std::string_view default_json, std::string_view meaning,
                   void (*set)(SceneDraft&, const JsonValue&), std::vector<std::string_view> choices = {},
                   std::string_view alternative = {}, const Object* object = nullptr) {
  return {key, kind, unit, range, default_json, meaning, set, std::move(choices), alternative, object};
}
/// A part of the scene that may be left out: its fields have defaults.
inline Field section(std::string_view key, const Object& object) {
  return field(key, FieldKind::kObject, "", {}, "{}", "", nullptr, {}, "", &object);
}
inline Field list(std::string_view key, double longest, std::string_view meaning, const Object& items) {
  return field(key, FieldKind::kList, "", {0, longest}, "[]", meaning, nullptr, {}, "", &items);
}

inline double radians(const JsonValue& v) {
  return v.number() * std::numbers::pi / 180;
}
inline geometry::Vector vector_of(const JsonValue& v) {
  return {v.items()[0].number(), v.items()[1].number()};
}
inline geometry::Point point_of(const JsonValue& v) {
  return {v.items()[0].number(), v.items()[1].number()};
}
inline geometry::Ring ring_of(const JsonValue& v) {
  geometry::Ring ring;
  for (const JsonValue& point : v.items()) ring.push_back(point_of(point));
  return ring;
}

const Object& origin_object();
const Object& time_object();
const Object& water_object();
const Object& wind_object();
const Object& ice_object();
const Object& contact_object();
const Object& fracture_object();
const Object& record_object();
const Object& ship_object();
const Object& hull_water_object();
const Object& engine_object();
const Object& steering_object();
const Object& mooring_object();
const Object& pilot_object();
const Object& structure_object();
const Object& wall_object();
const Object& floes_object();
const Object& import_object();
const Object& floe_ice_object();

}  // namespace polynya::io
