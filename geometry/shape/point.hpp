#pragma once

#include <cmath>

namespace polynya::geometry {

/// A displacement, direction or velocity in the plane. Units are those of its use, [m] where none are named.
struct Vector {
  double x = 0;
  double y = 0;
  friend bool operator==(const Vector&, const Vector&) = default;
};

/// A position in the plane [m]. Which frame it is in stands in the name of the variable that holds it.
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
/// z component of a × b.
constexpr double cross(Vector a, Vector b) {
  return a.x * b.y - a.y * b.x;
}
/// ω × r for an angular velocity ω about z [rad/s].
constexpr Vector cross(double omega, Vector r) {
  return {-omega * r.y, omega * r.x};
}
/// The vector turned by +90°.
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
constexpr Point midpoint(Point a, Point b) {
  return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
}

}  // namespace polynya::geometry
