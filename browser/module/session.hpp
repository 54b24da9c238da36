#pragma once

#include <memory>
#include <optional>
#include <string>

#include "browser/module/snapshot.hpp"
#include "io/run/run_loop.hpp"
#include "io/scene/scene_reader.hpp"

namespace polynya::browser {

/// How a run stands after it was advanced.
enum class Progress {
  kRunning,
  kFinished,          ///< at the end of the scene
  kNumericalFailure,  ///< Session::words() says what it was
  kFolderFailure,     ///< the page has no room for the run's files
};

/// The folder in the page's memory that a run writes.
inline constexpr const char* kRunFolder = "/run";

/// One scene and its run, which the page holds.
class Session {
 public:
  /// Reads a scene. words() has its problems and hints, the memory that it takes and what is shown before it runs, as
  /// JSON. Returns false where it is no scene; what was there before is then kept.
  bool load(std::string text);
  /// Starts the run of the scene from its first step. Returns false, with words(), where it cannot.
  bool start();
  /// Steps until a time of the scene [s], and stops earlier where `wall` [s] have passed.
  Progress advance(double until, double wall);
  /// Steps until a time of the scene [s], also behind its end. Returns false where the run fails.
  bool advance_beyond(double until);
  /// Gives a ship an order in the place of its pilot's.
  void steer(int ship, simulation::Command command);
  void release(int ship);
  /// What changed since the last snapshot; words() has the numbers of the run as JSON.
  void take_snapshot();
  /// Ends the run where it is, so that its folder is complete. An empty reason: it has come to the scene's end.
  bool finish(const std::string& reason);
  /// The run as the player reads it: words() has its words, columns() its numbers.
  bool read_back();

  std::string state_hash() const;
  const std::string& words() const { return words_; }
  const std::string& columns() const { return columns_; }
  bool has_run() const { return run_.has_value(); }

 private:
  bool step();
  std::optional<io::LoadedScene> scene_;
  std::optional<io::ActiveRun> run_;
  std::unique_ptr<io::RunRecorder> recorder_;
  SnapshotMaker snapshot_;
  Progress progress_ = Progress::kRunning;
  std::string words_;
  std::string columns_;
};

}  // namespace polynya::browser
