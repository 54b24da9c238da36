// Problems of scenes: each is reported at its place, with the value that was found and the values that are allowed.
#include <functional>
#include <map>

#include "scene_text.hpp"
#include "temporary_folder.hpp"

namespace polynya::io {
namespace {

using namespace tests;

TEST(SceneProblems, TenMistakesGiveTenPlacedMessages) {
  const std::string text = R"(// ten mistakes
{
  "ice": {
    "thicknes_m": 0.5,
    "density_kg_per_m3": "900",
    "poisson_ratio": 0.5
  },
	"water": {"drift_m_per_s": [1]},  // a tab
  "fracture": {"bending": {"model": "nevle"}},
  "ships": [
    {"hull": {"length_m": 120, "entrance_angle_deg": 27}, "mass_kg": -1, "moment_of_inertia_kg_m2": 5e9,
     "propulsion": {"thrust_N": 2e4, "constant_speed_m_per_s": 1}}
  ],
  "floes": [
    {"polygon": {"outer_m": [[0, 0], [10, 10], [10, 0], [0, 10]]}},
    {"rectangle": {"corner_m": [50, 0], "size_m": 10}},
    {"rectangle": {"corner_m": [55, 0], "size_m": 10}}
  ]
})";
  const std::vector<std::string> expected{
      "4:5: ice.thicknes_m: found an unknown key",
      "5:26: ice.density_kg_per_m3: found \"900\"",
      "6:22: ice.poisson_ratio: found 0.5, allowed: a number ≥ 0, < 0.5",
      "8:29: water.drift_m_per_s: found a list of 1",
      "9:37: fracture.bending.model: found \"nevle\"",
      "11:14: ships[0].hull.beam_m: found nothing",
      "11:70: ships[0].mass_kg: found -1",
      "12:20: ships[0].propulsion: found thrust and constant speed together",
      "15:5: floes[0]: found an invalid polygon: self-crossing at (5, 5), (0, 0), (10, 10)",
      "17:5: floes[2]: found an overlap with floes[1], 50 m² shared"};
  const auto outcome = read(text);
  ASSERT_FALSE(outcome.has_value());
  const auto& problems = outcome.error();
  ASSERT_EQ(problems.size(), expected.size()) << in_words(problems);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_BEGINS(to_string(problems[i]), "scene.json:" + expected[i]);
    EXPECT_FALSE(problems[i].allowed.empty());
  }
  EXPECT_EQ(problems[0].suggestion, "thickness_m");
  EXPECT_EQ(problems[4].suggestion, "nevel");
}

