#include "io/import/projected_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "elementary/elementary.hpp"
#include "geometry/shape/angle.hpp"
#include "io/import/degrees.hpp"
#include "io/import/gdal.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Ring;
using geometry::Vector;

constexpr double kMetresPerDegree = 111195;  ///< along a meridian of a sphere with the radius of the Earth [m/°]
/// Largest number of times that an edge is halved: enough to divide 1000 km into pieces of 1 m.
constexpr int kMostHalvings = 20;

Vector turned(Vector v, double angle) {
  const double c = elementary::cos(angle), s = elementary::sin(angle);
  return {v.x * c - v.y * s, v.x * s + v.y * c};
}
Point to_system(Point p, const CoordinateFrame& frame) {
  if (frame.is_in_degrees) return in_one_notation(p);
  if (frame.turn == 0) return p - frame.shift;
  return Point{} + turned(p - frame.shift - Point{}, frame.turn);
}
Point from_system(Point p, const CoordinateFrame& frame) {
  if (frame.turn == 0) return p + frame.shift;
  return Point{} + turned(p - Point{}, -frame.turn) + frame.shift;
}

bool has_image(const ProjectedLine& line) {
  return std::ranges::all_of(line.to, is_finite);
}

}  // namespace

CoordinateFrame frame_about(const simulation::GeographicOrigin& origin) {
  // A heading counts clockwise from north, a turn counter-clockwise from east.
  return {.system = fmt::format("+proj=aeqd +lat_0={:.15g} +lon_0={:.15g} +datum=WGS84 +units=m +no_defs +type=crs",
                                geometry::kDegreesPerRadian * origin.latitude,
                                geometry::kDegreesPerRadian * origin.longitude),
          .is_metric = true,
          .turn = std::numbers::pi / 2 - origin.heading};
}

CoordinateFrame in_degrees() {
  return {.system = kDegreesOnEarth, .is_in_degrees = true};
}

Result<std::vector<Point>> project(const std::vector<Point>& points, const CoordinateFrame& from,
                                   const CoordinateFrame& to) {
  std::vector<Point> moved;
  moved.reserve(points.size());
  for (const Point p : points) moved.push_back(to_system(p, from));
  if (from.system != to.system) {
    auto images = transform(moved, from.system, to.system);
    if (!images) return images;
    moved = *std::move(images);
  }
  for (Point& p : moved) p = from_system(p, to);
  return moved;
}

