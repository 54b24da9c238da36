#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "dynamics/bodies.hpp"

namespace polynya::dynamics {

/// Square cells over the water; each has the bodies whose boxes touch it. The grid is unbounded, since cells are
/// hashed. Bodies that are much smaller than a cell are in grids with finer cells. Otherwise all pieces of a broken
/// plate would be in the one cell that the plate had.
class HashGrid {
 public:
  /// `cell` is the side of the cells of the coarsest grid [m].
  explicit HashGrid(double cell) {
    for (Level& level : levels_) {
      level.cell = cell;
      cell /= kFiner;
    }
  }

  void insert(BodyIndex body, const geometry::Box& box) {
    if (is_wide(box)) return wide_.push_back(body);
    Level& level = level_of(box);
    for_cells(level.cell, box, [&](std::int64_t key) { level.cells[key].push_back(body); });
  }

  void remove(BodyIndex body, const geometry::Box& box) {
    const auto erase = [body](std::vector<BodyIndex>& bodies) {
      const auto at = std::find(bodies.begin(), bodies.end(), body);
      if (at == bodies.end()) return;
      *at = bodies.back();
      bodies.pop_back();
    };
    if (is_wide(box)) return erase(wide_);
    Level& level = level_of(box);
    for_cells(level.cell, box, [&](std::int64_t key) { erase(level.cells[key]); });
  }

  /// Updates a body whose box has moved; it usually stays within the same cells.
  void move(BodyIndex body, const geometry::Box& from, const geometry::Box& to) {
    if (!is_wide(from) && !is_wide(to) && &level_of(from) == &level_of(to)) {
      const double cell = level_of(to).cell;
      if (cell_of(from.low, cell) == cell_of(to.low, cell) && cell_of(from.high, cell) == cell_of(to.high, cell))
        return;
    }
    remove(body, from);
    insert(body, to);
  }

  /// Calls function(other) for each body in the cells of the box, once for each common cell. It also passes bodies
  /// farther away, if looking up the cells costs more than going through all of a level. The caller compares the boxes.
  template <typename Function>
  void for_each_near(const geometry::Box& box, Function function) const {
    for (const BodyIndex other : wide_) function(other);
    for (const Level& level : levels_) for_each_in(level, box, function);
  }

 private:
  struct Level {
    double cell = 0;  ///< side of the cells [m]
    std::unordered_map<std::int64_t, std::vector<BodyIndex>> cells;
  };
  // The following numbers change only the computing time.
  /// Side of a level's cells / side of the cells of the next, finer level [-]. Larger values put more small bodies into
  /// one cell; with smaller ones, the levels cover a smaller range of sizes.
  static constexpr double kFiner = 8;
  /// Boxes of up to this many cells are looked up cell by cell. Larger boxes are looked up so only if the level has at
  /// least as many used cells; otherwise all its bodies are passed.
  static constexpr double kFewCells = 64;
  /// A body whose box spans more cells of the coarsest level is in none of them, and is passed for every box.
  static constexpr double kMostCells = 65536;

  /// Column and row of a point's cell.
  static std::array<std::int64_t, 2> cell_of(geometry::Point p, double cell) {
    return {static_cast<std::int64_t>(std::floor(p.x / cell)), static_cast<std::int64_t>(std::floor(p.y / cell))};
  }

  template <typename Function>
  static void for_cells(double cell, const geometry::Box& box, Function function) {
    const auto [first_column, first_row] = cell_of(box.low, cell);
    const auto [last_column, last_row] = cell_of(box.high, cell);
    for (std::int64_t row = first_row; row <= last_row; ++row) {
      for (std::int64_t column = first_column; column <= last_column; ++column)
        function((row << 32) ^ (column & 0xffffffff));
    }
  }

  template <typename Function>
  static void for_each_in(const Level& level, const geometry::Box& box, Function function) {
    if (level.cells.empty()) return;
    const auto used = static_cast<double>(level.cells.size());
    if (cells_of(level.cell, box) > std::clamp(used, kFewCells, kMostCells)) {
      for (const auto& cell : level.cells) {
        for (const BodyIndex other : cell.second) function(other);
      }
      return;
    }
    for_cells(level.cell, box, [&](std::int64_t key) {
      const auto cell = level.cells.find(key);
      if (cell == level.cells.end()) return;
      for (const BodyIndex other : cell->second) function(other);
    });
  }

  /// About how many cells a box touches; at least one.
  static double cells_of(double cell, const geometry::Box& box) {
    return ((box.high.x - box.low.x) / cell + 1) * ((box.high.y - box.low.y) / cell + 1);
  }
  bool is_wide(const geometry::Box& box) const { return cells_of(levels_.front().cell, box) > kMostCells; }

  /// Returns the finest level whose cells are not smaller than the box, which is then in at most four cells. For larger
  /// boxes it is the coarsest level.
  Level& level_of(const geometry::Box& box) {
    const double size = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
    std::size_t i = 0;
    while (i + 1 < levels_.size() && levels_[i + 1].cell >= size) ++i;
    return levels_[i];
  }

  std::vector<BodyIndex> wide_;
  std::array<Level, 4> levels_;
};

}  // namespace polynya::dynamics
