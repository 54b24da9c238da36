#pragma once

#include <cmath>

#include "fracture/materials.hpp"

namespace polynya::fracture {

/// The readings of Eq. (7) of [Sawamura2017] that decide whether a floe is large enough to break.
enum class CharacteristicLength {
  kFourthRoot,  ///< (D / ρ_w g)^¼: the length by its definition [m]
  kAsPrinted,   ///< (D / ρ_w g)^½, as the paper prints it: its unit is m², but the paper's results need this number
};

/// Returns the characteristic length of a floating plate, l = (D / ρ_w g)^¼ [m], the scale over which it bends. Eq. (7)
/// of [Sawamura2017]. Deviation: the paper prints a square root; see CharacteristicLength.
inline double characteristic_length(const Ice& ice, const Water& water) {
  return std::sqrt(std::sqrt(flexural_rigidity(ice) / (water.density * kGravity)));
}

/// Returns the length with which a floe's size is compared, by the chosen reading of Eq. (7) [m].
inline double breakable_length(const Ice& ice, const Water& water, CharacteristicLength reading) {
  const double l = characteristic_length(ice, water);
  return reading == CharacteristicLength::kFourthRoot ? l : l * l;
}

}  // namespace polynya::fracture
