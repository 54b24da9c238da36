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

/// Exit codes of `polynya`, which scripts and tests rely on. The three causes of code 4 differ only in their messages.
enum ExitCode {
  kDone = 0,              ///< everything was done
  kUsage = 2,             ///< the command line is wrong
  kSceneInvalid = 3,      ///< the scene is wrong; nothing was written
  kNumericalFailure = 4,  ///< numbers became infinite or not a number; the folder has the run up to then
  kOutOfMemory = 4,       ///< memory ran out or would not suffice; a run that had begun is left like a killed one
  kRefused = 4,           ///< a shape was refused, or a check found a fault; everything else was done
  kInputOutput = 5,       ///< a file, stdout or stderr could not be read or written
  kDefect = 70,       ///< an error in Polynya itself, used by the commands in Python, which write a traceback to a file
  kStopped = 75,      ///< stopped by a signal; the folder has a checkpoint from which the run can be resumed
  kClosedPipe = 141,  ///< the reader of stdout or stderr has ended; shells report SIGPIPE by this code
};

// All text of the program is written by the functions below. If a text could not be written, the exit code is never 0.
// fmt::print and std::cout are not used: on a closed pipe or a full disk the first throws and the second loses the
// error.

/// Opens descriptors 0, 1 and 2 if they are closed, because otherwise the first files of a run would get these numbers.
/// Reading and writing such a stream then fails. Writing to a closed pipe, or beyond a limit of the file size, becomes
/// an error instead of a signal.
void open_streams();

/// Writes to stdout, through its buffer. A failure is stored for close_streams(); the caller does not see it.
void write_out(std::string_view text);
/// Formats as fmt::format() does, and writes the text as write_out() does. print_err() is the same for stderr.
template <typename... Args>
void print_out(fmt::format_string<Args...> format, Args&&... args) {
  write_out(fmt::format(format, std::forward<Args>(args)...));
}

/// Writes the buffer of stdout. Call it before another program writes there.
void flush_out();

/// Writes a message to stderr, after all text that was written to stdout before, so that a terminal shows both in
/// order. A failure is stored for close_streams().
void write_err(std::string_view text);
template <typename... Args>
void print_err(fmt::format_string<Args...> format, Args&&... args) {
  write_err(fmt::format(format, std::forward<Args>(args)...));
}

/// Writes problems to stderr, one per line, in the words of io::to_string(): errors, warnings and hints of a scene.
void print_lines(const std::vector<io::Problem>& problems);

using io::counted;  // "1 floe", "2 floes"

/// Writes "polynya: " and a message to stderr; returns the code.
ExitCode fail(ExitCode code, std::string_view message);

/// Result of a part of a command, or the exit code after its message has been written to stderr.
template <class Value>
using Outcome = tl::expected<Value, ExitCode>;
/// Writes a message as fail() does, and returns the failure of an Outcome.
inline tl::unexpected<ExitCode> failure(ExitCode code, std::string_view message) {
  return tl::unexpected(fail(code, message));
}

/// Writes progress to stderr at once. An error is ignored and does not change the exit code.
void show_progress(std::string_view text);

/// Writes the buffers, closes stdout and reports on stderr if not all text could be written to stdout. Call it last.
/// Returns the exit code of the program: `code` if it is not 0 or if everything was written; kClosedPipe, without a
/// message, if only a closed pipe prevented writing; otherwise kInputOutput.
int close_streams(int code);

/// Makes SIGINT, SIGTERM and SIGHUP only ask to stop from now on, so that a run can write a checkpoint first. A second
/// signal of the same kind ends the program at once. A signal that the parent process ignores, as under nohup, stays
/// ignored.
void watch_signals();

/// Returns the number of the last signal that asked to stop, or 0. Long commands ask for it between their steps. It is
/// never reset.
int stop_signal();

/// How progress is shown on stderr.
enum class ProgressKind {
  kAuto,   ///< the same as kBar
  kBar,    ///< a bar that is renewed ten times a second; kLines if stderr is no terminal, or TERM is "dumb"
  kLines,  ///< a line every ten seconds
  kJson,   ///< a line with a JSON object every second
  kNone,   ///< nothing
};

/// A report of progress in all its forms.
struct ProgressReport {
  double part = 0;  ///< completed fraction, 0..1; negative if it is not known: then there is no bar, only the text
  /// Text of a line, or of the field after the bar: ASCII, fields separated by two blanks, important fields first.
  /// Fields at the end that do not fit into the width of the terminal are left out.
  std::string words;
  std::string json;  ///< one JSON object without a line break, for kJson
};

/// Prints reports on stderr, as often as their kind requires.
class ProgressOutput {
 public:
  explicit ProgressOutput(ProgressKind kind);

