#include <algorithm>

#include "dynamics/pairs.hpp"

namespace polynya::dynamics {

std::vector<PairMemory> BroadPhase::memory() const {
  std::vector<PairMemory> memory;
  for (const std::vector<ActivePair>* list : {&active_, &recent_, &new_}) {
    for (const ActivePair& active : *list) {
      const Pair& pair = pairs_[active.slot];
      if (!pair.is_dropped) memory.push_back({active.a, active.b, active.separation_bound, pair.records});
    }
  }
  std::sort(memory.begin(), memory.end(),
            [](const PairMemory& p, const PairMemory& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
  return memory;
}

void BroadPhase::remember(const Bodies& bodies, const std::vector<PairMemory>& memory) {
  for (const PairMemory& pair : memory) {
    add_pair(bodies, pair.a, pair.b);
    new_.back().separation_bound = pair.separation_bound;
    pairs_[new_.back().slot].records = pair.records;
  }
  // The boxes are new, so some may meet that did not before.
  for (BodyIndex body = 0; body < bodies.size(); ++body) {
    if (bodies.is_awake[body] != 0) connect(bodies, body);
  }
}

}  // namespace polynya::dynamics
