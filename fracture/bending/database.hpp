#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "fracture/bending/solver_settings.hpp"

namespace polynya::fracture {

/// The dimensionless groups that decide when a wedge breaks, beside ν. docs/theory/bending.md.
struct WedgeGroups {
  double opening_angle = 0;  ///< 2α [rad]
  double mass_ratio = 0;     ///< m̂ = ρ_i h / (ρ_w l)
  double softness = 0;       ///< Π = σ_f h² / (κ l²)
  double froude = 0;         ///< Fr = v_n / √(g l)
};

enum class Group : std::uint8_t { kOpeningAngle, kMassRatio, kSoftness, kFroude };

inline constexpr std::array<std::string_view, 4> kGroupNames = {"opening angle", "mass ratio", "softness",
                                                                "Froude number"};

/// Where the table has its points, each ascending, two at least.
struct DatabaseGrid {
  std::vector<double> opening_angles_deg;
  std::vector<double> mass_ratios;
  std::vector<double> softnesses;
  std::vector<double> froude_numbers;

  std::size_t size() const {
    return opening_angles_deg.size() * mass_ratios.size() * softnesses.size() * froude_numbers.size();
  }
  friend bool operator==(const DatabaseGrid&, const DatabaseGrid&) = default;
};

/// Whether a list can be an axis of a grid: two values at least, from 1e-12 to 1e12, ascending by more than a
/// billionth each, so that their logarithms differ too.
bool is_grid_axis(const std::vector<double>& values);

/// The grid of the database that ships with Polynya.
DatabaseGrid default_grid();

/// The table at one point of its grid.
struct DatabaseEntry {
  double force = 0;        ///< V̂_b = V_b / (σ_f h²)
  double cusp_radius = 0;  ///< R / l
  double crack_ratio = 0;  ///< greatest bottom-fibre hoop stress before failure, in σ_f

  friend bool operator==(const DatabaseEntry&, const DatabaseEntry&) = default;
};

/// An answer of the table, and which groups were clamped to its edge for it.
struct DatabaseAnswer : DatabaseEntry {
  std::uint8_t outside = 0;  ///< one bit per Group

  bool is_outside(Group group) const { return ((outside >> static_cast<unsigned>(group)) & 1U) != 0; }
  bool is_in_range() const { return outside == 0; }
};

/// A group of a load that lies outside of a table, and the table's range.
struct OutsideRange {
  std::string name;  ///< of kGroupNames, or of what else a table is made for
  double value = 0;  ///< the load's; the opening angle in degrees
  double least = 0, most = 0;

  friend bool operator==(const OutsideRange&, const OutsideRange&) = default;
};

/// The icebreaking database: where wedges of floating ice break, tabulated over the dimensionless groups.
class BendingDatabase {
 public:
  /// entries in the order of the grid's lists, Froude number fastest; asserts their number, and that every
  /// force, radius and grid value is positive and the grid ascends.
  BendingDatabase(SolverSettings settings, DatabaseGrid grid, std::vector<DatabaseEntry> entries);

  /// Multilinear in 2α, ln m̂, ln Π and, along pushes of equal duration Fr ∝ Π^½, ln Fr, for ln V̂/2α, ln R/l
  /// and the crack ratio. Outside the grid the nearest edge answers and is named; except that below the least
  /// Froude number the wedge is at rest on its water, and the edge's answer is the answer.
  DatabaseAnswer look_up(const WedgeGroups& groups) const;

  /// The groups that look_up() clamps to an edge; empty in range.
  std::vector<OutsideRange> outside(const WedgeGroups& groups) const;

  const SolverSettings& settings() const { return settings_; }
  const DatabaseGrid& grid() const { return grid_; }
  const std::vector<DatabaseEntry>& entries() const { return entries_; }

 private:
  SolverSettings settings_;
  DatabaseGrid grid_;
  std::vector<DatabaseEntry> entries_;
  std::vector<DatabaseEntry> stored_;               ///< ln V̂/2α, ln R/l, crack ratio
  std::array<std::vector<double>, 4> coordinates_;  ///< 2α [rad], ln m̂, ln Π, ln Fr
  std::array<std::size_t, 4> strides_;
};

/// Why a database could not be made or read, with its line where it has one.
struct DatabaseError {
  int line = 0;  ///< 0: not a line's fault
  std::string message;
};

using BuildProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Solves the wedge at every point of the grid. The threads share the work; the result does not depend on how
/// many they are. progress, if any, is called by one thread at a time. Stored to six significant digits.
tl::expected<BendingDatabase, DatabaseError> build_database(const SolverSettings& settings, const DatabaseGrid& grid,
                                                            int threads = 1, const BuildProgress& progress = {});

// ---- as text

/// Names of the fluid models in files and on the command line: winkler, local-mass, potential, free-surface.
std::string_view fluid_name(FluidModel fluid);
tl::expected<FluidModel, DatabaseError> fluid_from_name(std::string_view name);

/// The database as text, UTF-8, one item per line, the same bytes for the same database:
///   polynya-bending-database 1      the format's version
///   fluid potential                 the solver's settings, one per line in SolverSettings' order
///   …
///   opening_angle_deg 20 25 …       the four grids
///   mass_ratio …
///   softness …
///   froude …
///   columns force radius crack      V̂_b, R / l, crack ratio; Froude number fastest, opening angle slowest
///   entries N                       then N lines of three numbers
///   hash fnv1a64 0123456789abcdef   of every byte before this line
std::string write_database(const BendingDatabase& database);

/// Reads what write_database() writes, and nothing else: an unknown line, a number out of range, a missing or
/// extra entry or a wrong hash is an error with its line. Takes at most kMostEntries entries and kLargestFile
/// bytes.
tl::expected<BendingDatabase, DatabaseError> parse_database(std::string_view text);

// A damaged file must not take memory without bound; the shipped one has 13 500 lines in 0.35 MB.
inline constexpr std::size_t kMostEntries = 200'000;
inline constexpr std::size_t kLargestFile = 16'000'000;

/// The hash on the last line of the database's text, as printed there.
std::string database_hash(const BendingDatabase& database);

/// The database that ships with Polynya, compiled in. `polynya database build` with no options makes the same
/// bytes.
const BendingDatabase& default_database();

/// Its text as compiled in.
std::string_view default_database_text();

}  // namespace polynya::fracture
