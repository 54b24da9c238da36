#include "tests/geometry/dice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/predicates.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/pose.hpp"
#include "tests/shapes.hpp"

namespace polynya::geometry::trials {
namespace {

Ring box_ring(double width, double height) {
  return shapes::rectangle(0, 0, width, height).outer;
}

Ring comb(Dice& dice) {
  const int teeth = 1 + dice.below(6);
  Ring ring{{0, 0}, {2.0 * teeth, 0}};
  for (int tooth = teeth - 1; tooth >= 0; --tooth) {
    const double x = 2 * tooth;
    for (const Point p : {Point{x + 1.5, 8}, Point{x + 1, 1}, Point{x + 0.5, 1}, Point{x, 8}}) ring.push_back(p);
  }
  return ring;
}

Ring spiral(Dice& dice) {
  const int turns = 8 + dice.below(30);
  Ring ring;
  const auto at = [](double radius, double angle) { return Point{radius * std::cos(angle), radius * std::sin(angle)}; };
  for (int i = 0; i < turns; ++i) ring.push_back(at(2 + 0.2 * i, 0.4 * i));
  for (int i = turns - 1; i >= 0; --i) ring.push_back(at(1 + 0.2 * i, 0.4 * i));
  return ring;
}

Ring star(Dice& dice) {
  const int points = 3 + dice.below(20);
  Ring ring;
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * i / points;
    const double radius = dice.between(1, 8);
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

Ring on_grid(Dice& dice) {
  Ring ring;
  const int points = 3 + dice.below(5);
  for (int i = 0; i < points; ++i)
    ring.push_back({static_cast<double>(dice.below(7)), static_cast<double>(dice.below(7))});
  return ring;
}

Polygon with_holes(Dice& dice) {
  static const std::vector<Ring> kHoles[] = {
      {{{0, 0}, {3, 6}, {6, 3}}},
      {{{0, 4}, {2, 5}, {2, 3}}},
      {{{2, 2}, {2, 4}, {4, 4}, {4, 2}}, {{4, 4}, {4, 6}, {6, 6}, {6, 4}}},
      {{{0, 4}, {2, 5}, {3, 4}, {2, 3}}, {{3, 4}, {5, 6}, {5, 3}}},
      {{{2, 2}, {2, 6}, {6, 6}, {6, 2}}},
  };
  return {box_ring(8, 8), kHoles[dice.below(5)]};
}

// Moves a polygon off the grid in doubles: turned, far away, tiny or huge.
Polygon moved(Dice& dice, Polygon polygon) {
  const Pose turned{{0, 0}, Rotation::by(0.1 + 0.37 * dice.below(8))};
  const int kind = dice.below(6);
  const double scale = kind == 1 ? 1e-6 : (kind == 2 ? 1e6 : 1);
  const Vector offset = kind == 3 ? Vector{1e6, -3e6} : Vector{0, 0};
  const bool is_turned = dice.below(2) == 1;
  const auto move = [&](Ring& ring) {
    for (Point& p : ring) {
      if (is_turned) p = transform(turned, p);
      p = Point{p.x * scale, p.y * scale} + offset;
    }
  };
  move(polygon.outer);
  for (Ring& hole : polygon.holes) move(hole);
  return polygon;
}

double nudged(Dice& dice, double value) {
  const double far = std::numeric_limits<double>::infinity();
  const int which = dice.below(8);
  return which > 1 ? value : std::nextafter(value, which == 0 ? far : -far);
}
Point nudged(Dice& dice, Point p) {
  return {nudged(dice, p.x), nudged(dice, p.y)};
}

Point a_vertex(Dice& dice, const Polygon& floe) {
  const int rings = static_cast<int>(floe.holes.size()) + 1;
  const int r = dice.below(rings);
  const Ring& ring = r == 0 ? floe.outer : floe.holes[static_cast<std::size_t>(r) - 1];
  return ring[static_cast<std::size_t>(dice.below(static_cast<int>(ring.size())))];
}

struct EdgeOf {
  Point a;
  Point b;
};
EdgeOf an_edge(Dice& dice, const Polygon& floe) {
  const auto i = static_cast<std::size_t>(dice.below(static_cast<int>(floe.outer.size())));
  return {floe.outer[i], floe.outer[(i + 1) % floe.outer.size()]};
}

Point a_place(Dice& dice, const Polygon& floe) {
  const Box box = bounding_box(floe.outer);
  const Vector size = box.high - box.low;
  const int kind = dice.below(5);
  const EdgeOf e = kind == 1 || kind == 2 ? an_edge(dice, floe) : EdgeOf{};
  switch (kind) {
    case 0:
      return nudged(dice, a_vertex(dice, floe));
    case 1:
      return nudged(dice, midpoint(e.a, e.b));
    case 2:
      return nudged(dice, e.a + dice.between(-0.5, 1.5) * (e.b - e.a));
    case 3:
      return {box.low.x + size.x * (dice.below(9) - 1) / 6, box.low.y + size.y * (dice.below(9) - 1) / 6};
    default:
      return {box.low.x + size.x * dice.between(-0.2, 1.2), box.low.y + size.y * dice.between(-0.2, 1.2)};
  }
}

double distance_to_edge(Point p, const EdgeOf& e) {
  const double along = length(e.b - e.a);
  return along > 0 ? std::abs(cross(e.b - e.a, p - e.a)) / along : 0;
}

Ring roll_disc(Dice& dice, const Polygon& floe) {
  const Point centre = a_place(dice, floe);
  const Box box = bounding_box(floe.outer);
  const double size = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  double radius = size * dice.between(0.02, 0.7);
  const int aim = dice.below(3);
  if (aim == 1) radius = nudged(dice, distance(centre, a_vertex(dice, floe)));
  if (aim == 2) radius = nudged(dice, distance_to_edge(centre, an_edge(dice, floe)));
  if (!(radius > 0)) radius = 0.1 * size;
  return disc_polygon(centre, radius, radius * dice.between(0.002, 0.3));
}

}  // namespace

int Dice::below(int count) {
  const int value = count > 256 ? byte() * 256 + byte() : byte();
  return value % count;
}

double Dice::between(double low, double high) {
  return low + (high - low) * (byte() * 256 + byte()) / 65535.0;
}

Polygon roll_floe(Dice& dice) {
  const int kind = dice.below(7);
  Polygon polygon;
  if (kind == 0) polygon.outer = box_ring(1 + dice.below(10), 1 + dice.below(10));
  if (kind == 1) polygon.outer = box_ring(10, std::pow(10.0, -dice.below(16)));
  if (kind == 2) polygon.outer = comb(dice);
  if (kind == 3) polygon.outer = spiral(dice);
  if (kind == 4) polygon.outer = star(dice);
  if (kind == 5) polygon.outer = on_grid(dice);
  if (kind == 6) polygon = with_holes(dice);
  return normalised(moved(dice, polygon));
}

Knife roll_knife(Dice& dice, const Polygon& floe) {
  switch (dice.below(6)) {
    case 0:
    case 1:
      return {true, roll_disc(dice, floe)};
    case 2: {  // a polygon over the floe's own places
      Ring ring;
      const int points = 3 + dice.below(3);
      for (int i = 0; i < points; ++i) ring.push_back(a_place(dice, floe));
      ring = without_repeats(ring);
      if (ring.size() > 2 && area_sign(ring) < 0) std::reverse(ring.begin(), ring.end());
      return {true, ring};
    }
    case 3: {  // along an edge
      const EdgeOf e = an_edge(dice, floe);
      return {false, {nudged(dice, e.a), nudged(dice, e.b), a_place(dice, floe)}};
    }
    default: {
      Ring crack;
      const int points = 2 + dice.below(4);
      for (int i = 0; i < points; ++i) crack.push_back(a_place(dice, floe));
      return {false, crack};
    }
  }
}

ManyKnives roll_knives(Dice& dice, const Polygon& floe) {
  ManyKnives knives;
  knives.is_crack = dice.below(3) == 0;
  if (knives.is_crack) {
    const int points = 2 + dice.below(7);
    for (int i = 0; i < points; ++i) knives.crack.push_back(a_place(dice, floe));
    if (dice.below(3) == 0) knives.crack.push_back(knives.crack.front());
    knives.crack.erase(std::unique(knives.crack.begin(), knives.crack.end()), knives.crack.end());
    if (knives.crack.size() < 2) knives.crack = {floe.outer[0], floe.outer[1]};
    return knives;
  }
  const int count = 1 + dice.below(3);
  for (int i = 0; i < count; ++i) {
    Knife knife = roll_knife(dice, floe);
    Polygon polygon{std::move(knife.points), {}};
    if (dice.below(3) == 0) {
      const Point towards = a_place(dice, floe);
      Ring hole = polygon.outer;
      for (Point& p : hole) p = towards + 0.5 * (p - towards);
      polygon.holes.push_back(std::move(hole));
    }
    polygon = normalised(polygon);
    if (find_defect(polygon)) polygon.holes.clear();
    if (!find_defect(polygon)) knives.polygons.push_back(std::move(polygon));
  }
  return knives;
}

}  // namespace polynya::geometry::trials
