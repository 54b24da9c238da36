#include "io/scene/pilot_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "geometry/shape/pose.hpp"
#include "io/scene/scene_check.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Vector;
using simulation::ShipSpec;

constexpr double kDegrees = 180 / std::numbers::pi;

double steering_most(const ShipSpec& ship) {
  if (const auto* rudder = std::get_if<simulation::RudderSettings>(&ship.steering)) return rudder->most;
  if (const auto* azimuth = std::get_if<simulation::AzimuthSettings>(&ship.steering)) return azimuth->most;
  return 0;
}

/// Whether two segments come nearer than that.
bool are_near(Point a, Point b, Point c, Point d, double nearer_than) {
  const auto side = [](Point p, Point q, Point r) { return cross(q - p, r - p); };
  if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
  return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                   distance_to_segment(d, a, b)}) < nearer_than;
}

/// The pilot of one ship while it is checked.
class PilotCheck {
 public:
  PilotCheck(std::size_t ship, const JsonValue& item, SceneDraft& draft, ProblemCollector& problems)
      : index_(ship), ship_(draft.scene.ships[ship]), item_(item), draft_(draft), problems_(problems) {}

  void run() {
    if (!item_.find("pilot")) return;
    if (!std::holds_alternative<simulation::Engine>(ship_.propulsion))
      return report("pilot", "a pilot of a ship without an engine", "propulsion.engine, or no pilot");
    std::visit([&](auto& pilot) { check(pilot); }, ship_.pilot);
  }

 private:
  void report(const std::string& key, std::string found, std::string allowed) {
    problems_.report(0, nearest_offset(item_, key), fmt::format("{}.{}", ship_path(draft_, index_), key),
                     std::move(found), std::move(allowed));
  }

  /// Whether the ship can be steered, which the pilot needs.
  bool has_steering(const std::string& key) {
    if (steering_most(ship_) > 0) return true;
    report(key, "nothing to steer with", "steering.rudder or steering.azimuth");
    return false;
  }
  void check_angle(const std::string& key, double angle) {
    const double most = steering_most(ship_);
    if (std::abs(angle) <= most * (1 + 1e-9)) return;
    report(key, fmt::format("{:.4g}°", kDegrees * angle),
           fmt::format("at most {:.4g}° to either side", kDegrees * most));
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
        report(fmt::format("pilot.table.rows[{}].t_s", i), fmt::format("{:g}", pilot.rows[i].time),
               fmt::format("a time after that of the row before, {:g} [s]", pilot.rows[i - 1].time));
      check_angle(fmt::format("pilot.table.rows[{}].steering_deg", i), pilot.rows[i].steering_angle);
    }
  }

  void check(const simulation::RoutePilot& pilot) {
    if (!has_steering("pilot.route") || pilot.waypoints.empty()) return;
    const Vector ahead{std::cos(ship_.heading), std::sin(ship_.heading)};
    const Vector way = pilot.waypoints.front().position_in_world - ship_.position_in_world;
    if (dot(way, ahead) <= 0)
      report(
          "pilot.route.waypoints[0].position_m",
          fmt::format("({:g}, {:g}), {:.4g} m behind the ship", pilot.waypoints.front().position_in_world.x,
                      pilot.waypoints.front().position_in_world.y, -dot(way, ahead)),
          "a first waypoint ahead of the ship, or another heading_deg");
    Point from = ship_.position_in_world;
    for (std::size_t i = 0; i < pilot.waypoints.size(); ++i) {
      const Point to = pilot.waypoints[i].position_in_world;
      if (const ShipSpec* structure = structure_on(from, to))
        report(fmt::format("pilot.route.waypoints[{}].position_m", i),
               fmt::format("a leg to ({:g}, {:g}) that leads through {}", to.x, to.y, structure->name),
               "legs that stay half a beam clear of structures");
      from = to;
    }
  }

  /// A structure nearer to a leg than half the beam.
  const ShipSpec* structure_on(Point from, Point to) const {
    const geometry::Box box = bounding_box(ship_.hull.waterline);
    const double half_beam = 0.5 * (box.high.y - box.low.y);
    for (std::size_t k = 0; k < draft_.scene.ships.size(); ++k) {
      if (!draft_.ship_origins[k].is_structure) continue;
      const geometry::Ring ring = waterline_in_world(draft_.scene.ships[k]).outer;
      for (std::size_t i = 0; i < ring.size(); ++i)
        if (are_near(from, to, ring[i], ring[(i + 1) % ring.size()], half_beam))
          return &draft_.scene.ships[k];
    }
    return nullptr;
  }

  void check(simulation::FollowingPilot& pilot) {
    const auto& ships = draft_.scene.ships;
    const auto leader = std::ranges::find(ships, pilot.ship, &ShipSpec::name);
    pilot.leader = leader == ships.end() ? 0 : static_cast<int>(leader - ships.begin());
    if (!has_steering("pilot.follow")) return;
    const std::string key = "pilot.follow.ship";
    const std::string found = fmt::format("\"{}\"", pilot.ship);
    if (leader == ships.end() || is_grounded(*leader))
      return report(key, found + (leader == ships.end() ? ", the name of no ship" : ", which is no ship"),
                    "the name of another ship");
    if (pilot.leader == static_cast<int>(index_))
      return report(key, found + ": a ship cannot follow itself", "the name of another ship");
    if (follows_back(pilot))
      report(key, found + ", which follows this ship", "a ship that follows no ship of the same line");
  }

  /// Whether the leaders of leaders lead back to this ship.
  bool follows_back(const simulation::FollowingPilot& pilot) const {
    const auto& ships = draft_.scene.ships;
    std::string_view name = pilot.ship;
    for (std::size_t i = 0; i < ships.size(); ++i) {
      const auto leader = std::ranges::find(ships, name, &ShipSpec::name);
      if (leader == ships.end()) return false;
      if (static_cast<std::size_t>(leader - ships.begin()) == index_) return true;
      const auto* next = std::get_if<simulation::FollowingPilot>(&leader->pilot);
      if (!next) return false;
      name = next->ship;
    }
    return false;
  }

  const std::size_t index_;
  ShipSpec& ship_;
  const JsonValue& item_;
  SceneDraft& draft_;
  ProblemCollector& problems_;
};

}  // namespace

void complete_pilots(const JsonValue& given, SceneDraft& draft, ProblemCollector& problems) {
  for (std::size_t i = 0; i < draft.scene.ships.size(); ++i) {
    if (!draft.ship_origins[i].is_structure)
      PilotCheck(i, given.find("ships")->items()[draft.ship_origins[i].group], draft, problems).run();
  }
}

}  // namespace polynya::io
