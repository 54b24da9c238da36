// Hulls in fast ice, which does not give way: fast ice that drifts, or a ship that keeps its speed.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/cut/overlap.hpp"
#include "simulation/ice/prescribed.hpp"
#include "simulation/world/step.hpp"
#include "simulation/world/world.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

constexpr double kLineLoad = 2.8e6 * 0.5;  // σ_c h [N/m]
constexpr double kRadius = 5;              // [m]
constexpr double kWay = 100;               // [m]

struct Drift {
  double speed = 0;  ///< speed of the ice against the hull [m/s]
  double step = 0;   ///< [s]
};
constexpr Drift kDrifts[] = {{0.2, 0.05}, {0.2, 0.02}, {1, 0.05}, {1, 0.02}};

/// Makes a plate that drifts onto a structure at the origin. The edge of the plate is at `edge`.
Build drifting_onto(const geometry::Ring& hull, double edge, Drift drift) {
  return Build()
      .without_splits()
      .step(drift.step)
      .structure(hull)
      .floe(fast(rectangle(edge - 200, -40, edge, 40), {drift.speed, 0}));
}

/// Runs the scene over the distance kWay, and checks that no step presses with more than `most` [N].
Trial over_the_way(const Scene& scene, double speed, double most) {
  Trial done = run(scene, kWay / speed, [&](const Simulation& simulation) {
    geometry::Vector force{};
    for (const dynamics::Contact& c : simulation.world().data.contacts)
      force += (c.step_share / scene.time.step) * c.impulse_on_b();
    EXPECT_LT(length(force), 1.005 * most) << simulation.time();
  });
  EXPECT_FALSE(done.simulation.numerical_failure().has_value());
  expect_closed(done.simulation);
  return done;
}

/// The load is σ_c h 2r if the front half is entirely in the ice. The work is then σ_c h times the area of the channel.
/// This area is 2r (s − r) + ½ π r² for a cylinder, and 2r s for a flat face, from the first touch on.
TEST(Prescribed, ACylinderAndAFlatFaceCrushTheChannelsThatTheyLeave) {
  const double load = kLineLoad * 2 * kRadius;
  const double of_cylinder = 2 * kRadius * (kWay - kRadius) + 0.5 * std::numbers::pi * kRadius * kRadius;
  for (const Drift drift : kDrifts) {
    for (const auto& [hull, area] : {std::pair{cylinder_waterline(kRadius), of_cylinder},
                                     {rectangle(-kRadius, -5, 6, 5).outer, 2 * kRadius * kWay}}) {
      SCOPED_TRACE(testing::Message() << area << " m2 at " << drift.speed << " in steps of " << drift.step);
      const Trial done = over_the_way(drifting_onto(hull, -kRadius, drift), drift.speed, load);
      EXPECT_NEAR(done.simulation.audit().sums.energy.crushing / (kLineLoad * area), 1, 0.02);
      EXPECT_NEAR(done.simulation.area_ledger().brash / area, 1, 0.02) << "the channel is open";
      EXPECT_NEAR(mean(done.story, &HullSample::from_ice, 0, 10 / drift.speed) / load, 1, 0.02);
      EXPECT_EQ(done.simulation.floe_states().size(), 1u);
    }
  }
}

/// A pile with a corner ahead is carved out of the ice again and again. Between two carvings the overlap is a band
/// along its two flanks. After each step, the volume on record matches the work that crushed it. The step in which the
/// corner enters the ice is an exception.
TEST(Prescribed, TheRecordOfACornersContactHasTheVolumeThatItsWorkCrushed) {
  const geometry::Ring diamond{{0.5, 0}, {0, 0.5}, {-0.5, 0}, {0, -0.5}};
  for (const double step : {0.1, 0.05}) {
    const Drift drift{0.1, step};
    double least = 1e9, most = 0;
    const double stands_in_ice = 10;  // all of the corner is in the ice from then on [s]
    const Trial done = run(drifting_onto(diamond, -0.5, drift), 60, [&](const Simulation& simulation) {
      if (simulation.time() < stands_in_ice) return;
      for (const dynamics::Contact& c : simulation.world().data.contacts) {
        if (c.record->booked.volume < 1e-3) continue;  // just carved: rounding
        const double takes = 2.8e6 * c.record->booked.volume;
        least = std::min(least, c.record->booked.work / takes);
        most = std::max(most, c.record->booked.work / takes);
      }
    });
    EXPECT_GT(done.simulation.counts().ground, 50) << "carved often";
    EXPECT_GT(least, 0.97) << step;
    EXPECT_LT(most, 1.03) << step;
    expect_closed(done.simulation);
  }
}

