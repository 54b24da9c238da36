#pragma once

#include <string>

#include <tl/expected.hpp>

namespace polynya::app {

/// The whole of a file, or of stdin where its name is "-", or what is wrong with it in words. What is longer
/// than `longest` bytes is refused.
tl::expected<std::string, std::string> read_input(const std::string& file, std::size_t longest);

}  // namespace polynya::app
