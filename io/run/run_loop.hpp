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

/// A run that is in progress, with its folder. start_run() and resume_run() make it, and run_to_end() steps it.
struct ActiveRun {
  const LoadedScene& scene;           ///< must exist longer than this object
  simulation::Simulation simulation;  ///< state of the run, at time 0 or at a checkpoint
  RunWriter writer;                   ///< writes the folder, which it keeps locked
  double wall_time = 0;               ///< wall time of earlier parts of the run [s]
};

/// Returns the number of ticks of a whole run. The end of the scene is rounded up to a whole tick, except for an excess
/// of up to 1e-9 ticks, which is rounding. So a run may end up to a tick after `until` of its scene.
std::int64_t last_step_of(const simulation::StepSettings& time);

/// Starts a run: makes the simulation at time 0 and prepares the folder. Fails if the folder cannot be used. With
/// `overwrite`, an earlier run in the folder is replaced (claim_run_folder); without it, such a folder is refused and
/// unchanged.
Result<ActiveRun> start_run(const std::filesystem::path& folder, const LoadedScene& scene, bool overwrite = false);

/// Continues a run from a checkpoint, which is read from `file`. `lock` locks the run folder. Whatever the folder has
/// beyond the checkpoint is cut off (RunWriter::resume). The run goes to the end of `scene`, which may differ from the
/// former end of the run; nothing else may differ from the run's scene. Fails if the checkpoint is damaged, of another
/// run, or after that end, and if the folder is damaged.
Result<ActiveRun> resume_run(RunLock lock, const LoadedScene& scene, const std::filesystem::path& file);

/// Returns the simulation at a checkpoint. Fails if its state cannot be read, or if its number of steps or its hash is
/// not the one in the checkpoint.
Result<simulation::Simulation> simulation_at(const LoadedScene& scene, const Checkpoint& checkpoint);

/// Returns a checkpoint of a run between two steps. `progress` is the state of the folder (RunWriter::sync),
/// `wall_time` the wall time of the run so far [s]. The journal of the simulation must have been written to the folder
/// before, because the checkpoint does not contain it.
Checkpoint checkpoint_of(const simulation::Simulation& simulation, const LoadedScene& scene, RunProgress progress,
                         double wall_time);

/// Checks the whole simulation after a step: for numbers that are not finite, balances of energy or momentum that do
/// not close, and a state that contradicts itself. Returns a message for the first failure; nothing if there is none.
/// It takes long compared with a step. A run without RunControl::check looks only for numerical failures
/// (Simulation::numerical_failure): speeds that are not finite or beyond kRunawaySpeed, and overloads.
std::optional<std::string> failure_after_step(const simulation::Simulation& simulation);

/// Progress of a run, for display.
struct RunStatus {
  double time = 0;             ///< simulated time [s]
  std::int64_t fractures = 0;  ///< number of bends and splits so far (fractures_of)
};

/// Writes the folder of a run between its steps. run_to_end(), Python and the browser use it: begin() once, then after
/// each step record_step() and frame_if_due(), from time to time checkpoint(), and end() at last. A write that fails
/// shows in the result of checkpoint() and end() and in RunWriter::status().
class RunRecorder {
 public:
  /// `wall_time` is the wall time of the run before it was resumed [s]. All other arguments must exist longer than this
  /// object.
  RunRecorder(simulation::Simulation& simulation, RunWriter& writer, const LoadedScene& scene, double wall_time = 0);
  /// Records the initial state of a new run and its first frame. Call it once before the first step, and not for a run
  /// that was resumed (RunWriter::has_begun). `journal` is the journal of a simulation of the scene before its first
  /// step; it contains the floes of the scene, and is emptied.
  void begin(simulation::Journal& journal);
  /// Writes the journal of the last step and empties it. Call it after every step.
  void record_step() { writer_.record(simulation_.journal()); }
  /// Writes a frame if one is due at this tick (RecordSettings::frames_interval). Call it after every step.
  void frame_if_due() {
    if (is_frame_due()) writer_.frame(simulation_);
  }
  /// Writes a checkpoint of the run between two steps, after all files of the folder are on the disk. If it fails, the
  /// error names the file; the next attempt is due as after a success.
  Result<> checkpoint() { return checkpoint(wall_time()); }
  /// Writes a last checkpoint, and after it a last frame, unless one was due at the last tick and is written already. A
  /// run that is continued to a later end starts from the checkpoint, and so does not contain that extra frame. The
  /// checkpoint has the wall time 0, so that two folders of one run have the same bytes. If the checkpoint cannot be
  /// written, no frame is.
  Result<> end();
  /// Returns the wall time of the run so far, including the time before it was resumed [s].
  double wall_time() const { return wall_time_before_ + seconds_since(start_); }
  /// Wall time since the last checkpoint, or since this object was made [s].
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
  int threads = 1;  ///< number of threads, at least 1; results do not depend on it
  /// Simulated time between checkpoints [s], in addition to those by wall time; 0: none by simulated time.
  double checkpoint_every = 0;
  /// Wall time between checkpoints [s]; 0: none by wall time. A run that is killed loses at most about this much work.
  /// It is looked at after every 16th step. A smaller value costs time, because each checkpoint waits for the disk.
  double checkpoint_every_wall = 60;
  /// True: call failure_after_step() after every step, and stop at the first failure; slow. False: stop at numerical
  /// failures only, and check the balances at the end.
  bool check = false;
  /// Write final.geojson even if the scene has more than kMostFloesInFinal floes (run_folder.hpp).
  bool final_geojson = false;
  /// Called after every 16th step, except when a checkpoint is due then.
  std::function<void(const RunStatus&)> progress = {};
  /// Called after every step. If it returns a reason, such as a signal of the user, the run stops there, with a
  /// checkpoint from which it can be resumed.
  std::function<std::optional<std::string>()> stop = {};
};

/// How a run ended.
enum class RunEnd {
  kFinished,          ///< the end of the scene was reached
  kStopped,           ///< stopped by RunControl::stop
  kNumericalFailure,  ///< a speed that is not finite or too large, an overload, or a fault that RunControl::check found
  kFolderFailure,     ///< a file of the folder could not be written; takes precedence over the others at the end
};

/// How run_to_end() ended.
struct RunResult {
  RunEnd end = RunEnd::kFinished;
  std::string reason;  ///< reason for an end other than kFinished, in words; otherwise empty
  RunSummary summary;  ///< the contents of summary.json
  /// Result of writing a dump, failure.bin: the state before the first faulty step. It is written after a numerical
  /// failure, and after any other end if the balances of ice, energy or momentum do not close, unless the folder was
  /// displaced (RunWriter::is_displaced). Empty if none was to be written; a failure with its reason if it was to be,
  /// but could not.
  std::optional<Result<>> dump = {};
};

/// Steps a run to the end of its scene, or until something stops it, and writes its folder. docs/architecture.md shows
/// an example. Failures are in the result. Throws std::bad_alloc if memory runs out; the folder is then like that of a
/// killed run, and resume_run can continue it from the newest checkpoint.
RunResult run_to_end(ActiveRun& run, const RunControl& control = {});

}  // namespace polynya::io
