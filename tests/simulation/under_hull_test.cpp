// Ice that goes under a hull: floes that tilt, submerged pieces that brake the ship, pieces that come up
// behind it.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/world/step.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

Ship with_draught(Ship ship) {
  ship.hull.draught = 6;
  return ship;
}

/// The reference ship at constant speed, through ice that goes under it.
Scene under(double speed = 1) {
  Scene scene;
  scene.ships = {with_draught(icebreaker({-0.5, 0}, ConstantSpeed{speed}, speed))};
  scene.fracture.cusp_fate = CuspFate::kUnderHull;
  scene.fracture.going_under.is_enabled = true;
  scene.fracture.resurface.is_enabled = true;
  return scene;
}

/// A floe of 12 m that lies on a plate too large to move, ahead of the stem.
Scene pinned_floe() {
  Scene scene = under();
  scene.ice.thickness = 1;
  scene.fracture.breakable_size_factor = 100;  // nothing breaks
  scene.floes = {floe(rectangle(0, -6, 12, 6)), floe(rectangle(12.01, -150, 400, 150))};
  return scene;
}

void expect_closed(const Simulation& simulation) {
  const AreaLedger ledger = simulation.area_ledger();
  EXPECT_LT(std::abs(ledger.imbalance), 1e-9 * ledger.initial_ice_area);
  EXPECT_TRUE(simulation.audit().is_closed()) << simulation.audit().energy_imbalance;
}

TEST(UnderHull, AFloeBetweenAnInclinedHullAndAPlateTiltsAndGoesUnder) {
  Simulation simulation(pinned_floe());
  const Story story = run(simulation, 20);
  const std::vector<Event> under = of_kind<Submerge>(story);
  ASSERT_FALSE(under.empty());
  EXPECT_EQ(under[0].ice()->floe, 0);
  EXPECT_GE(std::get<Submerge>(under[0].what).criterion.deflection,
            std::get<Submerge>(under[0].what).criterion.least_deflection);
  EXPECT_NEAR(std::get<Submerge>(under[0].what).criterion.least_deflection, 0.9, 1e-12);
  EXPECT_NEAR(std::get<Submerge>(under[0].what).under_hull_area, 144, 1e-9);
  EXPECT_EQ(simulation.counts().tilted_under, static_cast<std::int64_t>(under.size()));
  expect_closed(simulation);
}

TEST(UnderHull, ByVerticalWallsItNeverDoes) {
  Scene scene = pinned_floe();
  scene.ships[0].hull.angles_from_vertical.assign(scene.ships[0].hull.waterline.size(), 0);
  Simulation simulation(scene);
  EXPECT_TRUE(of_kind<Submerge>(run(simulation, 20)).empty());
  expect_closed(simulation);
}

TEST(UnderHull, TiltingLimitsTheForceOfAFloeThatCannotGetAway) {
  Scene scene = pinned_floe();
  const auto largest = [](const Scene& of) {
    Simulation simulation(of);
    double most = 0;
    for (const ShipSample& sample : run(simulation, 12).samples)
      most = std::max(most, std::abs(sample.from_ice.surge));
    return most;
  };
  const double tilting = largest(scene);
  scene.fracture.going_under.is_enabled = false;
  EXPECT_GT(largest(scene), 5 * tilting);
}

TEST(UnderHull, AFloeThatIsFreeToMoveIsPushedAsideAndStaysUp) {
  Scene scene = under(0.5);
  scene.floes = {floe(rectangle(0, 4, 8, 12))};
  Simulation simulation(scene);
  EXPECT_TRUE(of_kind<Submerge>(run(simulation, 40)).empty());
}

/// A small piece under the hull, and nothing else.
Scene one_tile(double y) {
  Scene scene = under();
  scene.ice.thickness = 1;
  scene.fracture.breakable_size_factor = 100;
  scene.ships[0].hull.has_speed_factor = false;
  scene.floes = {floe(rectangle(0, y - 2, 4, y + 2)), floe(rectangle(4.01, -150, 100, 150))};
  return scene;
}