TEST(Prescribed, AShipThatKeepsItsSpeedInFastIceDoesAsTheIceThatDriftsOntoIt) {
  const Scene scene = Build()
                          .without_splits()
                          .step(0.05)
                          .ship(barge({0, 0}, ConstantSpeed{1}))
                          .floe(fast(rectangle(0.01, -60, 200, 60)));
  const double beam = 24;
  const Trial done = over_the_way(scene, 1, kLineLoad * beam);
  EXPECT_NEAR(done.simulation.audit().sums.energy.crushing / (kLineLoad * beam * kWay), 1, 0.02);
}

/// The flank of a bow slides along the corner of fast ice. Friction is a part of the load, for a ship that keeps her
/// speed as for one that sails.
TEST(Prescribed, TheLoadOfAShipThatKeepsItsSpeedHasItsPartByFriction) {
  for (const double friction : {0.0, 0.1}) {
    Build build = Build().without_splits().step(0.02).ship(steep_icebreaker({-2, 0}, ConstantSpeed{1}));
    Scene scene = build.floe(fast(rectangle(0, 3, 100, 60)));
    scene.ice.friction = friction;
    double load = 0, by_friction = 0;
    for (const HullSample& sample : run(scene, 20).story.samples) {
      load += sample.from_ice.surge;
      by_friction += sample.friction_of_ice.surge;
    }
    EXPECT_LT(load, -1e5);
    if (friction == 0) {
      EXPECT_EQ(by_friction, 0);
    } else {
      EXPECT_TRUE(by_friction < 0.02 * load && by_friction > 0.9 * load) << by_friction / load;
    }
  }
}

/// In an oblique drift only the direction changes. The chord of the channel's head is perpendicular to the motion, up
/// to half an edge of the polygon that approximates the cylinder.
TEST(Prescribed, ACylinderIsPushedAlongTheMotionOfTheIce) {
  Build scene = drifting_onto(cylinder_waterline(kRadius), -kRadius, {0.5, 0.05});
  scene.floes[0].velocity = {0.5, 0.2};
  const Trial done = run(scene, 150);
  const double speed = std::hypot(0.5, 0.2);
  const dynamics::Planar force = done.story.samples.back().from_ice;
  EXPECT_NEAR((0.5 * force.surge + 0.2 * force.sway) / speed / (kLineLoad * 2 * kRadius), 1, 0.02);
  const double half_edge = std::numbers::pi / static_cast<double>(cylinder_waterline(kRadius).size());
  EXPECT_NEAR(std::atan2(force.sway, force.surge), std::atan2(0.2, 0.5), half_edge + 0.01);
}

/// The cylinder crosses the whole plate. Where it has left the plate there are two floes, and the smaller one is free.
TEST(Prescribed, APlateThatIsCutThroughIsTwo) {
  const Trial done =
      run(Build().without_splits().step(0.05).pile({0, 0}, 2).floe(fast(rectangle(-32, -10, -2, 15), {1, 0})), 40);
  ASSERT_EQ(done.simulation.floe_states().size(), 2u);
  EXPECT_EQ(done.story.rejected_cuts().size(), 0u);
  expect_closed(done.simulation);
}

/// A wall that closes flat crushes ice over all of its length at once. Its load is σ_c h w from the first step on, 588
/// MN for 300 m of 0.7 m, until the ice has taken its momentum, and is never larger
/// (docs/decisions/2026-11-23-flat-wall.md).
TEST(Prescribed, AWallThatClosesFlatBearsOnAllOfTheIce) {
  constexpr double kChannelWidth = 300;  // [m]
  for (const double step : {0.01, 0.002}) {
    const double bears = 588e6;  // σ_c h w [N]
    double most = 0;
    const Trial done = run(Build()
                               .step(step)
                               .thickness(0.7)
                               .without_splits()
                               .floe(rectangle(0, 0.05, kChannelWidth, 100))
                               .wall({kChannelWidth, 100.001}, {0, 100.001})
                               .wall({0, 0}, {kChannelWidth, 0}, pressing(5e4)),
                           3, [&](const Simulation& s) { most = std::max(most, largest_contact_force(s)); });
    EXPECT_LE(most, 1.001 * bears) << step;
    EXPECT_GT(most, 0.5 * bears) << step;
    expect_closed(done.simulation);
  }
}

