#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "simulation/state/state.hpp"

namespace polynya::simulation {
namespace {

using Defect = std::optional<std::string>;

Defect check_columns(const World& world) {
  const dynamics::Bodies& b = world.population.bodies;
  const auto count = static_cast<std::size_t>(world.population.hull_count) + world.population.floes.size();
  const auto size_of = [](const auto&... columns) { return std::array{columns.size()...}; };
  const auto sizes =
      size_of(b.position, b.angle, b.angle_rest, b.rotation, b.velocity, b.angular_velocity, b.inverse_mass,
              b.inverse_moment, b.travel, b.bounding_radius, b.rim_speed, b.drag_span, b.is_awake, b.is_alive, b.mass,
              b.moment, b.centroid, b.thickness, b.kind, b.boundary, b.drag);
  const auto is_count = [&](std::size_t size) { return size == count; };
  if (!std::ranges::all_of(sizes, is_count)) return fmt::format("a column of bodies is not {} long", count);
  if (world.accounts.loads.size() != hull_count(world.setup.scene)) return "loads of other ships than there are";
  return {};
}

Defect check_helms(const World& world) {
  const std::size_t ships = world.setup.scene.ships.size();
  if (world.population.helms.size() != ships || world.accounts.sailing.size() != ships)
    return "helms of other ships than there are";
  for (std::size_t i = 0; i < ships; ++i) {
    const Helm& helm = world.population.helms[i];
    if (!(std::abs(helm.lever) <= 1)) return fmt::format("ship {} has its lever beyond full", i);
    if (!(std::abs(helm.steering_angle) <= world.setup.sailing[i].steering_most))
      return fmt::format("ship {} has its rudder beyond the stop", i);
    if (!(helm.memory.pattern.lap_share < 1)) return fmt::format("ship {} is beyond its lap", i);
    if (helm.memory.waypoint < 0) return fmt::format("ship {} goes to no waypoint", i);
    if (helm.is_adrift && !world.setup.scene.ships[i].mooring)
      return fmt::format("ship {} is adrift and was not moored", i);
  }
  return {};
}

Defect check_awake(const Population& population) {
  std::size_t awake = 0;
  for (BodyIndex i = 0; i < population.bodies.size(); ++i) awake += population.bodies.is_awake[i] != 0 ? 1 : 0;
  if (awake != population.awake.size())
    return fmt::format("{} bodies are awake, {} are listed", awake, population.awake.size());
  for (std::size_t k = 0; k < population.awake.size(); ++k) {
    const BodyIndex i = population.awake[k];
    if (i < 0 || i >= population.bodies.size() || population.bodies.is_awake[i] == 0)
      return fmt::format("body {} is listed awake and is not", i);
    if (k > 0 && population.awake[k - 1] >= i) return fmt::format("body {} is listed out of its order", i);
  }
  return {};
}

Defect check_motion(const Population& population, const Setup& setup, BodyIndex i) {
  const dynamics::Bodies& b = population.bodies;
  const geometry::Rotation r = b.rotation[i];
  const double sum = b.position[i].x + b.position[i].y + b.angle[i] + b.velocity[i].x + b.velocity[i].y +
                     b.angular_velocity[i] + b.travel[i];
  if (!std::isfinite(sum)) return fmt::format("body {} is not finite", i);
  const auto by_angle = geometry::Rotation::by(b.angle[i]);
  if (r.cosine != by_angle.cosine || r.sine != by_angle.sine)
    return fmt::format("body {} has a rotation that is not by its angle", i);
  if (b.boundary[i] == nullptr) return fmt::format("body {} has no boundary", i);
  if (b.is_awake[i] == 0 && rim_speed_of(b, i) >= kRestSpeed && setup.shortcuts.sleeps)
    return fmt::format("body {} moves asleep", i);
  return {};
}

Defect check_floe(const Population& population, const Setup& setup, FloeId id) {
  const Floe& floe = population.floes[id];
  const BodyIndex body = population.body_of(id);
  const dynamics::Bodies& b = population.bodies;
  const bool is_of_scene = floe.parent == kNoFloe;
  if (!is_of_scene && (floe.parent < 0 || floe.parent >= id))
    return fmt::format("floe {} is older than its parent", id);
  if (!is_of_scene && population.is_alive(floe.parent))
    return fmt::format("floe {} has a parent that has not broken", id);
  if (floe.generation != (is_of_scene ? 0 : population.floes[floe.parent].generation + 1))
    return fmt::format("floe {} has the generation {}", id, floe.generation);
  if (!population.is_alive(id)) {
    const bool is_gone = b.boundary[body] == nullptr && b.is_awake[body] == 0 && floe.shape.polygon.outer.empty();
    return is_gone ? Defect{} : fmt::format("floe {} broke and is still there", id);
  }
  if (b.is_awake[body] != 0 && b.drag[body] == nullptr) return fmt::format("floe {} is awake without drag", id);
  const geometry::Measures measures = geometry::measure(floe.shape.polygon);
  const fracture::Ice& ice = ice_of_floe(setup, population, id);
  const double mass = ice.density * ice.thickness * measures.area;
  if (b.thickness[body] != ice.thickness) return fmt::format("floe {} has another thickness than its ice", id);
  if (measures.area != floe.area || !(floe.area > 0)) return fmt::format("floe {} has another area than its shape", id);
  if (b.mass[body] != mass || (!population.is_fast(id) && b.inverse_mass[body] != 1 / mass) ||
      b.centroid[body] != measures.centroid)
    return fmt::format("floe {} has another mass than its shape", id);
  return {};
}

Defect check_pairs(const Population& population) {
  const dynamics::Bodies& b = population.bodies;
  for (const dynamics::PairState& pair : population.pairs.pair_states()) {
    if (b.is_alive[pair.a] == 0 || b.is_alive[pair.b] == 0)
      return fmt::format("a pair of {} and {}, one broken", pair.a, pair.b);
    if (b.is_awake[pair.a] == 0 && b.is_awake[pair.b] == 0)
      return fmt::format("a pair of {} and {}, both asleep", pair.a, pair.b);
  }
  return {};
}

Defect check_sums(const World& world) {
  const Population& population = world.population;
  std::int64_t broken = 0;
  std::size_t under = 0;
  for (FloeId id = 0; id < population.floe_count(); ++id) {
    broken += population.is_alive(id) ? 0 : 1;
    under += population.floes[id].is_under ? 1 : 0;
  }
  if (under != population.submerged.size())
    return fmt::format("{} floes are under hulls, {} are listed", under, population.submerged.size());
  for (const SubmergedPiece& submerged : population.submerged) {
    if (!population.is_alive(submerged.floe) || !population.floes[submerged.floe].is_under)
      return fmt::format("floe {} is submerged and not under a hull", submerged.floe);
  }
  for (const TiltedFloe& tilted : population.tilted) {
    if (!population.is_floating(tilted.floe)) return fmt::format("floe {} is tilted and does not float", tilted.floe);
  }
  for (const auto& [ledger, unit] : {std::pair(area_ledger(world), "m²"), std::pair(mass_ledger(world), "kg")})
    if (!ledger.is_closed()) return fmt::format("{} {} of ice too much", ledger.imbalance(), unit);
  const Counts& counts = world.accounts.counts;
  const std::int64_t fractures = counts.bends + counts.splits + counts.ground + counts.came_up + counts.stayed_under;
  if (broken != fractures) return fmt::format("{} floes broke in {} fractures", broken, fractures);
  return {};
}

}  // namespace

std::optional<std::string> validate_world(const World& world) {
  const Population& population = world.population;
  if (auto defect = check_columns(world)) return defect;
  if (auto defect = check_helms(world)) return defect;
  if (auto defect = check_awake(population)) return defect;
  if (auto defect = check_sums(world)) return defect;
  if (auto defect = check_pairs(population)) return defect;
  for (BodyIndex i = 0; i < population.bodies.size(); ++i) {
    if (population.bodies.is_alive[i] == 0) continue;
    if (auto defect = check_motion(population, world.setup, i)) return defect;
  }
  for (FloeId id = 0; id < population.floe_count(); ++id) {
    if (auto defect = check_floe(population, world.setup, id)) return defect;
  }
  return {};
}

}  // namespace polynya::simulation
