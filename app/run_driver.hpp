#pragma once

#include <filesystem>
#include <string>

#include "app/command_line.hpp"
#include "app/exit_code.hpp"
#include "app/progress.hpp"
#include "io/run/active_run.hpp"
#include "io/run/run_loop.hpp"

namespace polynya::app {

/// The map of a run's last frame.
struct DrawnMap {
  std::string name;                        ///< of the picture in the folder; empty where none was drawn
  io::RunEnd end = io::RunEnd::kFinished;  ///< or kFolderFailure
  std::string reason = {};                 ///< of another end
};

/// Draws it into the run's folder; only notes it where the folder is too large to be read back.
DrawnMap draw_map(const std::filesystem::path& folder);

ExitCode exit_code_of(io::RunEnd end);

/// How a run is driven, whether it starts or is resumed.
struct DriverOptions {
  io::RunControl control;
  ProgressKind progress = ProgressKind::kAuto;
  bool no_map = false;  ///< leave out the picture of the end
};
void add_run_options(CommandLine& command, DriverOptions& options);

/// Takes a run to its end, or to what stops it (io/run/run_loop.hpp), and prints the result.
ExitCode drive_run(io::ActiveRun run, const DriverOptions& options);

}  // namespace polynya::app
