#include "io/scene/ship_presets.hpp"

#include <algorithm>
#include <string>

#include "io/scene/scene_input.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::io {
namespace {

constexpr Basis kPublished = Basis::kPublished;
constexpr Basis kEstimated = Basis::kEstimated;
constexpr Basis kAssumed = Basis::kAssumed;
constexpr Basis kRecall = Basis::kRecall;

constexpr std::string_view kPaper = "[Sawamura2017]";
constexpr std::string_view kArctia = "[Arctia2016]";
constexpr std::string_view kNordicaPage = "[NordicaPage]";
constexpr std::string_view kOdenSheet = "[OdenSheet]";
constexpr std::string_view kXueLongPage = "[XueLong2Page]";
constexpr std::string_view kWaterline = "from the length over all";
constexpr std::string_view kAngles = "typical of icebreakers of its kind";
constexpr std::string_view kByPower = "K_e (P D)^2/3 gives the pull that is reported or usual for its power";

std::vector<Particular> paper_ship() {
  return {{"hull.length_m", "120", kPublished, kPaper},
          {"hull.beam_m", "24", kPublished, kPaper},
          {"hull.entrance_angle_deg", "27", kPublished, kPaper},
          {"hull.stem_angle_deg", "30", kPublished, kPaper},
          {"mass_kg", "1e7", kPublished, kPaper},
          {"moment_of_inertia_kg_m2", "5e9", kPublished, kPaper}};
}

ShipPreset reference_ship() {
  ShipPreset ship{"reference", "The paper's ship with a draught, an engine and a rudder", paper_ship(), {}};
  for (const Particular& more : std::vector<Particular>{
           {"hull.draught_m", "6", kAssumed, "the project's reference ship"},
           {"hull.block_coefficient", "0.579", kEstimated, "from its mass, in fresh water"},
           {"propulsion.engine.bollard_pull_kN", "1000", kAssumed, "the project's reference ship"},
           {"propulsion.engine.open_water_speed_m_per_s", "8", kAssumed, "the project's reference ship"},
           {"steering.rudder.max_deg", "35", kAssumed, "usual of single rudders"}})
    ship.particulars.push_back(more);
  return ship;
}

ShipPreset araon() {
  return {"araon",
          "Araon, research icebreaker, KOPRI 2009",
          {{"hull.length_m", "95", kEstimated, kWaterline},
           {"hull.beam_m", "19", kRecall, "main dimensions"},
           {"hull.draught_m", "6.8", kRecall, "main dimensions"},
           {"hull.block_coefficient", "0.6", kAssumed, "displacement not known"},
           {"hull.stem_angle_deg", "35", kAssumed, kAngles},
           {"hull.entrance_angle_deg", "30", kAssumed, kAngles},
           {"propulsion.engine.power_MW", "10", kRecall, "two azimuthing thrusters of 5 MW"},
           {"propulsion.engine.propellers", "2", kRecall, "two azimuthing thrusters of 5 MW"},
           {"propulsion.engine.propeller_diameter_m", "4.3", kEstimated, kByPower},
           {"propulsion.engine.open_water_speed_m_per_s", "8.23", kRecall, "16 kn"},
           {"steering.azimuth.rate_deg_per_s", "8", kAssumed, "usual of azimuthing thrusters"}},
          {{1.0, 3 * kKnot, 630e3, "design point (recall)"}}};
}

ShipPreset polaris() {
  return {
      "polaris",
      "Polaris, Baltic icebreaker, Arctia 2016",
      {{"hull.length_m", "100", kEstimated, kWaterline},
       {"hull.beam_m", "24", kPublished, kArctia},
       {"hull.draught_m", "8", kPublished, kArctia},
       {"hull.block_coefficient", "0.571", kEstimated, "from 10 961 t at 8 m in fresh water, [Arctia2016]"},
       {"hull.stem_angle_deg", "25", kAssumed, kAngles},
       {"hull.entrance_angle_deg", "30", kAssumed, kAngles},
       {"propulsion.engine.bollard_pull_kN", "2100", kPublished, "214 t, [Arctia2016]"},
       {"propulsion.engine.power_MW", "19", kPublished, "three azimuthing thrusters, one at the bow, [Arctech2016]"},
       {"propulsion.engine.propellers", "3", kPublished, "[Arctech2016]"},
       {"propulsion.engine.open_water_speed_m_per_s", "8.75", kPublished, "17 kn, [Arctia2016]"},
       {"steering.azimuth.rate_deg_per_s", "8", kAssumed, "usual of azimuthing thrusters"}},
      {{1.2, 6 * kKnot, 0, "[Arctia2016]"}, {1.8, 3.5 * kKnot, 0, "[Workboat2016]"}}};
}

ShipPreset nordica() {
  return {"nordica",
          "Nordica, multipurpose icebreaker, 1994",
          {{"hull.length_m", "96.7", kPublished, "between perpendiculars, [NordicaPage]"},
           {"hull.beam_m", "26", kPublished, kNordicaPage},
           {"hull.draught_m", "7", kPublished, "as a Baltic icebreaker, [NordicaPage]"},
           {"hull.block_coefficient", "0.59", kEstimated, "from 12 800 t at 8.4 m, [NordicaPage]"},
           {"hull.stem_angle_deg", "25", kAssumed, kAngles},
           {"hull.entrance_angle_deg", "30", kAssumed, kAngles},
           {"propulsion.engine.bollard_pull_kN", "2300", kRecall, "trials"},
           {"propulsion.engine.power_MW", "15", kPublished, "two azimuthing thrusters of 7.5 MW, [NordicaPage]"},
           {"propulsion.engine.propellers", "2", kPublished, kNordicaPage},
           {"propulsion.engine.open_water_speed_m_per_s", "8.49", kPublished, "16.5 kn, [NordicaPage]"},
           {"steering.azimuth.rate_deg_per_s", "8", kAssumed, "usual of azimuthing thrusters"}},
          {{0.8, 9.5 * kKnot, 0, kNordicaPage}}};
}

ShipPreset oden() {
  return {"oden",
          "Oden, Swedish icebreaker, 1988",
          {{"hull.length_m", "95", kEstimated, kWaterline},
           {"hull.beam_m", "29.4", kRecall, "of the bow; 31 m over all, [OdenSheet]"},
           {"hull.draught_m", "8", kPublished, "7.0 to 8.5 m, [OdenSheet]"},
           {"hull.block_coefficient", "0.54", kEstimated, "from 13 000 t at 8.5 m, [OdenSheet]"},
           {"hull.stem_angle_deg", "22", kAssumed, kAngles},
           {"hull.entrance_angle_deg", "40", kAssumed, kAngles},
           {"propulsion.engine.bollard_pull_kN", "2500", kRecall, "in nozzles"},
           {"propulsion.engine.power_MW", "18", kPublished, kOdenSheet},
           {"propulsion.engine.propellers", "2", kPublished, kOdenSheet},
           {"propulsion.engine.propeller_diameter_m", "4.5", kPublished, kOdenSheet},
           {"propulsion.engine.open_water_speed_m_per_s", "8.23", kPublished, "16 kn, [OdenSheet]"},
           {"steering.rudder.area_m2", "56", kPublished, "two of 28 m2, [OdenSheet]"},
           {"steering.rudder.max_deg", "70", kPublished, kOdenSheet}},
          {{1.8, 3 * kKnot, 0, kOdenSheet}, {1.9, 3 * kKnot, 0, "[OdenWhoi]"}}};
}

ShipPreset xue_long_2() {
  return {"xuelong-2",
          "Xue Long 2, research icebreaker, 2019",
          {{"hull.length_m", "116", kEstimated, kWaterline},
           {"hull.beam_m", "22.3", kPublished, kXueLongPage},
           {"hull.draught_m", "7.9", kPublished, "of the design, [XueLong2Page]"},
           {"hull.block_coefficient", "0.65", kEstimated, "from 14 300 t at 8.3 m, [XueLong2Page]"},
           {"hull.stem_angle_deg", "25", kAssumed, kAngles},
           {"hull.entrance_angle_deg", "30", kAssumed, kAngles},
           {"propulsion.engine.power_MW", "15", kPublished, "two azimuthing thrusters of 7.5 MW, [XueLong2Page]"},
           {"propulsion.engine.propellers", "2", kPublished, kXueLongPage},
           {"propulsion.engine.propeller_diameter_m", "4.5", kEstimated, kByPower},
           {"propulsion.engine.open_water_speed_m_per_s", "7.72", kPublished, "15 kn, [XueLong2Page]"},
           {"steering.azimuth.rate_deg_per_s", "8", kAssumed, "usual of azimuthing thrusters"}},
          {{1.5, 2.5 * kKnot, 0, "2 to 3 kn, with .2 m of snow, [XueLong2Page]"}}};
}

std::vector<ShipPreset> make_presets() {
  return {{"sawamura2017", "The paper's ship: no draught, no engine", paper_ship(), {}},
          reference_ship(),
          araon(),
          polaris(),
          nordica(),
          oden(),
          xue_long_2()};
}

/// Puts a value at a dotted path, making the objects on the way.
void put_at(JsonValue& object, std::string_view path, JsonValue value) {
  const std::size_t dot = path.find('.');
  const std::string key(path.substr(0, dot));
  JsonValue* member = object.find(key);
  if (!member) member = &object.members().emplace_back(JsonMember{key, 0, {JsonValue::Object{}, 0}}).value;
  if (dot == std::string_view::npos)
    *member = std::move(value);
  else
    put_at(*member, path.substr(dot + 1), std::move(value));
}

const Field* field_of(const Object& table, std::string_view key) {
  const auto found =
      std::find_if(table.fields.begin(), table.fields.end(), [&](const Field& field) { return field.key == key; });
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

std::string_view name_of(Basis basis) {
  constexpr std::string_view kNames[] = {"published", "estimated", "assumed", "recall"};
  return kNames[static_cast<std::size_t>(basis)];
}

std::span<const ShipPreset> ship_presets() {
  static const std::vector<ShipPreset> presets = make_presets();
  return presets;
}

const ShipPreset* find_ship_preset(std::string_view name) {
  const auto presets = ship_presets();
  const auto found =
      std::find_if(presets.begin(), presets.end(), [&](const ShipPreset& preset) { return preset.name == name; });
  return found == presets.end() ? nullptr : &*found;
}

JsonValue json_of(const ShipPreset& preset) {
  JsonValue ship{JsonValue::Object{}, 0};
  for (const Particular& particular : preset.particulars)
    put_at(ship, particular.path, parse_json(particular.json).root);
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
    // Of an unknown one the name is reported, and not all that it would have filled in.
    if (!preset) preset = find_ship_preset("reference");
    JsonValue particulars = json_of(*preset);
    if (has_no_engine(ship) && !ship.find("steering"))
      std::erase_if(particulars.members(), [](const JsonMember& member) { return member.key == "steering"; });
    merge(ship_description(), ship, particulars, offset);
  }
}

}  // namespace polynya::io
