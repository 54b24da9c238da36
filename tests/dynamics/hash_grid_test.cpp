#include "dynamics/hash_grid.hpp"

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

}  // namespace
}  // namespace polynya::dynamics
