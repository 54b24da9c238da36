#include "fracture/bending/direct_solution.hpp"

#include <cmath>

namespace polynya::fracture {

WedgeSolver wedge_of(const BendingLoad& load, SolverSettings settings) {
  const WedgeGroups groups = scaled(load).groups;
  settings.poisson_ratio = load.ice.poisson_ratio;
  return {groups.opening_angle, groups.mass_ratio, settings};
}

std::optional<BendingForecast> direct_forecast(const WedgeSolver& solver, const BendingLoad& load,
                                               Feedback feedback) {
  const ScaledLoad scaled_load = scaled(load);
  if (!(scaled_load.groups.froude > 0) || !std::isfinite(scaled_load.groups.softness)) return std::nullopt;
  const std::optional<WedgeFailure> failure = solver.failure(push_of(scaled_load, feedback));
  if (!failure) return std::nullopt;
  BendingForecast forecast;
  forecast.capacity.vertical_force = failure->force * scaled_load.force_scale;
  forecast.capacity.cusp_radius = failure->cusp_radius * scaled_load.length_scale;
  forecast.capacity.radial_crack_first = failure->crack_time.has_value();
  forecast.normal_force = forecast.capacity.vertical_force / load.vertical_to_crushing;
  forecast.penetration = failure->penetration * scaled_load.length_scale;
  forecast.time = failure->time * scaled_load.time_scale;
  return forecast;
}

}  // namespace polynya::fracture
