#include "io/run/record_reader.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "io/run/load_columns.hpp"
#include "io/text/csv_row.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {

using simulation::FloeId;

namespace {

double number(const JsonValue& value, std::string_view key) {
  return json_member(value, key, JsonValue::Kind::kNumber).number();
}
FloeId floe_id(const JsonValue& value, std::string_view key) {
  const JsonValue* found = value.find(key);
  if (!found) throw ReadError(fmt::format("\"{}\" is missing", key));
  return floe_id(*found);
}
double take_number(std::string_view& row) {
  const std::string_view field = csv_field(row);
  const auto value = csv_number(field);
  if (!value) throw ReadError(fmt::format("\"{}\" is not a number", field));
  return *value;
}

simulation::ContactState::Body body_of(std::string_view& line, const Run& run) {
  const std::string_view ship = csv_field(line);
  std::string_view floe = csv_field(line);
  simulation::ContactState::Body body{ship_index(run.scene.scene, ship), simulation::kNoFloe};
  if (ship.empty()) body.floe = static_cast<FloeId>(take_number(floe));
  if (body.ship < 0 && !run.floe(body.floe)) throw ReadError("a contact of what there is not");
  return body;
}

}  // namespace

JsonValue json_of(std::string_view text) {
  JsonDocument document = parse_json(text);
  if (!document.faults.empty()) throw ReadError("not JSON: " + document.faults.front().found);
  return std::move(document.root);
}

const JsonValue& json_member(const JsonValue& value, std::string_view key, JsonValue::Kind kind) {
  const JsonValue* found = value.find(key, kind);
  if (!found) throw ReadError(fmt::format("\"{}\" is not {}", key, name_of(kind)));
  return *found;
}

FloeId floe_id(const JsonValue& value) {
  if (value.is_null()) return simulation::kNoFloe;
  if (!value.is(JsonValue::Kind::kNumber) || !(value.number() >= 0 && value.number() < 1e9))
    throw ReadError("not a floe's id");
  return static_cast<FloeId>(value.number());
}

geometry::Point point(const JsonValue& value) {
  if (!value.is(JsonValue::Kind::kArray) || value.items().size() != 2 ||
      !value.items()[0].is(JsonValue::Kind::kNumber) || !value.items()[1].is(JsonValue::Kind::kNumber))
    throw ReadError("not a point");
  return {value.items()[0].number(), value.items()[1].number()};
}

int ship_index(const simulation::Scene& scene, std::string_view name) {
  return hull_named(scene, name);
}

simulation::BirthRecord birth_of(const JsonValue& line) {
  simulation::BirthRecord birth;
  birth.floe = floe_id(line, "floe_id");
  birth.parent = floe_id(line, "parent_id");
  birth.time = number(line, "born_s");
  birth.generation = static_cast<int>(number(line, "generation"));
  birth.area = number(line, "area_m2");
  birth.mass = number(line, "mass_kg");
  birth.centroid_in_body = point(json_member(line, "centroid_m", JsonValue::Kind::kArray));
  return birth;
}

simulation::HullSample sample_of(std::string_view line, const std::vector<const ForceColumn*>& columns,
                                 const simulation::Scene& scene) {
  simulation::HullSample s;
  s.time = take_number(line);
  s.ship = ship_index(scene, csv_field(line));
  for (const ForceColumn* column : columns) column->store(s, take_number(line));
  return s;
}

RunCrushed crushed_of(std::string_view line, const Run& run) {
  RunCrushed crushed;
  crushed.time = take_number(line);
  crushed.overlap.on = body_of(line, run);
  crushed.overlap.by = body_of(line, run);
  crushed.overlap.area = take_number(line);
  if (line.empty()) return crushed;  // of a version that did not book it
  crushed.overlap.tilted = take_number(line);
  crushed.overlap.volume = take_number(line);
  crushed.overlap.work = take_number(line);
  return crushed;
}

RunContact contact_of(std::string_view line, const Run& run) {
  RunContact contact;
  contact.time = take_number(line);
  simulation::ContactState& state = contact.state;
  state.on = body_of(line, run);
  state.by = body_of(line, run);
  if (!read_row(line, state)) throw ReadError("a contact with what is no number");
  return contact;
}

}  // namespace polynya::io
