#include "dynamics/contact/separation.hpp"

#include <algorithm>

#include "dynamics/contact/collision.hpp"

namespace polynya::dynamics {

using geometry::Vector;

int separate(Bodies& bodies, const std::vector<Contact>& contacts, const SeparationSettings& settings,
             double dt) {
  // Each contact moves its own bodies by its own share, one after the other: a relaxation, not a solution,
  // since this overlap is a few centimetres that may take a second to decay.
  int moved = 0;
  const double share = std::min(1.0, dt / settings.time);
  for (const Contact& c : contacts) {
    const double excess =
        c.depth - std::max(settings.slop, c.record != nullptr ? c.record->crushed_depth : 0.0);
    if (excess <= 0) continue;
    const Vector arm_a = c.middle() - bodies.position[c.a];
    const Vector arm_b = c.middle() - bodies.position[c.b];
    const Mobility a{bodies.inverse_mass[c.a], bodies.inverse_moment[c.a], arm_a};
    const Mobility b{bodies.inverse_mass[c.b], bodies.inverse_moment[c.b], arm_b};
    const double p = share * excess * effective_mass(a, b, c.normal);  // [kg m]: an impulse times a second
    move_body(bodies, c.a, -p * a.inverse_mass * c.normal, -p * a.inverse_moment * cross(arm_a, c.normal));
    move_body(bodies, c.b, p * b.inverse_mass * c.normal, p * b.inverse_moment * cross(arm_b, c.normal));
    ++moved;
  }
  return moved;
}

}  // namespace polynya::dynamics
