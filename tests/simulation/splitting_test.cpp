// Splitting by the forces that contacts really carry (docs/theory.md, "Splitting").
#include "fracture/splitting.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "simulation/ship/pressing.hpp"
#include "simulation/world/world.hpp"
#include "tests/dynamics/scenery.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Point;
using geometry::Vector;

constexpr double kOpeningOfStem = 0.633;  // per force ahead, of the reference ship with μ 0.2

Scene lefm_scene(const std::vector<FloeSpec>& floes) {
  Scene scene;
  scene.fracture.splitting = fracture::SplittingModel::kLefm;
  scene.floes = floes;
  return scene;
}

/// The reference ship with vertical walls: it crushes and splits ice, and does not bend it.
Ship wedge_ship(const Propulsion& propulsion, double speed = 1) {
  Ship ship = icebreaker({0, 0}, propulsion, speed);
  ship.hull.angles_from_vertical.assign(ship.hull.waterline.size(), 0);
  return ship;
}

/// Steps to the first fracture, or to a time.
Event first_fracture(Simulation& simulation, double until) {
  Story story;
  while (simulation.time() < until) {
    simulation.step();
    listen(simulation, story);
    for (const Event& event : story.events)
      if (event.is_fracture()) return event;
  }
  Event none;
  none.time = -1;
  return none;
}

double largest_force(const Simulation& simulation) {
  double largest = 0;
  for (const dynamics::Contact& c : simulation.world().step.contacts)
    largest = std::max(largest, length(c.impulse_on_b()) / simulation.scene().time.step);
  return largest;
}

TEST(Splitting, APlateOfTwentyKilometresSplitsWhenTheForceHasGrownToWhatItTakes) {
  // F = 2 σ_c h ξ tan α ahead, of which 0.633 opens the crack: ξ = F_max / (0.633 · 2 σ_c h tan 27°) = 2.20
  // m.
  Scene scene = lefm_scene({floe(rectangle(0.001, -1e4, 2e4, 1e4))});
  scene.ships = {wedge_ship(ConstantSpeed{1})};
  const double needed = fracture::lefm_splitting_force(scene.ice, 2e4, 2e4);
  const double depth = needed / (kOpeningOfStem * 2 * 2.8e6 * 0.5 * std::tan(27 * kDegree));
  Simulation simulation(scene);
  double before = 0;
  Story story;
  while (story.events.empty() && simulation.time() < 5) {
    before = std::max(before, largest_force(simulation));
    simulation.step();
    listen(simulation, story);
  }
  ASSERT_FALSE(story.events.empty());
  const Event& event = story.events.front();
  EXPECT_TRUE(event.is<Split>());
  EXPECT_NEAR(event.ice()->penetration / depth, 1, 0.02);
  EXPECT_NEAR(event.time / depth, 1, 0.02) << "at 1 m/s";
  const fracture::FailureCriteria& c = event.criteria();
  EXPECT_GE(c.opening_force, c.opening_capacity);
  EXPECT_LT(c.opening_force, 1.01 * c.opening_capacity) << "it grows by less in a step";
  EXPECT_LT(kOpeningOfStem * before, 1.001 * c.opening_capacity) << "no step before had it";
  EXPECT_NEAR(c.opening_capacity / needed, 1, 1e-3);
  EXPECT_NEAR(c.opening_force / c.contact_force, kOpeningOfStem, 1e-3);
  EXPECT_NEAR(c.flank_forces[0] / c.flank_forces[1], 1, 1e-3);
  EXPECT_NEAR(c.crack_length, 2e4, 5);
  EXPECT_NEAR(c.crack_width, 2e4, 5);
  EXPECT_EQ(c.fracture_toughness, scene.ice.fracture_toughness);
}

