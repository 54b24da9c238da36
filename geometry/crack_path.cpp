#include "geometry/crack_path.hpp"

#include <algorithm>
#include <vector>

namespace polynya::geometry {
namespace {

/// Distances along the line through the point at which it crosses the boundary, in order [m].
std::vector<double> crossings_of_line(const EdgeList& edges, Point point, Vector direction) {
  std::vector<double> at;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const double from = cross(direction, edges.from(e) - point);
    const double to = cross(direction, edges.to(e) - point);
    if ((from > 0) == (to > 0)) continue;
    const double t = from / (from - to);
    at.push_back(dot(direction, edges.from(e) + t * (edges.to(e) - edges.from(e)) - point));
  }
  std::sort(at.begin(), at.end());
  return at;
}

}  // namespace

CrackPath crack_path(const EdgeList& edges, Point point, Vector direction, double margin) {
  const std::vector<double> at = crossings_of_line(edges, point, direction);
  CrackPath path{point - margin * direction, point + margin * direction, 0};
  // The line is in ice between crossings 0–1, 2–3, …: an even count, since every ring is closed.
  double start = -margin;
  for (std::size_t i = 0; i + 1 < at.size(); i += 2) {
    if (at[i + 1] <= 0) continue;
    if (at[i] <= 0) start = at[i] - margin;  // the point lies in this stretch of ice: begin behind it
    path.length_in_ice += at[i + 1] - std::max(0.0, at[i]);
    path.end = point + (at[i + 1] + margin) * direction;
  }
  path.start = point + start * direction;
  return path;
}

}  // namespace polynya::geometry
