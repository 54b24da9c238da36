#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include <fmt/format.h>

#include "dynamics/ship/open_water.hpp"
#include "elementary/elementary.hpp"
#include "geometry/shape/angle.hpp"
#include "geometry/shape/pose.hpp"
#include "io/scene/floe_list_reader.hpp"
#include "io/scene/scene_check.hpp"
#include "simulation/ship/pattern.hpp"
#include "simulation/ship/sailing.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Vector;
using simulation::Ship;

/// Largest area of all rudders as a fraction of L T [-]. Usual are 0.02, a tenth of this.
constexpr double kLargestRudder = 0.2;
constexpr double kRudderShare = 0.018;      ///< Default area of the rudders as a fraction of L T [-].
constexpr double kGyrationOfLength = 0.25;  ///< Default radius of gyration as a fraction of the length [-].
constexpr double kLeastBlock = 0.2;         ///< Smallest block coefficient that is accepted [-].
constexpr double kShortestWall = 0.1;       ///< Shortest wall that is accepted [m].

/// Sets the waterline in house notation, and the angles of its vertices.
void set_waterline(const HullOutline& outline, simulation::Hull& hull) {
  hull.waterline = in_house_notation(geometry::Polygon{outline.waterline, {}}).outer;
  hull.angles_from_vertical = outline.angles_from_vertical;
  if (hull.waterline == outline.waterline) return;
  auto& angles = hull.angles_from_vertical;
  if (angles.size() == outline.waterline.size()) angles.resize(hull.waterline.size());
  if (hull.waterline.front() != outline.waterline.front()) std::ranges::reverse(angles);
}

/// Completes one ship.
class Completion {
 public:
  Completion(ShipInput& input, const JsonValue& given, const std::string& path, double density,
             ProblemCollector& problems)
      : input_(input), item_(given), density_(density), report_{problems, given, path} {}

  Ship run() {
    choose_water_and_speed();
    ship_ = input_.spec;
    ship_.name = input_.name;
    set_form();
    ship_.sway_speed = input_.sway_speed.value_or(0);
    ship_.yaw_rate = input_.yaw_rate.value_or(0);
    if (input_.steering) ship_.steering = *input_.steering;
    if (input_.pilot) ship_.pilot = *input_.pilot;
    std::visit([&](const auto& propulsion) { set_propulsion(propulsion); }, input_.propulsion);
    add_mass();
    if (const auto* engine = std::get_if<EngineInput>(&input_.propulsion)) add_engine(*engine);
    if (ship_.water.acts) check_hull();
    check_steering();
    if (input_.mooring) add_mooring(*input_.mooring);
    return std::move(ship_);
  }

 private:
  /// Sets defaults that depend on the propulsion: water acts on the hulls of ships with an engine, and a ship at
  /// constant speed has that speed at the start.
  void choose_water_and_speed() {
    const JsonValue* water = item_.find("water");
    if (std::holds_alternative<EngineInput>(input_.propulsion) && !(water && water->find("model")))
      input_.spec.water.acts = true;
    const auto* held = std::get_if<simulation::ConstantSpeed>(&input_.propulsion);
    if (!held) return;
    double& speed = input_.spec.speed;
    if (item_.find("speed_m_per_s") && speed != held->speed)
      report_("speed_m_per_s", show({speed}),
              fmt::format("the constant speed, {} [m/s], or nothing", show({held->speed})));
    speed = held->speed;
  }

  void set_form() {
    if (const auto* bow = std::get_if<WedgeBow>(&input_.form))
      ship_.hull.waterline = simulation::wedge_bow_waterline(bow->length, bow->beam, bow->entrance_angle);
    else
      set_waterline(std::get<HullOutline>(input_.form), ship_.hull);
  }

  void set_propulsion(const EngineInput& input) { ship_.propulsion = input.engine; }
  template <class Propulsion>
  void set_propulsion(const Propulsion& propulsion) {
    ship_.propulsion = propulsion;
  }

