#include "geometry/cut/overlapping_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "geometry/cut/cut.hpp"
#include "geometry/cut/overlap.hpp"

namespace polynya::geometry {
namespace {

bool overlap_deeply(const Box& a, const Box& b) {
  return std::min(a.high.x, b.high.x) - std::max(a.low.x, b.low.x) > kTouchingDepth &&
         std::min(a.high.y, b.high.y) - std::max(a.low.y, b.low.y) > kTouchingDepth;
}

/// Shared area of two valid polygons [m²], found exactly.
double area_in_common(const Polygon& a, const Polygon& b) {
  const auto cut = cut_by_polygon({a}, b);
  if (cut) return cut->ledger.area_inside;
  return cut.error().reason == CutFailure::kMisses ? 0 : std::numeric_limits<double>::quiet_NaN();
}

/// Square cells over all boxes, about as many as there are boxes; each lists the boxes that reach into it.
class Grid {
 public:
  explicit Grid(const std::vector<Box>& boxes) : all_(boxes.front()) {
    for (const Box& box : boxes) extend(all_, box);
    const Vector extent = all_.high - all_.low;
    const auto count = static_cast<double>(boxes.size());
    cell_ = std::max({std::sqrt(extent.x * extent.y / count), extent.x / count, extent.y / count, 1e-3});
    columns_ = 1 + static_cast<std::size_t>(extent.x / cell_);
    rows_ = 1 + static_cast<std::size_t>(extent.y / cell_);
    cells_.resize(columns_ * rows_);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for_cells(boxes[i], [&](std::size_t cell) { cells_[cell].push_back(i); });
    }
  }

  std::size_t cell_at(Point p) const { return row(p.y) * columns_ + column(p.x); }
  const std::vector<std::vector<std::size_t>>& cells() const { return cells_; }

 private:
  std::size_t column(double x) const {
    return std::min(columns_ - 1, static_cast<std::size_t>((x - all_.low.x) / cell_));
  }
  std::size_t row(double y) const {
    return std::min(rows_ - 1, static_cast<std::size_t>((y - all_.low.y) / cell_));
  }
  template <class Use>
  void for_cells(const Box& box, Use use) const {
    for (std::size_t r = row(box.low.y); r <= row(box.high.y); ++r) {
      for (std::size_t c = column(box.low.x); c <= column(box.high.x); ++c) use(r * columns_ + c);
    }
  }

  Box all_;
  double cell_ = 1;
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
};

}  // namespace

std::vector<OverlappingPair> find_overlapping_pairs(const std::vector<Polygon>& polygons, std::size_t most) {
  std::vector<OverlappingPair> found;
  if (polygons.empty()) return found;
  std::vector<Box> boxes;
  boxes.reserve(polygons.size());
  for (const Polygon& polygon : polygons) boxes.push_back(bounding_box(polygon.outer));
  const Grid grid(boxes);
  for (std::size_t cell = 0; cell < grid.cells().size() && found.size() < most; ++cell) {
    const auto& here = grid.cells()[cell];
    for (std::size_t i = 0; i < here.size() && found.size() < most; ++i) {
      for (std::size_t j = i + 1; j < here.size() && found.size() < most; ++j) {
        const Box& a = boxes[here[i]];
        const Box& b = boxes[here[j]];
        if (!overlap_deeply(a, b)) continue;
        // A pair is tested once, in the cell that holds the corner of what their boxes share.
        if (grid.cell_at({std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y)}) != cell) continue;
        const Polygon& p = polygons[here[i]];
        const Polygon& q = polygons[here[j]];
        if (has_separating_edge(p.outer, q.outer, kTouchingDepth, kTouchingDepth) ||
            has_separating_edge(q.outer, p.outer, kTouchingDepth, kTouchingDepth))
          continue;
        const double area = area_in_common(p, q);
        if (!(area <= kTouchingArea)) found.push_back({here[i], here[j], area});
      }
    }
  }
  std::ranges::sort(found, {}, [](const OverlappingPair& o) { return std::tuple(o.first, o.second); });
  return found;
}

}  // namespace polynya::geometry
