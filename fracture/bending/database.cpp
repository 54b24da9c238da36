#include "fracture/bending/database.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <charconv>
#include <cmath>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "fracture/bending/wedge_solver.hpp"
#include "geometry/shape/angle.hpp"

namespace polynya::fracture {
namespace {

template <class Map>
std::vector<double> mapped(std::vector<double> values, Map map) {
  std::transform(values.begin(), values.end(), values.begin(), map);
  return values;
}

/// An interval of one axis and where in it a coordinate lies, 0..1.
struct Cell {
  std::size_t lower = 0;
  double fraction = 0;

  double weight(unsigned end) const { return end == 0 ? 1 - fraction : fraction; }
};

Cell cell_at(const std::vector<double>& axis, double x) {
  const auto after = std::upper_bound(axis.begin() + 1, axis.end() - 1, x);
  const auto upper = static_cast<std::size_t>(after - axis.begin());
  return {upper - 1, std::clamp((x - axis[upper - 1]) / (axis[upper] - axis[upper - 1]), 0.0, 1.0)};
}

/// How far the interpolation between two softnesses follows pushes of equal duration: with the exponent ½ of
/// Fr ∝ Π^½ the time to the break, τ_b = √(Π V̂)/Fr, is the same at both but for V̂.
constexpr double kEqualDuration = 0.5;

/// Where to read the table at the softness cell's lower and upper value. What inertia does to the break
/// depends on how long the push lasts, so that the table is far smoother along Fr ∝ Π^½ than along Π alone.
/// Near the ends of the Froude axis the exponent shrinks to what both softnesses have.
std::array<Cell, 2> froude_cells(const std::vector<double>& softnesses, const Cell& softness,
                                 const std::vector<double>& froudes, double log_froude) {
  const double x = std::clamp(log_froude, froudes.front(), froudes.back());
  const double width = softnesses[softness.lower + 1] - softnesses[softness.lower];
  const double below = softness.fraction * width, above = width - below;
  const double exponent = std::min({kEqualDuration, (x - froudes.front()) / std::max(below, 1e-300),
                                    (froudes.back() - x) / std::max(above, 1e-300)});
  return {cell_at(froudes, x - exponent * below), cell_at(froudes, x + exponent * above)};
}

/// A load's place on the axes.
std::array<double, 4> axis_coordinates(const WedgeGroups& groups) {
  return {groups.opening_angle, std::log(groups.mass_ratio), std::log(groups.softness), std::log(groups.froude)};
}

/// Rounding at the edge of an axis is not "outside".
constexpr double kEdgeTolerance = 1e-9;

/// One bit per group that lies outside its axis, NaN included. A Froude number below the least does not: the
/// wedge is only more at rest.
std::uint8_t outside_bits(const std::array<std::vector<double>, 4>& axes, const std::array<double, 4>& x) {
  unsigned bits = 0;
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const bool may_be_below = axis == static_cast<std::size_t>(Group::kFroude);
    const bool is_inside = x[axis] <= axes[axis].back() + kEdgeTolerance &&
                           (x[axis] >= axes[axis].front() - kEdgeTolerance || may_be_below);
    if (!is_inside) bits |= 1U << axis;
  }
  return static_cast<std::uint8_t>(bits);
}

}  // namespace

bool is_grid_axis(const std::vector<double>& values) {
  if (values.size() < 2 || !(values.front() >= 1e-12) || !(values.back() <= 1e12)) return false;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(values[i] > values[i - 1] * (1 + kEdgeTolerance))) return false;
  return true;
}

/// Chosen by `polynya_bench_wedges accuracy`: closer in Fr where inertia overshoots, and in Π where the
/// loaded patch is no longer small.
DatabaseGrid default_grid() {
  return {{20, 29, 40, 51, 63, 76, 90, 104, 118, 132, 145, 156, 165, 173, 180},
          {0.02, 0.05, 0.1},
          {3e-5, 9.5e-5, 2.7e-4, 7e-4, 1.6e-3, 3.5e-3, 7e-3, 1.3e-2, 2.3e-2, 4e-2, 6.5e-2, 1e-1},
          {5e-4,   7.5e-4, 1.1e-3, 1.6e-3, 2.3e-3, 3.3e-3, 4.7e-3, 6.7e-3, 9.4e-3, 1.3e-2, 1.8e-2, 2.5e-2, 3.5e-2,
           4.8e-2, 6.5e-2, 8.7e-2, 0.114,  0.15,   0.2,    0.27,   0.38,   0.54,   0.76,   1.07,   1.5}};
}

BendingDatabase::BendingDatabase(SolverSettings settings, DatabaseGrid grid, std::vector<DatabaseEntry> entries)
    : settings_(settings), grid_(std::move(grid)), entries_(std::move(entries)) {
  assert(entries_.size() == grid_.size());
  assert(is_grid_axis(grid_.opening_angles_deg) && is_grid_axis(grid_.mass_ratios) && is_grid_axis(grid_.softnesses) &&
         is_grid_axis(grid_.froude_numbers));
  const auto logarithm = [](double x) { return std::log(x); };
  coordinates_ = {
      mapped(grid_.opening_angles_deg, [](double degrees) { return degrees * geometry::kRadiansPerDegree; }),
      mapped(grid_.mass_ratios, logarithm), mapped(grid_.softnesses, logarithm),
      mapped(grid_.froude_numbers, logarithm)};
  strides_[3] = 1;
  for (std::size_t axis = 3; axis > 0; --axis) strides_[axis - 1] = strides_[axis] * coordinates_[axis].size();
  stored_.reserve(entries_.size());
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const DatabaseEntry& e = entries_[i];
    assert(e.force > 0 && e.cusp_radius > 0);
    const double opening_angle = coordinates_[0][i / strides_[0]];
    stored_.push_back({std::log(e.force / opening_angle), std::log(e.cusp_radius), e.crack_ratio});
  }
}

