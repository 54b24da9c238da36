#pragma once

#include <string>
#include <vector>

#include "io/text/source_text.hpp"

namespace polynya::io {

/// What a program wrote, and how it ended.
struct ChildOutput {
  std::string out;
  std::string err;
  int code = 0;  ///< as a shell has it: 128 + signal where one ended it
};

/// Runs a program of the search path with these words, the first of which is its name, without a shell and
/// with nothing on stdin. Fails where it is not there, or where it writes more than `longest` bytes.
Result<ChildOutput> run_child(const std::vector<std::string>& words, std::size_t longest);

}  // namespace polynya::io
