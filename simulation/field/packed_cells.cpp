#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "simulation/field/cells.hpp"
#include "simulation/field/convex.hpp"
#include "simulation/field/free_area.hpp"
#include "simulation/field/portable_math.hpp"
#include "simulation/field/tessellation.hpp"

namespace polynya::simulation {
namespace {

using geometry::Point;
using geometry::Ring;
using geometry::Vector;

constexpr double kShortestFloeEdge = 0.03;  ///< of a floe, in sizes; smaller leaves slivers of edges
/// Of a floe's area that its cell must have room for. Smaller, and floes far off the law stand at boundaries;
/// larger, and boundaries are left bare.
constexpr double kLeastShare = 0.25;

/// Of floes one, two, three … of which share a round cell, cut across a random direction: measured.
constexpr std::array kAspectOfStrips{1.27, 1.97, 2.9, 3.85, 4.83, 5.8};

/// A floe that was drawn, or a hole.
struct Item {
  double area = 0;  ///< [m²]
  bool is_floe = true;
};

/// Along the longest edge, so that a slanting channel's box is not much larger than the channel.
Plane plane_along(const Ring& region) {
  Vector longest;
  for (std::size_t i = 0; i < region.size(); ++i) {
    const Vector edge = region[(i + 1) % region.size()] - region[i];
    if (squared_length(edge) > squared_length(longest)) longest = edge;
  }
  return {longest / length(longest), 1};
}

Plane plane_of(const FloeField& field, const Ring& region) {
  if (!field.orientation || !(field.aspect > 1)) return field.is_rectangle ? Plane{} : plane_along(region);
  const double turns = *field.orientation / (2 * std::numbers::pi);
  const auto [x, y] = portable_direction(turns - std::floor(turns));
  return {{x, y}, field.aspect};
}

/// Floes and holes, ascending in area. The floes cover what is asked for.
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

/// Runs of the items that share a cell: all of one, or of as many as give the aspect on average.
std::vector<std::size_t> run_lengths(const FloeField& field, std::size_t count, Random& random) {
  std::size_t few = 1;
  double share_of_more = 0;
  if (!field.orientation) {
    while (few + 1 < kAspectOfStrips.size() && field.aspect >= kAspectOfStrips[few]) ++few;
    const double low = kAspectOfStrips[few - 1];
    share_of_more = std::clamp((field.aspect - low) / (kAspectOfStrips[few] - low), 0.0, 1.0);
  }
  // The share is of floes, and runs of more hold more of them.
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

/// Items that share a cell.
struct Run {
  std::size_t first = 0;
  std::size_t count = 1;
};

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

void add_candidate(const FloeField& field, const Item& item, Ring ring, bool is_at_boundary, FieldLayout& layout) {
  const auto lose = [&layout] { ++layout.left_out; };
  if (ring.empty()) return lose();
  const double shortest = kShortestFloeEdge * std::sqrt(item.area);
  reduce_corners(ring, field.most_corners, shortest);
  const double cell_area = measure_convex(ring).area;
  Candidate candidate{inset(ring, 0.5 * field.gap), {}, 0, item.area, 0, is_at_boundary};
  if (candidate.ring.empty()) return lose();
  reduce_corners(candidate.ring, field.most_corners, shortest);  // edges that the gap made short
  const double whole = measure_convex(candidate.ring).area;
  add_corners(candidate.ring, field.least_corners);
  const CellMeasures measures = measure_convex(candidate.ring);
  if (!(measures.area >= kLeastShare * item.area)) return lose();
  layout.cell_area += cell_area * measures.area / whole;
  candidate.centroid = measures.centroid;
  candidate.area = candidate.room = measures.area;
  layout.candidates.push_back(std::move(candidate));
}

/// Adds the floes of one part of the region.
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

}  // namespace

FieldLayout packed_cells(const FloeField& field) {
  Random random(Random(field.seed).next());
  FieldLayout layout;
  for (const Ring& part : field.parts.empty() ? std::vector<Ring>{field.region} : field.parts)
    fill(field, part, random, layout);
  layout.tiled_area = layout.region_area;
  return layout;
}

}  // namespace polynya::simulation
