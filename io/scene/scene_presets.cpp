#include "io/scene/scene_presets.hpp"

#include <algorithm>

#include "io/scene/scene_fields.hpp"
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

/// Whether the ship is driven by something else than an engine: then the preset's steering, which needs one,
/// gives way with it.
bool has_no_engine(const JsonValue& ship) {
  const JsonValue* propulsion = ship.find("propulsion", JsonValue::Kind::kObject);
  return propulsion && !propulsion->members().empty() && !propulsion->find("engine");
}

}  // namespace

void fill_in_presets(JsonValue& scene) {
  JsonValue* ships = scene.find("ships");
  const Field* table = field_of(scene_object(), "ships");
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
    JsonValue particulars = json_of(*preset);
    if (has_no_engine(ship) && !ship.find("steering"))
      std::erase_if(particulars.members(), [](const JsonMember& member) { return member.key == "steering"; });
    merge(*table->object, ship, particulars, offset);
  }
}

}  // namespace polynya::io
