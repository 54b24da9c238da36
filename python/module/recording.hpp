#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "io/run/run_loop.hpp"

namespace polynya::python {

/// The run folder of a simulation that Python steps: the files of `polynya run`. What goes wrong with the folder is
/// kept as a failure, since steps are taken without the GIL.
class Recording {
 public:
  /// Takes the folder and writes what there is before the first step. Raises FolderError.
  Recording(const io::LoadedScene& scene, simulation::Simulation& simulation, const std::filesystem::path& folder,
            bool overwrite);
  /// After each step; takes its journal.
  void take_step();
  const std::optional<std::string>& failure() const { return failure_; }
  /// Ends the run here, as one whose scene ends at `until` [s]; or stops it, where there is a reason. Raises
  /// FolderError.
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
