#include "io/run/records.hpp"

#include <array>
#include <cassert>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "geometry/cut/cut.hpp"
#include "geometry/shape/angle.hpp"
#include "io/import/floe_properties.hpp"
#include "io/run/run_folder.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/shape_parts.hpp"

namespace polynya::io {

namespace {

using S = simulation::HullSample;
using dynamics::Planar;
using geometry::Point;
using geometry::Vector;
using enum Over;
using enum ShownWhere;

/// Returns true if older runs do not have the loads of this kind.
constexpr bool is_of_newer_runs(ShownWhere where) {
  return where != kAlways && where != kWhereItSplits;
}

/// Words for one of the three directions of loads on a ship.
struct Axis {
  std::string_view key, suffix, unit, title, noun, direction;
  double Planar::*component;
};
constexpr Axis kSurge{"surge", "_N", "N", "Surge force", "force", "forward", &Planar::surge};
constexpr Axis kSway{"sway", "_N", "N", "Sway force", "force", "to port", &Planar::sway};
constexpr Axis kYaw{"yaw", "_Nm", "N·m", "Yaw moment", "moment", "counter-clockwise", &Planar::yaw};

std::string name_of(const Axis& axis, std::string_view stem) {
  return fmt::format("{}{}{}", axis.key, stem, axis.suffix);
}

/// A load that has three columns, for surge, sway and yaw.
struct Load {
  std::string_view stem;  ///< part of the name: "_from_water" gives surge_from_water_N and so on
  Planar S::*place;
  Over over = kMean;
  /// Words for it: "of the water" gives "force of the water forward" and "Surge force of the water".
  std::string_view source;
  ShownWhere where = kAlways;
  std::string_view source_in_titles = {};  ///< shorter words for titles; empty: the same
  std::string_view curve = "mean";
  std::vector<Axis> axes = {kSurge, kSway, kYaw};
};

/// Places of the peak and of the plot of a number, and the title of the plot.
struct Shown {
  std::optional<ShownWhere> peak = {};
  std::optional<ShownWhere> plotted = {};
  std::string plot = {};
};

/// Converts a number of a file to an integer type. Throws ReadError if the number is not a value of that type.
template <class Whole>
Whole whole_of(double value) {
  if (value < std::numeric_limits<Whole>::min() || value > std::numeric_limits<Whole>::max() ||
      value != std::floor(value))
    throw ReadError(fmt::format("{} is not {}", value, std::is_same_v<Whole, bool> ? "0 or 1" : "a whole number"));
  return static_cast<Whole>(value);
}

/// Returns a column for the number at the end of a path of pointers to members. Angles in radians are written in
/// degrees.
template <class Row, class... Path>
Column<Row> number(std::string name, std::string meaning, Path... path) {
  const bool is_turn = name.find("_deg") != std::string::npos;
  const double scale = is_turn ? geometry::kDegreesPerRadian : 1;
  const double inverse = is_turn ? geometry::kRadiansPerDegree : 1;
  return {std::move(name), std::move(meaning),
          [=](const Row& row) { return scale * static_cast<double>((row.*....*path)); },
          [=](Row& row, double value) {
            auto& place = (row.*....*path);
            using Kind = std::remove_reference_t<decltype(place)>;
            if constexpr (std::is_integral_v<Kind>)
              place = whole_of<Kind>(value);
            else
              place = static_cast<Kind>(inverse * value);
          }};
}

struct Table {
  std::vector<ForceColumn> columns = {};

