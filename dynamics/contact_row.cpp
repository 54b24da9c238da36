#include "dynamics/contact_row.hpp"

#include <tuple>

namespace polynya::dynamics {
namespace {

using geometry::Vector;

/// Two ends whose impulses move the contact line almost alike are solved one after the other.
constexpr double kAlike = 1e-9;

}  // namespace

ContactConstraint make_constraint(const Bodies& bodies, const Contact& c, std::int32_t place_of_a,
                                  std::int32_t place_of_b, std::span<const SolverBody> solver_bodies) {
  ContactConstraint constraint;
  constraint.a = place_of_a;
  constraint.b = place_of_b;
  constraint.normal = c.normal;
  const SolverBody& a = solver_bodies[constraint.a];
  const SolverBody& b = solver_bodies[constraint.b];
  const double inverse_masses = a.inverse_mass + b.inverse_mass;
  for (int end = 0; end < 2; ++end) {
    constraint.arm_cross_normal_a[end] = cross(c.ends[end] - bodies.position[c.a], c.normal);
    constraint.arm_cross_normal_b[end] = cross(c.ends[end] - bodies.position[c.b], c.normal);
    constraint.inverse_mass_at[end] =
        inverse_masses +
        constraint.arm_cross_normal_a[end] * constraint.arm_cross_normal_a[end] * a.inverse_moment +
        constraint.arm_cross_normal_b[end] * constraint.arm_cross_normal_b[end] * b.inverse_moment;
    constraint.least[end] = 0;
    constraint.normal_impulse[end] = 0;
  }
  const Vector tangent = perpendicular(c.normal);
  constraint.arm_cross_tangent_a = cross(c.ends[0] - bodies.position[c.a], tangent);
  constraint.arm_cross_tangent_b = cross(c.ends[0] - bodies.position[c.b], tangent);
  constraint.inverse_mass_between =
      inverse_masses +
      constraint.arm_cross_normal_a[0] * constraint.arm_cross_normal_a[1] * a.inverse_moment +
      constraint.arm_cross_normal_b[0] * constraint.arm_cross_normal_b[1] * b.inverse_moment;
  const double both = constraint.inverse_mass_at[0] * constraint.inverse_mass_at[1];
  const double determinant = both - constraint.inverse_mass_between * constraint.inverse_mass_between;
  constraint.inverse_determinant = determinant > kAlike * both ? 1 / determinant : 0;
  constraint.inverse_slip_mass =
      inverse_masses + constraint.arm_cross_tangent_a * constraint.arm_cross_tangent_a * a.inverse_moment +
      constraint.arm_cross_tangent_b * constraint.arm_cross_tangent_b * b.inverse_moment;
  constraint.slip_mass = 1 / constraint.inverse_slip_mass;
  constraint.limit = 0.5 * c.impulse_limit;
  constraint.friction = c.friction;
  constraint.slip_impulse = 0;
  return constraint;
}

ConstraintSpeeds speeds_at(const ContactConstraint& constraint, std::span<const SolverBody> solver_bodies) {
  const SolverBody& a = solver_bodies[constraint.a];
  const SolverBody& b = solver_bodies[constraint.b];
  return {apart_at(constraint, a, b), dot(b.velocity - a.velocity, perpendicular(constraint.normal)) +
                                          b.angular_velocity * constraint.arm_cross_tangent_b -
                                          a.angular_velocity * constraint.arm_cross_tangent_a};
}

double isolated_impulse(const ContactConstraint& constraint, const ConstraintSpeeds& speeds) {
  const double v0 = -speeds.apart[0];
  const double v1 = -speeds.apart[1];
  if (v0 <= 0 && v1 <= 0) return 0;
  if (constraint.inverse_determinant != 0) {
    const double p0 = (constraint.inverse_mass_at[1] * v0 - constraint.inverse_mass_between * v1) *
                      constraint.inverse_determinant;
    const double p1 = (constraint.inverse_mass_at[0] * v1 - constraint.inverse_mass_between * v0) *
                      constraint.inverse_determinant;
    if (p0 >= 0 && p1 >= 0) return p0 + p1;
  }
  return std::max({0.0, v0 / constraint.inverse_mass_at[0], v1 / constraint.inverse_mass_at[1]});
}

double prescribed_work(const ContactConstraint& constraint, std::span<const SolverBody> solver_bodies,
                       const Bodies& bodies, const Contact& c) {
  double work = 0;
  for (const auto& [solver_body, body, sign] :
       {std::tuple{constraint.a, c.a, 1.0}, std::tuple{constraint.b, c.b, -1.0}}) {
    if (solver_bodies[solver_body].inverse_mass != 0) continue;
    const auto along = [&, body = body, sign = sign](geometry::Point at, Vector impulse) {
      return sign * dot(impulse, velocity_at(bodies, body, at - bodies.position[body]));
    };
    for (int end = 0; end < 2; ++end)
      work += along(c.ends[end], constraint.normal_impulse[end] * constraint.normal);
    work += along(c.middle(), constraint.slip_impulse * perpendicular(constraint.normal));
  }
  return work;
}

}  // namespace polynya::dynamics
