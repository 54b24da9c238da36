// Ice that goes under a hull: floes that tilt, submerged pieces that brake the ship, pieces that come up
// behind it.
#include <algorithm>

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
Build under(double speed = 1, geometry::Point stem = {-0.5, 0}) {
  Build scene = Build().ship(with_draught(icebreaker(stem, ConstantSpeed{speed}, speed)));
  scene.fracture.cusp_fate = CuspFate::kUnderHull;
  scene.fracture.going_under.is_enabled = true;
  scene.fracture.resurface.is_enabled = true;
  return scene;
}

/// A floe that lies on a plate too large to move, ahead of the stem; nothing breaks.
Build pinned(const geometry::Polygon& floe, const geometry::Polygon& plate) {
  Build scene = under().floe(floe).floe(plate);
  scene.ice.thickness = 1;
  scene.fracture.breakable_size_factor = 100;
  return scene;
}

Build pinned_floe() {
  return pinned(rectangle(0, -6, 12, 6), rectangle(12.01, -150, 400, 150));
}

/// A small piece, of 16 m², to port of the centre line by y.
Build one_tile(double y) {
  Build scene = pinned(rectangle(0, y - 2, 4, y + 2), rectangle(4.01, -150, 100, 150));
  scene.ships[0].hull.has_speed_factor = false;
  return scene;
}

TEST(UnderHull, AFloeBetweenAnInclinedHullAndAPlateTiltsAndGoesUnder) {
  const auto [simulation, story] = run(pinned_floe(), 20);
  const auto under = story.submerged();
  ASSERT_FALSE(under.empty());
  EXPECT_EQ(under[0].ice()->floe, 0);
  EXPECT_GE(std::get<Submerge>(under[0].what).criterion.deflection,
            std::get<Submerge>(under[0].what).criterion.least_deflection);
  EXPECT_NEAR(std::get<Submerge>(under[0].what).criterion.least_deflection, 0.9, 1e-12);
  EXPECT_NEAR(std::get<Submerge>(under[0].what).under_hull_area, 144, 1e-9);
  EXPECT_EQ(simulation.counts().tilted_under, std::ssize(under));
  expect_closed(simulation);
}

TEST(UnderHull, ByVerticalWallsOrWhereItIsFreeToMoveItNeverDoes) {
  Scene steep = pinned_floe();
  set_hull_angle(steep.ships[0], 0);
  for (const Scene& scene : {steep, Scene(under(0.5).floe(rectangle(0, 4, 8, 12)))}) {
    const auto [simulation, story] = run(scene, 40);
    EXPECT_TRUE(story.submerged().empty());
    expect_closed(simulation);
  }
}

TEST(UnderHull, TiltingLimitsTheForceOfAFloeThatCannotGetAway) {
  Scene scene = pinned_floe();
  const double tilting = largest(run(scene, 12).story, &HullSample::from_ice);
  scene.fracture.going_under.is_enabled = false;
  EXPECT_GT(largest(run(scene, 12).story, &HullSample::from_ice), 5 * tilting);
}

TEST(UnderHull, APieceTakesItsWeightTimesTheWayUpAndAlongTheHull) {
  const auto [simulation, story] = run(one_tile(0), 100);
  ASSERT_EQ(story.submerged().size(), 1U);
  double work = 0;
  for (const HullSample& sample : story.samples) work -= sample.from_submerged.surge * 0.1;  // at 1 m/s
  const double weight = 100 * 9.81 * 16;
  const dynamics::SubmersionPath& path = simulation.world().setup.underwater[0].path;
  EXPECT_NEAR(work, weight * (path.rise + 0.2 * path.sliding), 1e-9 * work);
}

TEST(UnderHull, IceOffTheCentreLineTurnsTheShipTowardsIt) {
  const Story story = run(one_tile(1), 40).story;
  ASSERT_EQ(story.submerged().size(), 1U);
  EXPECT_GT(mean(story, &HullSample::from_submerged, 0, 0, &dynamics::Planar::yaw), 0) << "to port, where it is";
}

TEST(UnderHull, IceStopsAShipButNeverReversesIt) {
  Scene scene = one_tile(0);
  scene.ships[0].propulsion = ConstantThrust{0};
  Trial done = run(scene, 20);
  auto& world = const_cast<World&>(done.simulation.world());
  ASSERT_EQ(world.population.submerged.size(), 1U);
  world.population.submerged[0].weight = 1e9;  // as if the whole hull were full of ice
  for (const double speed : {1e-3, 0.0, -1e-3}) {
    world.population.bodies.velocity[0] = {speed, 0};
    std::vector<HullLoads> loads(1);
    AuditSums audit;
    pull_of_submerged_ice(world.setup, world.population, loads, audit);
    EXPECT_NEAR(world.population.bodies.velocity[0].x, std::min(0.0, speed), 1e-18) << speed;
    EXPECT_NEAR(audit.energy.submerged_ice, speed > 0 ? 0.5 * 1e7 * speed * speed : 0, 1e-9);
  }
}