  template <class... Path>
  ForceColumn& add(std::string name, std::string_view unit, Over over, std::string meaning, const Shown& shown,
                   Path... path) {
    const auto where = shown.plotted ? shown.plotted : shown.peak;
    return columns.emplace_back(ForceColumn{number<S>(std::move(name), std::move(meaning), path...), unit, over,
                                            shown.peak, shown.plotted, shown.plot, "mean",
                                            where && is_of_newer_runs(*where)});
  }
  void load(const Load& l) {
    const std::string_view source = l.source_in_titles.empty() ? l.source : l.source_in_titles;
    for (const Axis& axis : l.axes)
      add(name_of(axis, l.stem), axis.unit, l.over, fmt::format("{} {} {}", axis.noun, l.source, axis.direction),
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
  t.add("ice_under_hull_m2", "m²", kAtEnd, "ice under the hull", {kUnderHulls, {}, "Ice under the hull"},
        &S::submerged_area);
  t.load({"_j_over_tau_c", &S::collision, kLargestStep, "of the ice by the paper, j/τ_c,", kWhereItSplits, "of the ice",
          "paper"});
}

void add_motion(Table& t) {
  t.add("x_m", "m", kAtEnd, "centre of gravity, over ground", {}, &S::position_in_world, &Point::x);
  t.add("y_m", "m", kAtEnd, "centre of gravity, over ground", {}, &S::position_in_world, &Point::y);
  t.add("heading_deg", "°", kAtEnd, "heading from the x axis, counter-clockwise", {}, &S::heading);
  t.columns.push_back({{"speed_m_per_s", "speed over ground", [](const S& s) { return length(s.velocity_in_world); },
                        [](S&, double) {}},  // not stored: it follows from the velocity
                       "m/s",
                       kAtEnd,
                       kAlways,
                       {},
                       "Speed over ground"});
  t.add("vx_m_per_s", "m/s", kAtEnd, "velocity over ground", {}, &S::velocity_in_world, &Vector::x);
  t.add("vy_m_per_s", "m/s", kAtEnd, "velocity over ground", {}, &S::velocity_in_world, &Vector::y);
  t.add("yaw_rate_deg_per_s", "°/s", kAtEnd, "yaw rate, counter-clockwise", {}, &S::yaw_rate);
}

void add_sailing_loads(Table& t) {
  t.add("thrust_N", "N", kMean, "thrust along the heading; for a ship at constant speed the force that keeps the speed",
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
  t.add("lever", "", kAtEnd, "thrust lever as a fraction of the power, from −1 (full astern) to 1 (full ahead)",
        {{}, kWithEngines, "Thrust lever"}, &S::lever);
  t.add("steering_deg", "°", kAtEnd, "angle of rudder or thrusters, positive to port",
        {{}, kWithEngines, "Steering angle"}, &S::steering_angle);
  t.add("delivered_power_W", "W", kAtEnd, "power of the engine at that lever; 0 if the scene gives no power",
        {{}, kWithEngines, "Delivered power"}, &S::delivered_power);
  t.add("rams", "", kAtEnd, "number of charges after the first, for a ramming pilot", {{}, kRamming, "Rams"}, &S::rams);
  t.add("gained_m", "m", kAtEnd, "distance gained by ramming, from the place at which the ship was stuck first",
        {{}, kRamming, "Gained by ramming"}, &S::distance_gained);
  t.add("contacts", "", kAtEnd, "number of contacts with ice", {{}, {}, "Contacts at the hull"}, &S::contacts);
  t.add("contacts_with_ships", "", kAtEnd, "number of contacts with other ships and structures", {},
        &S::contacts_with_ships)
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

constexpr std::pair<Axis, std::string_view> kDirections[]{
    {kSurge, "Surge force by cause"}, {kSway, "Sway force by cause"}, {kYaw, "Yaw moment by cause"}};

/// A cause of forces, and its column in each direction.
struct Cause {
  std::string_view cause, words;
  std::string_view stem;  ///< part of the names of its columns: "_from_water"
};
constexpr Cause kIce{"ice", "ice on the hull, with friction", ""};
constexpr Cause kFriction{"friction", "ice: friction", "_from_ice_friction"};
constexpr Cause kThrust{"thrust", "thrust", "thrust_N"};  // a single column, because it has only a surge component
constexpr Cause kCauses[]{kIce,
                          kFriction,
                          {"submerged", "ice under the hull", "_from_submerged_ice"},
                          {"water", "water on the hull", "_from_water"},
                          kThrust,
                          {"thrust", "thrusters", "_from_thrusters"},
                          {"rudder", "rudder", "_from_rudder"},
                          {"mooring", "mooring", "_from_mooring"},
                          {"ships", "other ships", "_from_ships"}};

/// Returns the column of a cause in a direction; null if the cause has no force in that direction.
const ForceColumn* column_of(const Cause& cause, const Axis& axis) {
  if (cause.stem != kThrust.stem) return find_column(name_of(axis, cause.stem));
  return axis.component == kSurge.component ? find_column(cause.stem) : nullptr;
}

std::vector<ForceCause> all_causes() {
  std::vector<ForceCause> causes;
  for (const auto& [axis, direction] : kDirections) {
    for (const Cause& cause : kCauses) {
      const ForceColumn* column = column_of(cause, axis);
      if (!column) continue;
      ForceCause& added = causes.emplace_back(ForceCause{direction, cause.cause, cause.words, column->name});
      if (cause.cause == kFriction.cause) added.share_of = column_of(kIce, axis)->name;
      if (cause.cause == kIce.cause) added.without_shares = "ice: crushing and pushing";
    }
  }
  return causes;
}

}  // namespace

std::span<const ForceCause> force_causes() {
  static const std::vector<ForceCause> causes = all_causes();
  return causes;
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

}  // namespace

std::span<const ContactColumn> contact_columns() {
  using S = ContactState;
  static const std::array columns{
      number<S>(
          "x_m",
          "position of the force over ground at the start of the step: the centre of pressure of the contact line",
          &S::point_in_world, &geometry::Point::x),
      number<S>("y_m", "the same, y component", &S::point_in_world, &geometry::Point::y),
      number<S>("fx_N",
                "force on the first body by the second, in axes over ground: momentum transferred in the step / "
                "duration of the step",
                &S::force, &geometry::Vector::x),
      number<S>("fy_N", "the same, y component", &S::force, &geometry::Vector::y),
      number<S>("depth_m", "penetration depth of the overlap along the contact's normal", &S::depth),
      number<S>("is_crushing", "1 if the contact pressed with the full force that crushing ice can carry, otherwise 0",
                &S::is_crushing),
      number<S>("arc_m",
                "distance of that position from the stem of `ship` along the waterline, positive to port, negative to "
                "starboard; empty on a floe",
                &S::arc),
      number<S>("station_m", "distance of that position aft of the stem; empty on a floe", &S::station),
      number<S>("width_m", "length of the contact line", &S::width),
      number<S>("height_m",
                "height of the ice that presses: its thickness, or at an inclined hull the height of its crushed part",
                &S::height),
      number<S>("pressure_Pa", "nominal pressure: force along the contact's normal / (width × height)", &S::pressure),
      number<S>("thickness_m", "thickness of the ice, of two floes the thinner one; 0 for contacts of steel",
                &S::thickness),
      ContactColumn{"ended_by",
                    "for a peak, the reason why the contact ended: `bend`, `split`, `tilt` or `slip`; empty for a "
                    "contact at a frame",
                    [](const S& s) { return static_cast<double>(s.ended_by); },
                    [](S& s, double word) { s.ended_by = static_cast<simulation::PeakEnd>(word); }, kPeakEnds}};
  return columns;
}

std::span<const PanelColumn> panel_columns() {
  using S = PanelSample;
  static const std::array columns{
      number<S>("panel", "number of the panel from the stem: 0, 1, … to port, −1, −2, … to starboard", &S::column),
      number<S>("row", "number of the row from the bottom: 0, 1, …; −1: loads above and below all rows", &S::row),
      number<S>("surge_N", "mean force of the ice forward", &S::load, &dynamics::Planar::surge),
      number<S>("sway_N", "mean force of the ice to port", &S::load, &dynamics::Planar::sway),
      number<S>("yaw_Nm", "mean moment of the ice counter-clockwise", &S::load, &dynamics::Planar::yaw),
      number<S>("force_N", "mean of the forces along the normals of the panel's contacts", &S::force),
      number<S>("force_max_N", "largest value of that force in one step", &S::largest),
      number<S>("pressure_Pa", "`force_N` / area of the panel", &S::pressure),
      number<S>("loaded_s", "time for which ice pressed on the panel in the interval", &S::loaded)};
  return columns;
}

std::span<const CrushedColumn> crushed_columns() {
  using S = simulation::CrushedOverlap;
  static const std::array columns{number<S>("crushed_m2", "", &S::area), number<S>("tilted_m2", "", &S::tilted),
                                  number<S>("crushed_m3", "", &S::volume), number<S>("crushing_J", "", &S::work),
                                  number<S>("unpaid_m2", "", &S::unpaid)};
  return columns;
}

double value_of(std::string_view field, std::span<const std::string_view> words) {
  const auto word = std::ranges::find(words, field);
  if (word != words.end()) return static_cast<double>(word - words.begin());
  if (words.empty() && field.empty()) return ContactState::kNowhere;
  const auto number = words.empty() ? csv_number(field) : std::nullopt;
  if (!number)
    throw ReadError(fmt::format("\"{}\" is not {}", field, words.empty() ? "a number" : "a word of its column"));
  return *number;
}

std::string_view hull_name(const simulation::Scene& scene, int ship) {
  const auto hull = static_cast<std::size_t>(ship);
  return ship < 0 || hull >= hull_count(scene) ? std::string_view{} : hull_of(scene, hull).name;
}

namespace {

/// Appends the beginning of a row about two bodies: the time, and for each body the name of the ship or the number of
/// the floe.
void append_bodies(std::string& text, double time, const simulation::ContactState::Body& on,
                   const simulation::ContactState::Body& by, const simulation::Scene& scene) {
  append_number(text, time);
  for (const simulation::ContactState::Body& body : {on, by}) {
    text.append(1, ',').append(hull_name(scene, body.ship)) += ',';
    if (body.floe != simulation::kNoFloe) append_number(text, body.floe);
  }
}

}  // namespace

std::string header_of(std::string_view file) {
  const auto table = [](std::string first, const auto& columns) {
    for (const auto& column : columns) first.append(1, ',').append(column.name);
    return first + '\n';
  };
  constexpr auto kBodies = "t_s,ship,floe_id,by_ship,by_floe_id";
  if (file == run_file::kForces) return table("t_s,ship", force_columns());
  if (file == run_file::kPanels) return table("t_s,ship", panel_columns());
  if (file == run_file::kContacts) return table(kBodies, contact_columns());
  if (file == run_file::kCrushed) return table(kBodies, crushed_columns());
  if (file == run_file::kFrames) return FrameEncoder::header();
  return file == run_file::kStates ? "t_s,steps,state_hash\n" : "";
}

void append_forces_row(std::string& text, const simulation::HullSample& sample, const simulation::Scene& scene) {
  append_number(text, sample.time);
  text.append(1, ',').append(hull_name(scene, sample.ship));
  append_row(text, sample, force_columns(), "null");
}

void append_contact(std::string& text, double time, const simulation::ContactState& contact,
                    const simulation::Scene& scene) {
  append_bodies(text, time, contact.on, contact.by, scene);
  append_row(text, contact, contact_columns());
}

void append_panel(std::string& text, const simulation::PanelSample& sample, const simulation::Scene& scene) {
  append_number(text, sample.time);
  text.append(1, ',').append(hull_name(scene, sample.hull));
  append_row(text, sample, panel_columns());
}

void append_crushed(std::string& text, double time, const simulation::CrushedOverlap& overlap,
                    const simulation::Scene& scene) {
  append_bodies(text, time, overlap.on, overlap.by, scene);
  append_row(text, overlap, crushed_columns(), "null");
}

void append_state(std::string& text, double time, std::int64_t steps, std::uint64_t hash) {
  append_number(text, time);
  text += fmt::format(",{},{:016x}\n", steps, hash);
}

void append_birth(std::string& text, const simulation::Birth& birth, const geometry::Polygon* parent,
                  const simulation::Scene* scene) {
  JsonWriter json(text);
  json.open('{').key("floe_id").value(birth.floe).key("parent_id").value(id_or_none(birth.parent));
  if (scene && birth.floe < std::ssize(scene->floes)) {
    const std::int64_t source = scene->floes[static_cast<std::size_t>(birth.floe)].source_floe;
    if (source >= 0) json.key("source_floe_id").value(source);
  }
  json.key("born_s").value(birth.time).key("generation").value(birth.generation);
  json.key("area_m2").value(birth.area).key("mass_kg").value(birth.mass);
  if (scene && birth.own_ice != simulation::kSceneIce) append_ice(json, ice_of(*scene, birth.own_ice));
  json.key("centroid_m").value(birth.centroid_in_body);
  append_shape(json, parent ? parts_of(birth.polygon_in_body, *parent) : whole(birth.polygon_in_body));
  json.close('}');
  text += '\n';
}

std::string to_geojson(const std::vector<simulation::FloeState>& floes, double time,
                       const std::optional<simulation::GeographicOrigin>& origin) {
  GeojsonLayer layer(time, place_members(origin));
  for (const simulation::FloeState& floe : floes) append_floe(layer, floe);
  return layer.finish();
}

void append_floe(GeojsonLayer& layer, const simulation::FloeState& floe) {
  JsonWriter& json = layer.start();
  json.key("floe_id").value(floe.floe).key("parent_id").value(id_or_none(floe.parent));
  json.key("born_s").value(floe.born).key("generation").value(floe.generation);
  json.key("area_m2").value(floe.area).key("mass_kg").value(floe.mass);
  append_ice(json, *floe.ice);
  json.key("speed_m_per_s").value(geometry::length(floe.velocity));
  json.key("vx_m_per_s").value(floe.velocity.x).key("vy_m_per_s").value(floe.velocity.y);
  json.key("angular_velocity_deg_per_s").value(geometry::kDegreesPerRadian * floe.angular_velocity);
  if (floe.is_fast) json.key("fast_ice").value(true);
  if (!floe.under_hull_of.empty())
    json.key("under_hull_of").value(floe.under_hull_of).key("under_hull_path_m").value(floe.under_path);
  // Far from the origin two corners of a cut may be rounded to the same point, which a scene that continues the run
  // would refuse.
  layer.end_with(normalised(transform(floe.world_from_body, *floe.polygon_in_body)));
}

using simulation::FloeId;

namespace {

double number_at(const JsonValue& value, std::string_view key) {
  return json_member(value, key, JsonValue::Kind::kNumber).number();
}
double take_number(std::string_view& row) {
  const std::string_view field = csv_field(row);
  const auto value = csv_number(field);
  if (!value) throw ReadError(fmt::format("\"{}\" is not a number", shortened(field, 60)));
  return *value;
}

/// Removes the time [s] from the start of a row and returns it.
double take_time(std::string_view& row) {
  const double time = take_number(row);
  if (std::isnan(time)) throw ReadError("a row without its time");
  return time;
}

/// Removes the name of a hull from the start of a row and returns the index of the hull.
int take_hull(std::string_view& row, const simulation::Scene& scene) {
  const std::string_view name = csv_field(row);
  const int hull = hull_named(scene, name);
  if (hull < 0) throw ReadError(fmt::format("\"{}\" is no ship, structure or wall of the scene", shortened(name, 60)));
  return hull;
}

simulation::ContactState::Body body_of(std::string_view& line, const Run& run) {
  const bool is_floe = line.starts_with(',');
  simulation::ContactState::Body body{-1, simulation::kNoFloe};
  if (is_floe)
    line.remove_prefix(1);
  else
    body.ship = take_hull(line, run.scene.scene);
  const std::string_view floe = csv_field(line);
  if (!is_floe && floe.empty()) return body;
  const auto number = is_floe ? csv_number(floe) : std::nullopt;
  if (!number || !(*number >= 0 && *number < static_cast<double>(run.floes.size())))
    throw ReadError(fmt::format("\"{}\" is no floe of the run", shortened(floe, 60)));
  body.floe = static_cast<FloeId>(*number);
  return body;
}

}  // namespace

JsonValue json_of(std::string_view text) {
  JsonDocument document = parse_json(text);
  if (!document.faults.empty()) throw ReadError("not JSON: " + message_of(document.faults.front()));
  return std::move(document.root);
}

FloeId floe_id(const JsonValue& value) {
  if (value.is_null()) return simulation::kNoFloe;
  if (!value.is(JsonValue::Kind::kNumber) || !(value.number() >= 0 && value.number() < 1e9))
    throw ReadError("not a floe's id");
  return static_cast<FloeId>(value.number());
}

simulation::BirthRecord birth_of(const JsonValue& line) {
  simulation::BirthRecord birth;
  birth.floe = floe_id(json_member(line, "floe_id"));
  birth.parent = floe_id(json_member(line, "parent_id"));
  birth.time = number_at(line, "born_s");
  birth.generation = static_cast<int>(number_at(line, "generation"));
  birth.area = number_at(line, "area_m2");
  birth.mass = number_at(line, "mass_kg");
  birth.centroid_in_body = point_of(json_member(line, "centroid_m"));
  return birth;
}

simulation::HullSample sample_of(std::string_view line, const std::vector<const ForceColumn*>& columns,
                                 const simulation::Scene& scene) {
  simulation::HullSample s;
  s.time = take_time(line);
  s.ship = take_hull(line, scene);
  for (const ForceColumn* column : columns) column->store(s, take_number(line));
  return s;
}

namespace {

/// Reads a row about two bodies at an instant.
template <class Record, class Row>
Record record_of(std::string_view line, const Run& run, Row Record::*row, std::span<const Column<Row>> columns) {
  Record record;
  record.time = take_time(line);
  (record.*row).on = body_of(line, run);
  (record.*row).by = body_of(line, run);
  read_row(line, record.*row, columns);
  return record;
}

}  // namespace

RunCrushed crushed_of(std::string_view line, const Run& run) {
  return record_of(line, run, &RunCrushed::overlap, crushed_columns());
}

RunContact contact_of(std::string_view line, const Run& run) {
  return record_of(line, run, &RunContact::state, contact_columns());
}

simulation::PanelSample panel_of(std::string_view line, const simulation::Scene& scene) {
  simulation::PanelSample sample;
  sample.time = take_time(line);
  sample.hull = take_hull(line, scene);
  read_row(line, sample, panel_columns());
  return sample;
}

void check_state(std::string_view line) {
  constexpr std::size_t kHashDigits = 16;
  take_time(line);
  take_number(line);
  if (line.size() != kHashDigits || line.find_first_not_of("0123456789abcdef") != std::string_view::npos)
    throw ReadError(fmt::format("\"{}\" is not a hash", shortened(line, 60)));
}

}  // namespace polynya::io
