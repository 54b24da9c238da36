#include "dynamics/contact/broad_phase.hpp"

#include <algorithm>
#include <utility>

#include "dynamics/chunks.hpp"

namespace polynya::dynamics {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Pose;

/// Margin by which boxes are grown; they are computed again after that much travel [m]. Smaller: pairs are searched
/// more often. Larger: more pairs are kept. Results do not change.
constexpr double kBoxMargin = 2.0;
/// Number of bodies out of their boxes that one thread takes at a time. Results do not change.
constexpr std::size_t kMovedPerChunk = 16;

/// Upper limit for the rounding of fragments' vertices, which is far smaller [m]. If it were smaller than the rounding,
/// fragments that touch could be taken as apart.
constexpr double kPieceRounding = 1e-6;

/// Returns how far a body that breaks can move without touching the other body of the pair; 0 if that is not known [m].
double clearance_of(const Bodies& bodies, const Pair& pair) {
  const Pose pose = centre_a_from_b(bodies, pair.a, pair.b);
  return std::max(0.0, clearance_left(bodies, pair.b, pose, pair.apart) - kPieceRounding);
}

/// Returns true if two bodies may press each other. Two bodies with prescribed motion do not, since no impulse moves
/// them; the exception is a hull in fast ice, which it crushes. Two walls do not either: they represent ice far away
/// and may cross at their ends.
bool can_press(const Bodies& bodies, BodyIndex a, BodyIndex b, bool presses_prescribed) {
  if (is_grounded(bodies.kind[a]) && is_grounded(bodies.kind[b])) return false;
  if (bodies.inverse_mass[a] != 0 || bodies.inverse_mass[b] != 0) return true;
  return presses_prescribed && (bodies.kind[a] == BodyKind::kFloe) != (bodies.kind[b] == BodyKind::kFloe);
}

}  // namespace

Box box_in_water(const Bodies& bodies, BodyIndex i) {
  const Pose pose = water_from_body(bodies, i);
  if (bodies.boundary[i]->edges.size() > 64)
    return geometry::grown({bodies.position[i], bodies.position[i]}, bodies.bounding_radius[i]);
  Box box = {transform(pose, bodies.boundary[i]->edges.vertices.front()), {}};
  box.high = box.low;
  for (const Point p : bodies.boundary[i]->edges.vertices) extend(box, transform(pose, p));
  return box;
}

BroadPhase::BroadPhase(const ContactRule& rule, double grid_cell) : rule_(rule), grid_(grid_cell) {}

void BroadPhase::add(const Bodies& bodies, BodyIndex body) {
  if (entries_.size() <= static_cast<std::size_t>(body)) {
    entries_.resize(static_cast<std::size_t>(body) + 1);
    travel_limits_.resize(static_cast<std::size_t>(body) + 1);
  }
  place(bodies, body, box_in_water(bodies, body));
}

void BroadPhase::place(const Bodies& bodies, BodyIndex body, const Box& box) {
  Entry& entry = entries_[body];
  const Box grown = geometry::grown(box, kBoxMargin);
  if (entry.is_in)
    grid_.move(body, entry.box, grown);
  else
    grid_.insert(body, grown);
  entry.box = grown;
  travel_limits_[body] = bodies.travel[body] + kBoxMargin;
  entry.is_in = true;
}

void BroadPhase::remove(BodyIndex body) {
  Entry& entry = entries_[body];
  leave_movers(body);
  for (const std::uint32_t slot : entry.pairs) {
    const Pair& pair = pairs_[slot];
    std::erase(entries_[pair.a == body ? pair.b : pair.a].pairs, slot);
    mark_dropped(slot);
  }
  entry.pairs.clear();
  kept_pieces_ -= std::exchange(entry.kept_pieces, 0U);
  if (entry.is_in) grid_.remove(body, entry.box);
  entry.is_in = false;
}

bool BroadPhase::may_move(const Bodies& bodies, BodyIndex body) const {
  return bodies.is_awake[body] != 0 && (!rule_.is_culling || !is_held(bodies, body));
}

void BroadPhase::enter_mover(const Bodies& bodies, BodyIndex body) {
  Entry& entry = entries_[body];
  if (entry.mover != kNoMover || !may_move(bodies, body)) return;
  entry.mover = static_cast<std::int32_t>(movers_.size());
  movers_.push_back(body);
}

