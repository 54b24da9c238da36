// External actions on ice: wind, skin drag and currents; the boundaries of ice: walls and structures; and fast ice.
#include <gtest/gtest.h>

#include "dynamics/contact/crush_law.hpp"
#include "simulation/world/step.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Point;
using geometry::Vector;

/// Returns the only floe of a scene.
FloeState only_floe(const Simulation& simulation) {
  return simulation.floe_states().front();
}

double mean_surge(const Story& story, int ship, double from) {
  return mean(story, &HullSample::from_ice, ship, from);
}

/// Water that drags at skins only, and a wind.
Build skin_drag(Build scene, double coefficient, Vector wind = {}) {
  scene.water.skin_drag_coefficient = coefficient;
  scene.wind.velocity = wind;
  return scene;
}

// ---- wind and skin drag

TEST(Wind, MovesAFloeAtTheSpeedOfTheClosedForm) {
  for (const double form : {0.0, 0.5}) {
    Scene scene = skin_drag(Build().step(0.5).floe(rectangle(-15, -15, 15, 15)), 0.004, {6, 8});
    scene.water.drag_coefficient = form;
    const Trial done = run(scene, 6000);
    const Vector velocity = only_floe(done.simulation).velocity;
    const double across = 30 * (0.6 + 0.8);  // of the square, across the wind
    const double water = 0.5 * 1000 * (0.004 * 900 + form * 0.5 * across);
    const double speed = std::sqrt(0.5 * 1.3 * 0.002 * 100 * 900 / water);
    EXPECT_NEAR(length(velocity) / speed, 1, 2e-3);
    EXPECT_NEAR(velocity.y / velocity.x, 8.0 / 6, 1e-9) << "it goes where the wind goes";
    if (form == 0) {
      EXPECT_NEAR(length(velocity) / 10, 0.025, 0.005) << "2 to 3 % of the wind";
    }
    expect_closed(done.simulation);
    EXPECT_GT(done.simulation.audit().sums.boundaries.wind, 0);
  }
}

TEST(Wind, CarriesIceOffInADriftAndLeavesFastIce) {
  const Build scene = Build().step(0.1).without_drag().drift({0.3, 0}).floe(rectangle(0, 0, 30, 30));
  const Trial done = run(skin_drag(Build(scene).floe(fast(rectangle(-100, 0, -70, 30))), 0.004, {0, 10}), 3000);
  const auto states = done.simulation.floe_states();
  EXPECT_NEAR(states[0].velocity.x, 0.3, 1e-9);
  EXPECT_NEAR(states[0].velocity.y, 0.25, 0.02);
  EXPECT_EQ(length(states[1].velocity), 0);
  expect_closed(done.simulation);
}

TEST(SkinDrag, SlowsAndStopsASpinAsTheClosedFormSays) {
  const Trial done =
      run(skin_drag(Build().step(0.1).without_drag().floe(shapes::regular(256, 20), {0.5, 0}, 0.05), 0.005), 200);
  const FloeState state = only_floe(done.simulation);
  // The closed form has dv/dt = −k v² with k = ½ C ρ_w / (ρ_i h), and dω/dt = −½ C ρ_w ∫r³ dA ω² / (½ m R²) with ∫r³ dA
  // = ⅖ π R⁵.
  const double k = 0.5 * 0.005 * 1000 / (900 * 0.5);
  EXPECT_NEAR(state.velocity.x * (1 + k * 0.5 * 200) / 0.5, 1, 1e-6);
  EXPECT_NEAR(state.angular_velocity * (1 + 0.8 * k * 20 * 0.05 * 200) / 0.05, 1, 1e-4);
  expect_closed(done.simulation);
}