TEST(Splitting, ByTrueForcesUnlessAnotherRuleIsChosenAndNeverByNone) {
  EXPECT_EQ(Scene{}.fracture.splitting, fracture::SplittingModel::kLefm);
  for (const auto model : {fracture::SplittingModel::kLefm, fracture::SplittingModel::kMichel,
                           fracture::SplittingModel::kNone}) {
    Scene scene = lefm_scene({floe(rectangle(0.05, -15, 30.05, 15))});
    scene.ships = {wedge_ship(ConstantSpeed{4}, 4)};
    scene.fracture.splitting = model;
    Simulation simulation(scene);
    while (simulation.time() < 3) simulation.step();
    if (model == fracture::SplittingModel::kNone) {
      EXPECT_EQ(simulation.counts().splits, 0);
      EXPECT_GT(simulation.counts().crush_contacts, 0);
    } else {
      EXPECT_GT(simulation.counts().splits, 0) << static_cast<int>(model);
    }
  }
}

TEST(Splitting, AFlatPushClosesTheMouthHoweverHard) {
  Scene scene = lefm_scene({floe(rectangle(0.05, -10, 20.05, 10))});
  scene.ships = {barge({0, 0}, ConstantSpeed{1})};
  Simulation simulation(scene);
  double largest = 0;
  while (simulation.time() < 3) {
    simulation.step();
    largest = std::max(largest, largest_force(simulation));
  }
  EXPECT_GT(largest, 3 * fracture::lefm_splitting_force(scene.ice, 20, 20));
  EXPECT_EQ(simulation.counts().splits, 0);
}

/// A floe of 60 × 30 m with a point of half-angle 30° at x = 0.
geometry::Polygon pointed(bool points_ahead) {
  const double d = 15 / std::tan(30 * kDegree);
  geometry::Polygon floe{{{0, 0}, {-d, 15}, {-60, 15}, {-60, -15}, {-d, -15}}, {}};
  if (!points_ahead)
    for (geometry::Point& p : floe.outer) p = {-60 - p.x, -p.y};
  return floe;
}

TEST(Splitting, AFloeSplitsAnotherWithItsPointAndNotWithItsSide) {
  for (const bool points_ahead : {true, false}) {
    Scene scene = lefm_scene({floe(pointed(points_ahead), {1, 0}), floe(rectangle(0.05, -10, 20.05, 10))});
    Simulation simulation(scene);
    const Event event = first_fracture(simulation, 3);
    if (!points_ahead) {
      EXPECT_EQ(event.time, -1);
      EXPECT_LT(simulation.floe_states()[0].velocity.x, 0.95) << "they met";
      continue;
    }
    EXPECT_TRUE(event.is<Split>());
    EXPECT_EQ(event.ship, -1);
    EXPECT_EQ(event.ice()->by_floe, 0);
    EXPECT_EQ(event.ice()->floe, 1);
    EXPECT_GE(event.criteria().opening_force, event.criteria().opening_capacity);
    EXPECT_NEAR(event.criteria().opening_capacity, fracture::lefm_splitting_force(scene.ice, 20, 20), 1e3);
    EXPECT_EQ(event.ice()->children.size(), 2u);
  }
}

TEST(Splitting, AFloeThatDriftsOnAStructureSplitsAtItsNoseAndNotAtItsWall) {
  for (const bool has_nose : {true, false}) {
    Scene scene = lefm_scene({floe(rectangle(0.05, -10, 20.05, 10), {-1, 0})});
    scene.structures = {standing(has_nose ? wedge_ship(ConstantSpeed{0}) : barge({0, 0}, ConstantSpeed{0}))};
    Simulation simulation(scene);
    const Event event = first_fracture(simulation, 3);
    EXPECT_EQ(event.time > 0, has_nose);
    if (has_nose) {
      EXPECT_TRUE(event.is<Split>());
      EXPECT_EQ(event.ship, 0);
    }
  }
}

TEST(Splitting, TheFlanksOfABowOpenTheHeadOfTheSlotItIsIn) {
  // The bow touches nothing but the two corners of a slot of 10 m; the slot's head is 30 m on.
  const geometry::Polygon plate{{{0, -40}, {80, -40}, {80, 40}, {0, 40}, {0, 5}, {30, 5}, {30, -5}, {0, -5}},
                                {}};
  Scene scene = lefm_scene({floe(plate)});
  scene.ships = {wedge_ship(ConstantSpeed{0.5})};
  scene.ships[0].position_in_world.x += 9;
  Simulation simulation(scene);
  const Event event = first_fracture(simulation, 10);
  ASSERT_TRUE(event.is<Split>());
  ASSERT_GT(event.time, 0);
  EXPECT_NEAR(event.criteria().crack_length, 50, 0.1);
  EXPECT_NEAR(event.point_in_world.x, 0, 1);
  EXPECT_NEAR(event.point_in_world.y, 0, 0.1);
  EXPECT_EQ(event.ice()->children.size(), 2u);
}