TEST(UnderHull, APieceTakesItsWeightTimesTheWayUpAndAlongTheHull) {
  const Scene scene = one_tile(0);
  Simulation simulation(scene);
  const Story story = run(simulation, 100);
  ASSERT_EQ(of_kind<Submerge>(story).size(), 1U);
  double work = 0;
  for (const ShipSample& sample : story.samples) work -= sample.from_submerged.surge * 0.1;  // at 1 m/s
  const double weight = 100 * 9.81 * 16;
  const dynamics::SubmersionPath& path = simulation.world().setup.underwater[0].path;
  EXPECT_NEAR(work, weight * (path.rise + 0.2 * path.sliding), 1e-9 * work);
}

TEST(UnderHull, IceOffTheCentreLineTurnsTheShipTowardsIt) {
  Simulation simulation(one_tile(1));
  const Story story = run(simulation, 40);
  ASSERT_EQ(of_kind<Submerge>(story).size(), 1U);
  double moment = 0;
  for (const ShipSample& sample : story.samples) moment += sample.from_submerged.yaw;
  EXPECT_GT(moment, 0) << "to port, where it is";
}

TEST(UnderHull, IceStopsAShipButNeverReversesIt) {
  Scene scene = one_tile(0);
  scene.ships[0].propulsion = ConstantThrust{0};
  Simulation simulation(scene);
  run(simulation, 20);
  auto& world = const_cast<World&>(simulation.world());
  ASSERT_EQ(world.population.submerged.size(), 1U);
  world.population.submerged[0].weight = 1e9;  // as if the whole hull were full of ice
  for (const double speed : {1e-3, 0.0, -1e-3}) {
    world.population.bodies.velocity[0] = {speed, 0};
    std::vector<ShipLoads> loads(1);
    AuditSums audit;
    pull_of_submerged_ice(world.setup, world.population, loads, audit);
    EXPECT_NEAR(world.population.bodies.velocity[0].x, std::min(0.0, speed), 1e-18) << speed;
    EXPECT_NEAR(audit.energy.submerged_ice, speed > 0 ? 0.5 * 1e7 * speed * speed : 0, 1e-9);
  }
}

TEST(UnderHull, APieceComesUpBehindTheShipAsItsOwnChildWithoutItsRim) {
  Simulation simulation(one_tile(0));
  Story story = run(simulation, 140);
  const std::vector<Event> up = of_kind<Resurface>(story);
  ASSERT_EQ(up.size(), 1U);
  EXPECT_EQ(up[0].ice()->floe, 0);
  ASSERT_EQ(up[0].ice()->children.size(), 1U);
  EXPECT_GE(std::get<Resurface>(up[0].what).criterion.path,
            std::get<Resurface>(up[0].what).criterion.least_path);
  EXPECT_NEAR(up[0].ice()->brash_area, 0.05 * 16, 1e-9);
  const auto born = std::ranges::find(story.births, up[0].ice()->children[0], &BirthRecord::floe);
  ASSERT_NE(born, story.births.end());
  EXPECT_EQ(born->parent, 0);
  EXPECT_EQ(born->generation, 1);
  EXPECT_NEAR(born->area, 0.95 * 16, 1e-9);
  EXPECT_EQ(simulation.counts().came_up, 1);
  EXPECT_EQ(simulation.area_ledger().under_hull_area, 0);
  expect_closed(simulation);
}

TEST(UnderHull, WithoutScatterItComesUpInItsPlace) {
  Scene scene = one_tile(0);
  scene.fracture.resurface.scatter = 0;
  Simulation simulation(scene);
  const Story story = run(simulation, 140);
  const std::vector<Event> under = of_kind<Submerge>(story);
  const std::vector<Event> up = of_kind<Resurface>(story);
  ASSERT_EQ(up.size(), 1U);
  const std::vector<FloeState> floes = simulation.floe_states();
  const auto state = std::ranges::find(floes, up[0].ice()->children[0], &FloeState::floe);
  ASSERT_NE(state, floes.end());
  EXPECT_LT(distance(transform(state->world_from_body, {2, 0}), up[0].point_in_world), 1e-9);
}

