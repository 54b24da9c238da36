#pragma once

#include <limits>
#include <vector>

namespace polynya::fracture {

/// How a property of ice scatters.
enum class ScatterKind {
  kConstant,
  kUniform,    ///< evenly between the bounds
  kNormal,     ///< cut off at the bounds
  kLogNormal,  ///< likewise
};

/// A law of scatter, in the property's unit. Strength and thickness are commonly taken as log-normal: of 894
/// samples of level ice it was the best fit to the compressive strength within a season or a mode of failure
/// [StrubKlein2017] (abstract); thickness truncated log-normal with a spread up to 0.3 (*recall*).
struct ScatterLaw {
  ScatterKind kind = ScatterKind::kLogNormal;
  double mean = 0;    ///< before the law is cut off; not of kUniform
  double spread = 0;  ///< standard deviation / mean, likewise [-]
  double least = 0;
  double most = std::numeric_limits<double>::infinity();
};

/// The share of the law at x or below.
double cumulative(const ScatterLaw& law, double x);

/// Of the law without its bounds, the share between them: 0 where nothing can be drawn.
double share_within_bounds(const ScatterLaw& law);

/// The value with that share of the law below it, 0 < share < 1. REQUIRES share_within_bounds(law) > 0.
double quantile(const ScatterLaw& law, double share);

/// What was drawn of a law.
struct ScatterMeasures {
  std::size_t count = 0;
  double mean = 0;
  double spread = 0;  ///< standard deviation / mean [-]
  double least = 0;
  double most = 0;
  double distance = 0;  ///< Kolmogorov–Smirnov, the largest difference of the shares [-]
};
ScatterMeasures measure(const ScatterLaw& law, std::vector<double> drawn);

}  // namespace polynya::fracture
