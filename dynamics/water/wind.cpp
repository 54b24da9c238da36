#include "dynamics/water/wind.hpp"

namespace polynya::dynamics {

using geometry::Vector;

WindWork apply_wind(Bodies& bodies, std::span<const BodyIndex> floes, Vector stress, double dt) {
  WindWork work;
  for (const BodyIndex i : floes) {
    if (bodies.inverse_mass[i] == 0) continue;  // wind does not move fast ice
    const Vector impulse = dt * bodies.area[i] * stress;
    const Vector change = bodies.inverse_mass[i] * impulse;
    work.energy += dot(impulse, bodies.velocity[i] + 0.5 * change);
    work.impulse += impulse;
    work.impulses += length(impulse);
    bodies.velocity[i] += change;
  }
  return work;
}

}  // namespace polynya::dynamics
