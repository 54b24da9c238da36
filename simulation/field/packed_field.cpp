#include "simulation/field/packed_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "simulation/field/convex.hpp"
#include "simulation/field/filling.hpp"
#include "simulation/field/free_area.hpp"
#include "simulation/field/obstacles.hpp"
#include "simulation/field/portable_math.hpp"
#include "simulation/field/tessellation.hpp"

namespace polynya::simulation {
namespace {

using geometry::Point;
using geometry::Ring;
using geometry::Vector;

constexpr double kShortestEdge = 0.03;  ///< of a floe, in sizes
constexpr double kLeastShare = 0.25;    ///< of a floe's area that its cell must have room for

/// Of floes one, two, three … of which share a round cell, cut across a random direction: measured.
constexpr std::array kAspectOfStrips{1.27, 1.97, 2.9, 3.85, 4.83, 5.8};

/// A floe that was drawn, or a hole.
struct Item {
  double area = 0;  ///< [m²]
  bool is_floe = true;
};

/// A floe in the making: its cell less half the gap, the area it should have and the most it can have.
struct Candidate {
  Ring ring;
  Point centroid;
  double wanted = 0;
  double most = 0;  ///< of its ring [m²]
  double room = 0;  ///< that it can have [m²]
  bool is_at_boundary = false;
};

/// What the parts of a field add up to.
struct Making {
  std::vector<Candidate> candidates;
  double free_area = 0;  ///< [m²]
  double cell_area = 0;  ///< of the candidates, before the gap is taken off [m²]
  int left_out = 0;
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

void add_candidate(const FloeField& field, const Item& item, Ring ring, bool is_at_boundary, Making& making) {
  const auto lose = [&making] { ++making.left_out; };
  if (ring.empty()) return lose();
  const double shortest = kShortestEdge * std::sqrt(item.area);
  reduce_corners(ring, field.most_corners, shortest);
  const double cell_area = measure_convex(ring).area;
  Candidate candidate{inset(ring, 0.5 * field.gap), {}, item.area, 0, 0, is_at_boundary};
  if (candidate.ring.empty()) return lose();
  reduce_corners(candidate.ring, field.most_corners, shortest);  // edges that the gap made short
  const double whole = measure_convex(candidate.ring).area;
  add_corners(candidate.ring, field.least_corners);
  const CellMeasures measures = measure_convex(candidate.ring);
  if (!(measures.area >= kLeastShare * item.area)) return lose();
  making.cell_area += cell_area * measures.area / whole;
  candidate.centroid = measures.centroid;
  candidate.most = candidate.room = measures.area;
  making.candidates.push_back(std::move(candidate));
}

/// Adds the floes of one part of the region.
void fill(const FloeField& field, const Ring& region, Random& random, Making& making) {
  const double area = free_area(region, field.kept_clear);
  making.free_area += area;
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
        add_candidate(field, items[run.first], std::move(cell), cells[i].is_clipped, making);
      continue;
    }
    const auto [x, y] = portable_direction(random.uniform());
    std::vector<double> shares(run.count);
    for (std::size_t k = 0; k < run.count; ++k) shares[k] = items[run.first + k].area;
    std::vector<Ring> strips(run.count);
    if (!cell.empty()) strips = strips_of(cell, {x, y}, shares);
    for (std::size_t k = 0; k < run.count; ++k) {
      if (items[run.first + k].is_floe)
        add_candidate(field, items[run.first + k], std::move(strips[k]), cells[i].is_clipped, making);
    }
  }
}

/// The candidate at a factor, or a little smaller where it would come too near to what is kept clear: the
/// corners of its cell were cut by straight lines. Nothing where that does not help.
Ring clear_of(const Obstacles& obstacles, const Candidate& candidate, double factor) {
  constexpr int kTries = 12;
  for (int i = 0; i < kTries; ++i) {
    Ring floe = scaled(candidate.ring, candidate.centroid, factor);
    if (!obstacles.forbid(floe)) return floe;
    factor *= 0.97;
  }
  return {};
}

/// The floes at a common factor. A candidate that had to be smaller, or left out, has no more room than that
/// from now on; true where there was one.
bool shrink_candidates(const Obstacles& obstacles, double factor, std::vector<Candidate>& candidates,
                       std::vector<Ring>& floes) {
  bool was_any = false;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Candidate& candidate = candidates[i];
    floes[i].clear();
    if (candidate.room <= 0) continue;
    const double area = std::min(factor * candidate.wanted, candidate.room);
    const double shrunk = std::sqrt(area / candidate.most);
    floes[i] = candidate.is_at_boundary ? clear_of(obstacles, candidate, shrunk)
                                        : scaled(candidate.ring, candidate.centroid, shrunk);
    const double left = floes[i].empty() ? 0 : measure_convex(floes[i]).area;
    if (left >= area * (1 - 1e-9)) continue;
    candidate.room = left;
    was_any = true;
  }
  return was_any;
}

/// Adds the floes that the candidates become. Where what is kept clear takes some of their room, the others
/// make up.
void add_floes(const FloeField& field, Making& making, FloeFieldOutcome& outcome) {
  constexpr int kRounds = 4;
  FloeField with_rounding = field;  // floes that keep the gap but for rounding pass
  with_rounding.gap = std::max(0.0, field.gap - 1e-9);
  const Obstacles obstacles(with_rounding);
  std::vector<Ring> floes(making.candidates.size());
  for (int round = 0; round < kRounds; ++round) {
    const double factor =
        common_factor(making.candidates, &Candidate::room, field.concentration * making.free_area);
    if (!shrink_candidates(obstacles, factor, making.candidates, floes)) break;
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
  enter_sizes(size_sum, outcome);
}

}  // namespace

FloeFieldOutcome make_packed_field(const FloeField& field) {
  Random random(Random(field.seed).next());
  Making making;
  if (field.parts.empty()) {
    fill(field, field.region, random, making);
  } else {
    for (const Ring& part : field.parts) fill(field, part, random, making);
  }
  FloeFieldOutcome outcome;
  outcome.region_area = making.free_area;
  outcome.left_out = making.left_out;
  if (!(making.free_area > 0)) return outcome;
  double most = 0;
  for (const Candidate& candidate : making.candidates) most += candidate.most;
  outcome.reachable_concentration = most / making.free_area;
  outcome.reachable_without_gap = making.cell_area / making.free_area;
  add_floes(field, making, outcome);
  if (outcome.count == 0) return outcome;
  outcome.statistics = statistics_of(*field.law, outcome.floes);
  return outcome;
}

}  // namespace polynya::simulation