TEST(Wind, PressesAPlateOnAStructureThatOtherwiseStopsForGood) {
  // The plate has 600 × 400 m and meets a cylinder of 10 m.
  const geometry::Polygon plate = rectangle(10.01, -200, 610.01, 200);
  Build scene = Build().unbreakable().step(0.02).pile({}, 10).floe(plate, {-0.1, 0});
  EXPECT_NEAR(mean_surge(run(scene, 60).story, 0, 40), 0, 1);
  const Trial windy = run(skin_drag(scene, 0.004, {-20, 0}), 120);
  const double by_wind = 0.5 * 1.3 * 0.002 * 400 * 240e3;
  EXPECT_NEAR(mean_surge(windy.story, 0, 60) / -by_wind, 1, 0.02);
  expect_closed(windy.simulation);
  scene.floes[0].velocity = {};
  const Trial carried = run(skin_drag(scene.drift({-0.4, 0}), 0.004), 120);  // which passes below the plate
  const double by_water = 0.5 * 1000 * 0.4 * 0.4 * (0.004 * 240e3 + 0.5 * 0.5 * 400);
  EXPECT_NEAR(mean_surge(carried.story, 0, 80) / -by_water, 1, 0.02);
  expect_closed(carried.simulation);
}

// ---- currents

TEST(Shear, AFloeAloneGoesWithTheCurrentAndTurnsAtHalfTheVorticity) {
  // The current u = s y along x has the vorticity −s. It has the same vorticity if it is turned by 30° and drifts;
  // without shear only the drift remains.
  for (const auto& [rate, direction] : {std::pair{0.01, 0.0}, {0.01, 30 * kDegree}, {0.0, 0.0}}) {
    const geometry::Rotation course = geometry::Rotation::by(direction);
    const Point at = Point{5, 7} + rotate(course, Vector{12, 40});
    const Vector drift{0.3, -0.2};
    const Trial done =
        run(Build().drift(drift).shear(rate, direction, {5, 7}).floe(rectangle(at.x - 4, at.y - 3, at.x + 4, at.y + 3)),
            60);
    const FloeState state = only_floe(done.simulation);
    EXPECT_NEAR(length(state.velocity - drift - rotate(course, {rate * 40, 0})), 0, 1e-12);
    EXPECT_NEAR(state.angular_velocity, -0.5 * rate, 1e-15);
    EXPECT_NEAR(state.angle, -0.5 * rate * 60, 1e-12);
  }
}

TEST(Shear, AFloeThatDoesNotGoWithItIsBroughtToItAsTheClosedFormSays) {
  // Along the stream its local current stays the same, so |v − u| = w₀ / (1 + k w₀ t), and so does its spin.
  Simulation simulation(Build().shear(0.01).floe(shapes::regular(64, 8, {0, 30}), {-0.8, 0}, 0.05));
  const dynamics::Bodies& bodies = simulation.world().population.bodies;
  const double width = 16;
  const double k = 0.5 * 1000 * 0.5 * width / (2 * bodies.mass[0]);
  const double spin_k = 0.5 * 1000 * 0.5 * bodies.drag[0]->rotational / (2 * bodies.moment[0]);
  for (const double t : {20.0, 200.0, 1500.0}) {
    run(simulation, t);
    const FloeState state = only_floe(simulation);
    EXPECT_NEAR((0.3 - state.velocity.x) * (1 + k * 0.8 * t) / 0.8, 1, 3e-3) << "a 64-gon's width is near 2 R";
    EXPECT_NEAR((state.angular_velocity + 0.005) * (1 + spin_k * 0.05 * t) / 0.05, 1, 1e-9);
    EXPECT_NEAR(state.velocity.y, 0, 1e-15);
  }
}

TEST(Shear, OnlyWhereTheWaterStandsStillDoesAFloeSleep) {
  // All floes are at rest in the water frame at the start. With 1e-5 1/s the current at a floe of 10 m at the origin is
  // below the rest speed, and at 100 m it is above.
  for (const double rate : {1e-5, 1e-2}) {
    Build scene = Build().shear(rate).floe(rectangle(-5, -5, 5, 5)).floe(rectangle(50, 100, 60, 110));
    Simulation simulation(scene.floe(rectangle(20, 20, 30, 30), {-rate * 25, 0}, 0.5 * rate));
    run(simulation, 2);
    const auto is_awake = [&](FloeId id) { return simulation.world().population.bodies.is_awake[id] != 0; };
    EXPECT_EQ(is_awake(0), rate == 1e-2) << "it turns with the water, faster than the rest speed at its rim";
    EXPECT_TRUE(is_awake(1));
    EXPECT_TRUE(is_awake(2)) << "at rest in the frame, yet the water takes it along";
    run(simulation, 50);
    EXPECT_GT(simulation.floe_states()[2].velocity.x, 0);
  }
}

