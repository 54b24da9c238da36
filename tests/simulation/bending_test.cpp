// A corner of a plate under an inclined wall: when it breaks, against the solution of that one push.
#include <cmath>

#include <gtest/gtest.h>

#include "fracture/bending/studies.hpp"
#include "fracture/crushing.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

constexpr double kHullAngle = 38.2 * kDegree, kHalfAngle = 45 * kDegree, kSpeed = 0.2;

/// A flat inclined bow that comes on to a right corner of 80 000 m² of ice.
Scene corner_under_a_wall() {
  Scene scene = without_drag();
  scene.contact = {};
  scene.fracture = {};
  scene.fracture.splitting = fracture::SplittingModel::kNone;
  scene.time.step = 0.005;
  scene.ships = {barge({-0.001, 0}, ConstantSpeed{kSpeed}, kSpeed)};
  scene.ships[0].hull.angles_from_vertical.assign(4, kHullAngle);
  const double d = 283 * std::sin(kHalfAngle);
  scene.floes = {floe({{{0, 0}, {d, -d}, {2 * d, 0}, {d, d}}, {}})};
  return scene;
}

/// When the corner breaks, and of what size and at what ξ.
Event first_bend(const Scene& scene) {
  Simulation simulation(scene);
  while (simulation.time() < 10) {
    simulation.step();
    for (const Event& event : simulation.journal().events)
      if (event.is<Bend>()) return event;
    simulation.journal().clear();
  }
  ADD_FAILURE() << "nothing broke";
  return {};
}

fracture::BendingForecast forecast(const Scene& scene, fracture::Feedback feedback) {
  fracture::BendingLoad load;
  load.ice = scene.ice;
  load.front_half_angle = load.back_half_angle = kHalfAngle;
  load.hull_angle = kHullAngle;
  load.mean_approach_speed = kSpeed;
  load.vertical_to_crushing = fracture::crushing_shares(kHullAngle, scene.ice.friction, kSpeed, 0).vertical;
  return direct_forecast(wedge_of(load, {}), load, feedback).value();
}

TEST(Bending, TheHullFollowsIceThatBendsAway) {
  const Scene scene = corner_under_a_wall();
  const Event event = first_bend(scene);
  const auto coupled = forecast(scene, fracture::Feedback::kCoupled);
  EXPECT_NEAR(event.time / coupled.time, 1, 0.05);
  EXPECT_NEAR(event.criteria().vertical_force / coupled.capacity.vertical_force, 1, 0.02);
  EXPECT_NEAR(event.ice()->penetration / coupled.penetration, 1, 0.03);
  EXPECT_NEAR(std::get<Bend>(event.what).cusp_radius / coupled.capacity.cusp_radius, 1, 0.12);
}

TEST(Bending, OrOnlyCrushesIt) {
  Scene scene = corner_under_a_wall();
  scene.fracture.follows_deflection = false;
  const Event event = first_bend(scene);
  const auto ignored = forecast(scene, fracture::Feedback::kIgnored);
  EXPECT_NEAR(event.time / ignored.time, 1, 0.03);
  EXPECT_NEAR(std::get<Bend>(event.what).cusp_radius / ignored.capacity.cusp_radius, 1, 0.03);
  EXPECT_GT(first_bend(corner_under_a_wall()).time, 1.3 * event.time);
}

/// No bending: what the ice gives way does not change what a vertical wall, or a floe too small to break,
/// takes.
TEST(Bending, WhatCannotBendDoesNotRecede) {
  for (const bool is_small : {false, true}) {
    Scene scene = corner_under_a_wall();
    if (is_small)
      scene.fracture.breakable_size_factor = 100;
    else
      scene.ships[0].hull.angles_from_vertical.assign(4, 0);
    const auto hash_of = [&](bool follows) {
      scene.fracture.follows_deflection = follows;
      Simulation simulation(scene);
      for (int i = 0; i < 200; ++i) simulation.step();
      return simulation.floe_states()[0].velocity.x;
    };
    EXPECT_EQ(hash_of(true), hash_of(false));
  }
}

}  // namespace
}  // namespace polynya::simulation
