#pragma once

#include "fracture/materials.hpp"

namespace polynya::fracture {

// A floe whose edge an inclined hull presses down tilts, and goes under when its edge is deep enough. Own law
// (docs/theory/under-hull.md): hydrostatics of a rigid floe, and its inertia.

struct TiltSettings {
  double added_mass_factor = 1;  ///< c_a, of a disc's added mass in heave [-]
  double damping = 0.3;          ///< ζ, damping of the edge's motion as a fraction of its angular frequency [-]
  double edge_deflection = 0.9;  ///< c_g: the edge goes under at this depth over the thickness [-]
  friend bool operator==(const TiltSettings&, const TiltSettings&) = default;
};

/// The resistance of a floe of area A and thickness h to the pressing down of its near edge.
struct TiltResistance {
  double stiffness = 0;  ///< k = ρ_w g A / 4 [N/m]
  double capacity = 0;   ///< V_rot = ρ_w g h A √r (1 − √r), r = ρ_i/ρ_w: largest force that it withstands [N]
  double mass = 0;  ///< m_e = ¼ [ρ_i h A + c_a 4/3 ρ_w (A/π)^1.5]: effective mass of the edge, with the water's [kg]

  double at(double deflection) const;  ///< R(w) = min(k w, V_rot) [N]
};

/// Returns the resistance of a floe of this area [m²], taken as rigid and compact. The ice must be lighter than the
/// water.
TiltResistance tilt_resistance(const Ice& ice, const Water& water, double area, double added_mass_factor);

/// The depth to which a floe's edge is pressed down, and its speed.
struct EdgeMotion {
  double deflection = 0;  ///< w ≥ 0 [m]
  double rate = 0;        ///< dw/dt [m/s]
};

/// Returns the largest vertical force that a contact transmits, V_lim = R(w) + m_e max(0, u − ẇ)/Δt with u = v_n / tan
/// θ_s [N]. With it the edge is as fast at the end of dt [s] as the hull slides it down, at `slide_speed` u [m/s].
double most_vertical_force(const TiltResistance& resistance, const EdgeMotion& motion, double slide_speed, double dt);

/// Returns the motion of the edge after dt [s] under a vertical force [N]: m_e ẅ = V − R(w), with ẇ decaying at the
/// rate ζ √(k/m_e). The floe comes to rest where it floats, at w = 0.
EdgeMotion tilted(const TiltResistance& resistance, const EdgeMotion& motion, double vertical_force, double damping,
                  double dt);

}  // namespace polynya::fracture