/// If the drift is along the course, the ship is faster relative to the water by the drift. Forces, cracks and tracks
/// are the same, also in a sheared current.
TEST(Drift, IsTheSameSceneSeenFromAMovingFrame) {
  for (const double shear : {0.0, 2e-3}) {
    const auto seen_with = [&](double drift) {
      return run(Build()
                     .drift({drift, 0})
                     .shear(shear)
                     .ship(icebreaker({0, 0.7}, ConstantThrust{2e4}, 1 + drift))
                     .grid({1, -40}, 2, 6, 10, 13.5)
                     .floe(rectangle(30, -50, 80, 50)),
                 40);
    };
    const Trial still = seen_with(0), drifting = seen_with(-0.25);
    ASSERT_EQ(still.story.events.size(), drifting.story.events.size());
    EXPECT_GT(still.story.events.size(), 1u);
    ASSERT_EQ(still.story.samples.size(), drifting.story.samples.size());
    for (std::size_t i = 0; i < still.story.samples.size(); ++i) {
      const HullSample &p = still.story.samples[i], &q = drifting.story.samples[i];
      ASSERT_NEAR(p.from_ice.surge, q.from_ice.surge, 1e-6 * (1 + std::abs(p.from_ice.surge))) << p.time;
      ASSERT_NEAR(distance(p.position_in_world, q.position_in_world + Vector{0.25 * q.time, 0}), 0, 1e-9);
      ASSERT_NEAR(length(p.velocity_in_world - q.velocity_in_world - Vector{0.25, 0}), 0, 1e-12);
    }
    const std::vector<FloeState> p = still.simulation.floe_states(), q = drifting.simulation.floe_states();
    ASSERT_EQ(p.size(), q.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Point carried = q[i].world_from_body.position + Vector{0.25 * 40, 0};
      EXPECT_NEAR(distance(p[i].world_from_body.position, carried), 0, 1e-9);
      EXPECT_NEAR(p[i].angle, q[i].angle, 1e-12);
    }
  }
}

TEST(Structure, InADriftHasTheLoadsOfAPrescribedShipMovingThroughStillIce) {
  for (const double wall_angle : {0.0, 50 * kDegree}) {
    Build ice = Build().floe(rectangle(7, -40, 60, 40));
    for (int row = 0; row < 4; ++row) ice.floe(rectangle(62, -30 + 15 * row, 75, -17 + 15 * row));
    Build drifting = ice, still = ice;
    Ship ship = icebreaker({60, 3}, ConstantSpeed{0.7});
    ship.hull.waterline = cylinder_waterline(6);
    set_hull_angle(ship, wall_angle);
    ship.mass = ship.moment_of_inertia = std::numeric_limits<double>::infinity();
    const Story a = run(drifting.drift({-0.7, 0}).pile({0, 3}, 6, wall_angle), 60).story;
    const Story b = run(still.ship(ship), 60).story;
    ASSERT_EQ(a.samples.size(), b.samples.size());
    for (std::size_t i = 0; i < b.samples.size(); ++i) {
      const HullSample &p = a.samples[i], &q = b.samples[i];
      ASSERT_EQ(p.from_ice, q.from_ice);
      ASSERT_EQ(p.collision.surge, q.collision.surge);
      ASSERT_NEAR(distance(p.position_in_world, {0, 3}), 0, 1e-9) << "it stands where it stands";
      ASSERT_EQ(p.velocity_in_world, Vector{});
    }
    EXPECT_GT(largest(a, &HullSample::from_ice), 1e4);
    ASSERT_EQ(a.events.size(), b.events.size());
    EXPECT_EQ(!b.bends().empty(), wall_angle > 0) << "only a sloping wall presses the ice down";
  }
}

