#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "geometry/shape/pose.hpp"
#include "io/run/motion_index.hpp"
#include "io/run/run_reader.hpp"

namespace polynya::io {

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

}  // namespace polynya::io
