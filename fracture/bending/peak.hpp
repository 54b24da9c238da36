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

}  // namespace polynya::fracture
