// Water forces: Eq. (6) of [Sawamura2017] relative to the water, against closed forms, and the forces of water on
// ships.
#include <algorithm>
#include <cmath>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include "dynamics/ship/manoeuvring.hpp"
#include "dynamics/ship/open_water.hpp"
#include "dynamics/ship/propulsion.hpp"
#include "dynamics/water/submerged_ice.hpp"
#include "dynamics/water/water_drag.hpp"
#include "tests/dynamics/scenery.hpp"
#include "tests/shapes.hpp"

namespace polynya::dynamics {
namespace {

using geometry::Point;
using geometry::Vector;
using namespace scenery;

constexpr double kDrag = 0.5;
constexpr double kWater = 1000;
constexpr double kThickness = 0.5;

Bodies one_floe(const geometry::Polygon& polygon, double angle = 0) {
  Bodies bodies;
  add_body(bodies, floe_body(polygon, {3, -2}, angle));
  return bodies;
}

/// Lets the water brake the first body.
WaterWork brake(Bodies& bodies, double time_step, DragArea area = DragArea::kEdge) {
  return apply_water_drag(bodies, {0}, {kDrag, kWater, {}, area}, time_step);
}

TEST(WaterDrag, AFloeThatMovesWithTheWaterFeelsNothing) {
  // Velocities are relative to the water. A floe that drifts with the water has none, so nothing changes, to the last
  // bit.
  Bodies bodies = one_floe(rectangle(10, 6), 0.7);
  EXPECT_EQ(brake(bodies, 100).lost, 0);
  EXPECT_EQ(bodies.velocity[0], Vector{});
  EXPECT_EQ(bodies.angular_velocity[0], 0);
}

TEST(WaterDrag, AShapeIsAsWideAsItsFarthestCornersInAllDirections) {
  Random random(17);
  for (int i = 0; i < 200; ++i) {
    const geometry::Polygon star = random_star(random, 3 + random.below(200), 3, 8);
    for (int k = 0; k < DragShape::kDirections; ++k) {
      const geometry::Vector across = perpendicular(drag_direction(k)) / length(drag_direction(k));
      double low = 0;
      double high = 0;
      for (const geometry::Point p : star.outer) {
        low = std::min(low, dot(p - geometry::Point{}, across));
        high = std::max(high, dot(p - geometry::Point{}, across));
      }
      const auto found = widths_of_outline(star.outer, {}, k);
      const auto before = widths_of_outline(star.outer, {}, (k + DragShape::kDirections - 1) % DragShape::kDirections);
      ASSERT_NEAR(found[0], high - low, 1e-13) << "star " << i << ", direction " << k;
      ASSERT_EQ(found[0], before[1]) << "star " << i << ", direction " << k;
    }
  }
}

TEST(WaterDrag, AHoleDoesNotWidenAFloe) {
  const geometry::Ring whole = rectangle(10, 6).outer;
  for (const auto& floe : {geometry::Polygon{whole, {}}, {whole, {shapes::reversed(rectangle(2, 2).outer)}}})
    EXPECT_TRUE(std::ranges::equal(geometry::edge_list(floe).outer_corners(), whole));
}

TEST(WaterDrag, TheRotationalIntegralIsThatOfDiscAndSquare) {
  // K = mean over directions of ∫|s|³ ds: R⁴/2 for a disc; (a/2)⁴ (3/2 + 4/π) / 2 for a square of side a.
  EXPECT_NEAR(make_drag_shape(shapes::regular(512, 7), {}).rotational / (std::pow(7, 4) / 2), 1, 1e-3);
  const double square = std::pow(4.0, 4) * (1.5 + 4 / std::numbers::pi) / 2;
  EXPECT_NEAR(make_drag_shape(rectangle(8, 8), {}).rotational / square, 1, 2e-3);
}

TEST(WaterDrag, ActsAgainstTheVelocityAndTakesTheEnergyItReports) {
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    Bodies bodies = one_floe(random_star(random, 5 + random.below(12), 1, 15), random.angle());
    bodies.velocity[0] = {random.between(-4, 4), random.between(-4, 4)};
    bodies.angular_velocity[0] = random.between(-1, 1);
    const Vector v = bodies.velocity[0];
    const double before = kinetic_energy(bodies);
    const double work =
        apply_water_drag(bodies, {0}, {random.between(0, 2), kWater, {}}, std::pow(10.0, random.between(-4, 4))).lost;
    const double after = kinetic_energy(bodies);
    ASSERT_LE(after, before);
    ASSERT_NEAR((before - after) / before, work / before, 1e-12);
    ASSERT_NEAR(cross(v, bodies.velocity[0]), 0, 1e-13) << "drag turns nothing";
    ASSERT_GE(dot(v, bodies.velocity[0]), 0) << "and never reverses";
  }
}

TEST(WaterDrag, WidthOfASquareIsWithinItsStatedError) {
  const geometry::Ring square = rectangle(10, 10).outer;
  double worst = 0;
  for (int i = 0; i <= 100000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 100000;
    const double exact = 10 * (std::abs(std::cos(angle)) + std::abs(std::sin(angle)));
    const double place = drag_place({std::cos(angle), std::sin(angle)});
    const int k = std::min(static_cast<int>(place), DragShape::kDirections - 1);
    const auto [width, next] = widths_of_outline(square, {}, k);
    const double relative = std::lerp(width, next, place - k) / exact - 1;
    worst = std::max(worst, std::abs(relative));
  }
  EXPECT_LT(worst, 1e-3);
  EXPECT_GT(worst, 1e-5) << "interpolation has some error: the bound is tested by something";
}

TEST(WaterDrag, ATurnedFloeWithATurnedVelocityFeelsTheSameDragTurned) {
  Random random(12);
  for (int i = 0; i < 1000; ++i) {
    const double along = random.between(5, 20), across = random.between(5, 20);
    const geometry::Polygon polygon = rectangle(along, across);
    const double course = random.angle(), angle = random.angle();
    const geometry::Rotation turn = geometry::Rotation::by(angle);
    const Vector velocity{2 * std::cos(course), 2 * std::sin(course)};
    // The same floe placed turned, and drawn with its corners turned: then other directions are its known
    // ones.
    Bodies straight = one_floe(polygon), placed = one_floe(polygon, angle);
    Bodies drawn = one_floe(transform(geometry::Pose{{}, turn}, polygon));
    straight.velocity[0] = velocity;
    placed.velocity[0] = drawn.velocity[0] = rotate(turn, velocity);
    for (Bodies* bodies : {&straight, &placed, &drawn}) brake(*bodies, 5);
    ASSERT_NEAR(length(rotate_back(turn, placed.velocity[0]) - straight.velocity[0]), 0, 1e-13);

    const auto resistance = [](const Bodies& bodies) { return 1 / length(bodies.velocity[0]) - 0.5; };  // k t
    const double off = std::abs(resistance(drawn) / resistance(placed) - 1);
    // The width of a floe has a kink where the floe moves along an edge, and interpolation cuts this kink. The error is
    // at most half the spacing of the known directions (1/16 rad) times the floe's aspect ratio.
    const double aspect = std::max(along, across) / std::min(along, across);
    ASSERT_LT(off, aspect / 32 + 1e-3) << aspect;
  }
}

TEST(WaterDrag, BodiesOfPrescribedMotionKeepTheirVelocity) {
  Bodies bodies;
  add_held(bodies, rectangle(10, 6), {}, {1, 0}, 0.1);
  brake(bodies, 10);
  EXPECT_EQ(std::pair(bodies.velocity[0], bodies.angular_velocity[0]), std::pair(Vector{1, 0}, 0.1));
}

/// Returns ∫ r³ dA over a rectangle about a point.
double third_moment_of_rectangle(Point low, Point high, Point about) {
  const auto integral = [](auto f, double from, double to) {
    return boost::math::quadrature::gauss_kronrod<double, 15>::integrate(f, from, to, 8, 1e-12);
  };
  return integral(
      [&](double x) {
        return integral([&](double y) { return std::pow(distance({x, y}, about), 3); }, low.y, high.y);
      },
      low.x, high.x);
}

TEST(PlanDrag, TheRotationalIntegralIsExactForDiscRingAndRectangles) {
  const auto moment = [](const geometry::Polygon& polygon, Point about) {
    return make_drag_shape(polygon, about, DragArea::kPlan).rotational;
  };
  const auto of_disc = [](double radius) { return 2 * std::numbers::pi * std::pow(radius, 5) / 5; };
  geometry::Polygon ring = shapes::regular(4096, 7);
  EXPECT_NEAR(moment(ring, {}) / of_disc(7), 1, 3e-6);
  ring.holes = {shapes::regular(4096, 5).outer};
  std::ranges::reverse(ring.holes[0]);
  EXPECT_NEAR(moment(ring, {}) / (of_disc(7) - of_disc(5)), 1, 5e-6);
  for (const Point about : {Point{}, Point{0.3, 1}, Point{5, 3}, Point{20, -7}})  // inside, on a corner, out
    EXPECT_NEAR(moment(rectangle(10, 6), about) / third_moment_of_rectangle({-5, -3}, {5, 3}, about), 1, 1e-9);
}

/// m v' = −½ C_D ρ_w A v² ⇒ v(t) = v0 / (1 + k v0 t), k = C_D ρ_w A / 2m, for any step length.
/// I ω' = −½ C_D ρ_w K ω² alike.
/// By its edge A = h w, and K is h times the rotational integral.
/// In plan A = 60 m² and K = ∫r³dA, whatever its course and thickness.
TEST(WaterDrag, AFreeFloeSlowsAndStopsItsSpinAsTheClosedForms) {
  Random random(4);
  for (const double dt : {0.005, 0.5, 50.0}) {
    for (const DragArea area : {DragArea::kEdge, DragArea::kPlan}) {
      const bool is_plan = area == DragArea::kPlan;
      Bodies bodies = one_floe(rectangle(10, 6), is_plan ? random.angle() : 0);
      bodies.drag[0] = std::make_shared<DragShape>(make_drag_shape(rectangle(10, 6), {}, area));
      const double course = is_plan ? random.angle() : 0;
      if (is_plan) bodies.thickness[0] = random.between(0.1, 3);
      const double braked = is_plan ? 60 : kThickness * 6;
      const double turned =
          is_plan ? third_moment_of_rectangle({-5, -3}, {5, 3}, {}) : kThickness * bodies.drag[0]->rotational;
      const double half = kDrag * kWater / 2, time = 2000 * dt;
      for (const double spin : {0.0, -0.2, 0.3}) {
        bodies.velocity[0] = 1.5 * Vector{std::cos(course), std::sin(course)};
        bodies.angular_velocity[0] = spin;
        for (int step = 0; step < 2000; ++step) brake(bodies, dt, area);
        const double slowed = 1.5 / (1 + half * braked / bodies.mass[0] * 1.5 * time);
        EXPECT_NEAR(length(bodies.velocity[0]) / slowed, 1, 1e-9) << dt;
        EXPECT_NEAR(cross(bodies.velocity[0], {std::cos(course), std::sin(course)}), 0, 1e-12) << dt;
        const double stopped = spin / (1 + half * turned / bodies.moment[0] * std::abs(spin) * time);
        EXPECT_NEAR(bodies.angular_velocity[0], stopped, 1e-9 * std::abs(stopped)) << dt;
      }
    }
  }
}

// ---- the water around a hull, propellers

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
  for (const MainDimensions& d : {kShip, MainDimensions{95, 29.4, 8, 0.6}, MainDimensions{200, 30, 12, 0.8}}) {
    const PlanarMatrix a = added_mass_of(clarke_derivatives(d), d.length, 1000, 1e6);
    EXPECT_EQ(a.rows[1].yaw, a.rows[2].sway);
    EXPECT_GT(a.rows[1].sway * a.rows[2].yaw, a.rows[1].yaw * a.rows[2].sway);
    EXPECT_GT(a.rows[1].sway, 0);
  }
}