  dynamics::MainDimensions dimensions() const { return dimensions_of(ship_, density_); }

  void add_mass() {
    const bool has_form = ship_.hull.draught > 0 && ship_.water.block_coefficient > 0;
    const auto d = dimensions();
    if (has_form && ship_.mass == 0) ship_.mass = density_ * d.block_coefficient * d.length * d.beam * d.draught;
    if (has_form && ship_.moment_of_inertia == 0)
      ship_.moment_of_inertia = ship_.mass * elementary::pow(kGyrationOfLength * d.length, 2);
    const std::string from_form = ", or hull.draught_m and hull.block_coefficient, from which it follows";
    if (ship_.mass == 0) report_("mass_kg", "nothing", "a number ≥ 1, ≤ 1e+12 [kg]" + from_form);
    if (ship_.moment_of_inertia == 0)
      report_("moment_of_inertia_kg_m2", "nothing", "a number ≥ 0.001, ≤ 1e+16 [kg m²]" + from_form);
    input_.spec.mass = ship_.mass;
    input_.spec.moment_of_inertia = ship_.moment_of_inertia;
    for (double* missing : {&ship_.mass, &ship_.moment_of_inertia})
      // Infinite, so that the missing value causes no further messages.
      if (*missing == 0) *missing = std::numeric_limits<double>::infinity();
  }

  void add_engine(const EngineInput& input) {
    auto& engine = std::get<simulation::Engine>(ship_.propulsion);
    const std::string key = "propulsion.engine";
    const double diameter =
        input.propeller_diameter > 0 ? input.propeller_diameter : dynamics::kPropellerOfDraught * ship_.hull.draught;
    engine.propellers = input.propellers;
    engine.has_nozzles = input.has_nozzles.value_or(false);
    engine.propeller_area = input.propellers * 0.25 * std::numbers::pi * diameter * diameter;
    if (engine.bollard_pull == 0 && engine.power > 0 && input.propeller_diameter > 0)
      engine.bollard_pull = dynamics::bollard_pull(engine.power, diameter, input.propellers, engine.has_nozzles);
    if (engine.bollard_pull == 0)
      return report_(key, "neither bollard_pull_kN nor power_MW with propeller_diameter_m",
                     "bollard_pull_kN, or power_MW and propeller_diameter_m");
    if (ship_.hull.draught > 0 && dimensions().block_coefficient <= 1)
      check_speed(engine, key + ".open_water_speed_m_per_s");
  }

  /// Reports an open-water speed at which the friction of the water alone would need all thrust or power.
  void check_speed(const simulation::Engine& engine, const std::string& key) {
    const double v = engine.open_water_speed;
    const double resistance =
        0.5 * density_ * ship_.water.resistance_coefficient * wetted_surface(dimensions()) * v * v;
    const std::string at =
        fmt::format("{:g}: the water's friction on the hull there is {:.4g} kN", v, 1e-3 * resistance);
    if (resistance > engine.bollard_pull)
      return report_(key, fmt::format("{}, the bollard pull {:.4g} kN", at, 1e-3 * engine.bollard_pull),
                     "a speed that the engine can reach");
    if (engine.power > 0 && resistance * v > engine.power)
      report_(key, fmt::format("{}, which takes {:.4g} MW of {:.4g}", at, 1e-6 * resistance * v, 1e-6 * engine.power),
              "a speed that the engine can reach");
  }

