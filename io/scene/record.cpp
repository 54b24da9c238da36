#include "io/scene/record.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/scene/gone_keys.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;

/// Smallest magnitude of a number that is not 0, in any unit. Squares, cubes and reciprocals of smaller numbers exceed
/// the range of doubles. A larger limit could refuse coordinates that differ from 0 only by rounding.
constexpr double kLeastMagnitude = 1e-100;

bool is_tiny(const JsonValue& value) {
  return value.is(JsonKind::kNumber) && value.number() != 0 && std::abs(value.number()) < kLeastMagnitude;
}

bool is_in(const Range& range, double value) {
  const bool low_ok = range.is_low_excluded ? value > range.low : value >= range.low;
  const bool high_ok = range.is_high_excluded ? value < range.high : value <= range.high;
  return low_ok && high_ok;
}

bool is_name(const std::string& text) {
  const auto is_plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  if (text.empty() || text.size() > 100 || !is_plain(text.front())) return false;
  return std::ranges::all_of(text, [&](char c) { return is_plain(c) || c == ' ' || c == '.' || c == '_' || c == '-'; });
}

std::string describe_range(const Field& field) {
  std::string text;
  const auto number = [](double value) {
    std::string digits;
    append_number(digits, value);
    return digits;
  };
  if (field.range.low > -std::numeric_limits<double>::infinity())
    text += (field.range.is_low_excluded ? " > " : " ≥ ") + number(field.range.low);
  if (field.range.high < std::numeric_limits<double>::infinity())
    text += (text.empty() ? "" : ",") + std::string(field.range.is_high_excluded ? " < " : " ≤ ") +
            number(field.range.high);
  if (!field.unit.empty()) text += fmt::format(" [{}]", field.unit);
  return text;
}

/// Returns the innermost wrong part of a number, or of nested lists of numbers with these lengths; null if all is
/// right.
const JsonValue* first_wrong_number(const Range& range, std::span<const Length> lengths, const JsonValue& value) {
  if (lengths.empty()) {
    const bool is_right =
        value.is(JsonKind::kNumber) && std::isfinite(value.number()) && is_in(range, value.number()) && !is_tiny(value);
    return is_right ? nullptr : &value;
  }
  const auto [least, most] = lengths.front();
  if (!value.is(JsonKind::kArray) || std::ssize(value.items()) < least ||
      (most > 0 && std::ssize(value.items()) > most))
    return &value;
  for (const JsonValue& item : value.items())
    if (const JsonValue* wrong = first_wrong_number(range, lengths.subspan(1), item)) return wrong;
  return nullptr;
}

/// Returns the innermost wrong part of a value that is not an object, or null.
const JsonValue* first_wrong(const Field& field, const JsonValue& value) {
  const auto only_if = [&](bool is_right) { return is_right ? nullptr : &value; };
  switch (field.kind) {
    case FieldKind::kText:
      return only_if(value.is(JsonKind::kText));
    case FieldKind::kName:
      return only_if(value.is(JsonKind::kText) && is_name(value.text()));
    case FieldKind::kBoolean:
      return only_if(value.is(JsonKind::kBoolean));
    case FieldKind::kChoice:
      return only_if(value.is(JsonKind::kText) &&
                     std::ranges::find(field.choices, value.text()) != field.choices.end());
    case FieldKind::kObject:
    case FieldKind::kList:
      return nullptr;
    default:
      break;
  }
  if (const JsonValue* wrong = first_wrong_number(field.range, lengths_of(field.kind), value)) return wrong;
  return only_if(field.kind != FieldKind::kInteger || value.number() == std::floor(value.number()));
}

/// Returns the keys that an object must have: "radius_m, or waterline_m" if there are alternatives.
std::string keys_needed_by(const Object& table) {
  const auto keys_of = [&](std::string_view alternative) {
    std::vector<std::string_view> keys;
    for (const Field& field : table.fields)
      if (field.alternative == alternative && field.presence == Presence::kRequired) keys.push_back(field.key);
    return fmt::format("{}", fmt::join(keys, " and "));
  };
  std::string forms = table.alternatives.empty() ? keys_of("") : "";
  for (const auto form : table.alternatives) forms += (forms.empty() ? "" : ", or ") + keys_of(form);
  return forms;
}

/// Describes what may be given for a field that is missing.
std::string describe_missing(const Field& field) {
  if (field.kind != FieldKind::kObject) return describe_allowed(field);
  return fmt::format("an object with {}{}", keys_needed_by(*field.object), field.instead);
}

std::optional<JsonValue> write_field(const Field& field, const void* record) {
  const auto part = [&](std::size_t item) { return field.find ? field.find(record, item) : nullptr; };
  if (field.kind == FieldKind::kList) {
    JsonValue list{JsonValue::Array{}};
    for (std::size_t i = 0; const void* item = part(i); ++i) list.items().push_back(write_object(*field.object, item));
    return list;
  }
  if (const void* found = part(0)) return write_object(*field.object, found);
  return field.get ? field.get(record) : std::nullopt;
}

}  // namespace

