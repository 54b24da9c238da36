#include <functional>
#include <set>

#include "scene_text.hpp"
#include "temporary_folder.hpp"

#include "io/scene/scene_input.hpp"

namespace polynya::io {
namespace {

using namespace tests;

// Together these texts choose every alternative of the field table.
const std::string kFirst = scene(
    {list("ships", {ship(R"("position_m": [-500, 0], "sway_speed_m_per_s": 0.1, "yaw_rate_deg_per_s": 0.2)")}),
     list("floes", {R"({"lattice": {"columns": 2, "rows": 3, "pitch_m": 20, "size_m": 10}, "crushed_overlaps": true,
       "source_floe_id": 7})",
                    square(100, 0, 10,
                           R"("ice": {"thickness_m": 0.7, "density_kg_per_m3": 890, "flexural_strength_Pa": 6e5,
       "compressive_strength_Pa": 2e6, "tensile_strength_Pa": {"mean": 7e5, "spread": 0.2},
       "fracture_toughness_Pa_sqrt_m": 1.2e5, "seed": 4})")})});
const std::string kSecond = scene(
    {R"("origin": {"latitude_deg": 78.2, "longitude_deg": 15.6, "heading_deg": 30})",
     list("ships", {ship(R"("hull": {"length_m": null, "beam_m": null, "entrance_angle_deg": null, "draught_m": 3,
       "waterline_m": [[10, 0], [0, 4], [-10, 4], [-10, -4], [0, -4]], "angles_from_vertical_deg": [60, 38, 0, 0, 38]},
       "name": "presser", "mass_kg": 1e6, "position_m": [-500, 0], "propulsion": {"constant_speed_m_per_s": 1.5})")}),
     R"("structures": [{"panels": {"length_m": 3}, "radius_m": 3, "position_m": [-300, 500], "wall_angle_deg": 10}])",
     list("floes",
          {R"({"polygon": {"outer_m": [[0, 0], [30, 0], [30, 30], [0, 30]],
       "holes_m": [[[10, 10], [10, 20], [20, 20]]]}})",
           square(-502, -2, 3, R"("under_hull_of": "presser", "under_hull_path_m": 4)"),
           R"({"field": {"corner_m": [-700, 400], "extent_m": [200, 150], "floe_size_m": 9, "concentration": 0.83,
       "gap_m": 0.3, "most_corners": 6, "keep_clear_m": [[[-650, 420], [-600, 420], [-650, 440]]], "seed": 3}})"})});
const std::string kThird =
    scene({R"("structures": [{"waterline_m": [[10, 0], [0, 4], [-10, 0], [0, -4]], "position_m": [500, 500], )"
           R"("heading_deg": 10}],
       "wind": {"velocity_m_per_s": [10, 2]},
       "walls": [{"from_m": [-100, -200], "to_m": [300, -200], "velocity_m_per_s": [0, 0.1]},
                 {"from_m": [300, 300], "to_m": [-100, 300], "pressure": {"line_load_N_per_m": 5e4}}])",
           list("floes", {R"({"field": {"outline_m": [[-10, 0], [200, 0], [120, 90], [5, 150]], "floe_size_m": 9,
       "concentration": 0.83, "gap_m": 0.3, "most_corners": 5}})"})});
const std::string kFourth = scene({list(
    "ships",
    {sailing_ship(
         R"("propulsion": {"engine": {"power_MW": 15, "propeller_diameter_m": 4, "propellers": 2, "nozzles": true,
       "open_water_speed_m_per_s": 8}}, "steering": {"rudder": {"area_m2": 12, "count": 1}},
       "pilot": {"constant": {}})"),
     ship(
         R"("hull": {"draught_m": 6}, "mass_kg": 7e6, "position_m": [0, 500], "steering": {"azimuth": {"max_deg": 90}},
       "propulsion": {"engine": {"bollard_pull_kN": 900, "open_water_speed_m_per_s": 7}},
       "pilot": {"route": {"waypoints": [{"position_m": [500, 500], "speed_m_per_s": 3},
                                         {"position_m": [900, 400], "speed_m_per_s": 2}]}},
       "mooring": {"surge_stiffness_N_per_m": 1e5, "break_load_N": 1e6, "position_m": [0, 501], )"
         R"("heading_deg": 1})")})});