// ---- walls

/// Returns a block of ice of 40 × 20 m between a fixed wall and a wall that presses with 50 kN/m, turned by an angle.
Build squeezed(double angle, bool has_ice = true) {
  const geometry::Pose pose{{7, -3}, geometry::Rotation::by(angle)};
  const auto at = [&](double x, double y) { return transform(pose, Point{x, y}); };
  Build scene =
      Build().unbreakable().step(0.01).wall(at(-20, 0), at(20, 0)).wall(at(20, 20.05), at(-20, 20.05), pressing(5e4));
  scene.contact.tolerance = 1e-6;
  if (has_ice) scene.floe({{at(-20, 0.01), at(20, 0.01), at(20, 20), at(-20, 20)}, {}});
  return scene;
}

TEST(Wall, ThatPressesClosesUntilTheIceBearsItsLoad) {
  for (const double angle : {0.0, 30 * kDegree}) {
    Build scene = squeezed(angle);
    if (angle > 0) scene.drift({0.2, 0.1});
    const Trial done = run(scene, 60);
    const double load = 5e4 * 40;
    const double creep = 2 * dynamics::kCreepSpeed * load / (2.8e6 * 0.5 * 40);  // of both faces
    EXPECT_NEAR(mean_surge(done.story, 1, 40) / -load, 1, 0.01);
    if (angle == 0) {
      EXPECT_NEAR(mean_surge(done.story, 0, 40) / -load, 1, 0.01) << "the ice passes it on";
    }
    const HullState wall = done.simulation.ship_states()[1];
    EXPECT_LT(length(wall.velocity), 1.1 * creep) << "it came to rest";
    EXPECT_EQ(wall.angular_velocity, 0);
    expect_closed(done.simulation);
  }
}

TEST(Wall, ClosesAtItsSpeedWhereNothingBearsAndNeverSideways) {
  Simulation simulation(squeezed(0.3, false).drift({0.2, -0.3}).floe(rectangle(500, 500, 510, 510)));
  const Point before = simulation.ship_states()[1].world_from_ship.position;
  run(simulation, 20);
  const HullState wall = simulation.ship_states()[1];
  const Vector normal{std::cos(wall.heading), std::sin(wall.heading)};
  EXPECT_NEAR(dot(wall.velocity, normal), 0.1, 1e-6);
  EXPECT_NEAR(cross(wall.velocity, normal), 0, 1e-12);
  EXPECT_NEAR(cross(wall.world_from_ship.position - before, normal), 0, 1e-9);
  expect_closed(simulation);
}

TEST(Wall, ThatMovesPushesIceAlongAndDoesNotMeetOtherWalls) {
  const Trial done = run(Build()
                             .unbreakable()
                             .step(0.01)
                             .wall({0, 10}, {0, -10}, moving({0.2, 0}))
                             .wall({4, -20}, {4, 20})
                             .wall({-30, -9}, {30, -9})
                             .floe(rectangle(0.01, -8, 2, 8)),
                         2);
  EXPECT_NEAR(only_floe(done.simulation).velocity.x, 0.2, 1e-3);
  EXPECT_NEAR(done.simulation.ship_states()[0].world_from_ship.position.x, 0.4, 1e-9);
  EXPECT_TRUE(done.story.of_kind<HullContact>().empty()) << "walls cross at their ends";
  expect_closed(done.simulation);
}

TEST(Wall, GoesOnFromASavedStateAsItWould) {
  expect_closed(expect_resumes(skin_drag(squeezed(0.4), 0.004, {5, 5}), 5, 10).simulation);
}

