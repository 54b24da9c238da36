#include "fracture/bending/wedge_push.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::fracture {

double push_force(const WedgePush& push, double penetration) {
  const double beyond = push.full_depth > 0 ? std::max(0.0, penetration - push.full_depth) : 0;
  return (penetration * penetration - beyond * beyond) / push.softness;
}

double push_depth(const WedgePush& push, double force) {
  const double square = push.softness * force;
  const double full = push.full_depth;
  if (full <= 0 || square <= full * full) return std::sqrt(square);
  return 0.5 * (square / full + full);  // V̂ Π = ξ² − (ξ − ξ_full)² = 2 ξ ξ_full − ξ_full²
}

}  // namespace polynya::fracture
