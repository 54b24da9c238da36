#pragma once

#include <cstdint>
#include <limits>

#include "dynamics/bodies.hpp"

namespace polynya::dynamics {

/// What restitution keeps of a contact from step to step (restitution_law.hpp); 0 by the law of crushing ice.
struct RestitutionMemory {
  double owed_impulse = 0;           ///< that crushing ice could not carry yet [N s]
  double given_impulse = 0;          ///< since first contact [N s]
  double limit = 0;                  ///< of it, by the fastest approach so far of the two alone [N s]
  double start_impulse[2] = {0, 0};  ///< where the next step starts, by the compression of the last two [N s]
};

/// What became of the paid overlap of a contact. By the law of crushing ice.
struct Booked {
  double crushed = 0;  ///< the area that work crushed [m²]
  double tilted = 0;   ///< the area where the floe's edge gave way: it broke, tilted or bent down [m²]
  double volume = 0;   ///< of the ice that work crushed [m³]
  double work = 0;     ///< that crushed it [J]

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

/// The ice that a contact crushed and that is not cut off yet. By the law of crushing ice.
struct CrushedIce {
  geometry::Pose a_from_b;  ///< of the two bodies' frames, where the largest overlap pressed
  double area = 0;          ///< of that overlap [m²]; 0: nothing was crushed
};

/// What is kept of a contact from step to step.
struct PersistentContact {
  geometry::Point last_point_in_b;   ///< where it was at the last step, in b's frame [m]
  geometry::Point first_touch_in_b;  ///< the point of b that was touched first [m]
  double age = 0;                    ///< since first contact [s]
  double approach = 0;               ///< ∫ max(0, v_n) dt [m]
  double crushed_depth = 0;          ///< overlap that crushing made: the ice is gone, nothing separates it [m]
  double last_impulse[2] = {0, 0};   ///< of compression, at each end, in the last substep solved [N s]
  double last_slip_impulse = 0;      ///< along the contact line, there [N s]
  double last_substep = 0;           ///< how long that was; 0 by restitution [s]
  double paid_area = 0;              ///< of the overlap, the part whose ice is gone (paid_overlap.hpp) [m²]
  double area = 0;                   ///< of the overlap, as expected at the end of the last step [m²]
  double reach = 0;                  ///< of the contact from last_point_in_b, at the last step [m]
  std::int64_t load_track = 0;       ///< of what follows its force from step to step; 0: nothing does
  RestitutionMemory restitution;
  double stored_energy = 0;  ///< that compression took and restitution has not given back; by the law of impulses [J]
  CrushedIce crushed;
  Booked booked;
  bool has_crushed = false;
  bool is_pierced = false;    ///< of a pierced body, at the last step
  bool was_refused = false;   ///< a fracture here was rejected by geometry: not tried again
  bool is_inherited = false;  ///< of the body that this one broke from: states only what is paid
  bool is_continued = false;  ///< already taken over by a contact of the next step
};

/// Two bodies that overlap, at one step. In the water frame; the normal points from a into b; a < b.
struct Contact {
  BodyIndex a = 0;
  BodyIndex b = 0;
  geometry::Point ends[2];   ///< the ends of the contact line [m]
  geometry::Point tip_of_b;  ///< the point of b farthest inside a [m]
  geometry::Point tip_of_a;  ///< the corner of a farthest inside b; the line's middle where none is [m]
  geometry::Vector normal;   ///< unit
  double width = 0;          ///< of the contact line [m]
  double depth = 0;          ///< of the overlap along the normal [m]
  double area = 0;           ///< of the overlap [m²]
  double paid_depth = 0;     ///< the depth to which the overlap is paid, at the start of the step [m]
  /// Length of the contact line once the two have closed at approach_speed for the step, to a thousandth, and at least
  /// its width; 0 where they do not come beyond what is paid [m].
  double width_ahead = 0;
  double approach_speed = 0;            ///< v_n at the middle, positive when approaching [m/s]
  double slip_speed = 0;                ///< along the contact line [m/s]
  std::uint32_t tip_edge_of_b = 0;      ///< the edge of b that starts at the tip, or that the tip is on
  std::uint32_t place = 0;              ///< among the contacts of its two bodies
  bool is_new = false;                  ///< its overlap was found in this step for the first time
  PersistentContact* record = nullptr;  ///< in its pair; valid during the step

