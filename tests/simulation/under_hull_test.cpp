// Ice under a hull: floes that tilt, submerged pieces that brake the ship, and pieces that surface behind it.
#include <algorithm>

#include <gtest/gtest.h>

#include "fracture/turning_cusp.hpp"
#include "geometry/cut/cut.hpp"
#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "simulation/ice/turning.hpp"
#include "simulation/world/step.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

/// Returns the reference ship at constant speed in ice that goes under it.
Build under(double speed = 1) {
  return Build().ship(with_draught(icebreaker({-0.5, 0}, ConstantSpeed{speed}, speed))).under_hulls();
}

/// A floe that lies on a plate too large to move, ahead of the stem; nothing breaks.
Build pinned(const geometry::Polygon& floe, const geometry::Polygon& plate) {
  return under().thickness(1).unbreakable().floe(floe).floe(plate);
}

Build pinned_floe() {
  return pinned(rectangle(0, -6, 12, 6), rectangle(12.01, -150, 400, 150));
}

/// Returns a scene with a small piece of 16 m², to port of the centre line by y.
Build one_tile(double y) {
  Build scene = pinned(rectangle(0, y - 2, 4, y + 2), rectangle(4.01, -150, 100, 150));
  scene.ships[0].hull.has_speed_factor = false;
  return scene;
}

TEST(UnderHull, AFloeBetweenAnInclinedHullAndAPlateTiltsAndGoesUnder) {
  const auto [simulation, story] = run(pinned_floe(), 20);
  ASSERT_FALSE(story.submerged().empty());
  const auto first = std::get<Submerge>(story.submerged()[0].what);
  EXPECT_EQ(first.floe, 0);
  EXPECT_GE(first.criterion.deflection, first.criterion.least_deflection);
  EXPECT_NEAR(first.criterion.least_deflection, 0.9, 1e-12);
  EXPECT_NEAR(first.under_hull_area, 144, 1e-9);
  EXPECT_EQ(simulation.counts().tilted_under, std::ssize(story.submerged()));
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
    pull_of_submerged_ice(world.setup, world.last_step, world.population, loads, audit);
    EXPECT_NEAR(world.population.bodies.velocity[0].x, std::min(0.0, speed), 1e-18) << speed;
    EXPECT_NEAR(audit.energy.submerged_ice, speed > 0 ? 0.5 * 1e7 * speed * speed : 0, 1e-9);
  }
}

TEST(UnderHull, APieceTakesItsWeightTimesTheWayUpAndAlongTheHullAndComesUpBehindTheShipWithoutItsRim) {
  const auto [simulation, story] = run(one_tile(0), 140);
  EXPECT_EQ(story.submerged().size(), 1U);
  double work = 0;
  for (const HullSample& sample : story.samples) work -= sample.from_submerged.surge * 0.1;  // at 1 m/s
  const double weight = 100 * 9.81 * 16;
  const dynamics::SubmersionPath& path = simulation.world().setup.underwater[0].path;
  EXPECT_NEAR(work, weight * (path.rise + 0.2 * path.sliding), 1e-9 * work);
  const auto up = std::get<Resurface>(only(story.resurfaced()).what);
  EXPECT_EQ(up.floe, 0);
  EXPECT_GE(up.criterion.path, up.criterion.least_path);
  EXPECT_NEAR(up.brash_area, 0.05 * 16, 1e-9);
  const Birth& born = story.births.back();
  EXPECT_EQ(born.floe, only(up.children));
  EXPECT_EQ(born.parent, 0);
  EXPECT_EQ(born.generation, 1);
  EXPECT_NEAR(born.area, 0.95 * 16, 1e-9);
  EXPECT_EQ(simulation.counts().came_up, 1);
  EXPECT_EQ(simulation.area_ledger().under_hulls, 0);
  expect_closed(simulation);
}

