#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/cut/cut.hpp"
#include "geometry/cut/internal/arrangement.hpp"
#include "geometry/exact/internal/exact_polygon.hpp"
#include "geometry/exact/validity.hpp"

namespace polynya::geometry {

inline tl::unexpected<CutError> refuse(CutFailure reason, std::string detail) {
  return tl::unexpected(CutError{reason, std::move(detail)});
}
inline tl::unexpected<CutError> refuse(CutFailure reason, Defect defect) {
  return refuse(reason, std::string(name_of(defect)));
}

/// Calls work() and returns its result, or the error kInternal if it throws OverlayFailure. Other exceptions, such as
/// those from a lack of memory or a defect in the program, are not caught.
template <typename Work>
auto guarded(Work work) -> decltype(work()) {
  try {
    return work();
  } catch (const exact::OverlayFailure& failure) {
    return refuse(CutFailure::kInternal, failure.what());
  }
}

/// The general path: CGAL overlays the whole shape and the tools exactly. It handles every valid input and takes tens
/// of milliseconds for thousands of vertices. It is used for several tools, tools with holes, polylines that cross
/// themselves, and where the local path does not handle the case. The caller has checked that the arguments are valid.
/// A failure of CGAL is returned as kInternal; a tool that misses or a crack that separates nothing as the error that
/// cut.hpp states.
CutOutcome cut_by_polygons_generally(const exact::Polygon& shape, const std::vector<Polygon>& tools_in_body);
CutOutcome cut_along_generally(const exact::Polygon& shape, const std::vector<std::vector<Point>>& polylines_in_body);

/// The cutting tool of a local cut: a simple counter-clockwise ring, or a simple open polyline.
struct Tool {
  const Ring& points;
  bool is_closed = false;

  int edge_count() const { return static_cast<int>(points.size()) - (is_closed ? 0 : 1); }
  /// Returns point i, where i may run one turn over either end of a closed tool.
  Point point(int i) const {
    const int n = static_cast<int>(points.size());
    return points[static_cast<std::size_t>(i < 0 ? i + n : (i >= n ? i - n : i))];
  }
};

/// The local path. It finds where the tool touches or crosses the boundary by exact predicates, rebuilds only the
/// chains between these nodes, rounds only the nodes, and validates only the edges that end in a rounded node. Its
/// pieces are those of the general path to the last bit, and its errors have the same reasons. Throws OverlayFailure if
/// CGAL refuses to round the nodes; cut.cpp then takes the general path. Returns nullopt if it does not handle the
/// case:
///   - rings touch each other where they are cut, or in a floe of which several rings are cut,
///   - a hole is so near edges that rounding moves that it is in doubt which piece the hole belongs to,
///   - a closed tool touches the ice without crossing it, and all vertices of the shape's outer ring lie on the tool's
///     boundary, so that no vertex shows which of the two encloses the other.
/// The shape must be valid; the tool must be a simple counter-clockwise ring or a simple open polyline.
std::optional<CutOutcome> cut_locally(const Polygon& shape, const Tool& tool);

}  // namespace polynya::geometry
