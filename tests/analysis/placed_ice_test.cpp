#include <limits>

#include "../io/expect_text.hpp"

#include "analysis/channel.hpp"
#include "geometry/exact/measures.hpp"

namespace polynya::tests {
namespace {

using geometry::Polygon;

const Polygon kSquare{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {}};

std::vector<analysis::PlacedIce> ice_of(const Polygon& polygon) {
  std::vector<analysis::PlacedIce> ice;
  const auto done = analysis::add_ice(ice, nullptr, polygon);
  EXPECT_TRUE(done.has_value()) << done.error();
  return ice;
}

TEST(PlacedIce, AValidFloeIsAddedAsItIs) {
  const auto ice = ice_of(kSquare);
  ASSERT_EQ(ice.size(), 1);
  EXPECT_EQ(ice[0].polygon.outer, kSquare.outer);
  EXPECT_EQ(ice[0].box.high.x, 2);
}

TEST(PlacedIce, ARingThatCrossesItselfIsWhatItWindsAround) {
  const auto ice = ice_of({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}});
  ASSERT_EQ(ice.size(), 2);
  EXPECT_EQ(geometry::measure(ice[0].polygon).area + geometry::measure(ice[1].polygon).area, 2);
}

TEST(PlacedIce, WhatEnclosesNothingIsNoIce) {
  EXPECT_TRUE(ice_of({{{0, 0}, {1, 1}, {2, 2}}, {}}).empty());
}

TEST(PlacedIce, AFloeThatCannotBePlacedIsToldNotLost) {
  std::vector<analysis::PlacedIce> ice;
  const auto done =
      analysis::add_ice(ice, nullptr, {{{0, 0}, {1, 0}, {0, std::numeric_limits<double>::infinity()}}, {}});
  ASSERT_FALSE(done.has_value());
  EXPECT_HAS(done.error(), "a placed floe is not a polygon");
  EXPECT_TRUE(ice.empty());
}

TEST(PlacedIce, NearIsWhereBoxesMeet) {
  const auto ice = ice_of(kSquare);
  EXPECT_EQ(near(ice, {{1, 1}, {5, 5}}).size(), 1);
  EXPECT_EQ(near(ice, {{3, 1}, {5, 5}}).size(), 0);
}

TEST(PlacedIce, APolygonIsPartedIntoWhatOthersCoverAndTheRest) {
  const Polygon half{{{-1, -1}, {1, -1}, {1, 3}, {-1, 3}}, {}};
  const auto parted = checked(analysis::part(kSquare, {half}));
  EXPECT_EQ(parted->inside_area, 2);
  ASSERT_EQ(parted->outside.size(), 1);
  EXPECT_EQ(geometry::measure(parted->outside[0]).area, 2);
}

TEST(PlacedIce, WhatNothingMeetsIsOutsideWhole) {
  const Polygon far{{{10, 10}, {11, 10}, {11, 11}}, {}};
  for (const auto& by : {std::vector<Polygon>{}, std::vector<Polygon>{far}}) {
    const auto parted = checked(analysis::part(kSquare, by));
    EXPECT_TRUE(parted->inside.empty());
    ASSERT_EQ(parted->outside.size(), 1);
    EXPECT_EQ(parted->outside[0].outer, kSquare.outer);
  }
}

}  // namespace
}  // namespace polynya::tests
