#include "dynamics/pair_grid.hpp"

#include <algorithm>

namespace polynya::dynamics {

void PairGrid::insert(BodyIndex body, const geometry::Box& box) {
  if (is_wide(box)) return wide_.push_back(body);
  for_cells(box, [&](std::int64_t key) { cells_[key].push_back(body); });
}

void PairGrid::remove(BodyIndex body, const geometry::Box& box) {
  const auto take_out = [body](std::vector<BodyIndex>& bodies) {
    const auto at = std::find(bodies.begin(), bodies.end(), body);
    if (at == bodies.end()) return;
    *at = bodies.back();
    bodies.pop_back();
  };
  if (is_wide(box)) return take_out(wide_);
  for_cells(box, [&](std::int64_t key) { take_out(cells_[key]); });
}

}  // namespace polynya::dynamics
