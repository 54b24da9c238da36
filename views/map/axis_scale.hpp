#pragma once

#include <vector>

namespace polynya::views {

/// An axis with its range, its ticks, and where on the paper a value lies.
struct AxisScale {
  bool is_log = false;
  double low = 0;
  double high = 1;
  std::vector<double> ticks;

  bool takes(double value) const;
  /// 0 at the low end, 1 at the high end.
  double share(double value) const;
};

/// How much of the paper the values may fill.
enum class AxisFit {
  kTight,  ///< all of it
  kRoomy,  ///< round ends and some room above; positive values on a linear axis start at 0
};

/// An axis for values from `low` to `high`, both positive if it is logarithmic.
AxisScale axis_scale(double low, double high, bool is_log, AxisFit fit);

}  // namespace polynya::views
