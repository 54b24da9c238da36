#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/shape/power_diagram.hpp"

namespace polynya::geometry {

/// Sites, or some of them, in square bins over a box, about one a bin.
class SiteBins {
 public:
  SiteBins(const std::vector<Site>& sites, const Box& box) : SiteBins(sites, every(sites.size()), box) {}

  SiteBins(const std::vector<Site>& sites, const std::vector<std::uint32_t>& chosen, const Box& box)
      : low_(box.low) {
    const Vector extent = box.high - box.low;
    const auto count = static_cast<double>(chosen.size());
    side_ = std::max({std::sqrt(extent.x * extent.y / count), extent.x / 1e6, extent.y / 1e6});
    columns_ = 1 + static_cast<int>(extent.x / side_);
    rows_ = 1 + static_cast<int>(extent.y / side_);
    first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    for (const std::uint32_t i : chosen) ++first_[bin_at(sites[i].point) + 1];
    for (std::size_t bin = 1; bin < first_.size(); ++bin) first_[bin] += first_[bin - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    members_.resize(chosen.size());
    for (const std::uint32_t i : chosen) members_[next[bin_at(sites[i].point)]++] = i;
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
  static std::vector<std::uint32_t> every(std::size_t count) {
    std::vector<std::uint32_t> all(count);
    for (std::size_t i = 0; i < count; ++i) all[i] = static_cast<std::uint32_t>(i);
    return all;
  }
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

}  // namespace polynya::geometry
