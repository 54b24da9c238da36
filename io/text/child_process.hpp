#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/text/source_text.hpp"

namespace polynya::io {

/// Output of a program that has ended, with or without success.
struct ChildOutput {
  std::string out;  ///< bytes that it wrote to stdout
  std::string err;  ///< bytes that it wrote to stderr
  int code = 0;     ///< exit code; 128 + the signal's number if a signal ended the program, as in a shell
};

/// Reason why there is no output of a program.
struct ChildFailure {
  /// True if the program is not on the search path or cannot be started; it must then be installed.
  bool is_missing = false;
  std::string words;  ///< the reason for the user, usually with the name of the program
};

/// Runs a program without a shell, so that no character of its arguments has a special meaning, and waits until it
/// ends. `words` are its name, which is looked up on the search path, and its arguments. `input` is given to it as
/// stdin. Returns its output, also if its exit code is not 0. Fails if the program cannot be started (or has the exit
/// code 127, as of a missing program), if it wrote more than `longest` bytes to stdout or to stderr, or if there is no
/// room for the temporary files through which the text goes. There is no limit of time. In the browser and in a Windows
/// build of the co-simulation unit, it always fails.
tl::expected<ChildOutput, ChildFailure> run_child(const std::vector<std::string>& words, std::size_t longest,
                                                  std::string_view input = {});

}  // namespace polynya::io
