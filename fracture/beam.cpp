#include "fracture/beam.hpp"

#include <cmath>
#include <limits>

#include "elementary/elementary.hpp"

namespace polynya::fracture {
namespace {

using geometry::Point;
using geometry::Vector;

/// Adds the moments of the triangle from the origin to p and q; positive if it runs counter-clockwise.
void add_triangle(Point p, Point q, PlaneMoments& sum) {
  const double twice = p.x * q.y - q.x * p.y;
  sum.area += twice / 2;
  sum.x += twice / 6 * (p.x + q.x);
  sum.y += twice / 6 * (p.y + q.y);
  sum.xx += twice / 12 * (p.x * p.x + p.x * q.x + q.x * q.x);
  sum.yy += twice / 12 * (p.y * p.y + p.y * q.y + q.y * q.y);
  sum.xy += twice / 24 * (2 * p.x * p.y + p.x * q.y + q.x * p.y + 2 * q.x * q.y);
}

/// Adds the part of a ring at x ≤ most. If the ring is not convex, the clipped ring runs back and forth along the
/// section, which adds nothing.
void add_ring(const geometry::Ring& ring, const geometry::Pose& frame_from_body, double most, PlaneMoments& sum) {
  Point first{}, last{};
  bool has_any = false;
  const auto go_to = [&](Point p) {
    if (has_any)
      add_triangle(last, p, sum);
    else
      first = p;
    has_any = true;
    last = p;
  };
  Point p = transform(frame_from_body, ring.back());
  for (const geometry::Point& vertex : ring) {
    const Point q = transform(frame_from_body, vertex);
    const bool crosses = (p.x <= most) != (q.x <= most);
    if (crosses) go_to({most, p.y + (most - p.x) / (q.x - p.x) * (q.y - p.y)});
    if (q.x <= most) go_to(q);
    p = q;
  }
  if (has_any) add_triangle(last, first, sum);
}

}  // namespace

PlaneMoments moments_of(const geometry::Polygon& polygon, const geometry::Pose& frame_from_body) {
  return moments_up_to(polygon, frame_from_body, std::numeric_limits<double>::infinity());
}

PlaneMoments moments_up_to(const geometry::Polygon& polygon, const geometry::Pose& frame_from_body, double x) {
  PlaneMoments sum;
  add_ring(polygon.outer, frame_from_body, x, sum);
  for (const geometry::Ring& hole : polygon.holes) add_ring(hole, frame_from_body, x, sum);
  return sum;
}

double long_axis(const PlaneMoments& about_centre) {
  return 0.5 * elementary::atan2(2 * about_centre.xy, about_centre.xx - about_centre.yy);
}

SectionLoad section_load(std::span<const BeamLoad> loads, const PlaneMoments& floe, const PlaneMoments& before,
                         const BeamSection& section) {
  Vector force{}, force_before{};  // in plan
  double turning = 0, down = 0, pitching = 0;
  SectionLoad load;
  for (const BeamLoad& on : loads) {
    force += on.force;
    turning += on.at.x * on.force.y - on.at.y * on.force.x;
    down += on.down;
    pitching += on.at.x * on.down;
    if (on.at.x >= section.x) continue;
    const Vector arm{on.at.x - section.x, on.at.y - section.middle};
    force_before += on.force;
    load.moment += cross(arm, on.force);
    load.vertical_moment -= arm.x * on.down;
  }
  const Vector a = (1 / floe.area) * force;  // times the mass per area, like `spin`
  const double spin = turning / (floe.xx + floe.yy);
  load.tension = a.x * before.area - spin * before.y - force_before.x;
  load.moment -= a.y * (before.x - section.x * before.area) + spin * (before.xx - section.x * before.x) -
                 a.x * (before.y - section.middle * before.area) + spin * (before.yy - section.middle * before.y);
  const double lift = down / floe.area;  // lift of the water per area at the middle
  const double slope = pitching / floe.xx;
  load.vertical_moment -= lift * (section.x * before.area - before.x) + slope * (section.x * before.x - before.xx);
  return load;
}

double elastic_share(const Ice& ice, const Water& water, double length) {
  const double h = ice.thickness;
  const double b = length * std::sqrt(std::sqrt(water.density * kGravity / (4 * ice.youngs_modulus * h * h * h / 12)));
  constexpr double kRigid =
      1e-2;  // b below which the ratio is taken as 1, within b⁴/500; the quotient below loses digits
  if (b < kRigid) return 1;
  return 2 * (elementary::cosh(b) - elementary::cos(b)) / (b * (elementary::sinh(b) + elementary::sin(b)));
}

double section_stress(const Ice& ice, double width, const SectionLoad& load) {
  const double h = ice.thickness;
  return load.tension / (h * width) + 6 * std::abs(load.moment) / (h * width * width) +
         6 * std::abs(load.vertical_moment) / (width * h * h);
}

double most_section_stress(const Ice& ice, double least_width, double length, double force, double down) {
  return section_stress(ice, least_width, {force, 0.25 * length * force, 0.25 * length * down});
}

}  // namespace polynya::fracture
