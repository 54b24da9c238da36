#pragma once

#include <string>

#include <tl/expected.hpp>

#include "io/run/run_reader.hpp"

namespace polynya::views {

/// Draws the last frame of a run, finished or not, into its folder: final.svg, and final.png where there is a
/// converter. Returns the name of the better one; the error names the file that could not be written.
tl::expected<std::string, std::string> draw_final_map(const io::Run& run);

}  // namespace polynya::views
