#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/run/frames.hpp"
#include "io/run/run_reader.hpp"

namespace polynya::io {
/// Where the floes of a run are, by time: the frames' records, by floe.
class MotionIndex {
 public:
  explicit MotionIndex(const Run& run);

  /// Motion of a floe's centre of mass at a time: between two frames, linear between their records. Nothing
  /// where no frame has the floe.
  std::optional<Motion> floe_at(simulation::FloeId floe, double time) const;
  std::optional<Motion> ship_at(std::size_t ship, double time) const;

 private:
  const RecordedMotion* last_record(simulation::FloeId floe, double time) const;
  std::vector<double> frame_times_;
  std::vector<std::vector<RecordedMotion>> floes_;  ///< by floe id, in time order
  std::vector<std::vector<Motion>> ships_;          ///< by ship, one a frame
};

/// A floe's polygon in the world for a motion of its centre of mass.
geometry::Polygon polygon_in_world(const geometry::Polygon& polygon_in_body, geometry::Point centroid_in_body,
                                   const Motion& motion);

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
