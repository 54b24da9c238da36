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

/// Returns the number if the whole text is a finite number.
std::optional<double> as_number(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || text.empty() || !std::isfinite(number)) return {};
  return number;
}

std::optional<double> as_number(const JsonValue& value) {
  if (value.is(JsonKind::kNumber)) return value.number();
  return value.is(JsonKind::kText) ? as_number(value.text()) : std::nullopt;
}

/// Returns true if a value is that code: the same number or the same text.
bool is_code(const JsonValue& value, const std::string& code) {
  const auto number = as_number(value), listed = as_number(code);
  if (number && listed) return *number == *listed;
  return value.is(JsonKind::kText) && trimmed(value.text()) == code;
}

/// Returns true for numbers that usually mean "no value": -9, -99, -9999.
bool looks_like_no_data(const JsonValue& value) {
  const auto number = as_number(value);
  if (!number || *number > -9) return false;
  const std::string digits = fmt::format("{}", -*number);
  return digits.find_first_not_of('9') == std::string::npos;
}

/// Units in the name of a property, and their factors to SI units.
struct UnitName {
  std::string_view name, si;
  double factor;
};
constexpr UnitName kUnits[] = {{"m", "m", 1},   {"cm", "m", 0.01},  {"mm", "m", 0.001}, {"dm", "m", 0.1},
                               {"pa", "pa", 1}, {"kpa", "pa", 1e3}, {"mpa", "pa", 1e6}, {"gpa", "pa", 1e9},
                               {"kg", "kg", 1}, {"deg", "deg", 1}};

/// A key in small letters, divided at its unit: "thickness" and "cm".
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

/// Returns the property that a key may mean, and the factor of its unit.
std::optional<NearMiss> near_miss_of(const std::string& key) {
  constexpr std::size_t kShort = 4;  // letters; shorter names all resemble each other and are not compared
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

namespace {

/// Takes "[91:0.95 93:1.6]", the values of codes, from the end of a name. Brackets without a colon belong to the name.
Result<> take_codes(std::string_view words, PropertyName& name) {
  const std::size_t open = name.name.rfind('[');
  if (open == std::string::npos || !name.name.ends_with(']') || name.name.find(':', open) == std::string::npos)
    return {};
  const std::string list = name.name.substr(open + 1, name.name.size() - open - 2);
  std::string wrong;
  for_pieces(list, ' ', [&](std::string_view pair, std::size_t) {
    if (pair.empty()) return;
    const std::size_t colon = pair.rfind(':');
    const auto value = colon == std::string_view::npos ? std::nullopt : as_number(pair.substr(colon + 1));
    if (!value || colon == 0)
      wrong = pair;
    else
      name.codes.emplace_back(pair.substr(0, colon), *value);
  });
  if (!wrong.empty()) return fail(fmt::format("\"{}\": {} is not CODE:VALUE, as 93:1.6", words, wrong));
  name.name.resize(open);
  return {};
}

}  // namespace

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
  if (auto codes = take_codes(words, name); !codes) return codes;
  if (const std::size_t star = name.name.rfind('*'); star != std::string::npos) {
    const auto factor = as_number(std::string_view(name.name).substr(star + 1));
    if (!factor || *factor == 0) return fail(fmt::format("\"{}\": {} is no factor", words, name.name.substr(star + 1)));
    name.factor = *factor;
    name.name.resize(star);
  }
  if (name.name.empty()) return fail(fmt::format("\"{}\" names no property of the file", words));
  names[std::string(key)] = std::move(name);
  return {};
}

