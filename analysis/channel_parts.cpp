#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/channel.hpp"
#include "geometry/cut/cut.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/outline.hpp"

namespace polynya::analysis {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using geometry::Vector;

io::Result<> add_ice(std::vector<PlacedIce>& ice, const simulation::BirthRecord* birth, Polygon polygon_in_world) {
  if (!find_defect(polygon_in_world)) {
    const geometry::Box box = bounding_box(polygon_in_world.outer);
    ice.push_back({birth, std::move(polygon_in_world), box});
    return {};
  }
  const auto repaired = geometry::repair(rings_of(polygon_in_world), geometry::FillRule::kNonZero);
  if (!repaired && repaired.error().reason == geometry::CutFailure::kMisses) return {};
  if (!repaired) return io::fail("a placed floe is not a polygon: " + to_string(repaired.error()));
  for (const geometry::Shape& shape : repaired->shapes)
    ice.push_back({birth, shape.polygon, bounding_box(shape.polygon.outer)});
  return {};
}

std::vector<Polygon> near(const std::vector<PlacedIce>& ice, const geometry::Box& box) {
  std::vector<Polygon> found;
  for (const PlacedIce& floe : ice) {
    if (overlaps(floe.box, box)) found.push_back(floe.polygon);
  }
  return found;
}

io::Result<Parted> part(const Polygon& polygon, const std::vector<Polygon>& by) {
  if (by.empty()) return Parted{{}, {polygon}, 0};
  auto cut = geometry::cut_by_polygons({polygon}, by);
  if (!cut && cut.error().reason == geometry::CutFailure::kMisses) return Parted{{}, {polygon}, 0};
  if (!cut) return io::fail("a cut was refused: " + to_string(cut.error()));
  Parted parted;
  parted.inside_area = cut->ledger.area_inside;
  for (geometry::Piece& piece : cut->pieces)
    (piece.part == geometry::Part::kInside ? parted.inside : parted.outside).push_back(std::move(piece.shape.polygon));
  return parted;
}

Point carried_by_water(const simulation::WaterSettings& water, Point point, double from, double to) {
  const simulation::ShearSettings& shear = water.shear;
  const Vector along{std::cos(shear.direction), std::sin(shear.direction)};
  const Point still = shear.origin + water.drift_path(from);
  const double to_port = cross(along, point - still);
  return point + (water.drift_path(to) - water.drift_path(from)) + (to - from) * shear.rate * to_port * along;
}

Polygon carried_by_water(const simulation::WaterSettings& water, Polygon polygon, double from, double to) {
  const auto carry = [&](Ring& ring) {
    for (Point& p : ring) p = carried_by_water(water, p, from, to);
  };
  carry(polygon.outer);
  std::ranges::for_each(polygon.holes, carry);
  return polygon;
}

namespace {

Ring hull_at(const io::Run& run, const io::MotionIndex& motions, std::size_t ship, double time, double now) {
  const auto& scene = run.scene.scene;
  Polygon hull{transform(ship_pose_at(run, motions, ship, time), hull_of(scene, ship).hull.waterline), {}};
  return carried_by_water(scene.water, std::move(hull), time, now).outer;
}

bool is_straight(const std::vector<Ring>& hulls, std::size_t from, std::size_t to, double tolerance) {
  for (std::size_t k = from + 1; k < to; ++k) {
    for (std::size_t v = 0; v < hulls[k].size(); ++v) {
      if (distance_to_segment(hulls[k][v], hulls[from][v], hulls[to][v]) > tolerance) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<double> straight_pieces(const io::Run& run, const io::MotionIndex& motions, std::size_t ship, double time,
                                    double tolerance) {
  /// Largest number of frames in a piece; it keeps the time of the search proportional to the number of frames.
  constexpr std::size_t kLongest = 256;
  const std::vector<double> times = frame_times_until(run, time);
  std::vector<Ring> hulls;
  hulls.reserve(times.size());
  for (const double t : times) hulls.push_back(hull_at(run, motions, ship, t, time));
  std::vector<double> ends{times.front()};
  for (std::size_t from = 0; from + 1 < times.size();) {
    std::size_t to = from + 1;
    while (to + 1 < times.size() && to - from < kLongest && is_straight(hulls, from, to + 1, tolerance)) ++to;
    ends.push_back(times[to]);
    from = to;
  }
  return ends;
}

std::vector<Polygon> swept_pieces(const io::Run& run, const io::MotionIndex& motions, std::size_t ship, double time,
                                  double tolerance) {
  const std::vector<double> ends = straight_pieces(run, motions, ship, time, tolerance);
  std::vector<Polygon> pieces;
  Ring before = hull_at(run, motions, ship, ends.front(), time);
  if (ends.size() == 1) pieces.push_back({convex_hull(before), {}});
  for (std::size_t i = 1; i < ends.size(); ++i) {
    Ring now = hull_at(run, motions, ship, ends[i], time);
    std::vector<Point> both = before;
    both.insert(both.end(), now.begin(), now.end());
    pieces.push_back({convex_hull(both), {}});
    before = std::move(now);
  }
  return pieces;
}

}  // namespace polynya::analysis
