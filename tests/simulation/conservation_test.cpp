// What a fracture keeps: mass, momentum, angular momentum, area; and who came from whom.
#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "tests/dynamics/scenery.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Point;
using geometry::Vector;

/// A moving, turning plate broken by a free ship, by bending and by splitting.
Scene breaking_scene(CuspFate fate, fracture::SplittingModel splitting = fracture::SplittingModel::kMichel) {
  Scene scene = without_drag();
  scene.fracture.cusp_fate = fate;
  scene.fracture.splitting = splitting;
  scene.contact.separation_time =
      1e15;  // moves bodies without their momentum, and so changes the angular momentum
  scene.ships = {icebreaker({0, 3}, ConstantThrust{0}, 2)};
  const Vector velocity{-0.2, 0.05};
  scene.floes = {floe(rectangle(0.5, -40, 70, 50), velocity, 1e-3), floe(rectangle(72, -40, 120, 60))};
  return scene;
}

struct Totals {
  double mass = 0;
  Vector momentum;
  double angular_momentum = 0;
};

Totals totals(const Simulation& simulation) {
  const dynamics::Bodies& bodies = simulation.world().population.bodies;
  Totals sum;
  for (dynamics::BodyIndex i = 0; i < bodies.size(); ++i) {
    if (!bodies.is_alive[i]) continue;
    sum.mass += bodies.mass[i];
    sum.momentum += bodies.mass[i] * bodies.velocity[i];
    sum.angular_momentum += bodies.mass[i] * cross(bodies.position[i] - Point{}, bodies.velocity[i]) +
                            bodies.moment[i] * bodies.angular_velocity[i];
  }
  return sum;
}

TEST(Fracture, KeepsMassMomentumAndAngularMomentumWhereNothingIsRemoved) {
  for (const auto splitting : {fracture::SplittingModel::kMichel, fracture::SplittingModel::kLefm}) {
    Scene scene = breaking_scene(CuspFate::kFloat, splitting);
    scene.fracture.smallest_floe_area = 0;
    Simulation simulation(scene);
    const Totals before = totals(simulation);
    const double scale = 60 * length(before.momentum);
    for (int step = 0; step < 3000; ++step) {
      simulation.step();
      if (simulation.counts().splits > 20) break;  // the LEFM criterion continues to split
      const Totals now = totals(simulation);
      ASSERT_NEAR(now.mass / before.mass, 1, 1e-12);
      ASSERT_NEAR(length(now.momentum - before.momentum) / length(before.momentum), 0, 1e-11) << step;
      ASSERT_NEAR((now.angular_momentum - before.angular_momentum) / scale, 0, 1e-10) << step;
    }
    const Counts counts = simulation.counts();
    std::printf("%ld bends, %ld splits, %ld floes\n", static_cast<long>(counts.bends),
                static_cast<long>(counts.splits), static_cast<long>(counts.floes_final));
    EXPECT_GT(counts.bends + counts.splits, 2);
    EXPECT_EQ(counts.rejected_cuts, 0);
  }
}

TEST(Fracture, PiecesMoveOnAsThePartsOfOneBody) {
  Simulation simulation(breaking_scene(CuspFate::kSubmerge));
  int checked = 0;
  for (int step = 0; step < 3000; ++step) {
    simulation.step();
    for (const Event& event : simulation.journal().events) {
      std::map<FloeId, FloeState> states;
      for (const FloeState& state : simulation.floe_states()) states[state.floe] = state;
      const World& world = simulation.world();
      for (const FloeId child : event.ice()->children) {
        if (!states.contains(child) || !states.contains(event.ice()->children.front()))
          continue;  // broke again at once
        const FloeState& first = states[event.ice()->children.front()];
        const FloeState& state = states[child];
        const Vector arm =
            world.population.bodies.position[world.population.body_of(child)] -
            world.population.bodies.position[world.population.body_of(event.ice()->children.front())];
        EXPECT_EQ(state.angular_velocity, first.angular_velocity);
        EXPECT_NEAR(length(state.velocity - first.velocity - cross(first.angular_velocity, arm)), 0, 1e-13);
        EXPECT_EQ(state.angle, first.angle);
        EXPECT_NEAR(
            state.mass / (simulation.scene().ice.density * simulation.scene().ice.thickness * state.area), 1,
            1e-14);
        ++checked;
      }
    }
    simulation.journal().clear();
  }
  EXPECT_GT(checked, 3);
}

