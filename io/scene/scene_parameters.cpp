#include "io/scene/scene_parameters.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "io/scene/scene_input.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::io {
namespace {

/// Keys that do not determine a run, or that make no sense for a coupled run.
constexpr std::array<std::string_view, 6> kLeftOut{"name", "description", "origin", "record", "walls", "until_s"};

/// Largest number of entries of "floes" that are searched, because a scene may list a million floes one by one.
constexpr std::size_t kMostGroups = 100;

void collect(const Object& object, const JsonValue& value, const std::string& path, std::vector<SceneParameter>& found);

/// Collects the parameters of the items of a list: all ships and structures, random fields of floes, and channels of
/// brash ice.
void collect_items(const Field& field, const JsonValue& list, const std::string& path,
                   std::vector<SceneParameter>& found) {
  if (field.key != "ships" && field.key != "structures" && field.key != "floes") return;
  for (std::size_t i = 0; i < std::min(list.items().size(), kMostGroups); ++i) {
    const JsonValue& item = list.items()[i];
    if (field.key == "floes" && !item.find("field") && !item.find("channel")) continue;
    collect(*field.object, item, fmt::format("{}[{}]", path, i), found);
  }
}

void collect_one(const Field& field, const JsonValue& value, const std::string& path,
                 std::vector<SceneParameter>& found) {
  const auto add = [&](FieldKind kind, double number) {
    found.push_back({path, std::string(field.unit), std::string(field.meaning), field.range, kind, number});
  };
  using Kind = JsonValue::Kind;
  if (field.kind == FieldKind::kObject && value.is(Kind::kObject)) return collect(*field.object, value, path, found);
  if (field.kind == FieldKind::kList && value.is(Kind::kArray)) return collect_items(field, value, path, found);
  if (field.kind == FieldKind::kBoolean && value.is(Kind::kBoolean))
    return add(FieldKind::kBoolean, value.boolean() ? 1 : 0);
  if (!value.is(Kind::kNumber)) return;
  if (field.kind == FieldKind::kInteger || field.kind == FieldKind::kNumber) add(field.kind, value.number());
  if (field.kind == FieldKind::kNumberOrLaw) add(FieldKind::kNumber, value.number());
}

void collect(const Object& object, const JsonValue& value, const std::string& path,
             std::vector<SceneParameter>& found) {
  for (const Field& field : object.fields) {
    if (std::ranges::find(kLeftOut, field.key) != kLeftOut.end()) continue;
    if (const JsonValue* member = value.find(field.key)) collect_one(field, *member, key_path(path, field.key), found);
  }
}

}  // namespace

std::vector<SceneParameter> scene_parameters(const LoadedScene& scene) {
  std::vector<SceneParameter> found;
  const JsonDocument document = parse_json(scene.resolved_text);
  collect(kSceneDescription, document.root, "", found);
  return found;
}

}  // namespace polynya::io
