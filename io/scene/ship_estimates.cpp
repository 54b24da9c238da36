#include "io/scene/ship_estimates.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "dynamics/ship/open_water.hpp"
#include "dynamics/ship/propulsion.hpp"
#include "elementary/elementary.hpp"
#include "geometry/shape/angle.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;

constexpr std::string_view kEngineKey = "propulsion.engine";

/// Returns the value at a path of keys; null if there is none.
template <class Json>
Json* at_path(Json& ship, std::string_view path) {
  Json* at = &ship;
  while (at && !path.empty()) {
    const std::size_t dot = path.find('.');
    at = at->find(path.substr(0, dot));
    path = dot == std::string_view::npos ? std::string_view{} : path.substr(dot + 1);
  }
  return at;
}

/// Adds estimates to a ship.
class Estimator {
 public:
  Estimator(JsonValue& ship, double density) : ship_(ship), density_(density) {}

  std::vector<Estimate> run() {
    add_block_coefficient();
    add_entrance_angle();
    add_propeller_diameter();
    add_open_water_speed();
    return std::move(estimates_);
  }

 private:
  /// Returns a stated or estimated number above 0; nothing otherwise.
  std::optional<double> number(std::string_view path) const {
    const JsonValue* found = at_path(std::as_const(ship_), path);
    if (!found || !found->is(JsonKind::kNumber) || !(found->number() > 0)) return {};
    return found->number();
  }
  std::optional<double> of_engine(std::string_view key) const { return number(fmt::format("{}.{}", kEngineKey, key)); }
  bool has(std::string_view path) const { return at_path(std::as_const(ship_), path) != nullptr; }

  struct Range {
    double least, most;
  };
  /// Sets a value of the ship if it lies in the range that its key allows.
  void add(std::string_view object, std::string_view key, double value, Range allowed, std::string by) {
    JsonValue* const holder = at_path(ship_, object);
    if (!holder || !holder->is(JsonKind::kObject) || !std::isfinite(value)) return;
    const double scale = elementary::pow(10, 2 - std::floor(elementary::log10(value)));
    const double rounded = std::round(value * scale) / scale;
    if (rounded < allowed.least || rounded > allowed.most) return;
    holder->set(key, rounded);
    estimates_.push_back({fmt::format("{}.{}", object, key), rounded, std::move(by)});
  }

  /// Returns length, beam and draught, and the block coefficient if it is known.
  std::optional<dynamics::MainDimensions> dimensions() const {
    const auto length = number("hull.length_m"), beam = number("hull.beam_m"), draught = number("hull.draught_m");
    if (!length || !beam || !draught) return {};
    return dynamics::MainDimensions{*length, *beam, *draught, number("hull.block_coefficient").value_or(0)};
  }

  void add_block_coefficient() {
    if (has("hull.block_coefficient")) return;
    const auto hull = dimensions();
    const auto mass = number("mass_kg"), speed = of_engine("open_water_speed_m_per_s");
    if (hull && mass)
      return add("hull", "block_coefficient", *mass / (density_ * hull->length * hull->beam * hull->draught), {0.2, 1},
                 "mass_kg over the mass of the water in length, beam and draught");
    if (hull && !has("mass_kg") && speed)
      add("hull", "block_coefficient", dynamics::usual_block_coefficient(hull->length, hull->beam, *speed), {0.2, 1},
          "0.14/Fn (L/B + 20)/26 at the open-water speed, within 0.48 to 0.85, [Schneekluth1998]");
  }

  void add_entrance_angle() {
    const auto hull = dimensions();
    if (has("hull.entrance_angle_deg") || has("hull.waterline_m") || !hull || !(hull->block_coefficient > 0)) return;
    if (const auto angle = dynamics::usual_entrance_angle(*hull))
      add("hull", "entrance_angle_deg", geometry::kDegreesPerRadian * *angle, {1, 89},
          "half angle of entrance of ordinary hulls, [Holtrop1984]");
  }

  void add_propeller_diameter() {
    const auto draught = number("hull.draught_m");
    if (of_engine("bollard_pull_kN") || !of_engine("power_MW") || !draught) return;
    if (has(fmt::format("{}.propeller_diameter_m", kEngineKey))) return;
    add(kEngineKey, "propeller_diameter_m", dynamics::kPropellerOfDraught * *draught, {1e-3, 50},
        fmt::format("{:g} of the draught (recall)", dynamics::kPropellerOfDraught));
  }

  /// Returns the installed power [W]. If it is not stated, the power is computed from the stated bollard pull K_e (P
  /// D)^⅔.
  std::optional<double> power() const {
    if (const auto stated = of_engine("power_MW")) return 1e6 * *stated;
    const auto pull = of_engine("bollard_pull_kN"), draught = number("hull.draught_m");
    if (!pull || !draught) return {};
    const double diameter = of_engine("propeller_diameter_m").value_or(dynamics::kPropellerOfDraught * *draught);
    const JsonValue* nozzles = at_path(std::as_const(ship_), fmt::format("{}.nozzles", kEngineKey));
    const bool has_nozzles = nozzles && nozzles->is(JsonKind::kBoolean) && nozzles->boolean();
    const int propellers = static_cast<int>(std::clamp(of_engine("propellers").value_or(1), 1.0, 3.0));
    return 1e6 * elementary::pow(1e3 * *pull / dynamics::bollard_pull(1e6, diameter, propellers, has_nozzles), 1.5);
  }