/// The fields of a law of sizes.
std::string field_of_law(const std::string& region, const std::string& law) {
  return "{\"field\": {" + region + R"(, "most_corners": 6, "least_corners": 5, "sizes": )" + law + "}}";
}
const std::string kFifth = scene(
    {R"("water": {"drift_table": [{"t_s": 0, "speed_m_per_s": 0.3, "direction_deg": 20},
                                  {"t_s": 60, "speed_m_per_s": 0.4, "direction_deg": 30}],
                  "tide": {"period_s": 3600, "major_m_per_s": 0.2, "minor_m_per_s": 0.1, )"
     R"("direction_deg": 5, "phase_deg": 7}},
       "wind": {"table": [{"t_s": 0, "speed_m_per_s": 9, "direction_deg": 20}]})",
     list("floes", {field_of_law(R"("corner_m": [0, 0], "extent_m": [200, 150], "concentration": 0.6, "gap_m": 0.3,
                "aspect": 1.5, "orientation_deg": 20, "packing": 0.8)",
                                 R"({"mean_m": 12, "spread": 0.3})"),
                    field_of_law(R"("corner_m": [300, 0], "extent_m": [300, 300], "concentration": 0.7)",
                                 R"({"exponent": 1.5, "least_m": 10, "largest_m": 60})"),
                    field_of_law(R"("centreline_m": [[-300, 0], [-200, 30]], "width_m": 40, "concentration": 0.7)",
                                 R"({"size_m": 5})")})});

/// A floe with the law of the paper, which is the only law that allows normals from circles.
const std::string kSixth =
    scene({R"("contact": {"law": "impulse", "restitution": 0.1})", list("floes", {square(100, 0, 10)})});

/// Channels of loose brash.
const std::string kSeventh = scene(
    {list("floes", {R"({"channel": {"centreline_m": [[0, 0], [60, 5], [120, 0]], "width_m": 30, "thickness_m": 0.8,
      "side_thickness_m": 1.2, "porosity": 0.25, "cover": 0.7, "sizes": {"mean_m": 3, "spread": 0.3}, "gap_m": 0.03,
      "fast_ice_thickness_m": 0.6, "fast_ice_width_m": 20, "seed": 3,
      "keep_clear_m": [[[20, 0], [30, 0], [30, 10]]]}})",
                    R"({"channel": {"centreline_m": [[0, 120], [60, 120]], "width_m": 30, "thickness_m": 0.8,
      "sizes": {"size_m": 3}}})",
                    R"({"channel": {"centreline_m": [[0, 240], [60, 240]], "width_m": 30, "thickness_m": 0.8,
      "sizes": {"exponent": 1, "least_m": 2, "largest_m": 5}}})"})});

/// A scene with a frozen channel.
const std::string kEighth =
    scene({list("floes", {R"({"channel": {"centreline_m": [[0, 0], [120, 0]], "width_m": 30, "thickness_m": 0.8,
      "consolidated_thickness_m": 0.2}})"})});

/// Returns ships that together have all other pilots.
std::string fleet() {
  std::vector<std::string> ships;
  for (const char* pilot :
       {R"("hold_speed": {"speed_m_per_s": 3, "heading_deg": 10})", R"("hold_heading": {"heading_deg": 20})",
        R"("table": {"rows": [{"t_s": 0, "lever": 0.5}, {"t_s": 60, "lever": 1, "steering_deg": 5}]})",
        R"("ram": {"heading_deg": 3, "back_m": 150})", R"("follow": {"ship": "ship-1", "distance_m": 100})",
        R"("manage": {"body": "ship-1", "pattern": "racetrack", "distance_m": 5000, "width_m": 700, "depth_m": 300,
                      "speed_m_per_s": 3, "safety_radius_m": 300})",
        R"("manage": {"body": "ship-2", "pattern": "linear", "distance_m": 9000, "width_m": 700, "lever": 0.7})"})
    ships.push_back(sailing_ship(fmt::format(
        R"("steering": {{"rudder": {{}}}}, "position_m": [0, {}], "pilot": {{{}}}, "panels": {{"length_m": 2}})",
        500 * ships.size(), pilot)));
  return fmt::format("{{\"ships\": [{}]}}", fmt::join(ships, ", "));
}

/// Another allowed value near the one at hand.
void change_number(const Field& field, JsonValue& value) {
  const double now = value.number();
  const double step = field.kind == FieldKind::kInteger ? 1 : now == 0 ? 0.015625 : std::abs(now) / 64;
  value.data = now + step < field.range.high ? now + step : now - step;
}

/// The first number in a value, of a law its mean; of a vector the second.
JsonValue& number_in(const Field& field, JsonValue& value) {
  if (JsonValue* mean = value.find("mean")) return *mean;
  if (!value.is(JsonValue::Kind::kArray)) return value;
  const bool is_vector = field.kind == FieldKind::kVector || field.kind == FieldKind::kNumberOrVector;
  return number_in(field, value.items()[is_vector ? 1 : 0]);
}

