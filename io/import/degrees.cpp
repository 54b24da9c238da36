#include "io/import/degrees.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "elementary/elementary.hpp"
#include "geometry/shape/angle.hpp"
#include "geometry/shape/segments.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Ring;

constexpr double kAtPole = 1e-10;    ///< points nearer to a pole than this are the pole [°]: 0.01 mm
constexpr double kSamePlace = 1e-9;  ///< points nearer to each other than this are the same place [°]: 0.1 mm

bool are_on_one_meridian(Point a, Point b) {
  return std::abs(std::remainder(a.x - b.x, 360)) <= kSamePlace;
}
bool are_same_place(Point a, Point b) {
  if (is_pole(a) || is_pole(b)) return is_pole(a) && is_pole(b) && (a.y > 0) == (b.y > 0);
  return are_on_one_meridian(a, b) && std::abs(a.y - b.y) <= kSamePlace;
}

/// Returns true if a ring turns back at a point, so that it arrives and leaves on one meridian, or if two points are
/// equal.
bool turns_back(Point before, Point at, Point after) {
  if (are_same_place(before, at)) return true;
  if (is_pole(at)) return are_on_one_meridian(before, after) || is_pole(before) || is_pole(after);
  return !is_pole(before) && !is_pole(after) && are_on_one_meridian(before, at) && are_on_one_meridian(at, after) &&
         (before.y < at.y) == (after.y < at.y);
}

}  // namespace

bool is_pole(Point point) {
  return std::abs(point.y) >= 90 - kAtPole;
}

double longitude_near(double longitude, double near) {
  const double difference = longitude - near;
  return std::abs(difference) <= 180 ? longitude : near + std::remainder(difference, 360);
}

Point in_one_notation(Point point) {
  return {is_pole(point) ? 0 : std::remainder(point.x, 360), point.y};
}

Ring continuous(const Ring& points, bool is_closed) {
  Ring result;
  const auto first = std::ranges::find_if_not(points, is_pole);
  if (first == points.end()) return points;
  double longitude = first->x;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point p = points[i];
    if (!is_pole(p)) {
      longitude = longitude_near(p.x, longitude);
      result.push_back({longitude, p.y});
      continue;
    }
    const bool has_next = i + 1 < n || is_closed;
    const Point next = points[(i + 1) % n];
    if (i > 0 || !is_closed) result.push_back({longitude, p.y});
    if (!has_next || is_pole(next)) continue;
    longitude = longitude_near(next.x, longitude);
    if (result.empty() || result.back() != Point{longitude, p.y}) result.push_back({longitude, p.y});
  }
  if (is_closed && is_pole(points.front())) result.push_back({longitude, points.front().y});
  return result;
}

Ring without_seams(Ring ring) {
  const bool has_pole = std::ranges::any_of(ring, is_pole);
  for (std::size_t i = 0, unchanged = 0; has_pole && ring.size() > 2 && unchanged < ring.size();) {
    const std::size_t n = ring.size();
    i %= n;
    if (turns_back(ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n])) {
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
      i = i > 0 ? i - 1 : ring.size() - 1;
      unchanged = 0;
    } else {
      ++i;
      ++unchanged;
    }
  }
  return ring;
}

namespace {

/// Corrects the change of longitude at a pole. With the material on its left, a ring at the north pole leaves it on a
/// meridian to the west of the one on which it arrived; at the south pole, to the east.
void follow_material_at_poles(Ring& ring) {
  for (std::size_t i = 1; i < ring.size(); ++i) {
    if (!is_pole(ring[i]) || !is_pole(ring[i - 1])) continue;
    const double change = ring[i].x - ring[i - 1].x;
    const double turn = ring[i].y > 0 && change > 0 ? -360 : ring[i].y < 0 && change < 0 ? 360 : 0;
    for (std::size_t k = i; turn != 0 && k < ring.size(); ++k) ring[k].x += turn;
  }
}

/// Projects a place to a plane that touches the Earth at the pole, to compare distances near it [°].
Point about_pole(Point degrees) {
  const double colatitude = 90 - std::abs(degrees.y), longitude = degrees.x * geometry::kRadiansPerDegree;
  return {colatitude * elementary::cos(longitude), colatitude * elementary::sin(longitude)};
}

/// A place on a ring: the edge that starts at a vertex, and the fraction of its length.
struct RingPlace {
  std::size_t edge = 0;
  double part = 0;
};

/// A ring around a pole. `turn` is the change of longitude once around it [°].
class RingAroundPole {
 public:
  RingAroundPole(const Ring& ring, double turn) : ring_(ring), turn_(turn) {}

