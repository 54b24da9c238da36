#include "simulation/ice/cut_overlap.hpp"

#include "geometry/exact/measures.hpp"
#include "simulation/ice/pieces.hpp"
#include "simulation/world/limits.hpp"

namespace polynya::simulation {
namespace {

/// What a floe's edge bears per metre before it crushes, σ_c h [N/m].
double crushing_line_load(const fracture::Ice& ice) {
  return ice.compressive_strength * ice.thickness;
}

geometry::Polygon outline_of(const Population& population, const Setup& setup, BodyIndex body) {
  if (population.is_hull(body)) return {hull_of(setup.scene, body).hull.waterline, {}};
  return population.floes[population.floe_of(body)].shape.polygon;
}

/// A kind of event with what all that happens to overlaps has.
template <class Kind>
Event event_of(const Population& population, const Clock& clock, const OverlapCut& overlap, BodyIndex ground,
               Kind kind) {
  const BodyIndex by = ground == overlap.a ? overlap.b : overlap.a;
  kind.floe = population.floe_of(ground);
  kind.by_floe = population.floe_or_none(by);
  return {clock.time(), population.hull_or_none(by), overlap.middle + clock.drift(), std::move(kind)};
}

/// Whether a cut leaves two floes or more, slivers and what would be brash aside.
bool is_parted(const Setup& setup, const geometry::CutResult& cut) {
  int floes = 0;
  for (const geometry::Piece& piece : cut.pieces) {
    const geometry::Measures measures = geometry::measure(piece.shape.polygon);
    floes += piece.part == geometry::Part::kOutside && can_be_floe(measures) &&
             measures.area >= setup.scene.fracture.smallest_floe_area;
  }
  return floes > 1;
}

}  // namespace

bool can_cut(const Population& population, const Accounts& accounts, BodyIndex a, BodyIndex b) {
  const dynamics::Bodies& bodies = population.bodies;
  if (!bodies.is_alive[a] || !bodies.is_alive[b]) return false;  // broken in this step
  if (!population.is_hull(a) && !population.is_floating(population.floe_of(a))) return false;
  if (population.is_hull(b) || !population.is_floating(population.floe_of(b))) return false;
  return !is_refused(accounts, a, b);
}

BodyIndex ground_of(const Setup& setup, const Population& population, BodyIndex a, BodyIndex b) {
  if (population.is_hull(a)) return b;
  const double stronger =
      crushing_line_load(ice_of_body(setup, population, a)) - crushing_line_load(ice_of_body(setup, population, b));
  if (stronger != 0) return stronger > 0 ? b : a;
  return population.bodies.area[a] < population.bodies.area[b] ? a : b;
}

bool cut_overlap(const Setup& setup, const Clock& clock, const OverlapCut& overlap, Population& population,
                 Accounts& accounts, Journal& journal) {
  const BodyIndex ground = ground_of(setup, population, overlap.a, overlap.b);
  const BodyIndex by = ground == overlap.a ? overlap.b : overlap.a;
  const geometry::Polygon outline = outline_of(population, setup, by);
  std::vector<geometry::Polygon> tools;
  for (const geometry::Pose& a_from_b : overlap.a_from_b)
    tools.push_back(transform(ground == overlap.a ? a_from_b : geometry::inverse(a_from_b), outline));
  const geometry::Shape& shape = population.floes[population.floe_of(ground)].shape;
  const geometry::CutOutcome outcome =
      tools.size() == 1 ? cut_by_polygon(shape, tools.front()) : cut_by_polygons(shape, tools);
  GrindCriterion criterion = overlap.criterion;
  if (outcome) {
    criterion.overlap_area = outcome->ledger.area_inside;
    if (criterion.overlap_area < criterion.least_area) return false;
    if (overlap.when == CutWhen::kParts && !is_parted(setup, *outcome)) return false;
    Event event = event_of(population, clock, overlap, ground, Grind{{}, criterion});
    replace_by_pieces(setup, clock, {std::move(event), InsideFate::kBrash, &EnergyFlows::grinding, &Counts::ground},
                      *outcome, population, accounts, journal);
    return true;
  }
  if (outcome.error().reason != geometry::CutFailure::kMisses) {  // else they have parted
    RejectedCut rejected = rejected_grind(criterion, shape.polygon, tools.front().outer, outcome.error(), accounts);
    journal.events.push_back(event_of(population, clock, overlap, ground, std::move(rejected)));
    accounts.refused_grinds.emplace_back(overlap.a, overlap.b);
  }
  return false;
}

}  // namespace polynya::simulation
