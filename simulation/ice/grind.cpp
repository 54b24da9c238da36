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

/// A kind of event with what all that happens to overlaps has.
template <class Kind>
Event event_of(const Population& population, const Clock& clock, const BlindOverlap& overlap, BodyIndex ground,
               Kind kind) {
  const BodyIndex by = ground == overlap.a ? overlap.b : overlap.a;
  const bool is_by_hull = population.is_hull(by);
  kind.floe = population.floe_of(ground);
  kind.by_floe = is_by_hull ? kNoFloe : population.floe_of(by);
  return {clock.time(), is_by_hull ? by : -1, overlap.middle + clock.drift(), std::move(kind)};
}

RejectedCut rejected_cut(const GrindCriterion& criterion, const geometry::Polygon& floe, geometry::Ring tool,
                         const geometry::CutError& error, std::int64_t number) {
  RejectedCut rejected;
  rejected.criterion = criterion;
  rejected.reason = std::string(name_of(error.reason)) + ": " + error.detail;
  rejected.input = {number, floe, std::move(tool), {}};
  return rejected;
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
    GrindCriterion criterion = criterion_of(population, overlap);
    if (criterion.overlap_area < criterion.least_area) continue;
    const BodyIndex ground = ground_of(setup, population, overlap);
    const BodyIndex by = ground == overlap.a ? overlap.b : overlap.a;
    const geometry::Pose ground_from_by =
        relative_pose(dynamics::water_from_body(bodies, ground), dynamics::water_from_body(bodies, by));
    const geometry::Polygon tool = transform(ground_from_by, outline_of(population, setup, by));
    const geometry::Shape& shape = population.floes[population.floe_of(ground)].shape;
    const geometry::CutOutcome outcome = geometry::cut_by_polygon(shape, tool);
    if (outcome) {
      criterion.overlap_area = outcome->ledger.area_inside;
      if (criterion.overlap_area < criterion.least_area) continue;
      Event event = event_of(population, clock, overlap, ground, Grind{.criterion = criterion});
      replace_by_pieces(setup, clock, {std::move(event), InsideFate::kBrash, &EnergyFlows::grinding, &Counts::ground},
                        *outcome, population, accounts, journal);
    } else if (outcome.error().reason != geometry::CutFailure::kMisses) {  // else they have parted
      RejectedCut rejected =
          rejected_cut(criterion, shape.polygon, tool.outer, outcome.error(), ++accounts.counts.rejected_cuts);
      journal.events.push_back(event_of(population, clock, overlap, ground, std::move(rejected)));
      accounts.refused_grinds.push_back(both);
    }
  }
}

}  // namespace polynya::simulation
