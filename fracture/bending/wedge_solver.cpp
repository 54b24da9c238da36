#include "fracture/bending/wedge_solver.hpp"

#include <algorithm>
#include <cmath>

#include "fracture/bending/internal/march.hpp"

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

WedgeSolver::WedgeSolver(double opening_angle, double mass_ratio, const SolverSettings& settings)
    : settings_(settings),
      modes_(std::make_shared<const WedgeModes>(wedge_modes(0.5 * opening_angle, mass_ratio, settings))) {}

std::optional<WedgeFailure> WedgeSolver::failure(const WedgePush& push) const {
  return march_to_failure(*modes_, push, settings_);
}

}  // namespace polynya::fracture