TEST(UnderHull, APieceWithoutRoomWaitsAndThenStaysUnderTheIce) {
  Scene scene = one_tile(0);
  scene.fracture.resurface.give_up = 10;
  scene.fracture.resurface.scatter = 0;
  Simulation simulation(scene);
  Story story = run(simulation, 30);
  ASSERT_EQ(of_kind<Submerge>(story).size(), 1U);
  // A floe as large as the hull and more lies where the piece would come up, as soon as the ship has gone.
  scene.floes.push_back(floe(rectangle(-400, -60, -122, 60), {1.5, 0}));
  scene.water.drag_coefficient = 0;
  Simulation blocked(scene);
  story = run(blocked, 220);
  const std::vector<Event> stays = of_kind<StayUnder>(story);
  ASSERT_EQ(stays.size(), 1U);
  EXPECT_GE(std::get<StayUnder>(stays[0].what).criterion.waited, 10);
  EXPECT_NEAR(std::get<StayUnder>(stays[0].what).under_ice_area, 16, 1e-9);
  EXPECT_NEAR(blocked.area_ledger().under_ice_area, 16, 1e-9);
  EXPECT_EQ(blocked.counts().stayed_under, 1);
  expect_closed(blocked);
}

TEST(UnderHull, AShipThatStopsKeepsItsIceAndOneThatBacksGivesItBack) {
  Scene scene = one_tile(0);
  scene.ships[0].propulsion = ConstantThrust{0};
  scene.ships[0].speed = 1;
  Simulation simulation(scene);
  Story story = run(simulation, 20);
  ASSERT_EQ(of_kind<Submerge>(story).size(), 1U);
  auto& world = const_cast<World&>(simulation.world());
  world.population.bodies.velocity[0] = {0, 0};
  story = run(simulation, 60);
  EXPECT_TRUE(of_kind<Resurface>(story).empty());
  EXPECT_EQ(world.population.submerged.size(), 1U);
  const double path = world.population.submerged[0].path;
  world.population.bodies.velocity[0] = {-1, 0};
  story = run(simulation, 60 + path + 30);
  const std::vector<Event> up = of_kind<Resurface>(story);
  ASSERT_EQ(up.size(), 1U);
  EXPECT_LT(std::get<Resurface>(up[0].what).criterion.path, 0);
}

TEST(UnderHull, IceUnderAHullGoesWithACurrent) {
  Scene scene = one_tile(0);
  scene.water.shear = {0.001, 0.5 * std::numbers::pi, {}};
  scene.fracture.resurface.scatter = 0;
  Simulation simulation(scene);
  const Story story = run(simulation, 160);
  const std::vector<Event> under = of_kind<Submerge>(story);
  const std::vector<Event> up = of_kind<Resurface>(story);
  ASSERT_EQ(up.size(), 1U);
  EXPECT_GT(std::abs(up[0].point_in_world.y - under[0].point_in_world.y), 0.05);
  expect_closed(simulation);
}

TEST(UnderHull, AChannelFillsWithBrashAndAResumedRunGoesOnBitByBit) {
  Scene scene = under(2);
  scene.time.step = 0.01;
  scene.floes = {floe(rectangle(0, -60, 300, 60))};
  scene.ships.push_back(with_draught(icebreaker({-140, 0}, ConstantSpeed{2}, 2)));
  scene.ships[1].name = "follower";
  Simulation simulation(scene);
  std::optional<Simulation> resumed;
  while (simulation.time() < 110) {
    if (simulation.steps() == 9000) {
      auto again = Simulation::resumed(scene, simulation.state());
      ASSERT_TRUE(again.has_value()) << again.error();
      resumed = std::move(*again);
    }
    simulation.step();
    simulation.journal().clear();
    if (resumed) resumed->step();
    if (simulation.steps() % 500 == 0) expect_closed(simulation);
  }
  const Counts counts = simulation.counts();
  EXPECT_GT(counts.came_up, 50);
  EXPECT_GT(counts.went_under, counts.came_up);
  EXPECT_GT(simulation.world().population.submerged.size(), 50U);
  EXPECT_EQ(simulation.state_hash(), resumed->state_hash());
}

}  // namespace
}  // namespace polynya::simulation
