#include "io/run/csv_columns.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "geometry/shape/angle.hpp"

namespace polynya::io {

namespace {

using S = simulation::HullSample;
using dynamics::Planar;
using geometry::Point;
using geometry::Vector;
using enum Over;
using enum ShownWhere;

/// Whether older runs do not have what is shown there.
constexpr bool is_of_newer_runs(ShownWhere where) {
  return where != kAlways && where != kWhereItSplits;
}

/// What a load is in one of the ship's axes.
struct Axis {
  std::string_view key, suffix, unit, title, noun, direction;
  double Planar::*component;
};
constexpr Axis kSurge{"surge", "_N", "N", "Surge force", "force", "forward", &Planar::surge};
constexpr Axis kSway{"sway", "_N", "N", "Sway force", "force", "to port", &Planar::sway};
constexpr Axis kYaw{"yaw", "_Nm", "N·m", "Yaw moment", "moment", "counter-clockwise", &Planar::yaw};

/// A load of which rows have surge, sway and yaw.
struct Load {
  std::string_view stem;  ///< "_from_water": surge_from_water_N, …
  Planar S::*place;
  Over over = kMean;
  std::string_view source;  ///< "of the water": force of the water forward, Surge force of the water
  ShownWhere where = kAlways;
  std::string_view source_in_titles = {};  ///< where it is shorter there
  std::string_view curve = "mean";
  std::vector<Axis> axes = {kSurge, kSway, kYaw};
};

/// Where a number has its peak or its plot, and the plot's title.
struct Shown {
  std::optional<ShownWhere> peak = {};
  std::optional<ShownWhere> plotted = {};
  std::string plot = {};
};

struct Table {
  std::vector<ForceColumn> columns = {};

