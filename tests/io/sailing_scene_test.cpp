// Scenes with ships that sail: what follows from what, and what is refused.
#include <gtest/gtest.h>

#include "io/scene/scene_reader.hpp"

namespace polynya::io {
namespace {

const std::string kHull =
    R"("hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27, "draught_m": 6, "block_coefficient": 0.58})";
const std::string kMass = R"("mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9)";
const std::string kEngine =
    R"("propulsion": {"engine": {"bollard_pull_kN": 1000, "open_water_speed_m_per_s": 8}})";

const std::string kRudder = R"(, "steering": {"rudder": {}})";

SceneOutcome read(const std::string& ship) {
  return read_scene("{\"ships\": [{" + ship + "}]}", "ship.json", ".");
}

simulation::Ship ship_of(const std::string& text) {
  const auto loaded = read(text);
  EXPECT_TRUE(loaded.has_value()) << (loaded ? "" : to_string(loaded.error().front()));
  return loaded ? loaded->scene.ships.front() : simulation::Ship{};
}

TEST(SailingScene, MassAndInertiaFollowFromTheForm) {
  const auto ship = ship_of(kHull + "," + kEngine);
  EXPECT_DOUBLE_EQ(ship.mass, 1000 * 0.58 * 120 * 24 * 6);
  EXPECT_DOUBLE_EQ(ship.moment_of_inertia, ship.mass * 900);
  EXPECT_TRUE(ship.water.acts);
  const auto heavy = ship_of(kHull + "," + kMass + "," + kEngine);
  EXPECT_EQ(heavy.mass, 1e7);
  EXPECT_EQ(heavy.moment_of_inertia, 5e9);
}

TEST(SailingScene, TheResolvedSceneHasThem) {
  const auto loaded = read(kHull + "," + kEngine);
  ASSERT_TRUE(loaded.has_value());
  EXPECT_NE(loaded->resolved_text.find("\"mass_kg\": 10022400"), std::string::npos) << loaded->resolved_text;
}

TEST(SailingScene, BollardPullFollowsFromThePower) {
  const auto ship = ship_of(kHull + R"(,"propulsion": {"engine": {"power_MW": 10, "propeller_diameter_m": 4,
      "propellers": 2, "open_water_speed_m_per_s": 8}})");
  const auto& engine = std::get<simulation::Engine>(ship.propulsion);
  EXPECT_NEAR(engine.bollard_pull, 0.98e3 * std::pow(40000, 2 / 3.0), 1e-3);
  EXPECT_EQ(engine.power, 10e6);
  EXPECT_NEAR(engine.propeller_area, 2 * M_PI * 4, 1e-9);
}

TEST(SailingScene, WaterActsIfAskedFor) {
  EXPECT_FALSE(ship_of(kHull + R"(,"propulsion": {"thrust_N": 1e5})").water.acts);
  EXPECT_TRUE(
      ship_of(kHull + R"(,"propulsion": {"thrust_N": 1e5}, "water": {"model": "manoeuvring"})").water.acts);
  EXPECT_FALSE(ship_of(kHull + "," + kEngine + R"(, "water": {"model": "none"})").water.acts);
}

