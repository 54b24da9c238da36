#include "geometry/shape/power_diagram.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace polynya::geometry {
namespace {

/// The sites in square bins over the box, about one a bin.
class Bins {
 public:
  Bins(const std::vector<Site>& sites, const Box& box) : low_(box.low) {
    const Vector extent = box.high - box.low;
    side_ = std::max(
        {std::sqrt(extent.x * extent.y / static_cast<double>(sites.size())), extent.x / 1e6, extent.y / 1e6});
    columns_ = 1 + static_cast<int>(extent.x / side_);
    rows_ = 1 + static_cast<int>(extent.y / side_);
    first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    for (const Site& site : sites) ++first_[bin_at(site.point) + 1];
    for (std::size_t bin = 1; bin < first_.size(); ++bin) first_[bin] += first_[bin - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    members_.resize(sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i)
      members_[next[bin_at(sites[i].point)]++] = static_cast<std::uint32_t>(i);
  }

  double side() const { return side_; }
  int most_rings() const { return std::max(columns_, rows_); }

  /// Calls visit(site) for the sites of the bins that are `ring` bins away from the point's.
  template <class Visit>
  void for_ring(Point p, int ring, Visit visit) const {
    const int column = column_of(p.x);
    const int row = row_of(p.y);
    for (int r = std::max(0, row - ring); r <= std::min(rows_ - 1, row + ring); ++r) {
      const bool is_end_row = r == row - ring || r == row + ring;
      const int stride = is_end_row || ring == 0 ? 1 : 2 * ring;
      for (int c = column - ring; c <= column + ring; c += stride) {
        if (c < 0 || c >= columns_) continue;
        const std::size_t bin = index(c, r);
        for (std::uint32_t k = first_[bin]; k < first_[bin + 1]; ++k) visit(members_[k]);
      }
    }
  }

 private:
  int column_of(double x) const {
    return std::clamp(static_cast<int>((x - low_.x) / side_), 0, columns_ - 1);
  }
  int row_of(double y) const { return std::clamp(static_cast<int>((y - low_.y) / side_), 0, rows_ - 1); }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  std::size_t bin_at(Point p) const { return index(column_of(p.x), row_of(p.y)); }

  Point low_;
  double side_ = 1;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::uint32_t> first_;  // of each bin among the members, and the end
  std::vector<std::uint32_t> members_;
};

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
  const Bins bins(sites, box);
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
