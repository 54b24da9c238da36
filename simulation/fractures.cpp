#include <algorithm>
#include <cmath>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/measures.hpp"
#include "simulation/floe_size.hpp"
#include "simulation/step.hpp"

namespace polynya::simulation {
namespace {

geometry::Ring cusp_of(const World& world, const PendingFracture& pending) {
  return geometry::disc_polygon(pending.first_touch_in_body, pending.cusp_radius,
                                world.scene.fracture.cusp_sagitta);
}

geometry::CutOutcome cut(const World& world, const PendingFracture& pending) {
  const geometry::Shape& shape = world.floes[pending.floe].shape;
  if (pending.failure == fracture::Failure::kBend)
    return geometry::cut_by_polygon(shape, {cusp_of(world, pending), {}});
  return geometry::cut_along(shape, {pending.crack_in_body.start, pending.crack_in_body.end});
}

Event event_of(const World& world, const PendingFracture& pending, EventKind kind) {
  Event event;
  event.time = world.time();
  event.kind = kind;
  event.ship = pending.ship;
  event.floe = pending.floe;
  event.point_in_world = pending.point_in_water + world.drift();
  event.normal_in_world = pending.normal;
  event.criteria = pending.criteria;
  event.cusp_radius = pending.failure == fracture::Failure::kBend ? pending.cusp_radius : 0;
  event.penetration = pending.penetration;
  return event;
}

void reject(World& world, const PendingFracture& pending, const geometry::CutError& error) {
  Event event = event_of(world, pending, EventKind::kRejectedCut);
  event.reason = std::string(name_of(error.reason)) + ": " + error.detail;
  ++world.counts.rejected_cuts;
  const geometry::Shape& shape = world.floes[pending.floe].shape;
  RejectedCut rejected{
      world.counts.rejected_cuts, world.time(), pending.floe, event.reason, shape.polygon, {}, {}};
  if (pending.failure == fracture::Failure::kBend) rejected.cusp_in_body = cusp_of(world, pending);
  rejected.crack_in_body[0] = pending.crack_in_body.start;
  rejected.crack_in_body[1] = pending.crack_in_body.end;
  world.journal.rejected_cuts.push_back(std::move(rejected));
  world.journal.events.push_back(std::move(event));
  pending.record->was_refused = true;
}

/// Enters the motion of ice that leaves the floe list with its parent's motion.
void note_removed(World& world, double& sink, const NewFloe& moving, const geometry::Measures& measures) {
  const double mass_per_area = world.scene.ice.density * world.scene.ice.thickness;
  const geometry::Vector arm =
      transform(moving.water_from_body, measures.centroid) - moving.water_from_body.position;
  const geometry::Vector velocity = moving.velocity + cross(moving.angular_velocity, arm);
  const geometry::Vector carried = mass_per_area * measures.area * velocity;
  sink += 0.5 * (dot(carried, velocity) +
                 mass_per_area * measures.second_moment * moving.angular_velocity * moving.angular_velocity);
  world.audit.momentum.removed += carried;
  world.audit.impulses += length(carried);
}

/// Pieces become bodies that move on as the parts of the parent they were: v + ω × r, the same ω.
void replace_by_pieces(World& world, const PendingFracture& pending, const geometry::CutResult& cut) {
  const bool is_bend = pending.failure == fracture::Failure::kBend;
  Event event = event_of(world, pending, is_bend ? EventKind::kBend : EventKind::kSplit);
  const BodyIndex parent = world.body_of(pending.floe);
  NewFloe child;
  child.parent = pending.floe;
  child.generation = world.floes[pending.floe].generation + 1;
  child.water_from_body = dynamics::water_from_body(world.bodies, parent);
  child.angle = world.bodies.angle[parent];
  child.angular_velocity = world.bodies.angular_velocity[parent];
  child.velocity = dynamics::velocity_at(world.bodies, parent,
                                         child.water_from_body.position - world.bodies.position[parent]);
  retire_floe(world, pending.floe);
  double& sink = is_bend ? world.audit.energy.bending : world.audit.energy.splitting;
  for (const geometry::Piece& piece : cut.pieces) {
    const geometry::Measures measures = geometry::measure(piece.shape.polygon);
    const double area = measures.area;
    const bool is_cusp = is_bend && piece.part == geometry::Part::kInside;
    if (is_cusp && world.scene.fracture.cusp_fate == CuspFate::kSubmerge) {
      event.submerged_area += area;
      note_removed(world, sink, child, measures);
      continue;
    }
    if (area < world.scene.fracture.smallest_floe_area || !can_be_floe(measures)) {
      event.brash_area += area;
      ++world.counts.brash_pieces;
      note_removed(world, sink, child, measures);
      continue;
    }
    child.shape = piece.shape;
    const FloeId id = add_floe(world, child, measures);
    wake(world, world.body_of(id));
    event.children.push_back(id);
    world.counts.floated_cusps += is_cusp ? 1 : 0;
  }
  event.brash_area += cut.ledger.area_slivers;
  event.rounding_defect = cut.ledger.rounding_defect;
  world.counts.snap_rounded += cut.ledger.snap_rounded;
  world.ledger.submerged_area += event.submerged_area;
  world.ledger.brash_area += event.brash_area;
  world.ledger.rounding_defect += event.rounding_defect;
  ++(is_bend ? world.counts.bends : world.counts.splits);
  world.journal.events.push_back(std::move(event));
}

}  // namespace

void apply_fractures(World& world) {
  std::stable_sort(world.fractures.begin(), world.fractures.end(),
                   [](const PendingFracture& p, const PendingFracture& q) { return p.floe < q.floe; });
  for (const PendingFracture& pending : world.fractures) {
    if (!world.is_alive(pending.floe))
      continue;  // it broke in this step already; its pieces are judged in the next
    const geometry::CutOutcome outcome = cut(world, pending);
    if (outcome) {
      replace_by_pieces(world, pending, *outcome);
    } else {
      reject(world, pending, outcome.error());
    }
  }
}

}  // namespace polynya::simulation
