#pragma once

#include "dynamics/contact/contact.hpp"

namespace polynya::dynamics {

/// Paid overlap. If ice crushes, two bodies may overlap where the ice of one is gone: that overlap is called paid
/// (docs/theory/contact.md). The record of a contact keeps the paid area. Only three things increase it: the work of
/// the contact's impulses (normal and along its line), ice that breaks or tilts at the contact, and, for bodies with
/// prescribed motion, the motion itself. Overlap beyond the paid area presses the two bodies apart until it is undone
/// or paid.
///
/// The relation between area S and depth ξ of an overlap is the power law of its measures, S(ξ') = S (ξ'/ξ)^p, with p =
/// ξ w / S between 1/3 and 3, where w is the length of the contact line (fracture::Overlap).

/// Returns true if an overlap is a crescent: ξ w > 3 S. Such an overlap is left where a body has been cut out of the
/// ice and has moved on since. It is a band along the outline of the body, much thinner than it is deep along the
/// contact's normal, so that the power law does not describe it. It grows by dS = w dξ, as every overlap does.
///
/// Only contacts of two bodies with prescribed motion are crescents by the law of crushing ice: for all others the
/// narrow phase takes the mean thickness of a crescent as its depth.
bool is_crescent(double depth, double width, double area);
inline bool is_crescent(const Contact& contact) {
  return is_crescent(contact.depth, contact.width, contact.area);
}

/// Returns the depth at which a contact's overlap would have an area [m²], by that power law or as a crescent [m].
double depth_at(const Contact& contact, double area);

/// Returns the area that a contact's overlap would have at a depth [m], by that power law or as a crescent [m²].
double area_at(const Contact& contact, double depth);

/// The force of crushing ice near a depth: F(ξ) = force (ξ/depth)^n.
struct CrushingForce {
  double force = 0;     ///< at the depth [N]
  double exponent = 0;  ///< n, ≥ 0 [-]
  double depth = 0;     ///< [m]
};

/// Returns F at another depth [N].
double force_at(const CrushingForce& law, double depth);

/// Returns the stiffness of F while the depth grows by `further` [m]: dF/dξ if n ≥ 1 or the growth is small, otherwise
/// the mean, (F(ξ + further) − F(ξ)) / further [N/m]. A tangent would let the force of a shallow overlap grow beyond
/// what the ice carries if the overlap becomes several times as deep in one step.
double stiffness_over(const CrushingForce& law, double further);

/// The overlap that work has paid.
struct Payment {
  double depth = 0;  ///< depth up to which the overlap is paid [m]
  double work = 0;   ///< work that paid it; less than the given work if all of the overlap is paid [J]
};

/// Moves the paid depth m to m' such that the work of crushing between them, ∫ F dξ, equals the given work [J]. The
/// paid depth never exceeds the depth reached and never decreases. Remaining work has slowed the bodies without
/// crushing further ice.
Payment pay(const CrushingForce& law, double paid_depth, double depth_reached, double work);

/// Sets the contact's paid depth from its record.
void enter_paid_depth(Contact& contact);

/// Settles a contact after the solver, with the law of crushing ice. It sets the record's paid area and expected area
/// at the end of the step, and the contact's growth of paid area by work and by breaking and tilting. `are_prescribed`
/// is true if both motions are prescribed: all overlap that presses is then paid.
void settle(bool are_prescribed, Contact& contact);

/// Settles a contact after the solver, with the law of impulses, which does not count work: all overlap that presses is
/// paid.
void settle_collision(const Contact& contact);

/// Stores the overlap that crushed in the record, to be cut off later, if it is the largest so far and at least 90 % of
/// it is paid. Does nothing where the floe tilts, since its ice is not gone.
void remember_crushed(const Bodies& bodies, const Contact& contact);

}  // namespace polynya::dynamics
