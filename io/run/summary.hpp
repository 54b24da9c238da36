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

/// The value of largest magnitude among several, with its sign, and its time.
struct Peak {
  double value = 0;  ///< in the unit of what is measured, with the sign of that moment; 0 if there was nothing
  double time = 0;   ///< simulated time of the value [s]
  /// Takes a value at a time [s] into account. Of equal magnitudes the first one stays, and NaN is ignored.
  void include(double candidate, double at) {
    if (std::abs(candidate) > std::abs(value)) *this = {candidate, at};
  }
};

/// Largest loads on one hull (ship, structure or wall) over a run, in the hull's frame.
struct ShipPeaks {
  std::string ship;             ///< name of the hull
  std::vector<Peak> of_column;  ///< of each column of forces.csv that peak_columns() names, in its order and units
  Peak of_contact{};  ///< largest force of one contact with ice along its normal [N], of the peaks in contacts.csv
};

/// Returns the number of fractures that progress and summaries show: bends and splits. Ground overlaps and refused cuts
/// are not counted.
inline std::int64_t fractures_of(const simulation::Counts& counts) {
  return counts.bends + counts.splits;
}

/// Contents of summary.json, except for those that follow from the scene.
struct RunSummary {
  bool finished = false;  ///< true if the end of the scene was reached
  /// Reason why the run stopped early; empty when it has finished. While it runs the file says "still running, or
  /// killed" (run_writer.cpp), which a killed run keeps.
  std::string stopped_by;
  std::int64_t steps = 0;        ///< number of whole ticks (time.step_s); a tick may be divided into several time steps
  double sim_time = 0;           ///< simulated time [s]
  double wall_time = 0;          ///< time by the clock of the whole run, also before it was resumed [s]
  simulation::IceLedger areas;   ///< balance of the area of ice [m²]
  simulation::IceLedger masses;  ///< balance of the mass of ice [kg]
  simulation::Audit audit;       ///< balance of energy [J] and momentum [N s] at the end
  simulation::Counts counts;     ///< numbers of fractures, contacts, steps and so on in the whole run
  std::vector<ShipPeaks> peaks;  ///< by number of the hull in the scene
  simulation::PeakCounts load_peaks;  ///< how many peaks contacts.csv has, and how many it leaves out
  /// Sentences for the user on what makes results doubtful or was not recorded; empty if there is nothing to say.
  std::vector<std::string> warnings;

  /// Returns the simulated seconds per second of wall time; 0 if the wall time is unknown.
  double real_time_factor() const { return wall_time > 0 ? sim_time / wall_time : 0; }
  /// Returns true if the balances of ice, energy and momentum close. If not, the run must not be trusted.
  bool accounts_close() const { return audit.is_closed() && areas.is_closed() && masses.is_closed(); }
};

/// Returns the shortest time step [s] that a run with this tick [s] took: the tick divided by the largest number of
/// parts of a tick. Before the first step it is the tick.
double shortest_step(const simulation::Counts& counts, double tick);

/// Returns the summary of a run that has ended, with its warnings. `stopped_by` is the reason if it was stopped, or
/// empty if it finished. `wall_time` [s] is that of the whole run.
RunSummary summarise(const simulation::Simulation& simulation, const RunWriter& writer, const std::string& stopped_by,
                     double wall_time);

/// Returns the text of summary.json. `scene` gives its name, seed, hash, time step and which terms of the balances are
/// written: those of wind, walls and moorings only if it has these.
std::string to_json_text(const RunSummary& summary, const LoadedScene& scene);

/// Returns the first member of a summary.json whose kind differs from the kind that this program writes, for example a
/// text instead of a number; nothing if there is none. Code that reads the summary needs no further checks of kinds.
/// Members may be missing, because older versions wrote fewer, and unknown members are ignored. `summary` is the root
/// of a text without JSON faults; `scene` that of the same run.
std::optional<JsonFault> fault_of_summary(const JsonValue& summary, const LoadedScene& scene);

/// End of a finished run.
struct FinishedRun {
  double time = 0;       ///< simulated time [s]
  double wall_time = 0;  ///< time by the clock that the whole run took [s]
};
/// Reads the end of a run from summary.json of its folder. Returns nothing if the run has not finished, or if the file
/// is missing or damaged. A time that the file lacks is 0.
std::optional<FinishedRun> finished_run(const std::filesystem::path& folder);

/// Returns the version of this program, "1.2.3", which every summary.json and checkpoint contains.
std::string_view version();

}  // namespace polynya::io
