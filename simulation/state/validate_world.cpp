#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "simulation/state/state.hpp"
#include "simulation/world/parts.hpp"

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

constexpr std::int64_t kMostSteps = 1'000'000'000;  // 58 days of the default step; a larger number means damage
constexpr std::int64_t kMostCounted = std::int64_t{1} << 60;  // two such counts can still be added

bool is_count(std::int64_t count) {
  return count >= 0 && count <= kMostCounted;
}

Defect check_accounts(const World& world) {
  const Counts& c = world.accounts.counts;
  for (const std::int64_t count : {c.floes_initial,
                                   c.bends,
                                   c.splits,
                                   c.ground,
                                   c.crush_contacts,
                                   c.rejected_cuts,
                                   c.floated_cusps,
                                   c.tilted_under,
                                   c.went_under,
                                   c.came_up,
                                   c.stayed_under,
                                   c.brash_pieces,
                                   c.snap_rounded,
                                   c.database_out_of_range,
                                   c.unconverged_steps,
                                   c.unpaired_stretches,
                                   c.peak_contacts,
                                   c.peak_awake,
                                   c.steps_taken,
                                   c.most_parts,
                                   c.body_steps,
                                   c.passing_steps,
                                   c.unresolved_splits,
                                   c.crowded_ticks})
    if (!is_count(count)) return fmt::format("a count of {}", count);
  if (c.largest_residual < 0 || c.energy_created < 0) return "a negative residual";
  if (world.clock.ticks < 0 || world.clock.ticks > kMostSteps) return fmt::format("{} ticks", world.clock.ticks);
  if (world.accounts.sampled_at < 0 || world.accounts.sampled_at > world.clock.ticks)
    return "a sample of a time to come";
  const auto [finer, bends] = world.pace;
  if (finer < 1 || finer > kMostParts || !std::has_single_bit(static_cast<unsigned>(finer)) ||
      !(bends >= 0 && bends <= static_cast<double>(kMostCounted)))
    return fmt::format("a pace of {} parts and {} bends", finer, bends);
  return {};
}

Defect check_loads(const LoadPeaks& peaks) {
  std::int64_t last = 0;
  for (const LoadTrack& track : peaks.tracks) {
    const ContactState& s = track.at_largest;
    if (track.id <= last || track.id > peaks.tracks_so_far) return fmt::format("load {} out of its order", track.id);
    if (std::min({track.least, track.largest, s.width, s.height, s.pressure, s.thickness}) < 0)
      return fmt::format("load {} is negative", track.id);
    last = track.id;
  }
  for (const std::int64_t count : {peaks.tracks_so_far, peaks.counts.recorded, peaks.counts.below, peaks.counts.beyond})
    if (!is_count(count)) return fmt::format("a count of {} peaks", count);
  return {};
}

Defect check_cusps(const Population& population) {
  for (const AcceleratingCusp& cusp : population.accelerating_cusps)
    if (!(cusp.impulse_left > 0 && cusp.largest_force > 0 && cusp.distance_left > 0))
      return "a cusp that no hull presses";
  constexpr double kLongestCusp = 1e4;  // largest depth of a cusp; a larger value means damage [m]
  for (const PressedDeck& pressed : population.decks) {
    const fracture::Deck& deck = pressed.deck;
    if (!(deck.depth > 0 && deck.depth < kLongestCusp && deck.thickness > 0 && deck.freeboard >= 0))
      return "a deck of no size";
    if (!(deck.hull_angle > 0 && deck.hull_angle < std::numbers::pi / 2)) return "a deck under a hull of no slope";
    if (!(pressed.state.displacement >= 0 && pressed.state.displacement < distance_to_lie_along(deck) &&
          pressed.state.pool >= 0))
      return "a deck that has turned too far";
    for (const fracture::DeckStrip& s : deck.strips) {
      if (std::min({s.width, s.sheet, s.sheet_across, s.water}) < 0) return "a deck of negative width";
      for (const fracture::DeckSide& side : s.sides)
        if (side.length < 0 || side.depth < 0) return "a deck with a side of negative length";
    }
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

Defect check_overlaps(const dynamics::PairState& pair) {
  for (const dynamics::PersistentContact& record : pair.records) {
    if (record.stored_energy < 0) return fmt::format("a negative energy in the contact of {} and {}", pair.a, pair.b);
    const geometry::Rotation r = record.crushed.a_from_b.rotation;
    const geometry::Point at = record.crushed.a_from_b.position;
    if (record.crushed.area < 0 || std::min({record.booked.crushed, record.booked.tilted, record.booked.volume}) < 0)
      return fmt::format("a negative overlap of {} and {}", pair.a, pair.b);
    if (!(std::max(std::abs(at.x), std::abs(at.y)) <= 1e9 &&
          std::abs(r.cosine * r.cosine + r.sine * r.sine - 1) < 1e-6))
      return fmt::format("crushed ice of {} and {} beyond the world", pair.a, pair.b);
  }
  return {};
}

Defect check_pairs(const Population& population) {
  const dynamics::Bodies& b = population.bodies;
  for (const dynamics::PairState& pair : population.pairs.pair_states()) {
    if (auto defect = check_overlaps(pair)) return defect;
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
  std::vector<bool> is_submerged(population.floes.size());
  for (const SubmergedPiece& submerged : population.submerged) {
    if (is_submerged[static_cast<std::size_t>(submerged.floe)])
      return fmt::format("floe {} is under two hulls", submerged.floe);
    is_submerged[static_cast<std::size_t>(submerged.floe)] = true;
    if (submerged.weight < 0 || submerged.waited < 0)
      return fmt::format("floe {} has a negative weight or wait", submerged.floe);
    if (!population.is_alive(submerged.floe) || !population.floes[submerged.floe].is_under)
      return fmt::format("floe {} is submerged and not under a hull", submerged.floe);
  }
  std::pair<int, FloeId> last{-1, kNoFloe};
  for (const TiltedFloe& tilted : population.tilted) {
    if (tilted.edge.deflection < 0) return fmt::format("floe {} has its edge above the water", tilted.floe);
    if (last >= std::pair(tilted.ship, tilted.floe))
      return fmt::format("floe {} is tilted out of its order", tilted.floe);
    last = {tilted.ship, tilted.floe};
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
  if (auto defect = check_accounts(world)) return defect;
  if (auto defect = check_loads(world.accounts.load_peaks)) return defect;
  if (auto defect = check_cusps(population)) return defect;
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
