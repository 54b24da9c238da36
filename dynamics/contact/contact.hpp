#pragma once

#include <cstdint>
#include <limits>

#include "dynamics/bodies.hpp"

namespace polynya::dynamics {

/// Memory of restitution from step to step, with the law of impulses (restitution_law.hpp). All values are 0 with the
/// law of crushing ice.
struct RestitutionMemory {
  double owed_impulse = 0;   ///< restitution that has not acted yet, because F limits the impulse of a step [N s]
  double given_impulse = 0;  ///< restitution given since first contact [N s]
  double limit = 0;          ///< largest given_impulse, by the fastest approach so far without other contacts [N s]
  double start_impulse[2] = {0, 0};  ///< compression at each end predicted for the next step, its start there [N s]
};

/// Account of the paid overlap of a contact, with the law of crushing ice.
struct Booked {
  double crushed = 0;  ///< area that work crushed [m²]
  double tilted = 0;   ///< area where the floe's edge gave way: it broke, tilted or bent down [m²]
  double volume = 0;   ///< volume of the ice that work crushed [m³]
  double work = 0;     ///< work of the normal force that crushed it [J]

  friend Booked operator*(double share, const Booked& b) {
    return {share * b.crushed, share * b.tilted, share * b.volume, share * b.work};
  }
  Booked& operator+=(const Booked& b) {
    crushed += b.crushed;
    tilted += b.tilted;
    volume += b.volume;
    work += b.work;
    return *this;
  }
};

/// The ice that a contact crushed and that is not cut off yet, with the law of crushing ice.
struct CrushedIce {
  geometry::Pose a_from_b;  ///< relative pose of the two body frames at which the largest overlap pressed
  double area = 0;          ///< area of that overlap [m²]; 0: nothing was crushed
};

/// Data of a contact that are kept from step to step.
struct PersistentContact {
  geometry::Point last_point_in_b;   ///< middle of the contact at the last step, in b's frame [m]
  geometry::Point first_touch_in_b;  ///< point of b that was touched first, the centre of a cusp [m]
  double age = 0;                    ///< time since first contact; 0: the record is new [s]
  double approach = 0;               ///< ∫ max(0, v_n) dt; over `age` the mean speed that bending uses [m]
  double crushed_depth = 0;          ///< depth of overlap that crushing made; separate() does not reduce it [m]
  double last_impulse[2] = {0, 0};   ///< normal impulse of compression at each end, in the last substep solved [N s]
  double last_slip_impulse = 0;      ///< impulse along the contact line in that substep [N s]
  double paid_area = 0;              ///< part of the overlap's area whose ice is gone (paid_overlap.hpp) [m²]
  /// Expected area of the overlap at the end of the last step [m²]. What exceeds the paid area is reported as not paid;
  /// 0 in the step in which the overlap is found.
  double area = 0;
  double reach = 0;             ///< extent of the contact from last_point_in_b, by which a pierced one is matched [m]
  std::int64_t load_track = 0;       ///< number of the track that follows its force over the steps; 0: none
  RestitutionMemory restitution;
  /// Law of impulses: energy that compression took and restitution has not given back [J].
  double stored_energy = 0;
  CrushedIce crushed;
  Booked booked;
  bool has_crushed = false;   ///< ice was crushed here (is_at_limit) while the bodies approached; counted once
  bool is_pierced = false;    ///< one body pierced the other at the last step
  bool was_refused = false;   ///< geometry rejected a fracture here: it is not tried again
  bool is_inherited = false;  ///< record of the body that this one broke from: states only the paid area
  bool is_continued = false;  ///< a contact of the next step has already taken it over
};

/// An overlap of two bodies in one step, in the water frame. The normal points from a into b; a < b.
struct Contact {
  BodyIndex a = 0;
  BodyIndex b = 0;
  geometry::Point ends[2];   ///< the ends of the contact line [m]
  geometry::Point tip_of_b;  ///< point of b farthest inside a, where its wedge angle is measured and it may crack [m]
  geometry::Point tip_of_a;  ///< corner of a farthest inside b, likewise; the middle of the line if there is none [m]
  geometry::Vector normal;   ///< unit vector
  double width = 0;          ///< length of the contact line [m]
  double depth = 0;          ///< extent of the overlap along the normal; mean thickness of a thin crescent [m]
  double area = 0;           ///< area of the overlap [m²]
  double paid_depth = 0;     ///< depth up to which the overlap is paid, at the start of the step [m]
  /// Length of the contact line after the two bodies have closed at approach_speed for the step, accurate to a
  /// thousandth and at least `width`. It is 0 if they do not close beyond the paid overlap, and with the law of
  /// impulses [m].
  double width_ahead = 0;
  double approach_speed = 0;            ///< v_n at the middle, positive when approaching [m/s]
  double slip_speed = 0;                ///< speed of b relative to a, along perpendicular(normal) [m/s]
  std::uint32_t tip_edge_of_b = 0;      ///< edge of b that starts at tip_of_b or contains it
  std::uint32_t place = 0;              ///< number among the contacts of its two bodies
  bool is_new = false;                  ///< the overlap was found in this step for the first time
  PersistentContact* record = nullptr;  ///< record in its pair; valid during the step

