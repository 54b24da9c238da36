// Quantities that a fracture conserves, with both laws: mass, momentum, angular momentum and area. Parents and children
// are consistent, and energy and momentum at the end equal those of the accounts.
#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "simulation/state/state.hpp"
#include "simulation/world/energy.hpp"
#include "tests/dynamics/scenery.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Vector;

/// Returns a moving, turning plate that a free ship breaks by bending and by splitting.
Build breaking_scene(Laws laws, CuspFate fate) {
  Build scene = Build(laws)
                    .without_drag()
                    .cusps(fate)
                    .ship(icebreaker({0, 3}, ConstantThrust{0}, 2))
                    .floe(rectangle(0.5, -40, 70, 50), {-0.2, 0.05}, 1e-3)
                    .floe(rectangle(72, -40, 120, 60));
  scene.contact.separation_time = 1e15;  // moves bodies without their momentum
  return scene;
}

TEST(Fracture, KeepsMassMomentumAndAngularMomentumWhereNothingIsRemoved) {
  using enum fracture::SplittingModel;
  for (const auto& [laws, splitting] :
       {std::pair{Laws::kDefault, kLefm}, {Laws::kDefault, kMichel}, {Laws::kPaper, kLefm}, {Laws::kPaper, kMichel}}) {
    Build scene = breaking_scene(laws, CuspFate::kFloat).splitting(splitting);
    scene.fracture.smallest_floe_area = 0;
    Simulation simulation(scene);
    const auto living = [&] {
      dynamics::Bodies bodies = simulation.world().population.bodies;
      for (dynamics::BodyIndex i = 0; i < bodies.size(); ++i)
        if (!bodies.is_alive[i]) bodies.mass[i] = bodies.moment[i] = 0;
      return bodies;
    };
    const dynamics::Bodies before = living();
    const Vector momentum = scenery::momentum(before);
    for (int step = 0; step < 3000 && simulation.counts().splits < 20; ++step) {
      simulation.step();
      if (simulation.counts().ground > 0) break;  // crushed ice is removed
      const dynamics::Bodies now = living();
      ASSERT_NEAR(scenery::mass(now) / scenery::mass(before), 1, 1e-12);
      ASSERT_NEAR(length(scenery::momentum(now) - momentum) / length(momentum), 0, 1e-11) << step;
      ASSERT_NEAR(scenery::angular_momentum(now) - scenery::angular_momentum(before), 0, 1e-10 * 60 * length(momentum))
          << step;
    }
    EXPECT_GT(simulation.counts().bends + simulation.counts().splits, 2);
    EXPECT_EQ(simulation.counts().rejected_cuts, 0);
  }
}

TEST(Fracture, PiecesMoveOnAsThePartsOfOneBody) {
  for (const Laws laws : kBothLaws) {
    Simulation simulation(breaking_scene(laws, CuspFate::kSubmerge));
    const Population& population = simulation.world().population;
    const auto centre = [&](FloeId floe) { return population.bodies.position[population.body_of(floe)]; };
    int checked = 0;
    for (int step = 0; step < 3000; ++step) {
      simulation.step();
      for (const Event& event : simulation.journal().events) {
        std::map<FloeId, FloeState> states;
        for (const FloeState& state : simulation.floe_states()) states[state.floe] = state;
        for (const FloeId child : event.ice()->children) {
          const FloeId eldest = event.ice()->children.front();
          if (!states.contains(child) || !states.contains(eldest)) continue;  // broke again at once
          const FloeState &first = states[eldest], &state = states[child];
          const Vector arm = centre(child) - centre(eldest);
          EXPECT_EQ(state.angular_velocity, first.angular_velocity);
          EXPECT_EQ(state.angle, first.angle);
          EXPECT_NEAR(length(state.velocity - first.velocity - cross(first.angular_velocity, arm)), 0, 1e-13);
          EXPECT_NEAR(state.mass / (900 * 0.5 * state.area), 1, 1e-14);
          ++checked;
        }
      }
      simulation.journal().clear();
    }
    EXPECT_GT(checked, 3);
  }
}