void BroadPhase::leave_movers(BodyIndex body) {
  const std::int32_t mover = std::exchange(entries_[body].mover, kNoMover);
  if (mover == kNoMover) return;
  const BodyIndex last = movers_.back();
  movers_.pop_back();
  if (last == body) return;
  movers_[mover] = last;
  entries_[last].mover = mover;
}

void BroadPhase::wake(const Bodies& bodies, BodyIndex body) {
  enter_mover(bodies, body);
  add_pairs_of(bodies, body);
}

void BroadPhase::sleep(const Bodies& bodies, BodyIndex body) {
  leave_movers(body);
  own_pairs_ = entries_[body].pairs;
  for (const std::uint32_t pair : own_pairs_) {
    const BodyIndex other = pairs_[pair].a == body ? pairs_[pair].b : pairs_[pair].a;
    if (!may_move(bodies, other)) drop_pair(pair);
  }
}

bool BroadPhase::are_pair(BodyIndex a, BodyIndex b) const {
  const auto& smaller = entries_[a].pairs.size() < entries_[b].pairs.size() ? entries_[a].pairs : entries_[b].pairs;
  return std::ranges::any_of(smaller, [&](std::uint32_t pair) {
    return pairs_[pair].a == std::min(a, b) && pairs_[pair].b == std::max(a, b);
  });
}

void BroadPhase::add_pairs_of(const Bodies& bodies, BodyIndex body) {
  for_new_partners(bodies, body,
                   [&](BodyIndex other) { add_pair(bodies, std::min(body, other), std::max(body, other)); });
}

/// Calls use(other) for each body that overlaps this one's box, may press it, and has no pair with it yet. A body in
/// several cells is passed more than once, unless `use` adds the pair.
template <class Use>
void BroadPhase::for_new_partners(const Bodies& bodies, BodyIndex body, Use use) const {
  const Box box = entries_[body].box;
  const auto consider = [&](BodyIndex other) {
    if (other == body) return;
    if (rule_.is_culling && !overlaps(box, entries_[other].box)) return;
    if (!can_press(bodies, body, other, rule_.presses_prescribed)) return;
    if (!are_pair(body, other)) use(other);
  };
  if (rule_.is_culling && is_held(bodies, body)) {
    for (const BodyIndex other : movers_) consider(other);
    return;
  }
  if (rule_.is_culling) return grid_.for_each_near(box, consider);
  for (BodyIndex other = 0; other < bodies.size(); ++other) {
    if (entries_[other].is_in) consider(other);
  }
}

void BroadPhase::add_pair(const Bodies& bodies, BodyIndex a, BodyIndex b) {
  if (need_covers(bodies, a, b, rule_)) {
    keep_cover(bodies, a);
    keep_cover(bodies, b);
  }
  std::uint32_t slot = 0;
  if (free_pairs_.empty()) {
    slot = static_cast<std::uint32_t>(pairs_.size());
    pairs_.emplace_back();
  } else {
    slot = free_pairs_.back();
    free_pairs_.pop_back();
  }
  Pair& pair = pairs_[slot];
  pair.a = a;
  pair.b = b;
  pair.is_dropped = pair.is_outside = false;
  pair.near.distance = pair.apart.distance = pair.near_bound = -1;
  pair.parts.reset();
  entries_[a].pairs.push_back(slot);
  entries_[b].pairs.push_back(slot);
  new_.push_back({a, b, -1, slot});
}

void BroadPhase::drop_pair(std::uint32_t slot) {
  Pair& pair = pairs_[slot];
  for (const BodyIndex body : {pair.a, pair.b}) {
    auto& own = entries_[body].pairs;
    own.erase(std::find(own.begin(), own.end(), slot));
  }
  mark_dropped(slot);
}

void BroadPhase::mark_dropped(std::uint32_t slot) {
  pairs_[slot].is_dropped = true;
  ++dropped_;
}

void BroadPhase::erase_dropped(std::vector<ActivePair>& list) {
  std::erase_if(list, [&](const ActivePair& active) {
    if (!pairs_[active.slot].is_dropped) return false;
    free_pairs_.push_back(active.slot);
    pairs_[active.slot].parts.reset();
    return true;
  });
}