FloeProperties PropertyReader::read(const JsonValue& properties, std::string& wrong) {
  FloeProperties result;
  const auto value_of = [&](const PropertyName& name) -> const JsonValue* {
    const JsonValue* value = properties.find(name.name);
    const bool is_none = !value || value->is_null() || (value->is(JsonKind::kText) && trimmed(value->text()).empty());
    return is_none ? nullptr : value;
  };
  const auto name_of = [&](std::string_view key) {
    const auto named = rules_.names.find(key);
    return named != rules_.names.end() ? named->second : PropertyName{std::string(key)};
  };
  const auto refuse = [&](std::string_view name, const std::string& found, std::string_view allowed) {
    wrong += fmt::format("{}property {}: found {}, allowed: {}", wrong.empty() ? "" : "; ", name, found, allowed);
  };
  if (const JsonValue* fast = value_of({std::string(kFastIce)}); fast && fast->is(JsonKind::kBoolean))
    result.is_fast = fast->boolean();
  else if (fast)
    refuse(kFastIce, show(*fast), "true or false");
  if (const JsonValue* ship = value_of({std::string(kUnderHullOf)}); ship && ship->is(JsonKind::kText))
    result.under_hull_of = ship->text();
  else if (ship)
    refuse(kUnderHullOf, show(*ship), "the name of a ship");
  if (const JsonValue* id = value_of(name_of(kFloeId)); id && id->is(JsonKind::kNumber)) {
    const double number = id->number();
    if (number >= 0 && number <= kLargestId && number == std::floor(number))
      result.floe_id = static_cast<std::int64_t>(number);
  }
  for (const FloeProperty& property : kProperties) {
    const PropertyName name = name_of(property.key);
    const JsonValue* value = value_of(name);
    if (!value) continue;
    bool is_wrong = false;
    const auto number = number_in(property.key, name, *value, is_wrong);
    if (number && *number >= property.low && *number <= property.high) {
      result.*property.member = *number;
    } else if (number || is_wrong) {
      const bool is_scaled = number && (name.factor != 1 || !name.codes.empty());
      refuse(name.name, show(*value) + (is_scaled ? fmt::format(", which is {:.9g}", *number) : ""),
             fmt::format("a number from {:g} to {:g} [{}]{}", property.low, property.high, property.unit,
                         looks_like_no_data(*value)
                             ? fmt::format("; if that stands for no value: {}",
                                           fmt::format(fmt::runtime(rules_.no_data_in_words), *as_number(*value)))
                             : ""));
    }
  }
  return result;
}

/// Returns the number in a value; none if the value means "no value", or is wrong.
std::optional<double> PropertyReader::number_in(std::string_view key, const PropertyName& name, const JsonValue& value,
                                                bool& is_wrong) {
  const auto number = as_number(value);
  if (number && std::ranges::find(rules_.no_data, *number) != rules_.no_data.end()) {
    note(key, name.name, Reading::kNoData, value);
    return {};
  }
  if (!name.codes.empty()) {
    const auto code = std::ranges::find_if(name.codes, [&](const auto& one) { return is_code(value, one.first); });
    if (code != name.codes.end()) return code->second;
    note(key, name.name, Reading::kUnlistedCode, value);
    return {};
  }
  is_wrong = !number;
  if (!number) return {};
  if (value.is(JsonKind::kText)) note(key, name.name, Reading::kText, value);
  return name.factor * *number;
}

void PropertyReader::note(std::string_view key, const std::string& name, Reading reading, const JsonValue& value) {
  const auto is_it = [&](const Note& one) { return one.key == key && one.reading == reading; };
  auto found = std::ranges::find_if(notes_, is_it);
  if (found == notes_.end()) found = notes_.insert(notes_.end(), {std::string(key), name, reading, show(value), 0});
  ++found->floes;
}

std::vector<std::string> PropertyReader::notes() const {
  std::vector<std::string> words;
  for (const Note& one : notes_) {
    const std::string floes = counted(one.floes, "floe");
    if (one.reading == Reading::kText)
      words.push_back(
          fmt::format("property \"{}\" of {} is text, {}: it was read as a number", one.name, floes, one.example));
    else if (one.reading == Reading::kNoData)
      words.push_back(fmt::format("property \"{}\" of {} is {}, which stands for no value: no {} was read", one.name,
                                  floes, one.example, one.key));
    else
      words.push_back(fmt::format("property \"{}\" of {} is a code that is not listed, {}: no {} was read", one.name,
                                  floes, one.example, one.key));
  }
  return words;
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
