#include "io/import/projection.hpp"

#include <cmath>
#include <limits>

#include <dlfcn.h>
#include <fmt/format.h>
#include <proj.h>

#include "geometry/shape/angle.hpp"

namespace polynya::io {
namespace {

using geometry::Point;

constexpr const char* kDegreesByProj = "+proj=longlat +datum=WGS84 +no_defs +type=crs";

/// PROJ, loaded when it is first asked: it brings 37 libraries along, which each command would wait for and
/// carry otherwise. POLYNYA_PROJ is the name of the one that this was built with.
class Proj {
 public:
  void* const library = dlopen(POLYNYA_PROJ, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);

#define POLYNYA_OF_PROJ(name) decltype(&::name) const name = find<decltype(&::name)>(#name)
  POLYNYA_OF_PROJ(proj_context_create);
  POLYNYA_OF_PROJ(proj_context_destroy);
  POLYNYA_OF_PROJ(proj_context_set_enable_network);
  POLYNYA_OF_PROJ(proj_log_level);
  POLYNYA_OF_PROJ(proj_create);
  POLYNYA_OF_PROJ(proj_create_crs_to_crs);
  POLYNYA_OF_PROJ(proj_normalize_for_visualization);
  POLYNYA_OF_PROJ(proj_destroy);
  POLYNYA_OF_PROJ(proj_is_crs);
  POLYNYA_OF_PROJ(proj_get_name);
  POLYNYA_OF_PROJ(proj_get_type);
  POLYNYA_OF_PROJ(proj_get_source_crs);
  POLYNYA_OF_PROJ(proj_crs_get_sub_crs);
  POLYNYA_OF_PROJ(proj_crs_get_coordinate_system);
  POLYNYA_OF_PROJ(proj_cs_get_axis_info);
  POLYNYA_OF_PROJ(proj_trans);
#undef POLYNYA_OF_PROJ

 private:
  template <class Function>
  Function find(const char* name) const {
    return library != nullptr ? reinterpret_cast<Function>(dlsym(library, name)) : nullptr;
  }
};

const Proj& proj() {
  static const Proj loaded;
  return loaded;
}

bool has_proj() {
  return proj().library != nullptr;
}
constexpr const char* kNoProj = POLYNYA_PROJ " cannot be loaded: ./setup.sh, or apt-get install libproj25";

/// A context that reads PROJ's own files alone, and prints nothing.
pj_ctx* quiet_context() {
  pj_ctx* const context = proj().proj_context_create();
  proj().proj_log_level(context, PJ_LOG_NONE);
  proj().proj_context_set_enable_network(context, 0);
  return context;
}

/// Whether a system's first axis is in metres.
bool is_metric(pj_ctx* context, const PJ* crs) {
  PJ* const axes = proj().proj_crs_get_coordinate_system(context, crs);
  double metres = 0;
  const bool has_axis = axes != nullptr && proj().proj_cs_get_axis_info(context, axes, 0, nullptr, nullptr, nullptr,
                                                                        &metres, nullptr, nullptr, nullptr) == 1;
  proj().proj_destroy(axes);
  return has_axis && metres == 1;
}

void transform_all(PJ* steps, PJ_DIRECTION direction, std::vector<Point>& points) {
  for (Point& p : points) {
    PJ_COORD place{};
    place.xy = {p.x, p.y};
    const PJ_COORD at = proj().proj_trans(steps, direction, place);
    p = {at.xy.x, at.xy.y};
    if (!std::isfinite(p.x) || !std::isfinite(p.y))  // PROJ gives HUGE_VAL
      p.x = p.y = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

void Projection::Free::operator()(PJconsts* object) const {
  proj().proj_destroy(object);
}
void Projection::Free::operator()(pj_ctx* context) const {
  proj().proj_context_destroy(context);
}

Result<Crs> find_crs(const std::string& definition) {
  if (!has_proj()) return fail(kNoProj);
  const std::unique_ptr<pj_ctx, Projection::Free> context(quiet_context());
  std::unique_ptr<PJ, Projection::Free> crs(proj().proj_create(context.get(), definition.c_str()));
  if (!crs || proj().proj_is_crs(crs.get()) == 0)
    return fail(fmt::format("PROJ knows no coordinate system \"{}\", allowed: EPSG:n, OGC:CRS84, a PROJ string, WKT",
                            definition));
  Crs found;
  if (const char* name = proj().proj_get_name(crs.get())) found.name = name;
  PJ_TYPE type = proj().proj_get_type(crs.get());
  if (type == PJ_TYPE_BOUND_CRS || type == PJ_TYPE_COMPOUND_CRS) {
    crs.reset(type == PJ_TYPE_BOUND_CRS ? proj().proj_get_source_crs(context.get(), crs.get())
                                        : proj().proj_crs_get_sub_crs(context.get(), crs.get(), 0));
    if (!crs) return fail(fmt::format("\"{}\" has no horizontal system", definition));
    type = proj().proj_get_type(crs.get());
  }
  found.is_geographic = type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
  found.is_projected = type == PJ_TYPE_PROJECTED_CRS || type == PJ_TYPE_ENGINEERING_CRS;
  found.is_metric = found.is_projected && is_metric(context.get(), crs.get());
  return found;
}

Result<Projection> Projection::between(const std::string& from, const std::string& to) {
  if (!has_proj()) return fail(kNoProj);
  Projection projection;
  projection.context_.reset(quiet_context());
  pj_ctx* const context = projection.context_.get();
  const std::unique_ptr<PJ, Free> steps(proj().proj_create_crs_to_crs(context, from.c_str(), to.c_str(), nullptr));
  if (!steps) return fail(fmt::format(R"(PROJ has no way from "{}" to "{}")", from, to));
  projection.steps_.reset(proj().proj_normalize_for_visualization(context, steps.get()));
  if (!projection.steps_) return fail(fmt::format(R"(PROJ has no way from "{}" to "{}")", from, to));
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
                     geometry::kDegreesPerRadian * origin.latitude, geometry::kDegreesPerRadian * origin.longitude);
}

Result<GeographicPlane> GeographicPlane::about(const simulation::GeographicOrigin& origin) {
  auto from_degrees = Projection::between(kDegreesByProj, system(origin));
  if (!from_degrees) return fail(from_degrees.error());
  return GeographicPlane(origin, std::move(*from_degrees));
}

Geographic GeographicPlane::geographic_of(Point point) const {
  // The x axis heads `heading` clockwise from north; y is 90° to port of it.
  const double sin_h = std::sin(origin_.heading), cos_h = std::cos(origin_.heading);
  std::vector<Point> at{{point.x * sin_h - point.y * cos_h, point.x * cos_h + point.y * sin_h}};
  from_degrees_.apply_inverse(at);
  const double origin_longitude = geometry::kDegreesPerRadian * origin_.longitude;
  const double longitude = origin_longitude + std::remainder(at[0].x - origin_longitude, 360);
  return {at[0].y / geometry::kDegreesPerRadian, longitude / geometry::kDegreesPerRadian};
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
