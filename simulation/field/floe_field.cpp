#include "simulation/field/floe_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/exact/measures.hpp"
#include "geometry/exact/predicates.hpp"
#include "geometry/shape/power_diagram.hpp"
#include "simulation/field/convex.hpp"
#include "simulation/field/portable_math.hpp"
#include "simulation/field/tessellation.hpp"

namespace polynya::simulation {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using geometry::Site;
using geometry::Vector;

/// A cell from which a floe is made.
struct Candidate {
  geometry::Ring ring;  ///< ring of the cell with its corners reduced, counter-clockwise [m]
  geometry::Point centroid;
  double area = 0;               ///< area of the ring [m²]
  double wanted = 0;             ///< area of the floe before all floes are scaled by a common factor [m²]
  double room = 0;               ///< largest area that the floe can have [m²]
  bool may_be_forbidden = true;  ///< true if the scaled ring may reach into areas kept clear or across the outline
};

/// The cells of a field, and the areas that they cover.
struct FieldLayout {
  std::vector<Candidate> candidates;
  double tiled_area = 0;   ///< area that the cells tile; the floes cover the concentration of it [m²]
  double region_area = 0;  ///< part of it in the region and not kept clear [m²]
  double cell_area = 0;    ///< area of the candidates before the gap is taken off [m²]
  int left_out = 0;        ///< number of floes whose cells found no space
};

// ---- cells of fields without a size law

// Each of these constants determines all fields without a size law, to the bit.
/// Largest deviation of the logarithm of a floe's size, in standard deviations [-]. Larger: single floes may be too
/// large for the region.
constexpr double kFarthestCellDeviation = 2.5;
/// Number of passes that move the sites. Fewer leave cells slender and their areas inaccurate.
constexpr int kRelaxations = 12;
/// Shortest edge of a floe, as a fraction of √(area of its cell) [-]. Smaller values leave very short edges.
constexpr double kShortestCellEdge = 0.1;

/// Returns e^x as (1 + x/2²⁰)^(2²⁰), accurate to 1e-6 for |x| ≲ 1. It uses only multiplication and addition, so that
/// fields do not depend on the C library. It is kept beside portable_exponential() because existing fields must not
/// change.
double exponential(double x) {
  double power = 1 + x * 0x1p-20;
  for (int i = 0; i < 20; ++i) power *= power;
  return power;
}
/// Returns ln(1 + x) for 0 ≤ x ≤ 1 as 2 artanh(x / (2 + x)), for the same reason.
double logarithm_of_one_plus(double x) {
  const double y = x / (2 + x);
  double sum = 0;
  double power = y;
  for (int k = 1; k < 40; k += 2) {
    sum += power / k;
    power *= y * y;
  }
  return 2 * sum;
}

/// Returns the areas of floes with log-normal sizes [m²].
std::vector<double> draw_areas(const FloeField& field, std::size_t count, Random& random) {
  const double variance = logarithm_of_one_plus(field.size_spread * field.size_spread);
  const double sigma = std::sqrt(variance);
  std::vector<double> areas(count);
  for (double& area : areas) {
    const double z = std::clamp(random.normal(), -kFarthestCellDeviation, kFarthestCellDeviation);
    const double size = field.floe_size * exponential(sigma * z - 0.5 * variance);
    area = size * size;
  }
  return areas;
}

/// Returns one site for each area: a lattice with random displacements, in rows.
std::vector<Site> first_sites(const Box& box, const std::vector<double>& areas, Random& random) {
  const Vector extent = box.high - box.low;
  const auto count = static_cast<double>(areas.size());
  const auto rows = static_cast<std::size_t>(
      std::clamp(std::round(std::sqrt(count * extent.y / extent.x)), 1.0, std::max(1.0, count)));
  std::vector<Site> sites;
  sites.reserve(areas.size());
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t in_row = (row + 1) * areas.size() / rows - row * areas.size() / rows;
    for (std::size_t k = 0; k < in_row; ++k) {
      const double x = (static_cast<double>(k) + random.uniform()) / static_cast<double>(in_row);
      const double y = (static_cast<double>(row) + random.uniform()) / static_cast<double>(rows);
      sites.push_back({box.low + Vector{x * extent.x, y * extent.y}, 0});
    }
  }
  return sites;
}

