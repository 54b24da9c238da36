// The water around a hull, propellers, rudders, and the ice under it.
#include "dynamics/ship/manoeuvring.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "dynamics/ship/propulsion.hpp"
#include "dynamics/ship/rudder.hpp"
#include "dynamics/water/submerged_ice.hpp"
#include "tests/shapes.hpp"

namespace polynya::dynamics {
namespace {

/// The reference ship of the project's physics notes.
constexpr MainDimensions kShip{120, 24, 6, 0.579};

HullInWater hull(double cross_flow_drag = 0.8) {
  HullInWater hull;
  hull.length = kShip.length;
  hull.draught = kShip.draught;
  hull.aft = -60;
  hull.fore = 60;
  hull.cross_flow_drag = cross_flow_drag;
  hull.quadratic_resistance = 0.5 * 1000 * 0.004 * wetted_surface(kShip);
  hull.derivatives = clarke_derivatives(kShip);
  hull.added_mass = added_mass_of(hull.derivatives, kShip.length, 1000, 5e5);
  return hull;
}

TEST(Manoeuvring, ClarkesDerivativesOfTheReferenceShip) {
  const ManoeuvringDerivatives d = clarke_derivatives(kShip);
  EXPECT_NEAR(1e3 * d.y_v_dot, -9.162, 5e-4);
  EXPECT_NEAR(1e3 * d.y_r_dot, -0.638, 5e-4);
  EXPECT_NEAR(1e3 * d.n_v_dot, -0.440, 5e-4);
  EXPECT_NEAR(1e3 * d.n_r_dot, -0.4454, 5e-5);
  EXPECT_NEAR(1e3 * d.y_v, -15.130, 5e-4);
  EXPECT_NEAR(1e3 * d.y_r, 2.985, 5e-4);
  EXPECT_NEAR(1e3 * d.n_v, -4.869, 5e-4);
  EXPECT_NEAR(1e3 * d.n_r, -2.309, 5e-4);
  EXPECT_TRUE(d.are_physical());
}

TEST(Manoeuvring, DerivativesThatGiveEnergyAreNotPhysical) {
  ManoeuvringDerivatives d = clarke_derivatives(kShip);
  d.n_v = -0.05;  // a coupling that the damping does not outweigh
  EXPECT_FALSE(d.are_physical());
  EXPECT_FALSE(clarke_derivatives({30, 20, 6, 0.6}).are_physical()) << "a raft has no added mass by this";
}

TEST(Manoeuvring, AddedMassHasNoNegativeEnergy) {
  for (const MainDimensions& d :
       {kShip, MainDimensions{95, 29.4, 8, 0.6}, MainDimensions{200, 30, 12, 0.8}}) {
    const PlanarMatrix a = added_mass_of(clarke_derivatives(d), d.length, 1000, 1e6);
    EXPECT_EQ(a.rows[1].yaw, a.rows[2].sway);
    EXPECT_GT(a.rows[1].sway * a.rows[2].yaw, a.rows[1].yaw * a.rows[2].sway);
    EXPECT_GT(a.rows[1].sway, 0);
  }
}

TEST(Manoeuvring, TheWaterTakesEnergyFromEveryMotion) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const Planar at{8 * in(random), 3 * in(random), 0.1 * in(random)};
    const Planar velocity{8 * in(random), 3 * in(random), 0.1 * in(random)};
    EXPECT_GE(dot(velocity, water_damping(hull(), at) * velocity), 0);
  }
}

/// To port and starboard, and ahead and astern.
TEST(Manoeuvring, MirroredMotionsHaveMirroredForces) {
  const auto force = [](const Planar& at) { return water_damping(hull(), at) * at; };
  const auto expect_equal = [](const Planar& p, const Planar& q) {
    EXPECT_DOUBLE_EQ(p.surge, q.surge);
    EXPECT_DOUBLE_EQ(p.sway, q.sway);
    EXPECT_DOUBLE_EQ(p.yaw, q.yaw);
  };
  const Planar here = force({4, 0.7, 0.02});
  expect_equal(force({4, -0.7, -0.02}), {here.surge, -here.sway, -here.yaw});
  expect_equal(force({-4, 0.7, -0.02}), {-here.surge, here.sway, -here.yaw});
}

