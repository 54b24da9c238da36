#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "geometry/shape/pose.hpp"
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
geometry::Polygon polygon_in_world(geometry::Polygon polygon_in_body, geometry::Point centroid_in_body,
                                   const Motion& motion);

/// A floe where it was at some time of a run.
struct PlacedFloe {
  const simulation::BirthRecord* birth = nullptr;            ///< the run's
  std::shared_ptr<const geometry::Polygon> polygon_in_body;  ///< [m]
  geometry::Pose world_from_body;
  std::optional<Motion> motion;  ///< of its centre of mass; nothing where no frame has it
};

/// The floes that float at a time, by id. A floe that lived between two frames is placed as the floe it broke
/// from was, whose body frame it shares; one that no frame has, where it was born.
std::vector<PlacedFloe> floes_at(const Run& run, const MotionIndex& motions, double time);
/// Calls use(floe) for each of them, one at a time: all of a million floes, with their polygons, take 200 MB.
void for_floes_at(const Run& run, const MotionIndex& motions, double time,
                  const std::function<void(const PlacedFloe&)>& use);

/// Those under hulls then, or waiting for room behind them, likewise.
std::vector<PlacedFloe> floes_under_hulls_at(const Run& run, const MotionIndex& motions, double time);

/// The body frame of a floe whose centre of mass moves so.
geometry::Pose pose_of(const simulation::BirthRecord& birth, const Motion& motion);

/// Where a ship's frame is in the world; where the scene puts it if the run has no frames.
geometry::Pose ship_pose_at(const Run& run, const MotionIndex& motions, std::size_t ship, double time);

/// The times of the frames up to a time, and that time itself [s].
std::vector<double> frame_times_until(const Run& run, double time);

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
