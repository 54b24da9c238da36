#include "simulation/field/floe_field.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/exact/measures.hpp"
#include "geometry/exact/point_in_ring.hpp"
#include "simulation/field/cells.hpp"
#include "simulation/field/convex.hpp"

namespace polynya::simulation {
namespace {

using geometry::Box;
using geometry::Polygon;
using geometry::Ring;

/// Where floes may not be: nearer than the gap to what is kept clear, and across an outline.
class Obstacles {
 public:
  Obstacles(const FloeField& field, double gap) : field_(field), gap_(gap) {
    for (const Polygon& polygon : field.kept_clear) boxes_.push_back(grown(bounding_box(polygon.outer), gap));
  }

  bool forbid(const Ring& floe) const {
    if (!field_.is_rectangle &&
        (is_near_ring(floe, field_.region, 0) || geometry::side_of_ring(field_.region, floe.front()) < 0))
      return true;
    const Box box = bounding_box(floe);
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (!overlaps(box, boxes_[i])) continue;
      const Polygon& polygon = field_.kept_clear[i];
      if (is_near_ring(floe, polygon.outer, gap_) || geometry::contains(polygon, floe.front()) ||
          geometry::side_of_ring(floe, polygon.outer.front()) >= 0)
        return true;
    }
    return false;
  }

 private:
  const FloeField& field_;
  double gap_;  ///< [m]
  std::vector<Box> boxes_;
};

/// How floes give way to what forbids them.
struct GivingWay {
  int tries = 1;        ///< sizes that a floe is tried in, each 3 % shorter, before it is left out
  int rounds = 1;       ///< in which the others make up for what floes lost
  double rounding = 0;  ///< by so much less than the gap may floes be apart [m]
};

/// Cells with straight cuts at the boundary are rounded there: floes shrink a little, and the others make up.
/// The cells of a field without a law take no notice of boundaries, and what lies across one is left out.
GivingWay giving_way_of(const FloeField& field) {
  return field.law ? GivingWay{12, 4, 1e-9} : GivingWay{};
}

/// λ with Σ min(λ wanted, room) = total, by bisection [-].
double common_factor(const std::vector<Candidate>& candidates, double total) {
  double low = 0;
  double high = 64;
  for (int i = 0; i < 60; ++i) {
    const double factor = 0.5 * (low + high);
    double sum = 0;
    for (const Candidate& candidate : candidates) sum += std::min(factor * candidate.wanted, candidate.room);
    (sum < total ? low : high) = factor;
  }
  return 0.5 * (low + high);
}

/// The candidate at a factor, or a little smaller where it would be forbidden. Nothing where that does not
/// help.
Ring permitted(const Obstacles& obstacles, const Candidate& candidate, double factor, int tries) {
  for (; tries > 0; --tries) {
    Ring floe = scaled(candidate.ring, candidate.centroid, factor);
    if (!candidate.may_be_forbidden || !obstacles.forbid(floe)) return floe;
    factor *= 0.97;
  }
  return {};
}

/// The floes at a common factor. A candidate that had to be smaller, or left out, has no more room than that
/// from now on; true where there was one.
bool shrink_candidates(const Obstacles& obstacles, double factor, int tries, std::vector<Candidate>& candidates,
                       std::vector<Ring>& floes) {
  bool was_any = false;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Candidate& candidate = candidates[i];
    floes[i].clear();
    if (candidate.room <= 0) continue;
    const double area = std::min(factor * candidate.wanted, candidate.room);
    floes[i] = permitted(obstacles, candidate, std::sqrt(area / candidate.area), tries);
    const double left = floes[i].empty() ? 0 : measure_convex(floes[i]).area;
    if (left >= area * (1 - 1e-9)) continue;
    candidate.room = left;
    was_any = true;
  }
  return was_any;
}

/// Adds the floes that the cells' candidates become, with their number and the mean and spread of their
/// sizes.
void add_floes(const FloeField& field, FieldLayout& layout, FloeFieldOutcome& outcome) {
  const GivingWay way = giving_way_of(field);
  const Obstacles obstacles(field, std::max(0.0, field.gap - way.rounding));
  std::vector<Ring> floes(layout.candidates.size());
  for (int round = 0; round < way.rounds; ++round) {
    const double factor = common_factor(layout.candidates, field.concentration * layout.tiled_area);
    if (!shrink_candidates(obstacles, factor, way.tries, layout.candidates, floes)) break;
  }
  outcome.floes.reserve(floes.size());
  double size_sum = 0;
  for (Ring& floe : floes) {
    if (floe.empty()) {
      ++outcome.left_out;
      continue;
    }
    const double area = measure_convex(floe).area;
    outcome.floe_area += area;
    size_sum += std::sqrt(area);
    floe.shrink_to_fit();
    outcome.floes.push_back({std::move(floe), {}});
  }
  outcome.count = static_cast<int>(outcome.floes.size());
  if (outcome.count == 0) return;
  const auto count = static_cast<double>(outcome.count);
  outcome.mean_size = size_sum / count;
  const double variance = outcome.floe_area / count - outcome.mean_size * outcome.mean_size;
  outcome.size_spread = std::sqrt(std::max(0.0, variance)) / outcome.mean_size;
}

}  // namespace

double floe_count(const FloeField& field) {
  if (field.law) return std::round(field.concentration * geometry::signed_area(field.region) / mean_area(*field.law));
  const Box box = bounding_box(field.region);
  const double area = (box.high.x - box.low.x) * (box.high.y - box.low.y);
  const double mean = field.floe_size * field.floe_size * (1 + field.size_spread * field.size_spread);
  return std::round(field.concentration * area / mean);
}

FloeFieldOutcome make_floe_field(const FloeField& field) {
  FieldLayout layout = field.law ? packed_cells(field) : lattice_cells(field);
  FloeFieldOutcome outcome;
  outcome.region_area = layout.region_area;
  outcome.left_out = layout.left_out;
  if (!(layout.tiled_area > 0)) return outcome;
  double room = 0;
  for (const Candidate& candidate : layout.candidates) room += candidate.room;
  outcome.reachable_concentration = room / layout.tiled_area;
  outcome.reachable_without_gap = layout.cell_area / layout.tiled_area;
  add_floes(field, layout, outcome);
  if (field.law && outcome.count > 0) outcome.statistics = statistics_of(*field.law, outcome.floes);
  return outcome;
}

}  // namespace polynya::simulation
