#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

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
  double part = 0;    ///< done, 0..1; negative where that is not known
  std::string words;  ///< a line, or behind the bar: ASCII, fields two blanks apart, the important ones first
  std::string json;   ///< one object, without its newline
};

/// Prints reports on stderr, at the pace of their kind.
class ProgressOutput {
 public:
  explicit ProgressOutput(ProgressKind kind);

  /// Whether it is time for a report; cheap to call often.
  bool is_due();
  void show(const ProgressReport& report) const;
  /// Takes a bar away.
  void clear() const;
  double pause() const;  ///< between two reports [s]
  ProgressKind kind() const { return kind_; }
  /// The last report: completes a bar, or is one object more.
  void finish(const ProgressReport& report) const;

  double wall_time() const;  ///< since construction [s]

 private:
  ProgressKind kind_;
  std::chrono::steady_clock::time_point start_;
  double last_shown_ = 0;  ///< wall time [s]
};

/// Shows on stderr, from a thread of its own, that some work goes on: from its third second on (lines: from
/// the tenth), with how much is done where that is known. A bar is cleared when the work ends, so that
/// messages stand on lines of their own.
class WorkProgress {
 public:
  /// `work` is what is done: "reading the run".
  WorkProgress(ProgressKind kind, std::string work);
  WorkProgress(const WorkProgress&) = delete;
  WorkProgress& operator=(const WorkProgress&) = delete;
  ~WorkProgress();

  void set_part(double part) { part_ = part; }  ///< done, 0..1

 private:
  void show_until(const std::stop_token& stop);
  ProgressReport report() const;

  ProgressOutput output_;
  std::string work_;
  std::atomic<double> part_ = -1;
  std::mutex mutex_;
  std::condition_variable_any ended_;
  std::jthread thread_;  ///< the last member: it uses the others
};

/// What `work` returns, with its progress shown while it goes on.
template <class Work>
auto with_progress(ProgressKind kind, std::string name, Work work) {
  WorkProgress progress(kind, std::move(name));
  if constexpr (std::is_invocable_v<Work, WorkProgress&>)
    return work(progress);
  else
    return work();
}

/// "1:05", "2:03:04".
std::string clock_time(double seconds);

}  // namespace polynya::app
