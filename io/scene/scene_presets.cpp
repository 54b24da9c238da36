#include "io/scene/scene_presets.hpp"

#include <algorithm>

#include "io/scene/scene_input.hpp"
#include "io/scene/ship_presets.hpp"

namespace polynya::io {
namespace {

const Field* field_of(const Object& table, std::string_view key) {
  const auto found = std::find_if(table.fields.begin(), table.fields.end(),
                                  [&](const Field& field) { return field.key == key; });
  return found == table.fields.end() ? nullptr : &*found;
}

/// Whether the object has a field of another one of its table's alternatives.
bool chose_another(const Object& table, const JsonValue& object, const Field& field) {
  if (field.alternative.empty()) return false;
  return std::any_of(table.fields.begin(), table.fields.end(), [&](const Field& other) {
    return !other.alternative.empty() && other.alternative != field.alternative && object.find(other.key);
  });
}

void place_at(JsonValue& value, std::uint32_t offset) {
  value.offset = offset;
  if (!value.is(JsonValue::Kind::kObject)) return;
  for (JsonMember& member : value.members()) {
    member.key_offset = offset;
    place_at(member.value, offset);
  }
}

void merge(const Object& table, JsonValue& given, const JsonValue& preset, std::uint32_t offset) {
  for (const JsonMember& member : preset.members()) {
    const Field* field = field_of(table, member.key);
    if (!field || chose_another(table, given, *field)) continue;
    JsonValue* own = given.find(member.key);
    if (!own) {
      JsonMember added = member;
      added.key_offset = offset;
      place_at(added.value, offset);
      given.members().push_back(std::move(added));
    } else if (field->object && own->is(JsonValue::Kind::kObject)) {
      merge(*field->object, *own, member.value, offset);
    }
  }
}

}  // namespace

void fill_in_presets(JsonValue& scene) {
  JsonValue* ships = scene.find("ships");
  if (!ships || !ships->is(JsonValue::Kind::kArray)) return;
  for (JsonValue& ship : ships->items()) {
    const JsonValue* name =
        ship.is(JsonValue::Kind::kObject) ? ship.find("ship", JsonValue::Kind::kText) : nullptr;
    if (!name) continue;
    const std::uint32_t offset = name->offset;
    const ShipPreset* preset = find_ship_preset(name->text());
    if (preset) std::erase_if(ship.members(), [](const JsonMember& member) { return member.key == "ship"; });
    // Of an unknown one the name is reported, and not all that it would have filled in.
    if (!preset) preset = find_ship_preset("reference");
    merge(ship_description(), ship, json_of(*preset), offset);
  }
}

}  // namespace polynya::io
