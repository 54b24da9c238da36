#pragma once

#include <memory>
#include <optional>
#include <string>

#include "browser/module/snapshot.hpp"
#include "io/run/run_loop.hpp"
#include "io/scene/scene_reader.hpp"

namespace polynya::browser {

/// State of a run after it was advanced.
enum class Progress {
  kRunning,
  kFinished,          ///< at the end of the scene
  kNumericalFailure,  ///< Session::words() has the message
  kFolderFailure,     ///< the page has no memory left for the run's files
};

/// Folder in the page's memory to which a run is written.
inline constexpr const char* kRunFolder = "/run";

/// A scene and its run, which the page holds.
class Session {
 public:
  /// Reads a scene. words() then has its problems and hints, the memory that it needs, and the data to show before it
  /// runs, as JSON. Returns false if the text is no valid scene; the previous scene is then kept.
  bool load(std::string text);
  /// Starts the run of the scene from its first step. Returns false, with a message in words(), if it cannot start.
  bool start();
  /// Steps until a time of the scene [s], but for at most `wall` seconds of real time.
  Progress advance(double until, double wall);
  /// Steps until a time [s], also beyond the end of the scene. Returns false if the run fails.
  bool advance_beyond(double until);
  /// Gives a ship a command that replaces that of its pilot. release() gives control back to the pilot.
  void steer(int ship, simulation::Command command);
  void release(int ship);
  /// Collects all changes since the last snapshot in columns(). words() has the numbers of the run as JSON.
  void take_snapshot();
  /// Ends the run now and completes its folder. `reason` is empty if the run has reached the end of the scene.
  bool finish(const std::string& reason);
  /// Reads the run back in the form of the player: words() has its words, columns() its numbers.
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
