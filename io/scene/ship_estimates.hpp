#pragma once

#include <string>
#include <vector>

#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {

// Estimates for a ship in an early design stage, whose file does not state everything that `polynya performance` needs.

/// The estimate of a value that the ship's file does not state.
struct Estimate {
  std::string path;  ///< path of the value in the ship: "propulsion.engine.open_water_speed_m_per_s"
  double value = 0;  ///< estimate in the unit at the end of its key, rounded to three digits, as it is not more exact
  std::string by;    ///< formula of the estimate and its source, in words for people
};

/// Adds estimates to `ship`, an entry of a scene's "ships" whose preset is filled in, and returns those that were
/// added: the block coefficient, the entrance angle, the diameter of the propellers (if the power is stated but no
/// bollard pull, which then follows from the diameter), and the open-water speed. They are added in this order, and
/// later formulas use earlier estimates. The block coefficient follows from mass_kg, and only if no mass is stated from
/// the stated open-water speed. Stated values are kept, also wrong ones. A value stays missing if its formula needs
/// others that are missing, does not cover the hull, or gives a result outside of the key's range. `density` is that of
/// the water [kg/m³]; it matters only for the block coefficient from the mass and for the open-water speed.
std::vector<Estimate> add_estimates(JsonValue& ship, double density);

/// Reports each value of a ship that `polynya performance` needs and that its user has to state, at its own path. Call
/// it after add_estimates(), with the ship that it completed. A value is reported if it is neither stated nor
/// estimated, and if it would not be estimated once the other reported values are stated. Also reports what prevents a
/// run in level ice: a waterline point by point, a mooring, a mass from which no possible block coefficient follows,
/// and propulsion without an engine. Of the engine's values none is reported then. `report_at` takes a path in the
/// ship, the value that was found, and what is allowed. Nothing is reported if the ship has all that is needed.
void report_for_level_ice(const JsonValue& ship, const ReportAt& report_at);

}  // namespace polynya::io
