#pragma once

#include "app/progress.hpp"

namespace CLI {
class App;
}

namespace polynya::app {

/// How a run is driven, whether it starts or is resumed.
struct DriverOptions {
  int threads = 1;
  double checkpoint_every = 0;        ///< simulated time between checkpoints [s]; 0: by the clock alone
  double checkpoint_every_wall = 60;  ///< and by the clock [s]; 0: never by it
  bool check = false;                 ///< recompute every cross-index and sum of the world after every step
  ProgressKind progress = ProgressKind::kAuto;
};
void add_run_options(CLI::App& command, DriverOptions& options);

}  // namespace polynya::app
