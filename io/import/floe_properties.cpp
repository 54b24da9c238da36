#include "io/import/floe_properties.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/text/problem.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;
using fracture::Ice;

constexpr std::string_view kFloeId = "floe_id";
constexpr std::string_view kFastIce = "fast_ice";
constexpr std::string_view kUnderHullOf = "under_hull_of";
constexpr double kLargestId = 9007199254740991;  ///< 2^53 − 1

constexpr FloeProperty kProperties[] = {
    {"thickness_m", "m", 0.001, 20, &FloeProperties::thickness, &Ice::thickness},
    {"density_kg_per_m3", "kg/m³", 100, 1100, &FloeProperties::density, &Ice::density},
    {"flexural_strength_Pa", "Pa", 1, 1e9, &FloeProperties::flexural_strength, &Ice::flexural_strength},
    {"compressive_strength_Pa", "Pa", 1, 1e10, &FloeProperties::compressive_strength, &Ice::compressive_strength},
    {"tensile_strength_Pa", "Pa", 1, 1e9, &FloeProperties::tensile_strength, &Ice::tensile_strength},
    {"fracture_toughness_Pa_sqrt_m", "Pa √m", 1, 1e9, &FloeProperties::fracture_toughness, &Ice::fracture_toughness},
    {"vx_m_per_s", "m/s", -20, 20, &FloeProperties::velocity_x},
    {"vy_m_per_s", "m/s", -20, 20, &FloeProperties::velocity_y},
    {"angular_velocity_deg_per_s", "°/s", -360, 360, &FloeProperties::angular_velocity},
    {"under_hull_path_m", "m", -1000, 1e5, &FloeProperties::under_hull_path}};

/// Where the file has a property, and by what its values are multiplied.
struct Place {
  const JsonValue* value = nullptr;  ///< null: it has none
  std::string key;
  double factor = 1;
};

Place place_of(std::string_view key, const JsonValue& properties, const PropertyNames& names) {
  Place place{nullptr, std::string(key), 1};
  if (const auto named = names.find(key); named != names.end()) {
    place.key = named->second.name;
    place.factor = named->second.factor;
  }
  const JsonValue* value = properties.find(place.key);
  if (value && !value->is_null()) place.value = value;
  return place;
}

/// Units in a property's name, and what they are of the SI's.
struct UnitName {
  std::string_view name, si;
  double factor;
};
constexpr UnitName kUnits[] = {{"m", "m", 1},   {"cm", "m", 0.01},  {"mm", "m", 0.001}, {"dm", "m", 0.1},
                               {"pa", "pa", 1}, {"kpa", "pa", 1e3}, {"mpa", "pa", 1e6}, {"gpa", "pa", 1e9},
                               {"kg", "kg", 1}, {"deg", "deg", 1}};

/// A key in small letters, parted at its unit: "thickness", and cm.
struct NameAndUnit {
  std::string name;
  std::optional<UnitName> unit;
};
NameAndUnit part_at_unit(std::string_view key) {
  std::string small;
  for (const char c : key) {
    if (c >= 'A' && c <= 'Z')
      small += static_cast<char>(c | 0x20);
    else
      small += c == ' ' || c == '-' || c == '.' || c == '[' || c == '(' ? '_' : c;
  }
  while (!small.empty() && (small.back() == ']' || small.back() == ')')) small.pop_back();
  for (std::size_t start = small.find('_'); start < small.size(); start = small.find('_', start + 1)) {
    const std::string_view word =
        std::string_view(small).substr(start + 1).substr(0, small.find('_', start + 1) - start - 1);
    const auto* unit = std::ranges::find(kUnits, word, &UnitName::name);
    if (unit != std::end(kUnits)) return {small.substr(0, small.find_last_not_of('_', start) + 1), *unit};
  }
  return {std::move(small), std::nullopt};
}

/// The property that a key may be meant for, and the factor of its unit.
std::optional<NearMiss> near_miss_of(const std::string& key) {
  constexpr std::size_t kShort = 4;  // letters: names this short are all near one another
  constexpr std::size_t kLong = 100;
  if (key.size() > kLong) return {};
  const NameAndUnit given = part_at_unit(key);
  std::vector<std::string> names;
  std::vector<std::string_view> long_names;
  for (const FloeProperty& property : kProperties) names.push_back(part_at_unit(property.key).name);
  for (const std::string& name : names)
    if (name.size() > kShort) long_names.push_back(name);
  std::string meant = given.name;
  if (std::ranges::find(names, meant) == names.end()) {
    meant = given.name.size() > kShort ? nearest(given.name, long_names) : "";
    if (!meant.empty() && meant.front() != given.name.front()) meant = "";  // "intensity" is no density
    if (meant.empty() && given.name.find("thick") != std::string::npos) meant = names.front();
  }
  const auto found = std::ranges::find(names, meant);
  if (found == names.end()) return {};
  const std::string property(kProperties[found - names.begin()].key);
  const auto si = part_at_unit(property).unit;
  const bool is_convertible = given.unit && si && given.unit->si == si->si;
  return NearMiss{key, property, is_convertible ? given.unit->factor : 1, 0};
}

}  // namespace

