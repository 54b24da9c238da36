#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/run/run_reader.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/source_text.hpp"
#include "simulation/simulation.hpp"
#include "simulation/world/journal.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::io {

/// A column of forces.csv, contacts.csv, crushed.csv or panels.csv after the columns that name time and bodies. Writer,
/// reader, Python and docs/run-folder.md follow these tables; a test compares the page. To add a column, append it to
/// its table in records.cpp, and add the row that the test prints to the page.
template <class Row>
struct Column {
  std::string name;     ///< name with its unit: "surge_N"
  std::string meaning;  ///< description in docs/run-folder.md
  /// Returns the value; NaN if there is none; for a column of words the index in `words`.
  std::function<double(const Row&)> read;
  std::function<void(Row&, double)> store;
  std::span<const std::string_view> words = {};  ///< values of a column that has words instead of numbers
};

/// Removes the first field from a row and returns it.
inline std::string_view csv_field(std::string_view& row) {
  const std::string_view field = row.substr(0, row.find(','));
  row.remove_prefix(std::min(row.size(), field.size() + 1));
  return field;
}

/// Reads a field as a finite number, or "null" as NaN. Returns nothing for any other text.
inline std::optional<double> csv_number(std::string_view field) {
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (field == "null") return std::numeric_limits<double>::quiet_NaN();
  if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value)) return {};
  return value;
}

/// Scenes for which the views show a load.
enum class ShownWhere {
  kAlways,
  kAmongShips,     ///< scenes with several ships and structures
  kUnderHulls,     ///< scenes with ships under which ice can go
  kInWater,        ///< scenes with ships on which water acts, or that have an engine or a mooring
  kWithEngines,    ///< scenes with ships that have an engine
  kWithThrusters,  ///< scenes with ships that are steered by thrusters
  kWithRudders,    ///< scenes with ships that are steered by rudders
  kRamming,        ///< scenes with ships whose pilots ram
  kMoored,         ///< scenes with moored ships
  kWhereItSplits   ///< scenes in which j/τ_c decides splits
};

/// How a number is computed from the time steps of its interval: as mean, as largest value, or as value at the end.
enum class Over { kMean, kLargestStep, kAtEnd };

/// A number that forces.csv records for each ship and structure. The peaks of checkpoints and summary.json and the
/// plots of the player follow this table too.
struct ForceColumn : Column<simulation::HullSample> {
  std::string_view unit;  ///< unit for people: "N·m"; empty for a count
  Over over = Over::kAtEnd;
  std::optional<ShownWhere> peak = {};  ///< scenes whose summary.json has its largest magnitude; none: it has no peak
  std::optional<ShownWhere> plotted = {};  ///< scenes in which the player plots it, if they differ from those of `peak`
  std::string plot = {};                   ///< title of its plot in the player; empty: the player does not plot it
  std::string_view curve = "mean";         ///< curve in that plot: "mean", "max" or "paper"
  bool is_optional = false;                ///< true if older runs do not have it
};

/// Returns all columns of forces.csv after t_s and ship.
std::span<const ForceColumn> force_columns();

/// Returns the column of that name, which must exist.
const ForceColumn& force_column(std::string_view name);

/// Returns true if the views of a scene show loads of this kind.
bool is_shown(ShownWhere where, const simulation::Scene& scene);

/// Returns the columns whose peaks are in summary.json of a run of the scene.
std::vector<const ForceColumn*> peak_columns(const simulation::Scene& scene);

/// Returns the columns that the player plots for runs of the scene.
std::vector<const ForceColumn*> plotted_columns(const simulation::Scene& scene);

/// Returns the columns that the first line of a forces.csv names after t_s and ship. The error names the column that is
/// unknown, occurs twice or is missing.
Result<std::vector<const ForceColumn*>> force_columns_in(std::string_view header);

/// A part of the force on a ship, by its cause. It is a column of forces.csv; columns that are only shares of it are
/// left out. The parts of one direction add up to the force on the ship, mass × acceleration (docs/run-folder.md).
struct ForceCause {
  std::string_view direction;      ///< title of the player's plot that stacks the parts: "Surge force by cause"
  std::string_view cause;          ///< short name, which also selects its colour: "friction"
  std::string_view words;          ///< name for people: "ice: friction"
  std::string_view column;         ///< column of forces.csv
  std::string_view share_of = {};  ///< column that contains this one; empty: none does
  /// Name for the rest of a column whose shares are shown separately; empty: it has no shares.
  std::string_view without_shares = {};
};

/// Returns all causes.
std::span<const ForceCause> force_causes();

