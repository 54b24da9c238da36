#include "geometry/shape/power_diagram.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "geometry/shape/site_bins.hpp"

namespace polynya::geometry {
namespace {

/// Leaves of a convex ring what lies within dot(normal, x − origin) ≤ offset.
void clip(Ring& ring, Ring& scratch, Point origin, Vector normal, double offset) {
  scratch.clear();
  double before = dot(normal, ring.back() - origin) - offset;
  Point previous = ring.back();
  for (const Point p : ring) {
    const double side = dot(normal, p - origin) - offset;
    if ((side > 0) != (before > 0)) scratch.push_back(previous + (before / (before - side)) * (p - previous));
    if (side <= 0) scratch.push_back(p);
    previous = p;
    before = side;
  }
  std::swap(ring, scratch);
  if (ring.size() < 3) ring.clear();
}

double squared_reach(const Ring& ring, Point from) {
  double most = 0;
  for (const Point p : ring) most = std::max(most, squared_length(p - from));
  return most;
}

}  // namespace

std::vector<Ring> power_diagram(const std::vector<Site>& sites, const Box& box) {
  std::vector<Ring> cells(sites.size());
  if (sites.empty()) return cells;
  const SiteBins bins(sites, box);
  double heaviest = sites.front().weight;
  for (const Site& site : sites) heaviest = std::max(heaviest, site.weight);
  Ring scratch;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Site& own = sites[i];
    Ring& cell = cells[i];
    cell = {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
    double reach2 = squared_reach(cell, own.point);
    for (int ring = 0; ring <= bins.most_rings() && !cell.empty(); ++ring) {
      // A site at distance d bounds the cell at (d² + w_i − w_j) / 2d: not within its reach R once
      // d ≥ R + √(R² + w_j − w_i).
      const double nearest = (ring - 1) * bins.side();
      const double reach = std::sqrt(reach2);
      if (ring > 1 && nearest >= reach + std::sqrt(reach2 + heaviest - own.weight)) break;
      bins.for_ring(own.point, ring, [&](std::uint32_t j) {
        if (j == i || cell.empty()) return;
        const Vector to = sites[j].point - own.point;
        const double offset = 0.5 * (squared_length(to) + own.weight - sites[j].weight);
        if (offset >= 0 && offset * offset >= squared_length(to) * reach2) return;
        clip(cell, scratch, own.point, to, offset);
        reach2 = cell.empty() ? 0 : squared_reach(cell, own.point);
      });
    }
  }
  return cells;
}

}  // namespace polynya::geometry