  /// The number at the end of a path of pointers to members.
  template <class... Path>
  ForceColumn& number(const std::string& name, std::string_view unit, Over over, const std::string& meaning,
                      const Shown& shown, Path... path) {
    const bool is_turn = unit.starts_with("°");
    const double scale = is_turn ? geometry::kDegreesPerRadian : 1;
    const double inverse = is_turn ? geometry::kRadiansPerDegree : 1;
    const auto where = shown.plotted ? shown.plotted : shown.peak;
    return columns.emplace_back(
        ForceColumn{.name = name,
                    .unit = unit,
                    .meaning = meaning,
                    .over = over,
                    .read = [=](const S& s) { return scale * static_cast<double>((s.*....*path)); },
                    .store =
                        [=](S& s, double value) {
                          auto& place = (s.*....*path);
                          place = static_cast<std::remove_reference_t<decltype(place)>>(inverse * value);
                        },
                    .peak = shown.peak,
                    .plotted = shown.plotted,
                    .plot = shown.plot,
                    .is_optional = where && is_of_newer_runs(*where)});
  }
  void load(const Load& l) {
    const std::string_view source = l.source_in_titles.empty() ? l.source : l.source_in_titles;
    for (const Axis& axis : l.axes)
      number(fmt::format("{}{}{}", axis.key, l.stem, axis.suffix), axis.unit, l.over,
             fmt::format("{} {} {}", axis.noun, l.source, axis.direction),
             {l.where, {}, fmt::format("{} {}", axis.title, source)}, l.place, axis.component)
          .curve = l.curve;
  }
};

void add_contact_loads(Table& t) {
  t.load({"", &S::from_ice, kMean, "of the ice"});
  t.load({"_max", &S::from_ice_largest, kLargestStep, "of the ice", kAlways, {}, "max"});
  constexpr std::string_view kOfShips = "of other ships and structures";
  t.load({"_from_ships", &S::from_ships, kMean, kOfShips, kAmongShips, "of ships"});
  t.load({"_from_ships_max", &S::from_ships_largest, kLargestStep, kOfShips, kAmongShips, "of ships", "max"});
  t.load({"_from_submerged_ice", &S::from_submerged, kMean, "of the ice under the hull", kUnderHulls, {}, "mean"});
  t.number("ice_under_hull_m2", "m²", kAtEnd, "ice under the hull", {kUnderHulls, {}, "Ice under the hull"},
           &S::submerged_area);
  t.load({"_j_over_tau_c", &S::collision, kLargestStep, "of the ice by the paper, j/τ_c,", kWhereItSplits, "of the ice",
          "paper"});
}

void add_motion(Table& t) {
  t.number("x_m", "m", kAtEnd, "centre of gravity, over ground", {}, &S::position_in_world, &Point::x);
  t.number("y_m", "m", kAtEnd, "centre of gravity, over ground", {}, &S::position_in_world, &Point::y);
  t.number("heading_deg", "°", kAtEnd, "from the x axis, counter-clockwise", {}, &S::heading);
  t.columns.push_back({.name = "speed_m_per_s",
                       .unit = "m/s",
                       .meaning = "over ground",
                       .read = [](const S& s) { return length(s.velocity_in_world); },
                       .store = [](S&, double) {},  // it follows from the velocity
                       .peak = kAlways,
                       .plot = "Speed over ground"});
  t.number("vx_m_per_s", "m/s", kAtEnd, "velocity over ground", {}, &S::velocity_in_world, &Vector::x);
  t.number("vy_m_per_s", "m/s", kAtEnd, "velocity over ground", {}, &S::velocity_in_world, &Vector::y);
  t.number("yaw_rate_deg_per_s", "°/s", kAtEnd, "counter-clockwise", {}, &S::yaw_rate);
}

void add_sailing_loads(Table& t) {
  t.number("thrust_N", "N", kMean, "along the heading; of a ship at constant speed what it takes to hold it",
           {{}, {}, "Thrust"}, &S::thrust);
  t.load({"_from_thrusters",
          &S::from_engine,
          kMean,
          "of turned thrusters",
          kWithThrusters,
          "of thrusters",
          "mean",
          {kSway, kYaw}});
  t.load(
      {"_from_water", &S::from_water, kMean, "of the water on the hull, with its inertia,", kInWater, "of the water"});
  t.load(
      {"_from_rudder", &S::from_rudder, kMean, "of the rudder, with the hull's share,", kWithRudders, "of the rudder"});
  t.load({"_from_mooring", &S::from_mooring, kMean, "of the mooring", kMoored});
  t.load({"_from_ice_friction", &S::friction_of_ice, kMean,
          "of the ice's friction along the waterline, a share of that of the ice,", kInWater, "of the ice's friction"});
}

void add_helm(Table& t) {
  t.number("lever", "", kAtEnd, "of the thrust, a share of the power: −1 full astern to 1 full ahead",
           {{}, kWithEngines, "Thrust lever"}, &S::lever);
  t.number("steering_deg", "°", kAtEnd, "angle of rudder or thrusters, to port", {{}, kWithEngines, "Steering angle"},
           &S::steering_angle);
  t.number("delivered_power_W", "W", kAtEnd, "power of the engine at that lever; 0 where none is given",
           {{}, kWithEngines, "Delivered power"}, &S::delivered_power);
  t.number("rams", "", kAtEnd, "charges after the first, of a pilot that rams", {{}, kRamming, "Rams"}, &S::rams);
  t.number("gained_m", "m", kAtEnd, "by rams, from where the ship was first stuck", {{}, kRamming, "Gained by ramming"},
           &S::gained);
  t.number("contacts", "", kAtEnd, "with ice", {{}, {}, "Contacts at the hull"}, &S::contacts);
  t.number("contacts_with_ships", "", kAtEnd, "with other ships and structures", {}, &S::contacts_with_ships)
      .is_optional = true;
}

std::vector<ForceColumn> all_columns() {
  Table table;
  add_contact_loads(table);
  add_motion(table);
  add_sailing_loads(table);
  add_helm(table);
  return std::move(table.columns);
}

template <class Condition>
std::vector<const ForceColumn*> columns_where(Condition condition) {
  std::vector<const ForceColumn*> columns;
  for (const ForceColumn& column : force_columns())
    if (condition(column)) columns.push_back(&column);
  return columns;
}

const ForceColumn* find_column(std::string_view name) {
  const auto found = std::ranges::find(force_columns(), name, &ForceColumn::name);
  return found == force_columns().end() ? nullptr : &*found;
}

}  // namespace

std::span<const ForceColumn> force_columns() {
  static const std::vector<ForceColumn> kColumns = all_columns();
  return kColumns;
}

bool is_shown(ShownWhere where, const simulation::Scene& scene) {
  if (where == kAmongShips) return hull_count(scene) > 1;
  if (where == kUnderHulls) return has_draught(scene);
  const auto any_ship = [&](auto condition) { return std::ranges::any_of(scene.ships, condition); };
  using simulation::Ship;
  if (where == kInWater) return any_ship(simulation::sails);
  if (where == kWithEngines)
    return any_ship([](const Ship& s) { return std::holds_alternative<simulation::Engine>(s.propulsion); });
  if (where == kWithRudders)
    return any_ship([](const Ship& s) { return std::holds_alternative<simulation::RudderSettings>(s.steering); });
  if (where == kWithThrusters)
    return any_ship([](const Ship& s) { return std::holds_alternative<simulation::AzimuthSettings>(s.steering); });
  if (where == kRamming)
    return any_ship([](const Ship& s) { return std::holds_alternative<simulation::RammingPilot>(s.pilot); });
  if (where == kMoored) return any_ship([](const Ship& s) { return s.mooring.has_value(); });
  return where == kAlways || splits_by_j_over_tau_c(scene);
}

std::vector<const ForceColumn*> peak_columns(const simulation::Scene& scene) {
  return columns_where([&](const ForceColumn& c) { return c.peak && is_shown(*c.peak, scene); });
}

std::vector<const ForceColumn*> plotted_columns(const simulation::Scene& scene) {
  return columns_where([&](const ForceColumn& c) {
    const std::optional<ShownWhere> where = c.plotted ? c.plotted : c.peak;
    return !c.plot.empty() && (!where || !is_of_newer_runs(*where) || is_shown(*where, scene));
  });
}

const ForceColumn& force_column(std::string_view name) {
  const ForceColumn* found = find_column(name);
  assert(found != nullptr);
  return *found;
}

Result<std::vector<const ForceColumn*>> force_columns_in(std::string_view header) {
  if (csv_field(header) != "t_s" || csv_field(header) != "ship") return fail("columns of another version");
  std::vector<const ForceColumn*> columns;
  while (!header.empty()) {
    const std::string_view name = csv_field(header);
    const ForceColumn* found = find_column(name);
    if (found == nullptr || std::ranges::count(columns, found) > 0)
      return fail(fmt::format("a column \"{}\" of another version, or a second one", name));
    columns.push_back(found);
  }
  for (const ForceColumn& column : force_columns()) {
    if (!column.is_optional && std::ranges::count(columns, &column) == 0)
      return fail(fmt::format("no column \"{}\"", column.name));
  }
  return columns;
}

namespace {

constexpr std::string_view kDirections[]{"Surge force by cause", "Sway force by cause", "Yaw moment by cause"};

/// What one cause gives in each direction.
struct Row {
  std::string_view cause, words;
  std::string_view columns[3];  ///< empty: none
};
constexpr Row kIce{"ice", "ice on the hull, with friction", {"surge_N", "sway_N", "yaw_Nm"}};
constexpr Row kFriction{
    "friction", "ice: friction", {"surge_from_ice_friction_N", "sway_from_ice_friction_N", "yaw_from_ice_friction_Nm"}};
constexpr Row kRows[]{
    kIce,
    kFriction,
    {"submerged",
     "ice under the hull",
     {"surge_from_submerged_ice_N", "sway_from_submerged_ice_N", "yaw_from_submerged_ice_Nm"}},
    {"water", "water on the hull", {"surge_from_water_N", "sway_from_water_N", "yaw_from_water_Nm"}},
    {"thrust", "thrust", {"thrust_N"}},
    {"thrust", "thrusters", {"", "sway_from_thrusters_N", "yaw_from_thrusters_Nm"}},
    {"rudder", "rudder", {"surge_from_rudder_N", "sway_from_rudder_N", "yaw_from_rudder_Nm"}},
    {"mooring", "mooring", {"surge_from_mooring_N", "sway_from_mooring_N", "yaw_from_mooring_Nm"}},
    {"ships", "other ships", {"surge_from_ships_N", "sway_from_ships_N", "yaw_from_ships_Nm"}},
};

std::vector<ForceCause> all_causes() {
  std::vector<ForceCause> causes;
  for (std::size_t i = 0; i < std::size(kDirections); ++i) {
    for (const Row& row : kRows) {
      if (row.columns[i].empty()) continue;
      ForceCause& cause = causes.emplace_back();
      cause = {kDirections[i], row.cause, row.words, row.columns[i]};
      if (row.cause == kFriction.cause) cause.share_of = kIce.columns[i];
      if (row.cause == kIce.cause) cause.without_shares = "ice: crushing and pushing";
    }
  }
  return causes;
}

}  // namespace

std::span<const ForceCause> force_causes() {
  static const std::vector<ForceCause> kCauses = all_causes();
  return kCauses;
}

std::vector<ForceCause> force_causes(const simulation::Scene& scene) {
  const std::vector<const ForceColumn*> plotted = plotted_columns(scene);
  std::vector<ForceCause> causes;
  std::ranges::copy_if(force_causes(), std::back_inserter(causes), [&](const ForceCause& cause) {
    return std::ranges::find(plotted, cause.column, &ForceColumn::name) != plotted.end();
  });
  return causes;
}

namespace {

using simulation::ContactState;
using simulation::PanelSample;

constexpr std::array<std::string_view, 5> kPeakEnds{"", "bend", "split", "slip", "tilt"};

/// A column of the number at the end of a path of pointers to members.
template <class Row, class... Path>
LoadColumn<Row> number(std::string_view name, std::string_view meaning, Path... path) {
  const auto at = [path...](auto& row) -> auto& {
    return (row.*....*path);
  };
  return {name, meaning, [at](const Row& row) { return static_cast<double>(at(row)); },
          [at](Row& row, double value) {
            auto& place = at(row);
            place = static_cast<std::remove_reference_t<decltype(place)>>(value);
          }};
}

template <class Row>
void append_values(std::string& text, const Row& row, std::span<const LoadColumn<Row>> columns) {
  for (const LoadColumn<Row>& column : columns) {
    const double value = column.read(row);
    text += ',';
    if (!column.words.empty())
      text += column.words[static_cast<std::size_t>(value)];
    else if (!std::isnan(value))
      append_number(text, value);
  }
  text += '\n';
}

/// Of a field; nothing where it is neither a number nor a word of the column.
template <class Row>
std::optional<double> value_of(std::string_view field, const LoadColumn<Row>& column) {
  if (column.words.empty()) return field.empty() ? ContactState::kNowhere : csv_number(field);
  const auto word = std::ranges::find(column.words, field);
  if (word == column.words.end()) return {};
  return static_cast<double>(word - column.words.begin());
}

template <class Row>
bool read_values(std::string_view text, Row& row, std::span<const LoadColumn<Row>> columns) {
  bool has_more = true;
  for (const LoadColumn<Row>& column : columns) {
    if (!has_more) return true;
    const std::size_t comma = text.find(',');
    has_more = comma != std::string_view::npos;
    const auto value = value_of(text.substr(0, comma), column);
    if (!value) return false;
    column.store(row, *value);
    if (has_more) text.remove_prefix(comma + 1);
  }
  return !has_more;
}

}  // namespace

std::span<const ContactColumn> contact_columns() {
  using S = ContactState;
  static const std::array columns{
      number<S>("x_m", "where the force acts, over ground, when the step began: the contact line's centre of pressure",
                &S::point_in_world, &geometry::Point::x),
      number<S>("y_m", "likewise", &S::point_in_world, &geometry::Point::y),
      number<S>("fx_N", "the force on the first by the second, over ground: momentum given in the step, by its length",
                &S::force, &geometry::Vector::x),
      number<S>("fy_N", "likewise", &S::force, &geometry::Vector::y),
      number<S>("depth_m", "of the overlap, along the contact's normal", &S::depth),
      number<S>("is_crushing", "1 where the contact pressed with all that crushing ice carries, else 0",
                &S::is_crushing),
      number<S>("arc_m",
                "of that place on the waterline of `ship`, from its stem along the waterline, to port; to starboard "
                "negative; empty on a floe",
                &S::arc),
      number<S>("station_m", "of that place along the ship, from its stem aft; empty on a floe", &S::station),
      number<S>("width_m", "of the contact line", &S::width),
      number<S>("height_m", "of the ice that presses: its thickness, or what crushed of it at an inclined hull",
                &S::height),
      number<S>("pressure_Pa", "nominal: the force along the contact's normal, by width and height", &S::pressure),
      number<S>("thickness_m", "of the ice, of two floes the thinner; 0 of steel", &S::thickness),
      ContactColumn{"ended_by",
                    "of a peak what ended it: `bend`, `split`, `tilt` or `slip`; empty of a contact at a frame",
                    [](const S& s) { return static_cast<double>(s.ended_by); },
                    [](S& s, double word) { s.ended_by = static_cast<simulation::PeakEnd>(word); }, kPeakEnds}};
  return columns;
}

std::span<const PanelColumn> panel_columns() {
  using S = PanelSample;
  static const std::array columns{
      number<S>("panel", "its number from the stem, to port 0, 1, …, to starboard −1, −2, …", &S::column),
      number<S>("row", "from the bottom, 0, 1, …; −1: what acts above and below all rows", &S::row),
      number<S>("surge_N", "mean force of the ice forward", &S::load, &dynamics::Planar::surge),
      number<S>("sway_N", "mean force of the ice to port", &S::load, &dynamics::Planar::sway),
      number<S>("yaw_Nm", "mean moment of the ice counter-clockwise", &S::load, &dynamics::Planar::yaw),
      number<S>("force_N", "mean of what acts along the normals of its contacts", &S::force),
      number<S>("force_max_N", "of that, the largest step", &S::largest),
      number<S>("pressure_Pa", "`force_N` by the panel's area", &S::pressure),
      number<S>("loaded_s", "how long ice pressed on it in the interval", &S::loaded)};
  return columns;
}

void append_row(std::string& text, const ContactState& row) {
  append_values(text, row, contact_columns());
}
void append_row(std::string& text, const PanelSample& row) {
  append_values(text, row, panel_columns());
}
bool read_row(std::string_view text, ContactState& row) {
  return read_values(text, row, contact_columns());
}
bool read_row(std::string_view text, PanelSample& row) {
  return read_values(text, row, panel_columns());
}

}  // namespace polynya::io
