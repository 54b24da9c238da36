// The plate's length scale and the force that splits a floe, against numbers worked out by hand.
#include "fracture/characteristic_length.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace polynya::fracture {
namespace {

Ice papers_ice() {
  return {};
}

TEST(CharacteristicLength, IsTheFourthRootOfRigidityOverFoundation) {
  const Ice ice = papers_ice();
  const Water water;
  const double l = characteristic_length(ice, water);
  EXPECT_NEAR(l, 8.909, 5e-4);
  EXPECT_NEAR(flexural_rigidity(ice) / (water.density * kGravity * std::pow(l, 4)), 1, 1e-14);
}

TEST(CharacteristicLength, AsPrintedIsItsSquare) {
  EXPECT_NEAR(breakable_length(papers_ice(), {}, CharacteristicLength::kAsPrinted), 79.4, 0.05);
  EXPECT_NEAR(breakable_length(papers_ice(), {}, CharacteristicLength::kFourthRoot), 8.909, 5e-4);
}

TEST(CharacteristicLength, GrowsWithThicknessToTheThreeQuarters) {
  Ice thick = papers_ice();
  thick.thickness *= 16;
  EXPECT_NEAR(characteristic_length(thick, {}) / characteristic_length(papers_ice(), {}), 8, 1e-12);
  Ice stiff = papers_ice();
  stiff.youngs_modulus *= 16;
  EXPECT_NEAR(characteristic_length(stiff, {}) / characteristic_length(papers_ice(), {}), 2, 1e-12);
}

}  // namespace
}  // namespace polynya::fracture
