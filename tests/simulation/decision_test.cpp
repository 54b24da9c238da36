// Tests of docs/theory/decision.md: the floes that break under each hull, the time and kind of the break, and
// regressions.
#include <algorithm>

#include <gtest/gtest.h>

#include "bench/wedge_studies.hpp"
#include "fracture/characteristic_length.hpp"
#include "fracture/crushing.hpp"
#include "simulation/world/limits.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

Build ship_against(const Ship& ship, const geometry::Polygon& ice, Laws laws = Laws::kDefault) {
  return Build(laws).ship(ship).floe(ice);
}

TEST(Decision, AFloeSmallerThanTheBreakableSizeIsPushedNeverBroken) {
  // √area just below l = 8.909 m by its definition; 40 m below 79.4 m as printed.
  for (const bool as_printed : {false, true}) {
    const double size = as_printed ? 40 : 8.9;
    Scene scene =
        ship_against(icebreaker({0, 0}, ConstantSpeed{2}), rectangle(0.1, -0.3 * size, 0.1 + size, 0.7 * size));
    if (as_printed) scene.fracture.characteristic_length = fracture::CharacteristicLength::kAsPrinted;
    const auto [simulation, story] = run(scene, 20);
    EXPECT_TRUE(std::ranges::all_of(story.events, &Event::is<Grind>)) << "it is only crushed";
    EXPECT_EQ(simulation.counts().floes_final, 1);
    EXPECT_GT(distance(simulation.floe_states()[0].world_from_body.position, {}), 1) << "it was pushed";
  }
}

TEST(Decision, ThePapersPlateIsKnifeEdge) {
  // A central hit at 1 m/s gives j/τ_c = 10.9 MN, compared with F_s = 11 MN. A hit that is 2 % faster splits the floe;
  // a hit at 1 m/s does not.
  for (const double speed : {1.0, 1.02}) {
    const auto [simulation, story] = run(
        ship_against(icebreaker({0, 0}, ConstantThrust{0}, speed), rectangle(0.001, -100, 110.001, 100), Laws::kPaper),
        0.5);
    const double peak = largest(story, &HullSample::collision);
    EXPECT_NEAR(peak, 1.1 * speed / (1e-7 + 1 / (900 * 0.5 * 110 * 200)) / 0.5, 0.01e6);
    EXPECT_EQ(simulation.counts().splits > 0, speed > 1);
    if (speed == 1.0) {
      EXPECT_NEAR(peak, 10.945e6, 0.01e6);
      continue;
    }
    ASSERT_FALSE(story.splits().empty());
    const auto event = story.splits().front();
    EXPECT_NEAR(event.criteria().splitting_force, 11e6, 1e4);
    EXPECT_NEAR(event.criteria().crack_length, 110, 0.1);
    EXPECT_GT(event.criteria().collision_force, event.criteria().splitting_force);
    EXPECT_EQ(event.ice()->children.size(), 2u);
    double area = 0;
    for (const Birth& birth : story.births) area += birth.time == event.time ? birth.area : 0;
    EXPECT_NEAR(area, 110 * 200, 1e-9);
  }
}

TEST(Decision, LefmSplitsWhereMichelDoesNotAndStatesBothSides) {
  using enum fracture::SplittingModel;
  for (const auto model : {kMichel, kLefm, kNone}) {
    Scene scene =
        ship_against(icebreaker({0, 0}, ConstantThrust{0}, 0.5), rectangle(0.001, -30, 50.001, 30), Laws::kPaper)
            .splitting(model);
    scene.ice.fracture_toughness = 50e3;
    const Story story = run(scene, 1).story;
    const bool is_lefm = model == kLefm;
    EXPECT_EQ(!story.splits().empty(), is_lefm);
    if (model == kNone) continue;
    for (const Event& event : story.events) {
      EXPECT_GT(event.criteria().contact_force, 0);
      EXPECT_EQ(event.criteria().splitting_force > 0, !is_lefm) << "F_s of Eq. (4)";
    }
    for (const auto& event : story.splits()) {
      EXPECT_GE(event.criteria().opening_force, event.criteria().opening_capacity);
      EXPECT_GT(event.criteria().opening_capacity, 0);
      EXPECT_FALSE(event.criteria().leaves_sliver);
      EXPECT_GE(event.criteria().floe_size, event.criteria().breakable_size);
    }
  }
}

