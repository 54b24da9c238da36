// Deflection of the tip of a wedge, its effect on the penetration of the hull, and the effect of radial cracks on both.
#include "fracture/bending/edge_deflection.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/wedge_studies.hpp"
#include "fracture/bending/fsi_database_model.hpp"
#include "fracture/bending/internal/modes.hpp"
#include "fracture/characteristic_length.hpp"
#include "tests/fracture/bending/floating_beam.hpp"
#include "tests/fracture/wedge_contact.hpp"
#include "tests/shapes.hpp"

namespace polynya::fracture {
namespace {

using shapes::kDegree;

/// w / V under a force that grows as t²: μ q̈ + q = f t² from rest has q = f (t² − 2 μ (1 − cos t/√μ)).
double compliance_of(const WedgeModes& modes, double duration) {
  const Eigen::VectorXd at_rest = static_amplitudes(modes, 0.02);
  double compliance = 0;
  for (Eigen::Index k = 0; k < at_rest.size(); ++k) {
    const double mu = modes.inertia[k];
    const double phase = mu > 0 ? duration / std::sqrt(mu) : 1e9;
    const double lag = phase > 1e-3 ? 2 * (1 - std::cos(phase)) / (phase * phase) : 1 - phase * phase / 12;
    compliance += modes.tip[k] * at_rest[k] * (1 - lag);
  }
  return compliance;
}

void expect_compliance(double angle, double mass_ratio, const std::vector<double>& durations, auto tolerance_at) {
  const WedgeModes modes = wedge_modes(0.5 * angle * kDegree, mass_ratio, {});
  for (const double duration : durations)
    EXPECT_NEAR(tip_compliance(angle * kDegree, duration) / compliance_of(modes, duration), 1, tolerance_at(duration))
        << angle << " " << mass_ratio << " " << duration;
}

TEST(TipCompliance, IsThatOfTheModesAlsoBetweenItsPointsAndForOtherMassRatios) {
  for (const double angle : {20.0, 40.0, 90.0, 180.0})
    expect_compliance(angle, 0.05, {0.02, 0.04, 0.08, 0.15, 0.25, 0.4, 0.6, 0.9, 1.3, 1.8, 2.4, 3.2, 4.2, 6.0, 1e3},
                      [](double) { return 1e-3; });
  for (const double angle : {25.0, 75.0, 105.0, 165.0})
    for (const double mass_ratio : {0.02, 0.05, 0.1})
      expect_compliance(angle, mass_ratio, {0.1, 0.3, 1.1, 2.8, 9.0}, [&](double duration) {
        return mass_ratio == 0.05 ? 0.02 : duration < 1 ? 0.25 : 0.12;
      });
}

TEST(TipCompliance, AtRestIsTheHalfPlanesAndTheNarrowBeams) {
  EXPECT_NEAR(tip_compliance(std::numbers::pi, 1e6), 0.46198, 0.005);
  // The beam's l has no 1 − ν²; its width grows with 2 tan α.
  const BeamResponse beam = solve_floating_beam(BeamShape::kWedge, {.patch = 0.02});
  const double narrow = beam.tip_deflection / (2 * std::tan(10 * kDegree) * std::sqrt(1 - 0.3 * 0.3));
  EXPECT_NEAR(tip_compliance(20 * kDegree, 1e6) / narrow, 1, 0.02);
}

TEST(TipCompliance, GrowsFromNothing) {
  EXPECT_EQ(tip_compliance(1.5, 0), 0);
  double last = 0;
  for (double duration = 1e-3; duration < 2.5; duration *= 1.1) {
    const double now = tip_compliance(1.5, duration);
    EXPECT_GT(now, last);
    last = now;
  }
}

/// The hull advances by ξ + tan θ_s w before the wedge breaks. The reference is the solution in which the two act on
/// each other at every instant.
TEST(Recession, LengthensThePushAsTheCoupledSolutionHasIt) {
  BendingLoad load;
  load.hull_angle = 38.2 * kDegree;
  load.front_half_angle = load.back_half_angle = 56 * kDegree;
  load.vertical_to_crushing = crushing_shares(load.hull_angle, load.ice.friction, 1, 0).vertical;
  for (const double thickness : {0.25, 1.0}) {
    load.ice.thickness = thickness;
    const WedgeSolver solver = wedge_of(load, {});
    for (const double speed : {0.05, 0.2, 0.5, 1.0}) {
      load.mean_approach_speed = speed;
      const auto ignored = direct_forecast(solver, load);
      const auto coupled = direct_forecast(solver, load, Feedback::kCoupled);
      ASSERT_TRUE(ignored && coupled);
      const double area = ignored->normal_force / load.ice.compressive_strength;
      double travel = ignored->penetration;
      for (int i = 0; i < 50; ++i) travel = ignored->penetration + recession_per_area(load, travel) * area;
      EXPECT_NEAR(travel / speed / coupled->time, 1, 0.08) << thickness << " " << speed;
      if (speed == 0.05) {
        EXPECT_GT(coupled->time / ignored->time, 1.3);
      }
    }
  }
}

TEST(Recession, OfAWallThatDoesNotPressDownIsNothing) {
  BendingLoad load;
  load.vertical_to_crushing = -0.1;
  EXPECT_EQ(recession_per_area(load, 0.1), 0);
}

// ---- strength of a wedge that radial cracks split, and loads with a known force

/// Half a metre of ice on which a slow hull presses: V as of a corner of Π 10⁻³ at its penetration.
BendingLoad slow_load(double opening_angle_deg, double softness = 1e-3) {
  BendingLoad load;
  load.opening_angle = opening_angle_deg * kDegree;
  load.mean_approach_speed = 1e-3;
  load.penetration = 0.1;
  const double l = characteristic_length(load.ice, load.water);
  load.vertical_force = load.ice.flexural_strength * 0.25 * 0.01 / (softness * l * l);
  return load;
}

const FsiDatabaseModel kWhole(RadialCracks::kIgnored), kSplit(RadialCracks::kSplitWedge);

TEST(RadialCracks, LeaveNarrowWedgesAsTheyAre) {
  for (double angle = 20; angle <= 90; angle += 5) {
    const BendingCapacity split = kSplit.capacity(slow_load(angle)), whole = kWhole.capacity(slow_load(angle));
    EXPECT_EQ(split.vertical_force, whole.vertical_force);
    EXPECT_EQ(split.cusp_radius, whole.cusp_radius);
  }
}

/// The parts of 120° and 180° do not crack again. The parts of a notch of 220° do.
TEST(RadialCracks, LeavePartsThatBearTheirShares) {
  for (const auto& [angle, parts] : {std::pair{120., 2}, {180., 2}, {220., 4}, {240., 4}}) {
    const BendingCapacity split = kSplit.capacity(slow_load(angle));
    const BendingCapacity part = kWhole.capacity(slow_load(angle / parts, 1e-3 * parts));
    EXPECT_NEAR(split.vertical_force / (parts * part.vertical_force), 1, 1e-9) << angle;
    EXPECT_NEAR(split.cusp_radius / part.cusp_radius, 1, 1e-9) << angle;
    EXPECT_TRUE(split.radial_crack_first);
    EXPECT_TRUE(split.is_in_range) << angle;
  }
}

TEST(RadialCracks, WeakenWithoutAJump) {
  double last = kSplit.capacity(slow_load(79.9)).vertical_force;
  for (double angle = 80; angle < 180; angle += 0.1) {
    const double split = kSplit.capacity(slow_load(angle)).vertical_force;
    EXPECT_LE(split, kWhole.capacity(slow_load(angle)).vertical_force * (1 + 1e-12));
    EXPECT_NEAR(split / last, 1, 0.02) << angle;
    last = split;
  }
}

/// If the contact is a flat facet on a wedge of ice, a load given by the force of the contact is the same as a load
/// given by its angles.
TEST(KnownForce, OfAWedgeIsThatOfItsAngles) {
  BendingLoad load;
  load.front_half_angle = 30 * kDegree;
  load.back_half_angle = 70 * kDegree;
  load.hull_angle = 38 * kDegree;
  load.mean_approach_speed = 0.4;
  load.vertical_to_crushing = 0.5;
  for (const double depth : {0.02, 0.2, 0.45, 0.9}) {  // crushed through the thickness from 0.39 m on
    load.penetration = depth;
    load.vertical_force = 0;
    const BendingCapacity by_angles = kWhole.capacity(load);
    const double tangents = std::tan(load.front_half_angle) + std::tan(load.back_half_angle);
    load.vertical_force = load.vertical_to_crushing * load.ice.compressive_strength *
                          crushed_area(tangents, depth, load.ice.thickness, load.hull_angle);
    const BendingCapacity by_force = kWhole.capacity(load);
    EXPECT_NEAR(by_force.vertical_force / by_angles.vertical_force, 1, 1e-9) << depth;
    EXPECT_NEAR(by_force.cusp_radius / by_angles.cusp_radius, 1, 1e-9) << depth;
  }
}

/// A softer contact takes longer to break the ice: a larger cusp.
TEST(KnownForce, OfASofterContactBreaksALargerCusp) {
  BendingLoad load = slow_load(80, 3e-4);
  load.mean_approach_speed = 1;
  const double stiff = kWhole.capacity(load).cusp_radius;
  load.vertical_force /= 16;
  EXPECT_GT(kWhole.capacity(load).cusp_radius, 1.2 * stiff);
}

}  // namespace
}  // namespace polynya::fracture
