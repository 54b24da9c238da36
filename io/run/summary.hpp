#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/scene/scene_reader.hpp"
#include "io/text/json_parser.hpp"
#include "simulation/world/energy.hpp"
#include "simulation/world/journal.hpp"

namespace polynya::simulation {
class Simulation;
}

namespace polynya::io {

class RunWriter;

/// Largest magnitude of a value, and its time.
struct Peak {
  double value = 0;
  double time = 0;  ///< [s]
  void include(double candidate, double at) {
    if (std::abs(candidate) > std::abs(value)) *this = {candidate, at};
  }
};

/// Largest loads on one ship over a run, in the ship's frame.
struct ShipPeaks {
  std::string ship;
  std::vector<Peak> of_column;  ///< of each column of peak_columns()
  Peak of_contact;  ///< largest force of one contact with ice along its normal [N], as a row of contacts.csv has it
};

/// Number of fractures: bends and splits. Ground overlaps and refused cuts are not counted.
inline std::int64_t fractures_of(const simulation::Counts& counts) {
  return counts.bends + counts.splits;
}

/// Contents of summary.json.
struct RunSummary {
  bool finished = false;
  std::string stopped_by;  ///< reason why the run stopped early; empty while it runs and when it has finished
  std::int64_t steps = 0;
  double sim_time = 0;   ///< [s]
  double wall_time = 0;  ///< [s]
  simulation::IceLedger areas;
  simulation::IceLedger masses;
  simulation::Audit audit;
  simulation::Counts counts;
  std::vector<ShipPeaks> peaks;
  simulation::PeakCounts load_peaks;
  std::vector<std::string> warnings;

  double real_time_factor() const { return wall_time > 0 ? sim_time / wall_time : 0; }
  /// Returns true if the balances of ice, energy and momentum close.
  bool accounts_close() const { return audit.is_closed() && areas.is_closed() && masses.is_closed(); }
};

/// Returns the shortest time step [s] that a run with this tick [s] took.
double shortest_step(const simulation::Counts& counts, double tick);

/// Returns the summary of a run that has ended. `stopped_by` is the reason if it was stopped, or empty if it finished.
/// `wall_time` [s] is that of the whole run.
RunSummary summarise(const simulation::Simulation& simulation, const RunWriter& writer, const std::string& stopped_by,
                     double wall_time);

std::string to_json_text(const RunSummary& summary, const LoadedScene& scene);

/// Finds the first member of a summary.json whose kind differs from what this program writes, for example a text
/// instead of a number. Members may be missing, because older versions wrote fewer.
std::optional<JsonFault> fault_of_summary(const JsonValue& summary, const LoadedScene& scene);

/// End of a finished run.
struct FinishedRun {
  double time = 0;       ///< simulated time [s]
  double wall_time = 0;  ///< wall time that the run took [s]
};
/// Reads the end from summary.json of a folder; returns nothing if the run has not finished.
std::optional<FinishedRun> finished_run(const std::filesystem::path& folder);

/// Returns the version of Polynya, which every summary.json contains.
std::string_view version();

}  // namespace polynya::io
