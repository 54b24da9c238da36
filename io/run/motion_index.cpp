#include "io/run/motion_index.hpp"

#include <algorithm>
#include <map>

namespace polynya::io {
using simulation::FloeId;

geometry::Polygon polygon_in_world(geometry::Polygon polygon, geometry::Point centroid_in_body, const Motion& motion) {
  const geometry::Rotation rotation = geometry::Rotation::by(motion.angle);
  const auto place = [&](geometry::Ring& points) {
    for (geometry::Point& p : points) p = motion.position + rotate(rotation, p - centroid_in_body);
  };
  place(polygon.outer);
  std::ranges::for_each(polygon.holes, place);
  return polygon;
}

MotionIndex::MotionIndex(const Run& run) : floes_(run.floes.size()), ships_(hull_count(run.scene.scene)) {
  for (const Frame& frame : run.frames) {
    frame_times_.push_back(frame.time);
    for (const FloeMotion& floe : frame.floes) {
      const auto id = static_cast<std::size_t>(floe.floe);
      if (id < floes_.size()) floes_[id].push_back({frame.time, floe.motion});
    }
    for (std::size_t i = 0; i < std::min(ships_.size(), frame.ships.size()); ++i) ships_[i].push_back(frame.ships[i]);
  }
}

const RecordedMotion* MotionIndex::last_record(FloeId floe, double time) const {
  const auto& records = floes_[static_cast<std::size_t>(floe)];
  if (records.empty()) return nullptr;
  const auto after = std::ranges::upper_bound(records, time, {}, &RecordedMotion::time);
  return after == records.begin() ? &records.front() : &*(after - 1);
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
  const RecordedMotion* last = last_record(floe, time);
  if (!last) return std::nullopt;
  const Motion carried = carried_on(last->motion, time - last->time);
  const auto next_frame = std::ranges::upper_bound(frame_times_, time);
  if (next_frame == frame_times_.end() || next_frame == frame_times_.begin() || last->time > time) return carried;
  const RecordedMotion* next = last_record(floe, *next_frame);
  if (next == last) return carried;
  const double start = *(next_frame - 1);
  const double part = (time - start) / (*next_frame - start);
  return between(carried_on(last->motion, start - last->time), next->motion, part);
}

std::optional<Motion> MotionIndex::ship_at(std::size_t ship, double time) const {
  if (ship >= ships_.size() || ships_[ship].empty()) return std::nullopt;
  const auto& motions = ships_[ship];
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(frame_times_, time) - frame_times_.begin());
  if (next == 0) return motions.front();
  if (next >= motions.size()) return carried_on(motions.back(), time - frame_times_[motions.size() - 1]);
  const double start = frame_times_[next - 1];
  return between(motions[next - 1], motions[next], (time - start) / (frame_times_[next] - start));
}

std::vector<Frame> thinned_frames(const Run& run, const FrameSelection& selection) {
  if (selection.is_all()) return run.frames;
  std::map<simulation::FloeId, RecordedMotion> skipped;  // since the last frame that stayed
  std::vector<Frame> frames;
  std::size_t last = 0;  // one past the last selected frame
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    if (selection.has(run.frames[i].time)) last = i + 1;
  }
  int selected = 0;
  for (std::size_t i = 0; i < last; ++i) {
    const Frame& frame = run.frames[i];
    for (const FloeMotion& floe : frame.floes) skipped[floe.floe] = {frame.time, floe.motion};
    if (!selection.has(frame.time)) continue;
    if (selected++ % selection.every != 0 && i + 1 != last) continue;
    Frame kept{.time = frame.time, .ships = frame.ships, .floes = {}};
    for (const auto& [floe, at] : skipped) {
      if (run.is_alive(floe, frame.time) || run.is_under(floe, frame.time))
        kept.floes.push_back({floe, carried_on(at.motion, frame.time - at.time)});
    }
    skipped.clear();
    frames.push_back(std::move(kept));
  }
  return frames;
}

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
