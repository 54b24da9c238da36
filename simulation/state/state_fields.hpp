#pragma once

#include "dynamics/contact/broad_phase.hpp"
#include "geometry/shape/polygon.hpp"
#include "simulation/state/archive.hpp"
#include "simulation/world/world.hpp"

namespace polynya::simulation {

// The field lists of a run's state. A member that is added to a list is saved, loaded and hashed; increase
// kCheckpointVersion (io/run/checkpoint.hpp) at the same time.

/// Constraint on the motion of a floe: none, under a hull, or fast ice.
enum class Restraint : std::uint8_t { kFree, kUnderHull, kFast };

/// Returns true if a body is a ship that sails (Sailing::is_active), so that it has a helm and loads of sailing.
inline bool is_sailing(const Setup& setup, std::int32_t body) {
  return body < std::ssize(setup.sailing) && setup.sailing[body].is_active;
}

/// Returns true if a body is a ship with a mooring, which may be broken.
inline bool has_mooring(const Setup& setup, std::int32_t body) {
  return is_sailing(setup, body) && setup.scene.ships[body].mooring.has_value();
}

/// Returns true if contacts store energy and give it back, as by the law of impulses.
inline bool has_restitution(const Setup& setup) {
  return setup.scene.contact.law == ContactLaw::kImpulse;
}

/// Returns true if a body is a ship that manages ice.
inline bool manages_ice(const Setup& setup, std::int32_t body) {
  return is_sailing(setup, body) && std::holds_alternative<ManagingPilot>(setup.scene.ships[body].pilot);
}

void fields(auto& archive, Is<geometry::Point> auto& p) {
  archive(p.x, p.y);
}
void fields(auto& archive, Is<geometry::Vector> auto& v) {
  archive(v.x, v.y);
}
void fields(auto& archive, Is<geometry::Rotation> auto& r) {
  archive(r.cosine, r.sine);
}
void fields(auto& archive, Is<geometry::Polygon> auto& p) {
  archive(p.outer, p.holes);
}
/// The shape is saved separately, and only for floes that broke off.
void fields(auto& archive, Is<Floe> auto& f) {
  archive(f.parent, f.born, f.generation, f.area);
}
void fields(auto& archive, Is<TiltedFloe> auto& t) {
  archive(t.floe, t.ship, t.edge.deflection, t.edge.rate);
}
void fields(auto& archive, Is<SubmergedPiece> auto& t) {
  archive(t.floe, t.ship, t.path, t.weight, t.next_try, t.waited, t.had_deck);
}
void fields(auto& archive, Is<AcceleratingCusp> auto& c) {
  archive(c.ship, c.arm_in_ship, c.normal_in_ship, c.horizontal_in_ship, c.impulse_left, c.largest_force,
          c.distance_left);
}
void fields(auto& archive, Is<fracture::DeckStrip> auto& s) {
  archive(s.width, s.sheet, s.sheet_across, s.water);
  for (auto& side : s.sides) archive(side.facing, side.length, side.axis, side.depth);
}
/// Includes the members of the deck that follow from ice and hull.
void fields(auto& archive, Is<PressedDeck> auto& p) {
  archive(p.ship, p.arm_in_ship, p.normal_in_ship, p.horizontal_in_ship, p.deck.depth, p.deck.thickness,
          p.deck.freeboard, p.deck.hull_angle, p.state.displacement, p.state.pool);
  for (auto& strip : p.deck.strips) archive(strip);
}
void fields(auto& archive, Is<SubmergedLoads> auto& l) {
  archive(l.impulse, l.area);
}
void fields(auto& archive, Is<ContactLoads> auto& l) {
  archive(l.impulse, l.largest, l.carried[0].impulse, l.carried[0].level, l.carried[1].impulse, l.carried[1].level,
          l.carried[2].impulse, l.carried[2].level, l.friction, l.contacts);
}
/// Events in a state are contacts of two hulls only.
void fields(auto& archive, Is<Event> auto& e) {
  auto& c = std::get<HullContact>(e.what);
  archive(e.time, e.ship, c.other, e.point_in_world, c.closing_speed, c.relative_speed, c.is_prescribed);
}
void fields(auto& archive, Is<HullLoads> auto& l) {
  archive(l.ice, l.hulls, l.submerged, l.collision);
}
void fields(auto& archive, Is<dynamics::Planar> auto& p) {
  archive(p.surge, p.sway, p.yaw);
}
void fields(auto& archive, Is<SailingLoads> auto& l) {
  archive(l.water, l.engine, l.rudder, l.mooring);
}
void fields(auto& archive, Is<PilotMemory> auto& m) {
  archive(m.heading, m.speed_integral, m.drift_angle, m.waypoint, m.from, m.is_backing, m.slow_since, m.stuck_at,
          m.first_stuck_at, m.rams, m.distance_gained);
}
/// Saved only for ships that manage ice.
void fields(auto& archive, Is<PatternMemory> auto& m) {
  archive(m.upstream, m.lap_share, m.carried, m.target, m.target_at, m.next_choice);
}
void fields(auto& archive, Is<Helm> auto& h) {
  archive(h.lever, h.steering_angle, h.is_adrift, h.adrift_since, h.ice_force, h.memory);
}
void fields(auto& archive, Is<IceLedger> auto& l) {
  // The other members are computed when the ledger is read.
  archive(l.initial, l.under_ice, l.submerged, l.brash, l.rounding);
}
void fields(auto& archive, Is<Counts> auto& c) {
  archive(c.floes_initial, c.bends, c.splits, c.ground, c.tilted_under, c.went_under, c.came_up, c.stayed_under,
          c.crush_contacts, c.rejected_cuts, c.floated_cusps, c.brash_pieces, c.snap_rounded, c.database_out_of_range,
          c.unconverged_steps, c.largest_residual, c.energy_created, c.unpaired_stretches, c.peak_contacts,
          c.peak_awake);
}
void fields(auto& archive, Is<EnergyFlows> auto& e) {
  archive(e.thrust, e.current, e.drag, e.friction, e.restitution, e.crushing, e.bending, e.splitting, e.grinding,
          e.submersion, e.submerged_ice, e.rest);
}
void fields(auto& archive, Is<MomentumFlows> auto& m) {
  archive(m.thrust, m.held, m.water, m.removed);
}
void fields(auto& archive, Is<BoundaryFlows> auto& b) {
  archive(b.wind, b.walls, b.wind_impulse, b.wall_impulse);
}
void fields(auto& archive, Is<MooringFlows> auto& m) {
  archive(m.initial, m.taken_up, m.given_back, m.ground, m.damping, m.breaking, m.separation);
}
/// Leaves out `boundaries`, which only states of scenes with wind or pressing walls contain, and moorings and scales,
/// which do not influence the run and are in checkpoints only (tail_fields).
void fields(auto& archive, Is<AuditSums> auto& a) {
  archive(a.initial_energy, a.initial_momentum, a.impulses, a.energy, a.momentum);
}
void fields(auto& archive, Is<dynamics::PersistentContact> auto& r) {
  archive(r.last_point_in_b, r.first_touch_in_b, r.age, r.approach, r.crushed_depth, r.restitution.owed_impulse,
          r.restitution.given_impulse, r.restitution.limit, r.restitution.start_impulse[0],
          r.restitution.start_impulse[1], r.last_impulse[0], r.last_impulse[1], r.last_slip_impulse, r.paid_area,
          r.area, r.reach, r.has_crushed, r.is_pierced, r.is_inherited, r.was_refused, r.is_continued);
}
void fields(auto& archive, Is<geometry::Pose> auto& p) {
  archive(p.position, p.rotation);
}
void fields(auto& archive, Is<dynamics::Booked> auto& b) {
  archive(b.crushed, b.tilted, b.volume, b.work);
}
void fields(auto& archive, Is<dynamics::CrushedIce> auto& c) {
  archive(c.a_from_b, c.area);
}
/// Leaves out separation_bound, a cache that may differ between runs with the same motion. It is saved separately and
/// not hashed.
void fields(auto& archive, Is<dynamics::PairState> auto& p) {
  archive(p.a, p.b, p.records);
}

void fields(auto& archive, Is<std::pair<std::int64_t, std::int64_t>> auto& p) {
  archive(p.first, p.second);
}

/// The contact's bodies are saved as hull and floe. Its place on the waterline is left out, because it is computed when
/// the peak is recorded.
void fields(auto& archive, Is<LoadTrack> auto& t) {
  auto& s = t.at_largest;
  archive(t.id, t.is_rising, t.force, t.least, t.largest, t.time, s.on.ship, s.by.floe, s.point_in_world, s.force,
          s.depth, s.is_crushing, s.width, s.height, s.pressure, s.thickness, t.point_in_hull, t.ending);
}
void fields(auto& archive, Is<LoadPeaks> auto& p) {
  archive(p.tracks, p.tracks_so_far, p.counts.recorded, p.counts.below, p.counts.beyond, p.counts.largest_beyond);
}
void fields(auto& archive, Is<PanelLoads> auto& p) {
  archive(p.impulse, p.normal, p.largest, p.loaded, p.carried.impulse, p.carried.level, p.carried_load);
}

/// Leaves out peaks and panels, which do not influence the run. They are saved separately and not hashed (state.cpp).
void fields(auto& archive, Is<Accounts> auto& a) {
  archive(a.areas, a.audit, a.counts, a.loads, a.hull_contacts, a.refused_grinds);
}

/// Position and motion of a body. `travel` is included because caches of its neighbours depend on it. The rotation is
/// computed from the angle.
void motion_fields(auto& archive, Is<dynamics::Bodies> auto& b, BodyIndex i) {
  archive(b.position[i], b.angle[i], b.angle_rest[i], b.velocity[i], b.angular_velocity[i], b.travel[i], b.rim_speed[i],
          b.is_awake[i]);
}
/// The first part of a state.
void head_fields(auto& archive, Is<World> auto& world) {
  archive(world.clock.ticks, world.pace.finer, world.pace.bends, world.population.water_velocity, world.accounts);
  if (has_wind_or_walls(world.setup.scene)) archive(world.accounts.audit.boundaries);
}
/// Data of a hull, except for its motion.
void hull_fields(auto& archive, Is<World> auto& world, std::int32_t hull) {
  if (is_sailing(world.setup, hull)) archive(world.population.helms[hull], world.accounts.sailing[hull]);
  if (has_mooring(world.setup, hull)) archive(world.population.helms[hull].last_turn);
  if (manages_ice(world.setup, hull)) archive(world.population.helms[hull].memory.pattern);
}
/// The part of a checkpoint after the contacts, which is not hashed: the masses, which follow from the areas where all
/// ice is the same, and counts and sums that do not influence the run.
void tail_fields(auto& archive, Is<World> auto& world) {
  auto& counts = world.accounts.counts;
  archive(world.accounts.masses, counts.unresolved_splits, counts.passing_steps, counts.crowded_ticks,
          counts.steps_taken, counts.most_parts, counts.body_steps, world.accounts.sampled_at);
  auto& audit = world.accounts.audit;
  archive(audit.moorings, audit.exchanged, audit.initial_momenta);
}

}  // namespace polynya::simulation
