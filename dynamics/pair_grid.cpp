#include "dynamics/pair_grid.hpp"

#include <algorithm>

namespace polynya::dynamics {

void PairGrid::insert(BodyIndex body, const geometry::Box& box) {
  for_cells(box, [&](std::int64_t key) { cells_[key].push_back(body); });
}

void PairGrid::remove(BodyIndex body, const geometry::Box& box) {
  for_cells(box, [&](std::int64_t key) {
    auto& bodies = cells_[key];
    const auto at = std::find(bodies.begin(), bodies.end(), body);
    if (at == bodies.end()) return;
    *at = bodies.back();
    bodies.pop_back();
  });
}

}  // namespace polynya::dynamics
