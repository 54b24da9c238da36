#pragma once

#include <string>

#include "io/run/motion_index.hpp"
#include "io/run/run_reader.hpp"
#include "views/map/picture.hpp"

namespace polynya::views {

/// A run's floes, hulls, tracks and fractures at a time [s].
Picture picture_at(const io::Run& run, const io::MotionIndex& motions, double time);

/// The last frame of a run, with its title and a caption of what happened.
Picture final_picture(const io::Run& run);

/// Draws the last frame of a run, finished or not, into its folder: final.svg, and final.png where there is a
/// converter. Returns the name of the better one; the error names the file that could not be written.
io::Result<std::string> draw_final_map(const io::Run& run);

}  // namespace polynya::views