ProjectedLine line_in(const CoordinateFrame& frame, Ring points, bool is_closed) {
  if (is_closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
  if (frame.is_in_degrees) points = continuous(is_closed ? without_seams(std::move(points)) : points, is_closed);
  return {.from = std::move(points), .to = {}, .is_closed = is_closed};
}

Result<> project_vertices(std::vector<ProjectedLine>& lines, const CoordinateFrame& from, const CoordinateFrame& to) {
  std::vector<Point> points;
  for (const ProjectedLine& line : lines) points.insert(points.end(), line.from.begin(), line.from.end());
  const auto images = project(points, from, to);
  if (!images) return fail(images.error());
  auto next = images->begin();
  for (ProjectedLine& line : lines) {
    line.to.assign(next, next + std::ssize(line.from));
    next += std::ssize(line.from);
  }
  return {};
}

namespace {

/// A part of an edge that may need points.
struct Part {
  std::size_t line = 0;
  std::size_t edge = 0;       ///< the edge starts at the point with this index
  double begin = 0, end = 1;  ///< range of the part, as fractions of the edge's length
  std::pair<Point, Point> from, to;
  int halvings = 0;
};

/// A point added to an edge, and its image.
struct Added {
  std::size_t line = 0, edge = 0;
  double place = 0;
  Point from, to;
};

class Densification {
 public:
  Densification(std::vector<ProjectedLine>& lines, const CoordinateFrame& from, const CoordinateFrame& to,
                double tolerance)
      : lines_(lines), from_(from), to_(to), tolerance_(tolerance) {}

  Result<> run() {
    std::vector<Part> parts = edges();
    while (!parts.empty()) {
      auto next = divided(parts);
      if (!next) return fail(next.error());
      parts = *std::move(next);
    }
    insert();
    return {};
  }

 private:
  static constexpr std::array<double, 3> kSamples{0.25, 0.5, 0.75};

  std::vector<Part> edges() const {
    std::vector<Part> parts;
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      const ProjectedLine& line = lines_[k];
      const std::size_t n = line.from.size();
      if (n < 2 || !has_image(line)) continue;
      for (std::size_t i = 0; i + (line.is_closed ? 0 : 1) < n; ++i) {
        Part part{.line = k,
                  .edge = i,
                  .from = {line.from[i], line.from[(i + 1) % n]},
                  .to = {line.to[i], line.to[(i + 1) % n]}};
        if (from_.is_in_degrees) part.from.second.x = longitude_near(part.from.second.x, part.from.first.x);
        if (may_bend(part)) parts.push_back(std::move(part));
      }
    }
    return parts;
  }

  /// Returns true if the image of an edge can leave the straight line by more than the tolerance at all. In degrees
  /// this depends on the latitude: the image of an edge of length l leaves the line by at most l² tan(latitude) / (4
  /// R), with R the radius of the Earth.
  bool may_bend(const Part& part) const {
    const double length_of_image = distance(part.to.first, part.to.second);
    if (length_of_image == 0 && !to_.is_in_degrees) return false;
    if (!from_.is_in_degrees) return true;
    constexpr double kEarthRadius = 6371e3;  // [m]
    const double latitude = std::max(std::abs(part.from.first.y), std::abs(part.from.second.y));
    if (latitude > 89.9) return true;
    return length_of_image * length_of_image * (0.01 + elementary::tan(latitude * geometry::kRadiansPerDegree)) >
           tolerance_ * kEarthRadius;
  }

  static Point at(const std::pair<Point, Point>& ends, double place) {
    return {(1 - place) * ends.first.x + place * ends.second.x, (1 - place) * ends.first.y + place * ends.second.y};
  }

  /// Divides each part whose image is not straight into two, or into four if two would not be enough: a half bends a
  /// quarter as much. Stores the points between the new parts, and returns the new parts.
  Result<std::vector<Part>> divided(const std::vector<Part>& parts) {
    std::vector<Point> samples;
    samples.reserve(kSamples.size() * parts.size());
    for (const Part& part : parts)
      for (const double place : kSamples) samples.push_back(at(part.from, place));
    const auto images = project(samples, from_, to_);
    if (!images) return fail(images.error());
    // Half of the tolerance is used, because the largest deviation may lie between the samples.
    const double most = tolerance_ / 2;
    std::vector<Part> next;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Part& part = parts[i];
      const Point* const from = samples.data() + kSamples.size() * i;
      const Point* const image = images->data() + kSamples.size() * i;
      const double bend = deviation(part, image);
      if (part.halvings >= kMostHalvings || bend <= most) continue;
      const bool is_in_four = bend > 4 * most;
      Part rest = part;
      for (const std::size_t k : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
        if (!is_in_four && k != 1) continue;
        const double place = part.begin + kSamples[k] * (part.end - part.begin);
        added_.push_back({part.line, part.edge, place, from[k], image[k]});
        next.push_back({part.line,
                        part.edge,
                        rest.begin,
                        place,
                        {rest.from.first, from[k]},
                        {rest.to.first, image[k]},
                        part.halvings + (is_in_four ? 2 : 1)});
        rest.begin = place;
        rest.from.first = from[k];
        rest.to.first = image[k];
      }
      rest.halvings = next.back().halvings;
      next.push_back(rest);
    }
    return next;
  }

  /// Largest distance of a part's image from the straight line between its ends, at the samples [m].
  double deviation(const Part& part, const Point* image) const {
    std::pair<Point, Point> chord = part.to;
    Vector scale{1, 1};
    if (to_.is_in_degrees) {
      if (is_pole(chord.first)) chord.first.x = chord.second.x;
      chord.second.x = is_pole(chord.second) ? chord.first.x : longitude_near(chord.second.x, chord.first.x);
      if (std::abs(chord.second.x - chord.first.x) > 90) return std::numeric_limits<double>::infinity();
      const double latitude = (chord.first.y + chord.second.y) / 2;
      scale = {kMetresPerDegree * elementary::cos(latitude * geometry::kRadiansPerDegree), kMetresPerDegree};
    } else if (!to_.is_metric) {
      // Lengths are those of `from` in metres, because the target system may be in feet.
      const double length_to = distance(chord.first, chord.second);
      if (length_to > 0) scale = distance(part.from.first, part.from.second) / length_to * scale;
    }
    const auto scaled = [&](Point q) {
      return Point{scale.x * (q.x - chord.first.x), scale.y * (q.y - chord.first.y)};
    };
    double most = 0;
    for (std::size_t k = 0; k < kSamples.size(); ++k) {
      Point p = image[k];
      if (!is_finite(p)) return 0;
      if (to_.is_in_degrees) p.x = is_pole(p) ? chord.first.x : longitude_near(p.x, chord.first.x);
      const Point nearest = nearest_on_segment(scaled(chord.first), scaled(chord.second), scaled(p));
      most = std::max(most, distance(scaled(p), nearest));
    }
    return most;
  }

  void insert() {
    std::ranges::sort(added_, {}, [](const Added& a) { return std::tuple(a.line, a.edge, a.place); });
    auto next = added_.begin();
    while (next != added_.end()) {
      ProjectedLine& line = lines_[next->line];
      const std::size_t number = next->line;
      ProjectedLine dense{.from = {}, .to = {}, .is_closed = line.is_closed};
      for (std::size_t i = 0; i < line.from.size(); ++i) {
        dense.from.push_back(line.from[i]);
        dense.to.push_back(line.to[i]);
        for (; next != added_.end() && next->line == number && next->edge == i; ++next) {
          dense.from.push_back(next->from);
          dense.to.push_back(next->to);
        }
      }
      line = std::move(dense);
    }
  }

  std::vector<ProjectedLine>& lines_;
  const CoordinateFrame& from_;
  const CoordinateFrame& to_;
  const double tolerance_;
  std::vector<Added> added_;
};

}  // namespace

Result<> add_points(std::vector<ProjectedLine>& lines, const CoordinateFrame& from, const CoordinateFrame& to,
                    double tolerance) {
  if (!(tolerance > 0) || from.system == to.system) return {};
  return Densification(lines, from, to, tolerance).run();
}

Ring image_of(const ProjectedLine& line) {
  if (!line.is_closed) return line.to;
  Ring image;
  for (std::size_t i = 0; i < line.to.size(); ++i)
    if (image.empty() || line.to[i] != image.back()) image.push_back(line.to[i]);
  while (image.size() > 1 && image.back() == image.front()) image.pop_back();
  return image;
}

}  // namespace polynya::io
