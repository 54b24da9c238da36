#pragma once

#include <string>

#include "io/run/run_reader.hpp"

namespace polynya::views {

/// Returns a picture of the last frame of a run as SVG, as wide as a page of a journal: ice, hulls, tracks and
/// fractures, with a title, a caption about the main events, and a legend. Its colours can be told apart in greyscale
/// and by colour-blind readers.
std::string final_map(const io::Run& run);

/// Writes the picture to the run's folder: final.svg, and final.png if a converter is installed. Returns the name of
/// the better file. The error names the file that could not be written.
io::Result<std::string> draw_final_map(const io::Run& run);

}  // namespace polynya::views
