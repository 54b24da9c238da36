#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "simulation/journal.hpp"

namespace polynya::io {

/// A number that forces.csv records of each ship and structure: its column, which names the unit, and how it
/// is read from a row and put back into one. The writer, the reader, summary.json and the views follow this
/// table; docs/run-folder.md has its names and meanings.
struct ForceColumn {
  std::string_view name;     ///< with its unit: "surge_N"
  std::string_view meaning;  ///< as docs/run-folder.md has it
  double (*read)(const simulation::ShipSample& row);
  void (*store)(simulation::ShipSample& row, double value);
  bool is_optional = false;  ///< older runs do not have it
};

/// All of them, as they follow the columns t_s and ship.
std::span<const ForceColumn> force_columns();

/// The one of that name, which must be in the table.
const ForceColumn& force_column(std::string_view name);

/// The columns that the first line of a forces.csv names, after t_s and ship. The error names the column that
/// is unknown, there twice or missing.
tl::expected<std::vector<const ForceColumn*>, std::string> force_columns_in(std::string_view header);

}  // namespace polynya::io
