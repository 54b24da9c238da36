#include <algorithm>

#include "geometry/cut/cut.hpp"
#include "simulation/ice/pieces.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::BlindOverlap;

/// Blind overlaps smaller than this share of the smaller body are left: what contacts part soon.
constexpr double kLeastShare = 0.005;

/// What a floe's edge bears per metre before it crushes, σ_c h [N/m].
double crushing_line_load(const fracture::Ice& ice) {
  return ice.compressive_strength * ice.thickness;
}

/// Which of two bodies is ground: the floe in a hull; of two floes the weaker, or the smaller.
BodyIndex ground_of(const Setup& setup, const Population& population, const BlindOverlap& overlap) {
  if (population.is_hull(overlap.a)) return overlap.b;
  const double stronger = crushing_line_load(ice_of_body(setup, population, overlap.a)) -
                          crushing_line_load(ice_of_body(setup, population, overlap.b));
  if (stronger != 0) return stronger > 0 ? overlap.b : overlap.a;
  return population.bodies.area[overlap.a] < population.bodies.area[overlap.b] ? overlap.a : overlap.b;
}

geometry::Polygon outline_of(const Population& population, const Setup& setup, BodyIndex body) {
  if (population.is_hull(body)) return {hull_of(setup.scene, body).hull.waterline, {}};
  return population.floes[population.floe_of(body)].shape.polygon;
}

/// Both sides of what decides.
GrindCriterion criterion_of(const Population& population, const BlindOverlap& overlap) {
  const double area_a = population.bodies.area[overlap.a];
  const double area_b = population.bodies.area[overlap.b];
  const double smaller = std::min(area_a, area_b);
  GrindCriterion criterion{overlap.area, kLeastShare * smaller, overlap.width, overlap.least_width};
  if (overlap.is_inside) {
    const double radius = population.bodies.bounding_radius[area_a < area_b ? overlap.a : overlap.b];
    criterion.overlap_area = smaller;
    criterion.least_width = geometry::kBlindShare * smaller / (2 * radius);
  }
  return criterion;
}

Event event_of(const Population& population, const Clock& clock, const BlindOverlap& overlap,
               BodyIndex ground, const GrindCriterion& criterion) {
  const BodyIndex by = ground == overlap.a ? overlap.b : overlap.a;
  Event event;
  event.time = clock.time();
  event.kind = EventKind::kGrind;
  event.ship = population.is_hull(by) ? by : -1;
  event.by_floe = population.is_hull(by) ? kNoFloe : population.floe_of(by);
  event.floe = population.floe_of(ground);
  event.point_in_world = overlap.middle + clock.drift();
  event.grinding = criterion;
  return event;
}

void reject(Event event, const geometry::Polygon& floe, geometry::Ring tool, const geometry::CutError& error,
            Accounts& accounts, Journal& journal) {
  event.kind = EventKind::kRejectedCut;
  event.reason = std::string(name_of(error.reason)) + ": " + error.detail;
  ++accounts.counts.rejected_cuts;
  journal.rejected_cuts.push_back(
      {accounts.counts.rejected_cuts, event.time, event.floe, event.reason, floe, std::move(tool), {}});
  journal.events.push_back(std::move(event));
}

}  // namespace

void grind_blind_overlaps(const Setup& setup, const Clock& clock, const std::vector<BlindOverlap>& overlaps,
                          Population& population, Accounts& accounts, Journal& journal) {
  for (const BlindOverlap& overlap : overlaps) {
    const dynamics::Bodies& bodies = population.bodies;
    if (!bodies.is_alive[overlap.a] || !bodies.is_alive[overlap.b]) continue;  // broken in this step
    if (!population.is_hull(overlap.a) && !population.is_floating(population.floe_of(overlap.a))) continue;
    if (!population.is_floating(population.floe_of(overlap.b))) continue;
    const std::pair<std::int64_t, std::int64_t> both{overlap.a, overlap.b};
    if (std::ranges::find(accounts.refused_grinds, both) != accounts.refused_grinds.end()) continue;
    const GrindCriterion criterion = criterion_of(population, overlap);
    if (criterion.overlap_area < criterion.least_area) continue;
    const BodyIndex ground = ground_of(setup, population, overlap);
    const BodyIndex by = ground == overlap.a ? overlap.b : overlap.a;
    const geometry::Pose ground_from_by =
        relative_pose(dynamics::water_from_body(bodies, ground), dynamics::water_from_body(bodies, by));
    const geometry::Polygon tool = transform(ground_from_by, outline_of(population, setup, by));
    Event event = event_of(population, clock, overlap, ground, criterion);
    const geometry::Shape& shape = population.floes[event.floe].shape;
    const geometry::CutOutcome outcome = geometry::cut_by_polygon(shape, tool);
    if (outcome) {
      event.grinding.overlap_area = outcome->ledger.area_inside;
      if (event.grinding.overlap_area < criterion.least_area) continue;
      replace_by_pieces(setup, clock, {event, InsideFate::kBrash, &EnergyFlows::grinding, &Counts::ground},
                        *outcome, population, accounts, journal);
    } else if (outcome.error().reason != geometry::CutFailure::kMisses) {  // else they have parted
      reject(event, shape.polygon, tool.outer, outcome.error(), accounts, journal);
      accounts.refused_grinds.push_back(both);
    }
  }
}

}  // namespace polynya::simulation
