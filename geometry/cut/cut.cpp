#include "geometry/cut/cut.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "elementary/elementary.hpp"
#include "geometry/cut/internal/arrangement.hpp"
#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/cut/internal/snap_rounding.hpp"
#include "geometry/exact/internal/exact_polygon.hpp"
#include "geometry/exact/predicates.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/box_tree.hpp"

namespace polynya::geometry {
namespace {

// Returns true if a ring is strictly convex, counter-clockwise and goes around once: it then has no other defect.
bool is_convex(const Ring& ring) {
  const std::size_t n = ring.size();
  if (n < 3 || !are_usable(ring)) return false;
  int turns_back = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % n];
    const Point c = ring[(i + 2) % n];
    if (orientation(a, b, c) <= 0) return false;
    turns_back += precedes(a, b) != precedes(b, c) ? 1 : 0;
  }
  return turns_back == 2;
}

std::optional<DefectAt> find_tool_defect(const Polygon& tool) {
  if (tool.holes.empty() && is_convex(tool.outer)) return {};
  return find_defect(tool);
}

// Returns true if the polyline neither crosses nor touches itself; ends in one point count as touching.
bool is_simple(const std::vector<Point>& polyline) {
  if (polyline.size() == 2) return true;
  std::vector<Edge> edges;
  for (std::size_t i = 1; i < polyline.size(); ++i)
    edges.push_back({polyline[i - 1], polyline[i], 0, static_cast<int>(i)});
  return BoxTree(edges).for_each_pair([&](std::size_t i, std::size_t j) {
    const SegmentMeeting meeting = meet(edges[i].a, edges[i].b, edges[j].a, edges[j].b);
    if (meeting.kind == Meeting::kNone) return true;
    return j == i + 1 && meeting.kind == Meeting::kTouch;
  });
}

// Returns nullopt if the local path does not handle this configuration; the caller then uses the general path. The
// local path overlays segments only in order to round them, which CGAL may refuse.
std::optional<CutOutcome> try_locally(const Shape& shape, const Tool& tool) {
  try {
    return cut_locally(shape.polygon, tool);
  } catch (const exact::OverlayFailure&) {
    return {};
  }
}

// Cuts a valid shape by valid tools, with the first path that handles the case.
CutOutcome cut_by_valid(const Shape& shape, const std::vector<Polygon>& tools) {
  if (tools.size() == 1 && tools.front().holes.empty()) {
    if (auto outcome = try_locally(shape, {tools.front().outer, true})) return *std::move(outcome);
  }
  return cut_by_polygons_generally(exact::exactly(shape.polygon), tools);
}

// Returns the tool without rings that are nowhere near the shape and cut nothing of it; the local path may then
// suffice.
std::vector<Polygon> near_tools(const Shape& shape, const std::vector<Polygon>& tools) {
  const Box box = bounding_box(shape.polygon.outer);
  std::vector<Polygon> near;
  for (const Polygon& tool : tools) {
    if (!overlaps(bounding_box(tool.outer), box)) continue;
    near.push_back({tool.outer, {}});
    for (const Ring& hole : tool.holes) {
      if (overlaps(bounding_box(hole), box)) near.back().holes.push_back(hole);
    }
  }
  return near;
}

std::optional<DefectAt> find_shape_defect(const Shape& shape) {
  if (shape.known_valid) return {};
  return find_defect(shape.polygon);
}

using exact::Winding;

CutOutcome round_regions(const exact::Polygon& shape, std::vector<exact::Region> regions) {
  std::vector<exact::ExactPiece> pieces;
  pieces.reserve(regions.size());
  for (exact::Region& region : regions) {
    pieces.push_back({std::move(region.polygon), region.label == 1 ? Part::kInside : Part::kOutside});
  }
  return exact::rounded_pieces(exact::area(shape), pieces);
}

}  // namespace

CutOutcome cut_by_polygons_generally(const exact::Polygon& shape, const std::vector<Polygon>& tools_in_body) {
  return guarded([&]() -> CutOutcome {
    std::vector<exact::SourceSegment> segments;
    append_segments(segments, shape, 0);
    for (const Polygon& tool : tools_in_body) append_segments(segments, exact::exactly(tool), 1);
    const auto classify = [](Winding w) { return w.shape <= 0 ? -1 : (w.tool > 0 ? 1 : 0); };
    exact::Overlay overlay = exact::overlay(segments, classify, exact::Seams::kDissolve);
    if (std::ranges::none_of(overlay.regions, [](auto& r) { return r.label == 1; }))
      return refuse(CutFailure::kMisses, "the polygon does not meet the shape's interior");
    return round_regions(shape, std::move(overlay.regions));
  });
}

