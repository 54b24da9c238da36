// Floes with their own thickness, density and strengths.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "fracture/bending/published_forms.hpp"
#include "fracture/crushing.hpp"
#include "simulation/field/portable_math.hpp"
#include "simulation/ice/ice_scatter.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation::scenes {
namespace {

const fracture::Ice kIce;

/// A ship at constant speed, before ice that Kashtelyan's formula breaks.
Build ship_in_ice(double speed = 1) {
  Build scene = Build().step(0.01).ship(icebreaker({-0.5, 0}, ConstantSpeed{speed}, speed));
  scene.fracture.bending = BendingModelKind::kKashtelyan;
  return scene;
}

/// Returns the same scene with ice that goes under the ship and bends by the database.
Build ship_over_ice(double speed, bool comes_up = true) {
  return Build()
      .step(0.01)
      .ship(with_draught(icebreaker({-0.5, 0}, ConstantSpeed{speed}, speed)))
      .under_hulls(comes_up);
}

const geometry::Polygon kPlate = rectangle(0, -60, 120, 60);

TEST(FloeIce, BreaksAtTheLoadOfItsOwnStrengthAndThickness) {
  const double as_scene = first_bend(ship_in_ice().floe(kPlate)).criteria().bending_capacity;
  const fracture::Ice strong{.flexural_strength = 2 * kIce.flexural_strength};
  const auto bend = first_bend(ship_in_ice().floe(kPlate).of(strong));
  EXPECT_NEAR(bend.criteria().bending_capacity / as_scene, 2, 1e-9);
  EXPECT_GE(bend.criteria().vertical_force, bend.criteria().bending_capacity);
  EXPECT_EQ(bend.criteria().flexural_strength, strong.flexural_strength);
  const auto bend_of_thick = first_bend(ship_in_ice().floe(kPlate).of({.thickness = 1.5 * kIce.thickness}));
  EXPECT_NEAR(bend_of_thick.criteria().bending_capacity / as_scene, 2.25, 1e-9) << "P goes with h²";
}

/// In a scene with one floe, giving the ice to the floe is the same as giving it to the scene, to the bit.
Trial expect_same(Build scene, const fracture::Ice& ice, double until) {
  Scene own = Build(scene).of(ice);
  scene.ice = ice;
  Trial a = run(own, until), b = run(scene, until);
  EXPECT_EQ(a.simulation.state_hash(), b.simulation.state_hash());
  expect_closed(a.simulation);
  return a;
}

TEST(FloeIce, IsWhatTheSceneWouldHaveByAllThatUsesIt) {
  const fracture::Ice ice{.thickness = 0.61,
                          .density = 880,
                          .flexural_strength = 6.3e5,
                          .compressive_strength = 2.1e6,
                          .tensile_strength = 5.5e5,
                          .fracture_toughness = 1.1e5};
  const Counts counts = expect_same(ship_over_ice(1).floe(kPlate), ice, 25).simulation.counts();
  EXPECT_GT(counts.bends, 10);
  EXPECT_GT(counts.went_under, 10);
}

TEST(FloeIce, SplitsByItsOwnTensileStrengthAndToughness) {
  const fracture::Ice weak{.tensile_strength = 0.01 * kIce.tensile_strength,
                           .fracture_toughness = 0.2 * kIce.fracture_toughness};
  for (const auto model : {fracture::SplittingModel::kMichel, fracture::SplittingModel::kLefm}) {
    const Story story = expect_same(ship_in_ice(2).floe(rectangle(0, -30, 60, 30)).splitting(model), weak, 10).story;
    EXPECT_FALSE(story.splits().empty());
    for (const auto& event : story.splits()) EXPECT_EQ(event.criteria().fracture_toughness, weak.fracture_toughness);
  }
}

TEST(FloeIce, PiecesInheritIt) {
  const fracture::Ice own{.thickness = 0.3, .density = 850, .flexural_strength = 5e5};
  const Simulation simulation =
      run(ship_in_ice(2).floe(rectangle(0, -40, 40, 40)).floe(rectangle(40.1, -40, 80, 40)).of(own), 35).simulation;
  std::size_t of_second = 0;
  for (const FloeState& state : simulation.floe_states(Living::kAll)) {
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
  expect_closed(simulation);
}

TEST(FloeIce, TheLedgerInKilogramsBalancesWhereIceGoesUnderAndComesUp) {
  for (const bool comes_up : {false, true}) {
    Build scene = ship_over_ice(4, comes_up);
    for (int i = 0; i < 12; ++i) {
      const int column = i / 4;
      scene.floe(shapes::square({25.0 * column, 25.0 * (i % 4) - 50}, 24.9))
          .of({.thickness = 0.3 + 0.02 * (i % 7), .density = 860.0 + 10 * (i % 5)});
    }
    const Simulation simulation = run(scene, 38).simulation;
    const IceLedger masses = simulation.mass_ledger();
    const IceLedger areas = simulation.area_ledger();
    EXPECT_GT(simulation.counts().went_under, 0);
    EXPECT_GT(comes_up ? masses.brash : masses.under_ice, 0);
    EXPECT_EQ(simulation.counts().came_up > 0, comes_up);
    const double of_area =
        (masses.brash + masses.under_ice + masses.under_hulls) / (areas.brash + areas.under_ice + areas.under_hulls);
    EXPECT_GT(of_area, 0.3 * 860);
    EXPECT_LT(of_area, 0.42 * 900);
    expect_closed(simulation);
  }
}

TEST(FloeIce, TheWeakerIceCrushesAsHighAsTheThinnerFloe) {
  const fracture::Ice thin_and_strong{.thickness = 0.3, .compressive_strength = 3e6};
  const fracture::Ice thick_and_weak{.thickness = 0.8, .compressive_strength = 1e6};
  for (const auto& [a, b] : {std::pair(thin_and_strong, thick_and_weak), {thick_and_weak, thin_and_strong}}) {
    EXPECT_EQ(crushed_between(a, b).thickness, 0.3);
    EXPECT_EQ(crushed_between(a, b).compressive_strength, 1e6);
    // Two floes, 20 m wide, one fast and driven into the other that a plate of strong ice holds.
    Scene scene = Build()
                      .unbreakable()
                      .floe(fast(rectangle(-20, -10, 0, 10), {0.1, 0}))
                      .of(a)
                      .floe(rectangle(0.001, -10, 20, 10))
                      .of(b)
                      .floe(rectangle(20.001, -200, 420, 200))
                      .of({.compressive_strength = 1e8});
    scene.record.contacts = RecordedContacts::kAll;
    Simulation simulation(scene);
    double most = 0;
    for (int step = 0; step < 1000; ++step) {
      skip(simulation);
      for (const ContactState& contact : simulation.contact_states())
        if (contact.on.floe == 0) most = std::max(most, length(contact.force));
    }
    EXPECT_NEAR(most / (1e6 * 0.3 * 20), 1, 0.02);
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
  double products = 0;  // sum of products of two properties, which are independent
  for (std::size_t i = 0; i < thickness.size(); ++i) products += (thickness[i] - 0.5) * (strength[i] - 0.5) / 5000;
  EXPECT_LT(std::abs(products), 3 * 0.01 / std::sqrt(5000));
}

Scene scattering(std::uint64_t seed) {
  Scene scene = Build().step(0.01).without_splits().ship(icebreaker({-0.5, 0}, ConstantSpeed{2}, 2)).floe(kPlate);
  scene.fracture.bending_scatter = 0.2;
  scene.seed = seed;
  return scene;
}

/// Each event states exactly the strength that was drawn at the first touch. The distribution of these strengths
/// follows from the law only as a bound: the weaker of two places that one cusp takes breaks. The mean is therefore
/// between the mean of the lesser of two draws, 1 − s/√π for a small spread s, and the mean of one draw. The tolerance
/// is three standard errors of either.
TEST(BendingScatter, EachEventStatesTheStrengthItBrokeAt) {
  constexpr double kSpread = 0.2;
  std::vector<double> factors;
  for (const std::uint64_t seed : {5U, 6U, 7U, 8U}) {  // events of one run follow each other
    Simulation simulation(scattering(seed));
    while (simulation.time() < 40) {
      simulation.step();
      for (const Event& event : simulation.journal().events) {
        if (!event.is<Bend>()) continue;
        factors.push_back(event.criteria().flexural_strength / kIce.flexural_strength);
        EXPECT_TRUE(std::ranges::any_of(simulation.world().data.fractures, [&](const PendingFracture& pending) {
          const double drawn = strength_factor(seed, pending.first_touch_in_body, kSpread);
          return pending.floe == event.ice()->floe && std::abs(drawn / factors.back() - 1) < 1e-12;
        })) << event.time;
      }
      simulation.journal().clear();
    }
  }
  ASSERT_GT(factors.size(), 50u);
  const auto measures = fracture::measure({fracture::ScatterKind::kLogNormal, 1, kSpread}, factors);
  const double error = 3 * kSpread / std::sqrt(static_cast<double>(factors.size()));
  EXPECT_LT(measures.mean, 1 + error);
  EXPECT_GT(measures.mean, 1 - kSpread / std::sqrt(std::numbers::pi) - error);
  EXPECT_NEAR(measures.spread, kSpread, 0.08);
}

TEST(BendingScatter, TheSeedMeansSomethingInLevelIceAndThreadsAndResumeDoNot) {
  const Simulation one = expect_resumes(scattering(5), 7, 15, 2).simulation;
  EXPECT_GT(one.counts().bends, 20);
  EXPECT_EQ(one.mass_ledger().brash, run(scattering(5), 15).simulation.mass_ledger().brash);
  EXPECT_NE(one.state_hash(), run(scattering(6), 15).simulation.state_hash());
}

}  // namespace
}  // namespace polynya::simulation::scenes