TEST(SceneProblems, WhatNoFieldAloneCanTell) {
  const std::string shear = R"("water": {"shear": {"rate_per_s": 0.01}})";
  const std::string small_ship =
      ship(R"("hull": {"length_m": 40, "beam_m": 8}, "mass_kg": 1e3, "moment_of_inertia_kg_m2": 1e4,
        "position_m": null, "propulsion": {"thrust_N": 2e3})");
  expect_problems({
      {scene({shear, list("floes", {square(0, 0, 1), R"({"polygon": {"outer_m":
          [[-60, -20], [-10, -20], [-10, 20], [-60, 999999]]}})"})}),
       "floes[1]", "a rim that moves at"},
      {scene({R"("time": {"step_s": 0.005})", shear, list("floes", {square(0, 40000, 1)})}), "time.step_s",
       "0.005: floes[0] moves 2 m in one step at 400 m/s"},
      {scene({R"("water": {"shear": {"rate_per_s": 0.5}})", list("floes", {square(0, 9000, 9)})}), "floes[0]",
       "moves at 4504 m/s"},
      {scene({R"("time": {"step_s": 0.005})",
              list("floes", {square(0, 0, 200, R"("angular_velocity_deg_per_s": 100)")})}),
       "time.step_s", "0.005: floes[0] moves 1.23 m in one step at 247 m/s"},
      {scene({R"("time": {"step_s": 0.9, "until_s": 100})", list("ships", {small_ship})}), "time.step_s",
       "1.62 m in one step at 1.8 m/s"},
      {scene({list("ships", {ship(), ship()})}), "ships[1]", "an overlap with ships[0]"},
      {"{}", "", "neither ships nor floes"},
      {"[]", "", "a list of 0"},
      {"{\"floes\": 3}", "floes", "found 3"},
      {scene_of_ship(R"({"propulsion": {"thrust_N": 1}})"), "ships[0].hull",
       R"(length_m and beam_m and entrance_angle_deg, or waterline_m; or "ship": a preset's name, as "reference")"},
      {scene_of_ship(R"({"ship": "polarys"})"), "ships[0].ship", "polaris"},
      {scene_of_ship(ship(R"("propulsion": {"constant_speed_m_per_s": 1.5}, "speed_m_per_s": 1)")),
       "ships[0].speed_m_per_s", "found 1"},
      {scene({list("structures", {R"({"radius_m": 5})"}), list("floes", {square(0, 0, 9)})}), "floes[0]",
       "an overlap with structures[0]"},
      {scene({R"("fracture": {"bending": {"load_factor": 0.64}})"}), "fracture.bending.load_factor",
       "found 0.64, allowed: 1, or no such key: this calibration factor was removed"},
      {scene({R"("fracture": {"bending": {"cusp_radius_factor": "1"}})"}), "fracture.bending.cusp_radius_factor",
       "found \"1\", allowed: 1, or no such key: this calibration factor was removed"},
      {scene_of_ship(ship(R"("calibration": {"load_factor": 1, "cusp_radius_factor": 0.7})")), "ships[0].calibration",
       "calibration factors were removed"},
  });
}

TEST(SceneProblems, WhatARunCouldNotReadBackOrEnd) {
  const auto light = [](const std::string& members) {
    return scene_of_ship(R"({"hull": {"length_m": 0.1, "beam_m": 0.1, "entrance_angle_deg": 45, "draught_m": 0.01,
        "block_coefficient": 0.5}, "propulsion": {"constant_speed_m_per_s": 0})" +
                         members + "}");
  };
  const std::string sheared = R"("water": {"shear": {"rate_per_s": 0.005}})";
  const auto fast_for = [](const std::string& seconds) {  // 9.5 m apart, at 1 m/s
    return R"("time": {"until_s": )" + seconds + "}, " +
           list("floes", {square(0, 0, 9, R"("fast_ice": true)"),
                          square(18.5, 0, 9, R"("fast_ice": true, "velocity_m_per_s": [-1, 0])")});
  };
  expect_problems(
      {{light(""), "ships[0].mass_kg", "0.05, which follows from what is given, allowed: a number ≥ 1", 2},
       {light(R"(, "mass_kg": 1)"), "ships[0].moment_of_inertia_kg_m2", "which follows from what is given"},
       {scene({R"("time": {"until_s": 1e-320})", list("floes", {square(0, 0, 9)})}), "time.until_s",
        "0 or at least 1e-100 in size"},
       {scene({list("floes", {square(1e-300, 0, 9)})}), "floes[0].rectangle.corner_m", "0 or at least 1e-100 in size"},
       {scene({sheared, list("ships", {ship(R"("position_m": [0, 999999])")})}), "ships[0]",
        "a ship in a current of 5000 m/s"},
       {scene_of_ship(ship(R"("propulsion": {"thrust_N": 2e8})")), "ships[0].propulsion",
        "accelerates the ship by 20 m/s², allowed: at most 10 m/s²"},
       {scene({R"("time": {"until_s": 2000})", list("ships", {ship(R"("propulsion": {"thrust_N": -6e6})")})}),
        "ships[0].propulsion", "to 1.2e+03 m/s by 2000 s, since no water slows it"},
       {scene({R"("contact": {"normal": "circle-centres"})", list("floes", {square(0, 0, 9)})}), "contact.normal",
        "boundary, or circle-centres with contact.law impulse"},
       {scene({fast_for("10")}), "floes[1]", "can reach the fast ice of floes[0] before the end"}});
  load(scene({fast_for("9")}));
  load(light(R"(, "mass_kg": 1, "moment_of_inertia_kg_m2": 0.01)"));
  load(scene({sheared, list("ships", {ship(R"("position_m": [0, 9999])")})}));
  load(scene({R"("contact": {"normal": "circle-centres", "law": "impulse"})", list("floes", {square(0, 0, 9)})}));
}

