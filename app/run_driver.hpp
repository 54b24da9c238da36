#pragma once

#include "app/exit_code.hpp"
#include "app/run_options.hpp"
#include "io/run/active_run.hpp"

namespace polynya::app {

/// Takes a run to its end, or to what stops it (io/run/run_loop.hpp), and prints the result.
ExitCode drive_run(io::ActiveRun run, const DriverOptions& options);

}  // namespace polynya::app