TEST(UnderHull, WithoutScatterItComesUpInItsPlaceWhichGoesWithACurrent) {
  for (const double shear : {0.0, 0.001}) {
    Scene scene = one_tile(0).shear(shear, 0.5 * std::numbers::pi);
    scene.fracture.resurface.scatter = 0;
    const auto [simulation, story] = run(scene, 160);
    const Event up = only(story.resurfaced());
    expect_closed(simulation);
    if (shear > 0) {
      EXPECT_GT(std::abs(up.point_in_world.y - story.submerged()[0].point_in_world.y), 0.05);
      continue;
    }
    const std::vector<FloeState> floes = simulation.floe_states();
    const auto state = std::ranges::find(floes, up.ice()->children[0], &FloeState::floe);
    ASSERT_NE(state, floes.end());
    EXPECT_LT(distance(transform(state->world_from_body, {2, 0}), up.point_in_world), 1e-9);
  }
}

TEST(UnderHull, APieceWithoutRoomWaitsAndThenStaysUnderTheIce) {
  // A floe larger than the hull covers the place where the piece would surface, as soon as the ship has left it.
  Scene scene = one_tile(0).without_drag().floe(rectangle(-400, -60, -122, 60), {1.5, 0});
  scene.fracture.resurface.give_up = 10;
  scene.fracture.resurface.scatter = 0;
  const auto [simulation, story] = run(scene, 220);
  const auto stays = std::get<StayUnder>(only(story.stayed_under()).what);
  EXPECT_GE(stays.criterion.waited, 10);
  EXPECT_NEAR(stays.under_ice_area, 16, 1e-9);
  EXPECT_NEAR(simulation.area_ledger().under_ice, 16, 1e-9);
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
  const Event up = only(run(simulation, 60 + path + 30).resurfaced());
  EXPECT_LT(std::get<Resurface>(up.what).criterion.path, 0);
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
  Build scene = Build()
                    .step(0.01)
                    .thickness(1)
                    .without_splits()
                    .cusps(CuspFate::kUnderHull)
                    .ship(with_draught(icebreaker({-0.5, 0}, propulsion, speed)))
                    .floe(fast(rectangle(0, -150, 400, 150)));
  scene.fracture.floods_decks = floods_decks;
  return scene;
}

