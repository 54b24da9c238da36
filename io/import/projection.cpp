#include "io/import/projection.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <proj.h>

namespace polynya::io {
namespace {

using geometry::Point;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr const char* kLongitudeLatitude = "+proj=longlat +datum=WGS84 +no_defs +type=crs";

/// A context that reads PROJ's own files alone, and prints nothing.
pj_ctx* quiet_context() {
  pj_ctx* const context = proj_context_create();
  proj_log_level(context, PJ_LOG_NONE);
  proj_context_set_enable_network(context, 0);
  return context;
}

/// Whether a system's first axis is in metres.
bool is_metric(pj_ctx* context, const PJ* crs) {
  PJ* const axes = proj_crs_get_coordinate_system(context, crs);
  double metres = 0;
  const bool has_axis = axes != nullptr && proj_cs_get_axis_info(context, axes, 0, nullptr, nullptr, nullptr,
                                                                 &metres, nullptr, nullptr, nullptr) == 1;
  proj_destroy(axes);
  return has_axis && metres == 1;
}

void transform_all(PJ* steps, PJ_DIRECTION direction, std::vector<Point>& points) {
  for (Point& p : points) {
    const PJ_COORD at = proj_trans(steps, direction, proj_coord(p.x, p.y, 0, 0));
    p = {at.xy.x, at.xy.y};
    if (!std::isfinite(p.x) || !std::isfinite(p.y))  // PROJ gives HUGE_VAL
      p.x = p.y = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

void Projection::Free::operator()(PJconsts* object) const {
  proj_destroy(object);
}
void Projection::Free::operator()(pj_ctx* context) const {
  proj_context_destroy(context);
}

Result<Crs> find_crs(const std::string& definition) {
  const std::unique_ptr<pj_ctx, Projection::Free> context(quiet_context());
  std::unique_ptr<PJ, Projection::Free> crs(proj_create(context.get(), definition.c_str()));
  if (!crs || proj_is_crs(crs.get()) == 0)
    return fail(fmt::format("PROJ knows no coordinate system \"{}\"", definition));
  Crs found;
  if (const char* name = proj_get_name(crs.get())) found.name = name;
  PJ_TYPE type = proj_get_type(crs.get());
  if (type == PJ_TYPE_BOUND_CRS || type == PJ_TYPE_COMPOUND_CRS) {
    crs.reset(type == PJ_TYPE_BOUND_CRS ? proj_get_source_crs(context.get(), crs.get())
                                        : proj_crs_get_sub_crs(context.get(), crs.get(), 0));
    if (!crs) return fail(fmt::format("\"{}\" has no horizontal system", definition));
    type = proj_get_type(crs.get());
  }
  found.is_geographic = type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
  found.is_projected = type == PJ_TYPE_PROJECTED_CRS || type == PJ_TYPE_ENGINEERING_CRS;
  found.is_metric = found.is_projected && is_metric(context.get(), crs.get());
  return found;
}

Result<Projection> Projection::between(const std::string& from, const std::string& to) {
  Projection projection;
  projection.context_.reset(quiet_context());
  pj_ctx* const context = projection.context_.get();
  const std::unique_ptr<PJ, Free> steps(proj_create_crs_to_crs(context, from.c_str(), to.c_str(), nullptr));
  if (!steps) return fail(fmt::format("PROJ has no way from \"{}\" to \"{}\"", from, to));
  projection.steps_.reset(proj_normalize_for_visualization(context, steps.get()));
  if (!projection.steps_) return fail(fmt::format("PROJ has no way from \"{}\" to \"{}\"", from, to));
  return projection;
}

void Projection::apply(std::vector<Point>& points) const {
  transform_all(steps_.get(), PJ_FWD, points);
}
void Projection::apply_inverse(std::vector<Point>& points) const {
  transform_all(steps_.get(), PJ_INV, points);
}

std::string GeographicPlane::system(const simulation::GeographicOrigin& origin) {
  return fmt::format("+proj=aeqd +lat_0={} +lon_0={} +datum=WGS84 +units=m +no_defs +type=crs",
                     kDegrees * origin.latitude, kDegrees * origin.longitude);
}

GeographicPlane::GeographicPlane(const simulation::GeographicOrigin& origin)
    : origin_(origin), from_degrees_(Projection::between(kLongitudeLatitude, system(origin)).value()) {}

Geographic GeographicPlane::geographic_of(Point point) const {
  // The x axis heads `heading` clockwise from north; y is 90° to port of it.
  const double sin_h = std::sin(origin_.heading), cos_h = std::cos(origin_.heading);
  std::vector<Point> at{{point.x * sin_h - point.y * cos_h, point.x * cos_h + point.y * sin_h}};
  from_degrees_.apply_inverse(at);
  const double origin_longitude = kDegrees * origin_.longitude;
  const double longitude = origin_longitude + std::remainder(at[0].x - origin_longitude, 360);
  return {at[0].y / kDegrees, longitude / kDegrees};
}

void GeographicPlane::place(std::vector<Point>& degrees) const {
  from_degrees_.apply(degrees);
  turn(degrees);
}

void GeographicPlane::turn(std::vector<Point>& east_north) const {
  const double sin_h = std::sin(origin_.heading), cos_h = std::cos(origin_.heading);
  for (Point& p : east_north) p = {p.x * sin_h + p.y * cos_h, p.y * sin_h - p.x * cos_h};
}

}  // namespace polynya::io