  void check_hull() {
    if (ship_.hull.draught <= 0)
      return report_("hull.draught_m", "nothing, and water acts on the hull", "a draught, or water.model none");
    const auto d = dimensions();
    if (!std::isfinite(d.block_coefficient)) return;  // there is no mass, which has been reported
    if (d.block_coefficient < kLeastBlock || d.block_coefficient > 1)
      return report_("mass_kg",
                     fmt::format("{:.4g}, a block coefficient of {:.3g} for {:.4g} × {:.4g} × {:.4g} m", ship_.mass,
                                 d.block_coefficient, d.length, d.beam, d.draught),
                     fmt::format("a block coefficient of {:g} to 1", kLeastBlock));
    if (!clarke_derivatives(d).are_physical())
      report_("water.model",
              fmt::format("manoeuvring, whose regression has no meaning for a hull of {:.4g} × {:.4g} × {:.4g} m",
                          d.length, d.beam, d.draught),
              "none, or a hull of ship's proportions");
  }

  void check_steering() {
    if (std::holds_alternative<simulation::NoSteering>(ship_.steering)) return;
    if (!std::holds_alternative<simulation::Engine>(ship_.propulsion))
      return report_("steering", "a rudder or thrusters without an engine", "propulsion.engine, or no steering");
    auto* rudder = std::get_if<simulation::RudderSettings>(&ship_.steering);
    if (!rudder) return;
    const int propellers = std::get<simulation::Engine>(ship_.propulsion).propellers;
    if (rudder->count > propellers)
      return report_("steering.rudder.count", fmt::format("{}", rudder->count),
                     fmt::format("at most one for each of propulsion.engine.propellers, {}", propellers));
    const auto d = dimensions();
    const double most = kLargestRudder * d.length * d.draught;
    if (rudder->area > 0 && most > 0 && rudder->area > most)
      return report_("steering.rudder.area_m2", fmt::format("{:g}", rudder->area),
                     fmt::format("at most a fifth of length times draught, {:.4g} [m²]", most));
    if (rudder->area > 0) return;
    if (ship_.hull.draught <= 0)
      return report_("steering.rudder.area_m2", "nothing, and no hull.draught_m", "an area, or a draught");
    rudder->area = kRudderShare * d.length * d.draught;
  }

  void add_mooring(const MooringInput& input) {
    simulation::MooringSettings& mooring = ship_.mooring.emplace(input.settings);
    mooring.position_in_world = input.position.value_or(ship_.position_in_world);
    mooring.heading = input.heading.value_or(ship_.heading);
    if (std::holds_alternative<simulation::ConstantSpeed>(ship_.propulsion))
      return report_("mooring", "a mooring of a ship whose speed is prescribed", "thrust_N or an engine");
    const geometry::Vector off =
        rotate_back(geometry::Rotation::by(mooring.heading), ship_.position_in_world - mooring.position_in_world);
    const double load = elementary::hypot(mooring.surge_stiffness * off.x, mooring.sway_stiffness * off.y);
    if (mooring.break_load > 0 && load > mooring.break_load)
      report_("mooring.break_load_N",
              fmt::format("{:g}: the mooring is broken at the start, where it pulls with {:.4g} N", mooring.break_load,
                          load),
              "a greater load, or a ship nearer to mooring.position_m");
  }

  ShipInput& input_;
  const JsonValue& item_;
  const double density_;
  const ReportAt report_;
  Ship ship_;
};

double steering_most(const Ship& ship) {
  if (const auto* rudder = std::get_if<simulation::RudderSettings>(&ship.steering)) return rudder->most;
  if (const auto* azimuth = std::get_if<simulation::AzimuthSettings>(&ship.steering)) return azimuth->most;
  return 0;
}

/// Returns true if the distance of two segments is less than `nearer_than` [m].
bool are_near(Point a, Point b, Point c, Point d, double nearer_than) {
  const auto side = [](Point p, Point q, Point r) { return cross(q - p, r - p); };
  if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
  return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                   distance_to_segment(d, a, b)}) < nearer_than;
}

/// Checks the pilot of one ship.
class PilotCheck {
 public:
  PilotCheck(std::size_t ship, const JsonValue& item, SceneDraft& draft, ProblemCollector& problems)
      : index_(ship),
        ship_(draft.scene.ships[ship]),
        item_(item),
        draft_(draft),
        report_{problems, item, hull_path(draft, ship)} {}