/// Checks that every floe has the parent and the event that it came from, and that the parts of a floe add up to the
/// whole.
void expect_lineage(const Trial& run) {
  std::map<FloeId, Birth> births;
  for (const Birth& birth : run.story.births) ASSERT_TRUE(births.emplace(birth.floe, birth).second) << "born twice";
  std::map<FloeId, int> deaths;
  for (const Death& death : run.story.deaths) {
    ++deaths[death.floe];
    EXPECT_TRUE(death.polygon_in_body == births.at(death.floe).polygon_in_body) << "a shape never changes";
  }
  std::map<FloeId, const Event*> event_of_child;
  for (const Event& event : run.story.events) {
    EXPECT_EQ(deaths[event.ice()->floe], 1);
    double area = event.ice()->submerged_area + event.ice()->brash_area - event.ice()->rounding_defect;
    for (const FloeId child : event.ice()->children) {
      ASSERT_TRUE(births.contains(child));
      ASSERT_TRUE(event_of_child.emplace(child, &event).second) << "made by two events";
      area += births[child].area;
    }
    EXPECT_NEAR(area / births[event.ice()->floe].area, 1, 1e-12) << "the parts of floe " << event.ice()->floe;
  }
  for (const auto& [id, birth] : births) {
    ASSERT_EQ(event_of_child.contains(id), id >= 2);
    if (id < 2) {
      EXPECT_EQ(birth.parent, kNoFloe);
      EXPECT_EQ(birth.generation, 0);
      continue;
    }
    EXPECT_EQ(event_of_child[id]->ice()->floe, birth.parent);
    EXPECT_EQ(event_of_child[id]->time, birth.time);
    EXPECT_EQ(birth.generation, births[birth.parent].generation + 1);
  }
  const std::vector<FloeState> living = run.simulation.floe_states();
  for (const FloeState& state : living) {
    EXPECT_FALSE(deaths.contains(state.floe));
    EXPECT_EQ(state.parent, births[state.floe].parent);
    EXPECT_EQ(state.born, births[state.floe].time);
  }
  EXPECT_EQ(living.size(), births.size() - deaths.size());
  EXPECT_EQ(run.simulation.counts().floes_final, std::ssize(living));
}

TEST(Fracture, EveryFloeHasItsParentAndTheEventThatMadeItAndTheAreasBalanceAtEveryStep) {
  for (const Laws laws : kBothLaws) {
    for (const CuspFate fate : {CuspFate::kSubmerge, CuspFate::kFloat}) {
      Trial done{Simulation(breaking_scene(laws, fate)), {}};
      EXPECT_NEAR(done.simulation.area_ledger().initial, 69.5 * 90 + 48 * 100, 1e-9);
      while (done.simulation.time() < 15) {
        listen(done.simulation, done.story);
        done.simulation.step();
        const IceLedger ledger = done.simulation.area_ledger();
        ASSERT_NEAR(ledger.imbalance() / ledger.initial, 0, 1e-9) << done.simulation.time();
      }
      listen(done.simulation, done.story);
      EXPECT_EQ(done.simulation.area_ledger().submerged > 1, fate == CuspFate::kSubmerge);
      EXPECT_EQ(done.simulation.counts().floated_cusps > 0, fate == CuspFate::kFloat);
      EXPECT_TRUE(done.story.rejected_cuts().empty());
      EXPECT_GT(done.story.events.size(), 2u);
      expect_lineage(done);
    }
  }
}

/// A scene with a ship, or a structure of the same form, in two plates and small floes, with all energy sinks active.
Build busy_scene(Laws laws) {
  Build scene = Build(laws).floe(rectangle(0.5, -40, 70, 50), {-0.2, 0.05}, 1e-3).floe(rectangle(72, -40, 120, 60));
  for (int i = 0; i < 12; ++i) scene.floe(rectangle(-60 + 6 * i, -25, -55 + 6 * i, -18), {0.05 * i, 0.4});
  return scene;
}

Audit closed_audit(const Scene& scene, double until) {
  const Trial done = run(scene, until);
  expect_closed(done.simulation);
  return done.simulation.audit();
}

TEST(EnergyAudit, ClosesWhereAShipUnderThrustBreaksIceAndCuspsLeaveOrFloat) {
  for (const Laws laws : kBothLaws) {
    Build scene = busy_scene(laws).ship(icebreaker({0, 3}, ConstantThrust{2e5}, 2));
    const auto e = closed_audit(scene, 40).sums.energy;
    EXPECT_GT(e.thrust, 0);
    EXPECT_GT(e.drag, 0);
    EXPECT_GT(e.friction, 0);
    EXPECT_GT(e.crushing, 0);
    EXPECT_GT(e.bending, 0) << "cusps leave with their motion";
    EXPECT_EQ(e.current, 0);
    closed_audit(scene.cusps(CuspFate::kFloat).splitting(fracture::SplittingModel::kLefm), 20);
  }
}

TEST(EnergyAudit, ClosesWithAPrescribedShipInADriftAndWithAStructureInAShearedCurrent) {
  for (const Laws laws : kBothLaws) {
    const Audit prescribed =
        closed_audit(busy_scene(laws).drift({0.3, -0.1}).ship(icebreaker({0, 3}, ConstantSpeed{2}, 2)), 30);
    EXPECT_GT(prescribed.sums.energy.thrust, 0) << "what holds the speed works";
    EXPECT_GT(length(prescribed.sums.momentum.held), 0);
    const geometry::Ring hull = wedge_bow_waterline(120, 24, 27 * kDegree);
    const Audit sheared =
        closed_audit(busy_scene(laws).drift({-0.5, 0}).shear(1e-3).structure(hull, {-60, 3}, 50 * kDegree), 30);
    EXPECT_NE(sheared.sums.energy.current, 0);
  }
}

