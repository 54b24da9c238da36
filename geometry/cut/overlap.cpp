#include "geometry/cut/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "elementary/elementary.hpp"
#include "geometry/cut/internal/arrangement.hpp"
#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/predicates.hpp"
#include "geometry/shape/box_tree.hpp"
#include "geometry/shape/outline.hpp"

namespace polynya::geometry {
namespace {

exact::Ring placed(const exact::Ring& ring, const Pose& world_from_body) {
  using exact::Rational;
  const Rational c(world_from_body.rotation.cosine);
  const Rational s(world_from_body.rotation.sine);
  const exact::Point origin = exact::exactly(world_from_body.position);
  exact::Ring result;
  result.reserve(ring.size());
  for (const exact::Point& p : ring) {
    result.push_back({origin.x + c * p.x - s * p.y, origin.y + s * p.x + c * p.y});
  }
  return result;
}

exact::Polygon placed(const Shape& shape, const Pose& world_from_body) {
  const exact::Polygon body = exact::exactly(shape.polygon);
  exact::Polygon result{placed(body.outer, world_from_body), {}};
  for (const exact::Ring& hole : body.holes) result.holes.push_back(placed(hole, world_from_body));
  return result;
}

bool is_usable_at(const Shape& shape, const Pose& world_from_body) {
  return is_usable(world_from_body.position) && are_usable(shape.polygon.outer) &&
         std::ranges::all_of(shape.polygon.holes, [](const Ring& hole) { return are_usable(hole); });
}

// Returns the outer ring's box in the world, with a margin for the rounding of its own arithmetic.
Box box_in_world(const Shape& shape, const Pose& world_from_body) {
  const Box box = bounding_box(transform(world_from_body, shape.polygon.outer));
  const double size = length(box.high - box.low) + length(box.low - Point{}) + length(box.high - Point{});
  return grown(box, 1e-12 * size);
}

// b's outer ring in a's frame, in doubles, and its largest error there.
struct RingInFrame {
  Ring ring;
  Box box;
  double error = 0;  // [m]
};
RingInFrame ring_in_frame(const Pose& world_from_a, const Polygon& b, const Pose& world_from_b) {
  RingInFrame in_a;
  in_a.ring.reserve(b.outer.size());
  for (const Point p : b.outer) in_a.ring.push_back(inverse_transform(world_from_a, transform(world_from_b, p)));
  in_a.box = bounding_box(in_a.ring);
  in_a.error = 1e-12 * (length(in_a.box.low - Point{}) + length(in_a.box.high - Point{}) +
                        length(world_from_a.position - Point{}) + length(world_from_b.position - Point{}));
  return in_a;
}

// Returns true if `a` has an edge with all of `a` on its left and all of `b` on its right. Vertices of `a` may lie
// beyond the edge by `most_of_a`, those of `b` by `most_of_b` [m]; a negative value keeps them away from it.
bool has_separating_edge(const Ring& a, const Ring& b, double most_of_a, double most_of_b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Point from = a[i];
    const Vector edge = a[(i + 1) % a.size()] - from;
    const double size = length(edge);
    if (size == 0) continue;
    const auto side = [&](Point p) { return cross(edge, p - from); };
    if (std::ranges::all_of(b, [&](Point p) { return side(p) <= most_of_b * size; }) &&
        std::ranges::all_of(a, [&](Point p) { return side(p) >= -most_of_a * size; }))
      return true;
  }
  return false;
}

// Returns true if an edge of one ring leaves the other ring so far aside that rounding cannot be the reason: they share
// no point.
bool are_apart(const Ring& a, const RingInFrame& b) {
  double size = 0;
  for (const Point p : a) size = std::max({size, std::abs(p.x), std::abs(p.y)});
  const double off = b.error + 1e-12 * size;
  constexpr double kOverflow = 1e50;  ///< beyond it products may overflow [m]
  if (!(off < kOverflow)) return false;
  return has_separating_edge(a, b.ring, off, -4 * off) || has_separating_edge(b.ring, a, off, -4 * off);
}

// Returns one bit for each side of the box beyond which a point lies.
unsigned sides_beyond(Point p, const Box& box) {
  return (p.x < box.low.x ? 1U : 0U) | (p.x > box.high.x ? 2U : 0U) | (p.y < box.low.y ? 4U : 0U) |
         (p.y > box.high.y ? 8U : 0U);
}

bool overlap_deeply(const Box& a, const Box& b) {
  return std::min(a.high.x, b.high.x) - std::max(a.low.x, b.low.x) > kTouchingDepth &&
         std::min(a.high.y, b.high.y) - std::max(a.low.y, b.low.y) > kTouchingDepth;
}

/// Number of sides of the polygon that is drawn about a disc of the gap: its corners are 1/cos(15°), 4 % beyond the
/// disc. More: the corners of floes are rounder, and cuts are slower.
constexpr int kDiscSides = 12;
/// Smallest area that a gap cuts off [m²]; less is rounding. With 0, floes that already are a gap apart are cut again
/// and again.
constexpr double kLeastStrip = 1e-9;

/// Cuts a tool off a piece if more than `least_area` would be removed, and adds the remaining pieces to `left`. Returns
/// false if the piece is unchanged.
bool cut_off_piece(const Polygon& piece, const Polygon& tool, double least_area, Trimmed& trimmed,
                   std::vector<Polygon>& left) {
  CutOutcome cut = cut_by_polygon({.polygon = piece, .known_valid = true}, tool);
  if (!cut) {
    if (cut.error().reason != CutFailure::kMisses) trimmed.error = std::move(cut.error());
    return false;
  }
  const CutLedger& ledger = cut->ledger;
  if (ledger.area_inside + ledger.area_slivers <= least_area) return false;
  trimmed.area_trimmed += ledger.area_inside + ledger.area_slivers;
  trimmed.rounding_defect += ledger.rounding_defect;
  for (Piece& part : cut->pieces) {
    if (part.part == Part::kOutside) left.push_back(std::move(part.shape.polygon));
  }
  return true;
}

/// Cuts a tool off the remaining pieces of a polygon. Returns true if any was cut.
bool cut_off(const Polygon& tool, double least_area, Trimmed& trimmed) {
  const Box box = bounding_box(tool.outer);
  bool is_cut = false;
  std::vector<Polygon> left;
  for (Polygon& piece : trimmed.pieces) {
    if (trimmed.error || !overlaps(bounding_box(piece.outer), box) ||
        !cut_off_piece(piece, tool, least_area, trimmed, left))
      left.push_back(std::move(piece));
    else
      is_cut = true;
  }
  trimmed.pieces = std::move(left);
  if (trimmed.error) trimmed.pieces.clear();
  return is_cut;
}

/// Returns a polygon that contains every point closer to the edge than the gap.
Polygon around_edge(Point a, Point b, double gap) {
  const double reach = gap * (1 + 1e-9) / elementary::cos(std::numbers::pi / kDiscSides);
  std::vector<Point> corners;
  for (int i = 0; i < kDiscSides; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / kDiscSides;
    const Vector arm{reach * elementary::cos(angle), reach * elementary::sin(angle)};
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

/// Cuts a strip of the width of the gap along a ring off a polygon, where the two are near each other.
bool cut_off_strip(const Ring& ring, double gap, Trimmed& trimmed) {
  bool is_cut = false;
  for_ring_edges(ring, [&](Point a, Point b) {
    if (trimmed.pieces.empty() || !overlaps(grown(box_around(a, b), gap), box_of(trimmed.pieces))) return;
    is_cut = cut_off(around_edge(a, b, gap), kLeastStrip, trimmed) || is_cut;
  });
  return is_cut;
}

/// Returns the indices ordered by area, the largest first; of equal ones the first.
std::vector<std::size_t> by_area(const std::vector<Polygon>& polygons) {
  std::vector<double> areas;
  areas.reserve(polygons.size());
  for (const Polygon& polygon : polygons) areas.push_back(measure(polygon).area);
  std::vector<std::size_t> order(polygons.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return areas[i] > areas[j]; });
  return order;
}

/// Tolerance, as a fraction of an edge's length, within which a vertex touches the end of the edge [-]. Without it two
/// corners may pass each other.
constexpr double kEndSlack = 1e-9;
/// Further displacement after which a touch must have become an overlap [m]. Larger: thin tips pass through and their
/// touch is not confirmed. Smaller: the overlap is below kLeastShared (their ratio is a contact 1 µm wide).
constexpr double kFurtherOn = 1e-3;
/// Smallest area that counts as shared [m²]; less is the rounding of outlines that slide along each other. With 0 these
/// would touch at once.
constexpr double kLeastShared = 1e-9;

Vector outward_of(const Ring& ring, std::size_t edge) {
  const Vector along = ring[(edge + 1) % ring.size()] - ring[edge];
  return -perpendicular(along) / length(along);
}

/// Returns when a vertex moving at `velocity` reaches an edge of a counter-clockwise ring from outside, if ever [s].
std::optional<double> entry_time(Point vertex, Vector velocity, const Ring& ring, std::size_t edge) {
  const Point start = ring[edge];
  const Vector outward = outward_of(ring, edge);
  const double speed_in = -dot(velocity, outward);
  if (!(speed_in > 0)) return {};
  const double time = dot(vertex - start, outward) / speed_in;
  const double along = dot(vertex + time * velocity - start, perpendicular(outward));
  const double size = distance(start, ring[(edge + 1) % ring.size()]);
  if (along < -kEndSlack * size || along > (1 + kEndSlack) * size) return {};
  return time;
}

/// Returns the contacts of every vertex of one ring with every edge of the other.
std::vector<FirstContact> meetings(const Ring& a, const Ring& b, Vector velocity, double from, double until) {
  std::vector<FirstContact> found;
  const auto collect = [&](const Ring& moving, const Ring& resting, Vector relative, bool is_b_resting) {
    for (std::size_t i = 0; i < resting.size(); ++i) {
      for (const Point vertex : moving) {
        const auto time = entry_time(vertex, relative, resting, i);
        if (!time || *time < from || *time > until) continue;
        if (is_b_resting)
          found.push_back({*time, vertex, -outward_of(resting, i)});
        else
          found.push_back({*time, vertex + *time * relative, outward_of(resting, i)});
      }
    }
  };
  collect(b, a, velocity, false);
  collect(a, b, -velocity, true);
  std::ranges::stable_sort(found, {}, &FirstContact::time);
  return found;
}

}  // namespace

tl::expected<Overlap, CutError> overlap(const Shape& a, const Pose& world_from_a, const Shape& b,
                                        const Pose& world_from_b) {
  if (!overlaps(box_in_world(a, world_from_a), box_in_world(b, world_from_b))) return Overlap{0, "0"};
  // This is checked here, because CGAL leaks memory if it detects it itself.
  if (!is_usable_at(a, world_from_a) || !is_usable_at(b, world_from_b))
    return refuse(CutFailure::kInvalidShape, Defect::kNotFinite);
  return guarded([&]() -> tl::expected<Overlap, CutError> {
    std::vector<exact::SourceSegment> segments;
    append_segments(segments, placed(a, world_from_a), 0);
    append_segments(segments, placed(b, world_from_b), 1);
    const auto shared = [](exact::Winding w) { return w.shape > 0 && w.tool > 0 ? 0 : -1; };
    exact::Rational sum = 0;
    for (const exact::Region& region : exact::overlay(segments, shared, exact::Seams::kDissolve).regions)
      sum += exact::area(region.polygon);
    return Overlap{exact::nearest_double(sum), exact::digits_of(sum)};
  });
}

tl::expected<double, CutError> shared_area(const Polygon& a, const Pose& world_from_a, const Polygon& b,
                                           const Pose& world_from_b) {
  if (vertex_count(a) < vertex_count(b)) return shared_area(b, world_from_b, a, world_from_a);
  const RingInFrame b_in_a = ring_in_frame(world_from_a, b, world_from_b);
  const Box box = grown(b_in_a.box, b_in_a.error);
  Polygon near{near_part(a.outer, box), {}};
  if (near.outer.size() < 3 || are_apart(near.outer, b_in_a)) return 0;
  for (const Ring& hole : a.holes) {
    if (Ring part = near_part(hole, box); part.size() > 2) near.holes.push_back(std::move(part));
  }
  // The near part may cross itself, which overlap() allows. Where its winding differs from the whole ring's, b does not
  // wind at all.
  return overlap({.polygon = std::move(near)}, world_from_a, {.polygon = b}, world_from_b).map(&Overlap::area);
}

Ring near_part(const Ring& ring, const Box& box) {
  if (ring.empty()) return {};
  Ring kept{ring.front()};
  Point last = ring.front();  // last point of the run that starts at kept.back()
  unsigned run = sides_beyond(last, box);
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const unsigned sides = sides_beyond(ring[i], box);
    if ((run & sides) == 0 && last != kept.back()) {
      kept.push_back(last);
      run = sides_beyond(last, box);
    }
    if ((run & sides) == 0) {
      kept.push_back(ring[i]);
      run = sides;
    } else {
      run &= sides;
    }
    last = ring[i];
  }
  if (last != kept.back()) kept.push_back(last);
  return kept;
}

