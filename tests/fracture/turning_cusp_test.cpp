// The mass at the edge of a cusp that turns as it breaks off.
#include "fracture/turning_cusp.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace polynya::fracture {
namespace {

TEST(TurningCusp, WeighsAThirdOfItsIceAndHalfOfAPlatesWaterWhereItIsWide) {
  Ice ice;
  ice.thickness = 0.5;
  ice.density = 900;
  const Water water;
  const double depth = 2;
  const double width = 2e4;
  const double area = depth * width;
  const double mass = edge_mass(ice, water, {area, depth, width * depth * depth * depth / 3});
  // A plate of width 2a about its edge, in two dimensions: π ρ a⁴/8 about its middle, π ρ a⁴ of its middle's way.
  const double a = depth / 2;
  const double plate = 9. / 8 * std::numbers::pi * water.density * a * a * a * a;
  EXPECT_NEAR(mass / width, 900 * 0.5 * depth / 3 + plate / 2 / (depth * depth), 1e-4 * mass / width);
}

TEST(TurningCusp, OfALongOneTheWaterGoesRoundTheSides) {
  const Ice ice;
  const Water water;
  const auto water_of = [&](double depth) { return edge_mass(ice, water, {16, depth, 0}) / (16 * depth); };
  EXPECT_GT(water_of(2), 3 * water_of(8));
  EXPECT_EQ(edge_mass(ice, water, {}), 0);
}

}  // namespace
}  // namespace polynya::fracture