/// A scene that is given something, and where that is.
struct KindOfScene {
  std::function<std::string(const std::string& members)> scene_with;
  std::string path;
};

/// Makes a scene with one floe entry or one ship. The given members are inserted between the two parts of its text.
KindOfScene floe_kind(const std::string& begin, const std::string& end, const std::string& path) {
  return {[=](const std::string& members) { return scene({list("floes", {begin + members + end})}); },
          "floes[0]" + path};
}
KindOfScene field_kind(const std::string& begin) {
  return floe_kind("{\"field\": {" + begin, "}}", ".field");
}
KindOfScene ship_kind(const std::string& begin, const std::string& end = "", const std::string& path = "") {
  return {[=](const std::string& members) { return scene_of_ship(sailing_ship(begin + members + end)); },
          "ships[0]" + path};
}

std::string route(const std::string& waypoints) {
  return scene({list("ships", {sailing_ship(R"("steering": {"rudder": {}}, "pilot": {"route": {"waypoints": [)" +
                                            waypoints + "]}}")}),
                R"("structures": [{"name": "tower", "radius_m": 20, "position_m": [600, 0]}])"});
}

/// Returns a scene with one or two ships that manage the ice about a tower, or about another body.
std::string fleet(const std::string& first, const std::string& second = "") {
  std::vector<std::string> ships;
  for (const std::string& pilot : {first, second}) {
    const bool has_body = pilot.find("\"body\"") != std::string::npos;
    if (!pilot.empty())
      ships.push_back(sailing_ship(fmt::format(
          R"("position_m": [1500, {}], "steering": {{"rudder": {{}}}}, "pilot": {{"manage": {{{} {},
            "distance_m": 1500, "safety_radius_m": 200}}}})",
          300 * ships.size(), has_body ? "" : R"("body": "tower",)", pilot)));
  }
  return scene({fmt::format("\"ships\": [{}]", fmt::join(ships, ", ")),
                R"("structures": [{"name": "tower", "radius_m": 30}])",
                R"("walls": [{"name": "quay", "from_m": [0, -3000], "to_m": [100, -3000]}])"});
}

/// Makes a scene in which the given members are beside one other member.
KindOfScene scene_kind(const std::string& begin, const std::string& end = "", const std::string& path = "") {
  return {[=](const std::string& members) { return "{" + begin + members + end + "}"; }, path};
}