/// A plate with its edge along x = 0 and an older channel, parallel to it, from `spacing` on.
geometry::Polygon between_channels(double spacing) {
  const double far = spacing + 10;
  return {{{0.001, -300},
           {spacing, -300},
           {spacing, 250},
           {far, 250},
           {far, -300},
           {800, -300},
           {800, 300},
           {0.001, 300}},
          {}};
}

TEST(Splitting, BetweenParallelChannelsALongCrackRunsWhereTheyAreNearerThanSMax) {
  const auto first_at = [](double spacing) {
    Scene scene = lefm_scene({floe(between_channels(spacing))});
    scene.ships = {icebreaker({0, 0}, ConstantSpeed{0.5}, 0.5)};
    Simulation simulation(scene);
    return first_fracture(simulation, 10);
  };
  const Event bend = first_at(700);
  ASSERT_TRUE(bend.is<Bend>());
  ASSERT_GT(bend.criteria().opening_force, 0);
  EXPECT_LT(bend.criteria().opening_force, bend.criteria().opening_capacity);
  // S_max = (F_b / 0.2105 h K)², F_b what opens the crack when the ice bends.
  const double most = std::pow(bend.criteria().opening_force / (0.2105 * 0.5 * 150e3), 2);
  std::printf("F_b %.1f kN, S_max %.1f m\n", bend.criteria().opening_force / 1e3, most);
  const Event near = first_at(0.85 * most);
  ASSERT_TRUE(near.is<Split>());
  EXPECT_NEAR(near.criteria().crack_length, 0.85 * most, 0.5) << "from the stem to the older channel";
  EXPECT_GT(near.criteria().crack_width, 2 * near.criteria().crack_length);
  EXPECT_TRUE(first_at(1.15 * most).is<Bend>());
}

/// 36 floes of three to six corners that rush at each other.
Scene crowd(scenery::Random& random) {
  Scene scene = lefm_scene({});
  scene.water.drag_coefficient = 0;
  for (int i = 0; i < 36; ++i) {
    const int row = i / 6;
    const Point middle{13.0 * (i % 6), 13.0 * row};
    const int corners = 3 + random.below(4);
    geometry::Polygon polygon;
    for (int k = 0; k < corners; ++k) {
      const auto turn = geometry::Rotation::by(2 * std::numbers::pi * (k + random.between(0, 0.4)) / corners);
      polygon.outer.push_back(middle + 6 * Vector{turn.cosine, turn.sine});
    }
    scene.floes.push_back(floe(polygon, {random.between(-2, 2), random.between(-2, 2)}));
  }
  return scene;
}

TEST(Splitting, WhatPassesFloesOverIsNoLessThanTheirPushes) {
  scenery::Random random(20170611);
  Simulation simulation(crowd(random));
  const World& world = simulation.world();
  int bounded = 0, corners = 0, sharp = 0;
  while (simulation.time() < 8) {
    simulation.step();
    for (const dynamics::Contact& c : world.step.contacts) {
      const double bound = opening_bound(world.setup, {&c, 1});
      for (const BodyIndex floe : {c.a, c.b}) {
        PressedFloe pressed;
        press(world.setup, world.population.bodies, {&c, 1}, floe, pressed);
        EXPECT_LE(pressed.most, bound * (1 + 1e-9));
        corners += !pressed.contacts.empty() && pressed.contacts.front().is_corner ? 1 : 0;
      }
      (std::isinf(bound) ? sharp : bounded) += 1;
    }
  }
  EXPECT_GT(bounded, 1000);
  EXPECT_GT(sharp, 10);
  EXPECT_GT(corners, 1000);
}

}  // namespace
}  // namespace polynya::simulation
