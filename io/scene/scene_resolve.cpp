#include "io/scene/scene_resolve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/scene/scene_field_parts.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;

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
  return std::ranges::all_of(
      text, [&](char c) { return is_plain(c) || c == ' ' || c == '.' || c == '_' || c == '-'; });
}

/// The keys that an object cannot be without: "radius_m, or waterline_m" where there are alternatives.
std::string keys_needed_by(const Object& table) {
  const auto keys_of = [&](std::string_view alternative) {
    std::vector<std::string_view> keys;
    for (const Field& field : table.fields)
      if (field.alternative == alternative && field.default_json.empty()) keys.push_back(field.key);
    return fmt::format("{}", fmt::join(keys, " and "));
  };
  std::string forms = table.alternatives.empty() ? keys_of("") : "";
  for (const auto form : table.alternatives) forms += (forms.empty() ? "" : ", or ") + keys_of(form);
  return forms;
}

/// What is allowed in place of a field that is missing.
std::string describe_missing(const Object& table, const Field& field) {
  if (field.kind != FieldKind::kObject) return describe_allowed(field);
  const bool is_of_ship = &table == &ship_object();
  return fmt::format("an object with {}{}", keys_needed_by(*field.object),
                     is_of_ship ? R"(; or "ship": a preset's name, as "reference" (polynya ships))" : "");
}

class Resolver {
 public:
  explicit Resolver(ProblemCollector& problems) : problems_(problems) {}

  /// Nothing where a field that has no default is missing or wrong.
  std::optional<JsonValue> object(const Object& table, const JsonValue& value, const std::string& path) {
    if (!value.is(JsonKind::kObject)) {
      report(value.offset, path, show(value), "an object");
      return std::nullopt;
    }
    report_unknown_keys(table, value, path);
    bool is_whole = true;
    const auto alternative = chosen_alternative(table, value, path, is_whole);
    JsonValue resolved{JsonValue::Object{}, value.offset};
    for (const Field& field : table.fields) {
      if (!field.alternative.empty() && field.alternative != alternative) continue;
      if (field.default_json == kLeftOut && !value.find(field.key)) continue;
      auto member = one_field(table, field, value, path);
      if (!member)
        is_whole = false;
      else
        resolved.members().push_back({std::string(field.key), value.offset, std::move(*member)});
    }
    if (!is_whole) return std::nullopt;
    return resolved;
  }

 private:
  static std::string join(const std::string& path, std::string_view key) {
    return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
  }

  void report(std::uint32_t offset, const std::string& path, std::string found, std::string allowed,
              std::string suggestion = {}) {
    problems_.report(0, offset, path, std::move(found), std::move(allowed), std::move(suggestion));
  }

  void report_unknown_keys(const Object& table, const JsonValue& value, const std::string& path) {
    std::vector<std::string_view> known;
    for (const Field& field : table.fields) known.push_back(field.key);
    for (const JsonMember& member : value.members()) {
      if (std::ranges::find(known, member.key) != known.end()) continue;
      if (path.empty() && member.key == "$schema") continue;
      report(member.key_offset, join(path, member.key), "an unknown key",
             fmt::format("{}", fmt::join(known, ", ")), nearest(member.key, known));
    }
  }

  /// The alternative of which any field is given.
  std::string_view chosen_alternative(const Object& table, const JsonValue& value, const std::string& path,
                                      bool& is_whole) {
    if (table.alternatives.empty()) return "";
    std::vector<std::string_view> chosen;
    for (const Field& field : table.fields) {
      if (field.alternative.empty() || !value.find(field.key)) continue;
      if (std::ranges::find(chosen, field.alternative) == chosen.end()) chosen.push_back(field.alternative);
    }
    if (chosen.size() == 1) return chosen.front();
    report(value.offset, path,
           chosen.empty() ? "none of them" : fmt::format("{} together", fmt::join(chosen, " and ")),
           fmt::format("either {}", keys_needed_by(table)));
    is_whole = false;
    return chosen.empty() ? "" : chosen.front();
  }

  std::optional<JsonValue> one_field(const Object& table, const Field& field, const JsonValue& parent,
                                     const std::string& parent_path) {
    const std::string path = join(parent_path, field.key);
    const JsonValue* given = parent.find(field.key);
    if (!given) {
      if (!field.default_json.empty()) return default_of(field, parent.offset, path);
      report(parent.offset, path, "nothing", describe_missing(table, field));
      return std::nullopt;
    }
    std::optional<JsonValue> resolved = checked(field, *given, path);
    if (!resolved && !field.default_json.empty() && field.default_json != kLeftOut)
      return default_of(field, given->offset, path);
    return resolved;
  }

  JsonValue default_of(const Field& field, std::uint32_t offset, const std::string& path) {
    JsonValue value = parse_json(field.default_json).root;
    value.offset = offset;
    if (field.kind == FieldKind::kObject) return object(*field.object, value, path).value_or(value);
    if (field.kind == FieldKind::kName && value.text().ends_with('#')) {
      value.data = value.text().substr(0, value.text().size() - 1) + std::to_string(item_number_);
    }
    return value;
  }

  std::optional<JsonValue> checked(const Field& field, const JsonValue& value, const std::string& path) {
    if (field.kind == FieldKind::kObject) return object(*field.object, value, path);
    if (field.kind == FieldKind::kList) return list(field, value, path);
    if (field.kind == FieldKind::kNumberOrLaw && value.is(JsonKind::kObject)) return law(field, value, path);
    if (field.kind == FieldKind::kNumberOrVector && value.is(JsonKind::kNumber)) {
      return checked_deep(field, {JsonValue::Array{value, value}, value.offset}, path);
    }
    return checked_deep(field, value, path);
  }

