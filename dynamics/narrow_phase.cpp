#include "dynamics/narrow_phase.hpp"

#include <algorithm>

namespace polynya::dynamics {
namespace {

using geometry::Point;
using geometry::Pose;
using geometry::Rotation;
using geometry::Vector;

constexpr double kNearMargin = 0.75;  ///< bounding circles within this distance are kept with a pair [m]

/// Updates the records of a pair's contacts. A record passes to the nearest contact that may be the same; one
/// without a contact is dropped.
class ContactTracker {
 public:
  ContactTracker(std::vector<PersistentContact>& records, std::vector<PersistentContact>& scratch,
                 double circle_radius, double dt)
      : records_(records), updated_(scratch), tolerance_(0.25 * circle_radius), dt_(dt) {}

  void update(Contact* contacts, std::size_t count, const Bodies& bodies) {
    if (count == 1 && records_.size() == 1) {  // nearly always, and then in place
      const Point here = point_in_b(bodies, contacts[0], contacts[0].middle());
      const double reach = tolerance_ + 0.5 * contacts[0].width;
      if (squared_length(here - records_[0].last_point_in_b) > reach * reach)
        records_[0] = new_record(bodies, contacts[0]);
      advance(records_[0], contacts[0], here);
    } else {
      updated_.clear();
      for (std::size_t i = 0; i < count; ++i) updated_.push_back(record_of(contacts[i], bodies));
      std::swap(records_, updated_);
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
    advance(record, c, here);
    return record;
  }
  void advance(PersistentContact& record, const Contact& c, Point here) const {
    record.last_point_in_b = here;
    record.age += dt_;
    record.approach += std::max(0.0, c.approach_speed) * dt_;
    record.crushed_depth = std::min(record.crushed_depth, c.depth);
  }

  std::vector<PersistentContact>& records_;
  std::vector<PersistentContact>& updated_;
  double tolerance_;  // of a contact's displacement in a step, beside half its width [m]
  double dt_;
};

/// Finds the circles and edges of a pair that are near each other.
void find_near(const Bodies& bodies, Pair& pair, const Pose& pose) {
  const geometry::Boundary& a = *bodies.boundary[pair.a];
  const geometry::Boundary& b = *bodies.boundary[pair.b];
  const Pose a_from_b = dynamics::a_from_b(bodies, pair.a, pair.b, pose);
  pair.near_circles.clear();
  const double distance = near_circles(a, b, a_from_b, kNearMargin, pair.near_circles);
  edges_of(a, b, pair.near_circles, pair.near_edges);
  pair.near = {pose, (pair.near_circles.empty() ? distance : kNearMargin) * (1 - 1e-9)};
}

/// Appends the contacts of a pair among its near edges. Returns whether the two are apart.
bool collect(const Bodies& bodies, const Pair& pair, const Pose& pose, bool is_circle_centres,
             PairScratch& scratch, std::vector<Contact>& contacts) {
  const geometry::Boundary& a = *bodies.boundary[pair.a];
  const geometry::Boundary& b = *bodies.boundary[pair.b];
  const Pose a_from_b = dynamics::a_from_b(bodies, pair.a, pair.b, pose);
  scratch.manifolds.clear();
  int unpaired = 0;
  if (is_circle_centres) {
    find_circle_manifolds(a, b, a_from_b, pair.near_circles, scratch.manifolds);
  } else {
    unpaired = find_manifolds(a, b, a_from_b, pair.near_edges, scratch.crossings, scratch.manifolds);
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

double clearance_left(const Bodies& bodies, BodyIndex b, const Pose& pose, const Clearance& clearance) {
  if (clearance.distance < 0) return clearance.distance;
  const Rotation before = clearance.a_from_b.rotation;
  const Vector turn{pose.rotation.cosine - before.cosine, pose.rotation.sine - before.sine};  // as a chord
  return clearance.distance - distance(pose.position, clearance.a_from_b.position) -
         length(turn) * bodies.bounding_radius[b];
}

double collide_pair(const Bodies& bodies, Pair& pair, const Pose& pose, const ContactRule& rule, double dt,
                    PairScratch& scratch, std::vector<Contact>& contacts) {
  const double travelled = bodies.travel[pair.a] + bodies.travel[pair.b];
  if (travelled > pair.near_bound) {
    if (clearance_left(bodies, pair.b, pose, pair.near) < kRounding) find_near(bodies, pair, pose);
    pair.near_bound = travelled + clearance_left(bodies, pair.b, pose, pair.near) - kRounding;
  }
  if (pair.near_edges.pairs.empty()) {
    pair.records.clear();
    pair.apart = pair.near;
    return clearance_left(bodies, pair.b, pose, pair.apart);
  }
  const std::size_t first = contacts.size();
  const bool is_apart = collect(bodies, pair, pose, rule.is_circle_centres, scratch, contacts);
  if (!is_apart) {
    ContactTracker(pair.records, scratch.records, rule.circle_radius, dt)
        .update(contacts.data() + first, contacts.size() - first, bodies);
    pair.apart.distance = -1;
    return -1;
  }
  // Circles lie inside the ice: no two can overlap while the boundaries are apart.
  const double gap = least_distance(a_from_b(bodies, pair.a, pair.b, pose), pair.near_edges);
  pair.records.clear();
  pair.apart = {pose, std::min(gap, clearance_left(bodies, pair.b, pose, pair.near)) - kRounding};
  return pair.apart.distance;
}

}  // namespace polynya::dynamics
