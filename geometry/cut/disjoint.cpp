#include "geometry/cut/disjoint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "geometry/cut/overlapping_pairs.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/shape/box_pairs.hpp"
#include "geometry/shape/convex_hull.hpp"

namespace polynya::geometry {
namespace {

constexpr int kDiscSides = 12;  ///< of the polygon about a disc of the gap: its corners reach 1/cos(15°)
constexpr double kLeastStrip = 1e-9;  ///< what a gap takes less of is rounding [m²]

/// Cuts tools off one polygon.
class Trimmer {
 public:
  Trimmer(const Polygon& polygon, Trimmed& trimmed) : trimmed_(trimmed) { trimmed_.pieces = {polygon}; }

  /// Whether it was cut.
  bool cut_off(const Polygon& tool, double least_area) {
    const Box box = bounding_box(tool.outer);
    bool is_cut = false;
    std::vector<Polygon> left;
    for (Polygon& piece : trimmed_.pieces) {
      if (trimmed_.error || !overlaps(bounding_box(piece.outer), box) ||
          !cut_piece(piece, tool, least_area, left))
        left.push_back(std::move(piece));
      else
        is_cut = true;
    }
    trimmed_.pieces = std::move(left);
    if (trimmed_.error) trimmed_.pieces.clear();
    return is_cut;
  }

 private:
  bool cut_piece(const Polygon& piece, const Polygon& tool, double least_area, std::vector<Polygon>& left) {
    CutOutcome cut = cut_by_polygon({.polygon = piece, .known_valid = true}, tool);
    if (!cut) {
      if (cut.error().reason != CutFailure::kMisses) trimmed_.error = std::move(cut.error());
      return false;
    }
    const CutLedger& ledger = cut->ledger;
    if (ledger.area_inside + ledger.area_slivers <= least_area) return false;
    trimmed_.area_trimmed += ledger.area_inside + ledger.area_slivers;
    trimmed_.rounding_defect += ledger.rounding_defect;
    for (Piece& part : cut->pieces) {
      if (part.part == Part::kOutside) left.push_back(std::move(part.shape.polygon));
    }
    return true;
  }

  Trimmed& trimmed_;
};

/// A polygon that contains every point nearer to the edge than the gap.
Polygon around_edge(Point a, Point b, double gap) {
  const double reach = gap * (1 + 1e-9) / std::cos(std::numbers::pi / kDiscSides);
  std::vector<Point> corners;
  for (int i = 0; i < kDiscSides; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / kDiscSides;
    const Vector arm{reach * std::cos(angle), reach * std::sin(angle)};
    corners.push_back(a + arm);
    corners.push_back(b + arm);
  }
  return {convex_hull(corners), {}};
}

Box box_of(const std::vector<Polygon>& pieces) {
  Box box = bounding_box(pieces.front().outer);
  for (const Polygon& piece : pieces) extend(box, bounding_box(piece.outer));
  return box;
}

/// Cuts a strip of the gap along a ring off a polygon, where the two are near each other.
bool cut_off_strip(const Ring& ring, double gap, Trimmer& trimmer, const Trimmed& trimmed) {
  bool is_cut = false;
  for (std::size_t i = 0; i < ring.size() && !trimmed.pieces.empty(); ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    if (!overlaps(grown(box_around(a, b), gap), box_of(trimmed.pieces))) continue;
    is_cut = trimmer.cut_off(around_edge(a, b, gap), kLeastStrip) || is_cut;
  }
  return is_cut;
}

/// The larger first, of equal ones the first.
std::vector<std::size_t> by_area(const std::vector<Polygon>& polygons) {
  std::vector<double> areas;
  areas.reserve(polygons.size());
  for (const Polygon& polygon : polygons) areas.push_back(measure(polygon).area);
  std::vector<std::size_t> order(polygons.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return areas[i] > areas[j]; });
  return order;
}

}  // namespace

std::vector<Trimmed> make_disjoint(const std::vector<Polygon>& polygons, double gap) {
  std::vector<Trimmed> result(polygons.size());
  std::vector<Box> boxes;
  boxes.reserve(polygons.size());
  for (const Polygon& polygon : polygons) boxes.push_back(grown(bounding_box(polygon.outer), 0.6 * gap));
  const std::vector<std::size_t> order = by_area(polygons);
  std::vector<std::size_t> rank(polygons.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
  std::vector<std::vector<std::size_t>> larger(polygons.size());  // those whose boxes meet, by polygon
  for (const auto& [a, b] : pairs_of_boxes(boxes)) {
    const bool is_a_larger = rank[a] < rank[b];
    larger[is_a_larger ? b : a].push_back(is_a_larger ? a : b);
  }
  for (const std::size_t i : order) {
    Trimmer trimmer(polygons[i], result[i]);
    std::sort(larger[i].begin(), larger[i].end());
    for (const std::size_t other : larger[i]) {
      bool is_cut = false;
      for (const Polygon& piece : result[other].pieces) {
        is_cut = trimmer.cut_off(piece, kTouchingArea) || is_cut;
        if (gap > 0) {
          is_cut = cut_off_strip(piece.outer, gap, trimmer, result[i]) || is_cut;
          for (const Ring& hole : piece.holes)
            is_cut = cut_off_strip(hole, gap, trimmer, result[i]) || is_cut;
        }
      }
      if (is_cut) result[i].yields.push_back(other);
    }
  }
  return result;
}

}  // namespace polynya::geometry
