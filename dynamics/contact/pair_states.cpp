// What a saved run keeps of the pairs of bodies, and back.

#include <algorithm>

#include "dynamics/contact/broad_phase.hpp"

namespace polynya::dynamics {

template <class Wanted>
std::vector<PairState> BroadPhase::states_where(Wanted is_wanted) const {
  std::vector<PairState> states;
  for (const std::vector<ActivePair>* list : {&active_, &recent_, &new_}) {
    for (const ActivePair& active : *list) {
      const Pair& pair = pairs_[active.slot];
      if (pair.is_dropped || !is_wanted(pair)) continue;
      const auto records = pair.records();
      states.push_back({active.a, active.b, active.separation_bound, {records.begin(), records.end()}});
    }
  }
  std::sort(states.begin(), states.end(),
            [](const PairState& p, const PairState& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
  return states;
}

std::vector<PairState> BroadPhase::pair_states() const {
  return states_where([](const Pair&) { return true; });
}

std::vector<PairState> BroadPhase::touching_states() const {
  return states_where([](const Pair& pair) { return !pair.records().empty(); });
}

void BroadPhase::restore(const Bodies& bodies, const std::vector<PairState>& pairs) {
  for (const PairState& pair : pairs) {
    add_pair(bodies, pair.a, pair.b);
    new_.back().separation_bound = pair.separation_bound;
    if (!pair.records.empty()) pairs_[new_.back().slot].own_parts().records = pair.records;
  }
  // The boxes are new, so some may meet that did not before.
  for (BodyIndex body = 0; body < bodies.size(); ++body) {
    if (bodies.is_awake[body] == 0) continue;
    enter_mover(bodies, body);
    add_pairs_of(bodies, body);
  }
}

}  // namespace polynya::dynamics
