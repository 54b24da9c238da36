#pragma once

#include "fracture/bending/bending_model.hpp"

namespace polynya::fracture {

/// Deflection of a floating wedge's tip, per V / (ρ_w g l²) of the force V on it [-], where that force has
/// grown as t² for a duration since it was unloaded: at first the ice and the water below it hold it up by
/// their inertia, after a few t0 it has the deflection of a wedge at rest. opening_angle 2α [rad]; duration
/// in t0 = √(l/g).
///   w / V = Σ_k c_k [1 − 2 (1 − cos ω_k t) / (ω_k t)²]
/// over the modes of the plate on its water (potential flow, docs/theory/bending.md, "Modes and march"), tabulated
/// for m̂ 0.05 and a small loaded patch (0.02 l). Within 2 % of that sum between the table's points from 20°
/// to 180°; for mass ratios from 0.02 to 0.1 within 25 %, and within 12 % from t0 on. Outside of the table
/// its nearest edge.
double tip_compliance(double opening_angle, double duration);

/// How far the edge that a hull presses down recedes from it, per crushed area: tan θ_s w = r A_c, r = tan
/// θ_s C σ_c c_V / (ρ_w g l²) [m/m²], 0 where the hull does not press it down. `travel` is how far the hull
/// has come since it touched the ice as it lay [m], at the load's mean speed: the force on a wedge has grown
/// as the square of the time since.
double recession_per_area(const BendingLoad& load, double travel);

}  // namespace polynya::fracture