  void run() {
    if (!item_.find("pilot")) return;
    if (!std::holds_alternative<simulation::Engine>(ship_.propulsion))
      return report_("pilot", "a pilot of a ship without an engine", "propulsion.engine, or no pilot");
    std::visit([&](auto& pilot) { check(pilot); }, ship_.pilot);
  }

 private:
  /// Returns true if the ship can be steered, as its pilot needs; reports it otherwise.
  bool has_steering(const std::string& key) {
    if (steering_most(ship_) > 0) return true;
    report_(key, "nothing to steer with", "steering.rudder or steering.azimuth");
    return false;
  }
  void check_angle(const std::string& key, double angle) {
    const double most = steering_most(ship_);
    if (std::abs(angle) <= most * (1 + 1e-9)) return;
    report_(key, fmt::format("{:.4g}°", geometry::kDegreesPerRadian * angle),
            fmt::format("at most {:.4g}° to either side", geometry::kDegreesPerRadian * most));
  }

  void check(const simulation::ConstantPilot& pilot) {
    check_angle("pilot.constant.steering_deg", pilot.steering_angle);
  }
  void check(const simulation::SpeedPilot&) {}
  void check(const simulation::HeadingPilot&) { has_steering("pilot.hold_heading"); }
  void check(const simulation::RammingPilot&) {}

  void check(const simulation::TablePilot& pilot) {
    for (std::size_t i = 0; i < pilot.rows.size(); ++i) {
      if (i > 0 && pilot.rows[i].time <= pilot.rows[i - 1].time)
        report_(fmt::format("pilot.table.rows[{}].t_s", i), fmt::format("{:g}", pilot.rows[i].time),
                fmt::format("a time after that of the row before, {:g} [s]", pilot.rows[i - 1].time));
      check_angle(fmt::format("pilot.table.rows[{}].steering_deg", i), pilot.rows[i].steering_angle);
    }
  }

  void check(const simulation::RoutePilot& pilot) {
    if (!has_steering("pilot.route") || pilot.waypoints.empty()) return;
    const Vector ahead{elementary::cos(ship_.heading), elementary::sin(ship_.heading)};
    const Vector way = pilot.waypoints.front().position_in_world - ship_.position_in_world;
    if (dot(way, ahead) <= 0)
      report_("pilot.route.waypoints[0].position_m",
              fmt::format("({:g}, {:g}), {:.4g} m behind the ship", pilot.waypoints.front().position_in_world.x,
                          pilot.waypoints.front().position_in_world.y, -dot(way, ahead)),
              "a first waypoint ahead of the ship, or another heading_deg");
    Point from = ship_.position_in_world;
    for (std::size_t i = 0; i < pilot.waypoints.size(); ++i) {
      const Point to = pilot.waypoints[i].position_in_world;
      if (const auto* structure = structure_on(from, to))
        report_(fmt::format("pilot.route.waypoints[{}].position_m", i),
                fmt::format("a leg to ({:g}, {:g}) that leads through {}", to.x, to.y, structure->name),
                "legs that stay half a beam clear of structures");
      from = to;
    }
  }

  /// Returns a structure or wall that is nearer to a leg of the route than half the beam, or null.
  const simulation::PlacedHull* structure_on(Point from, Point to) const {
    const double half_beam = 0.5 * size_of(ship_.hull).y;
    for (std::size_t k = draft_.scene.ships.size(); k < hull_count(draft_.scene); ++k) {
      const simulation::PlacedHull& hull = hull_of(draft_.scene, k);
      const geometry::Ring ring = waterline_in_world(hull).outer;
      for (std::size_t i = 0; i < ring.size(); ++i)
        if (are_near(from, to, ring[i], ring[(i + 1) % ring.size()], half_beam)) return &hull;
    }
    return nullptr;
  }