TEST(Decision, AnInclinedBowBendsWhenItsVerticalForceReachesTheCapacity) {
  for (const Laws laws : kBothLaws) {
    const auto [simulation, story] =
        run(ship_against(icebreaker({0, 0}, ConstantSpeed{1}), rectangle(0.5, -100, 60.5, 100), laws), 20);
    EXPECT_GT(simulation.counts().bends, 3);
    EXPECT_EQ(simulation.counts().rejected_cuts, 0);
    for (const auto& event : story.bends()) {
      EXPECT_GT(event.criteria().vertical_force, 0);
      EXPECT_GE(event.criteria().vertical_force, event.criteria().bending_capacity);
      EXPECT_GE(event.criteria().floe_size, event.criteria().breakable_size);
      EXPECT_GT(std::get<Bend>(event.what).cusp_radius, 0);
      EXPECT_LT(std::get<Bend>(event.what).cusp_radius, 2 * 8.909);
      EXPECT_GT(event.ice()->penetration, 0);
      EXPECT_NEAR(length(event.ice()->normal_in_world), 1, 1e-12);
    }
  }
}

TEST(Decision, ARejectedCutIsRecordedCountedAndLeavesTheFloe) {
  // The far edge of the plate crosses itself, so the floe is not valid, and neither is any cut of it.
  const geometry::Polygon crossed{{{0.5, -30}, {60, -30}, {60, 30}, {40, 30}, {45, 35}, {45, 29}, {0.5, 30}}, {}};
  const auto [simulation, story] = run(ship_against(icebreaker({0, 0}, ConstantSpeed{1}), crossed), 5);
  const Counts counts = simulation.counts();
  EXPECT_GT(counts.rejected_cuts, 0);
  EXPECT_EQ(counts.rejected_cuts, std::ssize(story.events));
  EXPECT_EQ(counts.rejected_cuts, std::ssize(story.rejected_cuts()));
  for (const auto& event : story.rejected_cuts()) {
    const std::string reason = std::get<RejectedCut>(event.what).reason;
    EXPECT_NE(reason.find("invalid"), std::string::npos) << reason;
  }
  EXPECT_EQ(counts.bends + counts.splits, 0);
  EXPECT_EQ(counts.floes_final, 1);
  EXPECT_NEAR(simulation.area_ledger().imbalance(), 0, 1e-9);
}

// ---- when a corner breaks, against the solution of that one push

constexpr double kHullAngle = 38.2 * kDegree, kHalfAngle = 45 * kDegree, kSpeed = 0.2;

/// Returns a flat inclined bow that approaches a right corner of 80 000 m² of ice.
Scene corner_under_a_wall(bool follows_deflection) {
  Ship bow = barge({-0.001, 0}, ConstantSpeed{kSpeed}, kSpeed);
  set_hull_angle(bow, kHullAngle);
  Scene scene =
      Build().without_drag().without_splits().ship(bow).floe(shapes::diamond({0, 0}, 283 * std::sin(kHalfAngle)));
  scene.fracture.follows_deflection = follows_deflection;
  scene.fracture.outline = fracture::EdgeOutline::kWedge;  // which that solution is of
  return scene;
}

fracture::BendingForecast forecast(fracture::Feedback feedback) {
  fracture::BendingLoad load;
  load.front_half_angle = load.back_half_angle = kHalfAngle;
  load.hull_angle = kHullAngle;
  load.mean_approach_speed = kSpeed;
  load.vertical_to_crushing = fracture::crushing_shares(kHullAngle, load.ice.friction, kSpeed, 0).vertical;
  return direct_forecast(wedge_of(load, {}), load, feedback).value();
}

TEST(Bending, TheHullFollowsIceThatBendsAwayOrOnlyCrushesIt) {
  const auto event = first_bend(corner_under_a_wall(true));
  const auto coupled = forecast(fracture::Feedback::kCoupled);
  EXPECT_NEAR(event.time / coupled.time, 1, 0.05);
  EXPECT_NEAR(event.criteria().vertical_force / coupled.capacity.vertical_force, 1, 0.02);
  EXPECT_NEAR(event.ice()->penetration / coupled.penetration, 1, 0.03);
  EXPECT_NEAR(std::get<Bend>(event.what).cusp_radius / coupled.capacity.cusp_radius, 1, 0.12);
  const auto crushed = first_bend(corner_under_a_wall(false));
  const auto ignored = forecast(fracture::Feedback::kIgnored);
  EXPECT_NEAR(crushed.time / ignored.time, 1, 0.03);
  EXPECT_NEAR(std::get<Bend>(crushed.what).cusp_radius / ignored.capacity.cusp_radius, 1, 0.03);
  EXPECT_GT(event.time, 1.3 * crushed.time);
}

