#pragma once

#include <cmath>

#include "fracture/materials.hpp"

namespace polynya::fracture {

/// Which reading of Eq. (7) of [Sawamura2017] decides whether a floe is large enough to break.
enum class CharacteristicLength {
  kFourthRoot,  ///< (D / ρ_w g)^¼: the length by its definition, in metres
  kAsPrinted,   ///< (D / ρ_w g)^½: as the paper prints it; its unit is m², its story needs this number
};

/// The characteristic length of a floating plate, l = (D / ρ_w g)^¼ [m], the scale over which it bends.
/// Eq. (7) of [Sawamura2017]. Deviation: the paper prints a square root; see CharacteristicLength.
inline double characteristic_length(const Ice& ice, const Water& water) {
  return std::sqrt(std::sqrt(flexural_rigidity(ice) / (water.density * kGravity)));
}

/// The length that a floe's size is compared with, by the chosen reading of Eq. (7) [m].
inline double breakable_length(const Ice& ice, const Water& water, CharacteristicLength reading) {
  const double l = characteristic_length(ice, water);
  return reading == CharacteristicLength::kFourthRoot ? l : l * l;
}

}  // namespace polynya::fracture
