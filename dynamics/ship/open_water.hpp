#pragma once

#include <optional>

#include "dynamics/ship/manoeuvring.hpp"

namespace polynya::dynamics {

// Estimates, by published regressions from main dimensions, of values that a designer has not stated yet. The
// simulation itself does not use them.

/// Diameter of a propeller over the ship's draught, used if the diameter is not stated (recall) [-].
inline constexpr double kPropellerOfDraught = 0.65;

/// Returns the half angle of entrance of the waterline by the regression of [Holtrop1984], with the centre of buoyancy
/// amidships [rad]; nullopt if the hull is too full for the regression (prismatic coefficient above 0.85).
std::optional<double> usual_entrance_angle(const MainDimensions& hull);

/// Returns a block coefficient that suits a speed [m/s], 0.14/Fn × (L/B + 20)/26, from 0.48 to 0.85 [Schneekluth1998].
double usual_block_coefficient(double length, double beam, double speed);

/// Resistance of a hull in deep calm water [N] by [Holtrop1984]: friction with a form factor, correlation allowance and
/// waves. `entrance` is the half angle of the waterline at the stem [rad], `speed` > 0 [m/s], `density` of the water
/// [kg/m³]. The midship and waterplane coefficients follow from the block coefficient by [Schneekluth1998].
/// Returns nullopt outside the regression: a prismatic coefficient above 0.85 or a Froude number above 0.4.
/// Deviation: no bulb, immersed transom or appendages; the centre of buoyancy lies amidships.
std::optional<double> open_water_resistance(const MainDimensions& hull, double entrance, double speed, double density);

/// Fraction of the installed power that goes into open_water_resistance() at the open-water speed [-]. Fitted: the
/// middle of the values of six known ships, 0.18 to 0.49 (docs/ships.md, "What a file does not state"). It is low
/// because the bows of icebreakers have more resistance than the hulls of the regression, and their propellers are made
/// for slow speeds.
inline constexpr double kPowerIntoResistance = 0.28;

/// Returns the speed at which that fraction of a power [W] overcomes the resistance [m/s]; nullopt if the regression
/// does not reach it.
std::optional<double> usual_open_water_speed(const MainDimensions& hull, double entrance, double power, double density);

}  // namespace polynya::dynamics
