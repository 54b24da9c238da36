#include "dynamics/contact/hash_grid.hpp"

#include <set>

#include <gtest/gtest.h>

namespace polynya::dynamics {
namespace {

std::set<BodyIndex> near(const HashGrid& grid, const geometry::Box& box) {
  std::set<BodyIndex> found;
  grid.for_each_near(box, [&](BodyIndex other) { found.insert(other); });
  return found;
}

/// A plate of 100 km among floes of 4 m took a cell for every 5 m of it, and all the memory there was.
TEST(HashGrid, AVastBodyIsNearAllAndTakesNoCells) {
  HashGrid grid(5);
  const geometry::Box plate{{0, 0}, {1e5, 1e5}};
  const geometry::Box floe{{10, 10}, {14, 14}};
  const geometry::Box far{{-1e4, 0}, {-1e4 + 4, 4}};
  grid.insert(0, plate);
  grid.insert(1, floe);
  grid.insert(2, far);
  EXPECT_EQ(near(grid, floe), (std::set<BodyIndex>{0, 1}));
  EXPECT_EQ(near(grid, far), (std::set<BodyIndex>{0, 2}));
  EXPECT_EQ(near(grid, plate), (std::set<BodyIndex>{0, 1, 2}));
  grid.remove(0, plate);
  EXPECT_EQ(near(grid, floe), (std::set<BodyIndex>{1}));
  EXPECT_EQ(near(grid, plate), (std::set<BodyIndex>{1, 2}));
}

/// All pieces that broke out of a plate were in the plate's own cell: each looked through all others.
TEST(HashGrid, PiecesOfAPlateHaveCellsOfTheirSize) {
  HashGrid grid(900);
  const auto square = [](double x, double y, double side) {
    return geometry::Box{{x, y}, {x + side, y + side}};
  };
  const geometry::Box plate = square(0, 0, 600);
  grid.insert(0, plate);
  for (BodyIndex i = 1; i < 100; ++i) grid.insert(i, square(6.0 * i, 300, 5));
  const std::set<BodyIndex> found = near(grid, square(300, 300, 5));
  EXPECT_EQ(found.count(0), 1U);
  EXPECT_EQ(found.count(50), 1U);  // 300 to 305 m
  EXPECT_LT(found.size(), 12U);
  EXPECT_EQ(near(grid, plate).size(), 100U);
  grid.remove(50, square(300, 300, 5));
  EXPECT_EQ(near(grid, square(300, 300, 5)).count(50), 0U);
  EXPECT_EQ(near(grid, square(-2000, 300, 5)), (std::set<BodyIndex>{}));
}

}  // namespace
}  // namespace polynya::dynamics
