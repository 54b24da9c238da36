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

/// The coefficients of Kashtelyan's semi-empirical wedge (*recall*: after [Kashtelyan1968] as used in
/// [Lubbad2011]; the source could not be looked up here).
struct KashtelyanCoefficients {
  double force = 3.1;            ///< C_f [-]
  double radius = 0.32;          ///< C_l [-]
  double radius_speed = -0.144;  ///< C_v [s/m]
};

inline constexpr double kSmallestKashtelyanRadiusFactor = 0.2;  ///< floor of 1 + C_v v: reached at v = 5.6 m/s [-]

/// Force that breaks a wedge of opening angle θ, P = C_f (θ/π)² σ_f h² [N].
/// θ the whole opening angle 2α [rad], σ_f flexural strength [Pa], h thickness [m].
double kashtelyan_force(double opening_angle, const Ice& ice, const KashtelyanCoefficients& coefficients = {});

/// Cusp radius R = C_l l (1 + C_v v) [m]; the factor is clamped to its floor beyond its range of speed.
/// l characteristic length [m], v normal approach speed [m/s].
double kashtelyan_radius(double characteristic_length, double approach_speed,
                         const KashtelyanCoefficients& coefficients = {});

/// Kashtelyan's wedge under the simulation's load: θ = θ_wf + θ_wb.
class KashtelyanModel final : public BendingModel {
 public:
  explicit KashtelyanModel(const KashtelyanCoefficients& coefficients = {}) : coefficients_(coefficients) {}
  /// Out of range where the speed has driven the radius to its floor.
  BendingCapacity capacity(const BendingLoad& load) const override;

 private:
  KashtelyanCoefficients coefficients_;
};

}  // namespace polynya::fracture
