// Turns are exact: a body's angle is the sum of all its turns, and its rotation is the one by that angle.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "dynamics/bodies.hpp"
#include "tests/dynamics/scenery.hpp"

namespace polynya::dynamics {
namespace {

/// The difference of two angles, modulo a whole turn [rad].
long double apart(long double a, long double b) {
  return std::abs(std::remainder(a - b, 2 * std::numbers::pi_v<long double>));
}

/// Against the library's functions of long doubles, over all quarters and up to the largest angles of long runs.
TEST(Turns, CosineAndSineAreRightToTheLastBit) {
  for (const double scale : {1e-9, 1e-3, 1.0, 10.0, 1e3, 1e6}) {
    for (int i = -2000; i <= 2000; ++i) {
      const double angle = scale * i / 1237;
      const geometry::Rotation r = geometry::Rotation::by(angle);
      ASSERT_NEAR(r.cosine, static_cast<double>(std::cos(static_cast<long double>(angle))), 1.3e-16) << angle;
      ASSERT_NEAR(r.sine, static_cast<double>(std::sin(static_cast<long double>(angle))), 1.3e-16) << angle;
    }
  }
  EXPECT_EQ(geometry::Rotation::by(0).cosine, 1);
  EXPECT_EQ(geometry::Rotation::by(0).sine, 0);
}

/// A thousand seconds in the shortest steps are a million turns: plain sums of them would be 1e-8 rad off.
TEST(Turns, AngleAndRotationAreTheIntegralOfTheSpin) {
  for (const double spin : {1e-5, 0.01, 1.0472, 100.0}) {
    for (const double step : {0.0005, 0.00037, 0.005, 0.1}) {
      Bodies bodies;
      NewBody body = scenery::floe_body(shapes::rectangle(0, 0, 1, 1), {0, 0});
      body.angular_velocity = spin;
      body.angle = 0.3;
      add_body(bodies, body);
      const std::vector<BodyIndex> awake{0};
      const auto steps = static_cast<std::int64_t>(600 / step);
      for (std::int64_t i = 0; i < steps; ++i) integrate(bodies, awake, step);
      const long double turned = static_cast<long double>(spin) * step * steps;
      const geometry::Rotation r = bodies.rotation[0];
      EXPECT_LT(apart(bodies.angle[0], 0.3L + turned), 1e-11L) << spin << ' ' << step;
      EXPECT_LT(apart(std::atan2(static_cast<long double>(r.sine), static_cast<long double>(r.cosine)), 0.3L + turned),
                1e-11L)
          << spin << ' ' << step;
      EXPECT_NEAR(r.cosine * r.cosine + r.sine * r.sine, 1, 4e-16);
    }
  }
}

}  // namespace
}  // namespace polynya::dynamics