  void check(simulation::FollowingPilot& pilot) {
    const int leader = hull_named(draft_.scene, pilot.ship);
    pilot.leader = std::max(leader, 0);
    if (!has_steering("pilot.follow")) return;
    const std::string key = "pilot.follow.ship";
    const std::string found = fmt::format("\"{}\"", pilot.ship);
    if (leader < 0 || leader >= std::ssize(draft_.scene.ships))
      return report_(key, found + (leader < 0 ? ", the name of no ship" : ", which is no ship"),
                     "the name of another ship");
    if (leader == static_cast<int>(index_))
      return report_(key, found + ": a ship cannot follow itself", "the name of another ship");
    if (follows_back(pilot))
      report_(key, found + ", which follows this ship", "a ship that follows no ship of the same line");
  }

  void check(simulation::ManagingPilot& pilot) {
    const int body = hull_named(draft_.scene, pilot.body);
    pilot.body_index = std::max(body, 0);
    if (!has_steering("pilot.manage")) return;
    const bool is_there =
        body >= 0 && kind_of_hull(draft_.scene, static_cast<std::size_t>(body)) != simulation::BodyKind::kWall;
    if (!is_there || body == static_cast<int>(index_))
      return report_("pilot.manage.body", fmt::format("\"{}\"", pilot.body), "the name of another ship or a structure");
    if (pilot.speed > 0 && pilot.lever != 1) report_("pilot.manage.lever", "a lever, and a speed", "one of the two");
    complete_depth(pilot);
    check_place(pilot);
    find_partners(pilot);
  }

  static void complete_depth(simulation::ManagingPilot& pilot) {
    using Pattern = simulation::ManagementPattern;
    if (pilot.depth > 0) return;
    if (pilot.pattern == Pattern::kCircular || pilot.pattern == Pattern::kLargestFloe) pilot.depth = pilot.width;
    if (pilot.pattern == Pattern::kRacetrack) pilot.depth = 0.25 * pilot.width;
  }

  double safety_radius(const simulation::ManagingPilot& pilot, std::size_t other) const {
    if (pilot.safety_radius > 0) return pilot.safety_radius;
    return size_of(ship_.hull).x + size_of(hull_of(draft_.scene, other).hull).x;
  }

  /// Checks that the pattern has a valid form and does not touch the protected body.
  void check_place(const simulation::ManagingPilot& pilot) {
    using Pattern = simulation::ManagementPattern;
    if (pilot.pattern == Pattern::kRacetrack && pilot.depth > pilot.width)
      return report_("pilot.manage.depth_m", fmt::format("{:g}", pilot.depth),
                     fmt::format("at most the racetrack's width, {:g} [m]", pilot.width));
    if (pilot.pattern == Pattern::kSector && pilot.width > std::numbers::pi * pilot.distance)
      return report_(
          "pilot.manage.width_m", fmt::format("{:g}", pilot.width),
          fmt::format("at most half a circle about the body, {:.4g} [m]", std::numbers::pi * pilot.distance));
    // The pilot steers to a point on the pattern 1.5 ship lengths ahead. On a line much shorter than a ship length the
    // ship would go round in circles forever, and a line without length has no direction.
    const double length = size_of(ship_.hull).x;
    if (pilot.pattern != Pattern::kLargestFloe && !(line_of(pilot).lap() >= length))
      return report_("pilot.manage.width_m",
                     fmt::format("{:g}: once round the pattern is {:.4g} m", pilot.width, line_of(pilot).lap()),
                     fmt::format("a pattern that is at least as long as the ship, {:g} m", length));
    const double nearest = pilot.distance - 0.5 * pilot.depth;
    const double least = safety_radius(pilot, static_cast<std::size_t>(pilot.body_index));
    if (nearest < least)
      report_("pilot.manage.distance_m",
              fmt::format("{:g}: the pattern comes to {:.4g} m from {}", pilot.distance, nearest, pilot.body),
              fmt::format("a pattern that stays outside the safety radius, {:.4g} m", least));
  }

