#pragma once

#include <span>

namespace polynya::fracture {

/// The largest value of a sampled smooth function and where it lies.
struct Peak {
  double place = 0;
  double value = 0;
};

/// Greatest sample, refined by the parabola through it and its two neighbours. places ascending, at least
/// one.
Peak find_peak(std::span<const double> places, std::span<const double> values);

/// Place of a flat maximum under slightly uneven samples: of the quartic in ln(place) that fits them best
/// around it, in least squares with weights that taper to zero at a factor kFlatPeakReach on either side,
/// centred on the answer. places ascending and positive. Falls back on find_peak() where the quartic has no
/// maximum inside its reach.
double find_flat_peak(std::span<const double> places, std::span<const double> values);

/// Narrower, and the unevenness of samples moves the place; wider, and a quartic no longer fits the maximum.
inline constexpr double kFlatPeakReach = 2.5;

}  // namespace polynya::fracture
