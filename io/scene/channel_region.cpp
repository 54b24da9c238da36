#include "io/scene/channel_region.hpp"

#include <cstddef>

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Ring;
using geometry::Vector;

/// Returns the vector from a point of the line to the port side of the strip, which is half the width away from both
/// legs.
Vector mitre(Vector before, Vector after, double half) {
  const Vector a = perpendicular(before) / length(before);
  const Vector b = perpendicular(after) / length(after);
  const double share = 1 + dot(a, b);
  return share > 0.02 ? half / share * (a + b) : Vector{};  // else the line turns back on itself
}

bool is_convex(const Ring& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!(cross(ring[(i + 1) % n] - ring[i], ring[(i + 2) % n] - ring[(i + 1) % n]) > 0)) return false;
  }
  return true;
}

/// Returns the vectors from the points of a line to the port side of a strip of the given width [m].
std::vector<Vector> sides_of(const std::vector<Point>& line, double width) {
  const std::size_t last = line.size() - 1;
  std::vector<Vector> to_port;
  for (std::size_t i = 0; i <= last; ++i) {
    const Vector before = line[i == 0 ? 1 : i] - line[i == 0 ? 0 : i - 1];
    const Vector after = line[i == last ? last : i + 1] - line[i == last ? last - 1 : i];
    to_port.push_back(mitre(before, after, 0.5 * width));
  }
  return to_port;
}

}  // namespace

ChannelRegion channel_region(const std::vector<Point>& line, double width) {
  ChannelRegion region;
  const std::size_t last = line.size() - 1;
  const std::vector<Vector> to_port = sides_of(line, width);
  for (std::size_t i = 0; i < last; ++i) {
    Ring part{line[i] - to_port[i], line[i + 1] - to_port[i + 1], line[i + 1] + to_port[i + 1], line[i] + to_port[i]};
    if (!is_convex(part) && region.too_sharp < 0)
      region.too_sharp = static_cast<int>(
          i == 0 || (i < last - 1 && squared_length(to_port[i + 1]) > squared_length(to_port[i])) ? i + 1 : i);
    region.parts.push_back(std::move(part));
  }
  for (std::size_t i = 0; i <= last; ++i) region.outline.push_back(line[i] - to_port[i]);
  for (std::size_t i = last + 1; i-- > 0;) region.outline.push_back(line[i] + to_port[i]);
  return region;
}

std::vector<Ring> strips_beside(const std::vector<Point>& line, double width, double wider) {
  const std::vector<Vector> inner = sides_of(line, width);
  const std::vector<Vector> outer = sides_of(line, wider);
  Ring port, starboard;
  for (std::size_t i = 0; i < line.size(); ++i) port.push_back(line[i] + inner[i]);
  for (std::size_t i = line.size(); i-- > 0;) port.push_back(line[i] + outer[i]);
  for (std::size_t i = 0; i < line.size(); ++i) starboard.push_back(line[i] - outer[i]);
  for (std::size_t i = line.size(); i-- > 0;) starboard.push_back(line[i] - inner[i]);
  return {std::move(port), std::move(starboard)};
}

}  // namespace polynya::io
