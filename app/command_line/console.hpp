#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tl/expected.hpp>

#include "io/run/run_reader.hpp"
#include "io/text/problem.hpp"
#include "io/text/source_text.hpp"

namespace polynya::app {

/// What `polynya` returns to the shell.
enum ExitCode {
  kDone = 0,
  kUsage = 2,             ///< the command line is wrong
  kSceneInvalid = 3,      ///< the scene is wrong; nothing was written
  kNumericalFailure = 4,  ///< the numbers stopped being numbers; the folder holds the run up to there
  kOutOfMemory = 4,       ///< memory ran out; a run folder is as one of a run that was killed
  kRefused = 4,           ///< geometry was refused or found wrong; the rest was done
  kInputOutput = 5,       ///< a file, stdout or stderr could not be read or written
  kDefect = 70,           ///< polynya itself is wrong; the traceback of a command in Python is in a file
  kStopped = 75,          ///< stopped on a signal; the folder has a checkpoint to resume from
  kClosedPipe = 141,      ///< the reader of stdout or stderr went away, as a shell reports SIGPIPE
};

// Every text of the program goes through here. A text that could not be written never ends in exit code 0; fmt::print
// and std::cout are not used, since the one throws and the other forgets where stdout is a closed pipe or a full disk.

/// Opens what is closed of descriptors 0, 1 and 2, or the first files of a run would get them. Reading from
/// stdin and writing to stdout and stderr fail then. Makes writing to a closed pipe, or past a file size
/// limit, an error instead of a signal.
void open_streams();

/// Writes to stdout.
void write_out(std::string_view text);
template <typename... Args>
void print_out(fmt::format_string<Args...> format, Args&&... args) {
  write_out(fmt::format(format, std::forward<Args>(args)...));
}

/// Writes what is buffered for stdout: before another program writes there.
void flush_out();

/// Writes a message to stderr, after what went to stdout before.
void write_err(std::string_view text);
template <typename... Args>
void print_err(fmt::format_string<Args...> format, Args&&... args) {
  write_err(fmt::format(format, std::forward<Args>(args)...));
}

/// Problems, or a scene's warnings and hints, on stderr, a line each.
void print_lines(const std::vector<io::Problem>& problems);

using io::counted;

/// "polynya: " and the message on stderr; returns the code.
ExitCode fail(ExitCode code, std::string_view message);

/// What a part of a command came to, or the code that the command ends with, whose message is on stderr by then.
template <class Value>
using Outcome = tl::expected<Value, ExitCode>;
inline tl::unexpected<ExitCode> failure(ExitCode code, std::string_view message) {
  return tl::unexpected(fail(code, message));
}

/// Shows how far some work is, on stderr. It may be lost.
void show_progress(std::string_view text);

/// Writes what is buffered and reports on stderr what could not be written. Returns the exit code: `code` if
/// it is not 0 or all was written; kClosedPipe, without a message, where only a closed pipe kept text from
/// being written; else kInputOutput.
int close_streams(int code);

/// From now on SIGINT, SIGTERM and SIGHUP only ask to stop (a second one ends the program at once), and a
/// write past a size limit or into a closed pipe is an error where it happens, not a signal.
void watch_signals();

/// The signal that asked to stop, or 0.
int stop_signal();

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

/// The whole of a file, or of stdin where its name is "-", or what is wrong with it in words. What is longer
/// than `longest` bytes is refused, and a named pipe, but for those that the shell makes (`<(command)`).
tl::expected<std::string, std::string> read_input(const std::string& file, std::size_t longest);

/// What an input is called in messages: the file's name, or "stdin".
std::string input_name(const std::string& file);

/// A run's folder, with its progress on stderr (io/run/run_reader.hpp).
io::Result<io::Run> read_run(const std::string& folder, ProgressKind progress);

/// Whether the name means the program's own stdout: "-", "/dev/stdout", or the file that stdout goes to.
bool is_stdout(const std::string& file);

/// Writes to a name that a user gave: to a file, or into a pipe, a device or the program's own stdout or
/// stderr, whose failures close_streams() reports.
io::Result<> write_output(const std::string& file, const std::string& text);

/// Makes a folder that a user named, with those above it.
io::Result<> make_folder(const std::filesystem::path& folder);

/// Writes what a command makes of a run: into the folder `out` that a user named, which is made where it is
/// missing, or where that is empty into the run's, where links are not followed.
io::Result<> write_product(const std::string& out, const std::string& run, std::string_view name,
                           const std::string& text);

}  // namespace polynya::app
