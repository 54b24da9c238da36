// When and where the wedge breaks: the verified table, dimensionless collapse, trends, convergence.
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "bench/wedge_studies.hpp"
#include "fracture/bending/wedge_solver.hpp"
#include "tests/fracture/wedge_contact.hpp"

namespace polynya::fracture {
namespace {

double degrees(double angle) {
  return angle * std::numbers::pi / 180;
}

/// The paper's ice as a 90° wedge under its bow flank, whose inclination is 60° from the vertical.
BendingLoad paper_load(double ship_speed) {
  BendingLoad load;
  load.front_half_angle = load.back_half_angle = std::numbers::pi / 4;
  load.hull_angle = degrees(60);
  load.mean_approach_speed = ship_speed * std::cos(degrees(27));
  load.vertical_to_crushing = crushing_shares(load.hull_angle, load.ice.friction, load.mean_approach_speed, 0).vertical;
  return load;
}

// Ship speeds from 0.1 to 4 m/s are compared with an independent prototype of the same model.
TEST(Failure, PapersIceAtFiveSpeeds) {
  const WedgeSolver solver = wedge_of(paper_load(1), {});
  for (const auto& [speed, force, time, radius] : {std::tuple{.1, 70.5, 1.893, 3.03},
                                                   {.5, 70.6, .379, 2.64},
                                                   {1., 71.6, .191, 2.17},
                                                   {2., 73.2, .0965, 1.74},
                                                   {4., 75.5, .049, 1.39}}) {
    const auto forecast = direct_forecast(solver, paper_load(speed));
    ASSERT_TRUE(forecast.has_value()) << speed;
    EXPECT_NEAR(forecast->capacity.vertical_force / 1e3 / force, 1, 0.005) << speed;
    EXPECT_NEAR(forecast->time / time, 1, 0.01) << speed;
    EXPECT_NEAR(forecast->capacity.cusp_radius / radius, 1, 0.02) << speed;
  }
}

TEST(Failure, GroupsAtThreeSpeeds) {
  const WedgeSolver solver(std::numbers::pi / 2, 0.05, {});
  for (const auto& [froude, force, radius] : {std::tuple{.005, .353, .324}, {.05, .353, .291}, {.4, .378, .154}}) {
    const auto failure = solver.failure({froude, 1e-3, 0, 0});
    ASSERT_TRUE(failure.has_value());
    EXPECT_NEAR(failure->force / force, 1, 0.005) << froude;
    EXPECT_NEAR(failure->cusp_radius / radius, 1, 0.01) << froude;
    EXPECT_NEAR(failure->penetration, std::sqrt(1e-3 * failure->force), 1e-9);
    EXPECT_NEAR(failure->time * froude, failure->penetration, 1e-9);
  }
}

// Each refinement alone, and all together, change the result by less than the table's own tolerance. A coarser
// discretisation is farther from the finest.
TEST(Failure, ConvergesUnderRefinement) {
  SolverSettings elements, terms, panels, steps, all, coarse;
  all = elements = with_elements({}, 54);
  terms.angular_terms = 7;
  panels.panel_rings = 108;
  all.panel_columns = panels.panel_columns = 8;
  all.steps_to_failure = steps.steps_to_failure = 240;
  coarse.radial_elements = 18;
  coarse.panel_rings = 16;
  coarse.panel_columns = 3;
  double base_error = 0, coarse_error = 0;
  for (const double angle : {60.0, 150.0}) {
    const auto solve = [angle](const SolverSettings& settings) {
      const WedgeSolver solver(degrees(angle), 0.05, settings);
      std::vector<WedgeFailure> failures;
      for (const double froude : {0.02, 0.2}) failures.push_back(*solver.failure({froude, 1e-3, 0, 0}));
      return failures;
    };
    const std::vector<WedgeFailure> base = solve({}), best = solve(all), rough = solve(coarse);
    for (const auto& refined : {solve(elements), solve(terms), solve(panels), solve(steps), best}) {
      for (std::size_t i = 0; i < base.size(); ++i) {
        EXPECT_NEAR(base[i].force / refined[i].force, 1, 5e-3) << angle;
        EXPECT_NEAR(base[i].cusp_radius / refined[i].cusp_radius, 1, 0.01) << angle;
      }
    }
    for (std::size_t i = 0; i < base.size(); ++i) {
      base_error += std::abs(base[i].force / best[i].force - 1);
      coarse_error += std::abs(rough[i].force / best[i].force - 1);
    }
  }
  EXPECT_LT(base_error, 0.5 * coarse_error);
}

// Small soft wedges break where the loaded patch is a thousandth of l. A quarter of the inner radius, at the
// same spacing, changes nothing that matters.
TEST(Failure, ConvergesInTheInnerRadius) {
  const SolverSettings base, fine = with_inner_radius(base, base.inner_radius / 4);
  EXPECT_GT(fine.radial_elements, base.radial_elements);
  EXPECT_EQ(with_inner_radius(base, base.inner_radius), base);
  for (const double angle : {20.0, 35.0, 90.0}) {
    const WedgeSolver solver(degrees(angle), 0.05, base), reference(degrees(angle), 0.05, fine);
    for (const double froude : {5e-4, 0.1, 1.5}) {
      const WedgeFailure failure = *solver.failure({froude, 3e-5, 0, 0});
      const WedgeFailure expected = *reference.failure({froude, 3e-5, 0, 0});
      EXPECT_NEAR(failure.force / expected.force, 1, 3e-3) << angle << " " << froude;
      EXPECT_NEAR(failure.cusp_radius / expected.cusp_radius, 1, 0.015) << angle << " " << froude;
    }
  }
}

// Time steps are exact for a load that is linear within them, so a few steps are enough. The error falls with the
// square of the step.
TEST(Failure, TimeStepsConvergeToSecondOrder) {
  const std::vector<double> froudes = {0.01, 0.02, 0.05, 0.1, 0.2};
  const auto forces = [&](int steps) {
    SolverSettings settings;
    settings.fluid = FluidModel::kWinkler;
    settings.steps_to_failure = steps;
    const WedgeSolver solver(std::numbers::pi / 2, 0.05, settings);
    std::vector<double> found;
    for (const double froude : froudes) found.push_back(solver.failure({froude, 1e-3, 0, 0})->force);
    return found;
  };
  const std::vector<double> reference = forces(960);
  const auto error = [&](int steps) {
    const auto miss = [](double found, double expected) { return std::abs(found / expected - 1) / 5; };
    const std::vector<double> found = forces(steps);
    return std::transform_reduce(found.begin(), found.end(), reference.begin(), 0.0, std::plus{}, miss);
  };
  const double usual = error(SolverSettings{}.steps_to_failure);
  EXPECT_LT(usual, error(15) / 8);
  EXPECT_LT(usual, 1e-3);
}

// The same groups from two different ices, waters apart too: h, E, strengths, densities all differ.
TEST(Failure, CollapsesOntoTheGroups) {
  const BendingLoad first = paper_load(1.2);
  BendingLoad second = first;
  second.ice.thickness = 1.3;
  second.ice.youngs_modulus = 3.1e9;
  second.water.density = 1025;
  const double l1 = scaled(first).length_scale, l2 = scaled(second).length_scale;
  second.ice.density = first.ice.density * (first.ice.thickness / l1) / (second.ice.thickness / l2) * 1.025;  // m̂
  second.mean_approach_speed = first.mean_approach_speed * std::sqrt(l2 / l1);                                // Fr
  second.ice.flexural_strength = 0.45e6;
  second.hull_angle = degrees(50);
  second.vertical_to_crushing = 0.6;
  second.ice.compressive_strength *= scaled(second).groups.softness / scaled(first).groups.softness;  // Π
  ASSERT_NEAR(scaled(second).groups.softness / scaled(first).groups.softness, 1, 1e-12);
  ASSERT_NEAR(scaled(second).groups.mass_ratio / scaled(first).groups.mass_ratio, 1, 1e-12);

  const auto a = *direct_forecast(wedge_of(first, {}), first);
  const auto b = *direct_forecast(wedge_of(second, {}), second);
  EXPECT_NEAR(b.capacity.vertical_force / scaled(second).force_scale,
              a.capacity.vertical_force / scaled(first).force_scale, 1e-9);
  EXPECT_NEAR(b.capacity.cusp_radius / l2, a.capacity.cusp_radius / l1, 1e-9);
  EXPECT_NEAR(b.penetration / l2, a.penetration / l1, 1e-9);
  EXPECT_NEAR(b.time / scaled(second).time_scale, a.time / scaled(first).time_scale, 1e-7);
  EXPECT_GT(b.capacity.vertical_force, 2 * a.capacity.vertical_force);  // and yet two different ices
}

// The water's own waves hardly matter in the time a wedge takes to break.
TEST(Failure, FreeSurfaceIsNearPotential) {
  SolverSettings settings;
  settings.panel_rings = 32;
  const WedgeSolver plain(std::numbers::pi / 2, 0.05, settings);
  settings.fluid = FluidModel::kFreeSurface;
  const WedgeSolver free_surface(std::numbers::pi / 2, 0.05, settings);
  for (const double froude : {0.005, 0.05, 0.4}) {
    const auto a = free_surface.failure({froude, 1e-3, 0, 0}), b = plain.failure({froude, 1e-3, 0, 0});
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(a->force / b->force, 1, 0.02) << froude;
    EXPECT_NEAR(a->cusp_radius / b->cusp_radius, 1, 0.06) << froude;
  }
}

// Slow pushes are static under every fluid; fast ones are not.
TEST(Failure, FluidsAgreeAtRest) {
  const std::vector<double> speeds = {0.005, 2};
  SolverSettings settings;
  settings.panel_rings = 24;
  settings.free_surface_columns = 8;
  const auto rows = fluid_study(paper_load(1), speeds, settings);
  ASSERT_EQ(rows.size(), 2U);
  const double at_rest = rows[0].by_fluid[0]->capacity.vertical_force;
  for (const auto& forecast : rows[0].by_fluid) EXPECT_NEAR(forecast->capacity.vertical_force / at_rest, 1, 2e-3);
  EXPECT_GT(rows[1].by_fluid[1]->capacity.vertical_force, 1.03 * rows[1].by_fluid[2]->capacity.vertical_force);
}

// A wide wedge cracks along its bisector before its cusp breaks off, a narrow one does not.
TEST(Failure, RadialCrackOpensFirstInWideWedges) {
  for (const double angle : {30.0, 60.0, 80.0, 110.0, 150.0, 180.0}) {
    const auto failure = WedgeSolver(degrees(angle), 0.05, {}).failure({0.01, 1e-3, 0, 0});
    ASSERT_TRUE(failure.has_value());
    EXPECT_EQ(failure->crack_ratio >= 1, angle > 100) << angle;
  }
}

// The ice bends away from the hull, so the break comes later. At low speed its force is nearly the same.
TEST(Failure, DeflectionFeedbackDelaysTheBreak) {
  const std::vector<double> speeds = {0.05, 0.5, 4};
  const auto rows = feedback_study(paper_load(1), speeds, {});
  double previous_delay = 1e9;
  for (const FeedbackStudyRow& row : rows) {
    ASSERT_TRUE(row.ignored && row.coupled) << row.speed;
    const double delay = row.coupled->time / row.ignored->time;
    EXPECT_GT(delay, 1) << row.speed;
    EXPECT_LT(delay, previous_delay) << row.speed;
    EXPECT_NEAR(row.coupled->capacity.vertical_force / row.ignored->capacity.vertical_force, 1, 0.03) << row.speed;
    previous_delay = delay;
  }
}

// ξ = v t − w tan θ_s: without inertia the coupled penetration at the break is the uncoupled one, the time
// longer by the tip's deflection.
TEST(Failure, SlowFeedbackIsTheStaticDeflection) {
  const BendingLoad load = paper_load(0.002);
  const WedgeSolver solver = wedge_of(load, {});
  const auto ignored = *direct_forecast(solver, load);
  const auto coupled = *direct_forecast(solver, load, Feedback::kCoupled);
  EXPECT_NEAR(coupled.penetration / ignored.penetration, 1, 1e-3);
  // A static wedge of 90° with a short patch sinks w0 ≈ 1.15 P / (ρ_w g l²): from the receding of the hull.
  const double sunk = (load.mean_approach_speed * coupled.time - coupled.penetration) / std::tan(load.hull_angle);
  const double l = scaled(load).length_scale;
  EXPECT_NEAR(sunk * load.water.density * kGravity * l * l / coupled.capacity.vertical_force, 1.15, 0.2);
}

// The second branch of Eq. (2): a steep wall crushes through the thickness before the wedge breaks.
TEST(Failure, ThroughThicknessContactGrowsLinearly) {
  BendingLoad load = paper_load(0.3);
  load.hull_angle = degrees(20);
  load.vertical_to_crushing = crushing_shares(load.hull_angle, load.ice.friction, load.mean_approach_speed, 0).vertical;
  const auto forecast = *direct_forecast(wedge_of(load, {}), load);
  ASSERT_GT(forecast.penetration, load.ice.thickness * std::tan(load.hull_angle));
  const double area = crushed_area(2, forecast.penetration, load.ice.thickness, load.hull_angle);
  EXPECT_NEAR(forecast.capacity.vertical_force / (load.vertical_to_crushing * load.ice.compressive_strength * area), 1,
              1e-9);
}

TEST(Failure, NothingWhereTheHullDoesNotPressDown) {
  BendingLoad load = paper_load(1);
  const WedgeSolver solver = wedge_of(load, {});
  load.vertical_to_crushing = -0.01;
  EXPECT_FALSE(direct_forecast(solver, load).has_value());
  load.vertical_to_crushing = 0.5;
  load.mean_approach_speed = 0;
  EXPECT_FALSE(direct_forecast(solver, load).has_value());
}

TEST(Failure, PushForceAndDepthAreInverse) {
  const WedgePush push{0.1, 2e-3, 0.05, 0};
  for (const double depth : {0.01, 0.05, 0.051, 0.4})
    EXPECT_NEAR(push_depth(push, push_force(push, depth)), depth, 1e-12);
  const double slope_below = (push_force(push, 0.05) - push_force(push, 0.05 - 1e-7)) / 1e-7;
  const double slope_above = (push_force(push, 0.05 + 1e-7) - push_force(push, 0.05)) / 1e-7;
  EXPECT_NEAR(slope_above / slope_below, 1, 1e-4);  // C¹, as Eq. (2) is
}

}  // namespace
}  // namespace polynya::fracture