  /// Returns true if pause() has passed since it last returned true, or since construction; always false for kNone. It
  /// costs little to call often.
  bool is_due();
  /// Writes a report now, whether it is due or not. Ask is_due() first, also because kNone would be shown as a bar.
  void show(const ProgressReport& report) const;
  /// Removes the bar from the terminal; other kinds do nothing.
  void clear() const;
  /// Wall time between two reports [s]: 0.1 for a bar, so that it moves smoothly, 10 for lines, so that a log stays
  /// short, and 1 for JSON.
  double pause() const;
  ProgressKind kind() const { return kind_; }  ///< the kind that is shown: never kAuto
  /// Shows the last report: it completes a bar and ends its line, or is another JSON object. Lines do not show it,
  /// because the command's result follows.
  void finish(const ProgressReport& report) const;

  double wall_time() const;  ///< time since construction [s]

 private:
  ProgressKind kind_;
  std::chrono::steady_clock::time_point start_;
  double last_shown_ = 0;  ///< wall_time() at which is_due() last returned true [s]
};

/// Shows on stderr, from its own thread, that work is in progress, with its wall time and the completed fraction if it
/// is known. Nothing is shown for the first 2 s (lines: 10 s), so short work shows nothing. The destructor ends it and
/// removes a bar, so that messages start on a new line. If the system refuses a thread, no progress is shown.
class WorkProgress {
 public:
  /// `work` describes the work: "reading the run". It must not need escaping in JSON.
  WorkProgress(ProgressKind kind, std::string work);
  WorkProgress(const WorkProgress&) = delete;
  WorkProgress& operator=(const WorkProgress&) = delete;
  ~WorkProgress();

  void set_part(double part) { part_ = part; }  ///< completed fraction, 0..1; any thread may call it

 private:
  void show_until(const std::stop_token& stop);  ///< what the thread does: shows reports until it is asked to stop
  ProgressReport report() const;                 ///< the work, its wall time and its completed fraction

  ProgressOutput output_;
  std::string work_;
  std::atomic<double> part_ = -1;  ///< completed fraction; negative: not known
  std::mutex mutex_;
  std::condition_variable_any ended_;
  std::jthread thread_;  ///< must be the last member, because the thread uses the others
};

/// Does work and shows its progress by WorkProgress. Returns the result of `work`, which may take the WorkProgress& to
/// set the completed fraction.
template <class Work>
auto with_progress(ProgressKind kind, std::string name, Work work) {
  WorkProgress progress(kind, std::move(name));
  if constexpr (std::is_invocable_v<Work, WorkProgress&>)
    return work(progress);
  else
    return work();
}

/// Returns a duration [s], rounded to seconds, as "1:05", or from an hour on as "2:03:04".
std::string clock_time(double seconds);

/// Returns the contents of a file, or of stdin if its name is "-". Fails with a message, without the file's name, if it
/// cannot be read or is longer than `longest` [bytes]. Named pipes are refused, because a pipe without a writer would
/// block forever, except those that the shell makes for `<(command)`.
tl::expected<std::string, std::string> read_input(const std::string& file, std::size_t longest);

/// Returns the name of an input for messages: the file's name, or "stdin".
std::string input_name(const std::string& file);

/// Reads a run folder with progress on stderr. Fails as io::read_run() does (io/run/run_reader.hpp).
io::Result<io::Run> read_run(const std::string& folder, ProgressKind progress);

/// Returns true if the name means the program's stdout: "-", "/dev/stdout", or the file to which stdout is written.
/// Callers then write their words about it to stderr, so that they are not mixed with the data.
bool is_stdout(const std::string& file);

/// Writes to a name that a user gave: a file, a pipe, a device, or the program's own stdout or stderr, whose failures
/// close_streams() reports. An existing file is replaced, and a link is followed. Fails with a message that names the
/// file.
io::Result<> write_output(const std::string& file, const std::string& text);

/// Creates a folder that a user named, with the folders above it. It is no error if it exists. Fails with a message
/// that names it, for example if a file of that name exists.
io::Result<> make_folder(const std::filesystem::path& folder);

/// Writes a file `name` that a command makes from the run in the folder `run`. It is written into the folder `out`,
/// which is created if necessary, by write_output(); if `out` is empty, into the run's folder. There a symbolic link of
/// that name is replaced, not followed, because a run folder may come from somebody else. An existing file is replaced
/// in both. Fails with a message that names the file, also if the folder could not be created.
io::Result<> write_product(const std::string& out, const std::string& run, std::string_view name,
                           const std::string& text);

}  // namespace polynya::app
