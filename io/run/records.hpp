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

/// A column of forces.csv, contacts.csv, crushed.csv or panels.csv. The first columns, which name time and bodies, are
/// not in these tables. Row is the record that makes one row of the file. Writer, reader and Python follow the tables
/// of columns. A test compares docs/run-folder.md with them, except for crushed.csv, whose columns the page explains in
/// prose. To add a column, append it to its table in records.cpp, and add the row that the test prints to the page. A
/// column that is removed or renamed makes older runs unreadable.
template <class Row>
struct Column {
  std::string name;     ///< name with its unit, in the first line of the file: "surge_N"
  std::string meaning;  ///< description in docs/run-folder.md
  /// Returns the value of a record in the unit of `name`; NaN if there is none; for a column of words the index in
  /// `words`. Angles are in radians in records and in degrees in files.
  std::function<double(const Row&)> read;
  /// Stores such a value in a record. Throws ReadError if a whole number is needed and it is none.
  std::function<void(Row&, double)> store;
  std::span<const std::string_view> words = {};  ///< possible values of a column of words; empty: a column of numbers
};

/// Removes the first field and its comma from a row, and returns the field. It is empty for an empty row. Fields have
/// no quotes, because names of bodies have no commas.
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

/// Condition on a scene under which views show a load and summary.json has its peak. In other scenes the load is 0
/// or of no interest. forces.csv has all loads in every scene.
enum class ShownWhere {
  kAlways,
  kAmongShips,     ///< scenes with two or more hulls: ships, structures and walls
  kUnderHulls,     ///< scenes with ships with a draught, under which ice can go
  kInWater,        ///< scenes with ships on which water acts, or that have an engine or a mooring
  kWithEngines,    ///< scenes with ships that have an engine
  kWithThrusters,  ///< scenes with ships that are steered by thrusters
  kWithRudders,    ///< scenes with ships that are steered by rudders
  kRamming,        ///< scenes with ships whose pilots ram
  kMoored,         ///< scenes with moored ships
  kWhereItSplits   ///< scenes in which the criterion j/τ_c decides whether floes split
};

/// How a number is computed from the time steps of its recording interval (record.forces_interval_s).
enum class Over {
  kMean,         ///< mean over the interval; it hardly depends on the time step
  kLargestStep,  ///< value of the step in which its magnitude is largest; it depends on the length of the step
  kAtEnd         ///< value at the end of the interval
};

/// A number that forces.csv records for each ship, structure and wall. The peaks of checkpoints and summary.json and
/// the plots of the player follow this table too.
struct ForceColumn : Column<simulation::HullSample> {
  std::string_view unit;  ///< unit for people: "N·m"; empty for a number without a unit
  Over over = Over::kAtEnd;
  std::optional<ShownWhere> peak = {};  ///< scenes whose summary.json has its largest magnitude; none: it has no peak
  /// Scenes in which the player plots it; none: the same scenes as for `peak`. With neither, and with kAlways or
  /// kWhereItSplits, it is plotted in every scene (the player hides curves of the paper where j/τ_c does not decide
  /// splits).
  std::optional<ShownWhere> plotted = {};
  std::string plot = {};            ///< title of its plot in the player; empty: the player does not plot it
  std::string_view curve = "mean";  ///< kind of its curve in that plot: "mean", "max" or "paper"
  /// True: a forces.csv without it is accepted, because older runs do not have it. The record then keeps its initial
  /// value.
  bool is_optional = false;
};

/// Returns all columns of forces.csv after t_s and ship, in the order in which they are written.
std::span<const ForceColumn> force_columns();

/// Returns the column of forces.csv of that name, such as "surge_N". It must exist; there is no check in release
/// builds.
const ForceColumn& force_column(std::string_view name);

/// Returns true if the scene fulfils the condition.
bool is_shown(ShownWhere where, const simulation::Scene& scene);

/// Returns the columns whose peaks are in summary.json of a run of the scene. ShipPeaks::of_column has this order.
std::vector<const ForceColumn*> peak_columns(const simulation::Scene& scene);

