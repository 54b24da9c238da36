#pragma once

#include <memory>
#include <optional>

#include "fracture/bending/solver_settings.hpp"
#include "fracture/bending/wedge_push.hpp"

namespace polynya::fracture {

struct WedgeModes;

/// One wedge of floating ice, taken apart into its modes once (tenths of a second), then marched under any
/// push (milliseconds). Safe to use from several threads.
class WedgeSolver {
 public:
  /// opening_angle 2α in (0, 2π] [rad]; mass_ratio m̂ = ρ_i h / (ρ_w l) > 0.
  WedgeSolver(double opening_angle, double mass_ratio, const SolverSettings& settings);

  /// When and where the push breaks the wedge; nothing where it does not within a penetration of 3 l.
  std::optional<WedgeFailure> failure(const WedgePush& push) const;

 private:
  SolverSettings settings_;
  std::shared_ptr<const WedgeModes> modes_;
};

}  // namespace polynya::fracture