TEST(Prescribed, ALoadAboveAllThatIceBearsIsANumericalFailure) {
  World world(drifting_onto(cylinder_waterline(kRadius), -kRadius - 0.001, {0.2, 0.05}));
  for (int i = 0; i < 10; ++i) step(world);
  ASSERT_EQ(world.data.contacts.size(), 1u);
  EXPECT_FALSE(overload_of(world.setup, world.last_step, world.population, world.data).has_value());
  for (double& impulse : world.data.contacts[0].normal_impulse) impulse = 0.05 * 5 * kLineLoad * 2 * kRadius;
  const auto failure = overload_of(world.setup, world.last_step, world.population, world.data);
  ASSERT_TRUE(failure.has_value());
  EXPECT_NE(failure->find("their ice bears 13.9"), std::string::npos) << *failure;
}

TEST(Prescribed, ARunIsResumedAmongItsCarvings) {
  expect_resumes(drifting_onto(cylinder_waterline(kRadius), -kRadius, {1, 0.05}), 7.3, 12);
}

// ---- what contacts have crushed leaves the floe

/// A thin floe runs onto a pile with its side, and past it. It crushes more than h², and less than 0.5 % of the pile.
Scene floe_past_pile() {
  return Build()
      .without_drag()
      .unbreakable()
      .thickness(0.2)
      .pile({0, 0}, 10)
      .floe(rectangle(4, 9.6, 34, 39.6), {-4, 0});
}

/// Returns a floe of 8 x 4 m between a vertical bow and a pier.
Scene squeezed_floe(Laws laws = Laws::kDefault) {
  return Build(laws)
      .unbreakable()
      .ship(barge({0, 0}, ConstantSpeed{0.1}, 0.1))
      .structure(rectangle(8.05, -20, 20, 20).outer)
      .floe(rectangle(0.05, -2, 8.05, 2));
}

double area_pressed(const Simulation& simulation) {
  double area = 0;
  for (const CrushedOverlap& overlap : simulation.crushed_overlaps()) area += overlap.area + overlap.tilted;
  return area;
}

TEST(Shed, WhatAContactCrushedIsCutOffWhereItPressedMost) {
  Simulation simulation(floe_past_pile());
  Story story;
  double most_pressed = 0;
  while (simulation.time() < 20 && story.grinds().empty()) {
    most_pressed = std::max(most_pressed, area_pressed(simulation));
    simulation.step();
    listen(simulation, story);
  }
  const Event event = only(story.grinds());
  const GrindCriterion& criterion = std::get<Grind>(event.what).criterion;
  EXPECT_EQ(event.ship, 0);
  EXPECT_EQ(event.ice()->children.size(), 1U);
  EXPECT_EQ(criterion.least_width, 0);
  EXPECT_GE(criterion.overlap_area, criterion.least_area);
  EXPECT_NEAR(criterion.overlap_area, most_pressed, 0.02 * most_pressed);
  const double brash = simulation.area_ledger().brash;
  EXPECT_NEAR(brash, criterion.overlap_area, 1e-9);
  const FloeState floe = only(simulation.floe_states());
  EXPECT_NEAR(floe.area, 900 - brash, 1e-9);
  const auto shared = geometry::shared_area(*floe.polygon_in_body, floe.world_from_body,
                                            {simulation.scene().structures[0].hull.waterline, {}},
                                            simulation.ship_states()[0].world_from_ship);
  ASSERT_TRUE(shared.has_value());
  EXPECT_LT(*shared, 1e-6);
  EXPECT_GT(simulation.audit().sums.energy.grinding, 0);
  EXPECT_GT(length(simulation.audit().sums.momentum.removed), 0);
  expect_closed(simulation);
}

TEST(Shed, TheForceOnAFloeThatStaysPressedDoesNotChange) {
  Simulation simulation(squeezed_floe());
  const Story story = run(simulation, 40);
  ASSERT_GT(story.grinds().size(), 3U);
  EXPECT_LT(area_pressed(simulation), 0.021 * simulation.floe_states()[0].area);
  const fracture::Ice& ice = simulation.scene().ice;
  const double force = ice.compressive_strength * ice.thickness * 4;
  EXPECT_NEAR(-mean(story, &HullSample::from_ice, 0, 10) / force, 1, 0.02);
  EXPECT_NEAR(-largest(story, &HullSample::from_ice_largest) / force, -1, 0.1);
  expect_closed(simulation);
}

TEST(Shed, TheRulesOfThePaperKeepCrushedIce) {
  EXPECT_TRUE(run(squeezed_floe(Laws::kPaper), 20).story.grinds().empty());
}

TEST(Shed, IsPartOfTheStateAndDoesNotDependOnThreads) {
  EXPECT_GE(expect_resumes(squeezed_floe(), 11, 20, 2).simulation.counts().ground, 1);
  EXPECT_EQ(expect_resumes(floe_past_pile(), 1, 15, 2).simulation.counts().ground, 1);
}

}  // namespace
}  // namespace polynya::simulation
