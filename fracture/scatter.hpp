#pragma once

#include <limits>
#include <vector>

namespace polynya::fracture {

/// The kinds of scatter of a property of ice.
enum class ScatterKind {
  kConstant,
  kUniform,    ///< uniform between the bounds
  kNormal,     ///< cut off at the bounds
  kLogNormal,  ///< cut off at the bounds
};

/// A law of scatter, in the unit of the property. Strength and thickness are commonly taken as log-normal: this was the
/// best fit to the compressive strength of 894 samples of level ice within a season or a mode of failure
/// [StrubKlein2017] (abstract); thickness is truncated log-normal with a spread up to 0.3 (*recall*).
struct ScatterLaw {
  ScatterKind kind = ScatterKind::kLogNormal;
  double mean = 0;    ///< before the law is cut off; not used by kUniform
  double spread = 0;  ///< standard deviation / mean, before the law is cut off [-]
  double least = 0;
  double most = std::numeric_limits<double>::infinity();
};

/// Returns the fraction of the law at x or below.
double cumulative(const ScatterLaw& law, double x);

/// Returns the fraction of the law without bounds that lies between the bounds; 0: nothing can be drawn.
double share_within_bounds(const ScatterLaw& law);

/// Returns the value below which a fraction `share` of the law lies, 0 < share < 1. REQUIRES share_within_bounds(law) >
/// 0.
double quantile(const ScatterLaw& law, double share);

/// Statistics of values that were drawn from a law.
struct ScatterMeasures {
  std::size_t count = 0;
  double mean = 0;
  double spread = 0;  ///< standard deviation / mean [-]
  double least = 0;
  double most = 0;
  double distance = 0;  ///< Kolmogorov–Smirnov distance: the largest difference of the cumulative fractions [-]
};
ScatterMeasures measure(const ScatterLaw& law, std::vector<double> drawn);

}  // namespace polynya::fracture