/// Returns the columns that the player plots for runs of the scene.
std::vector<const ForceColumn*> plotted_columns(const simulation::Scene& scene);

/// Returns the columns that the first line of a forces.csv names after t_s and ship, in its order. Fails if a column is
/// unknown, occurs twice, or is missing and not optional; the error names it.
Result<std::vector<const ForceColumn*>> force_columns_in(std::string_view header);

/// A part of the force on a ship, by its cause, in one direction. It is a column of forces.csv. The causes of one
/// direction add up to the force on the ship, mass × acceleration (docs/run-folder.md). A cause that is a share of
/// another one (the friction of the ice, a share of the force of the ice) must not be added again.
struct ForceCause {
  std::string_view direction;      ///< title of the player's plot that stacks the causes: "Surge force by cause"
  std::string_view cause;          ///< short name, which also selects its colour in the player: "friction"
  std::string_view words;          ///< name for people: "ice: friction"
  std::string_view column;         ///< column of forces.csv: "surge_from_ice_friction_N"
  std::string_view share_of = {};  ///< column of the cause of which this one is a share; empty: it is no share
  /// Name for the rest of this cause if its shares are shown separately; empty: it has no shares.
  std::string_view without_shares = {};
};

/// Returns all causes: first of surge, then of sway, then of yaw.
std::span<const ForceCause> force_causes();

/// Returns the causes whose columns the player plots for runs of the scene, in the same order.
std::vector<ForceCause> force_causes(const simulation::Scene& scene);

// Columns of contacts.csv, crushed.csv and panels.csv after those that name time and bodies, in the order of the files.
using ContactColumn = Column<simulation::ContactState>;
using CrushedColumn = Column<simulation::CrushedOverlap>;
using PanelColumn = Column<simulation::PanelSample>;
std::span<const ContactColumn> contact_columns();
std::span<const CrushedColumn> crushed_columns();
std::span<const PanelColumn> panel_columns();

/// Appends the values of a row in the order of `columns`, each after a comma, and a line break. `none` is written where
/// the value is NaN: "null" in tables in which every field must have a number or null (forces.csv, crushed.csv),
/// otherwise nothing. The fields that name time and bodies must be in `text` already.
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

/// Returns the value of a field: with `words` the index of the word, otherwise the number, or NaN for "null" and an
/// empty field. Throws ReadError for anything else.
double value_of(std::string_view field, std::span<const std::string_view> words = {});

/// Stores the values of a row in a record. `text` is the row after the fields that name time and bodies. Rows of
/// earlier versions may have fewer values than there are columns; the rest of the record then keeps its values, also in
/// a row that was cut off between two fields. Throws ReadError if a value is wrong or there are too many.
template <class Row>
void read_row(std::string_view text, Row& row, std::span<const Column<Row>> columns) {
  for (const Column<Row>& column : columns) {
    if (text.empty()) return;
    column.store(row, value_of(csv_field(text), column.words));
  }
  if (!text.empty()) throw ReadError("more fields than there are columns");
}

/// Returns the id of a floe, or nothing for kNoFloe. JsonWriter writes a missing value as null, which floe_id() reads.
inline std::optional<simulation::FloeId> id_or_none(simulation::FloeId floe) {
  return floe == simulation::kNoFloe ? std::nullopt : std::optional(floe);
}

/// Returns the name of a ship, structure or wall by its index among the hulls of the scene; empty if there is none with
/// that index, such as −1 for a contact of two floes.
std::string_view hull_name(const simulation::Scene& scene, int ship);

// The functions below write the files of a run (docs/run-folder.md). Each of those named append_… appends whole lines
// to a text, except append_floe.

/// Returns the first bytes of a growing file, by its name: for a table the names of its columns and a line break, for
/// frames.bin its binary header, and nothing for the other files. A run can only be continued if its files begin so.
std::string header_of(std::string_view file);

