#include "dynamics/contact/contact_tracker.hpp"

#include <algorithm>
#include <limits>

#include "dynamics/contact/paid_overlap.hpp"

namespace polynya::dynamics {

using geometry::ContactManifold;
using geometry::Point;
using geometry::Vector;

namespace {

Point point_in_b(const Bodies& bodies, const Contact& c, Point point_in_water) {
  return bodies.centroid[c.b] + rotate_back(bodies.rotation[c.b], point_in_water - bodies.position[c.b]);
}

PersistentContact new_record(const Bodies& bodies, const Contact& c) {
  PersistentContact record;
  record.first_touch_in_b = point_in_b(bodies, c, c.tip_of_b);
  return record;
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
  if (!continues_one(contacts, manifolds, bodies)) update_several(contacts, manifolds, bodies);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    contacts[i].record = &records_[i];
    contacts[i].is_new = records_[i].age <= dt_ && records_[i].area == 0;
    enter_paid_depth(contacts[i]);
  }
}

/// Updates the record of a pair that had one contact and still has one, which is the usual case. Returns true if it is
/// such a pair.
bool ContactTracker::continues_one(std::span<Contact> contacts, std::span<const ContactManifold> manifolds,
                                   const Bodies& bodies) {
  if (contacts.size() != 1 || records_.size() != 1 || records_[0].is_inherited) return false;
  const Patch patch = patch_of(contacts[0], manifolds[0], bodies);
  const double reach = reach_of(records_[0], patch);
  if (squared_length(patch.middle - records_[0].last_point_in_b) > reach * reach) return false;
  advance(records_[0], contacts[0], patch);
  return true;
}

void ContactTracker::update_several(std::span<Contact> contacts, std::span<const ContactManifold> manifolds,
                                    const Bodies& bodies) {
  updated_.clear();
  for (std::size_t i = 0; i < contacts.size(); ++i)
    updated_.push_back(record_of(contacts[i], patch_of(contacts[i], manifolds[i], bodies), bodies));
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (updated_[i].age == 0) take_parts(contacts, i);
  }
  join_left_over(contacts, manifolds, bodies);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    advance(updated_[i], contacts[i], patch_of(contacts[i], manifolds[i], bodies));
  std::swap(records_, updated_);
}

/// Returns how far a contact may be from the place of its record [m]. If a body is or was pierced, line and middle may
/// move through the whole overlap in one step.
double ContactTracker::reach_of(const PersistentContact& record, const Patch& patch) const {
  const bool is_pierced = patch.is_pierced || record.is_pierced;
  return tolerance_ + (is_pierced ? std::max(patch.reach, record.reach) : patch.reach);
}

/// Returns the nearest record that may belong to the contact, or a new one with age 0.
PersistentContact ContactTracker::record_of(const Contact& c, const Patch& patch, const Bodies& bodies) {
  PersistentContact* old = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (PersistentContact& record : records_) {
    const double d = distance(record.last_point_in_b, patch.middle);
    if (record.is_continued || record.is_inherited || d > std::min(nearest, reach_of(record, patch))) continue;
    nearest = d;
    old = &record;
  }
  if (old == nullptr) return new_record(bodies, c);
  const PersistentContact record = *old;
  old->is_continued = true;
  return record;
}

namespace {

/// Moves paid area of an overlap to one that was a part of it: its share by area, as far as it is available [m²].
void give_part(double available, double area_of_part, PersistentContact& from, PersistentContact& to) {
  if (!(available > 0)) return;
  const double share_paid = std::min(1.0, from.paid_area / std::max(from.paid_area, from.area));
  const double given = std::min(available, share_paid * area_of_part);
  const Booked booked = given / from.paid_area * from.booked;
  to.paid_area += given;
  to.booked += booked;
  from.booked += -1.0 * booked;
  from.paid_area -= given;
  from.area = std::max(0.0, from.area - area_of_part);
  if (from.crushed.area > to.crushed.area) to.crushed = from.crushed;
}

}  // namespace

/// Gives a contact without a record its part of the paid area. The contact is a part of an earlier overlap: of one that
/// ended or was inherited, or of one that continues and has more paid area than its remaining area.
void ContactTracker::take_parts(std::span<const Contact> contacts, std::size_t part) {
  PersistentContact& record = updated_[part];
  const double area = contacts[part].area;
  for (PersistentContact& old : records_) {
    if (old.is_continued) continue;
    if (old.area > 0) record.area = area;  // a part of an earlier overlap is not a new contact
    give_part(old.paid_area, area - record.paid_area, old, record);
    // This ice is cut off with the part that took it over, and not again when its own record ends.
    if (old.crushed.area > 0 && !old.is_inherited && record.crushed.area >= old.crushed.area) old.crushed = {};
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (updated_[i].age > 0)
      give_part(updated_[i].paid_area - contacts[i].area, area - record.paid_area, updated_[i], record);
  }
}

/// Adds up the paid areas where the overlap of a record without a contact has become part of another overlap.
void ContactTracker::join_left_over(std::span<Contact> contacts, std::span<const ContactManifold> manifolds,
                                    const Bodies& bodies) {
  for (const PersistentContact& old : records_) {
    if (old.is_continued || old.is_inherited) continue;
    bool is_joined = false;
    for (std::size_t i = 0; i < contacts.size() && !is_joined; ++i) {
      if (!patch_of(contacts[i], manifolds[i], bodies).holds(old.last_point_in_b)) continue;
      updated_[i].paid_area += old.paid_area;
      updated_[i].area += old.area;
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

void ContactTracker::advance(PersistentContact& record, const Contact& c, const Patch& patch) const {
  record.last_point_in_b = patch.middle;
  record.reach = patch.reach;
  record.age += dt_;
  record.approach += std::max(0.0, c.approach_speed) * dt_;
  record.is_pierced = patch.is_pierced;
  if (patch.is_pierced) {
    // The ice was crushed, or the bodies would not overlap so far: the law of impulses does not separate it.
    record.crushed_depth = c.depth;
  } else {
    record.crushed_depth = std::min(record.crushed_depth, c.depth);
  }
}

}  // namespace polynya::dynamics
