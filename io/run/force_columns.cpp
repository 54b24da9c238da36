#include "io/run/force_columns.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <numbers>

#include <fmt/format.h>

#include "io/text/csv_row.hpp"

namespace polynya::io {
namespace {

using simulation::ShipSample;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kRadians = std::numbers::pi / 180;

template <auto Member>
constexpr ForceColumn column(std::string_view name, std::string_view meaning) {
  return {name, meaning, [](const ShipSample& s) { return static_cast<double>(s.*Member); },
          [](ShipSample& s, double value) {
            s.*Member = static_cast<std::remove_reference_t<decltype(s.*Member)>>(value);
          }};
}

template <double ShipSample::*Member>
constexpr ForceColumn in_degrees(std::string_view name, std::string_view meaning) {
  return {name, meaning, [](const ShipSample& s) { return kDegrees * s.*Member; },
          [](ShipSample& s, double value) { s.*Member = kRadians * value; }};
}

constexpr ForceColumn optional(ForceColumn column) {
  column.is_optional = true;
  return column;
}

using S = ShipSample;
constexpr ForceColumn kColumns[] = {
    column<&S::surge_force>("surge_N",
                            "force of the ice forward, mean of the interval: momentum given / time"),
    column<&S::sway_force>("sway_N", "to port, likewise"),
    column<&S::yaw_moment>("yaw_Nm", "moment counter-clockwise, likewise"),
    column<&S::surge_max>("surge_max_N",
                          "force of the ice forward in the single step where it is largest by magnitude"),
    column<&S::sway_max>("sway_max_N", "to port, likewise"),
    column<&S::yaw_max>("yaw_max_Nm", "moment counter-clockwise, likewise"),
    optional(column<&S::surge_from_ships>(
        "surge_from_ships_N", "force of other ships and structures forward, mean of the interval")),
    optional(column<&S::sway_from_ships>("sway_from_ships_N", "to port, likewise")),
    optional(column<&S::yaw_from_ships>("yaw_from_ships_Nm", "moment counter-clockwise, likewise")),
    optional(column<&S::surge_from_ships_max>(
        "surge_from_ships_max_N",
        "force of other ships and structures forward in the single step where it is largest by magnitude")),
    optional(column<&S::sway_from_ships_max>("sway_from_ships_max_N", "to port, likewise")),
    optional(column<&S::yaw_from_ships_max>("yaw_from_ships_max_Nm", "moment counter-clockwise, likewise")),
    column<&S::surge_peak>("surge_j_over_tau_c_N",
                           "the paper's collision force j/τ_c of the ice forward, largest by magnitude"),
    column<&S::sway_peak>("sway_j_over_tau_c_N", "to port, likewise"),
    column<&S::yaw_peak>("yaw_j_over_tau_c_Nm", "its moment counter-clockwise, likewise"),
    {"x_m", "centre of gravity, over ground", [](const S& s) { return s.position_in_world.x; },
     [](S& s, double value) { s.position_in_world.x = value; }},
    {"y_m", "centre of gravity, over ground", [](const S& s) { return s.position_in_world.y; },
     [](S& s, double value) { s.position_in_world.y = value; }},
    in_degrees<&S::heading>("heading_deg", "from the x axis, counter-clockwise"),
    {"speed_m_per_s", "over ground", [](const S& s) { return length(s.velocity_in_world); },
     [](S&, double) {}},  // it follows from the velocity
    {"vx_m_per_s", "velocity over ground", [](const S& s) { return s.velocity_in_world.x; },
     [](S& s, double value) { s.velocity_in_world.x = value; }},
    {"vy_m_per_s", "velocity over ground", [](const S& s) { return s.velocity_in_world.y; },
     [](S& s, double value) { s.velocity_in_world.y = value; }},
    in_degrees<&S::yaw_rate>("yaw_rate_deg_per_s", "counter-clockwise"),
    column<&S::thrust>("thrust_N", "along the heading; of a ship at constant speed what it takes to hold it"),
    column<&S::contacts>("contacts", "with ice, at the end of the interval"),
    optional(column<&S::contacts_with_ships>("contacts_with_ships",
                                             "with other ships and structures, at the end of the interval")),
};

}  // namespace

std::span<const ForceColumn> force_columns() {
  return kColumns;
}

const ForceColumn& force_column(std::string_view name) {
  const auto* found = std::ranges::find(kColumns, name, &ForceColumn::name);
  assert(found != std::end(kColumns));
  return *found;
}

tl::expected<std::vector<const ForceColumn*>, std::string> force_columns_in(std::string_view header) {
  if (csv_field(header) != "t_s" || csv_field(header) != "ship")
    return tl::unexpected(std::string("columns of another version"));
  std::vector<const ForceColumn*> columns;
  while (!header.empty()) {
    const std::string_view name = csv_field(header);
    const auto* found = std::ranges::find(kColumns, name, &ForceColumn::name);
    if (found == std::end(kColumns) || std::ranges::count(columns, found) > 0)
      return tl::unexpected(
          fmt::format("a column \"{}\" that this version does not know, or a second one", name));
    columns.push_back(found);
  }
  for (const ForceColumn& column : kColumns) {
    if (!column.is_optional && std::ranges::count(columns, &column) == 0)
      return tl::unexpected(fmt::format("no column \"{}\"", column.name));
  }
  return columns;
}

}  // namespace polynya::io
