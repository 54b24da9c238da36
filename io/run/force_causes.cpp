#include "io/run/force_causes.hpp"

#include <algorithm>
#include <iterator>

#include "io/run/force_columns.hpp"

namespace polynya::io {
namespace {

constexpr std::string_view kSurgeByCause = "Surge force by cause";
constexpr std::string_view kSwayByCause = "Sway force by cause";
constexpr std::string_view kYawByCause = "Yaw moment by cause";

/// The ice around the hull: what it presses with, and the friction where that is recorded.
constexpr ForceCause ice(std::string_view direction, std::string_view column) {
  return {direction, "ice", "ice on the hull, with friction", column, {}, "ice: crushing and pushing"};
}
constexpr ForceCause friction(std::string_view direction, std::string_view column, std::string_view of) {
  return {direction, "friction", "ice: friction", column, of};
}

constexpr ForceCause kCauses[] = {
    ice(kSurgeByCause, "surge_N"),
    friction(kSurgeByCause, "surge_from_ice_friction_N", "surge_N"),
    {kSurgeByCause, "submerged", "ice under the hull", "surge_from_submerged_ice_N"},
    {kSurgeByCause, "water", "water on the hull", "surge_from_water_N"},
    {kSurgeByCause, "thrust", "thrust", "thrust_N"},
    {kSurgeByCause, "rudder", "rudder", "surge_from_rudder_N"},
    {kSurgeByCause, "mooring", "mooring", "surge_from_mooring_N"},
    {kSurgeByCause, "ships", "other ships", "surge_from_ships_N"},
    ice(kSwayByCause, "sway_N"),
    friction(kSwayByCause, "sway_from_ice_friction_N", "sway_N"),
    {kSwayByCause, "water", "water on the hull", "sway_from_water_N"},
    {kSwayByCause, "thrust", "thrusters", "sway_from_thrusters_N"},
    {kSwayByCause, "rudder", "rudder", "sway_from_rudder_N"},
    {kSwayByCause, "mooring", "mooring", "sway_from_mooring_N"},
    {kSwayByCause, "ships", "other ships", "sway_from_ships_N"},
    ice(kYawByCause, "yaw_Nm"),
    friction(kYawByCause, "yaw_from_ice_friction_Nm", "yaw_Nm"),
    {kYawByCause, "submerged", "ice under the hull", "yaw_from_submerged_ice_Nm"},
    {kYawByCause, "water", "water on the hull", "yaw_from_water_Nm"},
    {kYawByCause, "thrust", "thrusters", "yaw_from_thrusters_Nm"},
    {kYawByCause, "rudder", "rudder", "yaw_from_rudder_Nm"},
    {kYawByCause, "mooring", "mooring", "yaw_from_mooring_Nm"},
    {kYawByCause, "ships", "other ships", "yaw_from_ships_Nm"},
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
