// Collisions that crush by the impulse law, step by step: what they end with, how long they take, and that
// both converge.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using shapes::diamond;

constexpr double kSpeed = 0.5;
constexpr double kMass = 900 * 0.5 * 2 * 7 * 7;  // of a diamond of 7 m [kg]

/// A floe's corner runs into a fixed ship, along the normal of its flat bow.
Scene corner_into_bow(double hull_angle, double speed, double density, double step, double restitution = 0) {
  ShipSpec bow = barge({0, 0}, ConstantSpeed{0}, 0);
  set_hull_angle(bow, hull_angle);
  Scene scene = Build(Laws::kPaper)
                    .unbreakable()
                    .without_drag()
                    .step(step)
                    .ship(bow)
                    .floe(diamond({0.01 * speed, 0}, 7), {-speed, 0});
  scene.ice.density = density;
  scene.contact.restitution = restitution;
  return scene;
}

struct Compression {
  double time = -1;     ///< from first contact to the end of the approach [s]
  double deepest = -1;  ///< [m]
};

Compression compression(const Scene& scene) {
  Simulation simulation(scene);
  Compression found;
  double start = -1;
  for (int step = 0; step < 200000 && found.time < 0; ++step) {
    simulation.step();
    for (const dynamics::Contact& c : simulation.world().step.contacts) {
      if (start < 0) start = simulation.time();
      found.deepest = std::max(found.deepest, c.depth);
    }
    if (start >= 0 && simulation.floe_states()[0].velocity.x >= -1e-9) found.time = simulation.time() - start;
  }
  return found;
}

TEST(CrushingCollision, TakesMassToTheThirdOverSpeedToTheThirdAtAnInclinedHull) {
  // F = k ξ²: the time of compression goes as (m / k v)^⅓.
  const auto time = [](double speed, double density) {
    return compression(corner_into_bow(60 * kDegree, speed, density, 5e-4)).time;
  };
  EXPECT_NEAR(std::log(time(kSpeed, 7200) / time(kSpeed, 900)) / std::log(8), 1.0 / 3, 0.01);
  EXPECT_NEAR(std::log(time(2 * kSpeed, 900) / time(kSpeed / 4, 900)) / std::log(8), -1.0 / 3, 0.01);
}

TEST(CrushingCollision, TakesTheRootOfTheMassAtAVerticalWallAndCrushesAsDeepAsTheEnergyTakesIt) {
  // F = σ_c h T ξ, a spring: a quarter of its period, π/2 √(m / σ_c h T), T = 2; ½ m v² = ½ σ_c h T ξ².
  const Compression base = compression(corner_into_bow(0, kSpeed, 900, 2e-4));
  const double root = std::sqrt(kMass / (2.8e6 * 0.5 * 2));
  EXPECT_NEAR(base.time / (std::numbers::pi / 2 * root), 1, 0.01);
  EXPECT_NEAR(base.deepest / (kSpeed * root), 1, 0.01);
  EXPECT_NEAR(compression(corner_into_bow(0, kSpeed, 7200, 2e-4)).time / base.time, std::sqrt(8), 0.02);
  EXPECT_NEAR(compression(corner_into_bow(0, 4 * kSpeed, 900, 2e-4)).time / base.time, 1, 0.01);
}

TEST(CrushingCollision, EndsWithEq5sRestitutionInTotal) {
  for (const double restitution : {0.0, 0.1, 0.5, 1.0}) {
    for (const double angle : {0.0, 60 * kDegree}) {
      const Simulation simulation = run(corner_into_bow(angle, kSpeed, 900, 1e-3, restitution), 4).simulation;
      EXPECT_NEAR(simulation.floe_states()[0].velocity.x, restitution * kSpeed, 1e-5 * kSpeed) << angle;
      EXPECT_EQ(simulation.counts().crush_contacts, 1);
    }
  }
}

/// Two floes that meet corner to corner, a little off their centres, after `gap` [m].
Scene corner_to_corner(double step, double restitution, double gap) {
  Scene scene = Build(Laws::kPaper)
                    .without_drag()
                    .step(step)
                    .floe(diamond({-14 - gap, 0.05}, 7))
                    .floe(diamond({0, 0}, 10), {-1, 0.1});
  scene.contact.restitution = restitution;
  return scene;
}

std::vector<double> final_velocities(const Scene& scene) {
  std::vector<double> all;
  for (const FloeState& state : run(scene, 1).simulation.floe_states())
    all.insert(all.end(), {state.velocity.x, state.velocity.y, 7 * state.angular_velocity});
  return all;
}

TEST(CrushingCollision, ConvergesAsTheStepShrinks) {
  // When the first touch falls within its step is chance: the worst over several gaps is what converges.
  for (const double restitution : {0.0, 0.1}) {
    std::vector<double> errors(5, 0);
    for (int k = 0; k < 8; ++k) {
      const double gap = 1e-3 * (1 + k);
      const std::vector<double> reference = final_velocities(corner_to_corner(2e-5, restitution, gap));
      double step = 16e-3;
      for (double& error : errors) {
        step /= 2;
        const std::vector<double> found = final_velocities(corner_to_corner(step, restitution, gap));
        for (std::size_t i = 0; i < found.size(); ++i)
          error = std::max(error, std::abs(found[i] - reference[i]));
      }
    }
    EXPECT_GT(std::log(errors.front() / errors.back()) / std::log(16), 0.8) << "its order";
  }
}

TEST(CrushingCollision, LevelIceDependsOnTheRadiusALittle) {
  // The overlap does not, but a contact keeps its record within a quarter of the radius (docs/theory.md).
  const auto resistance = [](double radius) {
    Scene scene =
        Build(Laws::kPaper).ship(icebreaker({-2, 0}, ConstantSpeed{1})).floe(rectangle(0, -75, 300, 75));
    scene.contact.circle_radius = radius;
    return -mean(run(scene, 130).story, &ShipSample::surge_force, 0, 30.05);
  };
  const double fine = resistance(0.5), coarse = resistance(2);
  EXPECT_GT(fine, 1e4);
  EXPECT_NE(fine, coarse);
  EXPECT_NEAR(coarse / fine, 1, 0.15);
}

TEST(CrushingCollision, ByCircleCentresIsFeltLaterByAShareOfTheRadius) {
  // The paper's rule: a corner's circle keeps off its tip by a share of the radius, so that the first touch
  // comes late by as much, and tends to the boundary's as the radius shrinks. Its normals do not: a row of
  // circles is as bumpy at any radius.
  const auto depth_at_touch = [](double radius) {
    Scene scene = Build(Laws::kPaper)
                      .without_drag()
                      .step(1e-4)
                      .floe(rectangle(-20.003, -15, -0.003, 9))
                      .floe(diamond({0, 2.2}, 7), {-0.5, 0.05});
    scene.contact.circle_radius = radius;
    scene.contact.normal = ContactNormal::kCircleCentres;
    Simulation simulation(scene);
    while (simulation.world().step.contacts.empty() && simulation.time() < 20) simulation.step();
    return 0.5 * simulation.time() - 0.003;
  };
  std::vector<double> lags;
  for (const double radius : {2.0, 1.0, 0.5, 0.25, 0.125, 0.0625}) {
    lags.push_back(depth_at_touch(radius));
    EXPECT_GT(lags.back(), 0);
    EXPECT_LT(lags.back(), radius);
  }
  EXPECT_NEAR(std::log(lags.front() / lags.back()) / std::log(32), 1, 0.3) << "its order";
}

}  // namespace
}  // namespace polynya::simulation
