#include "dynamics/pairs.hpp"

#include <algorithm>
#include <cassert>

namespace polynya::dynamics {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Pose;
using geometry::Rotation;
using geometry::Vector;

constexpr double kBoxMargin = 2.0;  ///< boxes are grown by this much, and renewed after that much travel [m]
constexpr double kRounding = 1e-9;  ///< of positions and distances, far more than it can be [m]
constexpr double kNearMargin = 0.75;  ///< pieces of boundary within this distance are kept with a pair [m]

Box box_in_water(const Bodies& bodies, BodyIndex i) {
  const Pose pose = water_from_body(bodies, i);
  if (bodies.boundary[i]->edges.size() > 64)
    return geometry::grown({bodies.position[i], bodies.position[i]}, bodies.bounding_radius[i]);
  Box box = {point_in_world(pose, bodies.boundary[i]->edges.vertices.front()), {}};
  box.high = box.low;
  for (const Point p : bodies.boundary[i]->edges.vertices) {
    const Point q = point_in_world(pose, p);
    box.low = {std::min(box.low.x, q.x), std::min(box.low.y, q.y)};
    box.high = {std::max(box.high.x, q.x), std::max(box.high.y, q.y)};
  }
  return box;
}

/// The records of a pair's contacts, brought up to date. A record goes on with the nearest contact that may
/// be the same; one without a contact is over.
class RecordKeeper {
 public:
  RecordKeeper(std::vector<ContactRecord>& records, std::vector<ContactRecord>& scratch, double circle_radius,
               double dt)
      : records_(records), renewed_(scratch), tolerance_(0.25 * circle_radius), dt_(dt) {}

  void renew(Contact* contacts, std::size_t count, const Bodies& bodies) {
    if (count == 1 && records_.size() == 1) {  // nearly always, and then in place
      const Point here = point_in_b(bodies, contacts[0], contacts[0].middle());
      const double reach = tolerance_ + 0.5 * contacts[0].width;
      if (squared_length(here - records_[0].last_point_in_b) > reach * reach)
        records_[0] = new_record(bodies, contacts[0]);
      bring_up_to_date(records_[0], contacts[0], here);
    } else {
      renewed_.clear();
      for (std::size_t i = 0; i < count; ++i) renewed_.push_back(record_of(contacts[i], bodies));
      std::swap(records_, renewed_);
    }
    for (std::size_t i = 0; i < count; ++i) contacts[i].record = &records_[i];
  }

 private:
  static Point point_in_b(const Bodies& bodies, const Contact& c, Point point_in_water) {
    return bodies.centroid[c.b] + rotate_back(bodies.rotation[c.b], point_in_water - bodies.position[c.b]);
  }
  static ContactRecord new_record(const Bodies& bodies, const Contact& c) {
    ContactRecord record;
    record.first_touch_in_b = point_in_b(bodies, c, c.tip_of_b);
    return record;
  }
  ContactRecord record_of(const Contact& c, const Bodies& bodies) {
    const Point here = point_in_b(bodies, c, c.middle());
    ContactRecord* old = nullptr;
    double nearest = tolerance_ + 0.5 * c.width;
    for (ContactRecord& record : records_) {
      const double d = distance(record.last_point_in_b, here);
      if (record.is_continued || d > nearest) continue;
      nearest = d;
      old = &record;
    }
    ContactRecord record = old != nullptr ? *old : new_record(bodies, c);
    if (old != nullptr) old->is_continued = true;
    bring_up_to_date(record, c, here);
    return record;
  }
  void bring_up_to_date(ContactRecord& record, const Contact& c, Point here) const {
    record.last_point_in_b = here;
    record.age += dt_;
    record.approach += std::max(0.0, c.approach_speed) * dt_;
    record.crushed_depth = std::min(record.crushed_depth, c.depth);
  }

  std::vector<ContactRecord>& records_;
  std::vector<ContactRecord>& renewed_;
  double tolerance_;  // between a contact's places in two steps, beside half its width [m]
  double dt_;
};

/// What is left of the way that `known` holds for, b being at `place` [m].
double way_left(const Bodies& bodies, BodyIndex b, const Pose& place, const KnownNear& known) {
  if (known.way < 0) return known.way;
  const Rotation was = known.a_from_b.rotation;
  const Vector turn{place.rotation.cosine - was.cosine, place.rotation.sine - was.sine};  // as a chord
  return known.way - distance(place.position, known.a_from_b.position) -
         length(turn) * bodies.bounding_radius[b];
}

}  // namespace

PairFinder::PairFinder(const ContactRule& rule, double grid_cell) : rule_(rule), grid_(grid_cell) {}

void PairFinder::add(const Bodies& bodies, BodyIndex body) {
  if (entries_.size() <= static_cast<std::size_t>(body)) entries_.resize(static_cast<std::size_t>(body) + 1);
  place(bodies, body);
}