std::map<std::string, KindOfScene> kinds_of_scenes() {
  const std::string box = R"("corner_m": [0, 0], "extent_m": 300, )", thrust = R"("propulsion": {"thrust_N": 1e5}, )";
  const std::string ice = R"({"rectangle": {"corner_m": [0, 0], "size_m": 10}, "ice": {)";
  const std::string deep = list("ships", {ship(R"("hull": {"draught_m": 6})")});
  return {{"field", field_kind("")},
          {"field of one size", field_kind(R"("corner_m": [0, 0], "extent_m": 100, "floe_size_m": 10, )")},
          {"field in a box", field_kind(box)},
          {"field of 80 %", field_kind(box + R"("sizes": {"size_m": 15}, "concentration": 0.8, )")},
          {"field of 98 %", field_kind(box + R"("sizes": {"size_m": 15}, "concentration": 0.98, )")},
          {"field of a power law",
           field_kind(box + R"("concentration": 0.9, "sizes": {"exponent": 1.87, "least_m": 10, )")},
          {"field in a channel",
           field_kind(R"("width_m": 12, "concentration": 0.8, "sizes": {"size_m": 15}, "centreline_m": [[0, 0], )")},
          {"channel of brash",
           floe_kind(R"({"channel": {"centreline_m": [[0, 0], [90, 0]], "thickness_m": 1, "width_m": 30, )", "}}",
                     ".channel")},
          {"entry of a channel",
           floe_kind(R"({"channel": {"centreline_m": [[0, 0], [90, 0]], "thickness_m": 1, "width_m": 30,
                         "sizes": {"size_m": 3}}, )",
                     "}", "")},
          {"entry of a frozen channel",
           floe_kind(R"({"channel": {"centreline_m": [[0, 0], [90, 0]], "thickness_m": 1, "width_m": 30,
                         "consolidated_thickness_m": 0.2}, )",
                     "}", "")},
          {"bent channel", floe_kind(R"({"channel": {"thickness_m": 1, "width_m": 30, "sizes": {"size_m": 3},
                                        "centreline_m": [[0, 0], )",
                                     "}}", ".channel")},
          {"ice", floe_kind(ice, "}}", ".ice")},
          {"ice too heavy", floe_kind(ice, "}}", "")},
          {"thickness", floe_kind(ice + R"("thickness_m": {)", "}}}", ".ice.thickness_m")},
          {"ship", ship_kind("")},
          {"ship without a form", ship_kind(R"("hull": {"draught_m": null, "block_coefficient": null}, )")},
          {"ship without a block coefficient", ship_kind(R"("hull": {"block_coefficient": null}, )")},
          {"ship under thrust", ship_kind(thrust)},
          {"ship moored under thrust",
           ship_kind(thrust + R"("mooring": {"sway_stiffness_N_per_m": 1e5, "position_m": [0, 30], )", "}")},
          {"engine", ship_kind(R"("propulsion": {"engine": {)", "}}")},
          {"engine of 12 m/s", ship_kind(R"("propulsion": {"engine": {"open_water_speed_m_per_s": 12, )", "}}")},
          {"pilot", ship_kind(R"("steering": {"rudder": {}}, "pilot": {)", "}", ".pilot")},
          {"route", {route, "ships[0].pilot.route.waypoints[0]"}},
          {"manager", {[](const std::string& pilot) { return fleet(pilot); }, "ships[0].pilot.manage"}},
          {"hull",
           {[](const std::string& hull) { return scene_of_ship(ship("\"hull\": {" + hull + "}")); }, "ships[0].hull"}},
          {"fracture", scene_kind(list("ships", {ship()}) + ", \"fracture\": {", "}", "fracture")},
          {"fracture under a hull", scene_kind(deep + ", \"fracture\": {", "}", "fracture")},
          {"fracture where cusps float",
           scene_kind(deep + R"(, "fracture": {"cusp_fate": "float", "going_under": {"enabled": false}, )", "}",
                      "fracture")},
          {"one floe", scene_kind(list("floes", {square(0, 0, 1)}) + ", ")},
          {"one ship", scene_kind(list("ships", {ship()}) + ", ")},
          {"floe", floe_kind("", "", "")},
          {"structures", scene_kind("\"structures\": [", "]", "structures")}};
}

TEST(SceneProblems, AreThoseOfTheTable) {
  const auto kinds = kinds_of_scenes();
  std::vector<WrongScene> rows;
  for (const std::vector<std::string>& row : table_of("io/wrong_scenes.txt")) {
    const KindOfScene& kind = kinds.at(row.at(0));
    rows.push_back({kind.scene_with(row.at(1)), kind.path + row.at(2), row.at(3)});
  }
  expect_problems(rows);
  load(route(R"({"position_m": [600, 80], "speed_m_per_s": 3}, {"position_m": [1000, 0], "speed_m_per_s": 3})"));
}

