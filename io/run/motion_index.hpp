#pragma once

#include <optional>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/run/frames.hpp"
#include "io/run/run_reader.hpp"

namespace polynya::io {

/// Where the floes of a run are, by time. Keeps what frames tell of each floe.
class MotionIndex {
 public:
  explicit MotionIndex(const Run& run);

  /// Motion of a floe's centre of mass at a time: between two frames, linear between what they tell. Nothing
  /// where no frame ever told of the floe.
  std::optional<Motion> floe_at(simulation::FloeId floe, double time) const;
  std::optional<Motion> ship_at(std::size_t ship, double time) const;

 private:
  struct Told {
    double time = 0;  ///< [s]
    Motion motion;
  };
  const Told* last_told(simulation::FloeId floe, double time) const;
  std::vector<double> frame_times_;
  std::vector<std::vector<Told>> floes_;    ///< by floe id, in time order
  std::vector<std::vector<Motion>> ships_;  ///< by ship, one a frame
};

/// A floe's polygon in the world for a motion of its centre of mass.
geometry::Polygon polygon_in_world(const geometry::Polygon& polygon_in_body, geometry::Point centroid_in_body,
                                   const Motion& motion);

}  // namespace polynya::io
