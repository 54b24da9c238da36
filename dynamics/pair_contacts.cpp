#include "dynamics/pair_contacts.hpp"

#include <algorithm>

namespace polynya::dynamics {
namespace {

using geometry::Point;
using geometry::Pose;
using geometry::Rotation;
using geometry::Vector;

constexpr double kNearMargin = 0.75;  ///< pieces of boundary within this distance are kept with a pair [m]

/// The records of a pair's contacts, brought up to date. A record goes on with the nearest contact that may
/// be the same; one without a contact is over.
class ContactTracker {
 public:
  ContactTracker(std::vector<PersistentContact>& records, std::vector<PersistentContact>& scratch,
                 double circle_radius, double dt)
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
  static PersistentContact new_record(const Bodies& bodies, const Contact& c) {
    PersistentContact record;
    record.first_touch_in_b = point_in_b(bodies, c, c.tip_of_b);
    return record;
  }
  PersistentContact record_of(const Contact& c, const Bodies& bodies) {
    const Point here = point_in_b(bodies, c, c.middle());
    PersistentContact* old = nullptr;
    double nearest = tolerance_ + 0.5 * c.width;
    for (PersistentContact& record : records_) {
      const double d = distance(record.last_point_in_b, here);
      if (record.is_continued || d > nearest) continue;
      nearest = d;
      old = &record;
    }
    PersistentContact record = old != nullptr ? *old : new_record(bodies, c);
    if (old != nullptr) old->is_continued = true;
    bring_up_to_date(record, c, here);
    return record;
  }
  void bring_up_to_date(PersistentContact& record, const Contact& c, Point here) const {
    record.last_point_in_b = here;
    record.age += dt_;
    record.approach += std::max(0.0, c.approach_speed) * dt_;
    record.crushed_depth = std::min(record.crushed_depth, c.depth);
  }

  std::vector<PersistentContact>& records_;
  std::vector<PersistentContact>& renewed_;
  double tolerance_;  // between a contact's places in two steps, beside half its width [m]
  double dt_;
};

void refresh(const Bodies& bodies, Pair& pair, const Pose& place) {
  const geometry::Boundary& a = *bodies.boundary[pair.a];
  const geometry::Boundary& b = *bodies.boundary[pair.b];
  const Pose a_from_b = dynamics::a_from_b(bodies, pair.a, pair.b, place);
  pair.covers.clear();
  pair.edges.clear();
  const double apart = near_circles(a, b, a_from_b, kNearMargin, pair.covers);
  if (!pair.covers.empty()) edges_of(a, b, pair.covers, pair.edges);
  pair.known = {place, (pair.covers.empty() ? apart : kNearMargin) * (1 - 1e-9)};
}

/// Finds the contacts of a pair among the edges known to be near. Returns whether the two are apart.
bool collect(const Bodies& bodies, const Pair& pair, const Pose& place, bool is_circle_centres,
             PairScratch& scratch, std::vector<Contact>& contacts) {
  const geometry::Boundary& a = *bodies.boundary[pair.a];
  const geometry::Boundary& b = *bodies.boundary[pair.b];
  const Pose a_from_b = dynamics::a_from_b(bodies, pair.a, pair.b, place);
  scratch.manifolds.clear();
  int unpaired = 0;
  if (is_circle_centres) {
    find_circle_manifolds(a, b, a_from_b, pair.covers, scratch.manifolds);
  } else {
    unpaired = find_manifolds(a, b, a_from_b, pair.edges, scratch.crossings, scratch.manifolds);
  }
  scratch.unpaired += unpaired;
  if (scratch.manifolds.empty()) return unpaired == 0;
  const Pose water_from_a = water_from_body(bodies, pair.a);
  std::uint32_t number = 0;
  for (const geometry::ContactManifold& manifold : scratch.manifolds) {
    Contact& c = contacts.emplace_back();
    c.a = pair.a;
    c.b = pair.b;
    for (int end = 0; end < 2; ++end) c.ends[end] = transform(water_from_a, manifold.ends[end]);
    c.tip_of_b = transform(water_from_a, manifold.tip_of_b);
    c.normal = rotate(water_from_a.rotation, manifold.normal);
    c.width = manifold.width;
    c.depth = manifold.depth;
    c.area = manifold.area;
    c.tip_edge_of_b = manifold.tip_edge_of_b;
    c.place = number++;
    const Vector relative = velocity_at(bodies, c.b, c.middle() - bodies.position[c.b]) -
                            velocity_at(bodies, c.a, c.middle() - bodies.position[c.a]);
    c.approach_speed = -dot(relative, c.normal);
    c.slip_speed = dot(relative, perpendicular(c.normal));
  }
  return false;
}

}  // namespace

double clearance_left(const Bodies& bodies, BodyIndex b, const Pose& place, const KnownNear& known) {
  if (known.way < 0) return known.way;
  const Rotation was = known.a_from_b.rotation;
  const Vector turn{place.rotation.cosine - was.cosine, place.rotation.sine - was.sine};  // as a chord
  return known.way - distance(place.position, known.a_from_b.position) -
         length(turn) * bodies.bounding_radius[b];
}

double collide_pair(const Bodies& bodies, Pair& pair, const Pose& place, const ContactRule& rule, double dt,
                    PairScratch& scratch, std::vector<Contact>& contacts) {
  const double travelled = bodies.travel[pair.a] + bodies.travel[pair.b];
  if (travelled > pair.near_bound) {
    if (clearance_left(bodies, pair.b, place, pair.known) < kRounding) refresh(bodies, pair, place);
    pair.near_bound = travelled + clearance_left(bodies, pair.b, place, pair.known) - kRounding;
  }
  if (pair.covers.empty()) {
    pair.records.clear();
    pair.quiet = pair.known;
    return clearance_left(bodies, pair.b, place, pair.quiet);
  }
  const std::size_t first = contacts.size();
  const bool is_apart = collect(bodies, pair, place, rule.is_circle_centres, scratch, contacts);
  if (!is_apart) {
    ContactTracker(pair.records, scratch.records, rule.circle_radius, dt)
        .renew(contacts.data() + first, contacts.size() - first, bodies);
    pair.quiet.way = -1;
    return -1;
  }
  // Circles lie inside the ice: no two can overlap while the boundaries are apart.
  const double free_way = least_distance(*bodies.boundary[pair.a], *bodies.boundary[pair.b],
                                         a_from_b(bodies, pair.a, pair.b, place), pair.edges);
  pair.records.clear();
  pair.quiet = {place, std::min(free_way, clearance_left(bodies, pair.b, place, pair.known)) - kRounding};
  return pair.quiet.way;
}

}  // namespace polynya::dynamics
