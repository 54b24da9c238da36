#include <array>
#include <charconv>
#include <mutex>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "fracture/bending/database.hpp"
#include "fracture/bending/internal/for_each_index.hpp"
#include "fracture/bending/wedge_solver.hpp"

namespace polynya::fracture {
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
  const WedgeSolver solver(wedge.opening_angle_deg * (std::numbers::pi / 180), wedge.mass_ratio, settings);
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
  std::size_t done = 0;
  std::mutex progress_mutex;
  for_each_index(wedges.size(), threads, [&](std::size_t i) {
    solved[i] = solve_wedge(wedges[i], settings, grid);
    const std::lock_guard lock(progress_mutex);
    ++done;
    if (progress) progress(done, wedges.size());
  });

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
