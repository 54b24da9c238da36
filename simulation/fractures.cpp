#include <algorithm>
#include <cmath>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/measures.hpp"
#include "simulation/limits.hpp"
#include "simulation/step.hpp"

namespace polynya::simulation {
namespace {

geometry::Ring cusp_of(const Setup& setup, const PendingFracture& pending) {
  return geometry::disc_polygon(pending.first_touch_in_body, pending.cusp_radius,
                                setup.scene.fracture.cusp_sagitta);
}

geometry::CutOutcome cut(const Setup& setup, const geometry::Shape& shape, const PendingFracture& pending) {
  if (pending.failure == fracture::Failure::kBend)
    return geometry::cut_by_polygon(shape, {cusp_of(setup, pending), {}});
  return geometry::cut_along(shape, {pending.crack_in_body.start, pending.crack_in_body.end});
}

Event event_of(const Clock& clock, const PendingFracture& pending, EventKind kind) {
  Event event;
  event.time = clock.time();
  event.kind = kind;
  event.ship = pending.ship;
  event.floe = pending.floe;
  event.point_in_world = pending.point_in_water + clock.drift();
  event.normal_in_world = pending.normal;
  event.criteria = pending.criteria;
  event.cusp_radius = pending.failure == fracture::Failure::kBend ? pending.cusp_radius : 0;
  event.penetration = pending.penetration;
  return event;
}

void reject(const Setup& setup, const Clock& clock, const PendingFracture& pending,
            const geometry::Shape& shape, const geometry::CutError& error, Counts& counts, Journal& journal) {
  Event event = event_of(clock, pending, EventKind::kRejectedCut);
  event.reason = std::string(name_of(error.reason)) + ": " + error.detail;
  ++counts.rejected_cuts;
  RejectedCut rejected{counts.rejected_cuts, clock.time(), pending.floe, event.reason, shape.polygon, {}, {}};
  if (pending.failure == fracture::Failure::kBend) rejected.cusp_in_body = cusp_of(setup, pending);
  rejected.crack_in_body[0] = pending.crack_in_body.start;
  rejected.crack_in_body[1] = pending.crack_in_body.end;
  journal.rejected_cuts.push_back(std::move(rejected));
  journal.events.push_back(std::move(event));
  pending.record->was_refused = true;
}

/// What all pieces of a floe have in common: they move on as the parts of the body they were, v + ω × r, the
/// same ω.
NewFloe child_of(const Population& population, FloeId parent) {
  const dynamics::Bodies& bodies = population.bodies;
  const BodyIndex body = population.body_of(parent);
  NewFloe child;
  child.thickness = bodies.thickness[body];
  child.parent = parent;
  child.generation = population.floes[parent].generation + 1;
  child.water_from_body = dynamics::water_from_body(bodies, body);
  child.angle = bodies.angle[body];
  child.angular_velocity = bodies.angular_velocity[body];
  child.velocity =
      dynamics::velocity_at(bodies, body, child.water_from_body.position - bodies.position[body]);
  return child;
}

/// Enters the motion of ice that leaves the floe list with its parent's motion.
void enter_removed(const NewFloe& piece, const geometry::Measures& measures, double ice_density,
                   double& energy_sink, AuditSums& audit) {
  const double mass_per_area = ice_density * piece.thickness;
  const geometry::Vector arm =
      transform(piece.water_from_body, measures.centroid) - piece.water_from_body.position;
  const geometry::Vector velocity = piece.velocity + cross(piece.angular_velocity, arm);
  const geometry::Vector carried = mass_per_area * measures.area * velocity;
  energy_sink += 0.5 * (dot(carried, velocity) + mass_per_area * measures.second_moment *
                                                     piece.angular_velocity * piece.angular_velocity);
  audit.momentum.removed += carried;
  audit.impulses += length(carried);
}

void enter_areas(const Event& event, const geometry::CutLedger& cut, Accounts& accounts) {
  accounts.counts.snap_rounded += cut.snap_rounded;
  accounts.ledger.submerged_area += event.submerged_area;
  accounts.ledger.brash_area += event.brash_area;
  accounts.ledger.rounding_defect += event.rounding_defect;
}

void replace_by_pieces(const Setup& setup, const Clock& clock, const PendingFracture& pending,
                       const geometry::CutResult& cut, Population& population, Accounts& accounts,
                       Journal& journal) {
  const FractureSettings& settings = setup.scene.fracture;
  const bool is_bend = pending.failure == fracture::Failure::kBend;
  Event event = event_of(clock, pending, is_bend ? EventKind::kBend : EventKind::kSplit);
  NewFloe child = child_of(population, pending.floe);
  retire_floe(pending.floe, population, journal);
  EnergyFlows& energy = accounts.audit.energy;
  double& energy_sink = is_bend ? energy.bending : energy.splitting;
  for (const geometry::Piece& piece : cut.pieces) {
    const geometry::Measures measures = geometry::measure(piece.shape.polygon);
    const bool is_cusp = is_bend && piece.part == geometry::Part::kInside;
    const bool is_submerged = is_cusp && settings.cusp_fate == CuspFate::kSubmerge;
    const bool is_brash = measures.area < settings.smallest_floe_area || !can_be_floe(measures);
    if (is_submerged || is_brash) {
      (is_submerged ? event.submerged_area : event.brash_area) += measures.area;
      accounts.counts.brash_pieces += is_submerged ? 0 : 1;
      enter_removed(child, measures, setup.scene.ice.density, energy_sink, accounts.audit);
      continue;
    }
    child.shape = piece.shape;
    const FloeId id = add_floe(setup, clock, child, measures, population, journal);
    wake(population.body_of(id), population);
    event.children.push_back(id);
    accounts.counts.floated_cusps += is_cusp ? 1 : 0;
  }
  event.brash_area += cut.ledger.area_slivers;
  event.rounding_defect = cut.ledger.rounding_defect;
  enter_areas(event, cut.ledger, accounts);
  ++(is_bend ? accounts.counts.bends : accounts.counts.splits);
  journal.events.push_back(std::move(event));
}

}  // namespace

void apply_fractures(const Setup& setup, const Clock& clock, std::vector<PendingFracture>& fractures,
                     Population& population, Accounts& accounts, Journal& journal) {
  std::ranges::stable_sort(fractures, {}, &PendingFracture::floe);
  for (const PendingFracture& pending : fractures) {
    if (!population.is_alive(pending.floe))
      continue;  // it broke in this step already; its pieces may break in the next
    const geometry::Shape& shape = population.floes[pending.floe].shape;
    const geometry::CutOutcome outcome = cut(setup, shape, pending);
    if (outcome) {
      replace_by_pieces(setup, clock, pending, *outcome, population, accounts, journal);
    } else {
      reject(setup, clock, pending, shape, outcome.error(), accounts.counts, journal);
    }
  }
}

}  // namespace polynya::simulation