std::string key_path(std::string_view path, std::string_view key) {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

bool RecordReader::object(const Object& table, const JsonValue& value, const std::string& path, void* record,
                          std::size_t number) {
  if (!value.is(JsonKind::kObject)) {
    report(value.offset, path, show(value), "an object");
    return false;
  }
  report_unknown_keys(table, value, path);
  std::string_view alternative;
  bool is_whole = choose_alternative(table, value, path, alternative);
  for (const Field& field : table.fields) {
    if (!field.alternative.empty() && field.alternative != alternative) continue;
    is_whole = one_field(field, value, path, record, number) && is_whole;
  }
  return is_whole;
}

namespace {

/// Searches the scene's description for a key, with or without its unit. Returns the shortest path to it, or an empty
/// text if there is no such key.
std::string path_of_key(const Object& root, std::string_view key) {
  const auto is_meant = [key](const Field& field) {
    return !field.unit.empty() && field.key.starts_with(key) && field.key.substr(key.size()).starts_with('_');
  };
  std::vector<std::pair<const Object*, std::string>> level{{&root, ""}}, below;
  constexpr int kDeepest = 6;  // of scenes
  for (int depth = 0; depth < kDeepest && !level.empty(); ++depth, level = std::exchange(below, {})) {
    for (const bool is_exact : {true, false})
      for (const auto& [object, path] : level)
        for (const Field& field : object->fields)
          if (is_exact ? field.key == key : is_meant(field)) return key_path(path, field.key);
    for (const auto& [object, path] : level)
      for (const Field& field : object->fields)
        if (field.object)
          below.emplace_back(field.object, key_path(path, field.key) + (field.kind == FieldKind::kList ? "[0]" : ""));
  }
  return "";
}

}  // namespace

void RecordReader::report_unknown_keys(const Object& table, const JsonValue& value, const std::string& path) {
  std::vector<std::string_view> known;
  for (const Field& field : table.fields) known.push_back(field.key);
  for (const JsonMember& member : value.members()) {
    if (std::ranges::find(known, member.key) != known.end()) continue;
    if (path.empty() && member.key == "$schema") continue;
    const std::string at = key_path(path, member.key);
    if (const GoneKey* gone = gone_key(at)) {
      if (!gone->changes_nothing(member.value))
        report(member.key_offset, at, show(member.value), std::string(gone->allowed));
      continue;
    }
    std::string meant = nearest(member.key, known);
    if (meant.empty()) meant = path_of_key(*root_, member.key);
    report(member.key_offset, at, "an unknown key", fmt::format("{}", fmt::join(known, ", ")), std::move(meant));
  }
}

/// Finds the alternative whose fields are given. Returns false if there is none or more than one.
bool RecordReader::choose_alternative(const Object& table, const JsonValue& value, const std::string& path,
                                      std::string_view& chosen) {
  if (table.alternatives.empty()) return true;
  std::vector<std::string_view> given;
  for (const Field& field : table.fields) {
    if (field.alternative.empty() || !value.find(field.key)) continue;
    if (std::ranges::find(given, field.alternative) == given.end()) given.push_back(field.alternative);
  }
  if (!given.empty()) chosen = given.front();
  if (given.size() == 1) return true;
  report(value.offset, path, given.empty() ? "none of them" : fmt::format("{} together", fmt::join(given, " and ")),
         fmt::format("either {}", keys_needed_by(table)));
  return false;
}

bool RecordReader::one_field(const Field& field, const JsonValue& parent, const std::string& parent_path, void* record,
                             std::size_t number) {
  const std::string path = key_path(parent_path, field.key);
  const JsonValue* given = parent.find(field.key);
  if (given && checked(field, *given, path, record)) return true;
  if (!given && field.presence == Presence::kRequired) report(parent.offset, path, "nothing", describe_missing(field));
  const bool has_default = field.presence == Presence::kDefault;
  if (has_default && field.kind == FieldKind::kName && field.default_value.text().ends_with('#')) {
    std::string name = field.default_value.text();
    name.pop_back();
    field.set(record, {name + std::to_string(number)});
  }
  const bool may_be_missing = field.presence == Presence::kLeftOut || field.presence == Presence::kChosen;
  return has_default || (!given && may_be_missing);
}

bool RecordReader::checked(const Field& field, const JsonValue& value, const std::string& path, void* record) {
  if (field.kind == FieldKind::kObject) return object(*field.object, value, path, field.open(record), 1);
  if (field.kind == FieldKind::kList) return list(field, value, path, record);
  if (field.kind == FieldKind::kNumberOrLaw && value.is(JsonKind::kObject)) return law(field, value, path, record);
  if (field.kind == FieldKind::kNumberOrVector && value.is(JsonKind::kNumber))
    return leaf(field, {JsonValue::Array{value, value}, value.offset}, path, record);
  return leaf(field, value, path, record);
}

bool RecordReader::leaf(const Field& field, const JsonValue& value, const std::string& path, void* record) {
  if (const JsonValue* wrong = first_wrong(field, value)) {
    const std::string size = is_tiny(*wrong) ? fmt::format(", 0 or at least {:g} in size", kLeastMagnitude) : "";
    report(wrong->offset, path, show(*wrong), describe_allowed(field) + size,
           wrong->is(JsonKind::kText) ? nearest(wrong->text(), field.choices) : "");
    return false;
  }
  if (record && field.set) field.set(record, value);
  return true;
}

bool RecordReader::list(const Field& field, const JsonValue& value, const std::string& path, void* record) {
  if (!value.is(JsonKind::kArray) || !is_in(field.range, static_cast<double>(value.items().size()))) {
    report(value.offset, path, show(value), describe_allowed(field));
    return false;
  }
  for (std::size_t i = 0; field.open && i < value.items().size(); ++i) {
    void* const item = field.open(record);
    if (!object(*field.object, value.items()[i], fmt::format("{}[{}]", path, i), item, i + 1)) field.drop(record);
  }
  return true;
}

/// Reads a law. Its numbers have the unit and the range of the field.
bool RecordReader::law(const Field& field, const JsonValue& value, const std::string& path, void* record) {
  if (!object(*field.object, value, path, field.open(record), 1)) return false;
  Field number = field;
  number.kind = FieldKind::kNumber;
  bool is_whole = true;
  for (const std::string_view key : {"mean", "least", "most"}) {
    const JsonValue* member = value.find(key);
    if (member && !leaf(number, *member, key_path(path, key), nullptr)) is_whole = false;
  }
  return is_whole;
}

JsonValue write_object(const Object& object, const void* record) {
  JsonValue value{JsonValue::Object{}};
  for (const Field& field : object.fields) {
    if (auto member = write_field(field, record))
      value.members().push_back({std::string(field.key), 0, std::move(*member)});
  }
  return value;
}

std::span<const Length> lengths_of(FieldKind kind) {
  static constexpr Length kNumbers[]{{}}, kRings[]{{}, {3}, {2, 2}}, kLine[]{{2}, {2, 2}};
  const std::span<const Length> ring = std::span(kRings).subspan(1), vector = std::span(kRings).subspan(2);
  return kind == FieldKind::kVector || kind == FieldKind::kNumberOrVector ? vector
         : kind == FieldKind::kNumbers                                    ? kNumbers
         : kind == FieldKind::kLine                                       ? kLine
         : kind == FieldKind::kRing                                       ? ring
         : kind == FieldKind::kRings                                      ? std::span<const Length>(kRings)
                                                                          : std::span<const Length>();
}

std::string describe_allowed(const Field& field) {
  static constexpr std::string_view kWords[]{
      "text",
      "1 to 100 letters, digits, spaces and . _ -, starting with a letter or digit",
      "an integer",
      "a number",
      "true or false",
      "one of ",
      "a number",
      "[x, y], each",
      "a number or [x, y], each",
      "a list of numbers, each",
      "a list of two or more [x, y], each",
      "a list of three or more [x, y], each",
      "a list of rings, each three or more [x, y], each",
      "an object",
      "a list of objects, its length"};
  const std::string words(kWords[static_cast<std::size_t>(field.kind)]);
  if (field.kind == FieldKind::kChoice) return words + fmt::format("{}", fmt::join(field.choices, ", "));
  return words + describe_range(field) + (field.kind == FieldKind::kNumberOrLaw ? ", or a law of such" : "");
}

double to_si(std::string_view unit, double value) {
  if (unit.starts_with("°")) return value * std::numbers::pi / 180;
  if (unit == "kN") return 1e3 * value;
  return unit == "MW" ? 1e6 * value : value;
}

double from_si(std::string_view unit, double value) {
  if (!std::isfinite(value) || to_si(unit, value) == value) return value;
  const double near = unit.starts_with("°") ? value / std::numbers::pi * 180 : value / to_si(unit, 1);
  for (int digits = 0; digits < 17; ++digits) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, near, std::chars_format::scientific, digits).ptr;
    double candidate = 0;
    std::from_chars(text, end, candidate);
    if (to_si(unit, candidate) == value) return candidate;
  }
  // Among seventeen digits the number that the user wrote may be a neighbouring double.
  double candidate = near;
  for (int i = 0; i < 4; ++i) candidate = std::nextafter(candidate, -std::numeric_limits<double>::infinity());
  for (int i = 0; i < 8 && to_si(unit, candidate) != value; ++i)
    candidate = std::nextafter(candidate, std::numeric_limits<double>::infinity());
  return to_si(unit, candidate) == value ? candidate : near;
}

}  // namespace polynya::io