/// Sorts new pairs into the lists. The long list changes only when enough new pairs have accumulated.
void BroadPhase::merge_new() {
  const auto merge = [](std::vector<ActivePair>& list, std::vector<ActivePair>& more) {
    if (list.empty()) return list.swap(more);
    const auto middle = static_cast<std::ptrdiff_t>(list.size());
    list.insert(list.end(), more.begin(), more.end());
    std::inplace_merge(list.begin(), list.begin() + middle, list.end());
  };
  std::sort(new_.begin(), new_.end());
  merge(recent_, new_);
  new_.clear();
  const std::size_t many = 16 + active_.size() / 8;
  if (dropped_ > many) {
    erase_dropped(active_);
    erase_dropped(recent_);
    dropped_ = 0;
  }
  if (recent_.size() > many) {
    merge(active_, recent_);
    recent_.clear();
  }
}

void BroadPhase::update(const Bodies& bodies, const std::vector<BodyIndex>& awake, double ahead, int threads) {
  moved_.clear();
  for (const BodyIndex body : awake) {
    if (!rule_.is_culling) break;  // every pair exists already
    if (bodies.travel[body] + ahead * bodies.rim_speed[body] > travel_limits_[body]) moved_.push_back(body);
  }
  boxes_.resize(moved_.size());
  for_chunks(moved_.size(), kMovedPerChunk, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) boxes_[i] = box_in_water(bodies, moved_[i]);
  });
  for (std::size_t i = 0; i < moved_.size(); ++i) place(bodies, moved_[i], boxes_[i]);
  const std::size_t chunks = chunk_count(moved_.size(), kMovedPerChunk);
  if (moved_some_.size() < chunks) moved_some_.resize(chunks);
  for_chunks(moved_.size(), kMovedPerChunk, threads, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Moved& moved = moved_some_[chunk];
    moved.parted.clear();
    moved.met.clear();
    for (const BodyIndex body : std::span(moved_).subspan(begin, end - begin)) {
      for (const std::uint32_t pair : entries_[body].pairs)
        if (!overlaps(entries_[pairs_[pair].a].box, entries_[pairs_[pair].b].box)) moved.parted.push_back(pair);
      for_new_partners(bodies, body, [&](BodyIndex other) {
        moved.met.push_back({std::min(body, other), std::max(body, other)});
      });
    }
  });
  for (const Moved& some : std::span(moved_some_).first(chunks)) {
    for (const std::uint32_t pair : some.parted)
      if (!pairs_[pair].is_dropped) drop_pair(pair);
  }
  for (const Moved& some : std::span(moved_some_).first(chunks)) {
    for (const auto& [a, b] : some.met)
      if (!are_pair(a, b)) add_pair(bodies, a, b);
  }
  if (!new_.empty() || dropped_ > 0) merge_new();
}

/// Finds the pairs that may touch now, ordered by (a, b): among the active ones from begin to end, and among the recent
/// ones that belong between these. Returns their number.
std::size_t BroadPhase::find_pending(const Bodies& bodies, std::size_t begin, std::size_t end,
                                     std::vector<ActivePair*>& pending) {
  const auto recent_from = [&](std::size_t i) {
    return i == 0 ? recent_.begin() : std::lower_bound(recent_.begin(), recent_.end(), active_[i]);
  };
  auto recent = recent_from(begin);
  const auto last_recent = end < active_.size() ? recent_from(end) : recent_.end();
  const std::size_t most = end - begin + static_cast<std::size_t>(last_recent - recent);
  if (pending.size() < most) pending.resize(most);
  const double* travel = bodies.travel.data();
  ActivePair** next = pending.data();
  const auto consider = [&](ActivePair& active) {
    const bool is_apart = travel[active.a] + travel[active.b] <= active.separation_bound;
    *next = &active;  // branch-free, because it is unpredictable which pairs may touch
    next += static_cast<int>(!(is_apart & rule_.is_culling));
  };
  for (std::size_t i = begin; i < end; ++i) {
    while (recent != last_recent && *recent < active_[i]) consider(*recent++);
    consider(active_[i]);
  }
  while (recent != last_recent) consider(*recent++);
  return static_cast<std::size_t>(next - pending.data());
}