/// Returns the causes whose columns the player plots for runs of the scene.
std::vector<ForceCause> force_causes(const simulation::Scene& scene);

using ContactColumn = Column<simulation::ContactState>;
using CrushedColumn = Column<simulation::CrushedOverlap>;
using PanelColumn = Column<simulation::PanelSample>;
std::span<const ContactColumn> contact_columns();
std::span<const CrushedColumn> crushed_columns();
std::span<const PanelColumn> panel_columns();

/// Appends the values of a row, each after a comma, and a line break. `none` is written where there is no number.
template <class Row, class Columns>
void append_row(std::string& text, const Row& row, const Columns& columns, std::string_view none = {}) {
  for (const auto& column : columns) {
    const double value = column.read(row);
    text += ',';
    if (!column.words.empty())
      text += column.words[static_cast<std::size_t>(value)];
    else if (std::isnan(value))
      text += none;
    else
      append_number(text, value);
  }
  text += '\n';
}

/// Returns the value of a field. Throws ReadError if it is neither a number nor one of the column's words.
double value_of(std::string_view field, std::span<const std::string_view> words = {});

/// Reads the values of a row. Rows of earlier versions may have fewer values than there are columns. Throws ReadError.
template <class Row>
void read_row(std::string_view text, Row& row, std::span<const Column<Row>> columns) {
  for (const Column<Row>& column : columns) {
    if (text.empty()) return;
    column.store(row, value_of(csv_field(text), column.words));
  }
  if (!text.empty()) throw ReadError("more fields than there are columns");
}

/// Returns the number of a floe, or nothing for kNoFloe, which records write as null.
inline std::optional<simulation::FloeId> id_or_none(simulation::FloeId floe) {
  return floe == simulation::kNoFloe ? std::nullopt : std::optional(floe);
}

/// Returns the name of a ship or structure by its index; empty if there is none.
std::string_view hull_name(const simulation::Scene& scene, int ship);

/// Lines of the files of a run (docs/run-folder.md). Each function appends whole lines to a text.

/// Returns the first bytes of a growing file: for a table its header, the names of the columns with their units.
std::string header_of(std::string_view file);

/// forces.csv: loads on a hull in a recording interval.
void append_forces_row(std::string& text, const simulation::HullSample& sample, const simulation::Scene& scene);

/// contacts.csv: contacts of bodies at a frame, and the peaks of the force of contacts.
void append_contact(std::string& text, double time, const simulation::ContactState& contact,
                    const simulation::Scene& scene);

/// panels.csv: loads of ice on a panel of a hull in a recording interval.
void append_panel(std::string& text, const simulation::PanelSample& sample, const simulation::Scene& scene);

/// Overlaps smaller than this fraction of the smaller body's area are left out of crushed.csv.
inline constexpr double kLeastCrushedShare = 1e-3;
/// crushed.csv: paid area of the overlap of two bodies at a frame.
void append_crushed(std::string& text, double time, const simulation::CrushedOverlap& overlap,
                    const simulation::Scene& scene);

/// states.csv: a hash of the whole state at each frame. It shows at which frame two runs begin to differ.
void append_state(std::string& text, double time, std::int64_t steps, std::uint64_t hash);

/// floes.ndjson: a floe. `parent` is the shape of the floe from which it broke, null for a floe of the scene. With a
/// scene, the floe's own ice properties and its id in the floe file are written too.
void append_birth(std::string& text, const simulation::Birth& birth, const geometry::Polygon* parent,
                  const simulation::Scene* scene = nullptr);

/// Returns all floes as a GeoJSON FeatureCollection in world coordinates [m].
std::string to_geojson(const std::vector<simulation::FloeState>& floes, double time,
                       const std::optional<simulation::GeographicOrigin>& origin = {});
/// Adds one floe to such a collection.
void append_floe(GeojsonLayer& layer, const simulation::FloeState& floe);

// The functions below read these lines. Each throws ReadError if a line is not valid.

JsonValue json_of(std::string_view text);
simulation::FloeId floe_id(const JsonValue& value);

simulation::BirthRecord birth_of(const JsonValue& line);
simulation::HullSample sample_of(std::string_view line, const std::vector<const ForceColumn*>& columns,
                                 const simulation::Scene& scene);
/// `run` already has its scene and its floes.
RunCrushed crushed_of(std::string_view line, const Run& run);
RunContact contact_of(std::string_view line, const Run& run);
simulation::PanelSample panel_of(std::string_view line, const simulation::Scene& scene);
/// Checks that a line is a row of states.csv.
void check_state(std::string_view line);

}  // namespace polynya::io