void PairFinder::place(const Bodies& bodies, BodyIndex body) {
  Entry& entry = entries_[body];
  if (entry.is_in) grid_.remove(body, entry.box);
  entry.box = geometry::grown(box_in_water(bodies, body), kBoxMargin);
  entry.travel_limit = bodies.travel[body] + kBoxMargin;
  grid_.insert(body, entry.box);
  entry.is_in = true;
}

void PairFinder::remove(BodyIndex body) {
  Entry& entry = entries_[body];
  while (!entry.pairs.empty()) drop_pair(entry.pairs.back());
  if (entry.is_in) grid_.remove(body, entry.box);
  entry.is_in = false;
}

void PairFinder::wake(const Bodies& bodies, BodyIndex body) {
  connect(bodies, body);
}

void PairFinder::sleep(const Bodies& bodies, BodyIndex body) {
  own_pairs_ = entries_[body].pairs;
  for (const std::uint32_t pair : own_pairs_) {
    const BodyIndex other = pairs_[pair].a == body ? pairs_[pair].b : pairs_[pair].a;
    if (!bodies.is_awake[other]) drop_pair(pair);
  }
}

void PairFinder::connect(const Bodies& bodies, BodyIndex body) {
  const Box box = entries_[body].box;
  const auto meet = [&](BodyIndex other) {
    if (other == body) return;
    if (rule_.is_culling && !overlaps(box, entries_[other].box)) return;
    if (bodies.inverse_mass[body] == 0 && bodies.inverse_mass[other] == 0)
      return;  // nothing could come of it
    const auto& smaller = entries_[body].pairs.size() < entries_[other].pairs.size() ? entries_[body].pairs
                                                                                     : entries_[other].pairs;
    const BodyIndex a = std::min(body, other);
    const BodyIndex b = std::max(body, other);
    for (const std::uint32_t pair : smaller) {
      if (pairs_[pair].a == a && pairs_[pair].b == b) return;
    }
    add_pair(bodies, a, b);
  };
  if (rule_.is_culling) return grid_.for_each_near(box, meet);
  for (BodyIndex other = 0; other < bodies.size(); ++other) {
    if (entries_[other].is_in) meet(other);
  }
}

