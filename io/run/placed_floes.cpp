#include "io/run/placed_floes.hpp"

namespace polynya::io {

geometry::Pose pose_of(const simulation::BirthRecord& birth, const Motion& motion) {
  const geometry::Rotation rotation = geometry::Rotation::by(motion.angle);
  return {motion.position - rotate(rotation, birth.centroid_in_body - geometry::Point{}), rotation};
}

namespace {

/// Of the youngest of the floe and those it broke from that a frame has.
geometry::Pose body_pose(const Run& run, const MotionIndex& motions, const simulation::BirthRecord& floe,
                         double time) {
  const simulation::BirthRecord* at = &floe;
  while (true) {
    if (const auto motion = motions.floe_at(at->floe, time)) return pose_of(*at, *motion);
    const RunFloe* parent = at->parent < at->floe ? run.floe(at->parent) : nullptr;
    if (!parent) return {};
    at = &parent->birth;
  }
}

template <class Condition>
std::vector<PlacedFloe> floes_where(const Run& run, const MotionIndex& motions, double time,
                                    Condition condition) {
  std::vector<PlacedFloe> floes;
  for (const RunFloe& floe : run.floes) {
    if (!condition(floe.birth.floe)) continue;
    floes.push_back({&floe.birth, run.shape(floe.birth.floe), body_pose(run, motions, floe.birth, time),
                     motions.floe_at(floe.birth.floe, time)});
  }
  return floes;
}

}  // namespace

std::vector<PlacedFloe> floes_at(const Run& run, const MotionIndex& motions, double time) {
  return floes_where(run, motions, time, [&](simulation::FloeId floe) { return run.is_alive(floe, time); });
}

std::vector<PlacedFloe> floes_under_hulls_at(const Run& run, const MotionIndex& motions, double time) {
  return floes_where(run, motions, time, [&](simulation::FloeId floe) { return run.is_under(floe, time); });
}

geometry::Pose ship_pose_at(const Run& run, const MotionIndex& motions, std::size_t ship, double time) {
  if (const auto motion = motions.ship_at(ship, time))
    return {motion->position, geometry::Rotation::by(motion->angle)};
  const simulation::ShipSpec& spec = run.scene.scene.ships.at(ship);
  return {spec.position_in_world, geometry::Rotation::by(spec.heading)};
}

std::vector<double> frame_times_until(const Run& run, double time) {
  std::vector<double> times;
  for (const Frame& frame : run.frames) {
    if (frame.time < time) times.push_back(frame.time);
  }
  times.push_back(time);
  return times;
}

}  // namespace polynya::io
