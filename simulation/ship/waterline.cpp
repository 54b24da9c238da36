#include "simulation/ship/waterline.hpp"

#include <cmath>
#include <limits>

#include "geometry/exact/measures.hpp"

namespace polynya::simulation {
namespace {

using geometry::Point;

constexpr double kLevel = 1e-9;  ///< tolerance by which vertices count as equally far forward [m]

/// Returns the index of the next vertex of a ring.
std::size_t after(const geometry::Ring& ring, std::size_t i) {
  return i + 1 < ring.size() ? i + 1 : 0;
}

}  // namespace

NearestPlace nearest_place(const geometry::Ring& ring, Point point) {
  NearestPlace place;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point from = ring[i], to = ring[after(ring, i)];
    const double along = nearest_part(from, to, point);
    const Point on_edge = from + along * (to - from);
    const double squared = squared_length(point - on_edge);
    if (squared >= nearest) continue;
    nearest = squared;
    place = {i, along, on_edge};
  }
  return place;
}

std::vector<EdgePart> edges_between(const geometry::Ring& ring, const NearestPlace& from, const NearestPlace& to) {
  if (from.edge == to.edge && from.along <= to.along) return {{from.edge, from.along, to.along}};
  std::vector<EdgePart> parts{{from.edge, from.along, 1}};
  for (std::size_t i = after(ring, from.edge); i != to.edge; i = after(ring, i)) parts.push_back({i, 0, 1});
  parts.push_back({to.edge, 0, to.along});
  return parts;
}

Waterline waterline_of(const geometry::Ring& ring) {
  Waterline line;
  line.ring = ring;
  line.area = geometry::measure({ring, {}}).area;
  std::size_t foremost = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    line.arc.push_back(line.length);
    line.length += distance(ring[i], ring[after(ring, i)]);
    if (ring[i].x > ring[foremost].x + kLevel) foremost = i;
  }
  line.stem_x = ring[foremost].x;
  const auto is_foremost = [&](std::size_t i) { return ring[i].x > line.stem_x - kLevel; };
  // The first of the foremost vertices may end the foremost edge: the ring may begin on it.
  const std::size_t before = foremost == 0 ? ring.size() - 1 : foremost - 1;
  const std::size_t first = is_foremost(before) ? before : foremost;
  const double edge = is_foremost(after(ring, first)) ? distance(ring[first], ring[after(ring, first)]) : 0;
  line.stem_arc = line.arc[first] + edge / 2;
  return line;
}

double arc_at(const Waterline& line, Point point) {
  const NearestPlace place = nearest_place(line.ring, point);
  const double from_stem = line.arc[place.edge] + distance(line.ring[place.edge], place.point) - line.stem_arc;
  return from_stem - line.length * std::ceil(from_stem / line.length - 0.5);
}

}  // namespace polynya::simulation
