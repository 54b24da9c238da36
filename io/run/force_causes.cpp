#include "io/run/force_causes.hpp"

#include <algorithm>
#include <iterator>

#include "io/run/force_columns.hpp"

namespace polynya::io {
namespace {

constexpr std::string_view kSurge = "Surge force by cause";
constexpr std::string_view kSway = "Sway force by cause";
constexpr std::string_view kYaw = "Yaw moment by cause";

/// The ice around the hull: what it presses with, and the friction where that is recorded.
constexpr ForceCause ice(std::string_view direction, std::string_view column) {
  return {direction, "ice", "ice on the hull, with friction", column, {}, "ice: crushing and pushing"};
}
constexpr ForceCause friction(std::string_view direction, std::string_view column, std::string_view of) {
  return {direction, "friction", "ice: friction", column, of};
}

constexpr ForceCause kCauses[] = {
    ice(kSurge, "surge_N"),
    friction(kSurge, "surge_from_ice_friction_N", "surge_N"),
    {kSurge, "submerged", "ice under the hull", "surge_from_submerged_ice_N"},
    {kSurge, "water", "water on the hull", "surge_from_water_N"},
    {kSurge, "thrust", "thrust", "thrust_N"},
    {kSurge, "rudder", "rudder", "surge_from_rudder_N"},
    {kSurge, "mooring", "mooring", "surge_from_mooring_N"},
    {kSurge, "ships", "other ships", "surge_from_ships_N"},
    ice(kSway, "sway_N"),
    friction(kSway, "sway_from_ice_friction_N", "sway_N"),
    {kSway, "water", "water on the hull", "sway_from_water_N"},
    {kSway, "thrust", "thrusters", "sway_from_thrusters_N"},
    {kSway, "rudder", "rudder", "sway_from_rudder_N"},
    {kSway, "mooring", "mooring", "sway_from_mooring_N"},
    {kSway, "ships", "other ships", "sway_from_ships_N"},
    ice(kYaw, "yaw_Nm"),
    friction(kYaw, "yaw_from_ice_friction_Nm", "yaw_Nm"),
    {kYaw, "submerged", "ice under the hull", "yaw_from_submerged_ice_Nm"},
    {kYaw, "water", "water on the hull", "yaw_from_water_Nm"},
    {kYaw, "thrust", "thrusters", "yaw_from_thrusters_Nm"},
    {kYaw, "rudder", "rudder", "yaw_from_rudder_Nm"},
    {kYaw, "mooring", "mooring", "yaw_from_mooring_Nm"},
    {kYaw, "ships", "other ships", "yaw_from_ships_Nm"},
};

}  // namespace

std::span<const ForceCause> force_causes() {
  return kCauses;
}

std::vector<ForceCause> force_causes(const simulation::Scene& scene) {
  const std::vector<const ForceColumn*> plotted = plotted_columns(scene);
  std::vector<ForceCause> causes;
  std::ranges::copy_if(kCauses, std::back_inserter(causes), [&](const ForceCause& cause) {
    return std::ranges::find(plotted, cause.column, &ForceColumn::name) != plotted.end();
  });
  return causes;
}

}  // namespace polynya::io
