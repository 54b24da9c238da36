#include "io/run/force_causes.hpp"

#include <algorithm>
#include <iterator>

#include "io/run/force_columns.hpp"

namespace polynya::io {
namespace {

constexpr std::string_view kDirections[]{"Surge force by cause", "Sway force by cause",
                                         "Yaw moment by cause"};

/// What one cause gives in each direction.
struct Row {
  std::string_view cause, words;
  std::string_view columns[3];  ///< empty: none
};
constexpr Row kIce{"ice", "ice on the hull, with friction", {"surge_N", "sway_N", "yaw_Nm"}};
constexpr Row kFriction{
    "friction",
    "ice: friction",
    {"surge_from_ice_friction_N", "sway_from_ice_friction_N", "yaw_from_ice_friction_Nm"}};
constexpr Row kRows[]{
    kIce,
    kFriction,
    {"submerged", "ice under the hull", {"surge_from_submerged_ice_N", "", "yaw_from_submerged_ice_Nm"}},
    {"water", "water on the hull", {"surge_from_water_N", "sway_from_water_N", "yaw_from_water_Nm"}},
    {"thrust", "thrust", {"thrust_N"}},
    {"thrust", "thrusters", {"", "sway_from_thrusters_N", "yaw_from_thrusters_Nm"}},
    {"rudder", "rudder", {"surge_from_rudder_N", "sway_from_rudder_N", "yaw_from_rudder_Nm"}},
    {"mooring", "mooring", {"surge_from_mooring_N", "sway_from_mooring_N", "yaw_from_mooring_Nm"}},
    {"ships", "other ships", {"surge_from_ships_N", "sway_from_ships_N", "yaw_from_ships_Nm"}},
};

std::vector<ForceCause> all_causes() {
  std::vector<ForceCause> causes;
  for (std::size_t i = 0; i < std::size(kDirections); ++i) {
    for (const Row& row : kRows) {
      if (row.columns[i].empty()) continue;
      ForceCause& cause = causes.emplace_back(kDirections[i], row.cause, row.words, row.columns[i]);
      if (row.cause == kFriction.cause) cause.share_of = kIce.columns[i];
      if (row.cause == kIce.cause) cause.without_shares = "ice: crushing and pushing";
    }
  }
  return causes;
}

}  // namespace

std::span<const ForceCause> force_causes() {
  static const std::vector<ForceCause> kCauses = all_causes();
  return kCauses;
}

std::vector<ForceCause> force_causes(const simulation::Scene& scene) {
  const std::vector<const ForceColumn*> plotted = plotted_columns(scene);
  std::vector<ForceCause> causes;
  std::ranges::copy_if(force_causes(), std::back_inserter(causes), [&](const ForceCause& cause) {
    return std::ranges::find(plotted, cause.column, &ForceColumn::name) != plotted.end();
  });
  return causes;
}

}  // namespace polynya::io