TEST(UnderHull, APieceComesUpBehindTheShipAsItsOwnChildWithoutItsRim) {
  const auto [simulation, story] = run(one_tile(0), 140);
  const auto up = story.resurfaced();
  ASSERT_EQ(up.size(), 1U);
  EXPECT_EQ(up[0].ice()->floe, 0);
  ASSERT_EQ(up[0].ice()->children.size(), 1U);
  EXPECT_GE(std::get<Resurface>(up[0].what).criterion.path, std::get<Resurface>(up[0].what).criterion.least_path);
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

TEST(UnderHull, WithoutScatterItComesUpInItsPlaceWhichGoesWithACurrent) {
  for (const double shear : {0.0, 0.001}) {
    Scene scene = one_tile(0).shear(shear, 0.5 * std::numbers::pi);
    scene.fracture.resurface.scatter = 0;
    const auto [simulation, story] = run(scene, 160);
    const auto up = story.resurfaced();
    ASSERT_EQ(up.size(), 1U);
    expect_closed(simulation);
    if (shear > 0) {
      EXPECT_GT(std::abs(up[0].point_in_world.y - story.submerged()[0].point_in_world.y), 0.05);
      continue;
    }
    const std::vector<FloeState> floes = simulation.floe_states();
    const auto state = std::ranges::find(floes, up[0].ice()->children[0], &FloeState::floe);
    ASSERT_NE(state, floes.end());
    EXPECT_LT(distance(transform(state->world_from_body, {2, 0}), up[0].point_in_world), 1e-9);
  }
}

TEST(UnderHull, APieceWithoutRoomWaitsAndThenStaysUnderTheIce) {
  // A floe as large as the hull and more lies where the piece would come up, as soon as the ship has gone.
  Scene scene = one_tile(0).without_drag().floe(rectangle(-400, -60, -122, 60), {1.5, 0});
  scene.fracture.resurface.give_up = 10;
  scene.fracture.resurface.scatter = 0;
  const auto [simulation, story] = run(scene, 220);
  const auto stays = story.stayed_under();
  ASSERT_EQ(stays.size(), 1U);
  EXPECT_GE(std::get<StayUnder>(stays[0].what).criterion.waited, 10);
  EXPECT_NEAR(std::get<StayUnder>(stays[0].what).under_ice_area, 16, 1e-9);
  EXPECT_NEAR(simulation.area_ledger().under_ice_area, 16, 1e-9);
  EXPECT_EQ(simulation.counts().stayed_under, 1);
  expect_closed(simulation);
}

TEST(UnderHull, AShipThatStopsKeepsItsIceAndOneThatBacksGivesItBack) {
  Scene scene = one_tile(0);
  scene.ships[0].propulsion = ConstantThrust{0};
  auto [simulation, story] = run(scene, 20);
  ASSERT_EQ(story.submerged().size(), 1U);
  auto& population = const_cast<World&>(simulation.world()).population;
  population.bodies.velocity[0] = {0, 0};
  EXPECT_TRUE(run(simulation, 60).resurfaced().empty());
  ASSERT_EQ(population.submerged.size(), 1U);
  const double path = population.submerged[0].path;
  population.bodies.velocity[0] = {-1, 0};
  const auto up = run(simulation, 60 + path + 30).resurfaced();
  ASSERT_EQ(up.size(), 1U);
  EXPECT_LT(std::get<Resurface>(up[0].what).criterion.path, 0);
}

TEST(UnderHull, AChannelFillsWithBrashAndAResumedRunGoesOnBitByBit) {
  Ship follower = with_draught(icebreaker({-140, 0}, ConstantSpeed{2}, 2));
  follower.name = "follower";
  const Scene scene = under(2).step(0.01).ship(follower).floe(rectangle(0, -60, 300, 60));
  const Simulation simulation = expect_resumes(scene, 90, 110).simulation;
  expect_closed(simulation);
  const Counts counts = simulation.counts();
  EXPECT_GT(counts.came_up, 50);
  EXPECT_GT(counts.went_under, counts.came_up);
  EXPECT_GT(simulation.world().population.submerged.size(), 50U);
}

/// The reference ship in a wide plate of a metre, by constant speed or thrust.
Build in_thick_ice(const Propulsion& propulsion, double speed, bool floods_decks) {
  Build scene = Build().step(0.01).ship(with_draught(icebreaker({-0.5, 0}, propulsion, speed)));
  scene.floe(rectangle(0, -150, 400, 150));
  scene.floes.back().is_fast = true;
  scene.ice.thickness = 1;
  scene.fracture.cusp_fate = CuspFate::kUnderHull;
  scene.fracture.splitting = fracture::SplittingModel::kNone;
  scene.fracture.floods_decks = floods_decks;
  return scene;
}

TEST(UnderHull, DecksThatWaterHasNotReachedBrakeAFastHullMore) {
  const auto of_decks = [](double speed) {
    const auto surge = [&](bool floods) {
      const Trial done = run(in_thick_ice(ConstantSpeed{speed}, speed, floods), 40 / speed);
      EXPECT_EQ(done.simulation.world().population.decks.empty(), !floods);
      return -mean(done.story, &HullSample::from_submerged, 0, 20 / speed);
    };
    return surge(true) - surge(false);
  };
  const double slow = of_decks(0.2);
  const double fast = of_decks(1);
  EXPECT_GT(slow, 0);
  EXPECT_GT(fast, 1.3 * slow);
}

TEST(UnderHull, DecksTakeTheirWorkFromAShipThatIsFree) {
  const Simulation simulation = run(in_thick_ice(ConstantThrust{3e5}, 1.5, true), 20).simulation;
  EXPECT_FALSE(simulation.world().population.decks.empty());
  expect_closed(simulation);
  EXPECT_GT(simulation.audit().sums.energy.submersion,
            run(in_thick_ice(ConstantThrust{3e5}, 1.5, false), 20).simulation.audit().sums.energy.submersion);
}

TEST(UnderHull, ARunWithDecksThatTurnGoesOnBitByBit) {
  const Simulation simulation = expect_resumes(in_thick_ice(ConstantSpeed{1}, 1, true), 15, 20).simulation;
  EXPECT_FALSE(simulation.world().population.decks.empty());
}

}  // namespace
}  // namespace polynya::simulation
