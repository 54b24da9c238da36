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

/// A column of forces.csv, contacts.csv, crushed.csv or panels.csv, behind those that name time and bodies. Writer,
/// reader, Python and docs/run-folder.md follow these tables (a test compares the page): to add a column, add it at the
/// end of its table in records.cpp, and its row, which that test prints, to the page.
template <class Row>
struct Column {
  std::string name;                        ///< with its unit: "surge_N"
  std::string meaning;                     ///< as docs/run-folder.md has it
  std::function<double(const Row&)> read;  ///< not a number where there is none; of words the place in them
  std::function<void(Row&, double)> store;
  std::span<const std::string_view> words = {};  ///< in the place of numbers
};

/// Takes the first field off a row.
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

/// Where the views show a load.
enum class ShownWhere {
  kAlways,
  kAmongShips,     ///< in scenes of several ships and structures
  kUnderHulls,     ///< in scenes with ships that ice can go under
  kInWater,        ///< in scenes with ships that water acts on, or that have an engine or a mooring
  kWithEngines,    ///< in scenes with ships that have one
  kWithThrusters,  ///< in scenes with ships that are steered by thrusters
  kWithRudders,    ///< in scenes with ships that are steered by rudders
  kRamming,        ///< in scenes with ships whose pilots ram
  kMoored,         ///< in scenes with moored ships
  kWhereItSplits   ///< in scenes where j/τ_c decides splits
};

/// What a number is of the steps of its interval.
enum class Over { kMean, kLargestStep, kAtEnd };

/// A number that forces.csv records of each ship and structure; the checkpoint's peaks, summary.json and the player
/// follow its table too.
struct ForceColumn : Column<simulation::HullSample> {
  std::string_view unit;  ///< as people read it: "N·m"; empty of a count
  Over over = Over::kAtEnd;
  std::optional<ShownWhere> peak = {};     ///< where summary.json has its largest value by magnitude
  std::optional<ShownWhere> plotted = {};  ///< where it has a plot, if that is not where it has a peak
  std::string plot = {};                   ///< title of its plot in the player; empty: none
  std::string_view curve = "mean";         ///< in that plot; or "max", or "paper"
  bool is_optional = false;                ///< older runs do not have it
};

/// All of them, as they follow the columns t_s and ship.
std::span<const ForceColumn> force_columns();

/// The one of that name, which must be in the table.
const ForceColumn& force_column(std::string_view name);

/// Whether views of a scene show what is shown there.
bool is_shown(ShownWhere where, const simulation::Scene& scene);

/// The columns of which a scene's summary.json has the peak.
std::vector<const ForceColumn*> peak_columns(const simulation::Scene& scene);

/// The columns that the player plots of a scene's runs.
std::vector<const ForceColumn*> plotted_columns(const simulation::Scene& scene);

/// The columns that the first line of a forces.csv names, after t_s and ship. The error names the column that
/// is unknown, there twice or missing.
Result<std::vector<const ForceColumn*>> force_columns_in(std::string_view header);

/// A part of the force on a ship by what causes it: a column of forces.csv, without the columns that are
/// shares of it. The parts of one direction add up to the force on the ship, mass × acceleration
/// (docs/run-folder.md).
struct ForceCause {
  std::string_view direction;            ///< title of the player's plot that stacks the parts: "Surge force by cause"
  std::string_view cause;                ///< "friction": names its colour
  std::string_view words;                ///< as people read it: "ice: friction"
  std::string_view column;               ///< of forces.csv
  std::string_view share_of = {};        ///< the column that contains this one; empty: none
  std::string_view without_shares = {};  ///< words for a column whose shares are shown apart; empty: it has none
};

/// Every one there is.
std::span<const ForceCause> force_causes();

/// Those whose columns the player plots of a scene's runs.
std::vector<ForceCause> force_causes(const simulation::Scene& scene);

