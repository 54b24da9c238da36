#pragma once

#include <optional>

#include "fracture/bending/fsi_database_model.hpp"
#include "fracture/bending/solver_settings.hpp"
#include "fracture/bending/wedge_solver.hpp"

namespace polynya::fracture {

/// The wedge of a load, ready to be marched: depends on its angles, ice and water, not on its speed. The
/// settings' Poisson ratio gives way to the ice's own.
WedgeSolver wedge_of(const BendingLoad& load, SolverSettings settings);

/// The fluid–structure solution for one physical load, without any table: both branches of Eq. (2) and,
/// coupled, the ice's own deflection, ξ = v_n t − w_tip tan θ_s. solver from wedge_of() of the same angles,
/// ice and water. Nothing where the hull does not press the ice down, stands still, or does not break the
/// wedge within 3 l.
std::optional<BendingForecast> direct_forecast(const WedgeSolver& solver, const BendingLoad& load,
                                               Feedback feedback = Feedback::kIgnored);

}  // namespace polynya::fracture
