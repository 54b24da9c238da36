#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fracture/bending/fsi_database_model.hpp"
#include "fracture/bending/wedge_solver.hpp"

namespace polynya::fracture {

// Direct solutions of the wedge for physical loads, and the studies of docs/theory/bending.md that are computed from
// them (polynya_bench_wedges prints these studies). Tests use the solutions as references; the product has only the
// table.

/// The same discretisation from another inner radius on: as many elements more or fewer as keep their
/// spacing, and fluid panels in proportion. inner_radius in l, below the outer radius.
SolverSettings with_inner_radius(const SolverSettings& settings, double inner_radius);

/// The same discretisation with that many radial elements, and fluid panels in proportion.
SolverSettings with_elements(const SolverSettings& settings, int radial_elements);

/// The wedge of a load, depends on its angles, ice and water, not on its speed. The
/// settings' Poisson ratio is replaced by the ice's own.
WedgeSolver wedge_of(const BendingLoad& load, SolverSettings settings);

/// The fluid–structure solution for one physical load, without any table: both branches of Eq. (2) and,
/// coupled, the ice's own deflection, ξ = v_n t − w_tip tan θ_s. solver from wedge_of() of the same angles,
/// ice and water. Nothing where the hull does not press the ice down, stands still, or does not break the
/// wedge within 3 l.
std::optional<BendingForecast> direct_forecast(const WedgeSolver& solver, const BendingLoad& load,
                                               Feedback feedback = Feedback::kIgnored);

/// Results of each fluid model for one load, in the order of FluidModel. An entry is empty if the ice does not break.
struct FluidStudyRow {
  double speed = 0;  ///< v_n [m/s]
  std::array<std::optional<BendingForecast>, 4> by_fluid;
};

std::vector<FluidStudyRow> fluid_study(const BendingLoad& load, std::span<const double> speeds,
                                       const SolverSettings& settings);

/// Effect of the ice's own deflection under the hull.
struct FeedbackStudyRow {
  double speed = 0;  ///< v_n [m/s]
  std::optional<BendingForecast> ignored;
  std::optional<BendingForecast> coupled;
};

std::vector<FeedbackStudyRow> feedback_study(const BendingLoad& load, std::span<const double> speeds,
                                             const SolverSettings& settings);

/// Comparison of the database with a solution, at one point between the points of the table.
struct AccuracyRow {
  WedgeGroups groups;
  double force_error = 0;   ///< table / solution − 1
  double radius_error = 0;  ///< table / solution − 1
};

struct AccuracyStudy {
  std::vector<AccuracyRow> rows;
  double worst_force_error = 0;   ///< greatest |force_error|
  double worst_radius_error = 0;  ///< greatest |radius_error|
};

/// Against solutions with the settings `reference` at random points of the grid's box, uniform in 2α, m̂, ln Π
/// and ln Fr. With the table's own settings this measures its interpolation alone; another inner radius or
/// mesh shows what they cost as well. The same points and numbers for the same seed, whatever the number of
/// threads. A point that does not break counts as an error of 1.
AccuracyStudy accuracy_study(const BendingDatabase& database, const SolverSettings& reference, int points,
                             std::uint64_t seed, int threads = 1);

}  // namespace polynya::fracture