/// Returns cells whose areas approach `targets` [m²]. In each pass the sites move to the centroids of their cells, and
/// the weights follow the errors of the areas.
std::vector<Ring> relaxed_cells(std::vector<Site> sites, const std::vector<double>& targets, const Box& box) {
  std::vector<Ring> cells = power_diagram(sites, box);
  for (int pass = 0; pass < kRelaxations; ++pass) {
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const CellMeasures cell = cells[i].empty() ? CellMeasures{} : measure_convex(cells[i]);
      if (cell.area > 0) sites[i].point = cell.centroid;
      // The area of a hexagon grows by √3 per unit of weight while its neighbours keep theirs. A full correction would
      // be 1/√3 = 0.58 of the error; about half of it is taken. Weights do not change in the first pass, because sites
      // that are still close to each other could lose their cells.
      if (pass > 0) sites[i].weight += 0.3 * (targets[i] - cell.area);
    }
    cells = power_diagram(sites, box);
  }
  return cells;
}

/// Returns the smallest distance of a point inside a convex ring from the lines of its edges [m].
double least_distance_to_edges(const Ring& ring, Point inside) {
  double least = INFINITY;
  for_ring_edges(ring, [&](Point from, Point to) {
    least = std::min(least, cross(to - from, inside - from) / distance(from, to));
  });
  return least;
}

/// Returns the cells of a field without a size law. Sizes are drawn from a log-normal distribution, limited to 2.5
/// standard deviations of the logarithm. A power diagram with one site for each size tiles the bounding box of the
/// region; it is relaxed until the area of each cell is in proportion to that of its floe [Balzer2009, deGoes2012].
/// Sites without a cell are lost: none in 1000 up to a spread of 0.3, and 4 in 100 at 0.5, where the smallest floes
/// become smaller than drawn.
FieldLayout lattice_cells(const FloeField& field) {
  const Box box = bounding_box(field.region);
  // Consecutive seeds must not give shifted copies of the same sequence.
  Random random(Random(field.seed).next());
  const auto count = static_cast<std::size_t>(std::max(1.0, floe_count(field)));
  std::vector<double> areas = draw_areas(field, count, random);
  std::vector<Site> sites = first_sites(box, areas, random);
  double sum = 0;
  for (const double area : areas) sum += area;
  FieldLayout layout;
  layout.tiled_area = (box.high.x - box.low.x) * (box.high.y - box.low.y);
  layout.cell_area = layout.tiled_area;
  layout.region_area = geometry::signed_area(field.region);
  for (double& area : areas) area *= layout.tiled_area / sum;
  std::vector<Ring> rings = relaxed_cells(std::move(sites), areas, box);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (rings[i].empty()) continue;
    Candidate cell;
    cell.ring = std::move(rings[i]);
    reduce_corners(cell.ring, field.most_corners, kShortestCellEdge * std::sqrt(areas[i]));
    const CellMeasures measures = measure_convex(cell.ring);
    if (!(measures.area > 0)) continue;
    cell.centroid = measures.centroid;
    cell.area = measures.area;
    cell.wanted = field.concentration * areas[i];
    // If a ring shrinks by the factor s about a point at the distance d from an edge, the edge moves inwards by (1 − s)
    // d.
    const double s = 1 - 0.5 * field.gap / least_distance_to_edges(cell.ring, cell.centroid);
    if (s > 0) cell.room = s * s * cell.area;
    if (cell.room > 0) layout.candidates.push_back(std::move(cell));
  }
  return layout;
}

// ---- cells of fields with a size law

/// Shortest edge of a floe, as a fraction of its size [-]. Smaller values leave very short edges.
constexpr double kShortestFloeEdge = 0.03;
/// Smallest area of a cell, as a fraction of the area of its floe [-]. Smaller values leave floes at boundaries that
/// deviate much from the law. Larger values leave the boundaries without floes.
constexpr double kLeastAreaShare = 0.25;

/// Mean aspect of floes of which one, two, three … share a round cell that is cut across a random direction [-]. These
/// values were measured.
constexpr std::array kAspectOfStrips{1.27, 1.97, 2.9, 3.85, 4.83, 5.8};

/// A floe or a hole of the drawn packing.
struct Item {
  double area = 0;  ///< area that it should have [m²]
  bool is_floe = true;
};

