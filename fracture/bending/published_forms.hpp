#pragma once

#include <numbers>

#include "fracture/bending/bending_model.hpp"

namespace polynya::fracture {
/// Largest load length a / l for which Nevel's wedge is used [-]: at 1 his formula for the force is 4 % below the beam
/// that it approximates.
inline constexpr double kLargestNevelLoadLength = 1;

/// Widest opening angle for which Nevel's wedge is used [rad]. Compared with our plate at rest, his form is within 4 %
/// in force and 2 % in radius up to 60°. At 90° the radius is up to 18 % too small; at 120° the force is 12 % or more
/// too large.
inline constexpr double kWidestNevelWedge = std::numbers::pi / 3;

/// Returns the force that breaks a narrow floating wedge under a load of length a on its tip [N]:
///   6 P / (b0 σ_f h²) = 1.05 + 2 (a/l) + ½ (a/l)³
/// (*recall*: after [Nevel1961]; checked here against the wedge as a beam, tests/fracture/bending/floating_beam.hpp).
/// b0 = 2 tan α is the growth of the wedge's width with the distance from its tip, and 2α its opening angle [rad]; σ_f
/// [Pa], h [m]. The formula is meant for narrow wedges: tan α diverges towards a straight edge.
double nevel_force(double opening_angle, double load_length_over_l, const Ice& ice);

/// Returns the distance from the tip at which Nevel's wedge breaks, at the largest bending stress, over l [-]. From a
/// table of our own solution of (x w'')'' + x w = q (tests/fracture/bending/floating_beam.hpp), since Nevel's force
/// form gives no radius. Within 0.1 % of that solution for 0 ≤ a/l ≤ 3.375; beyond, it grows as (a/l)^⅓.
double nevel_cusp_radius_over_l(double load_length_over_l);

/// Nevel's wedge under the simulation's load: 2α = θ_wf + θ_wb; the load length is the penetration ξ.
class NevelModel final : public BendingModel {
 public:
  /// The result is out of range if a / l exceeds kLargestNevelLoadLength or 2α exceeds kWidestNevelWedge.
  BendingCapacity capacity(const BendingLoad& load) const override;
};

/// Returns the force that breaks Kashtelyan's semi-empirical wedge, P = C_f (θ/π)² σ_f h², C_f 3.1 [N] (*recall*: after
/// [Kashtelyan1968] as used in [Lubbad2011]; the source was not available). θ is the whole opening angle 2α [rad], σ_f
/// the flexural strength [Pa], h the thickness [m].
double kashtelyan_force(double opening_angle, const Ice& ice);

/// Returns the cusp radius of that wedge, R = C_l l (1 + C_v v), with C_l 0.32 and C_v −0.144 s/m [m]. The factor is
/// limited to at least 0.2, which it reaches at 5.6 m/s, the end of its range of speed. l is the characteristic length
/// [m], v the normal approach speed [m/s].
double kashtelyan_radius(double characteristic_length, double approach_speed);

/// Kashtelyan's wedge under the simulation's load: θ = θ_wf + θ_wb.
class KashtelyanModel final : public BendingModel {
 public:
  /// The result is out of range if the speed has driven the radius to its lower limit.
  BendingCapacity capacity(const BendingLoad& load) const override;
};

}  // namespace polynya::fracture
