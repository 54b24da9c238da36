#pragma once

#include <string>
#include <string_view>

#include "fracture/bending/database.hpp"

namespace polynya::fracture {

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