/// V_b and R follow the depth of the facet, which a step finds up to 0.026 m before or after the ice breaks.
TEST(Bending, TheCuspIsNotTheSteps) {
  const auto radius = [](double step) {
    Ship bow = barge({-0.001, 0}, ConstantSpeed{1.5}, 1.5);
    set_hull_angle(bow, kHullAngle);
    Build scene = Build().thickness(0.3).step(step).without_drag().without_splits().ship(bow);
    scene.floe(fast({{{0, 0}, {40, -450}, {80, -450}, {80, 450}, {40, 450}}, {}}));  // a corner of 170 degrees
    return std::get<Bend>(first_bend(scene).what).cusp_radius;
  };
  const double fine = radius(0.0002);
  for (const double step : {0.01, 0.02, 0.03, 0.05}) EXPECT_NEAR(radius(step) / fine, 1, 0.006) << step;
}

/// Whether the ice recedes does not change the load of a vertical wall, or of a floe that is too small to break.
TEST(Bending, WhatCannotBendDoesNotRecede) {
  for (const bool is_small : {false, true}) {
    const auto speed = [&](bool follows) {
      Scene scene = corner_under_a_wall(follows);
      if (is_small)
        scene.fracture.breakable_size_factor = 100;
      else
        set_hull_angle(scene.ships[0], 0);
      return run(scene, 1).simulation.floe_states()[0].velocity.x;
    };
    EXPECT_EQ(speed(true), speed(false));
  }
}

// ---- what once went wrong: what must hold, not what the code gave

/// A floe that starts in motion used to be woken before the floes behind it in the scene existed, and ran into them.
TEST(Regression, AMovingFloeMeetsFloesThatTheSceneListsLater) {
  for (const bool is_mover_first : {true, false}) {
    Build scene = Build().without_drag();
    const FloeSpec mover = floe(rectangle(0, 0, 10, 10), {1, 0}), rester = floe(rectangle(10.5, 0, 20.5, 10));
    scene.floe(is_mover_first ? mover : rester).floe(is_mover_first ? rester : mover);
    Simulation simulation(scene);
    while (simulation.world().data.contacts.empty() && simulation.time() < 3) simulation.step();
    EXPECT_NEAR(simulation.time(), 0.5, 3 * scene.time.step) << is_mover_first;
    EXPECT_LT(simulation.world().data.contacts.front().depth, 2 * scene.time.step);
  }
}

/// Restitution was charged by the whole squeeze, step after step, and threw the small floe off at 1.45 m/s.
TEST(Regression, APinchedFloeIsNotThrownOff) {
  for (const double restitution : {0.0, 0.1, 0.3}) {
    Simulation simulation(Build(Laws::kPaper)
                              .unbreakable()
                              .restitution(restitution)
                              .ship(barge({0, 0}, ConstantSpeed{1}))
                              .floe(rectangle(0.1, -5, 10.1, 5))
                              .floe(rectangle(10.2, -55, 210.2, 55)));
    double fastest = 0, spin = 0;
    for (int i = 0; i < 2000; ++i) {
      skip(simulation);
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
  EXPECT_FALSE(can_be_floe({1, {}, -1e-20}));
}

/// The halves of a floe with a weak criterion used to split again in every step along the crack that they had just
/// left, and corners were cut off strip by strip. The ice on either side of a crack must not be a sliver.
TEST(Regression, ACrackIsNotParedStripByStrip) {
  for (const auto model : {fracture::SplittingModel::kMichel, fracture::SplittingModel::kLefm}) {
    Scene scene = ship_against(icebreaker({0, 3}, ConstantSpeed{0.5}, 0.5), rectangle(0.5, -40, 70, 50), Laws::kPaper)
                      .splitting(model);
    scene.fracture.splitting_shape_factor = 0.02;
    scene.ice.fracture_toughness = 20e3;
    const Story story = run(scene, 5).story;
    EXPECT_GE(story.splits().size(), 1u);
    EXPECT_LE(story.splits().size(), 40u);
    const double l = fracture::characteristic_length(scene.ice, scene.water.water);
    for (const auto& event : story.splits()) {
      EXPECT_GE(least_child(story, event), 0.499 * l * l) << event.time;
      EXPECT_GE(least_child(story, event) / event.criteria().crack_length, 0.49 * l) << event.time;
    }
  }
}

}  // namespace
}  // namespace polynya::simulation
