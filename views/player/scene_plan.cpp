#include <charconv>

#include "io/text/json_writer.hpp"
#include "views/player/player_page.hpp"

namespace polynya::views {
namespace {

using geometry::Point;

/// Returns the index in the path of a problem if the path belongs to that list: 2 for "ships[2].speed" and "ships".
/// Otherwise returns nullopt.
std::optional<std::size_t> index_in(std::string_view path, std::string_view list) {
  if (!path.starts_with(list) || path.substr(list.size()).substr(0, 1) != "[") return {};
  std::size_t index = 0;
  const char* const digits = path.data() + list.size() + 1;
  if (std::from_chars(digits, path.data() + path.size(), index).ec != std::errc()) return {};
  return index;
}

/// Returns the position of the ship, structure or wall to which a problem belongs [m]. Returns nullopt for all other
/// problems, also those of ice, because an entry may have many floes. Hulls are numbered in the order of ships,
/// structures and walls (hull_of()); `before` counts those of the lists before.
std::optional<Point> place_of(const io::Problem& problem, const simulation::Scene& scene) {
  std::size_t before = 0;
  for (const auto& [list, count] : {std::pair{"ships", scene.ships.size()},
                                    {"structures", scene.structures.size()},
                                    {"walls", scene.walls.size()}}) {
    const auto index = index_in(problem.path, list);
    if (index && *index < count) return hull_of(scene, before + *index).position_in_world;
    before += count;
  }
  return {};
}

/// Writes the routes of the ships that follow one: the ship's position at the start and the waypoints [m], and the
/// speed on the leg to each waypoint [m/s], so there is one speed less than points.
void write_routes(io::JsonWriter& json, const simulation::Scene& scene) {
  json.key("routes").open('[');
  for (const simulation::Ship& ship : scene.ships) {
    const auto* route = std::get_if<simulation::RoutePilot>(&ship.pilot);
    if (!route) continue;
    json.open('{').key("points_m").open('[').value(ship.position_in_world);
    for (const simulation::Waypoint& waypoint : route->waypoints) json.value(waypoint.position_in_world);
    json.close(']').key("speeds_m_per_s").open('[');
    for (const simulation::Waypoint& waypoint : route->waypoints) json.value(waypoint.speed);
    json.close(']').close('}');
  }
  json.close(']');
}

}  // namespace

// The page draws the routes and the wind at the start of the scene; a wind that changes later is not shown. The vector
// `wind_m_per_s` is the velocity of the air over ground. The page lists the warnings and hints that were found while
// reading the scene, and marks on the map those with a position (plan.js). There are no errors among them, because a
// scene with errors is not loaded. `words` is the message of a problem without its place in the file, which `line` (0
// if it is not known) and `path` give. With `--watch` the page reloads itself when the newest stamp, in the script
// `stamp_file`, differs from its own `stamp`. Without `--watch`, `stamp_file` is empty and the page stays as it is.
std::string scene_plan(const io::LoadedScene& scene, const std::string& stamp, const std::string& stamp_file) {
  std::string text;
  io::JsonWriter json(text);
  json.open('{').key("plan").open('{').key("stamp").value(stamp).key("stamp_file").value(stamp_file);
  const geometry::Vector wind = scene.scene.wind.velocity_at(0);
  json.key("wind_m_per_s").value(Point{wind.x, wind.y});
  write_routes(json, scene.scene);
  json.key("problems").objects(scene.hints, [&](const io::Problem& problem) {
    json.key("severity").value(name_of(problem.severity)).key("path").value(problem.path);
    json.key("words").value(message_of(problem)).key("line").value(problem.line);
    if (const auto place = place_of(problem, scene.scene)) json.key("point_m").value(*place);
  });
  json.close('}').close('}');
  return text;
}

}  // namespace polynya::views
