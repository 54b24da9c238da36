#include "dynamics/contact/narrow_phase.hpp"

#include <algorithm>

#include "dynamics/contact/contact_tracker.hpp"
#include "dynamics/contact/paid_overlap.hpp"

namespace polynya::dynamics {
namespace {

using geometry::Pose;
using geometry::Rotation;
using geometry::Vector;

/// Distance up to which bounding circles are kept with a pair [m]. Smaller: near circles are searched again more often.
/// Larger: more circles are compared in each step. Results do not change.
constexpr double kNearMargin = 0.75;

/// Number of covers that are kept for the second bodies of pairs. It is enough for the neighbours of one body in a
/// field and some of the next body. Fewer: covers are made again more often. Results do not change.
constexpr std::size_t kKeptSecondCovers = 32;

/// Returns the depth of an overlap: its extent along the normal [m]. The extent of a crescent describes the notch in
/// which a body lies, and not the overlap, which is thin; its mean thickness is then taken as its depth.
double bounded_depth(const geometry::ContactManifold& m) {
  return is_crescent(m.depth, m.width, m.area) ? m.area / m.width : m.depth;
}

/// Depth up to which an overlap is treated as a rectangle on its contact line, with the law of crushing ice [m]. Its
/// measures are differences of coordinates that are rounded at about 1e-12 m, so its shape would be rounding error.
/// Larger values give deeper overlaps too the wrong area.
constexpr double kShapeless = 1e-6;

/// Returns true if the depth is limited by bounded_depth(). It is not limited if both motions are prescribed, because
/// the simulation cuts such ice out (carve_channels) and needs the extent for it.
bool is_bounded(const ContactRule& rule, const Bodies& bodies, const Pair& pair) {
  return rule.is_depth_bounded && (bodies.inverse_mass[pair.a] != 0 || bodies.inverse_mass[pair.b] != 0);
}

geometry::CircleRule circle_rule(const ContactRule& rule) {
  return {rule.circle_radius, rule.is_circle_centres};
}

/// Finds the circles and edges of a pair that are near each other. Returns a lower bound of the distance between the
/// bodies; 0 if some are near [m].
double near_parts(const Bodies& bodies, const Pair& pair, const Pose& a_from_b, const ContactRule& rule,
                  PairScratch& scratch) {
  if (!need_covers(bodies, pair.a, pair.b, rule))
    return near_edges(bodies.boundary[pair.a]->edges, bodies.boundary[pair.b]->edges, a_from_b, kNearMargin,
                      scratch.near_edges);
  const auto [a, b] = scratch.covers.of(bodies, pair.a, pair.b, circle_rule(rule));
  scratch.near_circles.clear();
  const double distance = near_circles(a, b, a_from_b, kNearMargin, scratch.near_circles);
  edges_of(a, b, scratch.near_circles, scratch.near_edges);
  return distance;
}

/// Finds the near circles and edges of a pair and keeps them with it, and how far the bodies may move until others may
/// be near.
void find_near(const Bodies& bodies, Pair& pair, const Pose& pose, const ContactRule& rule, PairScratch& scratch) {
  const Pose a_from_b = dynamics::a_from_b(bodies, pair.a, pair.b, pose);
  const double distance = near_parts(bodies, pair, a_from_b, rule, scratch);
  const bool is_any_near = !scratch.near_edges.pairs.empty();
  if (is_any_near) {
    pair.own_parts().edges = scratch.near_edges;  // a copy has no spare capacity
    if (rule.is_circle_centres) pair.parts->circles = scratch.near_circles;
  } else if (pair.parts != nullptr) {
    pair.parts->edges.pairs.clear();
  }
  pair.near = {pose, (is_any_near ? kNearMargin : distance) * (1 - 1e-9)};
}

void forget_near(Pair& pair) {
  pair.parts.reset();
  pair.near = {};
  pair.near_bound = -1;
}

/// Records the manifolds that are inseparable, and removes those that have no direction in which to separate the
/// bodies.
void take_inseparable(const Pair& pair, const Pose& water_from_a, PairScratch& scratch) {
  InseparableOverlap inseparable{pair.a, pair.b, false, 0, 0, 0, {}};
  double largest = 0;
  for (const geometry::ContactManifold& m : scratch.manifolds) {
    if (!m.is_pierced || !geometry::is_inseparable(m.width, m.area, m.extent)) continue;
    inseparable.area += m.area;
    if (m.area <= largest) continue;
    largest = m.area;
    inseparable.width = m.width;
    inseparable.least_width = geometry::kInseparableShare * m.area / m.extent;
    inseparable.middle = transform(water_from_a, m.centroid);
  }
  if (inseparable.area > 0) scratch.inseparable.push_back(inseparable);
  std::erase_if(scratch.manifolds,
                [](const geometry::ContactManifold& m) { return m.is_pierced && m.width <= geometry::kNoWidth; });
}

/// Records whether one body is inside the other, for two bodies whose boundaries do not cross.
void take_inside(const Bodies& bodies, Pair& pair, const Pose& pose, const ContactRule& rule, PairScratch& scratch) {
  if (pair.is_outside) return;
  const Pose a_from_b = dynamics::a_from_b(bodies, pair.a, pair.b, pose);
  if (need_covers(bodies, pair.a, pair.b, rule)) {
    const auto [a, b] = scratch.covers.of(bodies, pair.a, pair.b, circle_rule(rule));
    pair.is_outside = !is_one_inside(a, b, a_from_b);
  } else {
    pair.is_outside = !is_one_inside(bodies.boundary[pair.a]->edges, bodies.boundary[pair.b]->edges, a_from_b);
  }
  if (pair.is_outside) return;
  const BodyIndex inner = bodies.bounding_radius[pair.a] < bodies.bounding_radius[pair.b] ? pair.a : pair.b;
  scratch.inseparable.push_back({pair.a, pair.b, true, 0, 0, 0, bodies.position[inner]});
}

/// Appends the contacts of a pair, which are found among its near edges. Returns true if the two bodies are apart.
bool collect(const Bodies& bodies, Pair& pair, const Pose& pose, const ContactRule& rule, PairScratch& scratch,
             std::vector<Contact>& contacts) {
  const geometry::Boundary& a = *bodies.boundary[pair.a];
  const geometry::Boundary& b = *bodies.boundary[pair.b];
  const Pose a_from_b = dynamics::a_from_b(bodies, pair.a, pair.b, pose);
  scratch.manifolds.clear();
  int unpaired = 0;
  if (rule.is_circle_centres) {
    find_circle_manifolds(a, b, a_from_b, pair.parts->circles, scratch.manifolds);
  } else {
    unpaired = find_manifolds({a, b, a_from_b}, pair.parts->edges, scratch.crossings, scratch.manifolds);
  }
  scratch.unpaired += unpaired;
  if (scratch.manifolds.empty()) {
    const bool is_apart = unpaired == 0;
    if (is_apart && !rule.is_circle_centres && scratch.crossings.crossings.empty())
      take_inside(bodies, pair, pose, rule, scratch);
    return is_apart;
  }
  const Pose water_from_a = water_from_body(bodies, pair.a);
  if (std::ranges::any_of(scratch.manifolds, &geometry::ContactManifold::is_pierced))
    take_inseparable(pair, water_from_a, scratch);
  std::uint32_t number = 0;
  for (const geometry::ContactManifold& manifold : scratch.manifolds) {
    Contact& c = contacts.emplace_back();
    c.a = pair.a;
    c.b = pair.b;
    for (int end = 0; end < 2; ++end) c.ends[end] = transform(water_from_a, manifold.ends[end]);
    c.tip_of_b = transform(water_from_a, manifold.tip_of_b);
    c.tip_of_a = transform(water_from_a, manifold.tip_of_a);
    c.normal = rotate(water_from_a.rotation, manifold.normal);
    c.width = manifold.width;
    c.depth = is_bounded(rule, bodies, pair) ? bounded_depth(manifold) : manifold.depth;
    const bool has_shape = !rule.is_depth_bounded || c.depth > kShapeless;
    c.area = has_shape ? manifold.area : c.width * c.depth;
    c.tip_edge_of_b = manifold.tip_edge_of_b;
    c.place = number++;
    const Vector relative = velocity_at(bodies, c.b, c.middle() - bodies.position[c.b]) -
                            velocity_at(bodies, c.a, c.middle() - bodies.position[c.a]);
    c.approach_speed = -dot(relative, c.normal);
    c.slip_speed = dot(relative, perpendicular(c.normal));
  }
  return false;
}

/// Relative change of the width of a contact line during a step above which the width at its end is computed [-].
/// Larger: forces of faces that come down flat are limited too early.
constexpr double kWidthKept = 1e-3;

/// Returns true if a contact line may have another length after the two bodies have closed by `way` [m]. By the power
/// law of its measures, w grows as ξ^(p - 1).
bool may_widen(const Contact& c, double way) {
  return (c.depth * c.width / c.area - 1) * way > kWidthKept * c.depth;
}

/// Returns the length of a contact line after the two bodies have closed by `way` along its normal [m]. Of several
/// overlaps there, the nearest one belongs to the contact.
double width_after(const Bodies& bodies, const Pair& pair, const Pose& pose, const Contact& c, double way,
                   PairScratch& scratch) {
  const Pose water_from_a = water_from_body(bodies, pair.a);
  Pose moved = a_from_b(bodies, pair.a, pair.b, pose);
  moved.position = moved.position - way * rotate_back(water_from_a.rotation, c.normal);
  scratch.manifolds_ahead.clear();
  find_manifolds({*bodies.boundary[pair.a], *bodies.boundary[pair.b], moved}, pair.parts->edges, scratch.crossings,
                 scratch.manifolds_ahead);
  const geometry::Point middle = inverse_transform(water_from_a, c.middle());
  const auto is_nearer = [&](const geometry::ContactManifold& m, const geometry::ContactManifold& n) {
    return distance(midpoint(m.ends[0], m.ends[1]), middle) < distance(midpoint(n.ends[0], n.ends[1]), middle);
  };
  const auto own = std::ranges::min_element(scratch.manifolds_ahead, is_nearer);
  return own == scratch.manifolds_ahead.end() ? c.width : std::max(c.width, own->width);
}

/// Finds the width of each contact line at the end of the step, for the law of crushing ice, which extrapolates the
/// force from the start of the step. A face that comes down almost parallel to the ice lies on it completely within a
/// step, and its contact line then grows no more.
void look_ahead(const Bodies& bodies, Pair& pair, const Pose& pose, const ContactRule& rule, double dt,
                PairScratch& scratch, std::span<Contact> contacts) {
  if (!rule.is_depth_bounded) return;
  for (Contact& c : contacts) {
    const double way = c.approach_speed * dt;
    if (c.depth + std::max(0.0, way) <= c.paid_depth || way <= 0) continue;
    c.width_ahead = c.width;
    if (!may_widen(c, way)) continue;
    if (clearance_left(bodies, pair.b, pose, pair.near) < way + kRounding) {
      find_near(bodies, pair, pose, rule, scratch);
      pair.near_bound =
          bodies.travel[pair.a] + bodies.travel[pair.b] + clearance_left(bodies, pair.b, pose, pair.near) - kRounding;
    }
    c.width_ahead = width_after(bodies, pair, pose, c, way, scratch);
  }
}

}  // namespace

std::pair<geometry::Covered, geometry::Covered> CoverCache::of(const Bodies& bodies, BodyIndex a, BodyIndex b,
                                                               const geometry::CircleRule& rule) {
  const geometry::Boundary& of_a = *bodies.boundary[a];
  const geometry::Boundary& of_b = *bodies.boundary[b];
  return {{of_a.edges, of_a.is_ready() ? *of_a.cover : first(of_a, a, rule)},
          {of_b.edges, of_b.is_ready() ? *of_b.cover : second(of_b, b, rule)}};
}

void CoverCache::clear() {
  first_ = {};
  second_ = std::vector<Entry>();
}

const geometry::Cover& CoverCache::first(const geometry::Boundary& boundary, BodyIndex body,
                                         const geometry::CircleRule& rule) {
  if (first_.body == body) return first_.cover;
  if (!second_.empty()) {  // pairs are ordered by their first body: it was mostly a second body before
    Entry& entry = second_[static_cast<std::size_t>(body) % kKeptSecondCovers];
    if (entry.body == body) {
      std::swap(first_, entry);
      return first_.cover;
    }
  }
  first_.body = -1;
  make_cover(boundary.edges, rule, first_.cover);
  first_.body = body;
  return first_.cover;
}

const geometry::Cover& CoverCache::second(const geometry::Boundary& boundary, BodyIndex body,
                                          const geometry::CircleRule& rule) {
  if (second_.empty()) second_.resize(kKeptSecondCovers);
  Entry& entry = second_[static_cast<std::size_t>(body) % kKeptSecondCovers];
  if (entry.body == body) return entry.cover;
  entry.body = -1;
  make_cover(boundary.edges, rule, entry.cover);
  entry.body = body;
  return entry.cover;
}

double clearance_left(const Bodies& bodies, BodyIndex b, const Pose& pose, const Clearance& clearance) {
  if (clearance.distance < 0) return clearance.distance;
  const Rotation before = clearance.a_from_b.rotation;
  const Vector turn{pose.rotation.cosine - before.cosine,
                    pose.rotation.sine - before.sine};  // as a chord of the unit circle
  return clearance.distance - distance(pose.position, clearance.a_from_b.position) -
         length(turn) * bodies.bounding_radius[b];
}

double collide_pair(const Bodies& bodies, Pair& pair, const Pose& pose, const ContactRule& rule, double dt,
                    PairScratch& scratch, std::vector<Contact>& contacts) {
  const double travelled = bodies.travel[pair.a] + bodies.travel[pair.b];
  if (travelled > pair.near_bound) {
    if (clearance_left(bodies, pair.b, pose, pair.near) < kRounding) find_near(bodies, pair, pose, rule, scratch);
    pair.near_bound = travelled + clearance_left(bodies, pair.b, pose, pair.near) - kRounding;
  }
  const auto tracker_of = [&](std::vector<PersistentContact>& records) {
    return ContactTracker(pair.a, pair.b, records, scratch.records, scratch.parted, rule.circle_radius, dt);
  };
  if (!pair.has_near_edges()) {
    if (pair.parts != nullptr) tracker_of(pair.parts->records).end(bodies);
    take_inside(bodies, pair, pose, rule, scratch);
    pair.parts.reset();
    pair.apart = pair.near;
    return clearance_left(bodies, pair.b, pose, pair.apart);
  }
  const std::size_t first = contacts.size();
  const bool is_apart = collect(bodies, pair, pose, rule, scratch, contacts);
  if (!is_apart) {
    const std::span<Contact> found = std::span(contacts).subspan(first);
    tracker_of(pair.parts->records).update(found, scratch.manifolds, bodies);
    look_ahead(bodies, pair, pose, rule, dt, scratch, found);
    pair.apart.distance = -1;
    pair.is_outside = false;
    return -1;
  }
  // Circles lie inside the ice, so none can overlap while the boundaries are apart.
  const double gap = least_distance(a_from_b(bodies, pair.a, pair.b, pose), pair.parts->edges);
  tracker_of(pair.parts->records).end(bodies);
  pair.apart = {pose, std::min(gap, clearance_left(bodies, pair.b, pose, pair.near)) - kRounding};
  if (!scratch.keeps_distant_edges && gap > rule.kept_gap) forget_near(pair);
  return pair.apart.distance;
}

}  // namespace polynya::dynamics
