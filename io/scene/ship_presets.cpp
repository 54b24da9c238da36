#include "io/scene/ship_presets.hpp"

#include <algorithm>

#include "io/scene/scene_input.hpp"

namespace polynya::io {
namespace {

std::vector<ShipPreset> make_presets() {
  const JsonDocument document = parse_json(kShipPresets);
  std::vector<ShipPreset> presets;
  for (const JsonValue& ship : document.root.items()) {
    ShipPreset& preset = presets.emplace_back();
    preset.name = ship.find("name")->text();
    preset.title = ship.find("title")->text();
    for (const JsonValue& row : ship.find("particulars")->items()) {
      const JsonValue::Array& of = row.items();
      preset.particulars.push_back(
          {of[0].text(), compact_json(kShipPresets, of[1].offset), of[2].text(), of[3].text()});
    }
    for (const JsonValue& row : ship.find("reported")->items()) {
      const JsonValue::Array& of = row.items();
      preset.reported.push_back({of[0].number(), of[1].number() * kKnot, of[2].number(), of[3].text()});
    }
  }
  return presets;
}

/// Sets the value at a dotted path. Missing objects on the way are created.
void put_at(JsonValue& object, std::string_view path, JsonValue value) {
  const std::size_t dot = path.find('.');
  const std::string_view key = path.substr(0, dot);
  if (!object.find(key)) object.set(key, JsonValue::Object{});
  if (dot == std::string_view::npos)
    *object.find(key) = std::move(value);
  else
    put_at(*object.find(key), path.substr(dot + 1), std::move(value));
}

/// Returns true if the object has a field of another alternative than that of `field`.
bool chose_another(const Object& table, const JsonValue& object, const Field& field) {
  return !field.alternative.empty() && std::ranges::any_of(table.fields, [&](const Field& other) {
    return !other.alternative.empty() && other.alternative != field.alternative && object.find(other.key);
  });
}

void merge(const Object& table, JsonValue& given, const JsonValue& preset, std::uint32_t offset) {
  for (const JsonMember& member : preset.members()) {
    const auto field = std::ranges::find(table.fields, member.key, &Field::key);
    if (field == table.fields.end() || chose_another(table, given, *field)) continue;
    JsonValue* own = given.find(member.key);
    if (!own) {
      JsonMember& added = given.members().emplace_back(JsonMember{member.key, offset, member.value});
      for_offsets(added.value, [offset](std::uint32_t& place) { place = offset; });
    } else if (field->object && own->is(JsonValue::Kind::kObject)) {
      merge(*field->object, *own, member.value, offset);
    }
  }
}

/// Returns true if the ship is driven by something other than an engine. The preset's steering needs an engine and is
/// then left out.
bool has_no_engine(const JsonValue& ship) {
  const JsonValue* propulsion = ship.find("propulsion", JsonValue::Kind::kObject);
  return propulsion && !propulsion->members().empty() && !propulsion->find("engine");
}

}  // namespace

std::span<const ShipPreset> ship_presets() {
  static const std::vector<ShipPreset> presets = make_presets();
  return presets;
}

const ShipPreset* find_ship_preset(std::string_view name) {
  const auto presets = ship_presets();
  const auto found = std::ranges::find(presets, name, &ShipPreset::name);
  return found == presets.end() ? nullptr : &*found;
}

JsonValue json_of(const ShipPreset& preset) {
  JsonValue ship{JsonValue::Object{}, 0};
  for (const PresetValue& value : preset.particulars) put_at(ship, value.path, parse_json(value.json).root);
  return ship;
}

void fill_in_presets(JsonValue& scene) {
  JsonValue* ships = scene.find("ships");
  if (!ships || !ships->is(JsonValue::Kind::kArray)) return;
  for (JsonValue& ship : ships->items()) {
    const JsonValue* name = ship.is(JsonValue::Kind::kObject) ? ship.find("ship", JsonValue::Kind::kText) : nullptr;
    if (!name) continue;
    const std::uint32_t offset = name->offset;
    const ShipPreset* preset = find_ship_preset(name->text());
    if (preset) std::erase_if(ship.members(), [](const JsonMember& member) { return member.key == "ship"; });
    // For an unknown preset only its name is reported. The values of a known one avoid messages about everything that
    // is missing.
    if (!preset) preset = find_ship_preset("reference");
    JsonValue particulars = json_of(*preset);
    if (has_no_engine(ship) && !ship.find("steering"))
      std::erase_if(particulars.members(), [](const JsonMember& member) { return member.key == "steering"; });
    merge(kShipDescription, ship, particulars, offset);
  }
}

}  // namespace polynya::io
