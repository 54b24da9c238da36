#include "io/run/placed_floes.hpp"

namespace polynya::io {

geometry::Pose pose_of(const simulation::BirthRecord& birth, const Motion& motion) {
  const geometry::Rotation rotation = geometry::Rotation::by(motion.angle);
  return {motion.position - rotate(rotation, birth.centroid_in_body - geometry::Point{}), rotation};
}

namespace {

/// Of the youngest of the floe and those it broke from that a frame has.
geometry::Pose body_pose(const Run& run, const MotionIndex& motions, const simulation::BirthRecord& floe, double time) {
  const simulation::BirthRecord* at = &floe;
  while (true) {
    if (const auto motion = motions.floe_at(at->floe, time)) return pose_of(*at, *motion);
    const RunFloe* parent = at->parent < at->floe ? run.floe(at->parent) : nullptr;
    if (!parent) return {};
    at = &parent->birth;
  }
}

PlacedFloe placed(const Run& run, const MotionIndex& motions, const simulation::BirthRecord& floe, double time) {
  return {&floe, run.shape(floe.floe), body_pose(run, motions, floe, time), motions.floe_at(floe.floe, time)};
}

}  // namespace

void for_floes_at(const Run& run, const MotionIndex& motions, double time,
                  const std::function<void(const PlacedFloe&)>& use) {
  for (const RunFloe& floe : run.floes)
    if (run.is_alive(floe.birth.floe, time)) use(placed(run, motions, floe.birth, time));
}

std::vector<PlacedFloe> floes_at(const Run& run, const MotionIndex& motions, double time) {
  std::vector<PlacedFloe> floes;
  for_floes_at(run, motions, time, [&](const PlacedFloe& floe) { floes.push_back(floe); });
  return floes;
}

std::vector<PlacedFloe> floes_under_hulls_at(const Run& run, const MotionIndex& motions, double time) {
  std::vector<PlacedFloe> floes;
  for (const RunFloe& floe : run.floes)
    if (run.is_under(floe.birth.floe, time)) floes.push_back(placed(run, motions, floe.birth, time));
  return floes;
}

geometry::Pose ship_pose_at(const Run& run, const MotionIndex& motions, std::size_t ship, double time) {
  if (const auto motion = motions.ship_at(ship, time)) return {motion->position, geometry::Rotation::by(motion->angle)};
  const simulation::PlacedHull& hull = hull_of(run.scene.scene, ship);
  return {hull.position_in_world, geometry::Rotation::by(hull.heading)};
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
