#include <algorithm>
#include <span>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/predicates.hpp"
#include "simulation/ice/pieces.hpp"
#include "simulation/ice/turning.hpp"
#include "simulation/ship/hull_contact_load.hpp"
#include "simulation/ship/waterline.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

/// Returns the outline of a cusp in the body frame of its floe: a disc about the point of first contact.
geometry::Ring cusp_of(const Setup& setup, const PendingFracture& pending) {
  return geometry::disc_polygon(pending.first_touch_in_body, pending.cusp_radius, setup.scene.fracture.cusp_sagitta,
                                pending.cusp_axis_in_body);
}

/// Cuts a floe by its cusp if it bends, or along its crack if it splits.
geometry::CutOutcome cut(const Setup& setup, const geometry::Shape& shape, const PendingFracture& pending) {
  if (pending.failure == fracture::Failure::kBend)
    return geometry::cut_by_polygon(shape, {cusp_of(setup, pending), {}});
  return geometry::cut_along(shape, pending.crack_in_body.points());
}

/// Returns true if the disc of a cusp misses the floe, because the ice at the point of first contact has broken off
/// with other cusps since. A fast ship moves metres between two cusps of thin ice.
bool misses_its_cusp(const geometry::CutOutcome& outcome, const PendingFracture& pending) {
  return !outcome && outcome.error().reason == geometry::CutFailure::kMisses &&
         pending.failure == fracture::Failure::kBend;
}

/// Largest distance between a contact and the ice at which a cusp is centred again, as a multiple of its radius [-]. A
/// contact farther from the floe does not touch this ice any more. Larger values break ice far from the contact;
/// smaller values leave bends without a cut.
constexpr double kFarthestIce = 10;

/// Centres a cusp at the place on the floe's boundary that is nearest to the contact, unless that place is farther away
/// than kFarthestIce radii. The middle of a contact line may lie between two spikes of ice.
void recentre(const Population& population, PendingFracture& pending) {
  const geometry::Pose pose = dynamics::water_from_body(population.bodies, population.body_of(pending.floe));
  const geometry::Point contact = inverse_transform(pose, pending.point_in_water);
  const geometry::Polygon& polygon = population.floes[pending.floe].shape.polygon;
  geometry::Point nearest = nearest_place(polygon.outer, contact).point;
  for (const geometry::Ring& hole : polygon.holes) {
    const geometry::Point p = nearest_place(hole, contact).point;
    if (distance(p, contact) < distance(nearest, contact)) nearest = p;
  }
  if (distance(nearest, contact) <= kFarthestIce * pending.cusp_radius) pending.first_touch_in_body = nearest;
}

/// Returns the event of a fracture, as a kind of event with `criterion`.
template <class Kind>
Event event_of(const Instant& now, const PendingFracture& pending) {
  Kind kind;
  kind.floe = pending.floe;
  kind.by_floe = pending.by_floe;
  kind.normal_in_world = pending.normal;
  kind.penetration = pending.penetration;
  kind.criterion = pending.criteria;
  if constexpr (requires { kind.cusp_radius; })
    kind.cusp_radius = pending.failure == fracture::Failure::kBend ? pending.cusp_radius : 0;
  return {now.time, pending.ship, pending.point_in_water + now.drift, std::move(kind)};
}

/// Returns the event of a fracture whose cut geometry refused. The caller sets its number.
Event rejected_fracture(const Setup& setup, const Instant& now, const PendingFracture& pending,
                        const geometry::Shape& shape, const geometry::CutError& error) {
  Event event = event_of<RejectedCut>(now, pending);
  auto& rejected = std::get<RejectedCut>(event.what);
  rejected.reason = to_string(error);
  rejected.input.polygon_in_body = shape.polygon;
  if (pending.failure == fracture::Failure::kBend) rejected.input.cusp_in_body = cusp_of(setup, pending);
  rejected.input.crack_in_body = pending.crack_in_body.points();
  return event;
}

