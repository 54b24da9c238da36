#pragma once

#include <algorithm>
#include <cmath>

namespace polynya::simulation {

/// One component of a hull's load, with the impulse that was missed before its contacts were found. That impulse acted
/// before the step in which it is given. It is booked in later steps, as far as their own load is below that of the
/// step in which it was found. So no mean over steps exceeds the largest load of one of them.
struct CarriedLoad {
  double impulse = 0;  ///< not booked yet [N s, N m s]
  double level = 0;    ///< up to which it is booked, ≥ 0 [N, N m]

  /// Returns the impulse to book for a step of length dt [s], in which contacts gave `steady`, and `missed` for the
  /// time before they were found [N s, N m s].
  double book(double steady, double missed, double dt) {
    if (missed != 0) level = std::max(level, std::abs(steady) / dt);
    impulse += missed;
    if (impulse == 0) return steady;
    const double most = level * dt;
    const double given =
        impulse > 0 ? std::clamp(most - steady, 0.0, impulse) : -std::clamp(most + steady, 0.0, -impulse);
    impulse -= given;
    if (impulse == 0) level = 0;
    return steady + given;
  }
};

}  // namespace polynya::simulation
