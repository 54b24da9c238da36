#pragma once

#include <numbers>

#include "fracture/bending/bending_model.hpp"

namespace polynya::fracture {
/// Greatest load length a / l of Nevel's wedge here [-]: at 1 its force form is 4 % below the beam it
/// approximates.
inline constexpr double kLargestNevelLoadLength = 1;

/// Widest opening angle of Nevel's wedge here [rad]. Against our plate at rest his form is within 4 % in
/// force and 2 % in radius up to 60°; at 90° the radius is up to 18 % too small, at 120° the force 12 % too
/// great or more.
inline constexpr double kWidestNevelWedge = std::numbers::pi / 3;

/// Force that breaks a narrow floating wedge under a tip load of length a [N]:
///   6 P / (b0 σ_f h²) = 1.05 + 2 (a/l) + ½ (a/l)³
/// (*recall*: after [Nevel1961]; checked here against the wedge as a beam,
/// tests/fracture/bending/floating_beam.hpp). b0 = 2 tan α is the growth of the wedge's width with the
/// distance from its tip, 2α its opening angle [rad]; σ_f [Pa], h [m]. Meant for narrow wedges: tan α
/// diverges towards a straight edge.
double nevel_force(double opening_angle, double load_length_over_l, const Ice& ice);

/// Where that wedge breaks: distance from its tip to the greatest bending stress, in l [-].
/// From a table of our own solution of (x w'')'' + x w = q (tests/fracture/bending/floating_beam.hpp), since
/// Nevel's force form gives no radius. Within 0.1 % of that solution for 0 ≤ a/l ≤ 3.375; beyond, grows as
/// (a/l)^⅓.
double nevel_cusp_radius_over_l(double load_length_over_l);

/// Nevel's wedge under the simulation's load: 2α = θ_wf + θ_wb, the load length is the penetration ξ.
class NevelModel final : public BendingModel {
 public:
  /// Out of range where a / l exceeds kLargestNevelLoadLength or 2α exceeds kWidestNevelWedge.
  BendingCapacity capacity(const BendingLoad& load) const override;
};

/// Force that breaks Kashtelyan's semi-empirical wedge of opening angle θ, P = C_f (θ/π)² σ_f h², C_f 3.1 [N]
/// (*recall*: after [Kashtelyan1968] as used in [Lubbad2011]; the source could not be looked up here).
/// θ the whole opening angle 2α [rad], σ_f flexural strength [Pa], h thickness [m].
double kashtelyan_force(double opening_angle, const Ice& ice);

/// Its cusp radius R = C_l l (1 + C_v v), C_l .32, C_v −.144 s/m [m]; the factor is clamped to .2 beyond its
/// range of speed, from 5.6 m/s on. l characteristic length [m], v normal approach speed [m/s].
double kashtelyan_radius(double characteristic_length, double approach_speed);

/// Kashtelyan's wedge under the simulation's load: θ = θ_wf + θ_wb.
class KashtelyanModel final : public BendingModel {
 public:
  /// Out of range where the speed has driven the radius to its floor.
  BendingCapacity capacity(const BendingLoad& load) const override;
};

}  // namespace polynya::fracture
