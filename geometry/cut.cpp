#include "geometry/cut.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/internal/exact_polygon.hpp"
#include "geometry/internal/general_cut.hpp"
#include "geometry/validity.hpp"

namespace polynya::geometry {
namespace {

tl::unexpected<CutError> refuse(CutFailure reason, const DefectAt& found) {
  return tl::unexpected(CutError{reason, std::string(name_of(found.defect))});
}

exact::Polygon exact_polygon_of(const Shape& shape) {
  return shape.exact ? *shape.exact : exact::exactly(shape.polygon);
}

bool all_finite(const std::vector<Point>& points) {
  return std::all_of(points.begin(), points.end(),
                     [](Point p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

std::optional<DefectAt> find_shape_defect(const Shape& shape) {
  if (shape.known_valid || shape.exact) return {};
  return find_defect(shape.polygon);
}

}  // namespace

std::string_view name_of(CutFailure reason) {
  switch (reason) {
    case CutFailure::kInvalidShape:
      return "invalid-shape";
    case CutFailure::kInvalidTool:
      return "invalid-tool";
    case CutFailure::kMisses:
      return "misses";
    case CutFailure::kDoesNotSeparate:
      return "does-not-separate";
    case CutFailure::kInternal:
      return "internal";
  }
  return "unknown";
}

CutOutcome cut_by_polygon(const Shape& shape, const Polygon& tool_in_body) {
  if (const auto found = find_shape_defect(shape)) return refuse(CutFailure::kInvalidShape, *found);
  if (const auto found = find_defect(tool_in_body)) return refuse(CutFailure::kInvalidTool, *found);
  return cut_by_polygons_generally(exact_polygon_of(shape), {tool_in_body});
}

CutOutcome cut_along(const Shape& shape, const std::vector<Point>& polyline_in_body) {
  if (const auto found = find_shape_defect(shape)) return refuse(CutFailure::kInvalidShape, *found);
  if (!all_finite(polyline_in_body)) return refuse(CutFailure::kInvalidTool, {Defect::kNotFinite, {}});
  const bool is_point = std::all_of(polyline_in_body.begin(), polyline_in_body.end(),
                                    [&](Point p) { return p == polyline_in_body.front(); });
  if (is_point) return refuse(CutFailure::kInvalidTool, {Defect::kTooFewPoints, {}});
  return cut_along_generally(exact_polygon_of(shape), polyline_in_body);
}

Ring disc_polygon(Point centre, double radius, double sagitta) {
  // A chord subtending an angle 2π/n leaves the circle by r(1 − cos(π/n)).
  constexpr int kFewest = 8;
  constexpr int kMost = 4096;
  const double half_angle = std::acos(std::clamp(1 - sagitta / radius, -1.0, 1.0));
  const double wanted = half_angle > 0 ? std::ceil(std::numbers::pi / half_angle) : kMost;
  const int n = static_cast<int>(std::clamp(wanted, double{kFewest}, double{kMost}));
  Ring ring;
  ring.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    ring.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return ring;
}

}  // namespace polynya::geometry
