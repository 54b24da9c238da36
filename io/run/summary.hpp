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

/// The largest value of something, by magnitude, and when.
struct Peak {
  double value = 0;
  double time = 0;  ///< [s]
  void include(double candidate, double at) {
    if (std::abs(candidate) > std::abs(value)) *this = {candidate, at};
  }
};

/// The largest loads on one ship over a run, in its frame.
struct ShipPeaks {
  std::string ship;
  std::vector<Peak> of_column;  ///< of each of peak_columns()
  Peak of_contact;              ///< of one contact with ice along its normal, by the gauge [N]
};

/// Number of fractures: bends and splits. Ground overlaps and refused cuts are not counted.
inline std::int64_t fractures_of(const simulation::Counts& counts) {
  return counts.bends + counts.splits;
}

/// What summary.json holds.
struct RunSummary {
  bool finished = false;
  std::string stopped_by;  ///< why it did not finish; empty while it runs and when it finished
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
  /// Whether ice, energy and momentum are where the accounts have them.
  bool accounts_close() const { return audit.is_closed() && areas.is_closed() && masses.is_closed(); }
};

/// The shortest time step that a run of such ticks [s] took [s].
double shortest_step(const simulation::Counts& counts, double tick);

/// The summary of a run at its end, or where it was stopped; `stopped_by` is empty at the end.
RunSummary summarise(const simulation::Simulation& simulation, const RunWriter& writer, const std::string& stopped_by,
                     double wall_time);

std::string to_json_text(const RunSummary& summary, const LoadedScene& scene);

/// Finds the first member of a summary.json whose kind differs from what this program writes, for example a text
/// instead of a number. Members may be missing, because older versions wrote fewer.
std::optional<JsonFault> fault_of_summary(const JsonValue& summary, const LoadedScene& scene);

/// The end of a finished run.
struct FinishedRun {
  double time = 0;       ///< simulated [s]
  double wall_time = 0;  ///< that it has taken [s]
};
/// By a folder's summary.json; none where its run has not finished.
std::optional<FinishedRun> finished_run(const std::filesystem::path& folder);

/// Polynya's version, as in every summary.json.
std::string_view version();

}  // namespace polynya::io
