#pragma once

#include <limits>
#include <vector>

#include "io/run/run_reader.hpp"

namespace polynya::io {

/// Which of a run's frames are wanted.
struct FrameSelection {
  int every = 1;                                           ///< only each n-th frame, and the last
  double from = -std::numeric_limits<double>::infinity();  ///< [s]
  double until = std::numeric_limits<double>::infinity();  ///< [s]

  bool is_all() const { return every <= 1 && from < -1e300 && until > 1e300; }
  bool has(double time) const { return from <= time && time <= until; }
};

/// The selected frames. A floe's record in a frame between them is carried on to the next one that stays, so
/// at every frame that stays each floe alive is where the run has it, at the run's velocity.
std::vector<Frame> thinned_frames(const Run& run, const FrameSelection& selection);

}  // namespace polynya::io