CutOutcome cut_along_generally(const exact::Polygon& shape, const std::vector<std::vector<Point>>& polylines_in_body) {
  return guarded([&]() -> CutOutcome {
    std::vector<exact::SourceSegment> segments;
    append_segments(segments, shape, 0);
    for (const std::vector<Point>& polyline : polylines_in_body) {
      for (std::size_t i = 1; i < polyline.size(); ++i) {
        const Point from = polyline[i - 1];
        const Point to = polyline[i];
        if (from != to) segments.push_back({exact::exactly(from), exact::exactly(to), 1});
      }
    }
    const auto classify = [](Winding w) { return w.shape <= 0 ? -1 : 0; };
    exact::Overlay overlay = exact::overlay(segments, classify, exact::Seams::kKeep);
    if (!overlay.tool_meets_interior)
      return refuse(CutFailure::kMisses, "the crack does not meet the shape's interior");
    if (overlay.regions.size() < 2) {
      return tl::unexpected(CutError{CutFailure::kDoesNotSeparate,
                                     "the crack ends inside the ice or only bridges its holes",
                                     overlay.dangling_length});
    }
    CutOutcome outcome = round_regions(shape, std::move(overlay.regions));
    if (outcome) outcome->ledger.dangling_length = overlay.dangling_length;
    return outcome;
  });
}

std::string_view name_of(CutFailure reason) {
  constexpr std::string_view kNames[]{"invalid-shape", "invalid-tool", "misses", "does-not-separate", "internal"};
  return kNames[static_cast<std::size_t>(reason)];
}

std::string to_string(const CutError& error) {
  return std::string(name_of(error.reason)) + ": " + error.detail;
}

CutOutcome cut_by_polygon(const Shape& shape, const Polygon& tool_in_body) {
  if (!tool_in_body.holes.empty()) return cut_by_polygons(shape, {tool_in_body});
  if (const auto found = find_shape_defect(shape)) return refuse(CutFailure::kInvalidShape, found->defect);
  if (const auto found = find_tool_defect(tool_in_body)) return refuse(CutFailure::kInvalidTool, found->defect);
  return cut_by_valid(shape, {tool_in_body});
}

CutOutcome cut_by_polygons(const Shape& shape, const std::vector<Polygon>& tools_in_body) {
  if (const auto found = find_shape_defect(shape)) return refuse(CutFailure::kInvalidShape, found->defect);
  for (const Polygon& tool : tools_in_body) {
    if (const auto found = find_tool_defect(tool)) return refuse(CutFailure::kInvalidTool, found->defect);
  }
  const std::vector<Polygon> near = near_tools(shape, tools_in_body);
  if (near.empty()) {
    return refuse(CutFailure::kMisses, "the polygon does not meet the shape's interior");
  }
  return cut_by_valid(shape, near);
}

CutOutcome cut_along(const Shape& shape, const std::vector<Point>& polyline_in_body) {
  if (const auto found = find_shape_defect(shape)) return refuse(CutFailure::kInvalidShape, found->defect);
  if (!are_usable(polyline_in_body)) return refuse(CutFailure::kInvalidTool, Defect::kNotFinite);
  std::vector<Point> crack = polyline_in_body;
  crack.erase(std::unique(crack.begin(), crack.end()), crack.end());
  if (crack.size() < 2) return refuse(CutFailure::kInvalidTool, Defect::kTooFewPoints);
  if (is_simple(crack)) {
    if (auto outcome = try_locally(shape, {crack, false})) return *std::move(outcome);
  }
  return cut_along_generally(exact::exactly(shape.polygon), {crack});
}

CutOutcome cut_along_all(const Shape& shape, const std::vector<std::vector<Point>>& polylines_in_body) {
  if (polylines_in_body.size() == 1) return cut_along(shape, polylines_in_body.front());
  if (const auto found = find_shape_defect(shape)) return refuse(CutFailure::kInvalidShape, found->defect);
  if (polylines_in_body.empty()) return refuse(CutFailure::kInvalidTool, Defect::kTooFewPoints);
  for (const std::vector<Point>& polyline : polylines_in_body)
    if (!are_usable(polyline)) return refuse(CutFailure::kInvalidTool, Defect::kNotFinite);
  return cut_along_generally(exact::exactly(shape.polygon), polylines_in_body);
}

