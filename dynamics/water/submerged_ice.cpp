#include "dynamics/water/submerged_ice.hpp"

#include <cmath>

#include "elementary/elementary.hpp"

namespace polynya::dynamics {
namespace {

constexpr double kGravity = 9.81;  // [m/s²]

}  // namespace

SubmersionPath submersion_path(const HullForm& hull) {
  const double tan_phi = elementary::tan(hull.stem_angle);
  const double sin_phi = elementary::sin(hull.stem_angle);
  const double tan_alpha = elementary::tan(hull.entrance_angle);
  const double psi = elementary::atan(tan_phi / elementary::sin(hull.entrance_angle));
  const double t = hull.draught;
  const double b = hull.beam;
  SubmersionPath path;
  path.rise = t * (b + t) / (b + 2 * t);
  path.bow = t / tan_phi;
  const double bottom = 0.7 * hull.length - t / tan_phi - b / (4 * tan_alpha);
  const double sides = t * elementary::cos(hull.stem_angle) * elementary::cos(psi) *
                       std::sqrt(1 / (sin_phi * sin_phi) + 1 / (tan_alpha * tan_alpha));
  path.sliding = std::max(0.0, bottom + sides);
  return path;
}

double submersion_speed_factor(double speed, double length) {
  return 1 + 9.4 * speed / std::sqrt(kGravity * length);
}

}  // namespace polynya::dynamics
