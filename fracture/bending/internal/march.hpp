#pragma once

#include <optional>

#include "fracture/bending/internal/modes.hpp"
#include "fracture/bending/wedge_push.hpp"

namespace polynya::fracture {

/// Marches the modes under the push until the top fibre's radial stress on the bisector reaches the flexural
/// strength. Exact for a load that is linear within each step; settings.steps_to_failure steps would bring a
/// slow push to failure. Nothing when the wedge does not break within the penetration this solver can follow,
/// ξ ≤ kDeepest.
std::optional<WedgeFailure> march_to_failure(const WedgeModes& modes, const WedgePush& push,
                                             const SolverSettings& settings);

inline constexpr double kDeepest = 3;  ///< in l

}  // namespace polynya::fracture
