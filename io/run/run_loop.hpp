#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "io/run/checkpoint.hpp"
#include "io/run/run_writer.hpp"
#include "io/run/summary.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/source_text.hpp"
#include "simulation/simulation.hpp"

namespace polynya::io {

/// A run that is in progress, with its folder.
struct ActiveRun {
  const LoadedScene& scene;  ///< must exist longer than this object
  simulation::Simulation simulation;
  RunWriter writer;
  double wall_time = 0;  ///< wall time of earlier parts of the run [s]
};

/// Returns the last tick of a run. The end of the scene is rounded up to a whole tick.
std::int64_t last_step_of(const simulation::StepSettings& time);

/// Starts a run: prepares its folder before the first step. Fails if the folder cannot be used (RunWriter::create).
Result<ActiveRun> start_run(const std::filesystem::path& folder, const LoadedScene& scene, bool overwrite = false);

/// Continues a run from a checkpoint of its folder, which is read from `file`. Whatever the folder has beyond the
/// checkpoint is cut off (RunWriter::resume). The run goes to the scene's end, which may differ from its former end.
Result<ActiveRun> resume_run(RunLock lock, const LoadedScene& scene, const std::filesystem::path& file);

/// Returns the simulation at a checkpoint, after comparing its hash with the one in the checkpoint.
Result<simulation::Simulation> simulation_at(const LoadedScene& scene, const Checkpoint& checkpoint);

/// Returns a checkpoint of a run between two steps. The journal of the simulation must have been written.
Checkpoint checkpoint_of(const simulation::Simulation& simulation, const LoadedScene& scene, RunProgress progress,
                         double wall_time);

/// Looks for a failure after a step: numbers that are not finite, balances that do not close, a state that contradicts
/// itself. Returns a message, or nothing if there is none.
std::optional<std::string> failure_after_step(const simulation::Simulation& simulation);

/// Progress of a run.
struct RunStatus {
  double time = 0;             ///< simulated time [s]
  std::int64_t fractures = 0;  ///< bends, splits and rejected cuts
};

/// Writes the folder of a run between its steps. Both run_to_end() and Python's stepping use it.
class RunRecorder {
 public:
  /// `wall_time` is that of earlier parts of the run [s].
  RunRecorder(simulation::Simulation& simulation, RunWriter& writer, const LoadedScene& scene, double wall_time = 0);
  /// Call it after the constructor. Before the first step of a run it records the initial state and a first frame.
  void begin(simulation::Journal& journal);
  void record_step() { writer_.record(simulation_.journal()); }
  void frame_if_due() {
    if (is_frame_due()) writer_.frame(simulation_);
  }
  Result<> checkpoint() { return checkpoint(wall_time()); }
  /// Writes a last checkpoint, and then a frame if none is due at the end. A run that is continued to a later end
  /// starts from the checkpoint, and so does not contain that extra frame.
  Result<> end();
  /// Returns the wall time of the run so far, with earlier parts [s].
  double wall_time() const { return wall_time_before_ + seconds_since(start_); }
  /// Wall time since the last checkpoint [s].
  double checkpoint_age() const { return seconds_since(last_checkpoint_); }

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds_since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
  }
  Result<> checkpoint(double wall_time);
  bool is_frame_due() const;
  simulation::Simulation& simulation_;
  RunWriter& writer_;
  const LoadedScene& scene_;
  double wall_time_before_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_checkpoint_ = start_;
};

/// Settings of run_to_end().
struct RunControl {
  int threads = 1;                    ///< number of threads; results do not depend on it
  double checkpoint_every = 0;        ///< simulated time between checkpoints [s]; 0: only by wall time
  double checkpoint_every_wall = 60;  ///< wall time between checkpoints [s]; 0: only by simulated time
  bool check = false;                 ///< check the whole state, and compute its sums again, after every step; slow
  /// Write final.geojson even if the scene has more than kMostFloesInFinal floes (run_folder.hpp).
  bool final_geojson = false;
  /// Called after every 16th step.
  std::function<void(const RunStatus&)> progress = {};
  /// Called after every step. If it returns a reason, the run stops there, with a checkpoint from which it can be
  /// resumed.
  std::function<std::optional<std::string>()> stop = {};
};

enum class RunEnd {
  kFinished,
  kStopped,           ///< stopped by RunControl::stop
  kNumericalFailure,  ///< numbers that are not finite, or a fault found by RunControl::check
  kFolderFailure,     ///< a file of the folder could not be written
};

/// How run_to_end() ended.
struct RunResult {
  RunEnd end = RunEnd::kFinished;
  std::string reason;  ///< reason for an end other than kFinished
  RunSummary summary;  ///< the contents of summary.json
  /// After a numerical failure, the state before the first faulty step is written to a dump. This is whether writing it
  /// succeeded; empty if no dump was to be written.
  std::optional<Result<>> dump = {};
};

/// Steps a run to the end of its scene, or until something stops it, and writes its folder. docs/architecture.md shows
/// an example. Throws std::bad_alloc if memory runs out; the folder is then like that of a killed run, and resume_run
/// can continue it from the newest checkpoint.
RunResult run_to_end(ActiveRun& run, const RunControl& control = {});

}  // namespace polynya::io
