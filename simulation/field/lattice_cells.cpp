#include <algorithm>
#include <cmath>

#include "geometry/exact/measures.hpp"
#include "geometry/shape/power_diagram.hpp"
#include "simulation/field/cells.hpp"
#include "simulation/field/convex.hpp"
#include "simulation/field/random.hpp"

namespace polynya::simulation {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Ring;
using geometry::Site;
using geometry::Vector;

// Every one of these changes all fields without a size law, to the bit.
constexpr double kFarthestCellDeviation = 2.5;  ///< of the logarithm of a floe's size, in standard deviations
constexpr int kRelaxations = 12;                ///< fewer leave cells slender and off their areas
constexpr double kShortestCellEdge = 0.1;       ///< of a floe, in sizes of its cell; smaller leaves slivers of edges

/// e^x for moderate x, without a library's: (1 + x/2²⁰)^(2²⁰), to 1e-6.
double exponential(double x) {
  double power = 1 + x * 0x1p-20;
  for (int i = 0; i < 20; ++i) power *= power;
  return power;
}
/// ln(1 + x) for 0 ≤ x ≤ 1, likewise: 2 artanh(x / (2 + x)).
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

/// Lognormal floe areas [m²].
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

/// As many points as there are areas, in rows of a shaken lattice.
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

/// Cells whose areas approach `targets` [m²]: sites move to their centroids while weights follow the areas'
/// errors.
std::vector<Ring> relaxed_cells(std::vector<Site> sites, const std::vector<double>& targets, const Box& box) {
  std::vector<Ring> cells = power_diagram(sites, box);
  for (int pass = 0; pass < kRelaxations; ++pass) {
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const CellMeasures cell = cells[i].empty() ? CellMeasures{} : measure_convex(cells[i]);
      if (cell.area > 0) sites[i].point = cell.centroid;
      // A hexagon's area grows by √3 per unit of weight while its neighbours stay. Weights wait until the
      // sites have spread: too early, they would leave close sites without a cell.
      if (pass > 0) sites[i].weight += 0.3 * (targets[i] - cell.area);
    }
    cells = power_diagram(sites, box);
  }
  return cells;
}

double least_distance_to_edges(const Ring& ring, Point inside) {
  double least = INFINITY;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector edge = ring[(i + 1) % ring.size()] - ring[i];
    least = std::min(least, cross(edge, inside - ring[i]) / length(edge));
  }
  return least;
}

}  // namespace

FieldLayout lattice_cells(const FloeField& field) {
  const Box box = bounding_box(field.region);
  // Consecutive seeds must not give shifted copies of one sequence.
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
    // Shrunk by s about a point at distance d from an edge, the edge moves in by (1 − s) d.
    const double s = 1 - 0.5 * field.gap / least_distance_to_edges(cell.ring, cell.centroid);
    if (s > 0) cell.room = s * s * cell.area;
    if (cell.room > 0) layout.candidates.push_back(std::move(cell));
  }
  return layout;
}

}  // namespace polynya::simulation
