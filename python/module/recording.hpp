#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "io/run/run_loop.hpp"

namespace polynya::python {

/// The run folder of a simulation that Python steps, with the files of `polynya run`. An error in the folder is stored
/// as a failure, because steps are taken without the GIL.
class Recording {
 public:
  /// Creates the folder and writes the state before the first step. Raises FolderError.
  Recording(const io::LoadedScene& scene, simulation::Simulation& simulation, const std::filesystem::path& folder,
            bool overwrite);
  /// Records a step and empties its journal. Call it after each step.
  void take_step();
  const std::optional<std::string>& failure() const { return failure_; }
  /// Ends the run now, as if its scene ended at `until` [s]; or stops it, if a reason is given. Raises FolderError.
  void end(double until, const std::string& stopped_by);

 private:
  void keep(const io::Result<>& result);
  std::unique_ptr<io::LoadedScene> scene_;
  simulation::Simulation& simulation_;
  io::RunWriter writer_;
  io::RunRecorder recorder_;
  std::optional<std::string> failure_;
};

}  // namespace polynya::python
