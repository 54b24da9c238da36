#pragma once

#include <span>

namespace polynya::fracture {

/// The largest value of a sampled smooth function and where it lies.
struct Peak {
  double place = 0;
  double value = 0;
};

/// Returns the largest sample, refined by the parabola through it and its two neighbours. `places` is ascending and has
/// at least one element.
Peak find_peak(std::span<const double> places, std::span<const double> values);

/// Returns the place of a flat maximum under slightly uneven samples. It is the maximum of the polynomial of fourth
/// degree in ln(place) that fits the samples around it best, by least squares with weights that taper to zero at a
/// factor kFlatPeakReach on either side and are centred on the result. `places` is ascending and positive. Uses
/// find_peak() if the polynomial has no maximum inside its reach, or if fewer than seven samples lie there.
double find_flat_peak(std::span<const double> places, std::span<const double> values);

/// Factor on either side of a flat maximum within which samples are fitted [-]. Smaller: the unevenness of samples
/// moves the place. Larger: a polynomial of fourth degree no longer fits the maximum.
inline constexpr double kFlatPeakReach = 2.5;

}  // namespace polynya::fracture
