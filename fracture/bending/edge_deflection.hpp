#pragma once

#include "fracture/bending/bending_model.hpp"

namespace polynya::fracture {

/// Returns the deflection w of a floating wedge's tip over V / (ρ_w g l²), for a force V on it that has grown as t² for
/// a duration since it was zero [-]. At first the inertia of the ice and the water below supports the tip; after a few
/// t0 it has the deflection of a wedge at rest. `opening_angle` is 2α [rad], `duration` is in t0 = √(l/g).
///   w / V = Σ_k c_k [1 − 2 (1 − cos ω_k t) / (ω_k t)²]
/// is summed over the modes of the plate on its water (potential flow, docs/theory/bending.md, "Modes and march") and
/// tabulated for m̂ 0.05 and a small loaded patch (0.02 l). Between the table's points it is within 2 % of that sum
/// from 20° to 180°. For mass ratios from 0.02 to 0.1 it is within 25 %, and within 12 % from t0 on. Outside of the
/// table the nearest edge is used.
double tip_compliance(double opening_angle, double duration);

/// Returns by how much the edge that a hull presses down recedes from the hull, per crushed area: tan θ_s w = r A_c
/// with r = tan θ_s C σ_c c_V / (ρ_w g l²) [m/m²] and C = tip_compliance(); 0 if the hull does not press it down.
/// `travel` is the distance that the hull has moved since it touched the undeflected ice [m], at the load's mean speed;
/// the force on a wedge has grown as the square of the time since then.
double recession_per_area(const BendingLoad& load, double travel);

}  // namespace polynya::fracture