/// Returns a plane along the longest edge of a region, so that the bounding box of a slanting channel is not much
/// larger than the channel.
Plane plane_along(const Ring& region) {
  Vector longest;
  for_ring_edges(region, [&](Point from, Point to) {
    if (squared_length(to - from) > squared_length(longest)) longest = to - from;
  });
  return {longest / length(longest), 1};
}

/// Returns the plane in which the cells of a field are made.
Plane plane_of(const FloeField& field, const Ring& region) {
  if (!field.orientation || !(field.aspect > 1)) return field.is_rectangle ? Plane{} : plane_along(region);
  const double turns = *field.orientation / (2 * std::numbers::pi);
  const auto [x, y] = portable_direction(turns - std::floor(turns));
  return {{x, y}, field.aspect};
}

/// Draws the floes and holes of a field, in ascending order of area. The floes cover the concentration of the free area
/// [m²].
std::vector<Item> draw_items(const FloeField& field, double free_area, Random& random) {
  const double wanted = field.concentration * free_area;
  const double packing = std::max(field.packing, field.concentration);
  const auto floes = static_cast<std::size_t>(std::max(1.0, std::round(wanted / mean_area(*field.law))));
  const auto holes =
      static_cast<std::size_t>(std::round(static_cast<double>(floes) * (packing / field.concentration - 1)));
  std::vector<Item> items;
  items.reserve(floes + holes);
  double sum = 0;
  for (const double area : draw_areas(*field.law, floes, random)) {
    items.push_back({area, true});
    sum += area;
  }
  for (const double area : draw_areas(*field.law, holes, random)) items.push_back({area, false});
  for (Item& item : items) item.area *= wanted / sum;
  std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.area < b.area; });
  return items;
}

/// Draws how many items share each cell: a number or the next larger one, so that the mean aspect is the field's.
std::vector<std::size_t> run_lengths(const FloeField& field, std::size_t count, Random& random) {
  std::size_t few = 1;
  double share_of_more = 0;
  if (!field.orientation) {
    while (few + 1 < kAspectOfStrips.size() && field.aspect >= kAspectOfStrips[few]) ++few;
    const double low = kAspectOfStrips[few - 1];
    share_of_more = std::clamp((field.aspect - low) / (kAspectOfStrips[few] - low), 0.0, 1.0);
  }
  // The fraction counts floes; longer runs contain more of them.
  const double runs_of_more =
      share_of_more * static_cast<double>(few) /
      (share_of_more * static_cast<double>(few) + (1 - share_of_more) * static_cast<double>(few + 1));
  std::vector<std::size_t> lengths;
  for (std::size_t left = count; left > 0; left -= lengths.back()) {
    const std::size_t length = random.uniform() < runs_of_more ? few + 1 : few;
    lengths.push_back(std::min(length, left));
  }
  return lengths;
}

/// Consecutive items that share a cell.
struct Run {
  std::size_t first = 0;
  std::size_t count = 1;
};

