#include <algorithm>

#include "dynamics/broad_phase.hpp"

namespace polynya::dynamics {

std::vector<PairState> BroadPhase::pair_states() const {
  std::vector<PairState> states;
  for (const std::vector<ActivePair>* list : {&active_, &recent_, &new_}) {
    for (const ActivePair& active : *list) {
      const Pair& pair = pairs_[active.slot];
      if (!pair.is_dropped) states.push_back({active.a, active.b, active.separation_bound, pair.records});
    }
  }
  std::sort(states.begin(), states.end(),
            [](const PairState& p, const PairState& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
  return states;
}

void BroadPhase::restore(const Bodies& bodies, const std::vector<PairState>& pairs) {
  for (const PairState& pair : pairs) {
    add_pair(bodies, pair.a, pair.b);
    new_.back().separation_bound = pair.separation_bound;
    pairs_[new_.back().slot].records = pair.records;
  }
  // The boxes are new, so some may meet that did not before.
  for (BodyIndex body = 0; body < bodies.size(); ++body) {
    if (bodies.is_awake[body] == 0) continue;
    enter_mover(bodies, body);
    add_pairs_of(bodies, body);
  }
}

}  // namespace polynya::dynamics
