#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tl/expected.hpp>

#include "io/text/problem.hpp"

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

/// Why a command ends: its exit code, and the message, which is still to be printed.
struct Failure {
  ExitCode code;
  std::string words;
};
template <class Value>
using Outcome = tl::expected<Value, Failure>;

inline tl::unexpected<Failure> failure(ExitCode code, std::string words) {
  return tl::unexpected(Failure{code, std::move(words)});
}

// Every text of the program goes through here. A text that could not be written never ends in exit code 0;
// fmt::print and std::cout are not used, since the one throws and the other forgets where stdout is a closed
// pipe or a full disk.

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

/// The code that a command ends with; a failure's message goes to stderr.
ExitCode code_of(const Outcome<ExitCode>& outcome);

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

}  // namespace polynya::app
