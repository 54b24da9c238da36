#include "io/scene/gone_keys.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "io/scene/record.hpp"

namespace polynya::io {
namespace {

bool is_one(const JsonValue& value) {
  return value.is(JsonValue::Kind::kNumber) && value.number() == 1;
}

bool has_only_ones(const JsonValue& value) {
  return value.is(JsonValue::Kind::kObject) &&
         std::ranges::all_of(value.members(), [](const JsonMember& member) { return is_one(member.value); });
}

// The scene.json of older runs contains all keys. So keys of older versions are still accepted with values that change
// nothing.
constexpr GoneKey kGoneKeys[]{
    {.path = "time.levels",
     .changes_nothing = [](const JsonValue&) { return true; },
     .instead = "the parts of a tick follow from what happens in it (docs/theory/steps.md)"},
    {.path = "fracture.bending.load_factor",
     .changes_nothing = is_one,
     .allowed = "1, or no such key: this calibration factor was removed. The bending load V_b is proportional to "
                "ice.flexural_strength_Pa, which can be given instead",
     .instead = "calibration factors were removed"},
    {.path = "fracture.bending.cusp_radius_factor",
     .changes_nothing = is_one,
     .allowed = "1, or no such key: this calibration factor was removed, and nothing replaces it",
     .instead = "calibration factors were removed"},
    {.path = "ships.calibration",
     .changes_nothing = has_only_ones,
     .allowed = "factors of 1, or no such key: calibration factors were removed. The bending load V_b is proportional "
                "to ice.flexural_strength_Pa, which can be given instead",
     .instead = "calibration factors were removed"},
};

std::string without_item_numbers(std::string_view path) {
  std::string found;
  bool is_inside = false;
  for (const char c : path) {
    if (c == '[') is_inside = true;
    if (!is_inside) found += c;
    if (c == ']') is_inside = false;
  }
  return found;
}

void add_hints(const JsonValue& value, const std::string& path, ProblemCollector& hints) {
  if (value.is(JsonValue::Kind::kArray)) {
    for (std::size_t i = 0; i < value.items().size(); ++i)
      add_hints(value.items()[i], fmt::format("{}[{}]", path, i), hints);
  }
  if (!value.is(JsonValue::Kind::kObject)) return;
  for (const JsonMember& member : value.members()) {
    const std::string at = key_path(path, member.key);
    if (const GoneKey* gone = gone_key(at)) {
      hints.add(0, member.key_offset,
                {.path = at,
                 .sentence = fmt::format("has no effect any more, and the next version will refuse it: {}; leave it "
                                         "out",
                                         gone->instead),
                 .severity = Severity::kHint});
    } else {
      add_hints(member.value, at, hints);
    }
  }
}

}  // namespace

const GoneKey* gone_key(std::string_view path) {
  const auto found = std::ranges::find(kGoneKeys, without_item_numbers(path), &GoneKey::path);
  return found == std::end(kGoneKeys) ? nullptr : found;
}

void add_hints_at_gone_keys(const JsonValue& given, ProblemCollector& hints) {
  // Floes are left out, because there may be a million, and none of these keys is theirs.
  for (const std::string_view part : {"time", "fracture", "ships"})
    if (const JsonValue* found = given.find(part)) add_hints(*found, std::string(part), hints);
}

}  // namespace polynya::io
