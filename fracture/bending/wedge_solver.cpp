#include "fracture/bending/wedge_solver.hpp"

#include "fracture/bending/internal/march.hpp"

namespace polynya::fracture {

WedgeSolver::WedgeSolver(double opening_angle, double mass_ratio, const SolverSettings& settings)
    : settings_(settings),
      modes_(std::make_shared<const WedgeModes>(wedge_modes(0.5 * opening_angle, mass_ratio, settings))) {}

std::optional<WedgeFailure> WedgeSolver::failure(const WedgePush& push) const {
  return march_to_failure(*modes_, push, settings_);
}

}  // namespace polynya::fracture