/// The reference ship at a crawl, ice of 10 m along both bow flanks and both sides, and a wall behind each,
/// parallel to the hull: R = q [B + 2 μ (L_bow + L_par)].
TEST(LinePressure, OnAShipsBowAndSidesIsThatOfTheClosedForm) {
  constexpr double kLoad = 5e4;
  constexpr double kGap = 10;  // distance from hull to wall [m]
  const Ship ship = steep_icebreaker({60, 0}, ConstantSpeed{0.005}, 0.005);
  const geometry::Ring& hull = ship.hull.waterline;
  Build scene = Build().unbreakable().step(0.01).ship(ship);
  scene.contact.tolerance = 1e-5;
  for (const auto& [i, k] : {std::pair{0, 1}, {1, 2}, {3, 4}, {4, 0}}) {
    const Vector out = -perpendicular(hull[k] - hull[i]) / distance(hull[i], hull[k]);
    const auto beside = [&](Point p, double off) { return p + off * out; };
    scene.floe({{beside(hull[i], 0.001), beside(hull[i], kGap), beside(hull[k], kGap), beside(hull[k], 0.001)}, {}});
    scene.wall(beside(hull[i], kGap + 0.001), beside(hull[k], kGap + 0.001), pressing(kLoad));
  }
  const Trial done = run(scene, 60);
  EXPECT_NEAR(mean_surge(done.story, 0, 30) / -(kLoad * (24 + 2 * scene.ice.friction * 120)), 1, 0.03);
  expect_closed(done.simulation);
}

// ---- fast ice

Build in_ice(const Propulsion& propulsion, const FloeSpec& ice) {
  return Build().step(0.01).ship(icebreaker({-0.5, 0}, propulsion)).floe(ice);
}

const FloeSpec kFastPlate = fast(rectangle(0, -60, 200, 60));

/// The only floe that is fast.
FloeId fast_floe(const Population& population) {
  std::vector<FloeId> found;
  for (FloeId id = 0; id < population.floe_count(); ++id)
    if (population.is_floating(id) && population.is_fast(id)) found.push_back(id);
  return only(found);
}

TEST(FastIce, StaysWhereAShipThrustsIntoIt) {
  const Trial done = run(in_ice(ConstantThrust{5e5}, kFastPlate), 30);
  ASSERT_GT(done.simulation.counts().bends, 5);
  const Population& population = done.simulation.world().population;
  const dynamics::Bodies& bodies = population.bodies;
  const BodyIndex body = population.body_of(fast_floe(population));
  EXPECT_EQ(bodies.velocity[body], Vector{});
  EXPECT_EQ(bodies.position[body], bodies.centroid[body]) << "its frame has not moved";
  EXPECT_LT(mean_surge(done.story, 0, 0), -1e4);
  expect_closed(done.simulation);
}

TEST(FastIce, LoadsAShipAtConstantSpeedAsAPlateTooHeavyToMoveDoes) {
  const Trial held = run(in_ice(ConstantSpeed{1}, fast(rectangle(0, -300, 600, 300))), 40);
  const Trial heavy = run(in_ice(ConstantSpeed{1}, floe(rectangle(0, -1500, 3000, 1500))), 40);
  EXPECT_LT(mean_surge(heavy.story, 0, 0), -1e4);
  EXPECT_NEAR(mean_surge(held.story, 0, 0) / mean_surge(heavy.story, 0, 0), 1, 0.05);
  const auto bends_of_held = static_cast<double>(held.simulation.counts().bends);
  EXPECT_GT(bends_of_held, 10);
  EXPECT_NEAR(bends_of_held / static_cast<double>(heavy.simulation.counts().bends), 1, 0.1);
  expect_closed(held.simulation);
}

