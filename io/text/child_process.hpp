#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/text/source_text.hpp"

namespace polynya::io {

/// Output of a program that has ended, with or without success.
struct ChildOutput {
  std::string out;  ///< bytes that it wrote to stdout, which need not be text
  std::string err;  ///< bytes that it wrote to stderr
  int code = 0;     ///< exit code; 128 + the signal's number if a signal ended the program, as in a shell
};

/// Reason why there is no output of a program.
struct ChildFailure {
  /// True if the program is not on the search path or cannot be started, so that the user must install it. False if it
  /// ran, but its text could not be passed on.
  bool is_missing = false;
  std::string words;  ///< the reason for the user, without a full stop, usually with the name of the program
};

/// Runs a program without a shell, so that no character of its arguments has a special meaning, and waits until it
/// ends. `words` are its name, which is looked up on the search path, and its arguments; there must be a name. `input`
/// is given to it as stdin. Returns its output, also if its exit code is not 0, so the caller must check the code.
/// Fails if the program cannot be started (or has the exit code 127, as of a missing program), if it wrote more than
/// `longest` bytes to stdout or to stderr, or if there is no room for the temporary files through which the text goes.
/// Output that is too long is only refused after the program has ended, so `longest` limits memory, not the disk. There
/// is no limit of time. In the browser and in a Windows build of the co-simulation unit, it always fails.
tl::expected<ChildOutput, ChildFailure> run_child(const std::vector<std::string>& words, std::size_t longest,
                                                  std::string_view input = {});

}  // namespace polynya::io
