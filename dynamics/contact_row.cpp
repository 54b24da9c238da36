#include "dynamics/contact_row.hpp"

#include <tuple>

namespace polynya::dynamics {
namespace {

using geometry::Vector;

/// Two ends whose impulses move the contact line almost alike are solved one after the other.
constexpr double kAlike = 1e-9;

}  // namespace

ContactRow make_row(const Bodies& bodies, const Contact& c, std::int32_t place_of_a, std::int32_t place_of_b,
                    std::span<const Mover> movers) {
  ContactRow row;
  row.a = place_of_a;
  row.b = place_of_b;
  row.normal = c.normal;
  const Mover& a = movers[row.a];
  const Mover& b = movers[row.b];
  const double inverse_masses = a.inverse_mass + b.inverse_mass;
  for (int end = 0; end < 2; ++end) {
    row.turn_a[end] = cross(c.ends[end] - bodies.position[c.a], c.normal);
    row.turn_b[end] = cross(c.ends[end] - bodies.position[c.b], c.normal);
    row.softness[end] = inverse_masses + row.turn_a[end] * row.turn_a[end] * a.inverse_moment +
                        row.turn_b[end] * row.turn_b[end] * b.inverse_moment;
    row.least[end] = 0;
    row.normal_impulse[end] = 0;
  }
  const Vector tangent = perpendicular(c.normal);
  row.slip_turn_a = cross(c.ends[0] - bodies.position[c.a], tangent);
  row.slip_turn_b = cross(c.ends[0] - bodies.position[c.b], tangent);
  row.coupling = inverse_masses + row.turn_a[0] * row.turn_a[1] * a.inverse_moment +
                 row.turn_b[0] * row.turn_b[1] * b.inverse_moment;
  const double both = row.softness[0] * row.softness[1];
  const double determinant = both - row.coupling * row.coupling;
  row.stiffness = determinant > kAlike * both ? 1 / determinant : 0;
  row.slip_softness = inverse_masses + row.slip_turn_a * row.slip_turn_a * a.inverse_moment +
                      row.slip_turn_b * row.slip_turn_b * b.inverse_moment;
  row.slip_mass = 1 / row.slip_softness;
  row.limit = 0.5 * c.impulse_limit;
  row.friction = c.friction;
  row.slip_impulse = 0;
  return row;
}

RowSpeeds speeds_at(const ContactRow& row, std::span<const Mover> movers) {
  const Mover& a = movers[row.a];
  const Mover& b = movers[row.b];
  return {apart_at(row, a, b), dot(b.velocity - a.velocity, perpendicular(row.normal)) +
                                   b.angular_velocity * row.slip_turn_b -
                                   a.angular_velocity * row.slip_turn_a};
}

double isolated_impulse(const ContactRow& row, const RowSpeeds& speeds) {
  const double v0 = -speeds.apart[0];
  const double v1 = -speeds.apart[1];
  if (v0 <= 0 && v1 <= 0) return 0;
  if (row.stiffness != 0) {
    const double p0 = (row.softness[1] * v0 - row.coupling * v1) * row.stiffness;
    const double p1 = (row.softness[0] * v1 - row.coupling * v0) * row.stiffness;
    if (p0 >= 0 && p1 >= 0) return p0 + p1;
  }
  return std::max({0.0, v0 / row.softness[0], v1 / row.softness[1]});
}

double held_work(const ContactRow& row, std::span<const Mover> movers, const Bodies& bodies,
                 const Contact& c) {
  double work = 0;
  for (const auto& [mover, body, sign] : {std::tuple{row.a, c.a, 1.0}, std::tuple{row.b, c.b, -1.0}}) {
    if (movers[mover].inverse_mass != 0) continue;
    const auto along = [&, body = body, sign = sign](geometry::Point at, Vector impulse) {
      return sign * dot(impulse, velocity_at(bodies, body, at - bodies.position[body]));
    };
    for (int end = 0; end < 2; ++end) work += along(c.ends[end], row.normal_impulse[end] * row.normal);
    work += along(c.middle(), row.slip_impulse * perpendicular(row.normal));
  }
  return work;
}

}  // namespace polynya::dynamics
