// Collisions that crush, step by step: what they end with, how long they take, and that both converge.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/dynamics/scenery.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

constexpr double kSpeed = 0.5;

/// A square floe standing on its corner, the corner towards −x at `tip`.
geometry::Polygon diamond(geometry::Point tip, double half_diagonal) {
  const double d = half_diagonal;
  return {{tip, {tip.x + d, tip.y - d}, {tip.x + 2 * d, tip.y}, {tip.x + d, tip.y + d}}, {}};
}

/// A floe's corner runs into a fixed ship, along the normal of its flat bow.
Scene corner_into_bow(double hull_angle, double speed, double density, double step) {
  Scene scene = without_drag();
  scene.time.step = step;
  scene.ice.density = density;
  scene.fracture.breakable_size_factor = 1e6;
  scene.contact.restitution = 0;
  scene.ships = {barge({0, 0}, ConstantSpeed{0}, 0)};
  scene.ships[0].hull.angles_from_vertical = {hull_angle, hull_angle, hull_angle, hull_angle};
  scene.floes = {floe(diamond({0.01 * speed, 0}, 7), {-speed, 0})};
  return scene;
}

/// From first contact to the end of the approach [s].
double compression_time(const Scene& scene) {
  Simulation simulation(scene);
  double start = -1;
  for (int step = 0; step < 200000; ++step) {
    simulation.step();
    if (start < 0 && !simulation.world().step.contacts.empty()) start = simulation.time();
    if (start >= 0 && simulation.floe_states()[0].velocity.x >= -1e-9) return simulation.time() - start;
  }
  return -1;
}

TEST(CrushingCollision, TakesMassToTheThirdOverSpeedToTheThirdAtAnInclinedHull) {
  // F = k ξ²: the time of compression goes as (m / k v)^⅓.
  const double angle = 60 * kDegree;
  const double base = compression_time(corner_into_bow(angle, kSpeed, 900, 5e-4));
  const double heavy = compression_time(corner_into_bow(angle, kSpeed, 7200, 5e-4));
  const double fast = compression_time(corner_into_bow(angle, 8 * kSpeed / 4, 900, 5e-4));
  const double slow = compression_time(corner_into_bow(angle, kSpeed / 4, 900, 5e-4));
  std::printf("compression %.4f s; exponents: mass %.4f, speed %.4f\n", base,
              std::log(heavy / base) / std::log(8), std::log(fast / slow) / std::log(8));
  EXPECT_NEAR(std::log(heavy / base) / std::log(8), 1.0 / 3, 0.01);
  EXPECT_NEAR(std::log(fast / slow) / std::log(8), -1.0 / 3, 0.01);
}

TEST(CrushingCollision, TakesTheRootOfTheMassAtAVerticalWallWhateverTheSpeed) {
  // F = σ_c h T ξ, a spring: a quarter of its period, π/2 √(m / σ_c h T), T = 2.
  const double base = compression_time(corner_into_bow(0, kSpeed, 900, 2e-4));
  const double heavy = compression_time(corner_into_bow(0, kSpeed, 7200, 2e-4));
  const double fast = compression_time(corner_into_bow(0, 4 * kSpeed, 900, 2e-4));
  const double mass = 900 * 0.5 * 2 * 7 * 7;
  const double predicted = std::numbers::pi / 2 * std::sqrt(mass / (2.8e6 * 0.5 * 2));
  std::printf("compression %.4f s, predicted %.4f s\n", base, predicted);
  EXPECT_NEAR(base / predicted, 1, 0.01);
  EXPECT_NEAR(heavy / base, std::sqrt(8), 0.02);
  EXPECT_NEAR(fast / base, 1, 0.01);
}

TEST(CrushingCollision, CrushesAsDeepAsTheEnergyTakesIt) {
  // ½ m v² = ½ σ_c h T ξ² at a vertical wall.
  Simulation simulation(corner_into_bow(0, kSpeed, 900, 2e-4));
  double deepest = 0;
  for (int step = 0; step < 5000; ++step) {
    simulation.step();
    for (const dynamics::Contact& c : simulation.world().step.contacts) deepest = std::max(deepest, c.depth);
  }
  const double mass = 900 * 0.5 * 2 * 7 * 7;
  EXPECT_NEAR(deepest / (kSpeed * std::sqrt(mass / (2.8e6 * 0.5 * 2))), 1, 0.01);
  EXPECT_EQ(simulation.counts().crush_contacts, 1);
}

TEST(CrushingCollision, EndsWithEq5sRestitutionInTotal) {
  for (const double restitution : {0.0, 0.1, 0.5, 1.0}) {
    for (const double angle : {0.0, 60 * kDegree}) {
      Scene scene = corner_into_bow(angle, kSpeed, 900, 1e-3);
      scene.contact.restitution = restitution;
      Simulation simulation(scene);
      for (int step = 0; step < 4000; ++step) simulation.step();
      EXPECT_NEAR(simulation.floe_states()[0].velocity.x, restitution * kSpeed, 1e-5 * kSpeed) << angle;
      EXPECT_EQ(simulation.counts().crush_contacts, 1);
    }
  }
}

TEST(CrushingCollision, NoStepsImpulseExceedsWhatTheIceCarries) {
  Scene scene = corner_into_bow(38.2 * kDegree, 2, 900, 5e-3);
  scene.contact.restitution = 0.3;
  Simulation simulation(scene);
  int crushing = 0;
  for (int step = 0; step < 400; ++step) {
    simulation.step();
    for (const dynamics::Contact& c : simulation.world().step.contacts) {
      ASSERT_LE(c.total_normal_impulse(), c.crushing_force * scene.time.step * (1 + 1e-12));
      crushing += c.total_normal_impulse() > 0;
    }
  }
  EXPECT_GT(crushing, 5);
}

