#pragma once

#include <optional>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "simulation/field/size_law.hpp"

namespace polynya::simulation {

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
