// A sheared current, and what stands still in a drift.
#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Point;
using geometry::Vector;

geometry::Polygon disc(Point centre, double radius) {
  geometry::Polygon polygon;
  for (int i = 0; i < 64; ++i) {
    const geometry::Rotation r = geometry::Rotation::by(2 * std::numbers::pi * i / 64);
    polygon.outer.push_back(centre + radius * Vector{r.cosine, r.sine});
  }
  return polygon;
}

Scene sheared(double rate, double direction = 0, Point origin = {}) {
  Scene scene = paper_scene();
  scene.water.shear = {rate, direction, origin};
  return scene;
}

TEST(Shear, AFloeAloneGoesWithTheCurrentAndTurnsAtHalfTheVorticity) {
  // u = s y along x: vorticity −s. Turned by 30° and drifting, the same.
  for (const double direction : {0.0, 30 * kDegree}) {
    Scene scene = sheared(0.01, direction, {5, 7});
    scene.water.drift = {0.3, -0.2};
    const geometry::Rotation course = geometry::Rotation::by(direction);
    const Vector to_floe = rotate(course, Vector{12, 40});
    scene.floes = {
        floe(rectangle(5 + to_floe.x - 4, 7 + to_floe.y - 3, 5 + to_floe.x + 4, 7 + to_floe.y + 3))};
    Simulation simulation(scene);
    run(simulation, 60);
    const FloeState state = simulation.floe_states().front();
    const Vector expected = scene.water.drift + rotate(course, {0.01 * 40, 0});
    EXPECT_NEAR(length(state.velocity - expected), 0, 1e-12);
    EXPECT_NEAR(state.angular_velocity, -0.005, 1e-15);
    EXPECT_NEAR(state.angle, -0.005 * 60, 1e-12);
  }
}

TEST(Shear, AFloeThatDoesNotGoWithItIsBroughtToItAsTheClosedFormSays) {
  // Along the stream its local current stays the same, so |v − u| = w₀ / (1 + k w₀ t), and so does its spin.
  Scene scene = sheared(0.01);
  scene.floes = {floe(disc({0, 30}, 8), {-0.8, 0}, 0.05)};
  Simulation simulation(scene);
  const World& world = simulation.world();
  const double width = 16;
  const double k = 0.5 * 1000 * 0.5 * width / (2 * world.population.bodies.mass[0]);
  const double spin_k = 0.5 * 1000 * 0.5 * world.population.bodies.drag[0]->rotational /
                        (2 * world.population.bodies.moment[0]);
  for (const double t : {20.0, 200.0, 1500.0}) {
    run(simulation, t);
    const FloeState state = simulation.floe_states().front();
    EXPECT_NEAR((0.3 - state.velocity.x) * (1 + k * 0.8 * t) / 0.8, 1, 3e-3)
        << "a 64-gon's width is near 2 R";
    EXPECT_NEAR((state.angular_velocity + 0.005) * (1 + spin_k * 0.05 * t) / 0.05, 1, 1e-9);
    EXPECT_NEAR(state.velocity.y, 0, 1e-15);
  }
}

TEST(Shear, OnlyWhereTheWaterStandsStillDoesAFloeSleep) {
  // All at rest in the water frame at the start. 1e-5 1/s: at the origin a floe of 10 m feels less than the
  // rest speed, at 100 m more.
  for (const double rate : {1e-5, 1e-2}) {
    Scene scene = sheared(rate);
    scene.floes = {floe(rectangle(-5, -5, 5, 5)), floe(rectangle(50, 100, 60, 110)),
                   floe(rectangle(20, 20, 30, 30), {-rate * 25, 0}, 0.5 * rate)};
    Simulation simulation(scene);
    run(simulation, 1);
    const auto is_awake = [&](FloeId id) { return simulation.world().population.bodies.is_awake[id] != 0; };
    EXPECT_EQ(is_awake(0), rate == 1e-2) << "it turns with the water, faster than the rest speed at its rim";
    EXPECT_TRUE(is_awake(1));
    EXPECT_TRUE(is_awake(2)) << "at rest in the frame, yet the water takes it along";
    run(simulation, 50);
    EXPECT_GT(simulation.floe_states()[2].velocity.x, 0);
  }
}

TEST(Shear, TheUniformPartIsOnlyAMovingFrame) {
  Scene still = sheared(0.004, 0, {0, 20});
  still.floes = {floe(rectangle(0, 0, 12, 9)), floe(rectangle(-14, 11, -1, 22)),
                 floe(rectangle(13, -11, 25, -1))};
  Scene drifting = still;
  drifting.water.drift = {0.5, 0.25};
  Simulation a(still);
  Simulation b(drifting);
  run(a, 200);
  run(b, 200);
  EXPECT_GT(a.counts().peak_contacts, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    const FloeState p = a.floe_states()[i];
    const FloeState q = b.floe_states()[i];
    EXPECT_NEAR(distance(p.world_from_body.position + 200 * Vector{0.5, 0.25}, q.world_from_body.position), 0,
                1e-9);
    EXPECT_EQ(p.angle, q.angle) << "the water frame's numbers are the same to the last bit";
  }
}

TEST(Structure, InADriftHasTheLoadsOfAPrescribedShipMovingThroughStillIce) {
  for (const double wall_angle : {0.0, 50 * kDegree}) {
    Scene drifting;
    drifting.water.drift = {-0.7, 0};
    drifting.structures = {pile({0, 3}, 6, wall_angle)};
    drifting.floes = {floe(rectangle(7, -40, 60, 40))};
    for (int row = 0; row < 4; ++row)
      drifting.floes.push_back(floe(rectangle(62, -30 + 15 * row, 75, -17 + 15 * row)));
    Scene still = drifting;
    still.water.drift = {};
    still.structures.clear();
    Ship& moving = still.ships.emplace_back();
    static_cast<PlacedHull&>(moving) = drifting.structures[0];
    moving.propulsion = ConstantSpeed{0.7};
    moving.mass = moving.moment_of_inertia = std::numeric_limits<double>::infinity();
    Simulation a(drifting);
    Simulation b(still);
    const Story seen_drifting = run(a, 60);
    const Story seen_still = run(b, 60);
    ASSERT_EQ(seen_drifting.samples.size(), seen_still.samples.size());
    double most = 0;
    for (std::size_t i = 0; i < seen_still.samples.size(); ++i) {
      const ShipSample& p = seen_drifting.samples[i];
      const ShipSample& q = seen_still.samples[i];
      ASSERT_EQ(p.from_ice.surge, q.from_ice.surge);
      ASSERT_EQ(p.from_ice.sway, q.from_ice.sway);
      ASSERT_EQ(p.from_ice.yaw, q.from_ice.yaw);
      ASSERT_EQ(p.collision.surge, q.collision.surge);
      ASSERT_NEAR(distance(p.position_in_world, {0, 3}), 0, 1e-9) << "it stands where it stands";
      ASSERT_EQ(p.velocity_in_world, Vector{});
      most = std::max(most, std::abs(p.from_ice.surge));
    }
    EXPECT_GT(most, 1e4);
    ASSERT_EQ(seen_drifting.events.size(), seen_still.events.size());
    const bool has_bent = std::ranges::any_of(seen_still.events, [](const Event& e) { return e.is<Bend>(); });
    EXPECT_EQ(has_bent, wall_angle > 0) << "only a sloping wall presses the ice down";
  }
}

}  // namespace
}  // namespace polynya::simulation
