#pragma once

#include <chrono>

namespace polynya::app {

enum class ProgressKind {
  kAuto,  ///< a bar on a terminal, else a quiet line now and then
  kBar,
  kLines,
  kJson,  ///< one object a second on stderr
  kNone,
};

/// Tells on stderr how far a run is.
class Progress {
 public:
  Progress(ProgressKind kind, double until);

  /// Cheap to call often: it looks at the clock and mostly returns.
  void show(double sim_time, long long fractures);
  /// Clears or completes what is shown.
  void finish(double sim_time, long long fractures);

  double wall_time() const;  ///< since construction [s]

 private:
  void draw(double sim_time, long long fractures);
  ProgressKind kind_;
  double until_;  ///< [s]
  std::chrono::steady_clock::time_point start_;
  double last_shown_ = 0;  ///< wall time [s]
  bool is_bar_drawn_ = false;
};

}  // namespace polynya::app