void BroadPhase::collide(const Bodies& bodies, ActivePair& active, double dt, PairScratch& scratch,
                         std::vector<Contact>& contacts) {
  Pair& pair = pairs_[active.slot];
  if (pair.is_dropped) return;
  if (!rule_.is_culling) pair.near.distance = pair.apart.distance = pair.near_bound = -1;
  const Pose pose = centre_a_from_b(bodies, active.a, active.b);
  double clearance = clearance_left(bodies, active.b, pose, pair.apart);
  if (clearance < kRounding) clearance = collide_pair(bodies, pair, pose, rule_, dt, scratch, contacts);
  const double travelled = bodies.travel[active.a] + bodies.travel[active.b];
  active.separation_bound = travelled + std::max(0.0, clearance - kRounding);
}

/// Returns all pairs that may touch now, ordered by (a, b). Valid until the next call.
std::span<BroadPhase::ActivePair* const> BroadPhase::find_all_pending(const Bodies& bodies, int threads) {
  constexpr std::size_t chunk = 4096;  // number of pairs that a thread takes at a time; does not change results
  const std::size_t chunks = std::max<std::size_t>(1, chunk_count(active_.size(), chunk));
  if (pending_.size() < chunks) pending_.resize(chunks);
  const auto find = [&](std::size_t k, std::size_t begin, std::size_t end) {
    pending_[k].count = find_pending(bodies, begin, end, pending_[k].pairs);
  };
  if (chunks == 1) {
    find(0, 0, active_.size());
    return {pending_[0].pairs.data(), pending_[0].count};
  }
  for_chunks(active_.size(), chunk, threads, find);
  all_pending_.clear();
  for (const auto& [pairs, count] : std::span(pending_).first(chunks))
    all_pending_.insert(all_pending_.end(), pairs.data(), pairs.data() + count);
  return all_pending_;
}

void BroadPhase::collide_share(const Bodies& bodies, std::span<ActivePair* const> pending, double dt,
                               PairScratch& scratch, std::vector<Contact>& contacts) {
  constexpr std::size_t kAhead = 8;  // pairs whose memory is fetched ahead of their turn
  scratch.keeps_distant_edges = static_cast<double>(active_.size()) <= rule_.most_pairs_with_edges;
  for (std::size_t i = 0; i < pending.size(); ++i) {
    if (i + kAhead < pending.size()) __builtin_prefetch(&pairs_[pending[i + kAhead]->slot]);
    if (i + kAhead / 2 < pending.size()) {
      const Pair& pair = pairs_[pending[i + kAhead / 2]->slot];
      __builtin_prefetch(&pair.near);
      __builtin_prefetch(pair.parts.get());
    }
    collide(bodies, *pending[i], dt, scratch, contacts);
  }
  scratch.covers.clear();
}

void BroadPhase::find_contacts(const Bodies& bodies, double dt, std::vector<Contact>& contacts, int threads) {
  constexpr std::size_t kLeastShare = 16;  // smallest number of pairs that is worth another thread
  constexpr std::size_t kMostShares = 64;  // more shares take more memory
  if (!new_.empty() || dropped_ > 0) merge_new();
  const std::span<ActivePair* const> pending = find_all_pending(bodies, threads);
  const std::size_t share = std::max(kLeastShare, chunk_count(pending.size(), kMostShares));
  const std::size_t shares = std::max<std::size_t>(1, chunk_count(pending.size(), share));
  if (shares_.size() < shares) shares_.resize(shares);
  if (shares == 1 || threads == 1) {
    contacts.clear();
    return collide_share(bodies, pending, dt, shares_[0].scratch, contacts);
  }
  for_chunks(pending.size(), share, threads, [&](std::size_t k, std::size_t begin, std::size_t end) {
    shares_[k].contacts.clear();
    collide_share(bodies, pending.subspan(begin, end - begin), dt, shares_[k].scratch, shares_[k].contacts);
  });
  std::size_t count = 0;
  for (Share& of : std::span(shares_).first(shares)) of.first = std::exchange(count, count + of.contacts.size());
  contacts.resize(count);
  for_chunks(shares, 1, threads, [&](std::size_t k, std::size_t, std::size_t) {
    std::ranges::copy(shares_[k].contacts, contacts.begin() + static_cast<std::ptrdiff_t>(shares_[k].first));
  });
}

void BroadPhase::take_inseparable_overlaps(std::vector<InseparableOverlap>& overlaps) {
  overlaps.clear();
  for (Share& share : shares_) {
    overlaps.insert(overlaps.end(), share.scratch.inseparable.begin(), share.scratch.inseparable.end());
    share.scratch.inseparable.clear();
  }
}