TEST(SceneProblems, OfWallsAndFastIce) {
  const auto walled = [](const std::string& more) { return scene({list("floes", {square(0, 0, 10)}), more}); };
  const auto wall = [&](const std::string& more, const std::string& law = "crush") {
    return walled(R"("contact": {"law": ")" + law + R"("}, "walls": [{"from_m": [-50, -1], "to_m": [50, -1], )" + more +
                  "}]");
  };
  const std::string load = R"("pressure": {"line_load_N_per_m": 5e4})";
  const std::string fast = R"("fast_ice": true)";
  expect_problems(
      {{wall(R"("velocity_m_per_s": [0, 1], )" + load), "walls[0].velocity_m_per_s", ""},
       {wall(load, "impulse"), "walls[0].pressure", ""},
       {wall(R"("pressure": {"line_load_N_per_m": 2e6})"), "walls[0].pressure.line_load_N_per_m", "1.4e+06"},
       {scene({R"("time": {"step_s": 0.1})", list("floes", {square(0, 0, 10)}),
               R"("walls": [{"from_m": [-50, -1], "to_m": [50, -1], "pressure": {"line_load_N_per_m": 1e5,
                 "mass_kg_per_m": 1e3}}])"}),
        "walls[0].pressure.mass_kg_per_m", "at least 3125"},
       {walled(R"("walls": [{"from_m": [50, 50], "to_m": [50, 50.01]}])"), "walls[0].to_m", ""},
       {walled(R"("walls": [{"from_m": [-50, 2], "to_m": [50, 2]}])"), "floes[0]",
        "found an overlap with walls[0], 20 m² shared, allowed: floes in front of the wall"},
       {scene({list("ships", {ship(R"("position_m": [0, 100])")}),
               R"("walls": [{"from_m": [-90, 95], "to_m": [90, 95]}])"}),
        "walls[0]", "found an overlap with ships[0]"},
       {scene({R"("contact": {"law": "crush"})",
               list("floes", {square(0, 0, 10, fast + R"(, "angular_velocity_deg_per_s": 3)")})}),
        "floes[0].angular_velocity_deg_per_s", "does not turn"},
       {scene({R"("contact": {"law": "impulse"})", list("floes", {square(0, 0, 10, fast)})}), "floes[0].fast_ice",
        ""}});
}

TEST(SceneProblems, OfIceUnderAHull) {
  const auto under = [](const std::string& name, const std::string& hull, double x = 100) {
    return scene({list("ships", {ship("\"name\": \"presser\"" + hull)}),
                  list("floes", {square(x, 0, 10, "\"under_hull_of\": \"" + name + "\"")})});
  };
  const std::string draught = R"(, "hull": {"draught_m": 6})";
  expect_problems({{under("pressed", draught), "floes[0].under_hull_of", "draught_m"},
                   {under("presser", ""), "floes[0].under_hull_of", "draught_m"}});
  EXPECT_TRUE(read(under("presser", draught, -60))) << "the hull is over it";
}

TEST(SceneProblems, OfShipsThatFollowInACircleAndOfAPresetWithoutAnEngine) {
  const auto led = [](const std::string& name, const std::string& leader, int y) {
    return sailing_ship(fmt::format(R"("name": "{}", "position_m": [0, {}], "steering": {{"rudder": {{}}}},
      "pilot": {{"follow": {{"distance_m": 100, "ship": "{}"}}}})",
                                    name, y, leader));
  };
  expect_problems(
      {{scene({list("ships", {led("a", "b", 0), led("b", "c", 200), led("c", "a", 400)})}),
        "ships[0].pilot.follow.ship", "which follows this ship", 3},
       {scene_of_ship(R"({"ship": "oden", "propulsion": {"constant_speed_m_per_s": 2}, "steering": {"azimuth": {}}})"),
        "ships[0].steering", "without an engine"}});
}

TEST(SceneProblems, OfShipsThatManageIceInEachOthersWay) {
  const std::string wide = R"("pattern": "circular", "width_m": 800)", phase = R"(, "phase": 0.5)";
  const std::string linear = R"("pattern": "linear", "width_m": )", race = R"("pattern": "racetrack", "width_m": 800)";
  const std::string at = "ships[0].pilot.manage.phase", message = "0 m from ship-2";
  expect_problems(
      {{fleet(linear + "800", linear + "800" + phase), at, message, 2}, {fleet(race, race), at, message, 2}});
  load(fleet(wide, wide + phase));
  load(fleet(linear + "800", linear + "500"));
}

