#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/text/source_text.hpp"

namespace polynya::io {

/// What a program wrote, and how it ended.
struct ChildOutput {
  std::string out;
  std::string err;
  int code = 0;  ///< as a shell has it: 128 + signal where one ended it
};

/// Why a program gave no output.
struct ChildFailure {
  bool is_missing = false;  ///< the search path does not have it, or it cannot be started
  std::string words;
};

/// Runs a program of the search path with these words, the first of which is its name, without a shell and
/// with `input` on stdin. Fails where it is not there, or where it writes more than `longest` bytes.
tl::expected<ChildOutput, ChildFailure> run_child(const std::vector<std::string>& words, std::size_t longest,
                                                  std::string_view input = {});

}  // namespace polynya::io
