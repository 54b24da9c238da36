#include "simulation/field/free_area.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/point_in_ring.hpp"
#include "simulation/field/convex.hpp"

namespace polynya::simulation {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using geometry::Vector;

bool is_convex(const Ring& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (cross(ring[(i + 1) % n] - ring[i], ring[(i + 2) % n] - ring[(i + 1) % n]) < 0) return false;
  }
  return true;
}

/// Whether a segment runs through a convex ring, deeper than rounding.
bool runs_through(Point from, Point to, const Ring& ring, double depth) {
  double enter = 0;
  double leave = 1;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector edge = ring[(i + 1) % ring.size()] - ring[i];
    const double margin = depth * length(edge);
    const double at_from = cross(edge, from - ring[i]) - margin;
    const double at_to = cross(edge, to - ring[i]) - margin;
    if (at_from <= 0 && at_to <= 0) return false;
    if (at_from < 0) enter = std::max(enter, at_from / (at_from - at_to));
    if (at_to < 0) leave = std::min(leave, at_from / (at_from - at_to));
    if (enter >= leave) return false;
  }
  return true;
}

}  // namespace

FreeArea::FreeArea(const Ring& region, const std::vector<Polygon>& kept_clear, double gap, const Plane& plane) {
  hull_ = plane.from_world(region);
  if (!is_convex(region)) {
    region_ = hull_;
    const Box box = bounding_box(region_);
    hull_ = {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
    add_edges(region, true, 0, plane);
  }
  for (const Polygon& polygon : kept_clear) {
    const Ring ring = plane.from_world(polygon.outer);
    const Box reach = grown(bounding_box(ring), 2 * gap * plane.stretch);
    if (!overlaps(reach, bounding_box(hull_))) continue;
    clear_.push_back(ring);
    clear_boxes_.push_back(bounding_box(ring));
    add_edges(polygon.outer, false, 0.5 * gap, plane);
  }
  tree_ = geometry::BoxTree(edges_);
}

/// Edges moved to their free side, and made longer at both ends, by the margin.
void FreeArea::add_edges(const Ring& in_world, bool is_free_inside, double margin, const Plane& plane) {
  for (std::size_t i = 0; i < in_world.size(); ++i) {
    Point from = in_world[i];
    Point to = in_world[(i + 1) % in_world.size()];
    if (!is_free_inside) std::swap(from, to);
    const Vector along = (to - from) / distance(from, to);
    from += margin * (perpendicular(along) - along);
    to += margin * (perpendicular(along) + along);
    edges_.push_back({plane.from_world(from), plane.from_world(to)});
  }
}

bool FreeArea::holds(Point p) const {
  if (!region_.empty() && side_of_ring(region_, p) < 0) return false;
  for (std::size_t i = 0; i < clear_.size(); ++i) {
    if (contains(clear_boxes_[i], {p, p}) && side_of_ring(clear_[i], p) > 0) return false;
  }
  return true;
}

bool FreeArea::clip(Ring& ring) const {
  if (edges_.empty() || ring.empty()) return false;
  const Box box = bounding_box(ring);
  std::vector<std::size_t> near;
  tree_.for_each_near(box, [&](std::size_t i) {
    near.push_back(i);
    return true;
  });
  const double depth = 1e-7 * distance(box.low, box.high);
  bool was_met = false;
  while (!ring.empty()) {
    Ring best;
    double most = -1;
    for (const std::size_t i : near) {
      const Point from = edges_[i].a;
      const Point to = edges_[i].b;
      if (!runs_through(from, to, ring, depth)) continue;
      Ring left = ring;
      clip_to_left(left, from, to);
      const double area = left.empty() ? 0 : measure_convex(left).area;
      if (area > most) {
        most = area;
        best = std::move(left);
      }
    }
    if (most < 0) break;
    was_met = true;
    ring = std::move(best);
  }
  if (!ring.empty() && !holds(measure_convex(ring).centroid)) ring.clear();
  return was_met;
}

double free_area(const Ring& region, const std::vector<Polygon>& kept_clear) {
  std::vector<geometry::Shape> pieces{{{region, {}}}};
  for (const Polygon& clear : kept_clear) {
    std::vector<geometry::Shape> left;
    for (geometry::Shape& piece : pieces) {
      auto cut = geometry::cut_by_polygon(piece, clear);
      if (!cut) {
        left.push_back(std::move(piece));  // it does not meet the clearing
        continue;
      }
      for (geometry::Piece& part : cut->pieces) {
        if (part.part == geometry::Part::kOutside) left.push_back(std::move(part.shape));
      }
    }
    pieces = std::move(left);
  }
  double area = 0;
  for (const geometry::Shape& piece : pieces) area += geometry::measure(piece.polygon).area;
  return area;
}

}  // namespace polynya::simulation
