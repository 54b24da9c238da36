#pragma once

#include <string>
#include <utility>

#include <tl/expected.hpp>

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

}  // namespace polynya::app
