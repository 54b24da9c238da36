#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "dynamics/bodies.hpp"

namespace polynya::dynamics {

/// Square cells over the water, each with the bodies whose boxes touch it. Unbounded: cells are hashed.
class HashGrid {
 public:
  explicit HashGrid(double cell) : cell_(cell) {}

  void insert(BodyIndex body, const geometry::Box& box) {
    if (is_wide(box)) return wide_.push_back(body);
    for_cells(box, [&](std::int64_t key) { cells_[key].push_back(body); });
  }

  void remove(BodyIndex body, const geometry::Box& box) {
    const auto erase = [body](std::vector<BodyIndex>& bodies) {
      const auto at = std::find(bodies.begin(), bodies.end(), body);
      if (at == bodies.end()) return;
      *at = bodies.back();
      bodies.pop_back();
    };
    if (is_wide(box)) return erase(wide_);
    for_cells(box, [&](std::int64_t key) { erase(cells_[key]); });
  }

  /// Calls function(other) for each body in the cells of the box, once per common cell.
  template <typename Function>
  void for_each_near(const geometry::Box& box, Function function) const {
    for (const BodyIndex other : wide_) function(other);
    if (is_wide(box)) {
      for (const auto& cell : cells_) {
        for (const BodyIndex other : cell.second) function(other);
      }
      return;
    }
    for_cells(box, [&](std::int64_t key) {
      const auto cell = cells_.find(key);
      if (cell == cells_.end()) return;
      for (const BodyIndex other : cell->second) function(other);
    });
  }

 private:
  template <typename Function>
  void for_cells(const geometry::Box& box, Function function) const {
    const auto index = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell_)); };
    for (std::int64_t row = index(box.low.y); row <= index(box.high.y); ++row) {
      for (std::int64_t column = index(box.low.x); column <= index(box.high.x); ++column) {
        function((row << 32) ^ (column & 0xffffffff));
      }
    }
  }

  /// A body that spans more cells than this is in no cell but near all bodies.
  static constexpr double kMostCells = 65536;
  bool is_wide(const geometry::Box& box) const {
    return ((box.high.x - box.low.x) / cell_ + 1) * ((box.high.y - box.low.y) / cell_ + 1) > kMostCells;
  }

  double cell_;  ///< [m]
  std::vector<BodyIndex> wide_;
  std::unordered_map<std::int64_t, std::vector<BodyIndex>> cells_;
};

}  // namespace polynya::dynamics
