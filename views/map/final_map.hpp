#pragma once

#include <string>

#include "io/run/run_reader.hpp"

namespace polynya::views {

/// Returns a picture of the last frame of a run as SVG, 170 mm wide like a page of a journal: ice, hulls, tracks and
/// fractures, with a title, a caption about the main events, and a legend. Its colours can be told apart in greyscale
/// and by colour-blind readers. A run without frames is shown at time 0.
std::string final_map(const io::Run& run);

/// Writes the picture to the run's folder: final.svg, and final.png (240 dots per inch) if rsvg-convert is installed
/// and succeeds, and the SVG has at most 20 MiB, which limits the time and memory of the conversion. Both replace the
/// files of an earlier call; a final.png that is not written anew is removed. Returns the name of the file to show the
/// user, without its folder: final.png if it was written, otherwise final.svg. Fails, with the name of the file, only
/// if final.svg cannot be written.
io::Result<std::string> draw_final_map(const io::Run& run);

}  // namespace polynya::views
