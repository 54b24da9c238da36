#include "dynamics/pairs.hpp"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace polynya::dynamics {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Pose;
using geometry::Vector;

constexpr double kBoxMargin = 2.0;  ///< boxes are grown by this much, and renewed after that much travel [m]
constexpr double kNearMargin = 0.75;  ///< contact circles within this distance are kept with a pair [m]

Box box_in_water(const Bodies& bodies, BodyIndex i) {
  const Pose pose = water_from_body(bodies, i);
  const geometry::CircleNode& all = bodies.boundary[i]->tree.front();
  const Point centre = point_in_world(pose, all.centre);
  Box box = geometry::grown({centre, centre}, all.reach);
  if (bodies.boundary[i]->edges.size() > 64) return box;
  box = {point_in_world(pose, bodies.boundary[i]->edges.vertices.front()), {}};
  box.high = box.low;
  for (const Point p : bodies.boundary[i]->edges.vertices) {
    const Point q = point_in_world(pose, p);
    box.low = {std::min(box.low.x, q.x), std::min(box.low.y, q.y)};
    box.high = {std::max(box.high.x, q.x), std::max(box.high.y, q.y)};
  }
  return box;
}

/// The record of a contact: the nearest old one that may be the same contact, or a new one, brought up to
/// date.
ContactRecord record_of(std::vector<ContactRecord>& old_records, const Contact& c, const Pose& water_from_b,
                        double tolerance, double dt) {
  const Point here = point_in_body(water_from_b, c.middle());
  ContactRecord* old = nullptr;
  double nearest = tolerance + 0.5 * c.width;
  for (ContactRecord& record : old_records) {
    const double d = distance(record.last_point_in_b, here);
    if (record.is_continued || d > nearest) continue;
    nearest = d;
    old = &record;
  }
  ContactRecord record;
  record.first_touch_in_b = point_in_body(water_from_b, c.tip_of_b);
  if (old != nullptr) {
    record = *old;
    old->is_continued = true;
  }
  record.last_point_in_b = here;
  record.age += dt;
  record.approach += std::max(0.0, c.approach_speed) * dt;
  record.crushed_depth = std::min(record.crushed_depth, c.depth);
  return record;
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
  grid_.for_each_near(box, [&](BodyIndex other) {
    if (other == body || !overlaps(box, entries_[other].box)) return;
    if (bodies.inverse_mass[body] == 0 && bodies.inverse_mass[other] == 0)
      return;  // nothing could come of it
    const auto& smaller = entries_[body].pairs.size() < entries_[other].pairs.size() ? entries_[body].pairs
                                                                                     : entries_[other].pairs;
    const BodyIndex a = std::min(body, other);
    const BodyIndex b = std::max(body, other);
    for (const std::uint32_t pair : smaller) {
      if (pairs_[pair].a == a && pairs_[pair].b == b) return;
    }
    add_pair(a, b);
  });
}

void PairFinder::add_pair(BodyIndex a, BodyIndex b) {
  std::uint32_t slot = 0;
  if (free_pairs_.empty()) {
    slot = static_cast<std::uint32_t>(pairs_.size());
    pairs_.emplace_back();
    place_in_active_.push_back(0);
  } else {
    slot = free_pairs_.back();
    free_pairs_.pop_back();
  }
  Pair& pair = pairs_[slot];
  pair.a = a;
  pair.b = b;
  pair.known_until = pair.quiet_until = -1;
  pair.circles.clear();
  pair.edges.clear();
  pair.records.clear();
  entries_[a].pairs.push_back(slot);
  entries_[b].pairs.push_back(slot);
  place_in_active_[slot] = static_cast<std::uint32_t>(active_.size());
  active_.push_back(slot);
}

void PairFinder::drop_pair(std::uint32_t slot) {
  const Pair& pair = pairs_[slot];
  for (const BodyIndex body : {pair.a, pair.b}) {
    auto& own = entries_[body].pairs;
    own.erase(std::find(own.begin(), own.end(), slot));
  }
  active_[place_in_active_[slot]] = active_.back();
  place_in_active_[active_.back()] = place_in_active_[slot];
  active_.pop_back();
  free_pairs_.push_back(slot);
}

void PairFinder::update(const Bodies& bodies, const std::vector<BodyIndex>& awake) {
  for (const BodyIndex body : awake) {
    if (bodies.travel[body] <= entries_[body].travel_limit) continue;
    place(bodies, body);
    own_pairs_ = entries_[body].pairs;
    for (const std::uint32_t pair : own_pairs_) {
      if (!overlaps(entries_[pairs_[pair].a].box, entries_[pairs_[pair].b].box)) drop_pair(pair);
    }
    connect(bodies, body);
  }
}

