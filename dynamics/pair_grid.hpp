#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "dynamics/bodies.hpp"

namespace polynya::dynamics {

/// Square cells over the water, each with the bodies whose grown boxes touch it. Unbounded: cells are hashed.
class PairGrid {
 public:
  explicit PairGrid(double cell) : cell_(cell) {}

  void insert(BodyIndex body, const geometry::Box& box);
  void remove(BodyIndex body, const geometry::Box& box);

  /// Calls visit(other) for each body in the cells of the box; one that spans several of them comes several
  /// times.
  template <typename Visit>
  void for_each_near(const geometry::Box& box, Visit visit) const {
    for (const BodyIndex other : wide_) visit(other);
    if (is_wide(box)) {
      for (const auto& cell : cells_) {
        for (const BodyIndex other : cell.second) visit(other);
      }
      return;
    }
    for_cells(box, [&](std::int64_t key) {
      const auto cell = cells_.find(key);
      if (cell == cells_.end()) return;
      for (const BodyIndex other : cell->second) visit(other);
    });
  }

 private:
  template <typename Visit>
  void for_cells(const geometry::Box& box, Visit visit) const {
    const auto index = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell_)); };
    for (std::int64_t row = index(box.low.y); row <= index(box.high.y); ++row) {
      for (std::int64_t column = index(box.low.x); column <= index(box.high.x); ++column) {
        visit((row << 32) ^ (column & 0xffffffff));
      }
    }
  }

  /// One that spans more cells than this is kept apart, near everybody: cells are for the many.
  static constexpr double kMostCells = 65536;
  bool is_wide(const geometry::Box& box) const {
    return ((box.high.x - box.low.x) / cell_ + 1) * ((box.high.y - box.low.y) / cell_ + 1) > kMostCells;
  }

  double cell_;  ///< [m]
  std::vector<BodyIndex> wide_;
  std::unordered_map<std::int64_t, std::vector<BodyIndex>> cells_;
};

}  // namespace polynya::dynamics
