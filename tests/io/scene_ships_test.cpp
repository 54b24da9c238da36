// What follows from a scene's ships, walls and presets.
#include <cmath>

#include "scene_text.hpp"

#include "io/scene/ship_presets.hpp"

namespace polynya::io {
namespace {

using namespace tests;
using simulation::CuspFate;

simulation::Ship ship_of(const std::string& text) {
  LoadedScene loaded = load(scene_of_ship(text));
  return loaded.scene.ships.empty() ? simulation::Ship{} : loaded.scene.ships.front();
}

TEST(SceneShips, AShipAtConstantSpeedStartsAtIt) {
  const auto held = ship_of(ship(R"("propulsion": {"constant_speed_m_per_s": 1.5})"));
  EXPECT_EQ(held.speed, 1.5);
  EXPECT_EQ(held.name, "ship-1");
}

TEST(SceneShips, MassInertiaAndWaterFollowFromTheForm) {
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
    for (const Particular& particular : one.particulars) EXPECT_FALSE(particular.source.empty()) << particular.path;
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