TEST(Manoeuvring, TheWaterTakesEnergyFromEveryMotion) {
  Random random(7);
  const auto any = [&] { return Planar{random.between(-8, 8), random.between(-3, 3), random.between(-0.1, 0.1)}; };
  for (int i = 0; i < 1000; ++i) {
    const Planar velocity = any();
    EXPECT_GE(dot(velocity, water_damping(hull(), any()) * velocity), 0);
  }
}

void expect_near(const Planar& found, const Planar& expected, const Planar& tolerance) {
  EXPECT_NEAR(found.surge, expected.surge, tolerance.surge);
  EXPECT_NEAR(found.sway, expected.sway, tolerance.sway);
  EXPECT_NEAR(found.yaw, expected.yaw, tolerance.yaw);
}

/// Motions are mirrored between port and starboard, and between ahead and astern.
TEST(Manoeuvring, MirroredMotionsHaveMirroredForces) {
  const auto force = [](const Planar& at) { return water_damping(hull(), at) * at; };
  const Planar here = force({4, 0.7, 0.02}), rounding{1e-9, 1e-9, 1e-7};
  expect_near(force({4, -0.7, -0.02}), {here.surge, -here.sway, -here.yaw}, rounding);
  expect_near(force({-4, 0.7, -0.02}), {-here.surge, here.sway, -here.yaw}, rounding);
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
    const double q = 0.5 * 1000 * 6 * 0.9;
    expect_near(water_damping(only_cross, {0, v, r}) * Planar{0, v, r}, {0, q * y, q * n},
                1e-6 * q * 3600 * Planar{0, 1, 60});
  }
}

