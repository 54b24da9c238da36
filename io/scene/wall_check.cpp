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
void check_load(const SceneDraft& draft, std::size_t wall, const JsonValue& pressure,
                ProblemCollector& problems) {
  const auto number = [&](std::string_view key) { return pressure.find(key, JsonValue::Kind::kNumber); };
  const JsonValue* load = number("line_load_N_per_m");
  const JsonValue* mass = number("mass_kg_per_m");
  const JsonValue* speed = number("closing_speed_m_per_s");
  if (!load || !mass || !speed) return;
  const std::string path = fmt::format("walls[{}].pressure.", wall);
  if (const double most = most_that_ice_bears(draft.scene); load->number() >= most)
    problems.report(
        0, load->offset, path + "line_load_N_per_m",
        fmt::format("{:g} N/m, which crushes the strongest ice of the scene without end", load->number()),
        fmt::format("less than its σ_c h, {:.4g} [N/m]", most));
  const double gain = draft.scene.time.step * load->number() / mass->number();
  if (gain > speed->number())
    problems.report(
        0, mass->offset, path + "mass_kg_per_m",
        fmt::format("{:g} kg/m, which the load takes to {:.3g} m/s in one step, beyond the closing speed",
                    mass->number(), gain),
        fmt::format("at least {:.4g} [kg/m], or a shorter time.step_s",
                    draft.scene.time.step * load->number() / speed->number()));
}

}  // namespace

void add_wall(std::size_t index, const JsonValue& item, SceneDraft& draft, ProblemCollector& problems) {
  const WallDraft& wall = draft.wall;
  const double length = distance(wall.from, wall.to);
  if (length < kShortestWall) {
    const JsonValue* to = item.find("to_m");
    problems.report(0, to ? to->offset : item.offset, fmt::format("walls[{}].to_m", index),
                    fmt::format("({:g}, {:g}), {:.3g} m from from_m", wall.to.x, wall.to.y, length),
                    fmt::format("a face of at least {:g} m", kShortestWall));
    return;
  }
  draft.scene.ships.push_back(simulation::wall_between(wall.from, wall.to, wall.depth, wall.wall));
  draft.ship().name = wall.name;
  draft.ship_origins.push_back(
      {.offset = item.offset, .group = index, .is_structure = true, .list = "walls"});
}

void check_walls(const SceneDraft& draft, const JsonValue& resolved, ProblemCollector& problems) {
  const auto* walls = resolved.find("walls", JsonValue::Kind::kArray);
  if (!walls) return;
  for (std::size_t i = 0; i < walls->items().size(); ++i) {
    const JsonValue* pressure = walls->items()[i].find("pressure", JsonValue::Kind::kObject);
    if (!pressure) continue;
    const std::string path = fmt::format("walls[{}].", i);
    if (const JsonValue* velocity = walls->items()[i].find("velocity_m_per_s"))
      problems.report(0, velocity->offset, path + "velocity_m_per_s", "a velocity of a wall with pressure",
                      "either of them: the load moves the wall");
    if (draft.scene.contact.law == simulation::ContactLaw::kImpulse)
      problems.report(0, pressure->offset, path + "pressure", "a load with contact.law impulse",
                      "contact.law crush, or velocity_m_per_s: rigid impulses bear no definite load");
    check_load(draft, i, *pressure, problems);
  }
}

void choose_skin_drag(const JsonValue& root, JsonValue& resolved) {
  const JsonValue* given = root.find("water");
  const JsonValue* wind = resolved.find("wind", JsonValue::Kind::kObject);
  const JsonValue* velocity = wind ? wind->find("velocity_m_per_s", JsonValue::Kind::kArray) : nullptr;
  if (!velocity || (given && given->find("skin_drag_coefficient"))) return;
  if (velocity->items()[0].number() == 0 && velocity->items()[1].number() == 0) return;
  JsonValue* water = resolved.find("water");
  if (JsonValue* skin = water ? water->find("skin_drag_coefficient") : nullptr) skin->data = kSkinDragInWind;
}

}  // namespace polynya::io
