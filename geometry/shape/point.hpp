#pragma once

#include <algorithm>
#include <cmath>

namespace polynya::geometry {

/// A displacement, direction or velocity in the plane. Its unit depends on its use; [m] if none is named.
struct Vector {
  double x = 0;
  double y = 0;
  friend bool operator==(const Vector&, const Vector&) = default;
};

/// A position in the plane [m]. The name of the variable states its frame.
struct Point {
  double x = 0;
  double y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

constexpr Vector operator+(Vector a, Vector b) {
  return {a.x + b.x, a.y + b.y};
}
constexpr Vector operator-(Vector a, Vector b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr Vector operator-(Vector a) {
  return {-a.x, -a.y};
}
constexpr Vector operator*(double s, Vector a) {
  return {s * a.x, s * a.y};
}
constexpr Vector operator*(Vector a, double s) {
  return {s * a.x, s * a.y};
}
constexpr Vector operator/(Vector a, double s) {
  return {a.x / s, a.y / s};
}
constexpr Vector& operator+=(Vector& a, Vector b) {
  return a = a + b;
}
constexpr Vector& operator-=(Vector& a, Vector b) {
  return a = a - b;
}

constexpr Vector operator-(Point a, Point b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr Point operator+(Point a, Vector b) {
  return {a.x + b.x, a.y + b.y};
}
constexpr Point operator-(Point a, Vector b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr Point& operator+=(Point& a, Vector b) {
  return a = a + b;
}

constexpr double dot(Vector a, Vector b) {
  return a.x * b.x + a.y * b.y;
}
/// Returns the z component of a × b.
constexpr double cross(Vector a, Vector b) {
  return a.x * b.y - a.y * b.x;
}
/// Returns ω × r for an angular velocity ω about z [rad/s].
constexpr Vector cross(double omega, Vector r) {
  return {-omega * r.y, omega * r.x};
}
/// Returns the vector rotated by +90°.
constexpr Vector perpendicular(Vector a) {
  return {-a.y, a.x};
}
constexpr double squared_length(Vector a) {
  return dot(a, a);
}
inline double length(Vector a) {
  return std::sqrt(squared_length(a));
}
inline double distance(Point a, Point b) {
  return length(b - a);
}
/// Lexicographic order: by x, then by y.
constexpr bool precedes(Point a, Point b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}
constexpr Point midpoint(Point a, Point b) {
  return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
}
/// Returns the place, along the segment from a (0) to b (1), of its point nearest to p; 0 if the segment has no length.
constexpr double nearest_part(Point a, Point b, Point p) {
  const Vector d = b - a;
  const double squared = squared_length(d);
  return squared > 0 ? std::clamp(dot(p - a, d) / squared, 0.0, 1.0) : 0;
}
constexpr Point nearest_on_segment(Point a, Point b, Point p) {
  return a + nearest_part(a, b, p) * (b - a);
}
inline double distance_to_segment(Point p, Point a, Point b) {
  return distance(p, nearest_on_segment(a, b, p));
}

/// An axis-aligned box [m].
struct Box {
  Point low;
  Point high;
};

constexpr Box box_around(Point a, Point b) {
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}
constexpr Box united(const Box& a, const Box& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}
constexpr void extend(Box& box, const Box& by) {
  box = united(box, by);
}
constexpr void extend(Box& box, Point by) {
  box = united(box, {by, by});
}
constexpr Box grown(const Box& box, double margin) {
  return {{box.low.x - margin, box.low.y - margin}, {box.high.x + margin, box.high.y + margin}};
}
constexpr bool overlaps(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}
constexpr bool contains(const Box& outer, const Box& inner) {
  return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && inner.high.x <= outer.high.x &&
         inner.high.y <= outer.high.y;
}

}  // namespace polynya::geometry