  std::optional<JsonValue> list(const Field& field, const JsonValue& value, const std::string& path) {
    if (!value.is(JsonKind::kArray)) {
      report(value.offset, path, show(value), describe_allowed(field));
      return std::nullopt;
    }
    if (!is_in(field.range, static_cast<double>(value.items().size()))) {
      report(value.offset, path, show(value), describe_allowed(field));
      return std::nullopt;
    }
    JsonValue resolved{JsonValue::Array{}, value.offset};
    for (std::size_t i = 0; i < value.items().size(); ++i) {
      item_number_ = i + 1;
      auto item = object(*field.object, value.items()[i], fmt::format("{}[{}]", path, i));
      resolved.items().push_back(item ? std::move(*item) : JsonValue{nullptr, value.items()[i].offset});
    }
    return resolved;
  }

  /// The numbers of a law are in the unit and range of its field.
  std::optional<JsonValue> law(const Field& field, const JsonValue& value, const std::string& path) {
    std::optional<JsonValue> resolved = object(law_object(), value, path);
    if (!resolved) return resolved;
    Field number = field;
    number.kind = FieldKind::kNumber;
    bool is_whole = true;
    for (const std::string_view key : {"mean", "least", "most"}) {
      const JsonValue* member = resolved->find(key);
      if (member && !checked_deep(number, *member, join(path, key))) is_whole = false;
    }
    if (!is_whole) return std::nullopt;
    return resolved;
  }

  /// Checks values that are not made of fields; the innermost wrong one is reported.
  std::optional<JsonValue> checked_deep(const Field& field, const JsonValue& value, const std::string& path) {
    if (const JsonValue* wrong = first_wrong(field, value)) {
      report(wrong->offset, path, show(*wrong), describe_allowed(field),
             wrong->is(JsonKind::kText) ? nearest(wrong->text(), field.choices) : "");
      return std::nullopt;
    }
    return value;
  }

  static const JsonValue* first_wrong(const Field& field, const JsonValue& value) {
    const auto number = [&](const JsonValue& v) {
      const bool ok = v.is(JsonKind::kNumber) && std::isfinite(v.number()) && is_in(field.range, v.number());
      return ok ? nullptr : &v;
    };
    const auto each = [](const JsonValue& v, std::size_t least, auto&& check) -> const JsonValue* {
      if (!v.is(JsonKind::kArray) || v.items().size() < least) return &v;
      for (const JsonValue& item : v.items()) {
        if (const JsonValue* wrong = check(item)) return wrong;
      }
      return nullptr;
    };
    const auto vector = [&](const JsonValue& v) {
      return v.is(JsonKind::kArray) && v.items().size() == 2 ? each(v, 2, number) : &v;
    };
    const auto ring = [&](const JsonValue& v) { return each(v, 3, vector); };
    switch (field.kind) {
      case FieldKind::kText:
        return value.is(JsonKind::kText) ? nullptr : &value;
      case FieldKind::kName:
        return value.is(JsonKind::kText) && is_name(value.text()) ? nullptr : &value;
      case FieldKind::kInteger:
        return number(value) || value.number() != std::floor(value.number()) ? &value : nullptr;
      case FieldKind::kNumber:
      case FieldKind::kNumberOrLaw:
        return number(value);
      case FieldKind::kBoolean:
        return value.is(JsonKind::kBoolean) ? nullptr : &value;
      case FieldKind::kChoice:
        return value.is(JsonKind::kText) &&
                       std::ranges::find(field.choices, value.text()) != field.choices.end()
                   ? nullptr
                   : &value;
      case FieldKind::kVector:
      case FieldKind::kNumberOrVector:
        return vector(value);
      case FieldKind::kNumbers:
        return each(value, 0, number);
      case FieldKind::kLine:
        return each(value, 2, vector);
      case FieldKind::kRing:
        return ring(value);
      case FieldKind::kRings:
        return each(value, 0, ring);
      case FieldKind::kObject:
      case FieldKind::kList:
        break;
    }
    return nullptr;
  }

  ProblemCollector& problems_;
  std::size_t item_number_ = 0;
};

void bind(const Object& table, const JsonValue& value, SceneDraft& draft, const OnItem& on_item) {
  for (const Field& field : table.fields) {
    const JsonValue* member = value.find(field.key);
    if (!member) continue;
    if (field.kind == FieldKind::kObject) {
      bind(*field.object, *member, draft, on_item);
    } else if (field.kind == FieldKind::kList) {
      for (std::size_t i = 0; i < member->items().size(); ++i) {
        const JsonValue& item = member->items()[i];
        if (item.is_null()) continue;
        field.object->begin(draft);
        bind(*field.object, item, draft, on_item);
        on_item(field.key, i, item);
      }
    } else {
      field.set(draft, *member);
    }
  }
}

}  // namespace

std::string show(const JsonValue& value) {
  std::string text;
  switch (value.kind()) {
    case JsonKind::kNumber:
      append_number(text, value.number());
      return text;
    case JsonKind::kText:
      append_text(text, shortened(value.text(), 60));
      return text;
    case JsonKind::kBoolean:
      return value.boolean() ? "true" : "false";
    case JsonKind::kArray:
      return fmt::format("a list of {}", value.items().size());
    default:
      return std::string(name_of(value.kind()));
  }
}

JsonValue resolve_scene(const JsonValue& root, ProblemCollector& problems) {
  return Resolver(problems).object(scene_object(), root, "").value_or(JsonValue{JsonValue::Object{}, 0});
}

void bind_scene(const JsonValue& resolved, SceneDraft& draft, const OnItem& on_item) {
  bind(scene_object(), resolved, draft, on_item);
}

}  // namespace polynya::io
