#include "io/import/floe_properties.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;

constexpr std::string_view kFloeId = "floe_id";
constexpr std::string_view kFastIce = "fast_ice";
constexpr double kLargestId = 9007199254740991;  ///< 2^53 − 1

constexpr FloeProperty kProperties[] = {
    {"thickness_m", "m", 0.001, 20, &FloeProperties::thickness},
    {"density_kg_per_m3", "kg/m³", 100, 1100, &FloeProperties::density},
    {"flexural_strength_Pa", "Pa", 1, 1e9, &FloeProperties::flexural_strength},
    {"compressive_strength_Pa", "Pa", 1, 1e10, &FloeProperties::compressive_strength},
    {"tensile_strength_Pa", "Pa", 1, 1e9, &FloeProperties::tensile_strength},
    {"fracture_toughness_Pa_sqrt_m", "Pa √m", 1, 1e9, &FloeProperties::fracture_toughness},
    {"vx_m_per_s", "m/s", -20, 20, &FloeProperties::velocity_x},
    {"vy_m_per_s", "m/s", -20, 20, &FloeProperties::velocity_y},
    {"angular_velocity_deg_per_s", "°/s", -360, 360, &FloeProperties::angular_velocity}};

std::string shown(const JsonValue& value) {
  std::string text;
  if (value.is(JsonKind::kNumber)) {
    append_number(text, value.number());
  } else if (value.is(JsonKind::kText)) {
    append_text(text, value.text().substr(0, 60));
  } else {
    text = name_of(value.kind());
  }
  return text;
}

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

void read_number(const FloeProperty& property, const Place& place, FloeProperties& result,
                 std::vector<BadProperty>& bad) {
  if (!place.value) return;
  const double value =
      place.value->is(JsonKind::kNumber) ? place.factor * place.value->number() : std::nan("");
  if (value >= property.low && value <= property.high) {
    result.*property.member = value;
    return;
  }
  std::string found = shown(*place.value);
  if (place.factor != 1 && std::isfinite(value)) found += fmt::format(", which is {:.9g}", value);
  bad.push_back({place.value, place.key, std::move(found),
                 fmt::format("a number from {:g} to {:g} [{}]", property.low, property.high, property.unit)});
}

void read_id(const Place& place, FloeProperties& result, std::vector<BadProperty>& bad) {
  if (!place.value) return;
  const double id = place.value->is(JsonKind::kNumber) ? place.value->number() : -1;
  if (id >= 0 && id <= kLargestId && id == std::floor(id)) {
    result.floe_id = static_cast<std::int64_t>(id);
    return;
  }
  bad.push_back({place.value, place.key, shown(*place.value), "a whole number ≥ 0"});
}

}  // namespace

std::span<const FloeProperty> floe_properties() {
  return kProperties;
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

FloeProperties read_floe_properties(const JsonValue& properties, const PropertyNames& names,
                                    std::vector<BadProperty>& bad) {
  FloeProperties result;
  if (const JsonValue* fast = properties.find(kFastIce); fast && !fast->is_null()) {
    if (fast->is(JsonKind::kBoolean))
      result.is_fast = fast->boolean();
    else
      bad.push_back({fast, std::string(kFastIce), shown(*fast), "true or false"});
  }
  read_id(place_of(kFloeId, properties, names), result, bad);
  for (const FloeProperty& property : kProperties)
    read_number(property, place_of(property.key, properties, names), result, bad);
  return result;
}

}  // namespace polynya::io
