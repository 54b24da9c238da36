// What a wedge bears that radial cracks split, and loads whose force is known.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "fracture/bending/fsi_database_model.hpp"
#include "fracture/bending/nevel.hpp"
#include "fracture/characteristic_length.hpp"
#include "tests/fracture/wedge_contact.hpp"

namespace polynya::fracture {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

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
    EXPECT_EQ(kSplit.capacity(slow_load(angle)).vertical_force,
              kWhole.capacity(slow_load(angle)).vertical_force);
    EXPECT_EQ(kSplit.capacity(slow_load(angle)).cusp_radius, kWhole.capacity(slow_load(angle)).cusp_radius);
  }
}

/// The parts of 120° and 180° do not crack again; those of a notch of 220° do.
TEST(RadialCracks, LeavePartsThatBearTheirShares) {
  struct Row {
    double angle;
    int parts;
  };
  for (const auto& [angle, parts] : {Row{120, 2}, {180, 2}, {220, 4}, {240, 4}}) {
    const BendingCapacity split = kSplit.capacity(slow_load(angle));
    const BendingCapacity part = kWhole.capacity(slow_load(angle / parts, 1e-3 * parts));
    EXPECT_NEAR(split.vertical_force / (parts * part.vertical_force), 1, 1e-9) << angle;
    EXPECT_NEAR(split.cusp_radius / part.cusp_radius, 1, 1e-9) << angle;
    EXPECT_TRUE(split.radial_crack_first);
    EXPECT_TRUE(split.is_in_range) << angle;
  }
}

/// Static wedges under small loads, σ_f h²: 2 × .208, 2 × .3545.
TEST(RadialCracks, HalveWhatTheStaticWedgesHave) {
  const double scale = 0.8e6 * 0.25;
  EXPECT_NEAR(kSplit.capacity(slow_load(120, 3e-4)).vertical_force / scale, 0.416, 0.015);
  EXPECT_NEAR(kSplit.capacity(slow_load(180, 3e-4)).vertical_force / scale, 0.709, 0.02);
}

TEST(RadialCracks, WeakenWithoutAJump) {
  double last = 0;
  for (double angle = 80; angle < 180; angle += 0.1) {
    const double split = kSplit.capacity(slow_load(angle)).vertical_force;
    EXPECT_LE(split, kWhole.capacity(slow_load(angle)).vertical_force * (1 + 1e-12));
    if (last > 0) {
      EXPECT_NEAR(split / last, 1, 0.02) << angle;
    }
    last = split;
  }
}

/// Where hull and ice are a flat facet and a wedge, the force of the contact gives the same push as its
/// angles.
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
