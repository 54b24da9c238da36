// Reading scenes: floes, files, fields, walls of ice, and values that replace values of the scene.
#include <cmath>
#include <filesystem>

#include "scene_text.hpp"
#include "temporary_folder.hpp"

#include "geometry/exact/measures.hpp"
#include "io/scene/ship_presets.hpp"

namespace polynya::io {
namespace {

using namespace tests;
using simulation::CuspFate;

TEST(Scene, RingsMayRunEitherWayAndBeClosed) {
  const auto area = [](const std::string& outer, const std::string& holes) {
    const auto loaded =
        load(scene({list("floes", {R"({"polygon": {"outer_m": )" + outer + R"(, "holes_m": )" + holes + "}}"})}));
    return geometry::measure(loaded.scene.floes.at(0).polygon_in_world).area;
  };
  EXPECT_EQ(area("[[0,0],[10,0],[10,10],[0,10]]", "[[[2,2],[2,4],[4,4],[4,2]]]"), 96);
  EXPECT_EQ(area("[[0,10],[10,10],[10,0],[0,0],[0,10]]", "[[[2,2],[4,2],[4,4],[2,4],[2,2]]]"), 96);
}

TEST(Scene, FloesFromGeojsonStayInTheScenesFolder) {
  const TemporaryFolder folder;
  write_file(folder / "scenes/floes/a.geojson",
             R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", )"
             R"("coordinates": [[[0,0],[10,0],[10,10],[0,10],[0,0]]]}},
    {"type": "Feature", "geometry": {"type": "MultiPolygon", )"
             R"("coordinates": [[[[20,0],[20,5],[25,5],[25,0],[20,0]]],[[[30,0],[35,0,7],[35,5],[30,0]]]]}}]})");
  write_file(folder / "outside.geojson",
             R"({"type": "Polygon", "coordinates": [[[0,0],[10,0],[10,10],[0,10],[0,0]]]})");
  std::filesystem::create_symlink(folder / "outside.geojson", folder / "scenes/link.geojson");
  const auto read_floes = [&](const std::string& file) {
    write_file(folder / "scenes/s.json", R"({"floes": [{"file": ")" + file + R"(", "velocity_m_per_s": [0.1, 0]}]})");
    return read_scene_file(folder / "scenes/s.json");
  };
  const auto loaded = checked(read_floes("floes/a.geojson"));
  ASSERT_EQ(loaded->scene.floes.size(), 3U);
  EXPECT_EQ(loaded->scene.floes[1].velocity.x, 0.1);
  EXPECT_EQ(geometry::measure(loaded->scene.floes[1].polygon_in_world).area, 25);
  expect_reads_back(*loaded);  // the resolved scene needs no other file
  for (const char* file : {"../outside.geojson", "link.geojson", "/etc/passwd", "floes", "missing.geojson", "",
                           "../scenes/../outside.geojson"}) {
    const std::vector<Problem> problems = refused(read_floes(file));
    EXPECT_EQ(problems.front().path, "floes[0].file") << in_words(problems);
  }
}

TEST(Scene, OverridesTakeTheScenesPlace) {
  const auto loaded = checked(read_scene(scene({R"("time": {"until_s": 5})", list("floes", {square(0, 0, 1)})}),
                                         "a b é.json", ".", {.until = 7.5, .seed = 12, .assignments = {}}));
  EXPECT_EQ(loaded->scene.time.until, 7.5);
  EXPECT_EQ(loaded->scene.seed, 12U);
  EXPECT_HAS(loaded->resolved_text, "\"until_s\": 7.5");
  EXPECT_EQ(loaded->scene.name, "a-b---");
}

TEST(Scene, FastIceHoldsItsVelocityOverGround) {
  const std::string moving = R"("velocity_m_per_s": [0.1, -0.2])";
  const auto loaded =
      load(scene({R"("contact": {"law": "crush"})",
                  list("floes", {square(0, 0, 10, moving + R"(, "fast_ice": true)"), square(20, 0, 10, moving)})}));
  ASSERT_EQ(loaded.scene.floes.size(), 2u);
  EXPECT_TRUE(loaded.scene.floes[0].is_fast);
  EXPECT_EQ(loaded.scene.floes[0].velocity, (geometry::Vector{0.1, -0.2}));
  EXPECT_FALSE(loaded.scene.floes[1].is_fast);
}

TEST(Scene, WindHasSkinDragOfItsOwnUnlessGiven) {
  const std::string blowing = R"({"velocity_m_per_s": [0, 10]})";
  for (const auto& [wind, drag] : {std::pair<std::string, double>(R"({"drag_coefficient": 0.003})", 0),
                                   {blowing, 0.004},
                                   {blowing + R"(, "water": {"skin_drag_coefficient": 0.005})", 0.005},
                                   {blowing + R"(, "water": {"skin_drag_coefficient": 0})", 0}}) {
    const LoadedScene loaded = load(scene({list("floes", {square(0, 0, 10)}), "\"wind\": " + wind}));
    EXPECT_EQ(loaded.scene.water.skin_drag_coefficient, drag) << wind;
    expect_reads_back(loaded);
  }
}

TEST(ShippedScenes, AreValidAndHaveNoHints) {
  for (const auto& entry : std::filesystem::directory_iterator(std::string(POLYNYA_SOURCE_DIR) + "/scenes")) {
    if (entry.path().extension() != ".json") continue;
    const auto loaded = checked(read_scene_file(entry.path()));
    EXPECT_EQ(loaded->scene.name, entry.path().stem());
    EXPECT_EQ(in_words(loaded->hints), "");
  }
}

/// The paper's counts and concentrations (docs/paper-comparison.md).
TEST(PaperScenes, HoldThePapersIce) {
  struct Case {
    const char* name;
    std::size_t small;
    double size, concentration, tolerance;
  };
  for (const Case& c :
       {Case{"fig4a", 110, 15, 0.53, 0.005}, Case{"fig6a", 225, 10, 0.55, 0.005}, Case{"fig6b", 64, 20, 0.55, 0.005}}) {
    const auto loaded =
        checked(read_scene_file(std::string(POLYNYA_SOURCE_DIR) + "/scenes/sawamura2017-" + c.name + ".json"));
    const auto& floes = loaded->scene.floes;
    ASSERT_EQ(floes.size(), c.small + 21 + 2);
    geometry::Box box = geometry::bounding_box(floes.front().polygon_in_world.outer);
    double area = 0;
    for (std::size_t i = 0; i < c.small; ++i) {
      EXPECT_NEAR(geometry::measure(floes[i].polygon_in_world).area, c.size * c.size, 1e-9);
      const auto other = geometry::bounding_box(floes[i].polygon_in_world.outer);
      box.high = {std::max(box.high.x, other.high.x), std::max(box.high.y, other.high.y)};
    }
    const double margin = 2 * box.low.x;  // half a gap stands around the lattice
    const double lattice_area = (box.high.x - box.low.x + margin) * (box.high.y - box.low.y + margin);
    EXPECT_NEAR(static_cast<double>(c.small) * c.size * c.size / lattice_area, c.concentration, c.tolerance);
    for (const auto& floe : floes) {
      area += geometry::measure(floe.polygon_in_world).area;
      const auto outline = geometry::bounding_box(floe.polygon_in_world.outer);
      EXPECT_GE(outline.low.x, 0);
      EXPECT_GE(outline.low.y, 0);
      EXPECT_LE(outline.high.x, 560);  // the lattice of 20 m floes is 10 m longer than the others
      EXPECT_LE(outline.high.y, 300);
    }
    EXPECT_NEAR(area / (550.0 * 300.0), 0.62, 0.014);
  }
}

LoadedScene with_field(const std::string& members, const std::string& more = "\"seed\": 1") {
  return load(scene({more, list("floes", {"{\"field\": {" + members + "}}"})}));
}
const std::string kBox = R"("corner_m": [0, 0], "extent_m": 300, )";

/// No floe is in the ship or the structure, and no two lie over one another.
TEST(Field, ReportsHowItCameOut) {
  const auto loaded = load(
      scene({list("ships", {ship(R"("position_m": [100, 100])")}), list("structures", {R"({"radius_m": 20, "position_m":
        [300, 100]})"}),
             list("floes", {square(-50, 0, 10), R"({"field": {"corner_m": [0, 0], "extent_m": [400, 200],
        "floe_size_m": 10, "concentration": 0.8}})"})}));
  ASSERT_EQ(loaded.fields.size(), 1u);
  EXPECT_EQ(loaded.fields[0].group, 1u);
  const auto& outcome = loaded.fields[0].outcome;
  EXPECT_EQ(static_cast<std::size_t>(outcome.count) + 1, loaded.scene.floes.size());
  EXPECT_GT(outcome.left_out, 30);
  EXPECT_DOUBLE_EQ(outcome.region_area, 8e4);
  double area = 0;
  for (std::size_t i = 1; i < loaded.scene.floes.size(); ++i)
    area += geometry::measure(loaded.scene.floes[i].polygon_in_world).area;
  EXPECT_NEAR(area, outcome.floe_area, 1e-6);
}

TEST(Field, FollowsTheScenesSeedAndItsOwn) {
  const auto first_corner = [](int scene_seed, int field_seed) {
    const std::string field = fmt::format(R"("floe_size_m": 10, "concentration": 0.5, "seed": {})", field_seed);
    const LoadedScene loaded = with_field(kBox + field, fmt::format("\"seed\": {}", scene_seed));
    return loaded.scene.floes.front().polygon_in_world.outer.front();
  };
  EXPECT_EQ(first_corner(1, 0), first_corner(1, 0));
  EXPECT_NE(first_corner(1, 0), first_corner(2, 0));
  EXPECT_NE(first_corner(1, 0), first_corner(1, 1));
}

TEST(Field, HasTheLawAndItsStatistics) {
  const auto loaded =
      with_field(kBox + R"("concentration": 0.9, "sizes": {"exponent": 1.87, "least_m": 10, "largest_m": 60})");
  ASSERT_EQ(loaded.fields.size(), 1u);
  const auto& outcome = loaded.fields[0].outcome;
  EXPECT_EQ(outcome.count, static_cast<int>(loaded.scene.floes.size()));
  EXPECT_NEAR(outcome.concentration(), 0.9, 1e-6);
  ASSERT_TRUE(outcome.statistics.has_value());
  EXPECT_LT(outcome.statistics->distance_to_law, 0.03);
  expect_reads_back(loaded);
  const std::string one_size = with_field(kBox + R"("concentration": 0.5, "floe_size_m": 15)").resolved_text;
  EXPECT_HAS(one_size, "\"size_spread\": 0.25", "\"most_corners\": 8");
  EXPECT_LACKS(one_size, "packing");
}

TEST(Field, AChannelIsFilledAlongItsBends) {
  const auto loaded = with_field(R"("centreline_m": [[0, 0], [60, 0], [100, 40]], "width_m": 12, "concentration": 0.8,
      "gap_m": 0.01, "sizes": {"exponent": 0, "least_m": 0.5, "largest_m": 2})");
  const auto& outcome = loaded.fields.at(0).outcome;
  EXPECT_NEAR(outcome.region_area, 12 * (60 + 40 * std::sqrt(2.0)), 1e-6)
      << "mitres add on one side what they take on the other";
  EXPECT_NEAR(outcome.concentration(), 0.8, 1e-6);
  EXPECT_GT(outcome.count, 700);
  EXPECT_LT(outcome.statistics->distance_to_law, 0.01);
}

TEST(Words, ANumberAgreesWithWhatItCounts) {
  EXPECT_EQ(counted(1, "split"), "1 split");
  EXPECT_EQ(counted(0U, "split"), "0 splits");
  EXPECT_EQ(counted(2, "push", "pushes"), "2 pushes");
}

/// Values in place of the scene's own, by their paths (polynya run --set, polynya validate --cases).
const std::string kSet =
    "{\n  \"time\": {\"until_s\": 10}, \"ice\": {\"thickness_m\": 0.5}, " + list("floes", {square(0, 0, 10)}) + "}";

SceneOutcome with_values(const std::vector<std::string>& words, const std::string& text = kSet) {
  SceneOverrides overrides;
  for (const std::string& each : words) overrides.assignments.push_back(parse_assignment(each).value());
  return read_scene(text, "scene.json", ".", overrides);
}

TEST(SceneAssign, PutsValuesOfEveryKindWhereTheirPathsLead) {
  const auto outcome =
      checked(with_values({"ice.thickness_m=0.7", "floes[0].rectangle.corner_m[1]=5", "water.drift_m_per_s=[1,2]",
                           "name=of-no-quotes", "fracture.bending.radial_cracks=\"ignored\"", "seed=7"}));
  EXPECT_EQ(outcome->scene.ice.thickness, 0.7);
  EXPECT_EQ(outcome->scene.floes.at(0).polygon_in_world.outer.front().y, 5);
  EXPECT_EQ(outcome->scene.water.drift.y, 2);
  EXPECT_EQ(outcome->scene.name, "of-no-quotes");
  EXPECT_EQ(outcome->scene.seed, 7U);
  const auto set = with_values({"ice.thickness_m=0.8"});
  const LoadedScene written = load(with(kSet, R"("ice": {"thickness_m": 0.8})"));
  EXPECT_EQ(set->resolved_text, written.resolved_text);
  EXPECT_EQ(set->hash, written.hash);
}

TEST(SceneAssign, NamesTheOptionAndTheKeyOfWhatIsWrong) {
  for (const auto& [words, message] :
       {std::pair{"ice.thickness_m=-1", "ice.thickness_m: found -1, allowed: a number ≥ 0.001, ≤ 20 [m]"},
        {"ice.thicknes_m=1", "ice.thicknes_m: found an unknown key"},
        {"floes[1].rectangle.size_m=3", "floes[1]: found a list of 1, allowed: floes[0]"},
        {"ships[0].mass_kg=3", "ships: found nothing, allowed: a list that the scene has"},
        {"ice.thickness_m.x=3", "ice.thickness_m: found 0.5, allowed: an object, to have \"x\""},
        {"a..b=1", ""},
        {"a[=1", ""},
        {"a[x]=1", ""},
        {"[0]=1", ""},
        {"a]=1", ""}}) {
    EXPECT_BEGINS(to_string(refused(with_values({words})).front()), std::string("--set ") + words + ": " + message);
  }
  for (const auto& [words, meant] : {std::pair{"ice.thicknes_m=1", "thickness_m"},
                                     {"thickness_m=1", "ice.thickness_m"},
                                     {"until_s=1", "time.until_s"},
                                     {"ice.until=1", "time.until_s"},
                                     {"draught_m=1", "ships[0].hull.draught_m"}})
    EXPECT_HAS(in_words(with_values({words}).error()), fmt::format("did you mean \"{}\"?", meant));
  EXPECT_FALSE(parse_assignment("no-value"));
  EXPECT_FALSE(parse_assignment("=3"));
}

TEST(SceneAssign, SaysWhatJsonWantsInPlaceOfWhatIsNotJson) {
  const std::vector<std::pair<std::string, std::string>> all{
      {"time.step_s=.05", "\".05\" is not a JSON number; write 0.05; allowed: a number ≥ 1e-05"},
      {"time.step_s=0,07", "\"0,07\" is not a JSON number; write 0.07;"},
      {"time.step_s=+0.05", "write 0.05;"},
      {"time.step_s=05e-3", "write 0.005;"},
      {"time.step_s=1.", "write 1;"},
      {"time.step_s=0.05 s", "write 0.05;"},
      {"time.step_s='0.05'", "write 0.05;"},
      {"floes.0.fast_ice=true", "floes: found a list of 1, allowed: floes[0]"},
      {"time.step_s=50ms", "found \"50ms\", which is not JSON and so is taken as a text, allowed: a number"},
      {"ice.thickness_m=50cm", "found \"50cm\", which is not JSON"},
      {"time.step_s=5%", "found \"5%\", which is not JSON and so is taken as a text, allowed: a number"},
      {"time.step_s=NaN", "found \"NaN\", which is not JSON"},
      {"time.step_s=", "found \"\", which is not JSON"},
      {"fracture.resurface.enabled=False", "\"False\" is not a JSON boolean; write false; allowed: true or false"},
      {"water.drift_m_per_s=.1,2", "\".1,2\" is not a JSON list; write [0.1, 2]; allowed: [x, y]"},
      {"water.drift_m_per_s=(1 -2)", "write [1, -2];"},
      {"ice=thickness_m:5",
       "found \"thickness_m:5\", which is not JSON and so is taken as a text, allowed: an object"}};
  for (const auto& [words, message] : all)
    EXPECT_HAS(to_string(refused(with_values({words})).front()), "--set " + words + ": ", message);
  // A text is a text, with quotes or without.
  EXPECT_EQ(checked(with_values({"description=.05"}))->description, ".05");
}

/// A problem of the second of two options is reported for the second option. A problem of the scene itself is reported
/// for the scene.
TEST(SceneAssign, KeepsThePlacesOfSceneOptionsAndCasesApart) {
  const auto problems = refused(with_values({"seed=1", "ice.friction=nine"}, "{\n  \"ice\": {\"thickness_m\": -1}\n}"));
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_BEGINS(to_string(problems[0]), "scene.json:2:26: ice.thickness_m");
  EXPECT_BEGINS(to_string(problems[1]), "--set ice.friction=nine: ice.friction");
  SceneOverrides overrides;
  overrides.assignments = parse_case(R"({"seed": 2, "ice.thickness_m": -1})", "cases.ndjson", 17).value();
  EXPECT_BEGINS(to_string(read_scene(kSet, "scene.json", ".", overrides).error().front()),
                "cases.ndjson:17:32: ice.thickness_m: found -1");
  EXPECT_EQ(to_string(parse_case("[1]", "cases.ndjson", 3).error()),
            "cases.ndjson:3:1: found a list of 1, allowed: an object of paths and values");
  EXPECT_FALSE(parse_case("{\"a\": }", "cases.ndjson", 3));
}

// ---- what follows from a scene's ships, walls and presets

simulation::Ship ship_of(const std::string& text) {
  LoadedScene loaded = load(scene_of_ship(text));
  return loaded.scene.ships.empty() ? simulation::Ship{} : loaded.scene.ships.front();
}

TEST(SceneShips, WhatAShipIsNotGivenFollowsFromTheRest) {
  const auto held = ship_of(ship(R"("propulsion": {"constant_speed_m_per_s": 1.5})"));
  EXPECT_EQ(held.speed, 1.5);
  EXPECT_EQ(held.name, "ship-1");
  const auto sailing = ship_of(sailing_ship());
  EXPECT_DOUBLE_EQ(sailing.mass, 1000 * 0.58 * 120 * 24 * 6);
  EXPECT_DOUBLE_EQ(sailing.moment_of_inertia, sailing.mass * 900);
  EXPECT_TRUE(sailing.water.acts);
  EXPECT_HAS(load(scene_of_ship(sailing_ship())).resolved_text, "\"mass_kg\": 10022400");
  const auto heavy = ship_of(sailing_ship(R"("mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9)"));
  EXPECT_EQ(heavy.mass, 1e7);
  EXPECT_EQ(heavy.moment_of_inertia, 5e9);
  const std::string pushed = R"("propulsion": {"thrust_N": 1e5})";
  EXPECT_FALSE(ship_of(sailing_ship(pushed)).water.acts);
  EXPECT_TRUE(ship_of(sailing_ship(pushed + R"(, "water": {"model": "manoeuvring"})")).water.acts);
  EXPECT_FALSE(ship_of(sailing_ship(R"("water": {"model": "none"})")).water.acts);
}

TEST(SceneShips, AMassThatTheHullDoesNotDisplaceIsAWarning) {
  EXPECT_TRUE(load(scene_of_ship(sailing_ship())).hints.empty());
  const auto hints = load(scene_of_ship(sailing_ship(R"("mass_kg": 1.2e7)"))).hints;
  ASSERT_EQ(hints.size(), 1U);
  EXPECT_HAS(to_string(hints[0]), ": warning: ships[0].mass_kg: ", "displace 1.002e+07 kg");
}

TEST(SceneShips, BollardPullFollowsFromThePower) {
  const auto sailing = ship_of(sailing_ship(R"("propulsion": {"engine": {"power_MW": 10, "propeller_diameter_m": 4,
      "propellers": 2, "open_water_speed_m_per_s": 8}})"));
  const auto& engine = std::get<simulation::Engine>(sailing.propulsion);
  EXPECT_NEAR(engine.bollard_pull, 0.98e3 * std::pow(40000, 2 / 3.0), 1e-3);
  EXPECT_EQ(engine.power, 10e6);
  EXPECT_NEAR(engine.propeller_area, 2 * M_PI * 4, 1e-9);
}

TEST(SceneShips, TheFateOfCuspsFollowsFromADraughtUnlessTheSceneStatesIt) {
  const std::string deep = R"("hull": {"draught_m": 6})";
  const auto with_draught = load(scene_of_ship(ship(deep))).scene;
  EXPECT_EQ(with_draught.fracture.cusp_fate, CuspFate::kUnderHull);
  EXPECT_TRUE(with_draught.fracture.going_under.is_enabled && with_draught.fracture.resurface.is_enabled);
  EXPECT_EQ(with_draught.ships[0].hull.draught, 6);
  const auto without = load(scene_of_ship(ship())).scene;
  EXPECT_EQ(without.fracture.cusp_fate, CuspFate::kSubmerge);
  EXPECT_FALSE(without.fracture.going_under.is_enabled || without.fracture.resurface.is_enabled);
  const auto stated = load(scene(
      {list("ships", {ship(deep)}), R"("fracture": {"cusp_fate": "submerge", "going_under": {"enabled": false}})"}));
  EXPECT_EQ(stated.scene.fracture.cusp_fate, CuspFate::kSubmerge);
  EXPECT_FALSE(stated.scene.fracture.resurface.is_enabled) << "nothing goes under";
  expect_reads_back(stated);
}

LoadedScene walled(const std::string& walls) {
  return load(scene({list("floes", {square(0, 0, 10)}), "\"walls\": [" + walls + "]"}));
}

TEST(SceneShips, WallsHaveTheIceToTheirLeft) {
  const auto loaded =
      walled(R"({"from_m": [-50, -1], "to_m": [50, -1], "velocity_m_per_s": [0.1, 0.2]}, {"name": "north",
    "from_m": [50, 20], "to_m": [-50, 20], "depth_m": 3, "pressure": {"line_load_N_per_m": 5e4}})");
  ASSERT_EQ(loaded.scene.walls.size(), 2u);
  EXPECT_TRUE(loaded.hints.empty());
  const simulation::Wall& south = loaded.scene.walls[0];
  EXPECT_EQ(south.name, "wall-1");
  EXPECT_EQ(south.position_in_world, (geometry::Point{0, -1}));
  EXPECT_NEAR(std::sin(south.heading), 1, 1e-15) << "its face looks along +y";
  EXPECT_EQ(south.velocity, (geometry::Vector{0.1, 0.2}));
  EXPECT_FALSE(south.pressure);
  const simulation::Wall& north = loaded.scene.walls[1];
  EXPECT_EQ(north.name, "north");
  EXPECT_NEAR(std::sin(north.heading), -1, 1e-15);
  ASSERT_TRUE(north.pressure);
  EXPECT_EQ(north.load(), 5e6);
  EXPECT_EQ(north.pressure->mass_per_length, 4.5e5);
  const auto box = bounding_box(north.hull.waterline);
  EXPECT_EQ(box.low.x, -3);
  EXPECT_EQ(box.high.x, 0);
}

TEST(SceneShips, WallsMayCrossAndOneThatTurnsItsBackIsPointedOut) {
  EXPECT_TRUE(
      walled(R"({"from_m": [-50, -1], "to_m": [50, -1]}, {"from_m": [-1, 50], "to_m": [-1, -50]})").hints.empty());
  const auto back = walled(R"({"from_m": [50, -1], "to_m": [-50, -1], "depth_m": 0.5})").hints;
  ASSERT_EQ(back.size(), 1u);
  EXPECT_EQ(back.front().path, "walls[0].to_m");
  EXPECT_HAS(back.front().sentence, "exchange");
}

SceneOutcome preset(const std::string& members) {
  return read(scene_of_ship("{\"ship\": " + members + "}"));
}

TEST(ShipPresets, EachIsAShipWithASourceForEveryParticular) {
  ASSERT_GE(ship_presets().size(), 7u);
  for (const ShipPreset& one : ship_presets()) {
    const bool has_engine = json_of(one).find("propulsion") != nullptr;
    const auto loaded =
        checked(preset(fmt::format("\"{}\"{}", one.name, has_engine ? "" : R"(, "propulsion": {"thrust_N": 2e4})")));
    EXPECT_GT(loaded->scene.ships[0].mass, 1e6) << one.name;
    for (const PresetValue& value : one.particulars) EXPECT_FALSE(value.source.empty()) << value.path;
    expect_reads_back(*loaded);
  }
}

TEST(ShipPresets, WhatASceneGivesStandsInsteadOfThePresets) {
  const auto polaris = preset(R"("polaris")"), deeper = preset(R"("polaris", "hull": {"draught_m": 8.5})");
  ASSERT_TRUE(polaris.has_value() && deeper.has_value());
  EXPECT_EQ(polaris->scene.ships[0].hull.draught, 8);
  EXPECT_EQ(deeper->scene.ships[0].hull.draught, 8.5);
  EXPECT_EQ(deeper->scene.ships[0].hull.waterline, polaris->scene.ships[0].hull.waterline);
  EXPECT_NEAR(polaris->scene.ships[0].mass, 10961e3, 5e3);
  const auto other = checked(preset(R"("sawamura2017", "propulsion": {"constant_speed_m_per_s": 2},
      "hull": {"waterline_m": [[60, 0], [40, 10], [-60, 10], [-60, -10], [40, -10]]})"));
  EXPECT_EQ(other->scene.ships[0].hull.waterline.size(), 5u);
  EXPECT_TRUE(std::holds_alternative<simulation::ConstantSpeed>(other->scene.ships[0].propulsion));
  for (const char* drive : {R"("constant_speed_m_per_s": 2)", R"("thrust_N": 1e5)"}) {
    const auto held = checked(preset(fmt::format(R"("reference", "propulsion": {{{}}})", drive)));
    EXPECT_TRUE(std::holds_alternative<simulation::NoSteering>(held->scene.ships[0].steering));
  }
}

}  // namespace
}  // namespace polynya::io
