#pragma once

#include <string>

#include <tl/expected.hpp>

namespace polynya::app {

/// The whole of a file, or of stdin where its name is "-", or what is wrong with it in words. What is longer
/// than `longest` bytes is refused.
tl::expected<std::string, std::string> read_input(const std::string& file, std::size_t longest);

/// Writes to a file, or to stdout where its name is "-". Returns what went wrong; empty where all is well.
std::string write_output(const std::string& file, const std::string& text);

}  // namespace polynya::app