TEST(Fracture, EveryFloeKnowsItsParentAndTheEventThatMadeIt) {
  for (const CuspFate fate : {CuspFate::kSubmerge, CuspFate::kFloat}) {
    Simulation simulation(breaking_scene(fate));
    const Story story = run(simulation, 15);
    std::map<FloeId, Birth> births;
    for (const Birth& birth : story.births) {
      ASSERT_TRUE(births.emplace(birth.floe, birth).second) << "born twice";
    }
    std::map<FloeId, int> deaths;
    for (const Death& death : story.deaths) {
      ++deaths[death.floe];
      EXPECT_TRUE(death.polygon_in_body == births.at(death.floe).polygon_in_body) << "a shape never changes";
    }
    std::map<FloeId, const Event*> event_of_child;
    for (const Event& event : story.events) {
      ASSERT_FALSE(event.is<RejectedCut>());
      EXPECT_EQ(deaths[event.ice()->floe], 1);
      double area = event.ice()->submerged_area + event.ice()->brash_area - event.ice()->rounding_defect;
      for (const FloeId child : event.ice()->children) {
        ASSERT_TRUE(births.contains(child));
        ASSERT_TRUE(event_of_child.emplace(child, &event).second) << "made by two events";
        area += births[child].area;
      }
      EXPECT_NEAR(area / births[event.ice()->floe].area, 1, 1e-12)
          << "the parts of floe " << event.ice()->floe;
    }
    for (const auto& [id, birth] : births) {
      if (birth.parent == kNoFloe) {
        EXPECT_LT(id, 2);
        EXPECT_EQ(birth.generation, 0);
        EXPECT_FALSE(event_of_child.contains(id));
        continue;
      }
      ASSERT_TRUE(event_of_child.contains(id));
      EXPECT_EQ(event_of_child[id]->ice()->floe, birth.parent);
      EXPECT_EQ(event_of_child[id]->time, birth.time);
      EXPECT_EQ(birth.generation, births[birth.parent].generation + 1);
    }
    std::size_t living = 0;
    for (const FloeState& state : simulation.floe_states()) {
      EXPECT_FALSE(deaths.contains(state.floe));
      EXPECT_EQ(state.parent, births[state.floe].parent);
      EXPECT_EQ(state.born, births[state.floe].time);
      ++living;
    }
    EXPECT_EQ(living, births.size() - deaths.size());
    EXPECT_EQ(simulation.counts().floes_final, static_cast<std::int64_t>(living));
    EXPECT_GT(story.events.size(), 2u);
  }
}

TEST(Fracture, TheAreaLedgerBalancesAtEveryStep) {
  for (const CuspFate fate : {CuspFate::kSubmerge, CuspFate::kFloat}) {
    Simulation simulation(breaking_scene(fate));
    for (int step = 0; step < 3000; ++step) {
      simulation.step();
      const AreaLedger ledger = simulation.area_ledger();
      ASSERT_NEAR(ledger.imbalance / ledger.initial_ice_area, 0, 1e-9) << step;
    }
    const AreaLedger ledger = simulation.area_ledger();
    std::printf("submerged %.3f m2, brash %.4f m2, rounding %.2g m2, imbalance %.2g m2\n",
                ledger.submerged_area, ledger.brash_area, ledger.rounding_defect, ledger.imbalance);
    EXPECT_NEAR(ledger.initial_ice_area, 69.5 * 90 + 48 * 100, 1e-9);
    if (fate == CuspFate::kSubmerge) {
      EXPECT_GT(ledger.submerged_area, 1);
    } else {
      EXPECT_EQ(ledger.submerged_area, 0);
    }
  }
}

TEST(Fracture, TheSameSceneGivesTheSameRecordsToTheLastBit) {
  const auto story = [] {
    Simulation simulation(breaking_scene(CuspFate::kFloat));
    return run(simulation, 10);
  };
  const Story first = story();
  const Story second = story();
  ASSERT_EQ(first.samples.size(), second.samples.size());
  for (std::size_t i = 0; i < first.samples.size(); ++i) {
    EXPECT_TRUE(first.samples[i] == second.samples[i]) << "sample " << i;
  }
  ASSERT_EQ(first.events.size(), second.events.size());
  for (std::size_t i = 0; i < first.events.size(); ++i) {
    const Event& p = first.events[i];
    const Event& q = second.events[i];
    EXPECT_TRUE(p.time == q.time && p.what.index() == q.what.index() && p.ice()->floe == q.ice()->floe &&
                p.ice()->children == q.ice()->children && p.point_in_world == q.point_in_world &&
                p.criteria().vertical_force == q.criteria().vertical_force);
  }
  ASSERT_EQ(first.births.size(), second.births.size());
  for (std::size_t i = 0; i < first.births.size(); ++i) {
    EXPECT_TRUE(first.births[i].polygon_in_body == second.births[i].polygon_in_body);
  }
  EXPECT_EQ(first.deaths, second.deaths);
  EXPECT_GT(first.events.size(), 2u);
}

}  // namespace
}  // namespace polynya::simulation