/// Returns the fate of a cusp at a hull. A hull without a draught cannot take ice, so the cusp goes under for good.
InsideFate fate_of_cusp(const Setup& setup, int ship) {
  switch (setup.scene.fracture.cusp_fate) {
    case CuspFate::kFloat:
      return InsideFate::kFloats;
    case CuspFate::kUnderHull:
      return setup.underwater[ship].can_take_ice ? InsideFate::kUnderHull : InsideFate::kSubmerged;
    case CuspFate::kSubmerge:
      break;
  }
  return InsideFate::kSubmerged;
}

/// Returns how the pieces of a floe are handled, by the kind of its fracture.
Breakage breakage_of(const Setup& setup, const Instant& now, const PendingFracture& pending,
                     const geometry::CutResult& cut) {
  if (pending.failure != fracture::Failure::kBend)
    return {event_of<Split>(now, pending), cut, InsideFate::kFloats, &EnergyFlows::splitting, &Counts::splits};
  return {event_of<Bend>(now, pending), cut, fate_of_cusp(setup, pending.ship), &EnergyFlows::bending, &Counts::bends};
}

/// Assigns the other bends of a floe that has just bent to the pieces that contain their contacts. `first` is the id of
/// the first piece. A hull may break more than one cusp off a plate in a step. If the second bend were put off to the
/// next step, a bow in uniform ice would break the plate on one side first, and which side that is would depend on the
/// length of the step. A piece that is too small to break takes no bend.
void pass_bends(FloeId bent, FloeId first, std::span<PendingFracture> others, const Population& population) {
  for (PendingFracture& pending : others) {
    if (pending.floe != bent || !pending.passes_to_pieces) continue;
    for (FloeId piece = first; piece < population.floe_count(); ++piece) {
      const BodyIndex body = population.body_of(piece);
      if (!population.is_floating(piece) || floe_size(population, body) < pending.criteria.breakable_size) continue;
      const geometry::Pose pose = dynamics::water_from_body(population.bodies, body);
      if (contains(population.floes[piece].shape.polygon, inverse_transform(pose, pending.point_in_water))) {
        pending.floe = piece;
        break;
      }
    }
  }
}

}  // namespace

void apply_fractures(const Setup& setup, const Step& step, StepData& data, Population& population, Books books) {
  std::vector<PendingFracture>& fractures = data.fractures;
  std::ranges::stable_sort(fractures, {}, &PendingFracture::floe);
  for (std::size_t i = 0; i < fractures.size(); ++i) {
    PendingFracture& pending = fractures[i];
    if (!population.is_floating(pending.floe))
      continue;  // it has already broken in this step, and no piece has taken over this fracture (pass_bends)
    const geometry::Shape& shape = population.floes[pending.floe].shape;
    geometry::CutOutcome outcome = cut(setup, shape, pending);
    if (misses_its_cusp(outcome, pending)) {
      recentre(population, pending);
      outcome = cut(setup, shape, pending);
    }
    if (outcome) {
      const FloeId first = population.floe_count();
      Breakage breakage = breakage_of(setup, step.end, pending, *outcome);
      const bool is_bend = pending.failure == fracture::Failure::kBend;
      if (is_bend && !pending.is_in_range) ++books.accounts.counts.database_out_of_range;
      if (breakage.inside == InsideFate::kUnderHull) {
        start_cusp(step, pending, pressed_mass(setup, population, pending, *outcome), population,
                   {data.loads[pending.ship], books.accounts.audit});
        breakage.has_decks = has_decks(setup, pending);
        if (breakage.has_decks) add_decks(setup, pending, *outcome, population);
      }
      replace_by_pieces(setup, step.end, breakage, population, books);
      if (pending.passes_to_pieces) pass_bends(pending.floe, first, std::span(fractures).subspan(i + 1), population);
    } else {
      Event event = rejected_fracture(setup, step.end, pending, shape, outcome.error());
      std::get<RejectedCut>(event.what).input.number = ++books.accounts.counts.rejected_cuts;
      books.journal.events.push_back(std::move(event));
      pending.record->was_refused = true;
    }
  }
}

}  // namespace polynya::simulation