  // Decided between finding and solving; along the normal, both ends together.
  double friction = 0;  ///< largest tangential per normal impulse [-]
  /// F, the force of crushing ice at the larger of the depth and the paid depth [N]. Infinite for steel on steel, which
  /// does not crush.
  double crushing_force = std::numeric_limits<double>::infinity();
  double crushing_stiffness = 0;  ///< k = dF/dξ at that depth [N/m]
  double crushing_share = 1;      ///< F as a fraction of the force that crushes the ice [-]; below 1 if the floe tilts
  /// Largest force that the ice along the contact carries, however deep the overlap becomes in the step [N].
  double most_force = std::numeric_limits<double>::infinity();
  double missed_impulse = 0;  ///< impulse missed before the contact was found, in the step in which it is found [N s]
  double breaking_force = std::numeric_limits<double>::infinity();  ///< force at which the ice breaks [N]

  // Found by the solver.
  double normal_impulse[2] = {0, 0};  ///< on b along the normal, at each end [N s]
  double normal_work = 0;             ///< work of the normal impulses on both bodies together [J]
  double slip_work = 0;               ///< work of the slip impulse [J]
  double restored_work = 0;           ///< work of the normal impulses by which restitution gave back stored energy [J]
  double depth_after = 0;             ///< expected depth of the overlap at the end of the step [m]
  double paid_depth_after = 0;        ///< depth up to which work has then paid it [m]
  double paying_work = 0;             ///< part of the contact's work in the step that paid [J]
  double paid_by_work = 0;            ///< growth of the paid area in the step, for ice that this work crushed [m²]
  double paid_by_giving_way = 0;      ///< growth of the paid area in the step, for ice that broke or tilted [m²]
  bool is_at_limit = false;           ///< ice crushed: the contact pressed (law of impulses: with all of F)
  bool is_broken = false;             ///< the force reached breaking_force
  double step_share = 1;       ///< fraction of the impulses that belongs to this step; the rest is missed_impulse [-]
  double prescribed_work = 0;  ///< work of a body with prescribed motion on the other one [J]
  double slip_impulse = 0;     ///< impulse on b along perpendicular(normal), anywhere on the line [N s]

  bool gives_way = false;  ///< the floe tilts instead of carrying the force that crushes it

  geometry::Point middle() const { return midpoint(ends[0], ends[1]); }
  double total_normal_impulse() const { return normal_impulse[0] + normal_impulse[1]; }
  geometry::Vector impulse_on_b() const {  ///< total impulse on b [N s]
    return total_normal_impulse() * normal + slip_impulse * perpendicular(normal);
  }
  /// Returns the point of the contact line at which the total normal impulse turns the bodies as those at both ends do
  /// [m].
  geometry::Point centre_of_pressure() const {
    const double total = total_normal_impulse();
    return total > 0 ? ends[0] + (normal_impulse[1] / total) * (ends[1] - ends[0]) : middle();
  }
  bool is_rigid() const { return crushing_force == std::numeric_limits<double>::infinity(); }
};

/// Two bodies with an overlap whose area hardly changes when they move apart, in any direction. No contact can separate
/// them.
struct InseparableOverlap {
  BodyIndex a = 0;
  BodyIndex b = 0;
  bool is_inside = false;  ///< one lies completely inside the other, without a crossing
  double area = 0;         ///< area of the pair's inseparable overlaps; 0 if is_inside [m²]
  double width = 0;        ///< length |R| of the contact line of the largest of them (docs/theory/contact.md) [m]
  double least_width = 0;  ///< width below which the overlap is inseparable [m]
  geometry::Point middle;  ///< middle of the largest, in the water frame [m]
};

/// A contact that ended because its two bodies have separated there.
struct PartedContact {
  BodyIndex a = 0;
  BodyIndex b = 0;
  CrushedIce crushed;
  geometry::Point middle;  ///< middle of the contact when it was last found, in the water frame [m]
};

}  // namespace polynya::dynamics
