#pragma once

#include <string>

#include <tl/expected.hpp>

#include "app/progress.hpp"
#include "io/run/run_reader.hpp"

namespace polynya::app {

/// The whole of a file, or of stdin where its name is "-", or what is wrong with it in words. What is longer
/// than `longest` bytes is refused, and a named pipe, but for those that the shell makes (`<(command)`).
tl::expected<std::string, std::string> read_input(const std::string& file, std::size_t longest);

/// A run's folder, with its progress on stderr (io/run/run_reader.hpp).
io::Result<io::Run> read_run(const std::string& folder, ProgressKind progress);

}  // namespace polynya::app
