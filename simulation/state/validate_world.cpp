#include "simulation/state/validate_world.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"

namespace polynya::simulation {
namespace {

using Wrong = std::optional<std::string>;

constexpr double kAreaTolerance = 1e-9;  ///< of sums of doubles, relative to the ice at the start

Wrong check_columns(const World& world) {
  const dynamics::Bodies& b = world.bodies;
  const auto count = static_cast<std::size_t>(world.ship_count()) + world.floes.size();
  const std::size_t sizes[] = {b.position.size(),
                               b.angle.size(),
                               b.rotation.size(),
                               b.velocity.size(),
                               b.angular_velocity.size(),
                               b.inverse_mass.size(),
                               b.inverse_moment.size(),
                               b.travel.size(),
                               b.bounding_radius.size(),
                               b.rim_speed.size(),
                               b.is_awake.size(),
                               b.is_alive.size(),
                               b.mass.size(),
                               b.moment.size(),
                               b.centroid.size(),
                               b.thickness.size(),
                               b.boundary.size(),
                               b.drag.size()};
  const auto is_count = [&](std::size_t size) { return size == count; };
  if (!std::ranges::all_of(sizes, is_count)) return fmt::format("a column of bodies is not {} long", count);
  if (world.loads.size() != world.scene.ships.size()) return "loads of other ships than there are";
  return {};
}

Wrong check_awake(const World& world) {
  std::size_t awake = 0;
  for (BodyIndex i = 0; i < world.bodies.size(); ++i) awake += world.bodies.is_awake[i] != 0 ? 1 : 0;
  if (awake != world.awake.size())
    return fmt::format("{} bodies are awake, {} are listed", awake, world.awake.size());
  for (std::size_t k = 0; k < world.awake.size(); ++k) {
    const BodyIndex i = world.awake[k];
    if (i < 0 || i >= world.bodies.size() || world.bodies.is_awake[i] == 0)
      return fmt::format("body {} is listed awake and is not", i);
    if (k > 0 && world.awake[k - 1] >= i) return fmt::format("body {} is listed out of its order", i);
  }
  return {};
}

Wrong check_motion(const World& world, BodyIndex i) {
  const dynamics::Bodies& b = world.bodies;
  const geometry::Rotation r = b.rotation[i];
  const double sum = b.position[i].x + b.position[i].y + b.angle[i] + b.velocity[i].x + b.velocity[i].y +
                     b.angular_velocity[i] + b.travel[i];
  if (!std::isfinite(sum)) return fmt::format("body {} is not finite", i);
  if (std::abs(r.cosine * r.cosine + r.sine * r.sine - 1) > 1e-9)
    return fmt::format("body {} has a rotation that is none", i);
  if (b.boundary[i] == nullptr) return fmt::format("body {} has no boundary", i);
  const double rim_speed = length(b.velocity[i]) + std::abs(b.angular_velocity[i]) * b.bounding_radius[i];
  if (b.is_awake[i] == 0 && rim_speed >= kRestSpeed && world.shortcuts.sleeps)
    return fmt::format("body {} moves asleep", i);
  return {};
}

Wrong check_floe(const World& world, FloeId id) {
  const Floe& floe = world.floes[id];
  const BodyIndex body = world.body_of(id);
  const dynamics::Bodies& b = world.bodies;
  const bool is_of_scene = floe.parent == kNoFloe;
  if (!is_of_scene && (floe.parent < 0 || floe.parent >= id))
    return fmt::format("floe {} is older than its parent", id);
  if (!is_of_scene && world.is_alive(floe.parent)) return fmt::format("floe {} has a parent that lives", id);
  if (floe.generation != (is_of_scene ? 0 : world.floes[floe.parent].generation + 1))
    return fmt::format("floe {} has the generation {}", id, floe.generation);
  if (!world.is_alive(id)) {
    const bool is_gone =
        b.boundary[body] == nullptr && b.is_awake[body] == 0 && floe.shape.polygon.outer.empty();
    return is_gone ? Wrong{} : fmt::format("floe {} broke and is still there", id);
  }
  if (b.is_awake[body] != 0 && b.drag[body] == nullptr)
    return fmt::format("floe {} is awake without drag", id);
  const geometry::Measures measures = geometry::measure(floe.shape.polygon);
  const double mass = world.scene.ice.density * world.scene.ice.thickness * measures.area;
  if (measures.area != floe.area || !(floe.area > 0))
    return fmt::format("floe {} has another area than its shape", id);
  if (b.mass[body] != mass || b.inverse_mass[body] != 1 / mass || b.centroid[body] != measures.centroid)
    return fmt::format("floe {} has another mass than its shape", id);
  return {};
}

Wrong check_pairs(const World& world) {
  const dynamics::Bodies& b = world.bodies;
  for (const dynamics::PairMemory& pair : world.pairs.memory()) {
    if (b.is_alive[pair.a] == 0 || b.is_alive[pair.b] == 0)
      return fmt::format("a pair of {} and {}, one dead", pair.a, pair.b);
    if (b.is_awake[pair.a] == 0 && b.is_awake[pair.b] == 0)
      return fmt::format("a pair of {} and {}, both asleep", pair.a, pair.b);
  }
  return {};
}

Wrong check_sums(const World& world) {
  double area = 0;
  std::int64_t dead = 0;
  for (FloeId id = 0; id < static_cast<FloeId>(world.floes.size()); ++id) {
    if (world.is_alive(id)) area += world.floes[id].area;
    dead += world.is_alive(id) ? 0 : 1;
  }
  const AreaLedger& ledger = world.ledger;
  const double lost =
      area + ledger.submerged_area + ledger.brash_area - ledger.rounding_defect - ledger.initial_ice_area;
  if (!(std::abs(lost) <= kAreaTolerance * ledger.initial_ice_area))
    return fmt::format("{} m² of ice too much", lost);
  if (dead != world.counts.bends + world.counts.splits)
    return fmt::format("{} floes broke in {} fractures", dead, world.counts.bends + world.counts.splits);
  return {};
}

}  // namespace

std::optional<std::string> validate_world(const World& world) {
  for (const auto check : {check_columns, check_awake, check_sums, check_pairs}) {
    if (auto wrong = check(world)) return wrong;
  }
  for (BodyIndex i = 0; i < world.bodies.size(); ++i) {
    if (world.bodies.is_alive[i] == 0) continue;
    if (auto wrong = check_motion(world, i)) return wrong;
  }
  for (FloeId id = 0; id < static_cast<FloeId>(world.floes.size()); ++id) {
    if (auto wrong = check_floe(world, id)) return wrong;
  }
  return {};
}

}  // namespace polynya::simulation
