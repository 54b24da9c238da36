// Recorded contacts explain the loads on ships and the motion of floes.
#include <map>

#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Vector;

/// A ship under thrust in drifting water, into loose floes and a plate behind them.
Scene pack(RecordedContacts contacts) {
  Scene scene = without_drag();
  scene.water.drift = {0.2, -0.1};
  scene.record.contacts = contacts;
  scene.record.forces_interval = scene.time.step;
  scene.ships = {icebreaker({0, 0}, ConstantThrust{2e6}, 2)};
  scene.ships[0].heading = 0.1;
  for (int column = 0; column < 2; ++column) {
    for (int row = 0; row < 5; ++row) {
      const double x = 2 + 11.0 * column;
      const double y = -26 + 10.5 * row;
      scene.floes.push_back(floe(rectangle(x, y, x + 10, y + 10)));
    }
  }
  scene.floes.push_back(floe(rectangle(26, -60, 86, 60)));
  return scene;
}

TEST(Contacts, OfAShipAddUpToItsLoadInTheStep) {
  Simulation simulation(pack(RecordedContacts::kShips));
  int pressed = 0;
  int most = 0;
  bool has_crushed = false;
  while (simulation.time() < 25) {
    const geometry::Pose before = simulation.ship_states()[0].world_from_ship;
    const double heading = simulation.ship_states()[0].heading;
    simulation.step();
    const ShipSample sample = simulation.journal().samples.back();
    simulation.journal().clear();
    Vector force;
    double moment = 0;
    double size = 1;
    const auto contacts = simulation.contact_states();
    for (const ContactState& contact : contacts) {
      ASSERT_EQ(contact.on.ship, 0);
      ASSERT_GE(contact.by.floe, 0);
      force += contact.force;
      moment += cross(contact.point_in_world - before.position, contact.force);
      size += length(contact.force);
      has_crushed = has_crushed || contact.is_crushing;
    }
    const Vector in_ship = rotate_back(geometry::Rotation::by(heading), force);
    ASSERT_NEAR(in_ship.x, sample.from_ice.surge, 1e-9 * size) << simulation.time();
    ASSERT_NEAR(in_ship.y, sample.from_ice.sway, 1e-9 * size);
    ASSERT_NEAR(moment, sample.from_ice.yaw, 1e-7 * size);
    ASSERT_EQ(static_cast<int>(contacts.size()), sample.contacts);
    pressed += size > 1e4;
    most = std::max(most, sample.contacts);
  }
  EXPECT_GT(simulation.counts().bends, 0);
  EXPECT_GT(pressed, 500);
  EXPECT_GE(most, 3);
  EXPECT_TRUE(has_crushed);
}

/// Nothing else pushes a floe where there is no drag: Newton's second law, floe by floe and step by step.
TEST(Contacts, BetweenFloesTooExplainHowEachFloeMoves) {
  Scene scene = pack(RecordedContacts::kAll);
  scene.fracture.breakable_size_factor = 1e6;
  Simulation simulation(scene, {.sleeps = false});
  int between_floes = 0;
  for (int step = 0; step < 1000; ++step) {
    std::map<FloeId, Vector> gained;
    for (const FloeState& state : simulation.floe_states()) gained[state.floe] = -state.mass * state.velocity;
    simulation.step();
    simulation.journal().clear();
    for (const FloeState& state : simulation.floe_states()) gained[state.floe] += state.mass * state.velocity;
    double size = 1;
    for (const ContactState& contact : simulation.contact_states()) {
      const Vector impulse = scene.time.step * contact.force;
      if (contact.on.floe != kNoFloe) gained[contact.on.floe] -= impulse;
      gained[contact.by.floe] += impulse;
      between_floes += contact.on.floe != kNoFloe && length(impulse) > 0;
      size += length(impulse);
    }
    for (const auto& [floe, left] : gained) ASSERT_NEAR(length(left), 0, 1e-8 * size) << floe;
  }
  EXPECT_GT(between_floes, 500);
}

TEST(Contacts, AreThoseTheSceneAsksFor) {
  Simulation all(pack(RecordedContacts::kAll));
  Simulation ships(pack(RecordedContacts::kShips));
  Simulation none(pack(RecordedContacts::kNone));
  EXPECT_TRUE(all.contact_states().empty()) << "nothing was stepped yet";
  std::size_t others = 0;
  for (int step = 0; step < 1000; ++step) {
    for (Simulation* simulation : {&all, &ships, &none}) {
      simulation->step();
      simulation->journal().clear();
    }
    const auto of_ships = ships.contact_states();
    auto of_all = all.contact_states();
    others += std::erase_if(of_all, [](const ContactState& contact) { return contact.on.ship < 0; });
    ASSERT_EQ(of_all.size(), of_ships.size());
    for (std::size_t i = 0; i < of_all.size(); ++i) {
      EXPECT_EQ(of_all[i].by, of_ships[i].by);
      EXPECT_EQ(of_all[i].force, of_ships[i].force);
    }
    ASSERT_TRUE(none.contact_states().empty());
  }
  EXPECT_GT(others, 300U);
  EXPECT_EQ(all.state_hash(), none.state_hash()) << "looking changes nothing";
}

}  // namespace
}  // namespace polynya::simulation