TEST(EnergyAudit, FailsOnAChangeWithoutAnEntry) {
  Trial done = run(busy_scene(Laws::kDefault).ship(icebreaker({0, 3}, ConstantThrust{2e5}, 2)), 5);
  ASSERT_TRUE(done.simulation.audit().is_closed());
  const_cast<World&>(done.simulation.world()).population.bodies.velocity[0].y += 0.01;
  EXPECT_FALSE(done.simulation.audit().is_closed()) << "a ship pushed aside by nothing";
}

/// An entry of an account that is wrong by a share of the reference value of that account.
struct Planted {
  const char* account = "";
  std::function<void(Accounts&, double share, const Audit&)> plant;
  std::function<bool(const Simulation&)> is_closed;
};

const std::vector<Planted>& planted() {
  const auto audit = [](const Simulation& s) { return s.audit().is_closed(); };
  const auto is_valid = [](const Simulation& s) { return !validate_world(s.world()).has_value(); };
  static const std::vector<Planted> all{
      {"energy", [](Accounts& a, double share, const Audit& now) { a.audit.energy.drag += share * now.turnover; },
       audit},
      {"stored energy",
       [](Accounts& a, double share, const Audit& now) { a.audit.moorings.initial -= share * now.turnover; }, audit},
      {"momentum",
       [](Accounts& a, double share, const Audit& now) { a.audit.momentum.held.y += share * now.momentum_turnover; },
       audit},
      {"area", [](Accounts& a, double share, const Audit&) { a.areas.brash += 1e-3 * share * a.areas.initial; },
       is_valid},
      {"mass", [](Accounts& a, double share, const Audit&) { a.masses.submerged -= 1e-3 * share * a.masses.initial; },
       is_valid}};
  return all;
}

/// Tolerances are 1e-6 of the turnover for energy and momentum, and 1e-9 of the ice for areas and masses.
TEST(EveryAlarm, IsRaisedByTwiceItsToleranceAndNotByHalf) {
  for (const Planted& each : planted()) {
    for (const double share : {0.0, 5e-7, -5e-7, 2e-6, -2e-6}) {
      Trial done = run(busy_scene(Laws::kDefault).ship(icebreaker({0, 3}, ConstantThrust{2e5}, 2)), 2);
      each.plant(const_cast<World&>(done.simulation.world()).accounts, share, done.simulation.audit());
      EXPECT_EQ(each.is_closed(done.simulation), std::abs(share) < 1e-6) << each.account << ' ' << share;
    }
  }
}

/// Momenta that cancel are accounted for. Floes whose momenta add up to zero, and floes that only spin, meet and stop
/// without any outer impulse.
TEST(EveryAlarm, IsNotRaisedByMomentaThatCancel) {
  for (const Laws laws : kBothLaws) {
    for (const double spin : {0.0, 0.1}) {
      const double speed = spin == 0 ? 0.3 : 0;  // of 20 m x 20 m against 15 m x 16 m
      Simulation simulation(Build(laws)
                                .without_drag()
                                .floe(rectangle(-21, -10, -1, 10), {speed, 0}, spin)
                                .floe(rectangle(1, -7, 16, 9), {-speed * 400 / 240, 0}, spin));
      double largest = 0;
      for (int step = 0; step < 4000; ++step) {
        skip(simulation);
        const Audit audit = simulation.audit();
        largest = std::max(largest, length(audit.momentum_imbalance));
        ASSERT_TRUE(audit.is_closed()) << step << ' ' << length(audit.momentum_imbalance);
      }
      EXPECT_GT(simulation.counts().peak_contacts, 0);
      EXPECT_EQ(simulation.audit().sums.impulses, 0) << "no outer impulse";
      EXPECT_GT(largest, 1e-6 * length(simulation.audit().sums.initial_momentum)) << "what rounding leaves of nothing";
    }
  }
}

/// A flow to and fro adds to the turnover in both directions.
TEST(EveryAlarm, ComparesWithWhatWentToAndFro) {
  AuditSums sums;
  open_accounts({}, sums);
  for (int i = 0; i < 10; ++i) {
    const AuditSums before = sums;
    sums.energy.thrust += i % 2 == 0 ? 3 : -3;
    sums.energy.drag += 0.5;
    enter_exchange(before, sums);
  }
  EXPECT_EQ(sums.energy.thrust, 0);
  EXPECT_DOUBLE_EQ(audit(sums, {}).turnover, 10 * 3.5);
}

}  // namespace
}  // namespace polynya::simulation