void change(const Field& field, JsonValue& value) {
  if (field.kind == FieldKind::kText || field.kind == FieldKind::kName)
    value.data = std::string("changed");
  else if (field.kind == FieldKind::kBoolean)
    value.data = !value.boolean();
  else if (field.kind == FieldKind::kChoice)
    value.data = std::string(field.choices[value.text() == field.choices[0] ? 1 : 0]);
  else
    change_number(field, number_in(field, value));
}

/// Visits every leaf of a resolved scene with its field and path.
using Visit = std::function<void(const Field&, JsonValue&, const std::string&)>;
void walk(const Object& table, JsonValue& value, const std::string& path, const Visit& visit) {
  for (const Field& field : table.fields) {
    JsonValue* member = value.find(field.key);
    if (!member) continue;
    const std::string at = path + "." + std::string(field.key);
    if (field.kind == FieldKind::kObject) {
      walk(*field.object, *member, at, visit);
    } else if (field.kind == FieldKind::kList) {
      for (JsonValue& item : member->items()) walk(*field.object, item, at, visit);
    } else {
      visit(field, *member, at);
    }
  }
}

std::set<std::string> all_leaves(const Object& table, const std::string& path) {
  std::set<std::string> leaves;
  for (const Field& field : table.fields) {
    const std::string at = path + "." + std::string(field.key);
    if (field.kind == FieldKind::kObject || field.kind == FieldKind::kList)
      leaves.merge(all_leaves(*field.object, at));
    else
      leaves.insert(at);
  }
  return leaves;
}

TEST(SceneFields, TheResolvedSceneReadsBackToTheSameSceneAndText) {
  for (const std::string& text :
       {kFirst, kSecond, kThird, kFourth, kFifth, kSixth, kSeventh, kEighth, fleet(), commented_scene()})
    expect_reads_back(load(text));
}

/// Returns whether another part of that scene prevents a field from changing alone.
bool is_bound(const std::string& path, const LoadedScene& base, const std::string& text, const JsonValue& tree) {
  const std::set<std::string_view> of_ice_under_hulls{".fracture.cusp_fate", ".fracture.going_under.enabled",
                                                      ".fracture.resurface.enabled"};
  if (of_ice_under_hulls.contains(path)) return !has_draught(base.scene);
  const bool is_of_entry = path.starts_with(".floes.") && !path.starts_with(".floes.channel.");
  if (text == kEighth && (is_of_entry || path == ".floes.channel.gap_m" || path == ".floes.channel.seed"))
    return true;                                                                     // it has no pieces
  if ((text == kSeventh || text == kEighth) && path == ".contact.law") return true;  // they have fast ice
  if (text == kSeventh && path == ".floes.fast_ice") return true;                    // its pieces are free
  if (path == ".ships.speed_m_per_s")  // said twice in a resolved scene, and changed in both places
    return tree.find("ships")->items()[0].find("propulsion")->find("constant_speed_m_per_s") != nullptr;
  if (path == ".water.drift_m_per_s" || path == ".wind.velocity_m_per_s") return text == kFifth;  // it has tables
  if (path == ".floes.fast_ice") return base.scene.contact.law == simulation::ContactLaw::kImpulse;
  if (path == ".contact.normal") return base.scene.contact.law == simulation::ContactLaw::kCrush;
  if (path == ".contact.law") return text == kThird;                       // its wall presses
  if (path == ".ships.name") return text == fleet() || text == kSecond;    // named elsewhere too
  return path == ".ships.water.model" && !base.scene.ships[0].water.acts;  // it needs a draught
}

/// Every field of the table reaches the scene. Changing it alone changes the scene, and the change survives in the
/// resolved text.
TEST(SceneFields, EveryFieldRoundTripsAndReachesTheScene) {
  std::set<std::string> seen;
  for (const std::string& base_text : {kFirst, kSecond, kThird, kFourth, kFifth, kSixth, kSeventh, kEighth, fleet()}) {
    const LoadedScene base = load(base_text);
    JsonValue tree = parse_json(base.resolved_text).root;
    walk(kSceneDescription, tree, "", [&](const Field& field, JsonValue& value, const std::string& path) {
      if (value.is(JsonValue::Kind::kArray) && value.items().empty()) return;
      const std::set<std::string_view> of_names{".ships.pilot.follow.ship", ".ships.pilot.manage.body",
                                                ".floes.under_hull_of"};
      if (of_names.contains(path)) seen.insert(path);  // it must be a ship's name
      if (of_names.contains(path) || is_bound(path, base, base_text, tree)) return;
      seen.insert(path);
      SCOPED_TRACE(path);
      const auto before = value.data;
      change(field, value);
      if (path == ".ships.propulsion.constant_speed_m_per_s")
        tree.find("ships")->items()[0].find("speed_m_per_s")->data = value.data;
      const LoadedScene changed = load(to_json_text(tree));
      EXPECT_FALSE(changed.scene == base.scene && changed.description == base.description) << path;
      EXPECT_NE(changed.hash, base.hash) << path;
      expect_reads_back(changed);
      value.data = before;
      if (path == ".ships.propulsion.constant_speed_m_per_s")
        tree.find("ships")->items()[0].find("speed_m_per_s")->data = before;
    });
  }
  std::set<std::string> expected = all_leaves(kSceneDescription, "");
  expected.erase(".floes.file");  // becomes polygons in the resolved scene
  std::erase_if(expected, [](const std::string& path) { return path.starts_with(".floes.import."); });
  expected.erase(".ships.ship");  // becomes the preset's particulars
  EXPECT_EQ(seen, expected);
}

