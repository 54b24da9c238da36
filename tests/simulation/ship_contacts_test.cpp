// Contact of ships with one another and with structures: recorded apart from the ice, and never in silence.
#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Vector;

TEST(ShipContacts, AreNoIceLoad) {
  // Two barges bow to bow, no ice in the scene.
  Scene scene = without_drag();
  scene.ships = {barge({0, 0}, ConstantThrust{0}, 0.5), barge({0, 0}, ConstantThrust{0}, 0.5)};
  scene.ships[1].position_in_world = {60.55, 0};
  scene.ships[1].heading = std::numbers::pi;
  Simulation simulation(scene);
  const Story story = run(simulation, 1);
  double surge = 0;
  for (const ShipSample& sample : story.samples) {
    EXPECT_EQ(sample.from_ice.surge, 0);
    EXPECT_EQ(sample.from_ice_largest.surge, 0);
    EXPECT_EQ(sample.collision.surge, 0);
    EXPECT_EQ(sample.contacts, 0);
    if (sample.ship == 0) surge += scene.record.forces_interval * sample.from_ships.surge;
  }
  EXPECT_NEAR(surge, 1e7 * (simulation.ship_states()[0].velocity.x - 0.5), 1e-3);
  EXPECT_LT(surge, -5e6);
  ASSERT_EQ(of_kind<ShipContact>(story).size(), 1U);
  const Event event = of_kind<ShipContact>(story)[0];
  const auto& contact = std::get<ShipContact>(event.what);
  EXPECT_NEAR(event.time, 0.55, 2 * scene.time.step + 1e-9);
  EXPECT_EQ(event.ship, 0);
  EXPECT_EQ(contact.other, 1);
  EXPECT_NEAR(contact.closing_speed, 1, 1e-6);
  EXPECT_NEAR(contact.relative_speed, 1, 1e-6);
  EXPECT_NEAR(event.point_in_world.x, 0.275, 0.01);
  EXPECT_FALSE(contact.is_prescribed);
}

TEST(ShipContacts, WithIceBetweenTheTwoLoadsAddUpToTheMotion) {
  Scene scene = without_drag();
  scene.ships = {barge({0, 0}, ConstantThrust{0}, 1)};
  scene.structures = {pile({25, 3}, 5)};
  scene.floes = {floe(rectangle(1, -8, 9, -2))};
  Simulation simulation(scene);
  const Story story = run(simulation, 40);
  Vector by_ice, by_pile;
  double turned_by_ice = 0, turned_by_pile = 0;
  for (const ShipSample& sample : story.samples) {
    if (sample.ship != 0) continue;
    by_ice += 0.1 * Vector{sample.from_ice.surge, sample.from_ice.sway};
    by_pile += 0.1 * Vector{sample.from_ships.surge, sample.from_ships.sway};
    turned_by_ice += 0.1 * sample.from_ice.yaw;
    turned_by_pile += 0.1 * sample.from_ships.yaw;
  }
  const ShipState end = simulation.ship_states()[0];
  EXPECT_LT(by_ice.x, -1e4);
  EXPECT_LT(by_pile.x, -1e6);
  EXPECT_NEAR((turned_by_ice + turned_by_pile) / (5e9 * end.angular_velocity), 1, 1e-9);
  // The heading turns by less than a degree while the pile is touched: m Δv along it, to that.
  EXPECT_NEAR((by_ice.x + by_pile.x) / (1e7 * (end.velocity.x - 1)), 1, 1e-2);
}

TEST(ShipContacts, OfPrescribedMotionsAreRecorded) {
  // The pile stands off the course by this much: every step length and place finds the touch, none beside it.
  for (const double step : {0.005, 0.013, 0.05}) {
    for (const double off : {-18.0, -16.9, -12.0, -3.7, 0.0, 5.0, 12.0, 16.9, 17.1, 30.0}) {
      Scene scene = paper_scene();
      scene.time.step = step;
      scene.ships = {barge({0, 0}, ConstantSpeed{2})};
      scene.structures = {pile({25, off}, 5), pile({-150, 0}, 5)};
      Simulation simulation(scene);
      const Story story = run(simulation, 30);
      if (std::abs(off) > 17) {
        EXPECT_TRUE(of_kind<ShipContact>(story).empty()) << off;
        continue;
      }
      ASSERT_EQ(of_kind<ShipContact>(story).size(), 1U) << off << " in steps of " << step;
      const Event event = of_kind<ShipContact>(story)[0];
      const auto& contact = std::get<ShipContact>(event.what);
      // The side of the bow that meets the pile is 20 m from it at most, 25 m where it meets the very edge.
      EXPECT_GE(event.time, 10 - 1e-9);
      EXPECT_LE(event.time, 12.5 + 2 * step);
      if (std::abs(off) < 11) {
        EXPECT_NEAR(event.time, 10, 2 * step);
      }
      EXPECT_EQ(contact.relative_speed, 2);
      EXPECT_GT(contact.closing_speed, 0);
      EXPECT_TRUE(contact.is_prescribed);
      for (const ShipSample& sample : story.samples) EXPECT_EQ(sample.from_ships.surge, 0);
    }
  }
}

TEST(ShipContacts, AreRecordedOnceAlsoAfterAResume) {
  Scene scene = paper_scene();
  scene.ships = {barge({0, 0}, ConstantThrust{1e5}), barge({0, 100}, ConstantSpeed{1})};
  scene.structures = {pile({6, 0}, 5), pile({6.5, 100}, 5)};
  Simulation simulation(scene);
  EXPECT_EQ(of_kind<ShipContact>(run(simulation, 3)).size(), 2U);
  auto resumed = Simulation::resumed(scene, simulation.state());
  ASSERT_TRUE(resumed.has_value()) << resumed.error();
  EXPECT_TRUE(of_kind<ShipContact>(run(*resumed, 6)).empty());
  EXPECT_TRUE(of_kind<ShipContact>(run(simulation, 6)).empty());
  EXPECT_EQ(resumed->state_hash(), simulation.state_hash());
}

}  // namespace
}  // namespace polynya::simulation
