// Floes whose thickness, density and strengths are their own.
#include <gtest/gtest.h>

#include "fracture/bending/kashtelyan.hpp"
#include "fracture/crushing.hpp"
#include "simulation/field/random.hpp"
#include "simulation/ice/ice_scatter.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation::scenes {
namespace {

/// Gives a floe of the scene ice of its own.
template <class Change>
void change_ice(Scene& scene, std::size_t floe, Change change) {
  fracture::Ice ice = scene.ice;
  change(ice);
  scene.floes[floe].own_ice = static_cast<std::int32_t>(scene.own_ice.size());
  scene.own_ice.push_back(ice);
}

/// A ship at constant speed that breaks a plate.
Scene plate(double speed = 1) {
  Scene scene;
  scene.time.step = 0.01;
  scene.ships = {icebreaker({-0.5, 0}, ConstantSpeed{speed}, speed)};
  scene.floes = {floe(rectangle(0, -60, 120, 60))};
  scene.fracture.bending = BendingModelKind::kKashtelyan;
  scene.fracture.splitting = fracture::SplittingModel::kMichel;
  return scene;
}

Event first_bend(const Scene& scene, double until = 20) {
  Simulation simulation(scene);
  for (const Event& event : run(simulation, until).events)
    if (event.is<Bend>()) return event;
  ADD_FAILURE() << "nothing bent";
  return {};
}

void expect_balanced(const Simulation& simulation) {
  const MassLedger masses = simulation.mass_ledger();
  EXPECT_GT(masses.initial_ice_mass, 0);
  EXPECT_LT(std::abs(masses.imbalance), 1e-9 * masses.initial_ice_mass);
  EXPECT_TRUE(simulation.audit().is_closed()) << simulation.audit().energy_imbalance;
}

TEST(FloeIce, BreaksAtTheLoadOfItsOwnStrengthAndThickness) {
  const double as_scene = first_bend(plate()).criteria().bending_capacity;
  Scene strong = plate();
  change_ice(strong, 0, [](fracture::Ice& ice) { ice.flexural_strength *= 2; });
  const Event bend = first_bend(strong);
  EXPECT_NEAR(bend.criteria().bending_capacity / as_scene, 2, 1e-9);
  EXPECT_GE(bend.criteria().vertical_force, bend.criteria().bending_capacity);
  EXPECT_EQ(bend.criteria().flexural_strength, 2 * strong.ice.flexural_strength);
  Scene thick = plate();
  change_ice(thick, 0, [](fracture::Ice& ice) { ice.thickness *= 1.5; });
  EXPECT_NEAR(first_bend(thick).criteria().bending_capacity / as_scene, 2.25, 1e-9) << "P goes with h²";
}

TEST(FloeIce, IsWhatTheSceneWouldHaveByAllThatUsesIt) {
  // One floe: to give it the ice is to give the scene that ice, to the bit.
  Scene own = plate();
  own.fracture.bending = BendingModelKind::kFsiDatabase;
  own.fracture.splitting = fracture::SplittingModel::kLefm;
  own.fracture.going_under.is_enabled = own.fracture.resurface.is_enabled = true;
  own.fracture.cusp_fate = CuspFate::kUnderHull;
  own.ships[0].hull.draught = 6;
  Scene scene = own;
  const auto change = [](fracture::Ice& ice) {
    ice = {.thickness = 0.61,
           .density = 880,
           .flexural_strength = 6.3e5,
           .compressive_strength = 2.1e6,
           .tensile_strength = 5.5e5,
           .fracture_toughness = 1.1e5};
  };
  change(scene.ice);
  change_ice(own, 0, change);
  Simulation a(own), b(scene);
  run(a, 25);
  run(b, 25);
  EXPECT_EQ(a.state_hash(), b.state_hash());
  EXPECT_GT(a.counts().bends, 10);
  EXPECT_GT(a.counts().went_under, 10);
  expect_balanced(a);
}

TEST(FloeIce, SplitsByItsOwnTensileStrengthAndToughness) {
  for (const auto model : {fracture::SplittingModel::kMichel, fracture::SplittingModel::kLefm}) {
    Scene own = plate(2);
    own.fracture.splitting = model;
    own.floes = {floe(rectangle(0, -30, 60, 30))};
    Scene scene = own;
    const auto weaken = [](fracture::Ice& ice) {
      ice.tensile_strength *= 0.01;
      ice.fracture_toughness *= 0.2;
    };
    change_ice(own, 0, weaken);
    weaken(scene.ice);
    Simulation a(own), b(scene);
    const Story story = run(a, 10);
    run(b, 10);
    EXPECT_GT(a.counts().splits, 0);
    EXPECT_EQ(a.state_hash(), b.state_hash());
    for (const Event& event : story.events) {
      if (!event.is<Split>()) continue;
      EXPECT_EQ(event.criteria().fracture_toughness, own.own_ice[0].fracture_toughness);
    }
  }
}

TEST(FloeIce, PiecesInheritIt) {
  Scene scene = plate(2);
  scene.floes = {floe(rectangle(0, -40, 40, 40)), floe(rectangle(40.1, -40, 80, 40))};
  change_ice(scene, 1, [](fracture::Ice& ice) {
    ice.thickness = 0.3;
    ice.density = 850;
    ice.flexural_strength = 5e5;
  });
  Simulation simulation(scene);
  run(simulation, 35);
  std::size_t of_second = 0;
  for (const FloeState& state : simulation.all_states()) {
    const bool is_second = state.ice == &simulation.scene().own_ice[0];
    of_second += is_second ? 1 : 0;
    EXPECT_NEAR(state.mass / state.area, is_second ? 0.3 * 850 : 0.5 * 900, 1e-9);
    const double x = transform(state.world_from_body, state.polygon_in_body->outer.front()).x;
    if (std::abs(x - 40) > 15) {
      EXPECT_EQ(is_second, x > 40) << state.floe;
    }
  }
  EXPECT_GT(of_second, 1u);
  EXPECT_GT(simulation.counts().bends, 10);
  expect_balanced(simulation);
}

/// Ice that goes under a hull, of floes that each have their own.
Scene mixed(bool comes_up) {
  Scene scene = plate(4);
  scene.fracture.bending = BendingModelKind::kFsiDatabase;
  scene.fracture.cusp_fate = CuspFate::kUnderHull;
  scene.fracture.going_under.is_enabled = true;
  scene.fracture.resurface.is_enabled = comes_up;
  scene.ships[0].hull.draught = 6;
  scene.floes.clear();
  for (int i = 0; i < 12; ++i) {
    const int column = i / 4;
    const double x = 25 * column, y = 25 * (i % 4) - 50;
    scene.floes.push_back(floe(rectangle(x, y, x + 24.9, y + 24.9)));
    change_ice(scene, scene.floes.size() - 1, [&](fracture::Ice& ice) {
      ice.thickness = 0.3 + 0.02 * (i % 7);
      ice.density = 860 + 10 * (i % 5);
    });
  }
  return scene;
}

TEST(FloeIce, TheLedgerInKilogramsBalancesWhereIceGoesUnderAndComesUp) {
  for (const bool comes_up : {false, true}) {
    Simulation simulation(mixed(comes_up));
    run(simulation, 38);
    const MassLedger masses = simulation.mass_ledger();
    const AreaLedger areas = simulation.area_ledger();
    EXPECT_GT(simulation.counts().went_under, 0);
    EXPECT_GT(comes_up ? masses.brash_mass : masses.under_ice_mass, 0);
    EXPECT_EQ(simulation.counts().came_up > 0, comes_up);
    const double of_area = (masses.brash_mass + masses.under_ice_mass + masses.under_hull_mass) /
                           (areas.brash_area + areas.under_ice_area + areas.under_hull_area);
    EXPECT_GT(of_area, 0.3 * 860);
    EXPECT_LT(of_area, 0.42 * 900);
    expect_balanced(simulation);
  }
}

TEST(FloeIce, TheWeakerIceCrushesAsHighAsTheThinnerFloe) {
  const fracture::Ice thin_and_strong{.thickness = 0.3, .compressive_strength = 3e6};
  const fracture::Ice thick_and_weak{.thickness = 0.8, .compressive_strength = 1e6};
  for (const bool is_swapped : {false, true}) {
    const fracture::Ice crushed = is_swapped ? crushed_between(thick_and_weak, thin_and_strong)
                                             : crushed_between(thin_and_strong, thick_and_weak);
    EXPECT_EQ(crushed.thickness, 0.3);
    EXPECT_EQ(crushed.compressive_strength, 1e6);
  }
  // Two floes, 20 m wide, one fast and driven into the other that a wall of fast ice holds.
  for (const bool is_swapped : {false, true}) {
    Scene scene;
    scene.fracture.breakable_size_factor = 1e9;
    scene.floes = {floe(rectangle(-20, -10, 0, 10), {0.1, 0}), floe(rectangle(0.001, -10, 20, 10))};
    for (FloeSpec& one : scene.floes) one.is_fast = true;
    scene.floes[1].is_fast = false;
    scene.floes.push_back(floe(rectangle(20.001, -200, 420, 200)));
    change_ice(scene, is_swapped ? 1 : 0, [&](fracture::Ice& ice) { ice = thin_and_strong; });
    change_ice(scene, is_swapped ? 0 : 1, [&](fracture::Ice& ice) { ice = thick_and_weak; });
    change_ice(scene, 2, [&](fracture::Ice& ice) { ice.compressive_strength = 1e8; });
    scene.record.contacts = RecordedContacts::kAll;
    Simulation simulation(scene);
    double most = 0;
    for (int step = 0; step < 1000; ++step) {
      simulation.step();
      for (const ContactState& contact : simulation.contact_states())
        if (contact.on.floe == 0) most = std::max(most, length(contact.force));
    }
    EXPECT_NEAR(most / (1e6 * 0.3 * 20), 1, 0.02) << is_swapped;
  }
}

TEST(BendingScatter, FollowsItsLawAtTheContacts) {
  std::vector<double> factors;
  for (int i = 0; i < 5000; ++i) {
    const int row = i / 71;
    factors.push_back(strength_factor(7, {0.37 * (i % 71), 0.11 * row - 3}, 0.25));
  }
  const fracture::ScatterLaw law{fracture::ScatterKind::kLogNormal, 1, 0.25};
  const fracture::ScatterMeasures measures = measure(law, factors);
  EXPECT_LT(measures.distance, 0.023) << "1.63/√n, of 99 in 100";
  EXPECT_NEAR(measures.mean, 1, 0.01);
  EXPECT_NEAR(measures.spread, 0.25, 0.01);
  EXPECT_EQ(strength_factor(7, {1, 2}, 0), 1);
  EXPECT_NE(strength_factor(7, {1, 2}, 0.25), strength_factor(8, {1, 2}, 0.25));
  EXPECT_NE(strength_factor(7, {1, 2}, 0.25), strength_factor(7, {2, 1}, 0.25));
  EXPECT_EQ(strength_factor(7, {0.0, 2}, 0.25), strength_factor(7, {-0.0, 2}, 0.25));
}

TEST(BendingScatter, DrawsFloesOneByOne) {
  const fracture::ScatterLaw law{fracture::ScatterKind::kNormal, 0.5, 0.2, 0.2, 0.8};
  std::vector<double> thickness, strength;
  for (std::size_t floe = 0; floe < 5000; ++floe) {
    thickness.push_back(drawn_property(law, 3, floe, 0));
    strength.push_back(drawn_property(law, 3, floe, 2));
  }
  EXPECT_LT(measure(law, thickness).distance, 0.023);
  double products = 0;  // of two properties: they are independent
  for (std::size_t i = 0; i < thickness.size(); ++i)
    products += (thickness[i] - 0.5) * (strength[i] - 0.5) / 5000;
  EXPECT_LT(std::abs(products), 3 * 0.01 / std::sqrt(5000));
}

Scene scattering(std::uint64_t seed) {
  Scene scene = plate(2);
  scene.fracture.bending = BendingModelKind::kFsiDatabase;
  scene.fracture.bending_scatter = 0.2;
  scene.seed = seed;
  return scene;
}

TEST(BendingScatter, EachEventStatesTheStrengthItBrokeAt) {
  Simulation simulation(scattering(5));
  const Story story = run(simulation, 40);
  std::vector<double> factors;
  for (const Event& event : story.events) {
    if (event.is<Bend>())
      factors.push_back(event.criteria().flexural_strength / simulation.scene().ice.flexural_strength);
  }
  ASSERT_GT(factors.size(), 50u);
  const auto measures = fracture::measure({fracture::ScatterKind::kLogNormal, 1, 0.2}, factors);
  EXPECT_LT(measures.distance, 1.63 / std::sqrt(static_cast<double>(factors.size())));
  EXPECT_NEAR(measures.spread, 0.2, 0.08);
}

TEST(BendingScatter, TheSeedMeansSomethingInLevelIceAndThreadsAndResumeDoNot) {
  Simulation one(scattering(5)), two(scattering(5)), other(scattering(6));
  two.set_threads(2);
  std::optional<Simulation> resumed;
  for (int step = 0; step < 1500; ++step) {
    for (Simulation* simulation : {&one, &two, &other}) {
      simulation->step();
      simulation->journal().clear();
    }
    if (step == 700) {
      auto again = Simulation::resumed(scattering(5), one.state());
      ASSERT_TRUE(again.has_value()) << again.error();
      resumed.emplace(std::move(*again));
    } else if (resumed) {
      resumed->step();
      resumed->journal().clear();
    }
  }
  EXPECT_GT(one.counts().bends, 20);
  EXPECT_EQ(one.state_hash(), two.state_hash());
  EXPECT_EQ(one.state_hash(), resumed->state_hash());
  EXPECT_EQ(one.mass_ledger().brash_mass, resumed->mass_ledger().brash_mass);
  EXPECT_NE(one.state_hash(), other.state_hash());
}

}  // namespace
}  // namespace polynya::simulation::scenes
