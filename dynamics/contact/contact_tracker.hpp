#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dynamics/contact/contact.hpp"
#include "geometry/contact/manifolds.hpp"

namespace polynya::dynamics {

/// Updates the records of a pair's contacts. A record passes to the nearest contact that may be the same one; a record
/// without a contact is dropped. The paid area of overlaps (paid_overlap.hpp) never grows here: if overlaps join, their
/// paid areas are added, and if one becomes several, each takes a part in proportion to its area.
class ContactTracker {
 public:
  /// Tracks the contacts of the pair a, b. Contacts that end with ice that they crushed are added to `parted`.
  ContactTracker(BodyIndex a, BodyIndex b, std::vector<PersistentContact>& records,
                 std::vector<PersistentContact>& scratch, std::vector<PartedContact>& parted, double circle_radius,
                 double dt)
      : a_(a),
        b_(b),
        records_(records),
        updated_(scratch),
        parted_(parted),
        tolerance_(0.25 * circle_radius),
        dt_(dt) {}

  /// Updates the records. `manifolds` has one manifold for each contact. There may be none, since edges that meet need
  /// not overlap.
  void update(std::span<Contact> contacts, std::span<const geometry::ContactManifold> manifolds, const Bodies& bodies);

  /// Ends all contacts, because the pair no longer touches.
  void end(const Bodies& bodies);

 private:
  /// Place and extent of a contact in b's frame.
  struct Patch {
    geometry::Point middle;   ///< middle of the contact line; of a pierced body the centroid of the overlap [m]
    geometry::Vector normal;  ///< normal of the contact, from a into b
    double half_width;        ///< half length of the contact line [m]
    double depth;             ///< depth of the overlap [m]
    double reach;             ///< largest distance of the contact's points from `middle` [m]
    bool is_pierced;          ///< true if one body pierces the other
    /// Returns true if a point of b lies in the overlap.
    bool holds(geometry::Point point_in_b) const;
  };
  static Patch patch_of(const Contact& contact, const geometry::ContactManifold& manifold, const Bodies& bodies);
  bool continues_one(std::span<Contact> contacts, std::span<const geometry::ContactManifold> manifolds,
                     const Bodies& bodies);
  void update_several(std::span<Contact> contacts, std::span<const geometry::ContactManifold> manifolds,
                      const Bodies& bodies);
  double reach_of(const PersistentContact& record, const Patch& patch) const;
  PersistentContact record_of(const Contact& contact, const Patch& patch, const Bodies& bodies);
  void take_parts(std::span<const Contact> contacts, std::size_t part);
  void join_left_over(std::span<Contact> contacts, std::span<const geometry::ContactManifold> manifolds,
                      const Bodies& bodies);
  void note_parted(const PersistentContact& record, const Bodies& bodies);
  void advance(PersistentContact& record, const Contact& contact, const Patch& patch) const;

  BodyIndex a_, b_;
  std::vector<PersistentContact>& records_;
  std::vector<PersistentContact>& updated_;
  std::vector<PartedContact>& parted_;
  // Distance that a contact may move in a step and still be the same one, in addition to its extent [m]. Smaller: the
  // record of a contact that slides fast ends, and a new one begins. Larger: a record may pass to another contact.
  double tolerance_;
  double dt_;
};

}  // namespace polynya::dynamics