void PairFinder::add_pair(const Bodies& bodies, BodyIndex a, BodyIndex b) {
  for (const BodyIndex body : {a, b}) {
    geometry::Boundary& boundary = *bodies.boundary[body];
    if (!boundary.is_ready()) make_ready(boundary, {rule_.circle_radius, rule_.is_circle_centres});
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
  pair.is_dropped = false;
  pair.known.way = pair.quiet.way = pair.known_until = -1;
  pair.covers.clear();
  pair.edges.clear();
  pair.records.clear();
  entries_[a].pairs.push_back(slot);
  entries_[b].pairs.push_back(slot);
  new_pairs_.push_back({a, b, -1, slot});
}

void PairFinder::drop_pair(std::uint32_t slot) {
  Pair& pair = pairs_[slot];
  for (const BodyIndex body : {pair.a, pair.b}) {
    auto& own = entries_[body].pairs;
    own.erase(std::find(own.begin(), own.end(), slot));
  }
  pair.is_dropped = true;
  has_dropped_ = true;
}

/// Brings the list of active pairs up to date, in order.
void PairFinder::tidy() {
  const auto settle = [&](std::vector<ActivePair>& list) {
    std::erase_if(list, [&](const ActivePair& active) {
      if (!pairs_[active.slot].is_dropped) return false;
      free_pairs_.push_back(active.slot);
      return true;
    });
  };
  if (has_dropped_) {
    settle(active_);
    settle(new_pairs_);
    has_dropped_ = false;
  }
  if (new_pairs_.empty()) return;
  std::sort(new_pairs_.begin(), new_pairs_.end());
  const auto middle = static_cast<std::ptrdiff_t>(active_.size());
  active_.insert(active_.end(), new_pairs_.begin(), new_pairs_.end());
  std::inplace_merge(active_.begin(), active_.begin() + middle, active_.end());
  new_pairs_.clear();
}

void PairFinder::update(const Bodies& bodies, const std::vector<BodyIndex>& awake) {
  if (!rule_.is_culling) return tidy();
  for (const BodyIndex body : awake) {
    if (bodies.travel[body] <= entries_[body].travel_limit) continue;
    place(bodies, body);
    own_pairs_ = entries_[body].pairs;
    for (const std::uint32_t pair : own_pairs_) {
      if (!overlaps(entries_[pairs_[pair].a].box, entries_[pairs_[pair].b].box)) drop_pair(pair);
    }
    connect(bodies, body);
  }
  tidy();
}

void PairFinder::refresh(const Bodies& bodies, Pair& pair, const Pose& place) {
  const geometry::Boundary& a = *bodies.boundary[pair.a];
  const geometry::Boundary& b = *bodies.boundary[pair.b];
  const Pose a_from_b = dynamics::a_from_b(bodies, pair.a, pair.b, place);
  pair.covers.clear();
  pair.edges.clear();
  const double apart = near_covers(a, b, a_from_b, kNearMargin, pair.covers);
  if (!pair.covers.empty()) edges_of(a, b, pair.covers, pair.edges);
  pair.known = {place, (pair.covers.empty() ? apart : kNearMargin) * (1 - 1e-9)};
}

/// Finds the contacts of a pair. Returns how far the two can move from here without touching [m].
double PairFinder::examine(const Bodies& bodies, Pair& pair, const Pose& place,
                           std::vector<Contact>& contacts, double dt) {
  const double travelled = bodies.travel[pair.a] + bodies.travel[pair.b];
  if (travelled > pair.known_until) {
    if (way_left(bodies, pair.b, place, pair.known) < kRounding) refresh(bodies, pair, place);
    pair.known_until = travelled + way_left(bodies, pair.b, place, pair.known) - kRounding;
  }
  if (pair.covers.empty()) {
    pair.records.clear();
    pair.quiet = pair.known;
    return way_left(bodies, pair.b, place, pair.quiet);
  }
  const std::size_t first = contacts.size();
  const bool is_apart = collect(bodies, pair, place, contacts);
  if (!is_apart) {
    RecordKeeper(pair.records, records_, rule_.circle_radius, dt)
        .renew(contacts.data() + first, contacts.size() - first, bodies);
    pair.quiet.way = -1;
    return -1;
  }
  // Circles lie inside the ice: no two can overlap while the boundaries are apart.
  const double free_way = least_distance(*bodies.boundary[pair.a], *bodies.boundary[pair.b],
                                         a_from_b(bodies, pair.a, pair.b, place), pair.edges);
  pair.records.clear();
  pair.quiet = {place, std::min(free_way, way_left(bodies, pair.b, place, pair.known)) - kRounding};
  return pair.quiet.way;
}

/// Finds the contacts of a pair among the edges known to be near. Returns whether the two are apart.
bool PairFinder::collect(const Bodies& bodies, const Pair& pair, const Pose& place,
                         std::vector<Contact>& contacts) {
  const geometry::Boundary& a = *bodies.boundary[pair.a];
  const geometry::Boundary& b = *bodies.boundary[pair.b];
  const Pose a_from_b = dynamics::a_from_b(bodies, pair.a, pair.b, place);
  patches_.clear();
  int unpaired = 0;
  if (rule_.is_circle_centres) {
    find_circle_patches(a, b, a_from_b, pair.covers, patches_);
  } else {
    unpaired = find_patches(a, b, a_from_b, pair.edges, scratch_, patches_);
  }
  unpaired_ += unpaired;
  if (patches_.empty()) return unpaired == 0;
  const Pose water_from_a = water_from_body(bodies, pair.a);
  std::uint32_t number = 0;
  for (const geometry::ContactPatch& patch : patches_) {
    Contact& c = contacts.emplace_back();
    c.a = pair.a;
    c.b = pair.b;
    for (int end = 0; end < 2; ++end) c.ends[end] = point_in_world(water_from_a, patch.ends[end]);
    c.tip_of_b = point_in_world(water_from_a, patch.tip_of_b);
    c.normal = rotate(water_from_a.rotation, patch.normal);
    c.width = patch.width;
    c.depth = patch.depth;
    c.area = patch.area;
    c.tip_edge_of_b = patch.tip_edge_of_b;
    c.place = number++;
    const Vector relative = velocity_at(bodies, c.b, c.middle() - bodies.position[c.b]) -
                            velocity_at(bodies, c.a, c.middle() - bodies.position[c.a]);
    c.approach_speed = -dot(relative, c.normal);
    c.slip_speed = dot(relative, perpendicular(c.normal));
  }
  return false;
}

void PairFinder::find_contacts(Bodies& bodies, double dt, std::vector<Contact>& contacts) {
  contacts.clear();
  tidy();
  for (ActivePair& active : active_) {
    const double travelled = bodies.travel[active.a] + bodies.travel[active.b];
    if (rule_.is_culling && travelled <= active.quiet_until) continue;
    Pair& pair = pairs_[active.slot];
    if (!rule_.is_culling) pair.known.way = pair.quiet.way = pair.known_until = -1;
    const Pose place = centre_a_from_b(bodies, active.a, active.b);
    double way = way_left(bodies, active.b, place, pair.quiet);
    if (way < kRounding) way = examine(bodies, pair, place, contacts, dt);
    active.quiet_until = travelled + std::max(0.0, way - kRounding);
  }
}

}  // namespace polynya::dynamics