TEST(SceneProblems, OfFlowsOverTime) {
  const auto rows = [](int second) {
    return fmt::format(R"([{{"t_s": 0, "speed_m_per_s": 0.3, "direction_deg": 0}},
      {{"t_s": {}, "speed_m_per_s": 0.3, "direction_deg": 90}}])",
                       second);
  };
  const auto with = [](const std::string& members) { return scene({list("ships", {ship("")}), members}); };
  expect_problems(
      {{with(R"("water": {"drift_table": )" + rows(0) + "}"), "water.drift_table[1].t_s",
        "after that of the row before"},
       {with(R"("wind": {"table": )" + rows(-1) + "}"), "wind.table[1].t_s", "after that of the row before"},
       {with(R"("water": {"drift_m_per_s": [0.1, 0], "drift_table": )" + rows(60) + "}"), "water.drift_m_per_s",
        "one of the two"}});
  load(with(R"("water": {"drift_table": )" + rows(60) + R"(}, "wind": {"table": )" + rows(60) + "}"));
}

/// Making a field of ice takes long. Problems that do not depend on the ice are therefore reported before, and problems
/// of the ice after it.
TEST(SceneProblems, WhatNeedsNoIceIsFoundBeforeAFieldIsMade) {
  const std::string ice = list("floes", {R"({"field": {"corner_m": [-100, -100], "extent_m": [200, 200],
      "concentration": 0.7, "floe_size_m": 20}})",
                                         square(0, 50, 30)});
  const std::string ships = list("ships", {ship()});
  EXPECT_HAS(in_words(read(scene({ice, ships})).error()), "an overlap with floes[0]");
  const std::string both = in_words(read(scene({ice, ships, R"("time": {"step_s": 1e-5, "until_s": 4e5})"})).error());
  EXPECT_HAS(both, "4e+10 steps");
  EXPECT_LACKS(both, "an overlap");
}

TEST(SceneProblems, OfFilesAreNamedWithThem) {
  const TemporaryFolder folder;
  write_file(folder / "f.geojson",
             "{\"type\": \"MultiPolygon\", \"coordinates\": [\n[[[0,0],[10,0],[10,10],[0,0]]],\n "
             "[[[0,0],[10,10],[10,0],[0,10],[0,0]]]]}");
  write_file(folder / "s.json", R"({"floes": [{"file": "f.geojson"}]})");
  EXPECT_BEGINS(to_string(read_scene_file(folder / "s.json").error().front()),
                (folder / "f.geojson").string() + ":3:2: ");
  EXPECT_BEGINS(to_string(read_scene_file("/no/such/scene.json").error().front()),
                "/no/such/scene.json: found no such file, ");
}

