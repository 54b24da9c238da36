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

/// The dimensionless groups that decide, besides ν, when a wedge breaks (docs/theory/bending.md).
struct WedgeGroups {
  double opening_angle = 0;  ///< 2α [rad]
  double mass_ratio = 0;     ///< m̂ = ρ_i h / (ρ_w l)
  double softness = 0;       ///< Π = σ_f h² / (κ l²)
  double froude = 0;         ///< Fr = v_n / √(g l)
};

enum class Group : std::uint8_t { kOpeningAngle, kMassRatio, kSoftness, kFroude };

inline constexpr std::array<std::string_view, 4> kGroupNames = {"opening angle", "mass ratio", "softness",
                                                                "Froude number"};

/// The grid points of the table on each axis, ascending, at least two.
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

/// Returns true if a list can be an axis of a grid: at least two values, from 1e-12 to 1e12, each larger than the one
/// before by more than a billionth, so that their logarithms differ too.
bool is_grid_axis(const std::vector<double>& values);

/// Returns the grid of the database that ships with Polynya.
DatabaseGrid default_grid();

/// The values of the table at one grid point.
struct DatabaseEntry {
  double force = 0;        ///< V̂_b = V_b / (σ_f h²)
  double cusp_radius = 0;  ///< R / l
  double crack_ratio = 0;  ///< largest bottom-fibre hoop stress before failure over σ_f

  friend bool operator==(const DatabaseEntry&, const DatabaseEntry&) = default;
};

/// Values from the table, and the groups that were limited to its edge.
struct DatabaseAnswer : DatabaseEntry {
  std::uint8_t outside = 0;  ///< one bit per Group

  bool is_outside(Group group) const { return ((outside >> static_cast<unsigned>(group)) & 1U) != 0; }
  bool is_in_range() const { return outside == 0; }
};

/// A group of a load that lies outside of a table, and the table's range of it.
struct OutsideRange {
  std::string name;  ///< one of kGroupNames, or another quantity for which a table is made
  double value = 0;  ///< value of the load; the opening angle in degrees
  double least = 0, most = 0;

  friend bool operator==(const OutsideRange&, const OutsideRange&) = default;
};

/// The icebreaking database: where wedges of floating ice break, tabulated over the dimensionless groups.
class BendingDatabase {
 public:
  /// `entries` are in the order of the grid's lists, with the Froude number fastest. Asserts their number, that every
  /// force, radius and grid value is positive, and that the grid ascends.
  BendingDatabase(SolverSettings settings, DatabaseGrid grid, std::vector<DatabaseEntry> entries);

  /// Returns interpolated values: linear in 2α, ln m̂, ln Π and, along pushes of equal duration Fr ∝ Π^½, ln Fr, for ln
  /// V̂/2α, ln R/l and the crack ratio. Outside of the grid the values at the nearest edge are returned and the group
  /// is named. The exception is a Froude number below the smallest: the wedge is then practically at rest on its water,
  /// and the values at the edge are right.
  DatabaseAnswer look_up(const WedgeGroups& groups) const;

  /// Returns the groups that look_up() limits to an edge; empty if all are in range.
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

/// The reason why a database could not be made or read, with its line if it has one.
struct DatabaseError {
  int line = 0;  ///< 0: the error does not belong to a line
  std::string message;
};

using BuildProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Solves the wedge at every grid point. The threads share the work; the result does not depend on their number.
/// `progress`, if given, is called by one thread at a time. Values are stored to six significant digits.
tl::expected<BendingDatabase, DatabaseError> build_database(const SolverSettings& settings, const DatabaseGrid& grid,
                                                            int threads = 1, const BuildProgress& progress = {});

// ---- text

/// Returns the name of a fluid model in files and on the command line: winkler, local-mass, potential or free-surface.
std::string_view fluid_name(FluidModel fluid);
tl::expected<FluidModel, DatabaseError> fluid_from_name(std::string_view name);

/// Returns the database as text, UTF-8, one item per line; the same bytes for the same database:
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

/// Reads the format of write_database() and nothing else: an unknown line, a number out of range, a missing or extra
/// entry or a wrong hash is an error with its line. The text may have at most kMostEntries entries and kLargestFile
/// bytes.
tl::expected<BendingDatabase, DatabaseError> parse_database(std::string_view text);

// Limits, so that a damaged file cannot take memory without bound; the shipped one has 13 500 lines in 0.35 MB.
inline constexpr std::size_t kMostEntries = 200'000;
inline constexpr std::size_t kLargestFile = 16'000'000;

/// Returns the hash on the last line of the database's text.
std::string database_hash(const BendingDatabase& database);

/// Returns the database that ships with Polynya, which is compiled in. `polynya database build` without options makes
/// the same bytes.
const BendingDatabase& default_database();

/// Returns the text of that database.
std::string_view default_database_text();

}  // namespace polynya::fracture
