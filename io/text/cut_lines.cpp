#include "io/text/cut_lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "elementary/elementary.hpp"
#include "geometry/exact/predicates.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Ring;
using geometry::Vector;

double largest_coordinate(const std::vector<Point>& points) {
  double largest = 0;
  for (const Point p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  return largest;
}

/// Returns cosine and sine of an angle [°]. They are exact at multiples of 90°, and equal to each other at 45°.
Vector direction_of(double angle_deg) {
  constexpr double kDiagonal = 1 / std::numbers::sqrt2;
  constexpr Vector kEighths[] = {{1, 0}, {kDiagonal, kDiagonal}, {0, 1}, {-kDiagonal, kDiagonal}, {-1, 0}};
  const double angle = std::remainder(angle_deg, 360);  // exact, from −180 to 180
  const double eighths = std::abs(angle) / 45;
  if (eighths == std::floor(eighths)) {
    const Vector up = kEighths[static_cast<int>(eighths)];
    return {up.x, angle < 0 ? -up.y : up.y};
  }
  return {elementary::cos(angle * std::numbers::pi / 180), elementary::sin(angle * std::numbers::pi / 180)};
}

/// Extends the ends of paths.
class Continuation {
 public:
  Continuation(const std::vector<CutPath>& paths, const geometry::Polygon& floe, double snap)
      : paths_(paths), floe_(floe), snap_(snap), rounding_(default_snap(floe, paths)) {}

  std::vector<CutPath> run() const {
    std::vector<CutPath> result = paths_;
    for (std::size_t i = 0; i < result.size(); ++i) {
      CutPath& path = result[i];
      if (path.size() < 2 || !geometry::are_usable(path)) continue;
      path.back() = end_of(i, path[path.size() - 2], path.back());
      path.front() = end_of(i, path[1], path.front());
    }
    return result;
  }

 private:
  /// Returns the new end of a path whose last segment runs from `before` to `end`.
  Point end_of(std::size_t path, Point before, Point end) const {
    const double way = length(end - before);
    if (!(way > 0 && std::isfinite(way))) return end;
    const Vector direction = (end - before) / way;
    const Point reach = end + snap_ * direction;
    if (reach == end) return end;
    std::optional<double> nearest;
    const auto look_at = [&](Point a, Point b) {
      if (a == b || !overlaps(geometry::box_around(a, b), geometry::box_around(end, reach))) return;
      if (geometry::meet(end, reach, a, b).kind == geometry::Meeting::kNone) return;
      const double across = cross(direction, b - a);
      const double there = across != 0 ? cross(a - end, b - a) / across : snap_;
      const double distance = std::isfinite(there) ? std::clamp(there, 0.0, snap_) : snap_;
      if (!nearest || distance < *nearest) nearest = distance;
    };
    const auto look_along = [&](const Ring& ring) {
      for (std::size_t i = 0; i < ring.size(); ++i) look_at(ring[i], ring[(i + 1) % ring.size()]);
    };
    look_along(floe_.outer);
    std::ranges::for_each(floe_.holes, look_along);
    for (std::size_t k = 0; k < paths_.size(); ++k) {
      if (k == path || !geometry::are_usable(paths_[k])) continue;
      for (std::size_t i = 1; i < paths_[k].size(); ++i) look_at(paths_[k][i - 1], paths_[k][i]);
    }
    return nearest ? end + (*nearest + rounding_) * direction : end;
  }

  const std::vector<CutPath>& paths_;
  const geometry::Polygon& floe_;
  const double snap_;
  const double rounding_;  ///< distance by which an extended end passes the boundary or path that it meets [m]
};

}  // namespace

CutPath path_across(Point point, double angle_deg, const geometry::Box& box) {
  double farthest = 0;
  for (const double x : {box.low.x, box.high.x}) {
    for (const double y : {box.low.y, box.high.y}) farthest = std::max(farthest, distance(point, {x, y}));
  }
  const double reach = std::ldexp(1.0, std::ilogb(std::max(farthest, 1e-300)) + 2);
  const geometry::Vector arm = reach * direction_of(angle_deg);
  return {point - arm, point + arm};
}

double default_snap(const geometry::Polygon& floe, const std::vector<CutPath>& paths) {
  double largest = largest_coordinate(floe.outer);
  for (const CutPath& path : paths) largest = std::max(largest, largest_coordinate(path));
  return 64 * std::numeric_limits<double>::epsilon() * largest;
}

std::vector<CutPath> continued(const std::vector<CutPath>& paths, const geometry::Polygon& floe, double snap) {
  return Continuation(paths, floe, snap).run();
}

bool ends_within(const std::vector<CutPath>& paths, const geometry::Box& box) {
  const auto is_within = [&](Point p) { return overlaps(box, geometry::Box{p, p}); };
  return std::ranges::any_of(
      paths, [&](const CutPath& path) { return !path.empty() && (is_within(path.front()) || is_within(path.back())); });
}

}  // namespace polynya::io
