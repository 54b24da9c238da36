#include <algorithm>

#include "simulation/ice/cut_overlap.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::BlindOverlap;

/// Blind overlaps smaller than this share of the smaller body are left: what contacts part soon.
constexpr double kLeastBlindShare = 0.005;

/// Both sides of what decides.
GrindCriterion criterion_of(const Population& population, const BlindOverlap& overlap) {
  const double area_a = population.bodies.area[overlap.a];
  const double area_b = population.bodies.area[overlap.b];
  const double smaller = std::min(area_a, area_b);
  GrindCriterion criterion{overlap.area, kLeastBlindShare * smaller, overlap.width, overlap.least_width};
  if (overlap.is_inside) {
    const double radius = population.bodies.bounding_radius[area_a < area_b ? overlap.a : overlap.b];
    criterion.overlap_area = smaller;
    criterion.least_width = geometry::kBlindShare * smaller / (2 * radius);
  }
  return criterion;
}

}  // namespace

void grind_blind_overlaps(const Setup& setup, const Clock& clock, const std::vector<BlindOverlap>& overlaps,
                          Population& population, Accounts& accounts, Journal& journal) {
  for (const BlindOverlap& overlap : overlaps) {
    if (!can_cut(population, accounts, overlap.a, overlap.b)) continue;
    const GrindCriterion criterion = criterion_of(population, overlap);
    if (criterion.overlap_area < criterion.least_area) continue;
    const dynamics::Bodies& bodies = population.bodies;
    const geometry::Pose a_from_b =
        relative_pose(dynamics::water_from_body(bodies, overlap.a), dynamics::water_from_body(bodies, overlap.b));
    cut_overlap(setup, clock, {overlap.a, overlap.b, {a_from_b}, overlap.middle, criterion}, population, accounts,
                journal);
  }
}

}  // namespace polynya::simulation