/// forces.csv: loads on a hull in a recording interval, in its own frame, and its motion at the end of the interval.
void append_forces_row(std::string& text, const simulation::HullSample& sample, const simulation::Scene& scene);

/// contacts.csv: a contact of two bodies, either at a frame, or at the peak of its force with the reason why it ended.
/// `time` is the time of the frame or of the peak [s]. A ship is written by its name, a floe by its id.
void append_contact(std::string& text, double time, const simulation::ContactState& contact,
                    const simulation::Scene& scene);

/// panels.csv: loads of ice on a panel, which is a section of a hull's side, in a recording interval. There
/// are only rows of intervals in which ice pressed on the panel.
void append_panel(std::string& text, const simulation::PanelSample& sample, const simulation::Scene& scene);

/// Overlaps smaller than this fraction of the smaller body's area are left out of crushed.csv [-]. A smaller value
/// makes the file longer; a larger one hides overlaps that the bodies visibly have. It does not change the run, and is
/// not the limit of the same name in simulation/ice/overlaps.cpp.
inline constexpr double kLeastCrushedShare = 1e-3;
/// crushed.csv: the overlap of two bodies at a frame, by what became of its ice: crushed, tilted under a hull, or not
/// yet crushed (CrushedOverlap::unpaid).
void append_crushed(std::string& text, double time, const simulation::CrushedOverlap& overlap,
                    const simulation::Scene& scene);

/// states.csv: a hash of the whole state at a frame, at `time` [s], after `steps` ticks. Two runs can be compared by
/// it: it shows at which frame they begin to differ.
void append_state(std::string& text, double time, std::int64_t steps, std::uint64_t hash);

/// floes.ndjson: a floe when it comes into being. `parent` is the shape of the floe from which it broke, to whose
/// vertices the line then refers (shape_parts.hpp); with null all vertices are written, as for a floe of the scene.
/// With a scene, all ice properties of a floe that has its own ice, and the id of the floe in the floe file, are
/// written too; without one they are left out. The shape is in the floe's body frame [m].
void append_birth(std::string& text, const simulation::Birth& birth, const geometry::Polygon* parent,
                  const simulation::Scene* scene = nullptr);

/// Returns floes as a GeoJSON FeatureCollection in world coordinates [m], with the time [s] and the origin of the
/// scene, if it has one. final.geojson has this form, and a scene can continue from it.
std::string to_geojson(const std::vector<simulation::FloeState>& floes, double time,
                       const std::optional<simulation::GeographicOrigin>& origin = {});
/// Adds one floe to such a collection, with its ice, velocity and age as properties.
void append_floe(GeojsonLayer& layer, const simulation::FloeState& floe);

// The functions below read these lines, without the line break. Each throws ReadError if a line is not valid; whoever
// reads a whole file adds its name and the number of the line.

/// Returns the JSON value of a line.
JsonValue json_of(std::string_view text);
/// Returns the id of a floe; kNoFloe for null. Whether the run has the floe is not checked.
simulation::FloeId floe_id(const JsonValue& value);

/// Returns the data of a line of floes.ndjson, without its shape (read_shape).
simulation::BirthRecord birth_of(const JsonValue& line);
/// Returns a row of forces.csv. `columns` are the columns that its first line names (force_columns_in). Fields after
/// the last one are ignored; a missing one is refused.
simulation::HullSample sample_of(std::string_view line, const std::vector<const ForceColumn*>& columns,
                                 const simulation::Scene& scene);
/// Return a row of crushed.csv and of contacts.csv. `run` must already have its scene and its floes, whose names and
/// ids the rows contain; a row that names another body is refused.
RunCrushed crushed_of(std::string_view line, const Run& run);
RunContact contact_of(std::string_view line, const Run& run);
/// Returns a row of panels.csv. A row that names another hull than those of the scene is refused.
simulation::PanelSample panel_of(std::string_view line, const simulation::Scene& scene);
/// Checks that a line is a row of states.csv; its values are not needed to read a run.
void check_state(std::string_view line);

}  // namespace polynya::io
