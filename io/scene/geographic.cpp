#include "io/scene/geographic.hpp"

#include <cmath>

namespace polynya::io {
namespace {

constexpr double kSemiMajor = 6378137.0;                            ///< a of WGS 84 [m]
constexpr double kFlattening = 1 / 298.257223563;                   ///< f of WGS 84 [-]
constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);  ///< e² [-]

}  // namespace

Geographic geographic_of(const simulation::GeographicOrigin& origin, geometry::Point point) {
  // The x axis heads `heading` clockwise from north; y is 90° to port of it.
  const double sin_h = std::sin(origin.heading), cos_h = std::cos(origin.heading);
  const double east = point.x * sin_h - point.y * cos_h;
  const double north = point.x * cos_h + point.y * sin_h;
  const double sin_lat = std::sin(origin.latitude), cos_lat = std::cos(origin.latitude);
  const double normal = kSemiMajor / std::sqrt(1 - kEccentricity2 * sin_lat * sin_lat);
  // Geocentric, turned so that the origin's meridian is that of x.
  const double x = normal * cos_lat - sin_lat * north;
  const double y = east;
  const double z = normal * (1 - kEccentricity2) * sin_lat + cos_lat * north;
  const double p = std::hypot(x, y);
  double latitude = std::atan2(z, p * (1 - kEccentricity2));
  for (int i = 0; i < 20; ++i) {
    const double s = std::sin(latitude);
    const double n = kSemiMajor / std::sqrt(1 - kEccentricity2 * s * s);
    latitude = std::atan2(z + kEccentricity2 * n * s, p);
  }
  return {latitude, origin.longitude + std::atan2(y, x)};
}

}  // namespace polynya::io
