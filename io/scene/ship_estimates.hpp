#pragma once

#include <string>
#include <vector>

#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {

// Estimates for a ship in an early design stage, whose file does not state everything that `polynya performance` needs.

/// The estimate of a value that the ship's file does not state.
struct Estimate {
  std::string path;  ///< "propulsion.engine.open_water_speed_m_per_s"
  double value = 0;  ///< in the unit of its key, rounded to three digits
  std::string by;    ///< the formula and its source, in words
};

/// Adds estimates to a ship of a scene whose preset is filled in: the block coefficient, the entrance angle, the
/// diameter of the propellers if the thrust follows from it, and the open-water speed. Stated values are kept.
/// `density` is that of the water [kg/m³].
std::vector<Estimate> add_estimates(JsonValue& ship, double density);

/// Reports each value that `polynya performance` needs and that has to be stated, at its own path: one that is neither
/// stated nor estimated, and would not be estimated if the other reported ones were stated. Also reports what prevents
/// a run in level ice: a waterline point by point, a mooring, thrust without an engine.
void report_for_level_ice(const JsonValue& ship, const ReportAt& report_at);

}  // namespace polynya::io
