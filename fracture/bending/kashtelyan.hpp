#pragma once

#include "fracture/bending/bending_model.hpp"

namespace polynya::fracture {

/// The coefficients of Kashtelyan's semi-empirical wedge (*recall*: after [Kashtelyan1968] as used in
/// [Lubbad2011]; the source could not be looked up here).
struct KashtelyanCoefficients {
  double force = 3.1;            ///< C_f [-]
  double radius = 0.32;          ///< C_l [-]
  double radius_speed = -0.144;  ///< C_v [s/m]
};

inline constexpr double kSmallestKashtelyanRadiusFactor =
    0.2;  ///< floor of 1 + C_v v: reached at v = 5.6 m/s [-]

/// Force that breaks a wedge of opening angle θ, P = C_f (θ/π)² σ_f h² [N].
/// θ the whole opening angle 2α [rad], σ_f flexural strength [Pa], h thickness [m].
double kashtelyan_force(double opening_angle, const Ice& ice,
                        const KashtelyanCoefficients& coefficients = {});

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
