#pragma once

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "simulation/field/portable_math.hpp"

namespace polynya::simulation {

// How the sizes of a field's floes are distributed. The size of a floe is √area, as for the limit κ l; a disc
// of its area has a diameter of 1.128 sizes. Exponents do not depend on which of them is meant.

struct EqualSizes {
  double size = 15;  ///< [m]
};

/// The logarithm is normal, cut off at three deviations; mean and spread are those before it is cut off.
struct LognormalSizes {
  double mean = 15;     ///< [m]
  double spread = 0.3;  ///< deviation / mean [-]
};

/// N(> d) ∝ d^−a between two bounds, and nothing outside of them [Toyota2006].
struct PowerLawSizes {
  double exponent = 1.87;  ///< a of the number of floes; 0 is even in the logarithm, −1 even in d
  double least = 10;       ///< [m]
  double largest = 100;    ///< [m]
};

using SizeLaw = std::variant<EqualSizes, LognormalSizes, PowerLawSizes>;

/// The size that a share u of the floes stays below, 0 < u < 1 [m]. The same on every machine.
double size_at(const SizeLaw& law, double u);

/// The share of the floes that is smaller [-].
double share_below(const SizeLaw& law, double size);

/// Of a floe [m²].
double mean_area(const SizeLaw& law);

/// So many areas, ascending [m²]: one at random in each of as many equal parts of the law's probability, so
/// that a small field too has the law's small and large floes in their proportion.
std::vector<double> draw_areas(const SizeLaw& law, std::size_t count, Random& random);

/// What came of a size law, over the floes of a field.
struct FieldStatistics {
  SizeLaw law;                    ///< asked for
  double least_size = 0;          ///< [m]
  double largest_size = 0;        ///< [m]
  double distance_to_law = 0;     ///< Kolmogorov and Smirnov's; of equal sizes, the largest deviation / size
  std::optional<SizeLaw> fitted;  ///< by maximum likelihood, of the power law's exponent between its bounds
                                  ///< or the log-normal law's mean and spread; none of equal sizes
  double mean_aspect = 0;         ///< √ of the ratio of the principal second moments [-]
  double mean_corners = 0;
};

/// Of the largest difference between the law and the share of floes below a size [-]. `sizes` ascend.
double kolmogorov_smirnov(const SizeLaw& law, const std::vector<double>& sizes);

/// The exponent of a power law between bounds that makes the sizes likeliest: found by halving, since the
/// mean of ln d falls steadily with it. Sizes beyond a bound count as at it.
double likeliest_exponent(const PowerLawSizes& law, const std::vector<double>& sizes);

FieldStatistics statistics_of(const SizeLaw& law, const std::vector<geometry::Polygon>& floes);

}  // namespace polynya::simulation
