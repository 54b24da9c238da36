#include "dynamics/contact/contact_constraint.hpp"

#include <limits>
#include <tuple>

namespace polynya::dynamics {
namespace {

using geometry::Vector;

/// Limit below which det K counts as 0, as a fraction of the product of K's diagonal [-]; the two ends are then solved
/// one by one. Much smaller: the inverse magnifies rounding errors to impulses that turn the bodies. Much larger:
/// well-conditioned lines are solved end by end too, in more sweeps.
constexpr double kSingular = 1e-9;
/// Inverse mass that replaces the zero inverse mass of two bodies with prescribed motion, so that the impulse is the
/// law's impulse at their speeds [1/kg]. Multiplied by the impulse of a step, up to about 1e6 N s, it must stay far
/// below the creep speed; otherwise the impulse is smaller than the law's.
constexpr double kHeldInverseMass = 1e-13;

}  // namespace

void take_bodies(const Bodies& bodies, std::span<const BodyIndex> touched, std::span<SolverBody> solver_bodies) {
  for (std::size_t place = 0; place < touched.size(); ++place) {
    const BodyIndex body = touched[place];
    solver_bodies[place] = {bodies.velocity[body], bodies.angular_velocity[body], bodies.inverse_mass[body],
                            bodies.inverse_moment[body]};
  }
}

void give_back_bodies(std::span<const SolverBody> solver_bodies, std::span<const BodyIndex> touched, Bodies& bodies) {
  for (std::size_t place = 0; place < touched.size(); ++place) {
    bodies.velocity[touched[place]] = solver_bodies[place].velocity;
    bodies.angular_velocity[touched[place]] = solver_bodies[place].angular_velocity;
  }
}

ContactConstraint make_constraint(const Bodies& bodies, const Contact& c, std::int32_t place_of_a,
                                  std::int32_t place_of_b, std::span<const SolverBody> solver_bodies) {
  ContactConstraint k;
  k.a = place_of_a;
  k.b = place_of_b;
  k.normal = c.normal;
  const SolverBody& a = solver_bodies[k.a];
  const SolverBody& b = solver_bodies[k.b];
  const bool is_held = a.inverse_mass == 0 && b.inverse_mass == 0;
  const double inverse_masses = is_held ? kHeldInverseMass : a.inverse_mass + b.inverse_mass;
  for (int end = 0; end < 2; ++end) {
    k.arm_cross_normal_a[end] = cross(c.ends[end] - bodies.position[c.a], c.normal);
    k.arm_cross_normal_b[end] = cross(c.ends[end] - bodies.position[c.b], c.normal);
    k.inverse_mass_at[end] = inverse_masses + k.arm_cross_normal_a[end] * k.arm_cross_normal_a[end] * a.inverse_moment +
                             k.arm_cross_normal_b[end] * k.arm_cross_normal_b[end] * b.inverse_moment;
    k.least[end] = 0;
    k.normal_impulse[end] = 0;
  }
  const Vector tangent = perpendicular(c.normal);
  k.arm_cross_tangent_a = cross(c.ends[0] - bodies.position[c.a], tangent);
  k.arm_cross_tangent_b = cross(c.ends[0] - bodies.position[c.b], tangent);
  k.inverse_mass_between = inverse_masses + k.arm_cross_normal_a[0] * k.arm_cross_normal_a[1] * a.inverse_moment +
                           k.arm_cross_normal_b[0] * k.arm_cross_normal_b[1] * b.inverse_moment;
  const double both = k.inverse_mass_at[0] * k.inverse_mass_at[1];
  const double determinant = both - k.inverse_mass_between * k.inverse_mass_between;
  k.inverse_determinant = determinant > kSingular * both ? 1 / determinant : 0;
  k.inverse_slip_mass = inverse_masses + k.arm_cross_tangent_a * k.arm_cross_tangent_a * a.inverse_moment +
                        k.arm_cross_tangent_b * k.arm_cross_tangent_b * b.inverse_moment;
  k.slip_mass = 1 / k.inverse_slip_mass;
  k.limit = std::numeric_limits<double>::infinity();
  k.friction = c.friction;
  k.slip_impulse = 0;
  return k;
}

double isolated_impulse(const ContactConstraint& k, const ConstraintSpeeds& speeds) {
  const double v0 = -speeds.apart[0];
  const double v1 = -speeds.apart[1];
  if (v0 <= 0 && v1 <= 0) return 0;
  if (k.inverse_determinant != 0) {
    const double p0 = (k.inverse_mass_at[1] * v0 - k.inverse_mass_between * v1) * k.inverse_determinant;
    const double p1 = (k.inverse_mass_at[0] * v1 - k.inverse_mass_between * v0) * k.inverse_determinant;
    if (p0 >= 0 && p1 >= 0) return p0 + p1;
  }
  return std::max({0.0, v0 / k.inverse_mass_at[0], v1 / k.inverse_mass_at[1]});
}

double prescribed_work(const ContactConstraint& k, std::span<const SolverBody> solver_bodies, const Bodies& bodies,
                       const Contact& c) {
  double work = 0;
  if (solver_bodies[k.a].inverse_mass != 0 && solver_bodies[k.b].inverse_mass != 0) return work;
  for (const auto& [solver_body, body, sign] : {std::tuple{k.a, c.a, 1.0}, std::tuple{k.b, c.b, -1.0}}) {
    if (solver_bodies[solver_body].inverse_mass != 0) continue;
    const auto along = [&, body = body, sign = sign](geometry::Point at, Vector impulse) {
      return sign * dot(impulse, velocity_at(bodies, body, at - bodies.position[body]));
    };
    for (int end = 0; end < 2; ++end) work += along(c.ends[end], c.normal_impulse[end] * c.normal);
    work += along(c.middle(), c.slip_impulse * perpendicular(c.normal));
  }
  return work;
}

}  // namespace polynya::dynamics
