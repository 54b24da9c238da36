#pragma once

#include "dynamics/contact/contact.hpp"

namespace polynya::dynamics {

/// By the law of crushing ice, two bodies may overlap where the ice of one is gone: its overlap is paid
/// (docs/theory/contact.md). A contact's record keeps the paid area. Only three things make it grow: work of the
/// contact's impulses (normal and along its line), ice that breaks or tilts at the contact, and for bodies of
/// prescribed motion the motion itself. Overlap beyond the paid area presses the two apart until it is undone or paid.
///
/// Between area S and depth ξ an overlap is taken as the power law of its measures, S(ξ') = S (ξ'/ξ)^p,
/// p = ξ w / S between 1/3 and 3, w the length of the contact line (fracture::Overlap).

/// The depth at which a contact's overlap would have an area [m²], by that power law [m].
double depth_at(const Contact& contact, double area);

/// The area that a contact's overlap would have at a depth [m], by that power law [m²].
double area_at(const Contact& contact, double depth);

/// The force of crushing ice about a depth: F(ξ) = force (ξ/depth)^n.
struct CrushingForce {
  double force = 0;     ///< at the depth [N]
  double exponent = 0;  ///< n, ≥ 0 [-]
  double depth = 0;     ///< [m]
};

/// F at another depth [N].
double force_at(const CrushingForce& law, double depth);

/// How fast F grows while the depth grows by `further` [m]: dF/dξ where n ≥ 1 or the growth is small, else the mean,
/// (F(ξ + further) − F(ξ)) / further. A tangent would let the force of a shallow overlap grow beyond what the ice bears
/// where the overlap becomes several times as deep in one step [N/m].
double stiffness_over(const CrushingForce& law, double further);

/// What work has paid.
struct Payment {
  double depth = 0;  ///< to which the overlap is paid [m]
  double work = 0;   ///< that paid it: less than the work given where all of the overlap is paid [J]
};

/// Moves the paid depth m to m' where the work of crushing between them, ∫ F dξ, is the work given; not beyond the
/// depth reached, and never back. Work beyond that has slowed the bodies without crushing further ice.
Payment pay(const CrushingForce& law, double paid_depth, double depth_reached, double work);

/// Enters the contact's paid depth by its record.
void enter_paid_depth(Contact& contact);

/// After the solver by the law of crushing ice: enters into the record the area that is paid and the area expected at
/// the end of the step, and into the contact by how much work has made the paid area grow, and breaking and tilting.
void settle(bool are_prescribed, Contact& contact);

/// After the solver by the law of impulses, which does not count work: what presses is paid.
void settle_collision(const Contact& contact);

/// Keeps in the record the overlap that crushed, where it is the largest so far and nearly all of it is paid.
void remember_crushed(const Bodies& bodies, const Contact& contact);

}  // namespace polynya::dynamics