TEST(FastIce, ItsPiecesAreFreeAndMoveOnAsItDid) {
  auto [simulation, story] = run_to_first_event(in_ice(ConstantSpeed{1}, fast(kFastPlate.polygon_in_world, {-0.3, 0.1}))
                                                    .drift({0.05, 0})
                                                    .without_drag()
                                                    .cusps(CuspFate::kFloat),
                                                20);
  const Population& population = simulation.world().population;
  const auto velocity = [&](FloeId floe) { return population.bodies.velocity[population.body_of(floe)]; };
  const Event bend = only(story.bends());
  ASSERT_GE(bend.ice()->children.size(), 2u);
  for (const FloeId child : bend.ice()->children) {
    EXPECT_EQ(population.is_fast(child), child == fast_floe(population));
    EXPECT_NEAR(length(velocity(child) - Vector{-0.35, 0.1}), 0, 1e-12);
  }
  run(simulation, 10);
  expect_closed(simulation);
  EXPECT_EQ(velocity(fast_floe(population)), (Vector{-0.35, 0.1}));
}

TEST(Cusp, WhoseFirstTouchHasBrokenOffIsCentredAtTheIceNearestToTheContact) {
  World world(in_ice(ConstantSpeed{8}, kFastPlate));
  dynamics::PersistentContact record;
  PendingFracture pending;
  pending.failure = fracture::Failure::kBend;
  pending.floe = 0;
  pending.point_in_water = {-3, 5};
  pending.first_touch_in_body = {-4, 0};  // with the radius below, it reaches no ice
  pending.normal = {1, 0};
  pending.cusp_radius = 2;
  pending.penetration = 3;
  pending.record = &record;
  world.data.fractures = {pending};
  world.data.loads.resize(1);
  apply_fractures(world.setup, world.last_step, world.data, world.population, {world.accounts, world.journal});
  EXPECT_EQ(world.accounts.counts.bends, 1);
  EXPECT_EQ(world.accounts.counts.rejected_cuts, 0);
  EXPECT_FALSE(record.was_refused);
  EXPECT_NEAR(world.accounts.areas.submerged, std::numbers::pi * 2, 0.1) << "half a disc about (0, 5)";
}

TEST(FastIce, IsSavedWithItsPieces) {
  const Scene scene = in_ice(ConstantSpeed{1}, kFastPlate);
  const Trial again = expect_resumes(scene, 12, 20);
  EXPECT_GT(run(scene, 12).simulation.counts().bends, 1);
  EXPECT_NE(fast_floe(again.simulation.world().population), 0) << "a piece of the scene's floe";
}

// Ships, structures and walls are hulls. Properties that they share are addressed by the number of the hull.

TEST(Hulls, AreNumberedShipsFirstThenStructuresThenWallsAndFloesFollow) {
  Scene scene = Build()
                    .ship(icebreaker({0, 0}, ConstantThrust{0}))
                    .ship(barge({0, 300}, ConstantSpeed{1}))
                    .pile({200, 0}, 5)
                    .wall({-500, -500}, {500, -500})
                    .floe(rectangle(300, 0, 310, 10));
  scene.walls[0].name = "south";
  const Simulation simulation(scene);
  const Population& population = simulation.world().population;
  ASSERT_EQ(population.hull_count, 4);
  const std::pair<const char*, BodyKind> hulls[] = {{"icebreaker", BodyKind::kShip},
                                                    {"barge", BodyKind::kShip},
                                                    {"structure", BodyKind::kStructure},
                                                    {"south", BodyKind::kWall}};
  for (BodyIndex i = 0; i < 4; ++i) {
    const auto& [name, kind] = hulls[i];
    EXPECT_EQ(hull_of(scene, i).name, name);
    EXPECT_EQ(hull_named(scene, name), i);
    EXPECT_EQ(kind_of_hull(scene, i), kind);
    EXPECT_EQ(population.kind(i), kind);
    EXPECT_TRUE(population.is_hull(i));
    EXPECT_EQ(population.bodies.position[i], hull_of(scene, i).position_in_world);
    EXPECT_EQ(population.bodies.inverse_mass[i] == 0, i > 0) << "only the icebreaker can be pushed";
  }
  EXPECT_EQ(hull_named(scene, "north"), -1);
  EXPECT_EQ(population.kind(population.body_of(0)), BodyKind::kFloe);
  EXPECT_EQ(population.helms.size(), 2U) << "only ships are steered";
}

}  // namespace
}  // namespace polynya::simulation
