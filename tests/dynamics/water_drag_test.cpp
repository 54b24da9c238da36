// Eq. (6) of [Sawamura2017], relative to the water, against closed forms.
#include "dynamics/water/water_drag.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/dynamics/scenery.hpp"

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
  // Velocities are relative to the water, so a drifting floe has none: nothing changes, to the last bit.
  Bodies bodies = one_floe(rectangle(10, 6), 0.7);
  EXPECT_EQ(brake(bodies, 100).lost, 0);
  EXPECT_EQ(bodies.velocity[0], Vector{});
  EXPECT_EQ(bodies.angular_velocity[0], 0);
}

TEST(WaterDrag, AFreeFloeSlowsAsTheClosedForm) {
  // m v' = −½ C_D ρ_w h w v²  ⇒  v(t) = v0 / (1 + k v0 t), k = C_D ρ_w h w / 2m, for any step length.
  for (const double dt : {0.005, 0.5, 50.0}) {
    Bodies bodies = one_floe(rectangle(10, 6));
    bodies.velocity[0] = {1.5, 0};
    const double k = kDrag * kWater * kThickness * 6 / (2 * bodies.mass[0]);
    for (int step = 0; step < 2000; ++step) brake(bodies, dt);
    EXPECT_NEAR(bodies.velocity[0].x * (1 + k * 1.5 * 2000 * dt) / 1.5, 1, 1e-11) << dt;
    EXPECT_EQ(bodies.velocity[0].y, 0);
    EXPECT_EQ(bodies.angular_velocity[0], 0);
  }
}

TEST(WaterDrag, AShapeIsAsWideAsItsFarthestCornersInAllDirections) {
  Random random(17);
  for (int i = 0; i < 200; ++i) {
    const geometry::Polygon star = random_star(random, 3 + random.below(200), 3, 8);
    const DragShape shape = make_drag_shape(star, {});
    for (int k = 0; k < DragShape::kDirections; ++k) {
      const geometry::Vector across = perpendicular(drag_direction(k)) / length(drag_direction(k));
      double low = 0;
      double high = 0;
      for (const geometry::Point p : star.outer) {
        low = std::min(low, dot(p - geometry::Point{}, across));
        high = std::max(high, dot(p - geometry::Point{}, across));
      }
      ASSERT_NEAR(shape.width[k], high - low, 1e-13);
      const auto found = widths_of_outline(star.outer, {}, k);
      ASSERT_EQ(found[0], shape.width[k]) << "star " << i << ", direction " << k;
      ASSERT_EQ(found[1], shape.width[k + 1]) << "star " << i << ", direction " << k;
    }
  }
}

TEST(WaterDrag, AFloeWithoutATableOfWidthsMovesAsOneWithItToTheBit) {
  Random random(18);
  for (int i = 0; i < 50; ++i) {
    const geometry::Polygon star = random_star(random, 3 + random.below(60), 3, 8);
    Bodies with = one_floe(star, random.angle());
    Bodies without = with;
    const Point centroid = with.centroid[0];
    with.drag[0] = std::make_shared<DragShape>(make_drag_shape(star, centroid));
    without.drag[0] = std::make_shared<DragShape>(make_small_drag_shape(star, centroid));
    EXPECT_EQ(without.drag[0]->width.empty(), star.outer.size() <= 32);
    for (int step = 0; step < 100; ++step) {
      for (Bodies* bodies : {&with, &without}) {
        bodies->velocity[0] += geometry::Vector{0.1 * std::cos(0.2 * step), 0.1 * std::sin(0.2 * step)};
        brake(*bodies, 0.1);
        integrate(*bodies, {0}, 0.1);
      }
      ASSERT_EQ(with.velocity[0], without.velocity[0]);
      ASSERT_EQ(with.angular_velocity[0], without.angular_velocity[0]);
    }
  }
}

TEST(WaterDrag, TheRotationalIntegralIsThatOfDiscAndSquare) {
  // K = mean over directions of ∫|s|³ ds: R⁴/2 for a disc; (a/2)⁴ (3/2 + 4/π) / 2 for a square of side a.
  EXPECT_NEAR(make_drag_shape(shapes::regular(512, 7), {}).rotational / (std::pow(7, 4) / 2), 1, 1e-3);
  const double square = std::pow(4.0, 4) * (1.5 + 4 / std::numbers::pi) / 2;
  EXPECT_NEAR(make_drag_shape(rectangle(8, 8), {}).rotational / square, 1, 2e-3);
}

TEST(WaterDrag, AFreeSpinSlowsAsTheClosedForm) {
  // I ω' = −½ C_D ρ_w h K ω²
  for (const double omega : {0.3, -0.3}) {
    Bodies bodies = one_floe(shapes::regular(64, 9));
    bodies.angular_velocity[0] = omega;
    const double k = kDrag * kWater * kThickness * bodies.drag[0]->rotational / (2 * bodies.moment[0]);
    for (int step = 0; step < 3000; ++step) brake(bodies, 0.02);
    EXPECT_NEAR(bodies.angular_velocity[0] * (1 + k * 0.3 * 60) / omega, 1, 1e-11);
    EXPECT_EQ(bodies.velocity[0], Vector{});
  }
}