Ring disc_polygon(Point centre, double radius, double sagitta, Vector axis) {
  // A chord that subtends an angle 2π/n deviates from the circle by r(1 − cos(π/n)).
  constexpr int kFewest = 8;   // fewer: the area of a cusp is smaller than the disc's by more than a tenth
  constexpr int kMost = 4096;  // more: a mistyped sagitta makes rings that no step can handle
  const double half_angle = elementary::acos(std::clamp(1 - sagitta / radius, -1.0, 1.0));
  const double wanted = half_angle > 0 ? std::ceil(std::numbers::pi / half_angle) : kMost;
  const int n = static_cast<int>(std::clamp(wanted, double{kFewest}, double{kMost}));
  Ring ring;
  ring.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    ring.push_back(centre + radius * rotate({axis.x, axis.y}, Vector{elementary::cos(angle), elementary::sin(angle)}));
  }
  return ring;
}

// ---- repair

namespace {

tl::expected<Repaired, CutError> repair_exactly(const std::vector<Ring>& rings, FillRule rule) {
  std::vector<exact::SourceSegment> segments;
  exact::Rational drawn = 0;
  for (const Ring& ring : rings) {
    append_segments(segments, exact::exactly(ring), 0);
    drawn += exact::area(ring);
  }
  const auto classify = [rule](exact::Winding w) {
    const bool is_filled = rule == FillRule::kNonZero ? w.shape != 0 : w.shape % 2 != 0;
    return is_filled ? 0 : -1;
  };
  std::vector<exact::ExactPiece> pieces;
  exact::Rational area = 0;
  for (exact::Region& region : exact::overlay(segments, classify, exact::Seams::kDissolve).regions) {
    area += exact::area(region.polygon);
    pieces.push_back({std::move(region.polygon), Part::kOutside});
  }
  Repaired repaired;
  CutOutcome rounded = exact::rounded_pieces(area, pieces);
  if (!rounded) return tl::unexpected(std::move(rounded.error()));
  for (Piece& piece : rounded->pieces) repaired.shapes.push_back(std::move(piece.shape));
  repaired.area_drawn = exact::nearest_double(exact::magnitude(drawn));
  repaired.area = rounded->ledger.area_outside;
  repaired.area_changed = exact::nearest_double(exact::Rational(area - exact::magnitude(drawn)));
  repaired.ledger = std::move(rounded->ledger);
  return repaired;
}

Ring oriented(Ring ring, int turn) {
  if (area_sign(ring) * turn < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

}  // namespace

tl::expected<Repaired, CutError> repair(const std::vector<Ring>& rings, FillRule rule) {
  std::vector<Ring> usable;
  for (const Ring& ring : rings) {
    if (!are_usable(ring)) return refuse(CutFailure::kInvalidShape, Defect::kNotFinite);
    if (Ring kept = without_repeats(ring); kept.size() > 2) usable.push_back(std::move(kept));
  }
  tl::expected<Repaired, CutError> repaired = guarded([&] { return repair_exactly(usable, rule); });
  if (!repaired || !repaired->shapes.empty()) return repaired;
  return refuse(CutFailure::kMisses, "the rings enclose nothing");
}

tl::expected<std::vector<Polygon>, CutError> union_of(const std::vector<Polygon>& polygons) {
  std::vector<Polygon> united;
  if (polygons.empty()) return united;
  std::vector<Ring> rings;
  for (const Polygon& polygon : polygons) std::ranges::copy(rings_of(polygon), std::back_inserter(rings));
  tl::expected<Repaired, CutError> repaired = repair(rings, FillRule::kNonZero);
  if (!repaired) return tl::unexpected(std::move(repaired.error()));
  for (Shape& shape : repaired->shapes) united.push_back(std::move(shape.polygon));
  return united;
}

std::vector<Ring> rings_of(const Polygon& polygon) {
  std::vector<Ring> rings{polygon.outer};
  rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
  return rings;
}

Ring without_repeats(const Ring& ring) {
  Ring kept = ring;
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
  return kept;
}

Polygon normalised(const Polygon& polygon) {
  // A ring that is not finite has no orientation; find_defect names it.
  const auto turned = [&](const Ring& ring, int turn) {
    return are_usable(ring) ? oriented(without_repeats(ring), turn) : ring;
  };
  Polygon result{turned(polygon.outer, 1), {}};
  for (const Ring& hole : polygon.holes) result.holes.push_back(turned(hole, -1));
  return result;
}

}  // namespace polynya::geometry
