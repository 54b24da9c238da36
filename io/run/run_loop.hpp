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

/// A run somewhere between its start and its end, and its folder.
struct ActiveRun {
  const LoadedScene& scene;  ///< outlives this
  simulation::Simulation simulation;
  RunWriter writer;
  double wall_time = 0;  ///< that it has taken before [s]
};

/// The tick that a run ends with: its end is rounded up to a whole tick.
std::int64_t last_step_of(const simulation::StepSettings& time);

/// A run before its first step. The error is what is wrong with the folder (RunWriter::create).
Result<ActiveRun> start_run(const std::filesystem::path& folder, const LoadedScene& scene, bool overwrite = false);

/// A run at a checkpoint of its folder, read from `file`: the folder is cut back to it (RunWriter::resume), and
/// becomes that of a run to the scene's end, which may be another than it had.
Result<ActiveRun> resume_run(RunLock lock, const LoadedScene& scene, const std::filesystem::path& file);

/// The simulation of a checkpoint, checked against the hash it was saved with.
Result<simulation::Simulation> simulation_at(const LoadedScene& scene, const Checkpoint& checkpoint);

/// Where a run stands between two steps, its journal having been written.
Checkpoint checkpoint_of(const simulation::Simulation& simulation, const LoadedScene& scene, RunProgress progress,
                         double wall_time);

/// What is wrong with a run after a step: numbers that are none, accounts that do not close, a world that
/// contradicts itself. Nothing where all is well.
std::optional<std::string> failure_after_step(const simulation::Simulation& simulation);

/// How far a run is.
struct RunStatus {
  double time = 0;             ///< simulated [s]
  std::int64_t fractures = 0;  ///< bends, splits and rejected cuts
};

/// What is written of a run between its steps, whoever takes them: run_to_end(), or Python.
class RunRecorder {
 public:
  /// `wall_time` has been taken before [s].
  RunRecorder(simulation::Simulation& simulation, RunWriter& writer, const LoadedScene& scene, double wall_time = 0);
  /// Where nothing has been stepped yet: what there is, and a first frame.
  void begin(simulation::Journal& journal);
  void record_step() { writer_.record(simulation_.journal()); }
  void frame_if_due() {
    if (is_frame_due()) writer_.frame(simulation_);
  }
  Result<> checkpoint() { return checkpoint(wall_time()); }
  /// At the end: a checkpoint, and behind it a frame where none was due. A longer run goes on from the checkpoint,
  /// without the frame that only this end has.
  Result<> end();
  double wall_time() const { return wall_time_before_ + seconds_since(start_); }  ///< of the run so far [s]
  double checkpoint_age() const { return seconds_since(last_checkpoint_); }       ///< by the clock [s]

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

/// How a run is carried to its end.
struct RunControl {
  int threads = 1;                    ///< results do not depend on it
  double checkpoint_every = 0;        ///< simulated time between checkpoints [s]; 0: by the clock alone
  double checkpoint_every_wall = 60;  ///< and by the clock [s]; 0: never by it
  bool check = false;                 ///< validate all of the world, and derive its sums again, after every step
  bool final_geojson = false;         ///< also of a scene of more than kMostFloesInFinal floes (run_folder.hpp)
  /// Called every 16th step.
  std::function<void(const RunStatus&)> progress = {};
  /// Called after every step: a reason stops the run there, with a checkpoint to resume from.
  std::function<std::optional<std::string>()> stop = {};
};

enum class RunEnd {
  kFinished,
  kStopped,           ///< by RunControl::stop
  kNumericalFailure,  ///< numbers that are none, or what RunControl::check found
  kFolderFailure,     ///< a file of the folder could not be written
};

struct RunResult {
  RunEnd end = RunEnd::kFinished;
  std::string reason;  ///< of any other end
  RunSummary summary;  ///< as in summary.json
  /// Where a failure was to be dumped, the state before the first step after which something is wrong: whether that
  /// went well.
  std::optional<Result<>> dump = {};
};

/// Steps a run to the end of its scene, or to what stops it, and writes its folder; docs/architecture.md
/// shows an example. Throws std::bad_alloc where memory runs out: the folder is then that of a run that was
/// killed, which resume_run continues from its newest checkpoint.
RunResult run_to_end(ActiveRun& run, const RunControl& control = {});

}  // namespace polynya::io
