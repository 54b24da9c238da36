#pragma once

#include "dynamics/contact/broad_phase.hpp"
#include "geometry/shape/polygon.hpp"
#include "simulation/state/archive.hpp"
#include "simulation/world/world.hpp"

namespace polynya::simulation {

// What a run's state is made of, member by member. A member that is added here is kept, read back and hashed;
// raise kCheckpointVersion (io/run/checkpoint.hpp) with it.

/// What holds a floe, if anything.
enum class Restraint : std::uint8_t { kFree, kUnderHull, kFast };

/// Whether a body is a ship that has a helm and loads of its own.
inline bool is_sailing(const Setup& setup, std::int32_t body) {
  return body < std::ssize(setup.sailing) && setup.sailing[body].is_active;
}

/// Whether a body is a ship with a mooring, which may have broken.
inline bool has_mooring(const Setup& setup, std::int32_t body) {
  return is_sailing(setup, body) && setup.scene.ships[body].mooring.has_value();
}

/// Whether contacts store energy that they give back, by the law of impulses.
inline bool has_restitution(const Setup& setup) {
  return setup.scene.contact.law == ContactLaw::kImpulse;
}

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
/// Without its shape.
void fields(auto& archive, Is<Floe> auto& f) {
  archive(f.parent, f.born, f.generation, f.area);
}
void fields(auto& archive, Is<TiltedFloe> auto& t) {
  archive(t.floe, t.ship, t.edge.deflection, t.edge.rate);
}
void fields(auto& archive, Is<SubmergedPiece> auto& t) {
  archive(t.floe, t.ship, t.path, t.weight, t.next_try, t.waited);
}
void fields(auto& archive, Is<StartedCusp> auto& c) {
  archive(c.ship, c.arm_in_ship, c.normal_in_ship, c.horizontal_in_ship, c.left, c.most, c.way);
}
void fields(auto& archive, Is<fracture::DeckStrip> auto& s) {
  archive(s.width, s.sheet, s.sheet_across, s.water);
  for (auto& side : s.sides) archive(side.facing, side.length, side.axis, side.depth);
}
/// Of a deck; what follows from its ice and its hull as well.
void fields(auto& archive, Is<PressedDeck> auto& p) {
  archive(p.ship, p.arm_in_ship, p.normal_in_ship, p.horizontal_in_ship, p.deck.depth, p.deck.thickness,
          p.deck.freeboard, p.deck.hull_angle, p.state.way, p.state.pool);
  for (auto& strip : p.deck.strips) archive(strip);
}
void fields(auto& archive, Is<SubmergedLoads> auto& l) {
  archive(l.impulse, l.area);
}
void fields(auto& archive, Is<ContactLoads> auto& l) {
  archive(l.impulse, l.largest, l.carried[0].impulse, l.carried[0].level, l.carried[1].impulse, l.carried[1].level,
          l.carried[2].impulse, l.carried[2].level, l.friction, l.contacts);
}
/// Of the contact of two ships.
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
/// Of ships that manage ice alone.
void fields(auto& archive, Is<PatternMemory> auto& m) {
  archive(m.upstream, m.lap_share, m.carried, m.target, m.target_at, m.next_choice);
}
void fields(auto& archive, Is<Helm> auto& h) {
  archive(h.lever, h.steering_angle, h.is_adrift, h.adrift_since, h.ice_force, h.memory);
}
void fields(auto& archive, Is<IceLedger> auto& l) {
  archive(l.initial, l.under_ice, l.submerged, l.brash, l.rounding);  // the rest is derived
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
/// Not its boundaries: those are in states of scenes that have wind or walls. Not its moorings and scales: they decide
/// nothing of the run (tail_fields).
void fields(auto& archive, Is<AuditSums> auto& a) {
  archive(a.initial_energy, a.initial_momentum, a.impulses, a.energy, a.momentum);
}
void fields(auto& archive, Is<dynamics::PersistentContact> auto& r) {
  archive(r.last_point_in_b, r.first_touch_in_b, r.age, r.approach, r.crushed_depth, r.restitution.owed_impulse,
          r.restitution.given_impulse, r.restitution.limit, r.restitution.start_impulse[0],
          r.restitution.start_impulse[1], r.last_impulse[0], r.last_impulse[1], r.last_slip_impulse, r.last_substep,
          r.paid_area, r.area, r.reach, r.has_crushed, r.is_pierced, r.is_inherited, r.was_refused, r.is_continued);
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
/// Not its separation_bound: that is a cache, which may differ where the same bodies do the same.
void fields(auto& archive, Is<dynamics::PairState> auto& p) {
  archive(p.a, p.b, p.records);
}

void fields(auto& archive, Is<std::pair<std::int64_t, std::int64_t>> auto& p) {
  archive(p.first, p.second);
}

/// Its bodies follow from hull and floe, its place on the waterline is found when the peak is recorded.
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

/// Not its peaks and panels: they decide nothing of the run (state.cpp).
void fields(auto& archive, Is<Accounts> auto& a) {
  archive(a.areas, a.audit, a.counts, a.loads, a.hull_contacts, a.refused_grinds);
}

/// Where a body is and how it moves, and how far it has travelled, which bounds its neighbours' caches. Its rotation
/// follows from its angle.
void motion_fields(auto& archive, Is<dynamics::Bodies> auto& b, BodyIndex i) {
  archive(b.position[i], b.angle[i], b.angle_rest[i], b.velocity[i], b.angular_velocity[i], b.travel[i], b.rim_speed[i],
          b.is_awake[i]);
}
/// What a state begins with.
void head_fields(auto& archive, Is<World> auto& world) {
  archive(world.clock.ticks, world.pace.finer, world.pace.bends, world.population.water_velocity, world.accounts);
  if (has_wind_or_walls(world.setup.scene)) archive(world.accounts.audit.boundaries);
}
/// Beside its motion.
void hull_fields(auto& archive, Is<World> auto& world, std::int32_t hull) {
  if (is_sailing(world.setup, hull)) archive(world.population.helms[hull], world.accounts.sailing[hull]);
  if (has_mooring(world.setup, hull)) archive(world.population.helms[hull].last_turn);
  if (manages_ice(world.setup, hull)) archive(world.population.helms[hull].memory.pattern);
}
/// What checkpoints alone have after the contacts, before peaks and panels: masses follow from the areas where all ice
/// is alike.
void tail_fields(auto& archive, Is<World> auto& world) {
  auto& counts = world.accounts.counts;
  archive(world.accounts.masses, counts.unresolved_splits, counts.passing_steps, counts.crowded_ticks,
          counts.steps_taken, counts.most_parts, counts.body_steps, world.accounts.sampled_at);
  auto& audit = world.accounts.audit;
  archive(audit.moorings, audit.exchanged, audit.initial_momenta);
}

}  // namespace polynya::simulation