TEST(SceneFields, DefaultsAreTheSimulations) {
  simulation::Scene settings = load(kFirst).scene;
  settings.ships.clear();
  settings.floes.clear();
  settings.own_ice.clear();
  settings.name.clear();
  settings.time.step = simulation::StepSettings{}.step;  // chosen for this scene
  EXPECT_TRUE(settings == simulation::Scene{});
}

/// Values that are stored in radians and newtons are written as they were given, because resolved scenes and their
/// hashes depend on it.
TEST(SceneFields, NumbersInTheUnitsOfTheirKeysAreWrittenAsTheyWereGiven) {
  for (const std::string_view unit : {"°", "°/s", "kN", "MW", "m"})
    for (int i = -2000; i <= 2000; ++i) {
      EXPECT_EQ(from_si(unit, to_si(unit, i / 1000.0)), i / 1000.0) << unit;
      EXPECT_EQ(from_si(unit, to_si(unit, i)), i) << unit;
      EXPECT_EQ(to_si(unit, from_si(unit, to_si(unit, i / 7.0))), to_si(unit, i / 7.0)) << unit;
    }
}

TEST(SceneFields, EveryRangeIsKept) {
  const LoadedScene base = load(kFirst);
  JsonValue tree = parse_json(base.resolved_text).root;
  int tried = 0;
  walk(kSceneDescription, tree, "", [&](const Field& field, JsonValue& value, const std::string& path) {
    const auto before = value.data;
    std::vector<decltype(value.data)> wrong{nullptr, JsonValue::Object{}};
    wrong.emplace_back(field.kind == FieldKind::kBoolean ? decltype(value.data){1.0} : decltype(value.data){true});
    if (field.kind == FieldKind::kNumber || field.kind == FieldKind::kInteger) {
      wrong.insert(wrong.end(), {field.range.high * 1.001 + 1e-3, field.range.low - 1e-3, std::string("1")});
      if (field.range.is_low_excluded) wrong.emplace_back(field.range.low);
      if (field.range.is_high_excluded) wrong.emplace_back(field.range.high);
      if (field.kind == FieldKind::kInteger) wrong.emplace_back(1.5);
    }
    for (const auto& bad : wrong) {
      value.data = bad;
      const std::string text = to_json_text(tree);
      const auto outcome = read_scene(text, "base.json", ".");
      ASSERT_FALSE(outcome.has_value()) << path;
      const Problem& problem = outcome.error().front();
      EXPECT_HAS(path, std::string(field.key));
      EXPECT_HAS(problem.path, field.key) << to_string(problem);
      EXPECT_GT(problem.line, 1);
      ++tried;
    }
    value.data = before;
  });
  EXPECT_GT(tried, 200);
}

TEST(SceneSchema, NamesEveryFieldOnceWhereItBelongs) {
  const JsonDocument document = parse_json(scene_schema());
  ASSERT_TRUE(document.faults.empty());
  const std::function<void(const Object&, const JsonValue&)> check = [&](const Object& table, const JsonValue& schema) {
    const JsonValue* properties = schema.find("properties");
    ASSERT_NE(properties, nullptr);
    EXPECT_FALSE(schema.find("additionalProperties")->boolean());
    for (const Field& field : table.fields) {
      const JsonValue* property = properties->find(field.key);
      ASSERT_NE(property, nullptr) << field.key;
      if (field.kind == FieldKind::kObject) check(*field.object, *property);
      if (field.kind == FieldKind::kList) check(*field.object, *property->find("items"));
      if (field.kind == FieldKind::kNumber) {
        EXPECT_TRUE(property->find(field.range.is_low_excluded ? "exclusiveMinimum" : "minimum")) << field.key;
      }
    }
  };
  check(kSceneDescription, document.root);
}

TEST(SceneDocs, HoldTheTablesAsThePrintedOnes) {
  const std::string page = tests::read_file(std::string(POLYNYA_SOURCE_DIR) + "/docs/scene.md");
  EXPECT_HAS(page, scene_tables()) << "run: polynya schema --markdown, and put it into docs/scene.md";
}

}  // namespace
}  // namespace polynya::io
