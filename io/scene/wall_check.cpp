#include "io/scene/wall_check.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace polynya::io {
namespace {

constexpr double kShortestWall = 0.1;  ///< [m]

/// The largest σ_c h of the floes; of the scene's ice where there are none [N/m].
double most_that_ice_bears(const simulation::Scene& scene) {
  const auto borne = [](const fracture::Ice& ice) { return ice.compressive_strength * ice.thickness; };
  if (scene.floes.empty()) return borne(scene.ice);
  double most = 0;
  for (const simulation::FloeSpec& floe : scene.floes)
    most = std::max(most, borne(simulation::ice_of(scene, floe.own_ice)));
  return most;
}

/// A load that no ice bears, and a mass that it takes beyond the closing speed in one step.
void check_load(const simulation::Scene& scene, const simulation::Wall& wall, const JsonValue& given,
                const std::string& path, ProblemCollector& problems) {
  const auto report = [&](const std::string& key, std::string found, std::string allowed) {
    problems.report(0, nearest_offset(given, "pressure." + key), path + "pressure." + key, std::move(found),
                    std::move(allowed));
  };
  if (const double most = most_that_ice_bears(scene); wall.line_load >= most)
    report("line_load_N_per_m",
           fmt::format("{:g} N/m, which crushes the strongest ice of the scene without end", wall.line_load),
           fmt::format("less than its σ_c h, {:.4g} [N/m]", most));
  const double gain = scene.time.step * wall.line_load / wall.mass_per_length;
  if (gain > wall.closing_speed)
    report("mass_kg_per_m",
           fmt::format("{:g} kg/m, which the load takes to {:.3g} m/s in one step, beyond the closing speed",
                       wall.mass_per_length, gain),
           fmt::format("at least {:.4g} [kg/m], or a shorter time.step_s",
                       scene.time.step * wall.line_load / wall.closing_speed));
}

}  // namespace

void add_wall(std::size_t index, const JsonValue& item, const WallInput& wall, SceneDraft& draft,
              ProblemCollector& problems) {
  const double length = distance(wall.from, wall.to);
  if (length < kShortestWall) {
    problems.report(0, nearest_offset(item, "to_m"), fmt::format("walls[{}].to_m", index),
                    fmt::format("({:g}, {:g}), {:.3g} m from from_m", wall.to.x, wall.to.y, length),
                    fmt::format("a face of at least {:g} m", kShortestWall));
    return;
  }
  simulation::Wall settings = wall.pressure.value_or(simulation::Wall{});
  settings.velocity = wall.velocity.value_or(geometry::Vector{});
  draft.scene.ships.push_back(simulation::wall_between(wall.from, wall.to, wall.depth, settings));
  draft.scene.ships.back().name = wall.name;
  draft.ship_origins.push_back(
      {.offset = item.offset, .group = index, .is_structure = true, .list = "walls"});
}

void check_walls(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems) {
  for (std::size_t i = 0; i < draft.scene.ships.size(); ++i) {
    const auto* wall = std::get_if<simulation::Wall>(&draft.scene.ships[i].propulsion);
    if (!wall || !wall->presses()) continue;
    const std::size_t index = draft.ship_origins[i].group;
    const JsonValue& item = given.find("walls")->items()[index];
    const std::string path = fmt::format("walls[{}].", index);
    if (const JsonValue* velocity = item.find("velocity_m_per_s"))
      problems.report(0, velocity->offset, path + "velocity_m_per_s", "a velocity of a wall with pressure",
                      "either of them: the load moves the wall");
    if (draft.scene.contact.law == simulation::ContactLaw::kImpulse)
      problems.report(0, nearest_offset(item, "pressure"), path + "pressure",
                      "a load with contact.law impulse",
                      "contact.law crush, or velocity_m_per_s: rigid impulses bear no definite load");
    check_load(draft.scene, *wall, item, path, problems);
  }
}

}  // namespace polynya::io