TEST(Propulsion, BollardPullFollowsFromPowerDiameterAndPropellers) {
  EXPECT_NEAR(bollard_pull(1e6, 1, 1), 78e3, 1e-6);  // 1000 kW to the power of ⅔ are 100
  EXPECT_NEAR(bollard_pull(1e6, 1, 2), 98e3, 1e-6);
  EXPECT_NEAR(bollard_pull(1e6, 1, 3), 112e3, 1e-6);
  EXPECT_NEAR(bollard_pull(1e6, 1, 2, true), 1.4 * 98e3, 1e-6);
  // The ice class rules have the same coefficient for a channel: K_e = (0.8 K)^−1.5.
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

TEST(Propulsion, ASettingGoesToTheWantedOneAtItsRate) {
  EXPECT_DOUBLE_EQ(approach(0, -1, 0.05, 2), -0.1);
  EXPECT_DOUBLE_EQ(approach(0.95, 1, 0.05, 2), 1);
}

TEST(Propulsion, ThrustersTurnTheirThrust) {
  EXPECT_EQ(turned_thrust(1e6, 0, -50), (Planar{1e6, 0, 0}));
  expect_near(turned_thrust(1e6, M_PI / 2, -50), {0, -1e6, 5e7}, {1e-9, 1e-6, 1e-4});
}

TEST(Planar, SolvesThreeEquations) {
  const PlanarMatrix a{{{{4, 1, -2}, {0.5, 3, 1}, {1, -1, 5}}}};
  const Planar x{1.5, -2, 0.25};
  expect_near(solve(a, a * x), x, {1e-15, 1e-15, 1e-15});
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
  double risen = 0, slid = 0, behind = 0;
  for (double s = -0.3; s < 130;) {
    const double to = s + 0.0137;
    risen += path.risen_over(s, to);
    slid += path.slid_over(s, to);
    behind += path.slid_behind_bow_over(s, to);
    s = to;
  }
  EXPECT_NEAR(risen, path.rise, 1e-12);
  EXPECT_NEAR(slid, path.sliding, 1e-11);
  EXPECT_NEAR(behind, path.sliding - path.bow, 1e-11);
}

TEST(SubmergedIce, AHullCoveredWithIcePaysLindqvistsResistance) {
  const SubmersionPath path = submersion_path(kReference);
  const double mu = 0.2, speed = 1, dt = 0.01, piece = 0.5;  // a piece every half metre
  const double weight = 100 * 9.81 * 0.5 * 24 * piece;       // weight of each piece [N]
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

// The container ship that Holtrop and Mennen compute in 1982 as their example (recall): 205 × 32 × 10 m, 37500 m³, half
// angle of entrance 12.08°. At 25 kn friction with its form factor is 1005 kN, the correlation allowance 222 kN, and
// waves are 557 kN behind a bulb and a transom that take factors 0.7595 and 0.9592 off, which our hull does not have.
TEST(OpenWater, ResistanceOfThePublishedExample) {
  const MainDimensions hull{205, 32, 10, 37500.0 / (205 * 32 * 10)};
  constexpr double kKnot = 1852.0 / 3600;
  const double published = 1e3 * (1005 + 222 + 557 / (0.7595 * 0.9592));
  EXPECT_NEAR(open_water_resistance(hull, 12.08 * shapes::kDegree, 25 * kKnot, 1025).value() / published, 1, 0.06);
  EXPECT_NEAR(usual_entrance_angle(hull).value() / (12.08 * shapes::kDegree), 1, 0.03);
}

TEST(OpenWater, ASpeedOverThePowerItTakesGivesThatSpeed) {
  const MainDimensions hull{100, 24, 8, 0.57};
  for (const double speed : {4.0, 7.0, 9.0}) {
    const double power = open_water_resistance(hull, 0.5, speed, 1000).value() * speed / kPowerIntoResistance;
    EXPECT_NEAR(usual_open_water_speed(hull, 0.5, power, 1000).value(), speed, 1e-5);
  }
}

TEST(OpenWater, GivesNothingOutsideTheRegression) {
  EXPECT_FALSE(open_water_resistance({100, 20, 8, 1}, 0.5, 8, 1000)) << "a box";
  EXPECT_FALSE(usual_entrance_angle({100, 20, 8, 0.95}));
  EXPECT_FALSE(open_water_resistance({100, 20, 8, 0.6}, 0.5, 13, 1000)) << "a Froude number of 0.42";
  EXPECT_FALSE(usual_open_water_speed({100, 20, 8, 0.6}, 0.5, 1e12, 1000));
  EXPECT_FALSE(usual_open_water_speed({100, 20, 8, 0.6}, 0.5, 1, 1000));
}

TEST(OpenWater, FullHullsSuitSlowShips) {
  EXPECT_NEAR(usual_block_coefficient(110, 24, 8.75), 0.497, 5e-4);  // 0.14/0.2664 × 24.58/26
  EXPECT_EQ(usual_block_coefficient(110, 24, 1), 0.85);
  EXPECT_EQ(usual_block_coefficient(110, 24, 20), 0.48);
}

}  // namespace
}  // namespace polynya::dynamics
