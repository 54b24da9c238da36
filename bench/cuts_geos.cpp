#include <algorithm>

#include <geos_c.h>

#include "bench/cut_cases.hpp"

// GEOS 3.11: GEOSDifference and GEOSIntersection are OverlayNG in floating precision.
namespace polynya::bench::geos {
namespace {

class Library {
 public:
  Library() : handle_(GEOS_init_r()) {}
  ~Library() { GEOS_finish_r(handle_); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  operator GEOSContextHandle_t() const { return handle_; }

 private:
  GEOSContextHandle_t handle_;
};

GEOSGeometry* to_geos(GEOSContextHandle_t geos, const geometry::Ring& ring) {
  const auto size = static_cast<unsigned>(ring.size());
  GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(geos, size + 1, 2);
  for (unsigned i = 0; i <= size; ++i) {
    const geometry::Point p = ring[i == size ? 0 : i];
    GEOSCoordSeq_setXY_r(geos, sequence, i, p.x, p.y);
  }
  return GEOSGeom_createPolygon_r(geos, GEOSGeom_createLinearRing_r(geos, sequence), nullptr, 0);
}

std::size_t vertices(GEOSContextHandle_t geos, const GEOSGeometry* geometry) {
  return static_cast<std::size_t>(GEOSGetNumCoordinates_r(geos, geometry) - GEOSGetNumGeometries_r(geos, geometry));
}

GEOSGeometry* largest_part(GEOSContextHandle_t geos, GEOSGeometry* whole) {
  int best = 0;
  const int count = GEOSGetNumGeometries_r(geos, whole);
  if (count == 1 && GEOSGeomTypeId_r(geos, whole) == GEOS_POLYGON) return whole;
  const auto size = [&](int i) { return GEOSGetNumCoordinates_r(geos, GEOSGetGeometryN_r(geos, whole, i)); };
  for (int i = 1; i < count; ++i) best = size(i) > size(best) ? i : best;
  GEOSGeometry* part = GEOSGeom_clone_r(geos, GEOSGetGeometryN_r(geos, whole, best));
  GEOSGeom_destroy_r(geos, whole);
  return part;
}

Result measure(GEOSContextHandle_t geos, const GEOSGeometry* geometry) {
  Result result;
  GEOSArea_r(geos, geometry, &result.area);
  result.vertices = vertices(geos, geometry);
  return result;
}

}  // namespace

Result march(const March& march) {
  const Library geos;
  GEOSGeometry* plate = to_geos(geos, march.plate);
  for (const geometry::Ring& cusp : march.cusps) {
    GEOSGeometry* disc = to_geos(geos, cusp);
    GEOSGeometry* left = GEOSDifference_r(geos, plate, disc);
    GEOSGeom_destroy_r(geos, disc);
    GEOSGeom_destroy_r(geos, plate);
    plate = largest_part(geos, left);
  }
  const Result result = measure(geos, plate);
  GEOSGeom_destroy_r(geos, plate);
  return result;
}

Result split(const Split& split) {
  const Library geos;
  GEOSGeometry* floe = to_geos(geos, split.floe);
  GEOSGeometry* side = to_geos(geos, half_plane(split));
  Result result;
  for (GEOSGeometry* half : {GEOSIntersection_r(geos, floe, side), GEOSDifference_r(geos, floe, side)}) {
    const Result one = measure(geos, half);
    result.area += one.area;
    result.vertices += one.vertices;
    GEOSGeom_destroy_r(geos, half);
  }
  GEOSGeom_destroy_r(geos, side);
  GEOSGeom_destroy_r(geos, floe);
  return result;
}

}  // namespace polynya::bench::geos
