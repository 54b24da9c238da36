#include "analysis/swept_band.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cut/cut.hpp"
#include "io/run/moment.hpp"

namespace polynya::analysis {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using geometry::Vector;

Point carried_by_water(const simulation::WaterSettings& water, Point point, double from, double to) {
  const simulation::ShearSettings& shear = water.shear;
  const Vector along{std::cos(shear.direction), std::sin(shear.direction)};
  const Point still = shear.origin + from * water.drift;
  const double to_port = cross(along, point - still);
  return point + (to - from) * (water.drift + shear.rate * to_port * along);
}

Polygon carried_by_water(const simulation::WaterSettings& water, Polygon polygon, double from, double to) {
  const auto carry = [&](Ring& ring) {
    for (Point& p : ring) p = carried_by_water(water, p, from, to);
  };
  carry(polygon.outer);
  std::ranges::for_each(polygon.holes, carry);
  return polygon;
}

Ring convex_hull(std::vector<Point> points) {
  std::ranges::sort(points, [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Ring hull;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();  // the other chain begins with it
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

tl::expected<std::vector<Polygon>, std::string> union_of(const std::vector<Polygon>& polygons) {
  if (polygons.empty()) return std::vector<Polygon>{};
  std::vector<Point> corners;
  for (const Polygon& polygon : polygons) {
    const geometry::Box box = bounding_box(polygon.outer);
    corners.insert(corners.end(), {box.low, box.high});
  }
  const geometry::Box all = grown(geometry::bounding_box(corners), 1);
  const Polygon sheet{{all.low, {all.high.x, all.low.y}, all.high, {all.low.x, all.high.y}}, {}};
  auto cut = geometry::cut_by_polygons({sheet}, polygons);
  if (!cut) return tl::unexpected(std::string(name_of(cut.error().reason)) + ": " + cut.error().detail);
  std::vector<Polygon> pieces;
  for (geometry::Piece& piece : cut->pieces) {
    if (piece.part == geometry::Part::kInside) pieces.push_back(std::move(piece.shape.polygon));
  }
  return pieces;
}

namespace {

Ring hull_at(const io::Run& run, const io::MotionIndex& motions, std::size_t ship, double time, double now) {
  const auto& scene = run.scene.scene;
  Polygon hull{io::placed(ship_pose_at(run, motions, ship, time), scene.ships[ship].hull.waterline), {}};
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

std::vector<double> straight_pieces(const io::Run& run, const io::MotionIndex& motions, std::size_t ship,
                                    double time, double tolerance) {
  constexpr std::size_t kLongest = 256;  ///< frames in a piece, which keeps the search near linear
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

std::vector<Polygon> swept_pieces(const io::Run& run, const io::MotionIndex& motions, std::size_t ship,
                                  double time, double tolerance) {
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