  // Decided between finding and solving, along the normal, both ends together.
  double friction = 0;  ///< most tangential per normal impulse [-]
  /// F, what crushing ice carries at the depth of the overlap or the paid depth, whichever is greater [N]; infinite:
  /// steel on steel, which does not crush.
  double crushing_force = std::numeric_limits<double>::infinity();
  double crushing_stiffness = 0;  ///< k = dF/dξ there [N/m]
  double crushing_share = 1;      ///< F as a fraction of the force that crushes the ice: less where the floe tilts [-]
  /// The most that the ice along the contact bears, however deep the overlap becomes in the step [N].
  double most_force = std::numeric_limits<double>::infinity();
  double missed_impulse = 0;  ///< in the step of the first contact, before it was found [N s]
  double breaking_force = std::numeric_limits<double>::infinity();  ///< at which the ice breaks [N]

  // Found by the solver.
  double normal_impulse[2] = {0, 0};  ///< on b along the normal, at each end [N s]
  double normal_work = 0;             ///< of the normal impulses on the two bodies together [J]
  double slip_work = 0;               ///< of the slip impulse [J]
  double restored_work = 0;           ///< of the normal impulses by which restitution gave back what was stored [J]
  double depth_after = 0;             ///< expected of the overlap at the end of the step [m]
  double paid_depth_after = 0;        ///< the depth to which work has paid it then [m]
  double paying_work = 0;             ///< of the contact's work in the step, what paid [J]
  double paid_by_work = 0;            ///< growth of the paid area in the step by ice that this work crushed [m²]
  double paid_by_giving_way = 0;      ///< growth of the paid area in the step by ice that broke or tilted [m²]
  bool is_at_limit = false;           ///< it pressed with all that crushing ice carries
  bool is_broken = false;             ///< the force reached breaking_force
  double steady_share = 1;            ///< of the impulses: without what was missed before the contact was found [-]
  double prescribed_work = 0;         ///< by one of prescribed motion on the other [J]
  double slip_impulse = 0;            ///< on b along perpendicular(normal), anywhere on the line [N s]

  bool gives_way = false;  ///< the floe tilts rather than bears what crushing it takes

  geometry::Point middle() const { return midpoint(ends[0], ends[1]); }
  double total_normal_impulse() const { return normal_impulse[0] + normal_impulse[1]; }
  geometry::Vector impulse_on_b() const {  ///< [N s]
    return total_normal_impulse() * normal + slip_impulse * perpendicular(normal);
  }
  /// The point of the contact line through which that impulse turns the bodies as its two ends do [m].
  geometry::Point centre_of_pressure() const {
    const double total = total_normal_impulse();
    return total > 0 ? ends[0] + (normal_impulse[1] / total) * (ends[1] - ends[0]) : middle();
  }
  bool is_rigid() const { return crushing_force == std::numeric_limits<double>::infinity(); }
};

/// Two bodies that are in each other where the gradient of the overlap's area does not show it: no contact
/// parts them.
struct BlindOverlap {
  BodyIndex a = 0;
  BodyIndex b = 0;
  bool is_inside = false;  ///< one is all inside the other, without a crossing
  double area = 0;         ///< of the pair's blind overlaps [m²]; 0 where is_inside
  double width = 0;        ///< |R| of the largest of them [m]
  double least_width = 0;  ///< below which the overlap is blind [m]
  geometry::Point middle;  ///< of the largest, in the water frame [m]
};

/// Two bodies whose contact ended: they have parted there.
struct PartedContact {
  BodyIndex a = 0;
  BodyIndex b = 0;
  CrushedIce crushed;
  geometry::Point middle;  ///< of the contact when it was last found, in the water frame [m]
};

}  // namespace polynya::dynamics
