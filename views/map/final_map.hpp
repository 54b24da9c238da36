#pragma once

#include <string>

#include "io/run/run_reader.hpp"

namespace polynya::views {

/// The last frame of a run as SVG: ice, hulls, tracks and fractures under a title and a caption of what happened, over
/// a legend, on a page as wide as a journal's. Its colours stay apart in greyscale and for colour-blind eyes.
std::string final_map(const io::Run& run);

/// Draws that into the run's folder: final.svg, and final.png where there is a converter. Returns the name of the
/// better one; the error names the file that could not be written.
io::Result<std::string> draw_final_map(const io::Run& run);

}  // namespace polynya::views
