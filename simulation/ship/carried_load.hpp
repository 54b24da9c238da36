#pragma once

#include <algorithm>
#include <cmath>

namespace polynya::simulation {

/// One component of a hull's load, with the impulse that was missed before its contacts were found. Bodies may overlap
/// for a part of a step before a contact is found, and the impulse of that time is given in the step in which it is
/// found. It would make that step's mean force too large. Therefore it is booked in later steps, as far as their own
/// load is below that of the step in which it was found. So no mean over several steps exceeds the largest load of a
/// single step.
struct CarriedLoad {
  double impulse = 0;  ///< impulse that is not booked yet [N s, N m s]
  double level = 0;    ///< load up to which it is booked in later steps, ≥ 0 [N, N m]

  /// Returns the impulse to book for a step of length dt [s]. `of_step` is the impulse that contacts gave in the step,
  /// and `missed` the impulse for the time before they were found [N s, N m s].
  double book(double of_step, double missed, double dt) {
    if (missed != 0) level = std::max(level, std::abs(of_step) / dt);
    impulse += missed;
    if (impulse == 0) return of_step;
    const double most = level * dt;
    const double given =
        impulse > 0 ? std::clamp(most - of_step, 0.0, impulse) : -std::clamp(most + of_step, 0.0, -impulse);
    impulse -= given;
    if (impulse == 0) level = 0;
    return of_step + given;
  }
};

}  // namespace polynya::simulation