void PairFinder::refresh(const Bodies& bodies, Pair& pair) {
  const geometry::Boundary& a = *bodies.boundary[pair.a];
  const geometry::Boundary& b = *bodies.boundary[pair.b];
  const Pose a_from_b = relative_pose(water_from_body(bodies, pair.a), water_from_body(bodies, pair.b));
  pair.circles.clear();
  pair.edges.clear();
  const double apart = near_circles(a, b, a_from_b, kNearMargin, pair.circles);
  if (!pair.circles.empty()) edges_of(a, b, pair.circles, pair.edges);
  const double free_way = pair.circles.empty() ? apart : kNearMargin;
  pair.known_until = bodies.travel[pair.a] + bodies.travel[pair.b] + free_way * (1 - 1e-9);
}

void PairFinder::collect(const Bodies& bodies, Pair& pair, std::vector<Contact>& contacts, double dt) {
  const geometry::Boundary& a = *bodies.boundary[pair.a];
  const geometry::Boundary& b = *bodies.boundary[pair.b];
  const Pose water_from_a = water_from_body(bodies, pair.a);
  const Pose water_from_b = water_from_body(bodies, pair.b);
  const Pose a_from_b = relative_pose(water_from_a, water_from_b);
  patches_.clear();
  int unpaired = 0;
  if (rule_.is_circle_centres) {
    find_circle_patches(a, b, a_from_b, pair.circles, patches_);
  } else {
    unpaired = find_patches(a, b, a_from_b, pair.edges, scratch_, patches_);
  }
  unpaired_ += unpaired;
  if (patches_.empty() && unpaired == 0) {
    // Circles lie inside the ice: no two can overlap while the boundaries are apart.
    const double free_way = least_distance(a, b, a_from_b, pair.edges);
    constexpr double kRounding = 1e-9;  // of positions and distances, far more than it can be [m]
    pair.quiet_until = bodies.travel[pair.a] + bodies.travel[pair.b] + std::max(0.0, free_way - kRounding);
    pair.records.clear();
    return;
  }
  const std::size_t first = contacts.size();
  records_.clear();
  for (const geometry::ContactPatch& patch : patches_) {
    Contact c;
    c.a = pair.a;
    c.b = pair.b;
    for (int end = 0; end < 2; ++end) c.ends[end] = point_in_world(water_from_a, patch.ends[end]);
    c.tip_of_b = point_in_world(water_from_a, patch.tip_of_b);
    c.normal = rotate(water_from_a.rotation, patch.normal);
    c.width = patch.width;
    c.depth = patch.depth;
    c.area = patch.area;
    c.tip_edge_of_b = patch.tip_edge_of_b;
    c.place = static_cast<std::uint32_t>(records_.size());
    const Vector relative = velocity_at(bodies, c.b, c.middle() - bodies.position[c.b]) -
                            velocity_at(bodies, c.a, c.middle() - bodies.position[c.a]);
    c.approach_speed = -dot(relative, c.normal);
    c.slip_speed = dot(relative, perpendicular(c.normal));

    records_.push_back(record_of(pair.records, c, water_from_b, 0.25 * rule_.circle_radius, dt));
    contacts.push_back(c);
  }
  std::swap(pair.records, records_);  // a record without a contact is over
  for (std::size_t i = 0; i < pair.records.size(); ++i) contacts[first + i].record = &pair.records[i];
}

void PairFinder::find_contacts(Bodies& bodies, double dt, std::vector<Contact>& contacts) {
  contacts.clear();
  for (const std::uint32_t slot : active_) {
    Pair& pair = pairs_[slot];
    const double travelled = bodies.travel[pair.a] + bodies.travel[pair.b];
    if (travelled <= pair.quiet_until) continue;
    if (travelled > pair.known_until) refresh(bodies, pair);
    if (pair.circles.empty()) {
      pair.quiet_until = pair.known_until;
      pair.records.clear();
      continue;
    }
    collect(bodies, pair, contacts, dt);
  }
  std::sort(contacts.begin(), contacts.end(), [](const Contact& p, const Contact& q) {
    return std::tie(p.a, p.b, p.place) < std::tie(q.a, q.b, q.place);
  });
}

}  // namespace polynya::dynamics