TEST(SceneProblems, ALongKeyIsShortenedBetweenTwoCharacters) {
  std::string key;
  for (int i = 0; i < 50'000; ++i) key += "é";
  const auto problems = read("{\"" + key + "\": 1}").error();
  EXPECT_LT(to_string(problems[0]).size(), 1000U);
  EXPECT_LT(to_json_text({problems[0]}).size(), 1000U);
  EXPECT_HAS(to_string(problems[0]), "éé…: found an unknown key");
}

/// The scene.json of a run is the resolved scene, so every accepted scene must be readable again after it was written.
TEST(SceneProblems, ASceneThatCouldNotBeReadBackIsRefused) {
  const TemporaryFolder folder;
  write_file(folder / "f.geojson", R"({"type": "Polygon", "coordinates": [[[0,0],[1000,0],[0,1000],[0,0]]]})");
  const std::string text = R"({"floes": [{"file": "f.geojson"}]})";
  const std::size_t length = load(text, folder.path(), "s.json").resolved_text.size();
  EXPECT_GT(length, text.size());
  const auto fits = checked(read_scene(text, "s.json", folder.path(), {}, length));
  EXPECT_TRUE(read_scene(fits->resolved_text, "scene.json", ".", {}, length).has_value());
  const auto refused = read_scene(text, "s.json", folder.path(), {}, length - 1);
  ASSERT_FALSE(refused.has_value());
  EXPECT_BEGINS(to_string(refused.error().front()), fmt::format("s.json:1:1: found {} bytes", length));
  EXPECT_GE(kLongestScene, 2 * kLongestFloesFile);
}

// ---- what a valid scene is hinted at: with its place, its severity and its numbers, and never refused

struct Change {
  const char* from;
  const char* to;
};
using Changes = std::vector<Change>;

// Returns the hints for a scene that has no fault. Each ship is on one line, so that a hint's line identifies its ship.
std::vector<Problem> hints_of(const Changes& changes) {
  std::string text =
      R"({"time": {"until_s": 100}, "ice": {"thickness_m": 0.5}, "water": {"drift_m_per_s": [0.1, 0]},
"ships": [
{"name": "first", "hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27}, "mass_kg": 1e7, )"
      R"("moment_of_inertia_kg_m2": 5e9, "position_m": [-100, 0], "heading_deg": 0, )"
      R"("propulsion": {"constant_speed_m_per_s": 2}},
{"name": "second", "hull": {"length_m": 60, "beam_m": 12, "entrance_angle_deg": 27}, "mass_kg": 1e6, )"
      R"("moment_of_inertia_kg_m2": 3e8, "position_m": [-100, 100], "heading_deg": 10, "speed_m_per_s": 1, )"
      R"("propulsion": {"thrust_N": 1e4}}],
"structures": [{"name": "pier", "radius_m": 5, "position_m": [50, -200]}],
"floes": [{"rectangle": {"corner_m": [80, -50], "size_m": [200, 200]}}]})";
  for (const auto& [from, to] : changes) text = replaced(text, from, to);
  return load(text).hints;
}

const Change kTurned{"\"heading_deg\": 0", "\"heading_deg\": 180"};

/// Returns "LINE: severity: path: " and further words of the only hint.
TEST(SceneHints, HaveAPlaceASeverityAndNumbers) {
  struct Row {
    Changes changes;
    const char* begin;
    std::vector<const char*> words;
  };
  const Change one_metre{"\"thickness_m\": 0.5", "\"thickness_m\": 1"}, thick{"0.5}", "9}"};
  const Change slow{"\"speed_m_per_s\": 1,", "\"speed_m_per_s\": 0,"},
      fast{"_speed_m_per_s\": 2", "_speed_m_per_s\": 18"};
  for (const auto& [changes, begin, words] :
       {Row{{{"1e4}", "1e4}, \"mooring\": {}"}},
            "4: warning: ships[1].mooring: ",
            {"holds nothing", "surge_stiffness_N_per_m"}},
        Row{{{"1e7", "1e4"}},
            "3: warning: ships[0].mass_kg: ",
            {"1e+04 kg", "120 × 24 m", "3.5e+06 to 4.1e+07 kg", "3 to 16 m", "0.4 to 0.9"}},
        Row{{{"1e6", "1e8"}}, "4: warning: ships[1].mass_kg: ", {"1e+08 kg"}},
        Row{{kTurned}, "3: warning: ships[0].heading_deg: ", {"away from all ice", "120 m behind"}},
        Row{{{"1e4}", "-1e4}"}, slow}, "4: warning: ships[1].heading_deg: ", {"away from all ice"}},
        Row{{{"[50, -200]", "[50, 2]"}},
            "3: warning: ships[0].propulsion: ",
            {"meets pier", "after 42.7", "without a force"}},
        Row{{{R"({"rectangle": {"corner_m": [80, -50], "size_m": [200, 200]}})", ""}}, "6: hint: floes: ", {"no ice"}},
        Row{{thick}, "1: hint: ice.thickness_m: ", {"9 m", "4 m"}},
        Row{{{"0.5}", "0.001}"}, {"100}", R"(100, "step_s": 1e-5})"}},
            "1: hint: ice.thickness_m: ",
            {"0.001 m", "0.01 m"}},
        Row{{{"100}", R"(100, "levels": 3})"}}, "1: hint: time.levels: ", {"no effect", "leave it out"}},
        Row{{{"100}", R"(100}, "fracture": {"bending": {"load_factor": 1}})"}},
            "1: hint: fracture.bending.load_factor: ",
            {"no effect", "leave it out"}},
        Row{{{"1e4}", R"(1e4}, "calibration": {"cusp_radius_factor": 1})"}},
            "4: hint: ships[1].calibration: ",
            {"no effect", "leave it out"}},
        Row{{{"100}", R"(100, "step_s": 0.06}, "contact": {"law": "impulse"})"}},
            "1: warning: time.step_s: ",
            {"at 2 m/s", "0.12 m in a step", "0.15 of the ice's thickness of 0.5 m", "give 0.0375 s or less"}},
        Row{{{"100}", R"(100, "step_s": 0.025}, "contact": {"law": "impulse"})"}, one_metre},
            "1: warning: time.step_s: ",
            {"0.05 m in a step", "0.0375 m² over the ice's thickness of 1 m", "give 0.0187 s or less"}},
        Row{{{"100}", R"(100, "step_s": 0.02}, "contact": {"law": "impulse", "circle_radius_m": 0.1})"}},
            "1: warning: time.step_s: ",
            {"0.04 m in a step", "0.25 of contact.circle_radius_m 0.1", "give 0.0125 s or less"}},
        Row{{{"100}", R"(100, "step_s": 0.06})"}, {"0.5}", "0.01}"}},
            "1: warning: time.step_s: ",
            {"at 2 m/s", "0.0037 m in a step", "0.15 of the ice's thickness of 0.01 m", "give 0.024 s or less"}},
        Row{{fast, {"100}", R"(100, "step_s": 0.002})"}},
            "3: hint: ships[0].propulsion: ",
            {"18 m/s (35 kn)", "12 m/s"}},
        Row{{{"1e4}", "2e5}"}}, "4: hint: ships[1].propulsion: ", {"21 m/s by 100 s"}},
        Row{{{"[0.1, 0]", "[0, 6]"}}, "1: hint: water.drift_m_per_s: ", {"6 m/s", "3 m/s"}},
        Row{{{"[0.1, 0]", "[0, 2.9]"}, {"100}", R"(100, "step_s": 0.03}, "contact": {"law": "impulse"})"}},
            "1: warning: time.step_s: ",
            {"at 2.9 m/s", "give 0.0259 s or less"}},
        Row{{{"100}", R"(100}, "record": {"forces_interval_s": 0.286})"}},
            "1: hint: record.forces_interval_s: ",
            {"0.286 s is no whole number of ticks of 0.1 s", "the tick is therefore 0.002 s", "50 times as many",
             "give 0.3 s, or time.step_s"}},
        Row{{{"100}", R"(100}, "record": {"frames_interval_s": 0.007})"}},
            "1: hint: record.frames_interval_s: ",
            {"the tick is therefore 0.001 s", "give 0.1 s"}},
        Row{{{"1e4}", R"(1e4}, "mooring": {"sway_stiffness_N_per_m": 1e7})"}},
            "4: warning: ships[1].mooring: ",
            {"in sway with a period of 1.99 s", "20 ticks of 0.1 s", "1.008 times as long",
             "give time.step_s 0.05 s"}}}) {
    const std::vector<Problem> hints = hints_of(changes);
    ASSERT_EQ(hints.size(), 1U) << begin;
    std::string text = to_string(hints[0]);
    EXPECT_GT(hints[0].column, 0);
    text = replaced(text, fmt::format(":{}: ", hints[0].column), ": ");
    EXPECT_BEGINS(text, std::string("scene.json:") + begin);
    for (const char* part : words) EXPECT_HAS(text, part);
  }
}

/// No hint is given if it could be wrong: the ice drifts after the ship, or moves by itself, or the structure is beside
/// the course or after its end.
TEST(SceneHints, AreSilentWhereTheSceneMayMeanIt) {
  for (const Changes& changes :
       {Changes{}, Changes{{"[0.1, 0]", "[-2.5, 0]"}, kTurned},
        Changes{{"200]}}]", "200]}, \"velocity_m_per_s\": [-1, 0]}]"}, kTurned}, Changes{{"[50, -200]", "[50, -18]"}},
        Changes{{"[50, -200]", "[200, 0]"}, {"[80, -50]", "[300, -50]"}},
        Changes{{"100}", R"(100}, "record": {"forces_interval_s": 0.25})"}},
        Changes{{"100}", R"(100, "step_s": 0.1}, "record": {"forces_interval_s": 0.286})"}},
        Changes{{"1e4}", R"(1e4}, "mooring": {"sway_stiffness_N_per_m": 1e5})"}}})
    EXPECT_EQ(in_words(hints_of(changes)), "");
}

}  // namespace
}  // namespace polynya::io