void BroadPhase::take_parted(std::vector<PartedContact>& parted) {
  parted.clear();
  for (Share& share : shares_) {
    parted.insert(parted.end(), share.scratch.parted.begin(), share.scratch.parted.end());
    share.scratch.parted.clear();
  }
}

std::int64_t BroadPhase::take_unpaired_stretches() {
  std::int64_t unpaired = 0;
  for (Share& share : shares_) unpaired += std::exchange(share.scratch.unpaired, 0);
  return unpaired;
}

/// Makes and keeps the cover of a body that another one approaches. If too many covers are kept already, it does so
/// only for covers that take long to make (kManyPieces).
void BroadPhase::keep_cover(const Bodies& bodies, BodyIndex body) {
  geometry::Boundary& boundary = *bodies.boundary[body];
  if (boundary.is_ready()) return;
  const double pieces = pieces_of(boundary.edges, rule_.circle_radius);
  const bool is_cheap = pieces <= kManyPieces && !rule_.is_circle_centres;
  if (is_cheap && kept_pieces_ + pieces > rule_.most_kept_pieces) return;
  make_ready(boundary, {rule_.circle_radius, rule_.is_circle_centres});
  entries_[body].kept_pieces = static_cast<std::uint32_t>(boundary.cover->pieces.size());
  kept_pieces_ += entries_[body].kept_pieces;
}

// Contact memory of a body that breaks, and the data about pairs in a saved run.

ContactMemory BroadPhase::contact_memory_of(const Bodies& bodies, BodyIndex parent) const {
  ContactMemory memory;
  for (const std::uint32_t slot : entries_[parent].pairs) {
    const Pair& pair = pairs_[slot];
    const BodyIndex other = pair.a == parent ? pair.b : pair.a;
    if (pair.is_outside) memory.outside.push_back({other, clearance_of(bodies, pair)});
    OverlapMemory overlap{.other = other};
    for (const PersistentContact& record : pair.records()) {
      overlap.paid_area += record.paid_area;
      overlap.area += record.area;
      overlap.booked += record.booked;
      if (record.crushed.area > overlap.crushed.area) overlap.crushed = record.crushed;
    }
    if (overlap.area == 0 && overlap.paid_area == 0) continue;
    if (pair.b == parent) overlap.crushed.a_from_b = inverse(overlap.crushed.a_from_b);
    memory.overlaps.push_back(overlap);
  }
  std::sort(memory.outside.begin(), memory.outside.end(),
            [](const Outside& p, const Outside& q) { return p.other < q.other; });
  return memory;
}

void BroadPhase::note_paid(BodyIndex body) {
  constexpr double kAnyArea = 1e18;  // larger than any overlap [m²]
  PersistentContact record;
  record.paid_area = record.area = kAnyArea;
  record.is_inherited = true;
  for (const std::uint32_t slot : entries_[body].pairs) pairs_[slot].own_parts().records = {record};
}

void BroadPhase::pass_contact_memory(const Bodies& bodies, BodyIndex fragment, const ContactMemory& memory) {
  for (const std::uint32_t slot : entries_[fragment].pairs) {
    Pair& pair = pairs_[slot];
    const BodyIndex other = pair.a == fragment ? pair.b : pair.a;
    const auto outside = std::lower_bound(memory.outside.begin(), memory.outside.end(), other,
                                          [](const Outside& o, BodyIndex body) { return o.other < body; });
    pair.is_outside = outside != memory.outside.end() && outside->other == other;
    if (pair.is_outside && outside->clearance > 0)
      pair.apart = {centre_a_from_b(bodies, pair.a, pair.b), outside->clearance};
    for (const OverlapMemory& old : memory.overlaps) {
      if (old.other != other) continue;
      PersistentContact record;
      record.paid_area = old.paid_area;
      record.area = old.area;
      record.booked = old.booked;
      record.crushed = old.crushed;  // a fragment has its floe's frame
      if (pair.b == fragment) record.crushed.a_from_b = inverse(record.crushed.a_from_b);
      record.is_inherited = true;
      pair.own_parts().records.push_back(record);
    }
  }
}

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
  // The boxes are new, so boxes may overlap that did not before.
  for (BodyIndex body = 0; body < bodies.size(); ++body) {
    if (bodies.is_awake[body] == 0) continue;
    enter_mover(bodies, body);
    add_pairs_of(bodies, body);
  }
}

}  // namespace polynya::dynamics