  /// Finds the ships that manage on the same line. They keep their distances on it; reports those that would meet.
  void find_partners(simulation::ManagingPilot& pilot) {
    if (pilot.pattern == simulation::ManagementPattern::kLargestFloe) return;
    const auto key = [](const simulation::ManagingPilot& p) {
      return std::tuple(p.body, p.pattern, p.distance, p.width, p.drifts_with_ice);
    };
    const auto& ships = draft_.scene.ships;
    const simulation::PatternLine line = line_of(pilot);
    for (std::size_t i = 0; i < ships.size(); ++i) {
      const auto* other = std::get_if<simulation::ManagingPilot>(&ships[i].pilot);
      if (!other || i == index_ || key(*other) != key(pilot)) continue;
      pilot.partners.push_back({static_cast<int>(i), other->phase});
      const double least = safety_radius(pilot, i);
      const double ahead = other->phase - pilot.phase - std::floor(other->phase - pilot.phase);
      if (const double nearest = least_distance(line, ahead); nearest < least)
        report_("pilot.manage.phase",
                fmt::format("{:g}: on their pattern it comes to {:.4g} m from {}", pilot.phase, nearest, ships[i].name),
                fmt::format("phases, or a depth_m, that leave the safety radius between them, {:.4g} m", least));
    }
  }

  /// Returns true if the ship is followed, directly or through others, by the ship that it follows.
  bool follows_back(const simulation::FollowingPilot& pilot) const {
    const auto& ships = draft_.scene.ships;
    std::string_view name = pilot.ship;
    for (std::size_t i = 0; i < ships.size(); ++i) {
      const auto leader = std::ranges::find(ships, name, &Ship::name);
      if (leader == ships.end()) return false;
      if (static_cast<std::size_t>(leader - ships.begin()) == index_) return true;
      const auto* next = std::get_if<simulation::FollowingPilot>(&leader->pilot);
      if (!next) return false;
      name = next->ship;
    }
    return false;
  }

  const std::size_t index_;
  Ship& ship_;
  const JsonValue& item_;
  SceneDraft& draft_;
  const ReportAt report_;
};

}  // namespace

simulation::Ship complete_ship(ShipInput& input, const JsonValue& given, const std::string& path, double density,
                               ProblemCollector& problems) {
  return Completion(input, given, path, density, problems).run();
}

simulation::Structure complete_structure(const StructureInput& input) {
  simulation::Structure structure = input.spec;
  structure.name = input.name;
  if (const auto* cylinder = std::get_if<Cylinder>(&input.form))
    structure.hull.waterline = simulation::cylinder_waterline(cylinder->radius);
  else
    set_waterline(std::get<HullOutline>(input.form), structure.hull);
  structure.hull.angles_from_vertical.assign(structure.hull.waterline.size(), input.slope);
  return structure;
}

std::optional<simulation::Wall> complete_wall(const WallInput& input, const JsonValue& given, const std::string& path,
                                              ProblemCollector& problems) {
  simulation::Wall wall = simulation::wall_between(input.from, input.to, input.depth);
  if (wall.length < kShortestWall) {
    ReportAt{problems, given, path}(
        "to_m", fmt::format("({:g}, {:g}), {:.3g} m from from_m", input.to.x, input.to.y, wall.length),
        fmt::format("a face of at least {:g} m", kShortestWall));
    return std::nullopt;
  }
  wall.name = input.name;
  wall.velocity = input.velocity.value_or(geometry::Vector{});
  wall.pressure = input.pressure;
  return wall;
}

void complete_pilots(const JsonValue& given, SceneDraft& draft, ProblemCollector& problems) {
  for (std::size_t i = 0; i < draft.scene.ships.size(); ++i)
    PilotCheck(i, given.find("ships")->items()[draft.hull_origins[i].group], draft, problems).run();
}

}  // namespace polynya::io