TEST(UnderHull, DecksThatWaterHasNotReachedBrakeAFastHullMore) {
  const auto of_decks = [](double speed) {
    const auto surge = [&](bool floods) {
      Scene scene = in_thick_ice(ConstantSpeed{speed}, speed, floods);
      scene.ships[0].hull.has_speed_factor = false;  // without decks it multiplies more of the force
      const Trial done = run(scene, 40 / speed);
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

TEST(UnderHull, WhereDecksFloodTheFactorOfSpeedIsLeftForTheFrictionBehindTheBowAlone) {
  const auto by_factor = [](bool floods, double from, double until) {
    const auto surge = [&](bool has_factor) {
      Scene scene = in_thick_ice(ConstantSpeed{1}, 1, floods);
      scene.ships[0].hull.has_speed_factor = has_factor;
      return -mean(run(scene, until).story, &HullSample::from_submerged, 0, from);
    };
    return surge(true) - surge(false);
  };
  // The stem is in the ice from 0.5 s on. The bow is 10.4 m long, so that nothing is behind it before 10.9 s.
  EXPECT_EQ(by_factor(true, 0, 10), 0);
  EXPECT_GT(by_factor(false, 0, 10), 100);
  const double whole = by_factor(false, 20, 30);
  const double left = by_factor(true, 20, 30);
  EXPECT_GT(left, 0);
  EXPECT_LT(left, 0.6 * whole);  // of the first pieces, 20 to 30 m behind the stem
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

// ---- overlap of ice that gives way is booked as tilted; no floe lies in a hull for the most part, or on both sides of
// it

/// A ship with a draught at constant speed, whose stem leans that far from the horizontal, before thick ice that does
/// not bend.
Build thick_ice(double stem_angle, double speed) {
  Ship ship = icebreaker({0, 0}, ConstantSpeed{speed}, speed);
  ship.hull.draught = 5.5;
  ship.hull.stem_angle = stem_angle;
  Build scene = Build().step(0.005).unbreakable().thickness(1.6).ship(ship);
  scene.fracture.going_under.is_enabled = true;
  return scene;
}

/// The scene of five trials in which floes of 2.5 m, and one of 3 x 24 m across the stem, were entirely or mostly
/// inside the hull.
Build floes_before_the_stem(double stem_angle) {
  return thick_ice(stem_angle, 1.5)
      .floe(rectangle(0.2, -1.25, 2.7, 1.25))
      .floe(rectangle(3, -1.25, 5.5, 1.25))
      .floe(rectangle(3, 2, 5.5, 4.5))
      .floe(rectangle(3, -4.5, 5.5, -2));
}

Build floe_across_the_stem() {
  return thick_ice(24.5 * kDegree, 1.5).floe(rectangle(0.2, -12, 3.2, 12));
}

geometry::Polygon hull_of_ship(const Simulation& simulation) {
  return {simulation.scene().ships[0].hull.waterline, {}};
}

/// The largest share of a floe that the ship covers.
double most_covered(const Simulation& simulation) {
  double most = 0;
  const geometry::Polygon hull = hull_of_ship(simulation);
  for (const FloeState& floe : simulation.floe_states()) {
    const auto shared = geometry::shared_area(*floe.polygon_in_body, floe.world_from_body, hull,
                                              simulation.ship_states()[0].world_from_ship);
    most = std::max(most, shared.value() / floe.area);
  }
  return most;
}

/// Returns the largest number of floes that the ship's waterline would make of one floe.
int most_parts(const Simulation& simulation) {
  int most = 0;
  for (const FloeState& floe : simulation.floe_states()) {
    const geometry::Pose floe_from_ship =
        relative_pose(floe.world_from_body, simulation.ship_states()[0].world_from_ship);
    const geometry::CutOutcome cut =
        cut_by_polygon({.polygon = *floe.polygon_in_body}, transform(floe_from_ship, hull_of_ship(simulation)));
    int parts = 0;
    if (cut)
      for (const geometry::Piece& piece : cut->pieces)
        parts += piece.part == geometry::Part::kOutside && geometry::measure(piece.shape.polygon).area > 1;
    most = std::max(most, parts);
  }
  return most;
}

CrushedOverlap overlap_with(const Simulation& simulation, FloeId floe) {
  for (const CrushedOverlap& overlap : simulation.crushed_overlaps())
    if (overlap.on.ship == 0 && overlap.by.floe == floe) return overlap;
  return {};
}

TEST(Tilted, TheOverlapOfAFloeThatTiltsIsNotBookedAsCrushed) {
  Simulation simulation(floes_before_the_stem(24.5 * kDegree));
  const fracture::Ice ice = simulation.scene().ice;
  CrushedOverlap last;
  Story story;
  while (simulation.time() < 10 && story.submerged().empty()) {
    last = overlap_with(simulation, 0);
    simulation.step();
    listen(simulation, story);
  }
  EXPECT_EQ(only(story.submerged()).ice()->floe, 0);
  const double if_crushed = ice.compressive_strength * ice.thickness * (last.area + last.tilted);
  EXPECT_GT(last.tilted, 2 * last.area);
  EXPECT_GT(if_crushed, 10 * last.work);
  expect_closed(simulation);
}

/// An inclined hull crushes a wedge of ice, which is less than the area of the overlap times the thickness.
TEST(Tilted, CrushedIceIsWhatTheWorkCrushes) {
  for (const double angle : {0.0, 20 * kDegree, 50 * kDegree}) {
    const Simulation simulation =
        run(Build().without_drag().unbreakable().pile({0, 0}, 10, angle).floe(rectangle(10.001, -40, 50, 40), {-1, 0}),
            0.8)
            .simulation;
    const CrushedOverlap overlap = overlap_with(simulation, 0);
    const double all = simulation.scene().ice.thickness * overlap.area;
    EXPECT_GT(overlap.area, 0.5) << angle;
    EXPECT_EQ(overlap.tilted, 0);
    EXPECT_NEAR(overlap.work / (simulation.scene().ice.compressive_strength * overlap.volume), 1, 0.05) << angle;
    if (angle == 0)
      EXPECT_NEAR(overlap.volume / all, 1, 1e-9);
    else
      EXPECT_LT(overlap.volume, 0.95 * all);
  }
}

/// An edge that is too strong to break bends away from the hull. Less of the overlap is crushed, exactly as much as the
/// work crushes.
TEST(Tilted, OfAnEdgeThatBendsTheIceIsCrushedThatTheHullHasPenetrated) {
  Build scene = Build().without_drag().without_splits().step(0.005).pile({0, 0}, 10, 45 * kDegree);
  scene.ice.flexural_strength = 1e9;
  const Simulation simulation = run(scene.floe(rectangle(10.001, -100, 210, 100), {-1, 0}), 0.8).simulation;
  const CrushedOverlap overlap = overlap_with(simulation, 0);
  EXPECT_EQ(simulation.counts().bends, 0);
  EXPECT_GT(overlap.tilted, 0.1 * overlap.area);
  EXPECT_NEAR(overlap.work / (simulation.scene().ice.compressive_strength * overlap.volume), 1, 0.01);
}

TEST(Tilted, NoFloeFloatsOfWhichAHullCoversMost) {
  for (const double stem_angle : {16 * kDegree, 24.5 * kDegree, 43 * kDegree}) {
    const auto [simulation, story] = run(floes_before_the_stem(stem_angle), 10, [](const Simulation& s) {
      EXPECT_LT(most_covered(s), 0.52) << "a contact is found a step late; at " << s.time();
    });
    ASSERT_FALSE(story.submerged().empty());
    expect_closed(simulation);
    if (stem_angle > 16 * kDegree) continue;
    const TiltCriterion criterion = std::get<Submerge>(story.submerged()[0].what).criterion;
    EXPECT_LT(criterion.deflection, criterion.least_deflection) << "it goes under before its edge is deep";
    EXPECT_NEAR(criterion.covered_share, 0.5, 0.02);
  }
}

TEST(Tilted, NoFloeStaysOneThatAHullHasCutInTwo) {
  double in_two_since = 0;
  const Trial done = run(floe_across_the_stem(), 15, [&](const Simulation& s) {
    if (most_parts(s) < 2) in_two_since = s.time();
    EXPECT_LE(s.time() - in_two_since, 0.3);
  });
  expect_closed(done.simulation);
}

TEST(Tilted, IsBookedAlikeWhereARunIsResumed) {
  EXPECT_FALSE(
      expect_resumes(floes_before_the_stem(24.5 * kDegree), 0.7, 1.5, 2).simulation.crushed_overlaps().empty());
}

/// A light ship that sets a heavy cusp in motion loses the momentum that she gives. Afterwards the edge moves as fast
/// as the hull slides it down.
TEST(TurningCusp, MovesOnWithTheHullThatItSlows) {
  const double speed = 2, slope = 0.8;
  Ship light = with_draught(icebreaker({0, 0}, ConstantThrust{0}, speed));
  light.mass = 2e4, light.moment_of_inertia = 1e7;
  Build scene = Build().cusps(CuspFate::kUnderHull).ship(light).floe(rectangle(0.1, -50, 100, 50));
  scene.fracture.floods_decks = false;
  World world(scene);
  PendingFracture bend;
  bend.normal = {1, 0};
  bend.driven_edge = {.speed = slope * speed, .speed_per_approach = slope, .horizontal = {0.9, 0}, .hull_angle = 0.7};
  const dynamics::Bodies& bodies = world.population.bodies;
  geometry::CutResult cut;
  cut.pieces.push_back({{rectangle(0.1, -6, 6.1, 6)}, geometry::Part::kInside});
  const fracture::Ice ice;
  const double mass = fracture::edge_mass(ice, world.setup.scene.water.water, {72, 6, 12 * 6. * 6 * 6 / 3});
  HullLoads loads;
  bend.criteria.bending_capacity = 1e12;  // all of it in one step
  Step step;
  step.length = 0.01;
  start_cusp(step, bend, pressed_mass(world.setup, world.population, bend, cut), world.population,
             {loads, world.accounts.audit});
  const double given = (speed - bodies.velocity[0].x) * light.mass / 0.9;  // down on the edge [N s]
  EXPECT_NEAR(given / mass, slope * bodies.velocity[0].x, 1e-9 * speed);
  EXPECT_LT(bodies.velocity[0].x, 0.6 * speed) << "the cusp should weigh as much as the ship";
  EXPECT_GT(bodies.velocity[0].x, 0);
}

}  // namespace
}  // namespace polynya::simulation