  /// Returns the ring with a seam to the pole that does not cross the polygon's rings, if there is such a seam.
  Ring with_seam(const std::vector<Ring>& rings) const {
    std::vector<RingPlace> places{nearest_to_pole()};
    for (std::size_t i = 0; i < ring_.size(); ++i) places.push_back({i, 0});
    const auto is_clear = [&](RingPlace place) {
      return std::ranges::none_of(rings, [&](const Ring& other) { return crosses_seam(place, other); });
    };
    const auto clear = std::ranges::find_if(places, is_clear);
    Ring drawn = beginning_at(clear != places.end() ? *clear : places.front());
    const Point first = drawn.front();
    const double pole = first.y > 0 ? 90 : -90;
    for (const Point p : {Point{first.x + turn_, first.y}, Point{first.x + turn_, pole}, Point{first.x, pole}})
      drawn.push_back(p);
    return drawn;
  }

 private:
  Point end_of(std::size_t i) const {
    return i + 1 < ring_.size() ? ring_[i + 1] : Point{ring_[0].x + turn_, ring_[0].y};
  }

  RingPlace nearest_to_pole() const {
    RingPlace nearest;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const Point a = about_pole(ring_[i]), b = about_pole(end_of(i));
      const Point p = nearest_on_segment(a, b, Point{});
      if (length(p - Point{}) >= least) continue;
      least = length(p - Point{});
      const double part = a == b ? 0 : length(p - a) / length(b - a);
      nearest = part < 1 - 1e-6 ? RingPlace{i, part > 1e-6 ? part : 0} : RingPlace{(i + 1) % ring_.size(), 0};
    }
    return nearest;
  }

  bool crosses_seam(RingPlace place, const Ring& other) const {
    const Point a = ring_[place.edge], b = end_of(place.edge);
    // The test starts a little above the ring, because the seam touches the ring at its foot.
    const Point foot = about_pole(a + place.part * (b - a));
    const Point above{(1 - 1e-9) * foot.x, (1 - 1e-9) * foot.y};
    for (std::size_t i = 0; i < other.size(); ++i)
      if (cross_each_other(above, Point{}, about_pole(other[i]), about_pole(other[(i + 1) % other.size()])))
        return true;
    return false;
  }

  Ring beginning_at(RingPlace place) const {
    Ring begun;
    const Point a = ring_[place.edge], b = end_of(place.edge);
    if (place.part > 0) begun.push_back(a + place.part * (b - a));
    const std::size_t first = place.part > 0 ? place.edge + 1 : place.edge;
    for (std::size_t i = first; i < first + ring_.size(); ++i)
      begun.push_back({ring_[i % ring_.size()].x + (i < ring_.size() ? 0 : turn_), ring_[i % ring_.size()].y});
    return begun;
  }

  const Ring& ring_;
  const double turn_;
};

Ring ring_in_degrees(const Ring& ring, double longitude, const std::vector<Ring>& rings) {
  Ring drawn = continuous(ring, true);
  if (drawn.empty()) return drawn;
  follow_material_at_poles(drawn);
  const double closing = longitude_near(drawn.front().x, drawn.back().x) - drawn.front().x;
  const double turn = is_pole(drawn.front()) ? 0 : 360 * std::round(closing / 360);
  if (turn != 0) drawn = RingAroundPole(drawn, turn).with_seam(rings);
  const double shift = longitude_near(drawn.front().x, longitude) - drawn.front().x;
  for (Point& p : drawn) p.x += shift;
  return drawn;
}

}  // namespace

geometry::Polygon drawn_in_degrees(const geometry::Polygon& polygon, double longitude) {
  std::vector<Ring> rings{polygon.outer};
  rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
  geometry::Polygon drawn{ring_in_degrees(polygon.outer, longitude, rings), {}};
  if (drawn.outer.empty()) return drawn;
  const auto [west, east] = std::ranges::minmax_element(drawn.outer, {}, &Point::x);
  const double middle = (west->x + east->x) / 2;
  for (const Ring& hole : polygon.holes) drawn.holes.push_back(ring_in_degrees(hole, middle, rings));
  return drawn;
}

Ring line_in_degrees(const Ring& line, double longitude) {
  Ring drawn = continuous(line, false);
  if (drawn.empty()) return drawn;
  const double shift = longitude_near(drawn.front().x, longitude) - drawn.front().x;
  for (Point& p : drawn) p.x += shift;
  return drawn;
}

}  // namespace polynya::io
