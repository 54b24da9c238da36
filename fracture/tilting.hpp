#pragma once

#include "fracture/materials.hpp"

namespace polynya::fracture {

// A floe that an inclined hull presses down at its edge tilts, and goes under where its edge is deep enough.
// Own law (docs/theory/under-hull.md): the hydrostatics of a rigid floe, and its inertia.

struct TiltSettings {
  double added_mass_factor = 1;  ///< c_a, of a disc's added mass in heave [-]
  double damping = 0.3;          ///< ζ, of the edge's motion, as a share of its frequency [-]
  double edge_deflection = 0.9;  ///< c_g: the edge goes under at this times the thickness [-]
  friend bool operator==(const TiltSettings&, const TiltSettings&) = default;
};

/// What resists the pressing down of a floe's near edge, of area A and thickness h.
struct TiltResistance {
  double stiffness = 0;  ///< k = ρ_w g A / 4 [N/m]
  double capacity = 0;   ///< V_rot = ρ_w g h A √r (1 − √r), r = ρ_i/ρ_w: the most it bears [N]
  double mass = 0;       ///< m_e = ¼ [ρ_i h A + c_a 4/3 ρ_w (A/π)^1.5]: of the edge, with the water's [kg]

  double at(double deflection) const;  ///< R(w) = min(k w, V_rot) [N]
};

/// Of a floe of that area [m²], taken as rigid and compact; the ice lighter than the water.
TiltResistance tilt_resistance(const Ice& ice, const Water& water, double area, double added_mass_factor);

/// How far a floe's edge is pressed down, and how fast.
struct EdgeMotion {
  double deflection = 0;  ///< w ≥ 0 [m]
  double rate = 0;        ///< dw/dt [m/s]
};

/// The vertical force with which the edge is as fast at the end of dt [s] as the hull slides it down: a
/// contact transmits no more. V_lim = R(w) + m_e max(0, u − ẇ)/Δt, u = v_n / tan θ_s [m/s] [N].
double most_vertical_force(const TiltResistance& resistance, const EdgeMotion& motion, double slide_speed, double dt);

/// The edge dt [s] later, under a vertical force [N]: m_e ẅ = V − R(w), with ẇ decaying at ζ √(k/m_e). The
/// floe comes to rest where it floats, w = 0.
EdgeMotion tilted(const TiltResistance& resistance, const EdgeMotion& motion, double vertical_force, double damping,
                  double dt);

}  // namespace polynya::fracture