DatabaseAnswer BendingDatabase::look_up(const WedgeGroups& groups) const {
  const std::array<double, 4> x = axis_coordinates(groups);
  const Cell angle = cell_at(coordinates_[0], x[0]), mass = cell_at(coordinates_[1], x[1]),
             softness = cell_at(coordinates_[2], x[2]);
  const std::array<Cell, 2> froude = froude_cells(coordinates_[2], softness, coordinates_[3], x[3]);
  DatabaseAnswer answer;
  answer.outside = outside_bits(coordinates_, x);
  double log_force = 0, log_radius = 0;
  for (unsigned vertex = 0; vertex < 16; ++vertex) {  // the corners of the cell
    const unsigned a = vertex & 1U, m = (vertex >> 1U) & 1U, s = (vertex >> 2U) & 1U, f = vertex >> 3U;
    const double weight = angle.weight(a) * mass.weight(m) * softness.weight(s) * froude[s].weight(f);
    const DatabaseEntry& e = stored_[(angle.lower + a) * strides_[0] + (mass.lower + m) * strides_[1] +
                                     (softness.lower + s) * strides_[2] + (froude[s].lower + f) * strides_[3]];
    log_force += weight * e.force;
    log_radius += weight * e.cusp_radius;
    answer.crack_ratio += weight * e.crack_ratio;
  }
  const std::vector<double>& angles = coordinates_[0];
  answer.force = std::exp(log_force) * std::clamp(groups.opening_angle, angles.front(), angles.back());
  answer.cusp_radius = std::exp(log_radius);
  return answer;
}

std::vector<OutsideRange> BendingDatabase::outside(const WedgeGroups& groups) const {
  const std::uint8_t bits = outside_bits(coordinates_, axis_coordinates(groups));
  const std::array<double, 4> values = {groups.opening_angle * geometry::kDegreesPerRadian, groups.mass_ratio,
                                        groups.softness, groups.froude};
  const std::array<const std::vector<double>*, 4> axes = {&grid_.opening_angles_deg, &grid_.mass_ratios,
                                                          &grid_.softnesses, &grid_.froude_numbers};
  std::vector<OutsideRange> ranges;
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    if (((static_cast<unsigned>(bits) >> axis) & 1U) != 0)
      ranges.push_back({std::string(kGroupNames[axis]), values[axis], axes[axis]->front(), axes[axis]->back()});
  return ranges;
}

// ---- solving all of it

namespace {

/// To six significant digits: far finer than the solution, and the same on machines whose mathematical
/// functions differ in the last bit.
double rounded(double x) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::scientific, 5).ptr;
  double value = 0;
  std::from_chars(text.data(), end, value);
  return value;
}

struct Wedge {
  double opening_angle_deg;
  double mass_ratio;
};

/// All pushes on one wedge; nothing where one of them does not break it.
std::optional<std::vector<DatabaseEntry>> solve_wedge(const Wedge& wedge, const SolverSettings& settings,
                                                      const DatabaseGrid& grid) {
  const WedgeSolver solver(wedge.opening_angle_deg * geometry::kRadiansPerDegree, wedge.mass_ratio, settings);
  std::vector<DatabaseEntry> entries;
  for (const double softness : grid.softnesses) {
    for (const double froude : grid.froude_numbers) {
      const std::optional<WedgeFailure> failure = solver.failure({froude, softness, 0, 0});
      if (!failure) return std::nullopt;
      entries.push_back({rounded(failure->force), rounded(failure->cusp_radius), rounded(failure->crack_ratio)});
    }
  }
  return entries;
}

}  // namespace

tl::expected<BendingDatabase, DatabaseError> build_database(const SolverSettings& settings, const DatabaseGrid& grid,
                                                            int threads, const BuildProgress& progress) {
  for (const auto* axis : {&grid.opening_angles_deg, &grid.mass_ratios, &grid.softnesses, &grid.froude_numbers})
    if (!is_grid_axis(*axis))
      return tl::unexpected(DatabaseError{0, "every group needs at least two positive, ascending values"});
  if (grid.opening_angles_deg.back() > 180)
    return tl::unexpected(DatabaseError{0, "opening angles above 180 degrees are not wedges"});

  std::vector<Wedge> wedges;
  for (const double angle : grid.opening_angles_deg)
    for (const double mass : grid.mass_ratios) wedges.push_back({angle, mass});
  std::vector<std::optional<std::vector<DatabaseEntry>>> solved(wedges.size());
  std::atomic<std::size_t> next = 0;
  std::size_t done = 0;
  std::mutex progress_mutex;
  const auto solve_all = [&] {
    for (std::size_t i = next++; i < wedges.size(); i = next++) {
      solved[i] = solve_wedge(wedges[i], settings, grid);
      const std::lock_guard lock(progress_mutex);
      ++done;
      if (progress) progress(done, wedges.size());
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < threads; ++i) helpers.emplace_back(solve_all);
    solve_all();
  }

  std::vector<DatabaseEntry> entries;
  for (std::size_t i = 0; i < wedges.size(); ++i) {
    if (!solved[i])
      return tl::unexpected(DatabaseError{0, "a push of the grid does not break the wedge of " +
                                                 std::to_string(wedges[i].opening_angle_deg) +
                                                 " degrees within a penetration of 3 l: take smaller softnesses"});
    entries.insert(entries.end(), solved[i]->begin(), solved[i]->end());
  }
  return BendingDatabase(settings, grid, std::move(entries));
}

}  // namespace polynya::fracture
