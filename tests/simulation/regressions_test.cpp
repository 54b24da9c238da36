// Each of these once went wrong. They state what must hold, not what the code gave.

#include <algorithm>

#include <gtest/gtest.h>

#include "fracture/characteristic_length.hpp"
#include "simulation/world/limits.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation::scenes {
namespace {

/// A floe that starts in motion was woken before the floes behind it in the scene were there, and ran into
/// them.
TEST(Regression, AMovingFloeMeetsFloesThatTheSceneListsLater) {
  for (const bool is_mover_first : {true, false}) {
    Scene scene = paper_scene();
    scene.water.drag_coefficient = 0;
    const FloeSpec solver_body = floe(rectangle(0, 0, 10, 10), {1, 0});
    const FloeSpec rester = floe(rectangle(10.5, 0, 20.5, 10));
    scene.floes = is_mover_first ? std::vector{solver_body, rester} : std::vector{rester, solver_body};
    Simulation simulation(scene);
    while (simulation.world().step.contacts.empty() && simulation.time() < 3) simulation.step();
    EXPECT_NEAR(simulation.time(), 0.5, 3 * scene.time.step) << is_mover_first;
    EXPECT_LT(simulation.world().step.contacts.front().depth, 2 * scene.time.step);
  }
}

/// Restitution was charged by the whole squeeze, step after step, and threw the small floe off at 1.45 m/s.
TEST(Regression, APinchedFloeIsNotThrownOff) {
  for (const double restitution : {0.0, 0.1, 0.3}) {
    Scene scene = paper_scene();
    scene.contact.restitution = restitution;
    scene.fracture.breakable_size_factor = 1e3;
    scene.ships = {barge({0, 0}, ConstantSpeed{1})};
    scene.floes = {floe(rectangle(0.1, -5, 10.1, 5)), floe(rectangle(10.2, -55, 210.2, 55))};
    Simulation simulation(scene);
    double fastest = 0;
    double spin = 0;
    for (int i = 0; i < 2000; ++i) {
      simulation.step();
      for (const FloeState& state : simulation.floe_states()) {
        fastest = std::max(fastest, length(state.velocity));
        spin = std::max(spin, std::abs(state.angular_velocity));
      }
    }
    EXPECT_LT(fastest, 1 + std::max(1.001 * restitution, 0.02)) << restitution;
    EXPECT_LT(spin, 1e-12) << "a symmetric pinch turns";
  }
}

/// A damaged checkpoint held a floe whose second moment rounding had taken, and a scene could: no mass, no
/// inertia.
TEST(Regression, IceWithoutMassOrInertiaIsNoFloe) {
  const auto could_be = [](double size) {
    return can_be_floe(geometry::measure({{{0, 0}, {size, 0}, {0, size}}, {}}));
  };
  EXPECT_TRUE(could_be(2e-3));
  EXPECT_FALSE(could_be(1e-3));
  EXPECT_FALSE(could_be(1e-120));
  EXPECT_FALSE(can_be_floe({.area = 1, .second_moment = -1e-20}));
}

/// With a weak criterion the halves of a floe split again every step along the crack they had just left, and
/// corners were pared: what a crack leaves on either side is no sliver.
TEST(Regression, ACrackIsNotParedStripByStrip) {
  for (const auto model : {fracture::SplittingModel::kMichel, fracture::SplittingModel::kLefm}) {
    Scene scene = paper_scene();
    scene.fracture.splitting = model;
    scene.fracture.splitting_shape_factor = 0.02;
    scene.ice.fracture_toughness = 20e3;
    scene.ships = {icebreaker({0, 3}, ConstantSpeed{0.5}, 0.5)};
    scene.floes = {floe(rectangle(0.5, -40, 70, 50))};
    Simulation simulation(scene);
    const Story story = run(simulation, 5);
    EXPECT_GE(simulation.counts().splits, 1);
    EXPECT_LE(simulation.counts().splits, 40);
    const double l = fracture::characteristic_length(scene.ice, scene.water.water);
    for (const Event& event : story.events) {
      if (!event.is<Split>()) continue;
      for (const FloeId child : event.ice()->children) {
        const double area = std::ranges::find(story.births, child, &Birth::floe)->area;
        EXPECT_GE(area, 0.499 * l * l) << child;
        EXPECT_GE(area / event.criteria().crack_length, 0.49 * l) << child;
      }
    }
  }
}

/// The scene's own comment: j = (1 + ε) v m_eff, worked by hand.
TEST(Regression, TwoFloesMeetAsEquation5SaysByHand) {
  Scene scene = paper_scene();
  scene.water.drag_coefficient = 0;
  scene.contact.restitution = 0.1;
  const double v = 0.3;
  scene.floes = {floe(rectangle(0, 0, 10, 10), {v, 0}), floe(rectangle(11, 0, 31, 10))};  // 45 t on 90 t
  Simulation simulation(scene);
  while (simulation.time() < 6) simulation.step();
  const double m0 = 45e3;
  const double m1 = 90e3;
  const double impulse = 1.1 * v * m0 * m1 / (m0 + m1);
  const auto states = simulation.floe_states();
  EXPECT_NEAR(states[0].velocity.x, v - impulse / m0, 1e-8);
  EXPECT_NEAR(states[1].velocity.x, impulse / m1, 1e-8);
  EXPECT_NEAR(states[0].angular_velocity, 0, 1e-6);
}

}  // namespace
}  // namespace polynya::simulation::scenes
