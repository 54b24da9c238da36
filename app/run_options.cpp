#include "app/run_options.hpp"

#include "app/options.hpp"

namespace polynya::app {

void add_run_options(CLI::App& command, DriverOptions& options) {
  option(command, "--threads", options.threads, "N", "Threads to step on; results do not depend on it",
         CLI::Range(1, 1024));
  option(command, "--checkpoint-every", options.checkpoint_every, "S",
         "Simulated time between checkpoints, beside those by the clock [s]", between(1e-5, 1e7));
  option(command, "--checkpoint-every-wall", options.checkpoint_every_wall, "S",
         "Time by the clock between checkpoints, 60 if not given; 0: none by the clock [s]", between(0, 1e7));
  command.add_flag("--check", options.check,
                   "Recompute every cross-index and sum after every step; stop if one differs");
  add_progress(command, options.progress);
}

}  // namespace polynya::app