TEST(SailingScene, WhatDoesNotGoTogetherIsRefusedAtItsPlace) {
  const std::string bare = R"("hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27})";
  const std::string drawn =
      R"("hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27, "draught_m": 6})";
  const std::string thrust = R"("propulsion": {"thrust_N": 1e5})";
  const auto engine = [](const std::string& more) { return R"("propulsion": {"engine": {)" + more + "}}"; };
  const struct {
    std::string ship, path, found;
  } cases[] = {
      {bare + R"(, "moment_of_inertia_kg_m2": 5e9,)" + thrust, "ships[0].mass_kg", "nothing"},
      {drawn + R"(, "mass_kg": 1e7,)" + thrust, "ships[0].moment_of_inertia_kg_m2", "nothing"},
      {bare + "," + kMass + "," + kEngine, "ships[0].hull.draught_m", "water acts on the hull"},
      {drawn + R"(, "mass_kg": 1e8, "moment_of_inertia_kg_m2": 5e9,)" + kEngine, "ships[0].mass_kg",
       "a block coefficient of 5.79"},
      {R"("hull": {"length_m": 40, "beam_m": 30, "entrance_angle_deg": 60, "draught_m": 6, "block_coefficient": 0.6},)" +
           kEngine,
       "ships[0].water.model", "no meaning for a hull of 40 × 30 × 6 m"},
      {kHull + "," + engine(R"("open_water_speed_m_per_s": 8)"), "ships[0].propulsion.engine",
       "neither bollard_pull_kN nor power_MW"},
      {kHull + "," + engine(R"("open_water_speed_m_per_s": 8, "power_MW": 5)"), "ships[0].propulsion.engine",
       "neither bollard_pull_kN nor power_MW"},
      {kHull + "," + engine(R"("open_water_speed_m_per_s": 12, "bollard_pull_kN": 500)"),
       "ships[0].propulsion.engine.open_water_speed_m_per_s", "the bollard pull 500 kN"},
      {kHull + "," + engine(R"("open_water_speed_m_per_s": 9, "bollard_pull_kN": 900, "power_MW": 3)"),
       "ships[0].propulsion.engine.open_water_speed_m_per_s", "MW of 3"},
      {kHull + "," + thrust + R"(, "steering": {"rudder": {}})", "ships[0].steering", "without an engine"},
      {kHull + "," + thrust +
           R"(, "mooring": {"sway_stiffness_N_per_m": 1e5, "position_m": [0, 30], "break_load_N": 2e6})",
       "ships[0].mooring.break_load_N", "it pulls with 3e+06 N"},
      {kHull + "," + kEngine + R"(, "steering": {"rudder": {"area_m2": 150}})",
       "ships[0].steering.rudder.area_m2", "150"},
      {kHull + R"(, "propulsion": {"constant_speed_m_per_s": 1}, "mooring": {})", "ships[0].mooring",
       "speed is prescribed"},
      {kHull + "," + thrust + R"(, "pilot": {"constant": {}})", "ships[0].pilot", "without an engine"},
      {kHull + "," + kEngine + R"(, "pilot": {"hold_heading": {}})", "ships[0].pilot.hold_heading",
       "nothing to steer with"},
      {kHull + "," + kEngine + kRudder + R"(, "pilot": {"constant": {"steering_deg": 40}})",
       "ships[0].pilot.constant.steering_deg", "40°"},
      {kHull + "," + kEngine + kRudder +
           R"(, "pilot": {"table": {"rows": [{"t_s": 5, "lever": 1}, {"t_s": 5, "lever": 0}]}})",
       "ships[0].pilot.table.rows[1].t_s", "5"},
      {kHull + "," + kEngine + kRudder +
           R"(, "pilot": {"route": {"waypoints": [{"position_m": [-500, 0], "speed_m_per_s": 3}]}})",
       "ships[0].pilot.route.waypoints[0].position_m", "500 m behind the ship"},
      {kHull + "," + kEngine + kRudder + R"(, "pilot": {"constant": {}, "hold_heading": {}})",
       "ships[0].pilot", "constant and hold_heading together"},
      {kHull + "," + kEngine + kRudder + R"(, "pilot": {"follow": {"ship": "ship-1", "distance_m": 100}})",
       "ships[0].pilot.follow.ship", "cannot follow itself"},
      {kHull + "," + kEngine + kRudder + R"(, "pilot": {"follow": {"ship": "Fram", "distance_m": 100}})",
       "ships[0].pilot.follow.ship", "the name of no ship"},
  };
  for (const auto& c : cases) {
    const auto outcome = read(c.ship);
    ASSERT_FALSE(outcome.has_value()) << c.ship;
    ASSERT_EQ(outcome.error().size(), 1U) << to_string(outcome.error().back());
    const Problem& problem = outcome.error().front();
    EXPECT_EQ(problem.path, c.path) << to_string(problem);
    EXPECT_NE(problem.found.find(c.found), std::string::npos) << to_string(problem);
    EXPECT_FALSE(problem.allowed.empty());
    EXPECT_EQ(problem.line, 1);
    EXPECT_GT(problem.column, 1);
  }
}

/// The only problem of a scene.
Problem problem_of(const std::string& text) {
  const auto outcome = read_scene(text, "ships.json", ".");
  EXPECT_FALSE(outcome.has_value());
  return outcome ? Problem{} : outcome.error().front();
}

TEST(SailingScene, RoutesStayClearOfStructures) {
  const auto scene = [&](const std::string& waypoints) {
    return "{\"ships\": [{" + kHull + "," + kEngine + kRudder + R"(, "pilot": {"route": {"waypoints": [)" +
           waypoints + R"(]}}}], "structures": [{"name": "tower", "radius_m": 20, "position_m": [600, 0]}]})";
  };
  const Problem through = problem_of(scene(R"({"position_m": [1000, 0], "speed_m_per_s": 3})"));
  EXPECT_EQ(through.path, "ships[0].pilot.route.waypoints[0].position_m");
  EXPECT_NE(through.found.find("leads through tower"), std::string::npos);
  problem_of(scene(R"({"position_m": [600, 31], "speed_m_per_s": 3})"));  // nearer than half a beam
  const auto around = read_scene(
      scene(
          R"({"position_m": [600, 80], "speed_m_per_s": 3}, {"position_m": [1000, 0], "speed_m_per_s": 3})"),
      "s", ".");
  EXPECT_TRUE(around.has_value());
}

TEST(SailingScene, ShipsDoNotFollowEachOtherInARing) {
  const auto ship = [&](const std::string& name, const std::string& leader, int y) {
    return "{" + kHull + "," + kEngine + kRudder + R"(, "name": ")" + name + R"(", "position_m": [0, )" +
           std::to_string(y) + R"(], "pilot": {"follow": {"distance_m": 100, "ship": ")" + leader + "\"}}}";
  };
  const Problem ring = problem_of("{\"ships\": [" + ship("a", "b", 0) + "," + ship("b", "c", 200) + "," +
                                  ship("c", "a", 400) + "]}");
  EXPECT_EQ(ring.path, "ships[0].pilot.follow.ship");
  EXPECT_NE(ring.found.find("which follows this ship"), std::string::npos);
}

TEST(SailingScene, AMassThatTheHullDoesNotDisplaceIsAWarning) {
  const auto loaded = read(kHull + R"(, "mass_kg": 1.2e7, )" + kEngine);
  ASSERT_TRUE(loaded.has_value());
  ASSERT_EQ(loaded->hints.size(), 1U);
  EXPECT_EQ(loaded->hints[0].path, "ships[0].mass_kg");
  EXPECT_NE(loaded->hints[0].sentence.find("displace 1.002e+07 kg"), std::string::npos);
  EXPECT_EQ(loaded->hints[0].severity, Severity::kWarning);
  EXPECT_TRUE(read(kHull + "," + kEngine)->hints.empty());
}

}  // namespace
}  // namespace polynya::io