TEST(Manoeuvring, CrossFlowIsTheIntegralOverTheHull) {
  HullInWater only_cross = hull(0.9);
  only_cross.derivatives = {};
  only_cross.aft = -70;
  only_cross.fore = 50;
  for (const auto& [v, r] : {std::pair{0.5, 0.0}, {0.5, 0.02}, {-0.3, 0.03}, {0.0, -0.01}, {2.0, 0.01}}) {
    double y = 0, n = 0;
    constexpr int kParts = 100000;
    for (int i = 0; i < kParts; ++i) {
      const double x = -70 + (i + 0.5) * 120 / kParts;
      const double s = v + x * r;
      y += std::abs(s) * s * 120 / kParts;
      n += x * std::abs(s) * s * 120 / kParts;
    }
    const Planar force = water_damping(only_cross, {0, v, r}) * Planar{0, v, r};
    const double q = 0.5 * 1000 * 6 * 0.9;
    EXPECT_NEAR(force.sway, q * y, 1e-6 * q * 3600);
    EXPECT_NEAR(force.yaw, q * n, 1e-6 * q * 3600 * 60);
  }
}

TEST(Propulsion, BollardPullFollowsFromPowerDiameterAndPropellers) {
  EXPECT_NEAR(bollard_pull(1e6, 1, 1), 78e3, 1e-6);  // 1000 kW to the power of ⅔ are 100
  EXPECT_NEAR(bollard_pull(1e6, 1, 2), 98e3, 1e-6);
  EXPECT_NEAR(bollard_pull(1e6, 1, 3), 112e3, 1e-6);
  EXPECT_NEAR(bollard_pull(1e6, 1, 2, true), 1.4 * 98e3, 1e-6);
  // The ice class rules have the same coefficient for a channel: K_e = (.8 K)^−1.5.
  EXPECT_NEAR(std::pow(0.8 * 0.78, -1.5), 2.03, 5e-3);
  EXPECT_NEAR(std::pow(0.8 * 0.98, -1.5), 1.44, 5e-3);
  EXPECT_NEAR(std::pow(0.8 * 1.12, -1.5), 1.18, 5e-3);
}

TEST(Propulsion, NetThrustEndsAtTheOpenWaterSpeed) {
  const Engine engine{.bollard_pull = 1e6, .open_water_speed = 8};
  EXPECT_DOUBLE_EQ(net_thrust(engine, 1, 0), 1e6);
  EXPECT_NEAR(net_thrust(engine, 1, 8), 0, 1e-9);
  EXPECT_NEAR(net_thrust(engine, 1, 4), 1e6 * (1 - 1 / 6.0 - 1 / 6.0), 1e-6);
  EXPECT_NEAR(net_thrust(engine, 0.125, 0), 0.25e6, 1e-6);
  EXPECT_NEAR(net_thrust(engine, -1, 0), -0.65e6, 1e-6);
  EXPECT_LT(net_thrust(engine, 0, 3), 0);
  EXPECT_GT(net_thrust(engine, 0, -3), 0);
}

TEST(Propulsion, EquilibriumWithAResistanceOfIce) {
  const Engine engine{.bollard_pull = 1e6, .open_water_speed = 8};
  double low = 0, high = 8;
  for (int i = 0; i < 60; ++i) {
    const double v = 0.5 * (low + high);
    (net_thrust(engine, 1, v) > 391.0e3 + 166.4e3 * v ? low : high) = v;
  }
  EXPECT_NEAR(low, 2.591, 1e-3 * 2.591);
}

TEST(Propulsion, ASettingGoesToTheWantedOneAtItsRate) {
  EXPECT_DOUBLE_EQ(approach(0, 1, 0.05, 2), 0.1);
  EXPECT_DOUBLE_EQ(approach(0, -1, 0.05, 2), -0.1);
  EXPECT_DOUBLE_EQ(approach(0.95, 1, 0.05, 2), 1);
}

TEST(Rudder, TurnsAShipToTheSideItIsLaidTo) {
  const Rudder rudder{.area = 13, .position = -60};
  const Planar to_port = rudder_force(rudder, 0.3, {6, 0, 0}, 0, 1000);
  EXPECT_LT(to_port.surge, 0);
  EXPECT_LT(to_port.sway, 0) << "the stern goes to starboard";
  EXPECT_GT(to_port.yaw, 0);
  const Planar to_starboard = rudder_force(rudder, -0.3, {6, 0, 0}, 0, 1000);
  EXPECT_DOUBLE_EQ(to_starboard.yaw, -to_port.yaw);
  EXPECT_LT(rudder_force(rudder, 0.3, {-2, 0, 0}, 0, 1000).yaw, 0) << "astern it turns her the other way";
}

TEST(Rudder, HasTheNormalForceOfAFoil) {
  const Rudder rudder{.area = 10, .aspect_ratio = 2, .position = -60, .wake_fraction = 0, .hull_factor = 0};
  const double normal = 0.5 * 1000 * 10 * 6.13 * 2 / 4.25 * 25 * std::sin(0.2);
  const Planar force = rudder_force(rudder, 0.2, {5, 0, 0}, 0, 1000);
  EXPECT_NEAR(force.surge, -normal * std::sin(0.2), 1e-6);
  EXPECT_NEAR(force.sway, -normal * std::cos(0.2), 1e-6);
}