  void add_open_water_speed() {
    if (has(fmt::format("{}.open_water_speed_m_per_s", kEngineKey))) return;
    const auto hull = dimensions();
    const auto entrance = number("hull.entrance_angle_deg"), watts = power();
    if (!hull || !(hull->block_coefficient > 0) || !entrance || *entrance > 89 || !watts) return;
    const double angle = *entrance / geometry::kDegreesPerRadian;
    const auto speed = dynamics::usual_open_water_speed(*hull, angle, *watts, density_);
    if (!speed) return;
    add(kEngineKey, "open_water_speed_m_per_s", *speed, {1e-3, 30},
        fmt::format("{:g} of {}{:.3g} MW goes into the resistance by [Holtrop1984]; six known ships are within 12 %",
                    dynamics::kPowerIntoResistance,
                    of_engine("power_MW") ? "" : "the power that the bollard pull takes, ", 1e-6 * *watts));
  }

  JsonValue& ship_;
  const double density_;
  std::vector<Estimate> estimates_;
};

/// Returns true if the path has an object or nothing at all.
bool may_hold(const JsonValue& ship, std::string_view path) {
  const JsonValue* found = at_path(ship, path);
  return !found || found->is(JsonKind::kObject);
}

}  // namespace

std::vector<Estimate> add_estimates(JsonValue& ship, double density) {
  return Estimator(ship, density).run();
}

void report_for_level_ice(const JsonValue& ship, const ReportAt& report_at) {
  const auto has = [&](std::string_view path) { return at_path(ship, path) != nullptr; };
  const auto require = [&](std::string_view path, std::string_view allowed) {
    if (!has(path)) report_at(path, "nothing", std::string(allowed));
  };
  const bool has_dimensions = has("hull.length_m") && has("hull.beam_m") && has("hull.draught_m");
  const bool has_form = has_dimensions && has("hull.block_coefficient");
  if (has("hull.waterline_m")) {
    report_at("hull.waterline_m", "a waterline point by point",
              "length_m, beam_m and entrance_angle_deg, which the formulas and the course need");
  } else if (may_hold(ship, "hull")) {
    require("hull.length_m", "the length of the waterline, a number ≥ 0.1, ≤ 1000 [m]");
    require("hull.beam_m", "the beam of the waterline, a number ≥ 0.1, ≤ 1000 [m]");
    if (has_form) require("hull.entrance_angle_deg", "a number ≥ 1, ≤ 89 [°]; the estimate does not cover this hull");
  }
  if (may_hold(ship, "hull")) {
    require("hull.draught_m", "a number > 0, ≤ 1000 [m]: the formulas and the course in level ice need it");
    if (!has("mass_kg") && !has("propulsion.engine.open_water_speed_m_per_s"))
      require("hull.block_coefficient",
              "one of three particulars: hull.block_coefficient (≥ 0.2, ≤ 1), mass_kg, or "
              "propulsion.engine.open_water_speed_m_per_s (> 0, ≤ 30 m/s); each of them suffices to estimate what else "
              "is missing");
    else if (!has("mass_kg") && has_dimensions)
      require("hull.block_coefficient",
              "a number ≥ 0.2, ≤ 1, or mass_kg; the estimate from the open-water speed does not cover this hull");
    else if (const JsonValue* mass = ship.find("mass_kg", JsonKind::kNumber); mass && has_dimensions && !has_form)
      report_at("mass_kg", fmt::format("{:g}", mass->number()),
                "a mass that gives a block coefficient of 0.2 to 1 with length, beam and draught");
  }
  if (has("mooring")) report_at("mooring", "a mooring", "none: the ship sails");
  const JsonValue* propulsion = ship.find("propulsion", JsonKind::kObject);
  if (propulsion && !propulsion->members().empty() && !propulsion->find("engine"))
    return report_at(kEngineKey, "nothing", "an engine, by which is known what the ship can push with");
  if (!may_hold(ship, "propulsion") || !may_hold(ship, kEngineKey)) return;
  const bool has_power = has("propulsion.engine.power_MW") || has("propulsion.engine.bollard_pull_kN");
  if (!has_power)
    require("propulsion.engine.power_MW", "installed power, a number > 0, ≤ 1000 [MW], or bollard_pull_kN");
  if (has_form && has_power && has("hull.entrance_angle_deg"))
    require("propulsion.engine.open_water_speed_m_per_s",
            "a number > 0, ≤ 30 [m/s]; the estimate does not cover this hull and power");
}

}  // namespace polynya::io