std::vector<OverlappingPair> find_overlapping_pairs(const std::vector<Polygon>& polygons, std::size_t most) {
  std::vector<OverlappingPair> found;
  if (polygons.empty()) return found;
  const std::vector<Box> boxes = boxes_of(polygons, [](const Polygon& p) { return bounding_box(p.outer); });
  for (const auto& [i, j] : pairs_of_boxes(boxes)) {
    if (found.size() >= most) break;
    const Polygon& p = polygons[i];
    const Polygon& q = polygons[j];
    if (!overlap_deeply(boxes[i], boxes[j]) || has_separating_edge(p.outer, q.outer, kTouchingDepth, kTouchingDepth) ||
        has_separating_edge(q.outer, p.outer, kTouchingDepth, kTouchingDepth))
      continue;
    const auto cut = cut_by_polygon({p}, q);
    if (!cut && cut.error().reason == CutFailure::kMisses) continue;
    const double area = cut ? cut->ledger.area_inside : std::numeric_limits<double>::quiet_NaN();
    if (!(area <= kTouchingArea)) found.push_back({i, j, area});
  }
  return found;
}

std::vector<Trimmed> make_disjoint(const std::vector<Polygon>& polygons, double gap) {
  std::vector<Trimmed> result(polygons.size());
  const auto grown_box = [gap](const Polygon& polygon) { return grown(bounding_box(polygon.outer), 0.6 * gap); };
  const std::vector<std::size_t> order = by_area(polygons);
  std::vector<std::size_t> rank(polygons.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
  std::vector<std::vector<std::size_t>> larger(polygons.size());  // larger polygons whose boxes overlap, by polygon
  for (const auto& [a, b] : pairs_of_boxes(boxes_of(polygons, grown_box))) {
    const bool is_a_larger = rank[a] < rank[b];
    larger[is_a_larger ? b : a].push_back(is_a_larger ? a : b);
  }
  for (const std::size_t i : order) {
    result[i].pieces = {polygons[i]};
    std::sort(larger[i].begin(), larger[i].end());
    for (const std::size_t other : larger[i]) {
      bool is_cut = false;
      for (const Polygon& piece : result[other].pieces) {
        is_cut = cut_off(piece, kTouchingArea, result[i]) || is_cut;
        if (gap > 0) {
          is_cut = cut_off_strip(piece.outer, gap, result[i]) || is_cut;
          for (const Ring& hole : piece.holes) is_cut = cut_off_strip(hole, gap, result[i]) || is_cut;
        }
      }
      if (is_cut) result[i].yields.push_back(other);
    }
  }
  return result;
}

std::optional<FirstContact> first_contact(const Ring& a, const Ring& b, Vector velocity, double from, double until) {
  if (velocity == Vector{}) return {};
  for (const FirstContact& touch : meetings(a, b, velocity, from, until)) {
    const double later = touch.time + kFurtherOn / length(velocity);
    const auto shared = overlap({{a, {}}}, {}, {{b, {}}}, {Point{} + later * velocity, {}});
    if (!shared || shared->area > kLeastShared) return touch;
  }
  return {};
}

}  // namespace polynya::geometry