TEST(Rudder, TheRaceTurnsAShipAtRest) {
  Rudder rudder{.area = 13, .position = -60};
  EXPECT_EQ(rudder_force(rudder, 0.5, {}, 5e5, 1000).yaw, 0);
  rudder.race_area = 15;
  EXPECT_GT(rudder_force(rudder, 0.5, {}, 5e5, 1000).yaw, 1e6);
  EXPECT_EQ(rudder_force(rudder, 0.5, {}, -5e5, 1000).yaw, 0) << "the race of a propeller astern goes ahead";
}

TEST(Rudder, AmidshipsItDampsTheTurn) {
  const Rudder rudder{.area = 13, .position = -60, .race_area = 15};
  const Planar turning{4, 0.1, 0.02};
  EXPECT_LT(dot(turning, rudder_force(rudder, 0, turning, 3e5, 1000)), 0);
  EXPECT_LT(rudder_force(rudder, 0, {4, 0, 0.02}, 3e5, 1000).yaw, 0);
}

TEST(Rudder, ThrustersTurnTheirThrust) {
  const Planar ahead = turned_thrust(1e6, 0, -50), port = turned_thrust(1e6, M_PI / 2, -50);
  EXPECT_EQ(ahead, (Planar{1e6, 0, 0}));
  EXPECT_NEAR(port.surge, 0, 1e-9);
  EXPECT_NEAR(port.sway, -1e6, 1e-6);
  EXPECT_NEAR(port.yaw, 5e7, 1e-4);
}

TEST(Planar, SolvesThreeEquations) {
  const PlanarMatrix a{{{{4, 1, -2}, {0.5, 3, 1}, {1, -1, 5}}}};
  const Planar x{1.5, -2, 0.25}, found = solve(a, a * x);
  EXPECT_NEAR(found.surge, x.surge, 1e-15);
  EXPECT_NEAR(found.sway, x.sway, 1e-15);
  EXPECT_NEAR(found.yaw, x.yaw, 1e-15);
}

// ---- ice under the hull, against Lindqvist's resistance

constexpr HullForm kReference{.length = 120,
                              .beam = 24,
                              .draught = 6,
                              .stem_angle = 30 * shapes::kDegree,
                              .entrance_angle = 27 * shapes::kDegree};

TEST(SubmergedIce, ThePathOfTheReferenceShipIsLindqvists) {
  const SubmersionPath path = submersion_path(kReference);
  EXPECT_NEAR(path.rise, 5.0, 5e-4);
  EXPECT_NEAR(path.sliding, 70.83, 5e-3);
  EXPECT_NEAR(path.bow, 6 / std::tan(30 * shapes::kDegree), 1e-12);
  // R_s = δρ g h B (z̄ + μ s̄): 58.9 kN potential, 166.8 kN friction.
  const double weight = 100 * 9.81 * 0.5 * 24;  // per metre of way [N/m]
  EXPECT_NEAR(weight * path.rise, 58.9e3, 50);
  EXPECT_NEAR(weight * 0.2 * path.sliding, 166.8e3, 50);
}

TEST(SubmergedIce, APieceHasRisenAndSlidAllTheWayHoweverItIsCutIntoSteps) {
  const SubmersionPath path = submersion_path(kReference);
  double risen = 0, slid = 0;
  for (double s = -0.3; s < 130;) {
    const double to = s + 0.0137;
    risen += path.risen_over(s, to);
    slid += path.slid_over(s, to);
    s = to;
  }
  EXPECT_NEAR(risen, path.rise, 1e-12);
  EXPECT_NEAR(slid, path.sliding, 1e-11);
}

TEST(SubmergedIce, AHullCoveredWithIcePaysLindqvistsResistance) {
  const SubmersionPath path = submersion_path(kReference);
  const double mu = 0.2, speed = 1, dt = 0.01, piece = 0.5;  // a piece every half metre
  const double weight = 100 * 9.81 * 0.5 * 24 * piece;       // of each [N]
  double work = 0;
  for (int step = 0; step < 50; ++step) {  // over one spacing of the pieces
    for (double s = step * dt * speed; s < 120; s += piece)
      work += weight * (path.risen_over(s, s + speed * dt) + mu * path.slid_over(s, s + speed * dt));
  }
  EXPECT_NEAR(work / (50 * dt * speed), 225.6e3, 0.01 * 225.6e3);
}

TEST(SubmergedIce, TheSpeedFactorIsLindqvists) {
  EXPECT_EQ(submersion_speed_factor(0, 120), 1);
  EXPECT_NEAR(submersion_speed_factor(1, 120), 1 + 9.4 / std::sqrt(9.81 * 120), 1e-12);
}

}  // namespace
}  // namespace polynya::dynamics
