#pragma once

#include "fracture/materials.hpp"

namespace polynya::fracture {

/// A cusp as it breaks off: the hull presses its near edge down, and it turns about its far one.
struct TurningCusp {
  double area = 0;           ///< A [m²]
  double depth = 0;          ///< R, from the axis to the point that is farthest from it [m]
  double second_moment = 0;  ///< J, about the axis [m⁴]
};

/// What the edge of a turning cusp weighs, M = ρ_i h J/R² + (9π/256) ρ_w A R/√(1 + (R/b)²), b = A/R [kg]: its own
/// inertia, and that of the water below, half of a plate's that turns about its edge in water without bounds. That
/// is what water with a free surface around has; ice around makes it more (docs/theory/bow.md).
double edge_mass(const Ice& ice, const Water& water, const TurningCusp& cusp);

}  // namespace polynya::fracture