/// Returns the runs of a number of items in random order.
std::vector<Run> shuffled_runs(const FloeField& field, std::size_t count, Random& random) {
  std::vector<Run> runs;
  std::size_t first = 0;
  for (const std::size_t length : run_lengths(field, count, random)) {
    runs.push_back({first, length});
    first += length;
  }
  for (std::size_t i = runs.size(); i > 1; --i)
    std::swap(runs[i - 1], runs[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  return runs;
}

/// Adds the floe of a cell, moved inwards by half of the gap, unless the cell is too small for it.
void add_candidate(const FloeField& field, const Item& item, Ring ring, bool is_at_boundary, FieldLayout& layout) {
  const auto lose = [&layout] { ++layout.left_out; };
  if (ring.empty()) return lose();
  const double shortest = kShortestFloeEdge * std::sqrt(item.area);
  reduce_corners(ring, field.most_corners, shortest);
  const double cell_area = measure_convex(ring).area;
  Candidate candidate{inset(ring, 0.5 * field.gap), {}, 0, item.area, 0, is_at_boundary};
  if (candidate.ring.empty()) return lose();
  // Moving the edges inwards may have made some of them short.
  reduce_corners(candidate.ring, field.most_corners, shortest);
  const double whole = measure_convex(candidate.ring).area;
  add_corners(candidate.ring, field.least_corners);
  const CellMeasures measures = measure_convex(candidate.ring);
  if (!(measures.area >= kLeastAreaShare * item.area)) return lose();
  layout.cell_area += cell_area * measures.area / whole;
  candidate.centroid = measures.centroid;
  candidate.area = candidate.room = measures.area;
  layout.candidates.push_back(std::move(candidate));
}

/// Adds the floes of one part of a field's region.
void fill(const FloeField& field, const Ring& region, Random& random, FieldLayout& layout) {
  const double area = free_area(region, field.kept_clear);
  layout.region_area += area;
  if (!(area > 0)) return;
  const std::vector<Item> items = draw_items(field, area, random);
  const std::vector<Run> runs = shuffled_runs(field, items.size(), random);
  std::vector<double> areas(runs.size(), 0);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (std::size_t k = 0; k < runs[i].count; ++k) areas[i] += items[runs[i].first + k].area;
  }
  const Plane plane = plane_of(field, region);
  const FreeArea free(region, field.kept_clear, field.gap, plane);
  std::vector<FieldCell> cells = tessellate(free, areas, random);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Run& run = runs[i];
    Ring cell = plane.to_world(std::move(cells[i].ring));
    if (run.count == 1) {
      if (items[run.first].is_floe)
        add_candidate(field, items[run.first], std::move(cell), cells[i].is_clipped, layout);
      continue;
    }
    const auto [x, y] = portable_direction(random.uniform());
    std::vector<double> shares(run.count);
    for (std::size_t k = 0; k < run.count; ++k) shares[k] = items[run.first + k].area;
    std::vector<Ring> strips(run.count);
    if (!cell.empty()) strips = strips_of(cell, {x, y}, shares);
    for (std::size_t k = 0; k < run.count; ++k) {
      if (items[run.first + k].is_floe)
        add_candidate(field, items[run.first + k], std::move(strips[k]), cells[i].is_clipped, layout);
    }
  }
}

/// Returns the cells of a field with a size law. Cells for the drawn floes, and for as many holes as the packing
/// requires, tile the free area (tessellation.hpp). If the field has an aspect and no orientation, cells of two and
/// more floes are cut across a random direction. The corners of each floe's cell are reduced or cut off, and its edges
/// are moved inwards by half of the gap. Holes are drawn from the same law as floes, so that no size is preferred.
FieldLayout packed_cells(const FloeField& field) {
  Random random(Random(field.seed).next());
  FieldLayout layout;
  for (const Ring& part : field.parts.empty() ? std::vector<Ring>{field.region} : field.parts)
    fill(field, part, random, layout);
  layout.tiled_area = layout.region_area;
  return layout;
}

// ---- the floes in the cells

/// Areas in which floes may not be: nearer than the gap to areas kept clear, and across the outline of the region.
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
  double gap_;  ///< smallest distance from areas kept clear [m]
  std::vector<Box> boxes_;
};

/// Rules by which floes shrink where they are forbidden (Obstacles::forbid).
struct GivingWay {
  int tries = 1;        ///< number of sizes in which a floe is tried, each 3 % shorter, before it is left out
  int rounds = 1;       ///< number of rounds in which the other floes grow to replace the lost area
  double rounding = 0;  ///< distance by which floes may be nearer to areas kept clear than the gap [m]
};

/// Returns the rules of a field. With a law, cells are cut along boundaries, and rounding may place their edges across
/// them: floes shrink a little, in one round to no less than 0.97¹¹ = 0.72 of their length, and the others grow.
/// Without a law, cells ignore boundaries, and floes across one are left out.
GivingWay giving_way_of(const FloeField& field) {
  return field.law ? GivingWay{12, 4, 1e-9} : GivingWay{};
}

/// Returns the factor λ with Σ min(λ wanted, room) = total, found by bisection between 0 and 64 [-]. It is 64 if the
/// candidates have too little room for the total.
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

/// Returns the ring of a candidate scaled by a factor, or by a slightly smaller one if it would be forbidden. Returns
/// an empty ring if none of the tried sizes is permitted.
Ring permitted(const Obstacles& obstacles, const Candidate& candidate, double factor, int tries) {
  for (; tries > 0; --tries) {
    Ring floe = scaled(candidate.ring, candidate.centroid, factor);
    if (!candidate.may_be_forbidden || !obstacles.forbid(floe)) return floe;
    factor *= 0.97;
  }
  return {};
}

/// Makes the floes for a common factor. A candidate that had to be smaller, or was left out, is limited to that area
/// from now on. Returns true if there was such a candidate.
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

/// Makes the floes from the candidates, and computes their number and the mean and spread of their sizes.
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
