#include "dynamics/contact/contact_tracker.hpp"

#include <algorithm>
#include <limits>

namespace polynya::dynamics {

using geometry::ContactManifold;
using geometry::Point;
using geometry::Vector;

namespace {

/// An overlap may be larger than what has pressed by this share of the smaller body, then it presses.
/// Greater: faces that turn onto each other overlap further before they press; 0: they press again by
/// rounding alone.
constexpr double kUncrushedShare = 0.005;

Point point_in_b(const Bodies& bodies, const Contact& c, Point point_in_water) {
  return bodies.centroid[c.b] + rotate_back(bodies.rotation[c.b], point_in_water - bodies.position[c.b]);
}

PersistentContact new_record(const Bodies& bodies, const Contact& c) {
  PersistentContact record;
  record.first_touch_in_b = point_in_b(bodies, c, c.tip_of_b);
  return record;
}

/// dS/dξ of the power law that continues an overlap to other depths, S(ξ) = S (ξ/d)^p (fracture::Overlap)
/// [m].
double growth_of(const Contact& c) {
  return std::clamp(c.width, c.area / c.depth, 3 * c.area / c.depth);
}

/// The depth at which the contact's overlap would have that area [m].
double loaded_depth_of(const Contact& c, double loaded_area) {
  if (!(loaded_area > 0 && c.area > 0 && c.depth > 0)) return 0;
  return std::max(0.0, c.depth + (loaded_area - c.area) / growth_of(c));
}

}  // namespace

bool ContactTracker::Patch::holds(Point point_in_b) const {
  const Vector off = point_in_b - middle;
  if (is_pierced) return length(off) <= reach;
  return std::abs(dot(off, perpendicular(normal))) <= half_width && std::abs(dot(off, normal)) <= depth;
}

ContactTracker::Patch ContactTracker::patch_of(const Contact& c, const ContactManifold& manifold,
                                               const Bodies& bodies) {
  const Point middle = point_in_b(bodies, c, c.middle());
  const Vector normal = rotate_back(bodies.rotation[c.b], c.normal);
  if (!manifold.is_pierced) return {middle, normal, 0.5 * c.width, c.depth, 0.5 * c.width, false};
  const Point centroid = point_in_b(bodies, c, transform(water_from_body(bodies, c.a), manifold.centroid));
  return {centroid, normal, 0.5 * c.width, c.depth, manifold.reach, true};
}

void ContactTracker::update(std::span<Contact> contacts, std::span<const ContactManifold> manifolds,
                            const Bodies& bodies) {
  if (contacts.size() == 1 && records_.size() == 1 && !records_[0].is_inherited) {  // nearly always
    const Patch patch = patch_of(contacts[0], manifolds[0], bodies);
    const double reach = reach_of(records_[0], patch);
    if (squared_length(patch.middle - records_[0].last_point_in_b) > reach * reach) {
      PersistentContact record = new_record(bodies, contacts[0]);
      keep_what_pressed(contacts[0], patch, record);
      if (record.loaded_area == 0) note_parted(records_[0], bodies);
      records_[0] = record;
    }
    advance(records_[0], contacts[0], patch, bodies);
  } else {
    updated_.clear();
    for (std::size_t i = 0; i < contacts.size(); ++i)
      updated_.push_back(record_of(contacts[i], patch_of(contacts[i], manifolds[i], bodies), bodies));
    join_left_over(contacts, manifolds, bodies);
    std::swap(records_, updated_);
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i].record = &records_[i];
}

/// How far a contact may be from where its record was [m]. Where a body is or was pierced, line and middle
/// may move through all of the overlap in a step.
double ContactTracker::reach_of(const PersistentContact& record, const Patch& patch) const {
  const bool is_pierced = patch.is_pierced || record.is_pierced;
  return tolerance_ + (is_pierced ? std::max(patch.reach, record.reach) : patch.reach);
}

PersistentContact ContactTracker::record_of(const Contact& c, const Patch& patch, const Bodies& bodies) {
  PersistentContact* old = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (PersistentContact& record : records_) {
    const double d = distance(record.last_point_in_b, patch.middle);
    if (record.is_continued || record.is_inherited || d > std::min(nearest, reach_of(record, patch))) continue;
    nearest = d;
    old = &record;
  }
  PersistentContact record = old != nullptr ? *old : new_record(bodies, c);
  if (old != nullptr)
    old->is_continued = true;
  else
    keep_what_pressed(c, patch, record);
  advance(record, c, patch, bodies);
  return record;
}

/// A contact without a record of its own, where an overlap was: a part of that one.
void ContactTracker::keep_what_pressed(const Contact& c, const Patch& patch, PersistentContact& record) const {
  for (const PersistentContact& old : records_) {
    if (distance(old.last_point_in_b, patch.middle) > tolerance_ + old.reach) continue;
    const double kept = std::min(old.loaded_area, c.area);
    if (kept > record.loaded_area) {
      record.loaded_area = kept;
      record.booked = kept / old.loaded_area * old.booked;
      record.booked.loaded = kept;
    }
    if (old.crushed.area > record.crushed.area) record.crushed = old.crushed;
  }
  if (record.loaded_area > 0) record.loaded_depth = loaded_depth_of(c, record.loaded_area);
}

/// Records without a contact whose overlap has become part of another.
void ContactTracker::join_left_over(std::span<Contact> contacts, std::span<const ContactManifold> manifolds,
                                    const Bodies& bodies) {
  for (const PersistentContact& old : records_) {
    if (old.is_continued || old.is_inherited || old.loaded_area == 0) continue;
    bool is_joined = false;
    for (std::size_t i = 0; i < contacts.size() && !is_joined; ++i) {
      if (!patch_of(contacts[i], manifolds[i], bodies).holds(old.last_point_in_b)) continue;
      updated_[i].loaded_depth = std::max(updated_[i].loaded_depth, old.loaded_depth);
      updated_[i].loaded_area += old.loaded_area;
      updated_[i].booked += old.booked;
      if (old.crushed.area > updated_[i].crushed.area) updated_[i].crushed = old.crushed;
      is_joined = true;
    }
    if (!is_joined) note_parted(old, bodies);
  }
}

void ContactTracker::note_parted(const PersistentContact& record, const Bodies& bodies) {
  if (record.is_inherited || record.crushed.area == 0) return;
  const Point middle = transform(water_from_body(bodies, b_), record.last_point_in_b);
  parted_.push_back({a_, b_, record.crushed, middle});
}

void ContactTracker::end(const Bodies& bodies) {
  for (const PersistentContact& record : records_) note_parted(record, bodies);
  records_.clear();
}

void ContactTracker::advance(PersistentContact& record, const Contact& c, const Patch& patch,
                             const Bodies& bodies) const {
  record.last_point_in_b = patch.middle;
  record.reach = patch.reach;
  record.age += dt_;
  record.approach += std::max(0.0, c.approach_speed) * dt_;
  record.is_pierced = patch.is_pierced;
  if (patch.is_pierced) {
    // Its extent does not show how far the overlap has pressed: its area does. And it was crushed, or the
    // bodies would not be in each other so far: nothing separates it.
    record.crushed_depth = c.depth;
    record.loaded_depth = loaded_depth_of(c, record.loaded_area);
    return;
  }
  record.crushed_depth = std::min(record.crushed_depth, c.depth);
  // Depth is a poor memory where faces turn onto each other: the overlap grows without becoming deeper.
  if (record.loaded_depth == 0 || c.area <= record.loaded_area) return;
  const double loaded = record.loaded_area + kUncrushedShare * std::min(bodies.area[c.a], bodies.area[c.b]);
  if (c.area > loaded) record.loaded_depth = std::min(record.loaded_depth, loaded_depth_of(c, loaded));
}

void remember_crushed(const Bodies& bodies, const Contact& c) {
  if (c.gives_way || !c.is_at_limit || c.area < c.record->crushed.area) return;
  c.record->crushed = {relative_pose(water_from_body(bodies, c.a), water_from_body(bodies, c.b)), c.area};
}

void remember_overlap(const Contact& c) {
  if (c.total_normal_impulse() == 0 || !(c.area > 0 && c.depth > 0)) return;
  const double moved = std::max(0.0, c.record->loaded_depth - c.depth);  // within the step
  c.record->loaded_area = c.area + growth_of(c) * moved;
}

}  // namespace polynya::dynamics