/// Two floes that meet corner to corner, a little off their centres, after `gap` [m].
Scene corner_to_corner(double step, double restitution, double gap) {
  Scene scene = without_drag();
  scene.time.step = step;
  scene.contact.restitution = restitution;
  scene.floes = {floe(diamond({-14 - gap, 0.05}, 7)), floe(diamond({0, 0}, 10), {-1, 0.1})};
  return scene;
}

std::vector<double> final_velocities(const Scene& scene, double until) {
  Simulation simulation(scene);
  run(simulation, until);
  std::vector<double> all;
  for (const FloeState& state : simulation.floe_states()) {
    all.insert(all.end(), {state.velocity.x, state.velocity.y, 7 * state.angular_velocity});
  }
  return all;
}

double largest_difference(const std::vector<double>& p, const std::vector<double>& q) {
  double worst = 0;
  for (std::size_t i = 0; i < p.size(); ++i) worst = std::max(worst, std::abs(p[i] - q[i]));
  return worst;
}

TEST(CrushingCollision, ConvergesAsTheStepShrinks) {
  // When the first touch falls within its step is chance: the worst over several gaps is what converges.
  for (const double restitution : {0.0, 0.1}) {
    std::vector<double> errors(5, 0);
    for (int k = 0; k < 8; ++k) {
      const double gap = 1e-3 * (1 + k);
      const std::vector<double> reference = final_velocities(corner_to_corner(2e-5, restitution, gap), 1);
      double step = 16e-3;
      for (double& error : errors) {
        step /= 2;
        error = std::max(
            error,
            largest_difference(final_velocities(corner_to_corner(step, restitution, gap), 1), reference));
      }
    }
    for (const double error : errors) std::printf("restitution %.1f: off by %.3g m/s\n", restitution, error);
    const double order = std::log(errors.front() / errors.back()) / std::log(16);
    std::printf("order %.2f\n", order);
    EXPECT_GT(order, 0.8);
  }
}

/// A corner runs into a flat face off its centre.
Scene corner_into_face(double radius, ContactNormal rule) {
  Scene scene = without_drag();
  scene.time.step = 1e-4;
  scene.contact.circle_radius = radius;
  scene.contact.normal = rule;
  scene.floes = {floe(rectangle(-20.003, -15, -0.003, 9)), floe(diamond({0, 2.2}, 7), {-0.5, 0.05})};
  return scene;
}

TEST(CrushingCollision, ByTheBoundaryRuleDoesNotKnowTheCirclesRadius) {
  const std::vector<double> coarse = final_velocities(corner_into_face(2, ContactNormal::kBoundary), 1);
  EXPECT_EQ(largest_difference(final_velocities(corner_into_face(0.25, ContactNormal::kBoundary), 1), coarse),
            0);
  EXPECT_GT(std::abs(coarse[0]), 0.01) << "they did meet";
}

/// Mean of the force that level ice takes [N].
double mean_resistance(double radius) {
  Scene scene = paper_scene();
  scene.contact.circle_radius = radius;
  scene.ships = {icebreaker({-2, 0}, ConstantSpeed{1})};
  scene.floes = {floe(rectangle(0, -75, 300, 75))};
  Simulation simulation(scene);
  run(simulation, 30);
  double sum = 0;
  const std::vector<ShipSample> samples = run(simulation, 130).samples;
  for (const ShipSample& sample : samples) sum -= sample.from_ice.surge;
  return sum / static_cast<double>(samples.size());
}

TEST(CrushingCollision, LevelIceDependsOnTheRadiusALittle) {
  // The overlap does not, but a contact keeps its record within a quarter of the radius
  // (docs/theory.md).
  const double fine = mean_resistance(0.5);
  const double coarse = mean_resistance(2);
  std::printf("mean surge %.1f kN at 0.5 m, %.1f kN at 2 m\n", fine / 1e3, coarse / 1e3);
  EXPECT_GT(fine, 1e4);
  EXPECT_NE(fine, coarse);
  EXPECT_NEAR(coarse / fine, 1, 0.15);
}

TEST(CrushingCollision, ByCircleCentresIsFeltLaterByAShareOfTheRadius) {
  // The paper's rule: a corner's circle keeps off its tip by a share of the radius, so that the first touch
  // comes late by as much, and tends to the boundary's as the radius shrinks. Its normals do not: a row of
  // circles is as bumpy at any radius.
  const auto depth_at_touch = [](double radius) {
    Simulation simulation(corner_into_face(radius, ContactNormal::kCircleCentres));
    while (simulation.world().step.contacts.empty() && simulation.time() < 20) simulation.step();
    return 0.5 * simulation.time() - 0.003;
  };
  std::vector<double> lags;
  for (const double radius : {2.0, 1.0, 0.5, 0.25, 0.125, 0.0625}) {
    lags.push_back(depth_at_touch(radius));
    std::printf("radius %.4f m: touches at a depth of %.5f m\n", radius, lags.back());
    EXPECT_GT(lags.back(), 0);
    EXPECT_LT(lags.back(), radius);
  }
  const double order = std::log(lags.front() / lags.back()) / std::log(32);
  std::printf("order %.2f\n", order);
  EXPECT_NEAR(order, 1, 0.3);
}

}  // namespace
}  // namespace polynya::simulation
