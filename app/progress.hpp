#pragma once

#include <chrono>
#include <string>

namespace polynya::app {

enum class ProgressKind {
  kAuto,  ///< a bar on a terminal, else a line now and then
  kBar,   ///< where stderr is a terminal, else kLines
  kLines,
  kJson,  ///< one object a second on stderr
  kNone,
};

/// One report of how far some work is, in each of its forms.
struct ProgressReport {
  double part = 0;  ///< done, 0..1
  std::string
      beside_bar;  ///< follows the bar on its line: ASCII, fields two blanks apart, the important ones first
  std::string line;  ///< without its newline
  std::string json;  ///< one object, without its newline
};

/// Prints reports on stderr, at the pace of their kind.
class ProgressOutput {
 public:
  explicit ProgressOutput(ProgressKind kind);

  /// Whether it is time for a report; cheap to call often.
  bool is_due();
  void show(const ProgressReport& report) const;
  /// The last report: completes a bar, or is one object more.
  void finish(const ProgressReport& report) const;

  double wall_time() const;  ///< since construction [s]

 private:
  ProgressKind kind_;
  std::chrono::steady_clock::time_point start_;
  double last_shown_ = 0;  ///< wall time [s]
};

/// "1:05", "2:03:04".
std::string clock_time(double seconds);

/// Prints on stderr how far a run is.
class Progress {
 public:
  Progress(ProgressKind kind, double until) : output_(kind), until_(until) {}

  /// Cheap to call often.
  void show(double sim_time, long long fractures) {
    if (output_.is_due()) output_.show(report(sim_time, fractures));
  }
  /// Clears or completes what is shown.
  void finish(double sim_time, long long fractures) { output_.finish(report(sim_time, fractures)); }

  double wall_time() const { return output_.wall_time(); }  ///< since construction [s]

 private:
  ProgressReport report(double sim_time, long long fractures) const;
  ProgressOutput output_;
  double until_;  ///< [s]
};

}  // namespace polynya::app
