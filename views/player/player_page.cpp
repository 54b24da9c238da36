#include "views/player/player_page.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include "io/text/encoding.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"

namespace polynya::views {

using geometry::Point;

namespace {

/// JSON as it may stand in a script element: no "<" that could end it or start a comment.
std::string in_script(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

/// What is put in for a mark of a template.
struct Filling {
  std::string_view mark;
  std::string text;
};

/// A template with what its marks stand for, in the order in which they stand in it.
std::string filled(std::string_view page, const std::vector<Filling>& fillings) {
  std::string text;
  for (const auto& [mark, filling] : fillings) {
    const std::size_t at = page.find(mark);
    text += page.substr(0, at);
    text += filling;
    page.remove_prefix(at + mark.size());
  }
  text += page;
  return text;
}

/// The names of the two runs, and the times that both have on their axes [s].
std::string pair_info(const std::array<ShownRun, 2>& runs) {
  std::string text;
  io::JsonWriter json(text);
  const auto& [first, second] = runs;
  json.open('{').key("labels").list(std::array{first.label, second.label});
  json.key("axis_s").list(
      std::array{std::min(first.data.start, second.data.start), std::max(first.data.end, second.data.end)});
  json.close('}');
  return text;
}

std::string as_json(std::string_view words) {
  std::string text;
  io::JsonWriter json(text);
  json.value(words);
  return text;
}

}  // namespace

std::string player_page(const io::Run& run, const PlayerData& data, const std::string& options) {
  return filled(kPlayerTemplate, {{"{{title}}", io::escaped(shown_name(run.scene.scene))},
                                  {"{{options}}", in_script(options)},
                                  {"{{info}}", in_script(data.info)},
                                  {"{{columns}}", io::to_base64(data.columns.bytes())}});
}

std::string pair_page(const std::array<ShownRun, 2>& runs) {
  const auto& [first, second] = runs;
  return filled(kPairTemplate, {{"{{title}}", io::escaped(first.label + " and " + second.label)},
                                {"{{pair}}", in_script(pair_info(runs))},
                                {"{{player}}", in_script(as_json(kPlayerTemplate))},
                                {"{{info}}", in_script(first.data.info)},
                                {"{{columns}}", io::to_base64(first.data.columns.bytes())},
                                {"{{info}}", in_script(second.data.info)},
                                {"{{columns}}", io::to_base64(second.data.columns.bytes())}});
}

namespace {

/// The index in "ships[2].speed", where the path is of that list.
std::optional<std::size_t> index_in(std::string_view path, std::string_view list) {
  if (!path.starts_with(list) || path.substr(list.size()).substr(0, 1) != "[") return {};
  std::size_t index = 0;
  const char* const digits = path.data() + list.size() + 1;
  if (std::from_chars(digits, path.data() + path.size(), index).ec != std::errc()) return {};
  return index;
}

/// Where the body is that a problem is of; none of ice, whose entries may be many floes.
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

std::string scene_plan(const io::LoadedScene& scene, const std::string& stamp, const std::string& stamp_file) {
  std::string text;
  io::JsonWriter json(text);
  json.open('{').key("plan").open('{').key("stamp").value(stamp).key("stamp_file").value(stamp_file);
  const geometry::Vector wind = scene.scene.wind.velocity_at(0);
  json.key("wind_m_per_s").value(Point{wind.x, wind.y});
  write_routes(json, scene.scene);
  json.key("problems").open('[');
  for (const io::Problem& problem : scene.hints) {
    json.open('{').key("severity").value(name_of(problem.severity)).key("path").value(problem.path);
    json.key("words").value(message_of(problem)).key("line").value(problem.line);
    if (const auto place = place_of(problem, scene.scene)) json.key("point_m").value(*place);
    json.close('}');
  }
  json.close(']').close('}').close('}');
  return text;
}

}  // namespace polynya::views
