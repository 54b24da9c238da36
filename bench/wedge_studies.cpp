#include "bench/wedge_studies.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <random>
#include <thread>

#include "fracture/bending/internal/plate.hpp"

namespace polynya::fracture {
namespace {

BendingLoad at_speed(BendingLoad load, double speed) {
  load.mean_approach_speed = speed;
  return load;
}

/// Calls work(i) once for every i < count, on that many threads.
template <typename Work>
void for_each_index(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto run = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> helpers;
  for (int i = 1; i < threads; ++i) helpers.emplace_back(run);
  run();
}

/// Uniform in [low, high), from 53 random bits: the same everywhere, which std::uniform_real_distribution is
/// not.
double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
}

double log_uniform(std::mt19937_64& random, const std::vector<double>& axis) {
  return std::exp(uniform(random, std::log(axis.front()), std::log(axis.back())));
}

AccuracyRow compared(const BendingDatabase& database, const SolverSettings& reference, const WedgeGroups& groups) {
  const WedgeSolver solver(groups.opening_angle, groups.mass_ratio, reference);
  const std::optional<WedgeFailure> solution = solver.failure({groups.froude, groups.softness, 0, 0});
  if (!solution) return {groups, 1, 1};
  const DatabaseAnswer answer = database.look_up(groups);
  return {groups, answer.force / solution->force - 1, answer.cusp_radius / solution->cusp_radius - 1};
}

}  // namespace

SolverSettings with_inner_radius(const SolverSettings& settings, double inner_radius) {
  const auto reach = [&](double inner) { return radial_coordinate(settings.outer_radius) - radial_coordinate(inner); };
  const double elements = settings.radial_elements * reach(inner_radius) / reach(settings.inner_radius);
  constexpr double kRounding = 1e-6;  // the same inner radius keeps the same elements
  SolverSettings changed = with_elements(settings, std::max(1, static_cast<int>(std::ceil(elements - kRounding))));
  changed.inner_radius = inner_radius;
  return changed;
}

SolverSettings with_elements(const SolverSettings& settings, int radial_elements) {
  SolverSettings changed = settings;
  changed.radial_elements = radial_elements;
  const double rings_per_element = static_cast<double>(settings.panel_rings) / settings.radial_elements;
  changed.panel_rings = std::max(1, static_cast<int>(std::lround(rings_per_element * radial_elements)));
  return changed;
}

WedgeSolver wedge_of(const BendingLoad& load, SolverSettings settings) {
  const WedgeGroups groups = scaled(load).groups;
  settings.poisson_ratio = load.ice.poisson_ratio;
  return {groups.opening_angle, groups.mass_ratio, settings};
}

std::optional<BendingForecast> direct_forecast(const WedgeSolver& solver, const BendingLoad& load, Feedback feedback) {
  const ScaledLoad scaled_load = scaled(load);
  if (!(scaled_load.groups.froude > 0) || !std::isfinite(scaled_load.groups.softness)) return std::nullopt;
  const std::optional<WedgeFailure> failure = solver.failure(wedge_push_of(scaled_load, feedback));
  if (!failure) return std::nullopt;
  BendingForecast forecast;
  forecast.capacity.vertical_force = failure->force * scaled_load.force_scale;
  forecast.capacity.cusp_radius = failure->cusp_radius * scaled_load.length_scale;
  forecast.capacity.radial_crack_first = failure->crack_ratio >= 1;
  forecast.normal_force = forecast.capacity.vertical_force / load.vertical_to_crushing;
  forecast.penetration = failure->penetration * scaled_load.length_scale;
  forecast.time = failure->time * scaled_load.time_scale;
  return forecast;
}

std::vector<FluidStudyRow> fluid_study(const BendingLoad& load, std::span<const double> speeds,
                                       const SolverSettings& settings) {
  std::vector<FluidStudyRow> rows(speeds.size());
  for (const FluidModel fluid :
       {FluidModel::kWinkler, FluidModel::kLocalMass, FluidModel::kPotential, FluidModel::kFreeSurface}) {
    SolverSettings with_fluid = settings;
    with_fluid.fluid = fluid;
    const WedgeSolver solver = wedge_of(load, with_fluid);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      rows[i].speed = speeds[i];
      rows[i].by_fluid[static_cast<std::size_t>(fluid)] = direct_forecast(solver, at_speed(load, speeds[i]));
    }
  }
  return rows;
}

std::vector<FeedbackStudyRow> feedback_study(const BendingLoad& load, std::span<const double> speeds,
                                             const SolverSettings& settings) {
  const WedgeSolver solver = wedge_of(load, settings);
  std::vector<FeedbackStudyRow> rows;
  for (const double speed : speeds) {
    rows.push_back({speed, direct_forecast(solver, at_speed(load, speed), Feedback::kIgnored),
                    direct_forecast(solver, at_speed(load, speed), Feedback::kCoupled)});
  }
  return rows;
}

AccuracyStudy accuracy_study(const BendingDatabase& database, const SolverSettings& reference, int points,
                             std::uint64_t seed, int threads) {
  const DatabaseGrid& grid = database.grid();
  std::mt19937_64 random(seed);
  std::vector<WedgeGroups> groups;
  for (int i = 0; i < points; ++i) {
    WedgeGroups g;
    g.opening_angle =
        uniform(random, grid.opening_angles_deg.front(), grid.opening_angles_deg.back()) * (std::numbers::pi / 180);
    g.mass_ratio = uniform(random, grid.mass_ratios.front(), grid.mass_ratios.back());
    g.softness = log_uniform(random, grid.softnesses);
    g.froude = log_uniform(random, grid.froude_numbers);
    groups.push_back(g);
  }
  AccuracyStudy study;
  study.rows.resize(groups.size());
  for_each_index(groups.size(), threads,
                 [&](std::size_t i) { study.rows[i] = compared(database, reference, groups[i]); });
  for (const AccuracyRow& row : study.rows) {
    study.worst_force_error = std::max(study.worst_force_error, std::abs(row.force_error));
    study.worst_radius_error = std::max(study.worst_radius_error, std::abs(row.radius_error));
  }
  return study;
}

}  // namespace polynya::fracture
