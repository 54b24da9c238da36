#include "simulation/ship/pattern.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace polynya::simulation {

using geometry::Point;
using geometry::Vector;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kCorners = 32;  ///< of a full turn

void add_arc(Point centre, Vector half_axes, double from, double to, int legs, geometry::Ring& ring) {
  for (int i = 0; i <= legs; ++i) {
    const double angle = from + (to - from) * i / legs;
    ring.push_back(centre + Vector{half_axes.x * std::cos(angle), half_axes.y * std::sin(angle)});
  }
}

geometry::Ring corners_of(const ManagingPilot& pilot) {
  const double far = pilot.distance + 0.5 * pilot.depth;
  const double near = pilot.distance - 0.5 * pilot.depth;
  const double half = 0.5 * pilot.width;
  geometry::Ring ring;
  switch (pilot.pattern) {
    case ManagementPattern::kLinear:
      ring = {{far, -half}, {far, half}, {near, half}, {near, -half}};
      break;
    case ManagementPattern::kSector: {
      const double angle = half / pilot.distance;
      add_arc({}, {far, far}, -angle, angle, kCorners / 2, ring);
      add_arc({}, {near, near}, angle, -angle, kCorners / 2, ring);
      break;
    }
    case ManagementPattern::kRacetrack: {
      const double radius = 0.5 * pilot.depth;
      add_arc({pilot.distance, half - radius}, {radius, radius}, 0, kPi, kCorners / 2, ring);
      add_arc({pilot.distance, radius - half}, {radius, radius}, kPi, 2 * kPi, kCorners / 2, ring);
      break;
    }
    case ManagementPattern::kCircular:
    case ManagementPattern::kLargestFloe:
      add_arc({pilot.distance, 0}, {0.5 * pilot.depth, half}, 0, 2 * kPi, kCorners, ring);
      break;
  }
  return ring;
}

}  // namespace

std::size_t PatternLine::leg_at(double place) const {
  const auto after = std::upper_bound(way.begin() + 1, way.end() - 1, place);
  return static_cast<std::size_t>(after - way.begin()) - 1;
}

Point PatternLine::at(double place) const {
  const std::size_t leg = leg_at(place);
  return corners[leg] + (place - way[leg]) * direction(leg);
}

Vector PatternLine::direction(std::size_t leg) const {
  return (corners[next(leg)] - corners[leg]) / (way[leg + 1] - way[leg]);
}

bool PatternLine::is_sharp_after(std::size_t leg) const {
  return dot(direction(leg), direction(next(leg))) < 0.5;
}

PatternLine line_of(const ManagingPilot& pilot) {
  constexpr double kShortest = 1e-3;  // of a leg [m]
  PatternLine line;
  for (const Point corner : corners_of(pilot))
    if (line.corners.empty() || distance(line.corners.back(), corner) > kShortest) line.corners.push_back(corner);
  while (line.corners.size() > 2 && distance(line.corners.back(), line.corners.front()) <= kShortest)
    line.corners.pop_back();
  line.way.push_back(0);
  for (std::size_t i = 0; i < line.corners.size(); ++i)
    line.way.push_back(line.way.back() + distance(line.corners[i], line.corners[line.next(i)]));
  return line;
}

double least_distance(const PatternLine& line, double ahead) {
  constexpr int kPlaces = 360;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kPlaces; ++i) {
    const double place = line.lap() * i / kPlaces;
    least = std::min(least, distance(line.at(place), line.at(std::fmod(place + ahead * line.lap(), line.lap()))));
  }
  return least;
}

}  // namespace polynya::simulation