TEST(WaterDrag, ActsAgainstTheVelocityAndTakesTheEnergyItReports) {
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    Bodies bodies = one_floe(random_star(random, 5 + random.below(12), 1, 15), random.angle());
    bodies.velocity[0] = {random.between(-4, 4), random.between(-4, 4)};
    bodies.angular_velocity[0] = random.between(-1, 1);
    const Vector v = bodies.velocity[0];
    const double before = kinetic_energy(bodies);
    const double work = apply_water_drag(bodies, {0}, {random.between(0, 2), kWater, {}},
                                         std::pow(10.0, random.between(-4, 4)))
                            .lost;
    const double after = kinetic_energy(bodies);
    ASSERT_LE(after, before);
    ASSERT_NEAR((before - after) / before, work / before, 1e-12);
    ASSERT_NEAR(cross(v, bodies.velocity[0]), 0, 1e-13) << "drag turns nothing";
    ASSERT_GE(dot(v, bodies.velocity[0]), 0) << "and never reverses";
  }
}

TEST(WaterDrag, WidthOfASquareIsWithinItsStatedError) {
  const DragShape square = make_drag_shape(rectangle(10, 10), {});
  double worst = 0;
  for (int i = 0; i <= 100000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 100000;
    const double exact = 10 * (std::abs(std::cos(angle)) + std::abs(std::sin(angle)));
    const double relative = width_across(square, {std::cos(angle), std::sin(angle)}) / exact - 1;
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
    // A floe's width has a kink where it moves along an edge, and interpolation cuts it: by at most half the
    // spacing of the known directions (1/16 rad) times the floe's aspect ratio.
    const double aspect = std::max(along, across) / std::min(along, across);
    ASSERT_LT(off, aspect / 32 + 1e-3) << aspect;
  }
}

TEST(WaterDrag, BodiesOfPrescribedMotionKeepTheirVelocity) {
  Bodies bodies;
  add_held(bodies, rectangle(10, 6), {}, {1, 0}, 0.1);
  brake(bodies, 10);
  EXPECT_EQ(bodies.velocity[0], (Vector{1, 0}));
  EXPECT_EQ(bodies.angular_velocity[0], 0.1);
}

/// ∫ r³ dA over a rectangle about a point, by Gauss's rule of 3 × 3 points in many cells.
double third_moment_of_rectangle(Point low, Point high, Point about) {
  constexpr int kCells = 200;
  const double x[3] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
  const double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  const double dx = (high.x - low.x) / kCells;
  const double dy = (high.y - low.y) / kCells;
  double sum = 0;
  for (int i = 0; i < kCells * 3; ++i) {
    for (int j = 0; j < kCells * 3; ++j) {
      const int column = i / 3;
      const int row = j / 3;
      const Point p{low.x + (column + x[i % 3]) * dx, low.y + (row + x[j % 3]) * dy};
      sum += weight[i % 3] * weight[j % 3] * std::pow(distance(p, about), 3) * dx * dy;
    }
  }
  return sum;
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
    EXPECT_NEAR(moment(rectangle(10, 6), about) / third_moment_of_rectangle({-5, -3}, {5, 3}, about), 1,
                1e-9);
}

TEST(PlanDrag, AFreeFloeSlowsAsTheClosedFormWhateverItsCourseAndThickness) {
  // m v' = −½ C_D ρ_w A v², A = 60 m² in plan, and I ω' = −½ C_D ρ_w ∫r³dA ω².
  Random random(4);
  for (const double dt : {0.005, 0.5, 50.0}) {
    Bodies bodies = one_floe(rectangle(10, 6), random.angle());
    bodies.drag[0] = std::make_shared<DragShape>(make_drag_shape(rectangle(10, 6), {}, DragArea::kPlan));
    const double course = random.angle();
    bodies.velocity[0] = 1.5 * Vector{std::cos(course), std::sin(course)};
    bodies.angular_velocity[0] = -0.2;
    bodies.thickness[0] = random.between(0.1, 3);
    const double braking = kDrag * kWater * 60 / (2 * bodies.mass[0]);
    const double turning =
        kDrag * kWater * third_moment_of_rectangle({-5, -3}, {5, 3}, {}) / (2 * bodies.moment[0]);
    for (int step = 0; step < 2000; ++step) brake(bodies, dt, DragArea::kPlan);
    const double time = 2000 * dt;
    EXPECT_NEAR(length(bodies.velocity[0]) * (1 + braking * 1.5 * time) / 1.5, 1, 1e-9) << dt;
    EXPECT_NEAR(-bodies.angular_velocity[0] * (1 + turning * 0.2 * time) / 0.2, 1, 1e-9) << dt;
  }
}

}  // namespace
}  // namespace polynya::dynamics
