#include "io/run/motion_index.hpp"

#include <algorithm>

#include "geometry/shape/pose.hpp"

namespace polynya::io {

using simulation::FloeId;

geometry::Polygon polygon_in_world(const geometry::Polygon& polygon_in_body, geometry::Point centroid_in_body,
                                   const Motion& motion) {
  const geometry::Rotation rotation = geometry::Rotation::by(motion.angle);
  const auto placed = [&](geometry::Ring points) {
    for (geometry::Point& p : points) p = motion.position + rotate(rotation, p - centroid_in_body);
    return points;
  };
  geometry::Polygon polygon{placed(polygon_in_body.outer), {}};
  for (const geometry::Ring& hole : polygon_in_body.holes) polygon.holes.push_back(placed(hole));
  return polygon;
}

MotionIndex::MotionIndex(const Run& run) : floes_(run.floes.size()), ships_(run.scene.scene.ships.size()) {
  for (const Frame& frame : run.frames) {
    frame_times_.push_back(frame.time);
    for (const FloeMotion& floe : frame.floes) {
      const auto id = static_cast<std::size_t>(floe.floe);
      if (id < floes_.size()) floes_[id].push_back({frame.time, floe.motion});
    }
    for (std::size_t i = 0; i < std::min(ships_.size(), frame.ships.size()); ++i)
      ships_[i].push_back(frame.ships[i]);
  }
}

const MotionIndex::Told* MotionIndex::last_told(FloeId floe, double time) const {
  const auto& told = floes_[static_cast<std::size_t>(floe)];
  if (told.empty()) return nullptr;
  const auto after = std::ranges::upper_bound(told, time, {}, &Told::time);
  return after == told.begin() ? &told.front() : &*(after - 1);
}

namespace {

Motion between(const Motion& a, const Motion& b, double part) {
  const auto mix = [&](double from, double to) { return from + part * (to - from); };
  return {{mix(a.position.x, b.position.x), mix(a.position.y, b.position.y)},
          mix(a.angle, b.angle),
          {mix(a.velocity.x, b.velocity.x), mix(a.velocity.y, b.velocity.y)},
          mix(a.angular_velocity, b.angular_velocity)};
}

}  // namespace

std::optional<Motion> MotionIndex::floe_at(FloeId floe, double time) const {
  if (floe < 0 || static_cast<std::size_t>(floe) >= floes_.size()) return std::nullopt;
  const Told* told = last_told(floe, time);
  if (!told) return std::nullopt;
  const Motion carried = carried_on(told->motion, time - told->time);
  const auto next_frame = std::ranges::upper_bound(frame_times_, time);
  if (next_frame == frame_times_.end() || next_frame == frame_times_.begin() || told->time > time)
    return carried;
  const Told* next = last_told(floe, *next_frame);
  if (next == told) return carried;
  const double start = *(next_frame - 1);
  const double part = (time - start) / (*next_frame - start);
  return between(carried_on(told->motion, start - told->time), next->motion, part);
}

std::optional<Motion> MotionIndex::ship_at(std::size_t ship, double time) const {
  if (ship >= ships_.size() || ships_[ship].empty()) return std::nullopt;
  const auto& motions = ships_[ship];
  const auto next =
      static_cast<std::size_t>(std::ranges::upper_bound(frame_times_, time) - frame_times_.begin());
  if (next == 0) return motions.front();
  if (next >= motions.size()) return carried_on(motions.back(), time - frame_times_[motions.size() - 1]);
  const double start = frame_times_[next - 1];
  return between(motions[next - 1], motions[next], (time - start) / (frame_times_[next] - start));
}

}  // namespace polynya::io
