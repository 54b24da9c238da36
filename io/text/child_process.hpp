#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/text/source_text.hpp"

namespace polynya::io {

/// Output of a program that has ended.
struct ChildOutput {
  std::string out;
  std::string err;
  int code = 0;  ///< exit code; 128 + the signal's number if a signal ended the program, as in a shell
};

/// Reason why a program gave no output.
struct ChildFailure {
  bool is_missing = false;  ///< the program is not on the search path, or cannot be started
  std::string words;
};

/// Runs a program without a shell. `words` are its name, which is looked up on the search path, and its arguments.
/// `input` is written to its stdin. Returns its output; fails if the program cannot be started, or if it writes more
/// than `longest` bytes.
tl::expected<ChildOutput, ChildFailure> run_child(const std::vector<std::string>& words, std::size_t longest,
                                                  std::string_view input = {});

}  // namespace polynya::io
