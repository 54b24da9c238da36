#pragma once

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "simulation/field/portable_math.hpp"

namespace polynya::simulation {

// Distributions of the sizes of a field's floes. The size of a floe is √area, as in the limit κ l. A disc has a
// diameter of 1.128 times its size. Exponents are the same for both measures.

/// All floes have the same size.
struct EqualSizes {
  double size = 15;  ///< size of all floes [m]
};

/// Log-normal sizes, limited to three standard deviations of the logarithm. Mean and spread are those of the
/// distribution without the limit.
struct LognormalSizes {
  double mean = 15;     ///< mean size [m]
  double spread = 0.3;  ///< standard deviation / mean [-]
};

/// Power law between two bounds: the number of floes larger than d is proportional to d^−a [Toyota2006].
struct PowerLawSizes {
  /// Exponent a of the number of floes; 0 is uniform in the logarithm of d, −1 uniform in d [-].
  double exponent = 1.87;
  double least = 10;     ///< smallest size [m]
  double largest = 100;  ///< largest size [m]
};

using SizeLaw = std::variant<EqualSizes, LognormalSizes, PowerLawSizes>;

/// Returns the size below which a fraction u of the floes lies, 0 < u < 1 [m]. It is the same on every machine.
double size_at(const SizeLaw& law, double u);

/// Returns the fraction of the floes that are smaller than a size [-].
double share_below(const SizeLaw& law, double size);

/// Returns the mean area of a floe [m²].
double mean_area(const SizeLaw& law);

/// Draws areas of floes in ascending order [m²]: one at random in each of `count` intervals of equal probability. A
/// small field therefore also has the small and large floes of the law in proportion.
std::vector<double> draw_areas(const SizeLaw& law, std::size_t count, Random& random);

/// Comparison of the floes of a field with their size law.
struct FieldStatistics {
  SizeLaw law;                 ///< law that the scene asks for
  double least_size = 0;       ///< smallest size [m]
  double largest_size = 0;     ///< largest size [m]
  double distance_to_law = 0;  ///< distance of Kolmogorov and Smirnov; for equal sizes the largest deviation / size [-]
  /// Law fitted by maximum likelihood: the exponent of a power law between its bounds, or mean and spread of a
  /// log-normal law; none for equal sizes.
  std::optional<SizeLaw> fitted;
  double mean_aspect = 0;  ///< mean of the floes' aspects (aspect_of) [-]
  /// Mean number of corners of a floe.
  double mean_corners = 0;
};

/// Returns the largest difference between the law and the fraction of floes below a size [-]. `sizes` must be in
/// ascending order [m].
double kolmogorov_smirnov(const SizeLaw& law, const std::vector<double>& sizes);

/// Returns the exponent of a power law between given bounds that fits sizes [m] with maximum likelihood. It is found by
/// bisection, because the mean of ln d decreases steadily with it. Sizes beyond a bound count as at the bound.
double likeliest_exponent(const PowerLawSizes& law, const std::vector<double>& sizes);

/// Returns the statistics of the sizes of floes.
FieldStatistics statistics_of(const SizeLaw& law, const std::vector<geometry::Polygon>& floes);

}  // namespace polynya::simulation
