#include "io/run/force_columns.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

#include <fmt/format.h>

#include "geometry/shape/angle.hpp"
#include "io/text/csv_row.hpp"

namespace polynya::io {
namespace {

using simulation::ShipSample;

template <auto Member>
constexpr ForceColumn column(std::string_view name, std::string_view unit, std::string_view meaning,
                             std::string_view plot = {}, bool is_optional = false) {
  return {.name = name,
          .unit = unit,
          .meaning = meaning,
          .read = [](const ShipSample& s) { return static_cast<double>(s.*Member); },
          .store =
              [](ShipSample& s, double value) {
                s.*Member = static_cast<std::remove_reference_t<decltype(s.*Member)>>(value);
              },
          .plot = plot,
          .is_optional = is_optional};
}

template <double ShipSample::*Member>
constexpr ForceColumn in_degrees(std::string_view name, std::string_view unit, std::string_view meaning) {
  return {.name = name,
          .unit = unit,
          .meaning = meaning,
          .read = [](const ShipSample& s) { return geometry::kDegreesPerRadian * s.*Member; },
          .store = [](ShipSample& s, double value) { s.*Member = geometry::kRadiansPerDegree * value; }};
}

template <auto Pair, auto Component>
constexpr ForceColumn component(std::string_view name, std::string_view unit, std::string_view meaning) {
  return {.name = name,
          .unit = unit,
          .meaning = meaning,
          .read = [](const ShipSample& s) { return s.*Pair.*Component; },
          .store = [](ShipSample& s, double value) { s.*Pair.*Component = value; }};
}

using S = ShipSample;
using dynamics::Planar;
using geometry::Point;
using geometry::Vector;
using enum ShownWhere;
using enum CurveKind;

/// Whether older runs do not have what is shown there.
constexpr bool is_of_newer_runs(ShownWhere where) {
  return where != kAlways && where != kWhereItSplits;
}

/// A load of ships that sail, component by component.
template <auto Load, double dynamics::Planar::*Component>
constexpr ForceColumn sailing(std::string_view name, std::string_view unit, std::string_view meaning,
                              ShownWhere where, std::string_view plot) {
  ForceColumn load = component<Load, Component>(name, unit, meaning);
  load.is_optional = true;
  load.peak = where;
  load.plot = plot;
  return load;
}

/// Of the helm; without a peak.
constexpr ForceColumn of_helm(ForceColumn column, ShownWhere where, std::string_view plot) {
  column.is_optional = true;
  column.plotted = where;
  column.plot = plot;
  return column;
}

/// A load, with its peak and its plot; older runs do not have those of ships.
template <double S::*Member>
constexpr ForceColumn load(std::string_view name, std::string_view unit, std::string_view meaning,
                           ShownWhere where, std::string_view plot, CurveKind curve = kMean) {
  ForceColumn load = column<Member>(name, unit, meaning);
  load.is_optional = is_of_newer_runs(where);
  load.peak = where;
  load.plot = plot;
  load.curve = curve;
  return load;
}

constexpr std::string_view kSurge = "Surge force of the ice", kSurgeOfShips = "Surge force of ships";
constexpr std::string_view kSway = "Sway force of the ice", kSwayOfShips = "Sway force of ships";
constexpr std::string_view kYaw = "Yaw moment of the ice", kYawOfShips = "Yaw moment of ships";
constexpr bool kInNewerRuns = true;

constexpr ForceColumn kColumns[] = {
    load<&S::surge_force>("surge_N", "N",
                          "force of the ice forward, mean of the interval: momentum given / time", kAlways,
                          kSurge),
    load<&S::sway_force>("sway_N", "N", "to port, likewise", kAlways, kSway),
    load<&S::yaw_moment>("yaw_Nm", "N·m", "moment counter-clockwise, likewise", kAlways, kYaw),
    load<&S::surge_max>("surge_max_N", "N",
                        "force of the ice forward in the single step where it is largest by magnitude",
                        kAlways, kSurge, kMax),
    load<&S::sway_max>("sway_max_N", "N", "to port, likewise", kAlways, kSway, kMax),
    load<&S::yaw_max>("yaw_max_Nm", "N·m", "moment counter-clockwise, likewise", kAlways, kYaw, kMax),
    load<&S::surge_from_ships>("surge_from_ships_N", "N",
                               "force of other ships and structures forward, mean of the interval",
                               kAmongShips, kSurgeOfShips),
    load<&S::sway_from_ships>("sway_from_ships_N", "N", "to port, likewise", kAmongShips, kSwayOfShips),
    load<&S::yaw_from_ships>("yaw_from_ships_Nm", "N·m", "moment counter-clockwise, likewise", kAmongShips,
                             kYawOfShips),
    load<&S::surge_from_ships_max>(
        "surge_from_ships_max_N", "N",
        "force of other ships and structures forward in the single step where it is largest by magnitude",
        kAmongShips, kSurgeOfShips, kMax),
    load<&S::sway_from_ships_max>("sway_from_ships_max_N", "N", "to port, likewise", kAmongShips,
                                  kSwayOfShips, kMax),
    load<&S::yaw_from_ships_max>("yaw_from_ships_max_Nm", "N·m", "moment counter-clockwise, likewise",
                                 kAmongShips, kYawOfShips, kMax),
    load<&S::surge_from_submerged>("surge_from_submerged_ice_N", "N",
                                   "force of the ice under the hull forward, mean of the interval",
                                   kUnderHulls, "Surge force of the ice under the hull"),
    load<&S::yaw_from_submerged>("yaw_from_submerged_ice_Nm", "N·m", "its moment counter-clockwise, likewise",
                                 kUnderHulls, "Yaw moment of the ice under the hull"),
    load<&S::submerged_area>("ice_under_hull_m2", "m²", "ice under the hull, at the end of the interval",
                             kUnderHulls, "Ice under the hull"),
    load<&S::surge_peak>("surge_j_over_tau_c_N", "N",
                         "the paper's collision force j/τ_c of the ice forward, largest by magnitude",
                         kWhereItSplits, kSurge, kPaper),
    load<&S::sway_peak>("sway_j_over_tau_c_N", "N", "to port, likewise", kWhereItSplits, kSway, kPaper),
    load<&S::yaw_peak>("yaw_j_over_tau_c_Nm", "N·m", "its moment counter-clockwise, likewise", kWhereItSplits,
                       kYaw, kPaper),
    component<&S::position_in_world, &Point::x>("x_m", "m", "centre of gravity, over ground"),
    component<&S::position_in_world, &Point::y>("y_m", "m", "centre of gravity, over ground"),
    in_degrees<&S::heading>("heading_deg", "°", "from the x axis, counter-clockwise"),
    {.name = "speed_m_per_s",
     .unit = "m/s",
     .meaning = "over ground",
     .read = [](const S& s) { return length(s.velocity_in_world); },
     .store = [](S&, double) {},  // it follows from the velocity
     .peak = kAlways,
     .plot = "Speed over ground"},
    component<&S::velocity_in_world, &Vector::x>("vx_m_per_s", "m/s", "velocity over ground"),
    component<&S::velocity_in_world, &Vector::y>("vy_m_per_s", "m/s", "velocity over ground"),
    in_degrees<&S::yaw_rate>("yaw_rate_deg_per_s", "°/s", "counter-clockwise"),
    column<&S::thrust>("thrust_N", "N",
                       "along the heading; of a ship at constant speed what it takes to hold it", "Thrust"),
    sailing<&S::from_engine, &Planar::sway>("sway_from_thrusters_N", "N",
                                            "of turned thrusters to port, mean of the interval",
                                            kWithThrusters, "Sway force of thrusters"),
    sailing<&S::from_engine, &Planar::yaw>("yaw_from_thrusters_Nm", "N·m",
                                           "their moment counter-clockwise, likewise", kWithThrusters,
                                           "Yaw moment of thrusters"),
    sailing<&S::from_water, &Planar::surge>(
        "surge_from_water_N", "N",
        "force of the water on the hull forward, its inertia with it, mean of the interval", kInWater,
        "Surge force of the water"),
    sailing<&S::from_water, &Planar::sway>("sway_from_water_N", "N", "to port, likewise", kInWater,
                                           "Sway force of the water"),
    sailing<&S::from_water, &Planar::yaw>("yaw_from_water_Nm", "N·m", "moment counter-clockwise, likewise",
                                          kInWater, "Yaw moment of the water"),
    sailing<&S::from_rudder, &Planar::surge>("surge_from_rudder_N", "N",
                                             "force of the rudder forward, mean of the interval",
                                             kWithRudders, "Surge force of the rudder"),
    sailing<&S::from_rudder, &Planar::sway>("sway_from_rudder_N", "N",
                                            "to port, with the hull's share, likewise", kWithRudders,
                                            "Sway force of the rudder"),
    sailing<&S::from_rudder, &Planar::yaw>("yaw_from_rudder_Nm", "N·m", "moment counter-clockwise, likewise",
                                           kWithRudders, "Yaw moment of the rudder"),
    sailing<&S::from_mooring, &Planar::surge>("surge_from_mooring_N", "N",
                                              "force of the mooring forward, mean of the interval", kMoored,
                                              "Surge force of the mooring"),
    sailing<&S::from_mooring, &Planar::sway>("sway_from_mooring_N", "N", "to port, likewise", kMoored,
                                             "Sway force of the mooring"),
    sailing<&S::from_mooring, &Planar::yaw>("yaw_from_mooring_Nm", "N·m",
                                            "moment counter-clockwise, likewise", kMoored,
                                            "Yaw moment of the mooring"),
    sailing<&S::friction_of_ice, &Planar::surge>(
        "surge_from_ice_friction_N", "N",
        "share of surge_N that friction along the waterline has; the rest presses", kInWater,
        "Surge force of the ice's friction"),
    sailing<&S::friction_of_ice, &Planar::sway>("sway_from_ice_friction_N", "N", "of sway_N, likewise",
                                                kInWater, "Sway force of the ice's friction"),
    sailing<&S::friction_of_ice, &Planar::yaw>("yaw_from_ice_friction_Nm", "N·m", "of yaw_Nm, likewise",
                                               kInWater, "Yaw moment of the ice's friction"),
    of_helm(column<&S::lever>("lever", "",
                              "of the thrust, a share of the power: −1 full astern to 1 full ahead, at the "
                              "end of the interval"),
            kWithEngines, "Thrust lever"),
    of_helm(in_degrees<&S::steering_angle>("steering_deg", "°",
                                           "angle of rudder or thrusters, to port, at the end of the "
                                           "interval"),
            kWithEngines, "Steering angle"),
    of_helm(column<&S::delivered_power>("delivered_power_W", "W",
                                        "power of the engine at that lever; 0 where none is given"),
            kWithEngines, "Delivered power"),
    of_helm(column<&S::rams>("rams", "", "charges after the first, of a pilot that rams"), kRamming, "Rams"),
    of_helm(column<&S::gained>("gained_m", "m", "by rams, from where the ship was first stuck"), kRamming,
            "Gained by ramming"),
    column<&S::contacts>("contacts", "", "with ice, at the end of the interval", "Contacts at the hull"),
    column<&S::contacts_with_ships>("contacts_with_ships", "",
                                    "with other ships and structures, at the end of the interval", "",
                                    kInNewerRuns),
};

template <class Condition>
std::vector<const ForceColumn*> columns_where(Condition condition) {
  std::vector<const ForceColumn*> columns;
  for (const ForceColumn& column : kColumns)
    if (condition(column)) columns.push_back(&column);
  return columns;
}

}  // namespace

std::span<const ForceColumn> force_columns() {
  return kColumns;
}

std::string_view name_of(CurveKind kind) {
  return kind == kMean ? "mean" : kind == kMax ? "max" : "paper";
}

bool is_shown(ShownWhere where, const simulation::Scene& scene) {
  if (where == kAmongShips) return hull_count(scene) > 1;
  if (where == kUnderHulls) return has_draught(scene);
  const auto any_ship = [&](auto condition) { return std::ranges::any_of(scene.ships, condition); };
  using simulation::Ship;
  if (where == kInWater) return any_ship(simulation::sails);
  if (where == kWithEngines)
    return any_ship([](const Ship& s) { return std::holds_alternative<simulation::Engine>(s.propulsion); });
  if (where == kWithRudders)
    return any_ship(
        [](const Ship& s) { return std::holds_alternative<simulation::RudderSettings>(s.steering); });
  if (where == kWithThrusters)
    return any_ship(
        [](const Ship& s) { return std::holds_alternative<simulation::AzimuthSettings>(s.steering); });
  if (where == kRamming)
    return any_ship([](const Ship& s) { return std::holds_alternative<simulation::RammingPilot>(s.pilot); });
  if (where == kMoored) return any_ship([](const Ship& s) { return s.mooring.has_value(); });
  return where == kAlways || splits_by_j_over_tau_c(scene);
}

std::vector<const ForceColumn*> peak_columns(const simulation::Scene& scene) {
  return columns_where([&](const ForceColumn& c) { return c.peak && is_shown(*c.peak, scene); });
}

std::vector<const ForceColumn*> plotted_columns(const simulation::Scene& scene) {
  return columns_where([&](const ForceColumn& c) {
    const std::optional<ShownWhere> where = c.plotted ? c.plotted : c.peak;
    return !c.plot.empty() && (!where || !is_of_newer_runs(*where) || is_shown(*where, scene));
  });
}

const ForceColumn& force_column(std::string_view name) {
  const auto* found = std::ranges::find(kColumns, name, &ForceColumn::name);
  assert(found != std::end(kColumns));
  return *found;
}

Result<std::vector<const ForceColumn*>> force_columns_in(std::string_view header) {
  if (csv_field(header) != "t_s" || csv_field(header) != "ship") return fail("columns of another version");
  std::vector<const ForceColumn*> columns;
  while (!header.empty()) {
    const std::string_view name = csv_field(header);
    const auto* found = std::ranges::find(kColumns, name, &ForceColumn::name);
    if (found == std::end(kColumns) || std::ranges::count(columns, found) > 0)
      return fail(fmt::format("a column \"{}\" of another version, or a second one", name));
    columns.push_back(found);
  }
  for (const ForceColumn& column : kColumns) {
    if (!column.is_optional && std::ranges::count(columns, &column) == 0)
      return fail(fmt::format("no column \"{}\"", column.name));
  }
  return columns;
}

}  // namespace polynya::io