using ContactColumn = Column<simulation::ContactState>;
using CrushedColumn = Column<simulation::CrushedOverlap>;
using PanelColumn = Column<simulation::PanelSample>;
std::span<const ContactColumn> contact_columns();
std::span<const CrushedColumn> crushed_columns();
std::span<const PanelColumn> panel_columns();

/// Appends a row's values, each behind a comma, and a line's end; `none` where there is no number.
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

/// The value of a field; throws ReadError where it is neither a number nor one of the column's words.
double value_of(std::string_view field, std::span<const std::string_view> words = {});

/// Reads a row's values, as many as the row has: those of earlier versions had fewer. Throws ReadError.
template <class Row>
void read_row(std::string_view text, Row& row, std::span<const Column<Row>> columns) {
  for (const Column<Row>& column : columns) {
    if (text.empty()) return;
    column.store(row, value_of(csv_field(text), column.words));
  }
  if (!text.empty()) throw ReadError("more fields than there are columns");
}

/// A floe's number where there is such a floe; records have null where there is none.
inline std::optional<simulation::FloeId> id_or_none(simulation::FloeId floe) {
  return floe == simulation::kNoFloe ? std::nullopt : std::optional(floe);
}

/// The name of a ship or structure, by its index; empty where there is none.
std::string_view hull_name(const simulation::Scene& scene, int ship);

/// The lines of a run's files (docs/run-folder.md). Each function appends whole lines to a buffer.

/// What one that grows begins with: of a table the names of its columns, with their units.
std::string header_of(std::string_view file);

/// forces.csv: the loads on a hull in an interval.
void append_forces_row(std::string& text, const simulation::HullSample& sample, const simulation::Scene& scene);

/// contacts.csv: who touched whom at a frame, and how hard at the peaks of a contact's force.
void append_contact(std::string& text, double time, const simulation::ContactState& contact,
                    const simulation::Scene& scene);

/// panels.csv: what ice did to a panel of a hull in an interval.
void append_panel(std::string& text, const simulation::PanelSample& sample, const simulation::Scene& scene);

/// crushed.csv: the overlap of two bodies at a frame that their contacts have pressed, as it is booked. Pairs below
/// this share of the smaller body are left out.
inline constexpr double kLeastCrushedShare = 1e-3;
void append_crushed(std::string& text, double time, const simulation::CrushedOverlap& overlap,
                    const simulation::Scene& scene);

/// states.csv: a hash of everything at each frame.
void append_state(std::string& text, double time, std::int64_t steps, std::uint64_t hash);

/// `parent` is the shape of the floe that it broke from; null where it is of the scene. With a scene also the
/// ice that is the floe's own, and the id that it has in the file it is from.
void append_birth(std::string& text, const simulation::Birth& birth, const geometry::Polygon* parent,
                  const simulation::Scene* scene = nullptr);

/// All floes as a GeoJSON FeatureCollection in world coordinates [m].
std::string to_geojson(const std::vector<simulation::FloeState>& floes, double time,
                       const std::optional<simulation::GeographicOrigin>& origin = {});
/// One floe of them.
void append_floe(GeojsonLayer& layer, const simulation::FloeState& floe);

// The lines that records.hpp writes, read back. Each throws ReadError where a line is not what it should be.

JsonValue json_of(std::string_view text);
simulation::FloeId floe_id(const JsonValue& value);

simulation::BirthRecord birth_of(const JsonValue& line);
simulation::HullSample sample_of(std::string_view line, const std::vector<const ForceColumn*>& columns,
                                 const simulation::Scene& scene);
/// `run` has its scene and its floes.
RunCrushed crushed_of(std::string_view line, const Run& run);
RunContact contact_of(std::string_view line, const Run& run);
simulation::PanelSample panel_of(std::string_view line, const simulation::Scene& scene);
/// Checks that a line is a row of states.csv.
void check_state(std::string_view line);

}  // namespace polynya::io
