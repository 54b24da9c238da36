// The table of what causes the forces on a ship, against the table of forces.csv.
#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "io/run/records.hpp"

namespace polynya::io {
namespace {

/// What the parts of each direction add up to; a share counts in the column that contains it.
std::map<std::string_view, double> sums(const simulation::HullSample& row) {
  std::map<std::string_view, double> sums;
  for (const ForceCause& cause : force_causes())
    if (cause.share_of.empty()) sums[cause.direction] += force_column(cause.column).read(row);
  return sums;
}

TEST(ForceCauses, AddUpToTheForceOnTheShip) {
  simulation::HullSample row;  // each number in it another power of two
  row.from_ice.surge = 1, row.from_ice.sway = 2, row.from_ice.yaw = 4;
  row.from_ships.surge = 8, row.from_ships.sway = 16, row.from_ships.yaw = 32;
  row.from_submerged = {64, 1048576, 128};
  row.from_water = {256, 512, 1024};
  row.from_rudder = {2048, 4096, 8192};
  row.from_mooring = {16384, 32768, 65536};
  row.thrust = 131072;
  row.from_engine = {0, 262144, 524288};
  row.friction_of_ice = {0.5, 0.25, 0.125};  // a share of the first three
  const auto sum = sums(row);
  ASSERT_EQ(sum.size(), 3U);
  EXPECT_EQ(sum.at("Surge force by cause"), 1 + 8 + 64 + 256 + 2048 + 16384 + 131072);
  EXPECT_EQ(sum.at("Sway force by cause"), 2 + 16 + 1048576 + 512 + 4096 + 32768 + 262144);
  EXPECT_EQ(sum.at("Yaw moment by cause"), 4 + 32 + 128 + 1024 + 8192 + 65536 + 524288);
}

TEST(ForceCauses, HaveEachColumnOnceAndSharesOfColumnsOfTheirDirection) {
  for (const ForceCause& cause : force_causes()) {
    const auto is_this = [&](const ForceCause& other) { return other.column == cause.column; };
    EXPECT_EQ(std::ranges::count_if(force_causes(), is_this), 1) << cause.column;
    EXPECT_EQ(force_column(cause.column).unit, cause.direction.starts_with("Yaw") ? "N·m" : "N");
    if (cause.share_of.empty()) continue;
    const auto causes = force_causes();
    const auto whole = std::ranges::find(causes, cause.share_of, &ForceCause::column);
    ASSERT_TRUE(whole != causes.end()) << cause.share_of;
    EXPECT_EQ(whole->direction, cause.direction);
    EXPECT_FALSE(whole->without_shares.empty());
  }
}

TEST(ForceCauses, AreShownWhereAShipHasThem) {
  simulation::Scene scene;
  scene.ships.resize(1);
  scene.ships[0].propulsion = simulation::ConstantSpeed{1};
  const auto has = [&](std::string_view column) {
    const auto causes = force_causes(scene);
    return std::ranges::find(causes, column, &ForceCause::column) != causes.end();
  };
  EXPECT_TRUE(has("surge_N") && has("thrust_N"));
  EXPECT_FALSE(has("surge_from_ice_friction_N") || has("surge_from_mooring_N") || has("surge_from_ships_N"));
  scene.ships[0].propulsion = simulation::ConstantThrust{1};
  scene.ships[0].mooring.emplace();
  EXPECT_TRUE(has("surge_from_ice_friction_N") && has("surge_from_mooring_N"));
  scene.ships.push_back(scene.ships[0]);
  EXPECT_TRUE(has("surge_from_ships_N"));
}

}  // namespace
}  // namespace polynya::io