std::span<const FloeProperty> floe_properties() {
  return kProperties;
}

void append_ice(JsonWriter& json, const Ice& ice) {
  for (const FloeProperty& property : floe_ice_properties()) json.key(property.key).value(ice.*property.ice);
}

Result<> add_property_name(std::string_view words, PropertyNames& names) {
  const std::size_t equals = words.find('=');
  if (equals == std::string_view::npos)
    return fail(fmt::format("\"{}\" is not KEY=NAME, as thickness_m=THICK or thickness_m=CM*0.01", words));
  const std::string_view key = words.substr(0, equals);
  std::vector<std::string_view> keys{kFloeId};
  for (const FloeProperty& property : kProperties) keys.push_back(property.key);
  if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
    const std::string meant = nearest(key, keys);
    return fail(fmt::format("\"{}\" is not one of: {}{}", key, fmt::join(keys, ", "),
                            meant.empty() ? "" : fmt::format("; did you mean {}?", meant)));
  }
  PropertyName name{std::string(words.substr(equals + 1)), 1};
  if (const std::size_t star = name.name.rfind('*'); star != std::string::npos) {
    const std::string factor = name.name.substr(star + 1);
    const char* const end = factor.data() + factor.size();
    const auto [stop, error] = std::from_chars(factor.data(), end, name.factor);
    if (error != std::errc() || stop != end || !std::isfinite(name.factor) || name.factor == 0)
      return fail(fmt::format("\"{}\": {} is no factor", words, factor));
    name.name.resize(star);
  }
  if (name.name.empty()) return fail(fmt::format("\"{}\" names no property of the file", words));
  names[std::string(key)] = std::move(name);
  return {};
}

FloeProperties read_floe_properties(const JsonValue& properties, const PropertyNames& names, std::string& wrong) {
  FloeProperties result;
  /// `take` returns whether it is what is allowed.
  const auto read = [&](std::string_view key, std::string_view allowed, auto take) {
    const Place place = place_of(key, properties, names);
    if (!place.value || take(*place.value, place.factor)) return;
    const bool is_scaled = place.factor != 1 && place.value->is(JsonKind::kNumber) && key != kFloeId;
    wrong +=
        fmt::format("{}property {}: found {}{}, allowed: {}", wrong.empty() ? "" : "; ", place.key, show(*place.value),
                    is_scaled ? fmt::format(", which is {:.9g}", place.factor * place.value->number()) : "", allowed);
  };
  read(kFastIce, "true or false", [&](const JsonValue& value, double) {
    if (value.is(JsonKind::kBoolean)) result.is_fast = value.boolean();
    return result.is_fast.has_value();
  });
  read(kUnderHullOf, "the name of a ship", [&](const JsonValue& value, double) {
    if (value.is(JsonKind::kText)) result.under_hull_of = value.text();
    return result.under_hull_of.has_value();
  });
  read(kFloeId, "a whole number ≥ 0", [&](const JsonValue& value, double) {
    const double id = value.is(JsonKind::kNumber) ? value.number() : -1;
    if (id >= 0 && id <= kLargestId && id == std::floor(id)) result.floe_id = static_cast<std::int64_t>(id);
    return result.floe_id.has_value();
  });
  for (const FloeProperty& property : kProperties) {
    const auto allowed = fmt::format("a number from {:g} to {:g} [{}]", property.low, property.high, property.unit);
    read(property.key, allowed, [&](const JsonValue& value, double factor) {
      const double number = value.is(JsonKind::kNumber) ? factor * value.number() : std::nan("");
      if (number >= property.low && number <= property.high) result.*property.member = number;
      return (result.*property.member).has_value();
    });
  }
  return result;
}

void NearMisses::add(const JsonValue& properties, const FloeProperties& read) {
  if (!properties.is(JsonKind::kObject)) return;
  for (const JsonMember& member : properties.members()) {
    const auto is_it = [&](const FloeProperty& property) { return property.key == member.key; };
    const auto is_named = [&](const auto& named) { return named.second.name == member.key; };
    if (!member.value.is(JsonKind::kNumber) && !member.value.is(JsonKind::kText)) continue;
    if (std::ranges::any_of(kProperties, is_it) || std::ranges::any_of(names_, is_named)) continue;
    auto known = index_.find(member.key);
    if (known == index_.end()) {
      known = index_.emplace(member.key, std::nullopt).first;
      if (auto miss = near_miss_of(member.key)) {
        known->second = found_.size();
        found_.push_back(std::move(*miss));
      }
    }
    if (!known->second) continue;
    NearMiss& miss = found_[*known->second];
    const auto* property = std::ranges::find(kProperties, miss.meant, &FloeProperty::key);
    if (!(read.*property->member)) ++miss.floes;
  }
}

std::string as_property_name(const NearMiss& miss) {
  return fmt::format("{}={}{}", miss.meant, miss.key, miss.factor == 1 ? "" : fmt::format("*{:g}", miss.factor));
}

}  // namespace polynya::io
