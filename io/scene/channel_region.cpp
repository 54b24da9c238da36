#include "io/scene/channel_region.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Ring;
using geometry::Vector;

/// From the line to its port side at a point: half the width away from both legs.
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

}  // namespace

ChannelRegion channel_region(const std::vector<Point>& line, double width) {
  ChannelRegion region;
  const std::size_t last = line.size() - 1;
  std::vector<Vector> to_port;
  for (std::size_t i = 0; i <= last; ++i) {
    const Vector before = line[i == 0 ? 1 : i] - line[i == 0 ? 0 : i - 1];
    const Vector after = line[i == last ? last : i + 1] - line[i == last ? last - 1 : i];
    to_port.push_back(mitre(before, after, 0.5 * width));
  }
  for (std::size_t i = 0; i < last; ++i) {
    Ring part{line[i] - to_port[i], line[i + 1] - to_port[i + 1], line[i + 1] + to_port[i + 1],
              line[i] + to_port[i]};
    if (!is_convex(part) && region.too_sharp < 0)
      region.too_sharp = static_cast<int>(
          i == 0 || (i < last - 1 && squared_length(to_port[i + 1]) > squared_length(to_port[i])) ? i + 1
                                                                                                  : i);
    region.parts.push_back(std::move(part));
  }
  for (std::size_t i = 0; i <= last; ++i) region.outline.push_back(line[i] - to_port[i]);
  for (std::size_t i = last + 1; i-- > 0;) region.outline.push_back(line[i] + to_port[i]);
  return region;
}

}  // namespace polynya::io
