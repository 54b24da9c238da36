#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dynamics/planar.hpp"
#include "geometry/contact/boundary.hpp"
#include "geometry/shape/pose.hpp"

namespace polynya::dynamics {

using BodyIndex = std::int32_t;

/// Kinds of rigid bodies. Ships, structures and walls are hulls: they are not ice.
enum class BodyKind : std::uint8_t { kShip, kStructure, kWall, kFloe };

/// Returns true for bodies that stand on the ground or represent ice far away. They do not press each other.
inline bool is_grounded(BodyKind kind) {
  return kind == BodyKind::kStructure || kind == BodyKind::kWall;
}

/// The factors of a shape's drag that do not depend on its speed, width and (with DragArea::kEdge) thickness. Made once
/// per shape (water_drag.hpp). With kPlan all widths are the area [m²], and K is ∫ r³ dA [m⁵].
struct DragShape {
  static constexpr int kDirections = 128;
  double rotational = 0;             ///< K = mean over directions of ∫|s|³ ds across the body [m⁴]
  double skin_rotational = 0;        ///< ∫ r³ dA; 0 if no skin drag acts [m⁵]
  std::optional<double> same_width;  ///< width across all directions, if it is the same: with kPlan, and for bodies
                                     ///< that water does not move [m]
};

/// The part of a drag shape that its body needed last. In steady motion the body needs the same part again.
struct DragSpan {
  double width = 0;       ///< across drag_direction(place) [m]
  double next_width = 0;  ///< across the next direction [m]
  double rotational = 0;  ///< K [m⁴]
  int place = -1;         ///< index of the direction; −1: none yet
};

/// The rigid bodies of a world, hulls and floes alike, stored as columns. Positions and velocities are in the water
/// frame, which drifts over ground with the uniform velocity of the water: ice at rest in it is at rest exactly. Bodies
/// are only ever added. A body that broke is marked as dead, and its index is not used again.
struct Bodies {
  // Hot columns: read or written in every step while the body is awake.
  std::vector<geometry::Point> position;     ///< centre of mass in the water frame [m]
  std::vector<double> angle;                 ///< of the body's axes: the sum of all its turns [rad]
  std::vector<double> angle_rest;            ///< rounding error of that sum (turn_body) [rad]
  std::vector<geometry::Rotation> rotation;  ///< cosine and sine of angle
  std::vector<geometry::Vector> velocity;    ///< of the centre of mass relative to the water [m/s]
  std::vector<double> angular_velocity;      ///< [rad/s]
  std::vector<double> inverse_mass;          ///< 0: prescribed motion [1/kg]
  std::vector<double> inverse_moment;        ///< 0: prescribed motion [1/(kg m²)]
  std::vector<double> travel;           ///< upper bound of the distance that any point of the body has moved so far [m]
  std::vector<double> bounding_radius;  ///< about the centre of mass [m]
  std::vector<double> rim_speed;        ///< upper bound of any point's speed at the last integration [m/s]
  std::vector<DragSpan> drag_span;
  std::vector<std::uint8_t> is_awake;
  // Cold columns.
  std::vector<std::uint8_t> is_alive;
  std::vector<double> mass;               ///< also for bodies with prescribed motion [kg]
  std::vector<double> moment;             ///< of inertia about the centre of mass [kg m²]
  std::vector<geometry::Point> centroid;  ///< centre of mass in the body frame [m]
  std::vector<double> area;               ///< in plan [m²]
  std::vector<double> thickness;          ///< of the ice; 0 for hulls [m]
  std::vector<BodyKind> kind;
  std::vector<std::shared_ptr<geometry::Boundary>> boundary;  ///< prepared when another body comes near
  std::vector<std::shared_ptr<const DragShape>> drag;         ///< null: the body has no drag, or sleeps

  BodyIndex size() const { return static_cast<BodyIndex>(position.size()); }
};

/// The properties of a body that is added.
struct NewBody {
  geometry::Point position;     ///< centre of mass, water frame [m]
  double angle = 0;             ///< [rad]
  geometry::Vector velocity;    ///< relative to the water [m/s]
  double angular_velocity = 0;  ///< [rad/s]
  double mass = 0;              ///< [kg]
  double moment = 0;            ///< [kg m²]
  bool is_prescribed = false;   ///< true if impulses do not change its velocity
  BodyKind kind = BodyKind::kFloe;
  geometry::Point centroid;  ///< in the body frame [m]
  double thickness = 0;      ///< of the ice [m]
  std::shared_ptr<geometry::Boundary> boundary;
  std::shared_ptr<const DragShape> drag;
};

BodyIndex add_body(Bodies& bodies, const NewBody& body);

/// Reserves memory for this number of bodies in total.
void reserve(Bodies& bodies, std::size_t count);

/// Returns the placement of a body's frame in the water frame.
inline geometry::Pose water_from_body(const Bodies& bodies, BodyIndex i) {
  const geometry::Rotation r = bodies.rotation[i];
  return {bodies.position[i] - rotate(r, bodies.centroid[i] - geometry::Point{}), r};
}

/// Returns the placement of b's centre of mass and axes in the frame of a's.
inline geometry::Pose centre_a_from_b(const Bodies& bodies, BodyIndex a, BodyIndex b) {
  return geometry::relative_pose({bodies.position[a], bodies.rotation[a]}, {bodies.position[b], bodies.rotation[b]});
}

/// Returns the placement of b's frame in a's, from the placement of their centres of mass.
inline geometry::Pose a_from_b(const Bodies& bodies, BodyIndex a, BodyIndex b, const geometry::Pose& centre_a_from_b) {
  const geometry::Vector centroid_of_a = bodies.centroid[a] - geometry::Point{};
  const geometry::Vector centroid_of_b = bodies.centroid[b] - geometry::Point{};
  return {centre_a_from_b.position + centroid_of_a - rotate(centre_a_from_b.rotation, centroid_of_b),
          centre_a_from_b.rotation};
}

/// Returns the placement of b's frame in a's, from the placement of both in the water.
inline geometry::Pose a_from_b(const Bodies& bodies, BodyIndex a, BodyIndex b) {
  return geometry::relative_pose(water_from_body(bodies, a), water_from_body(bodies, b));
}

/// Returns true if both motions are prescribed, as for a hull in fast ice: no contact changes them.
inline bool are_prescribed(const Bodies& bodies, BodyIndex a, BodyIndex b) {
  return bodies.inverse_mass[a] == 0 && bodies.inverse_mass[b] == 0;
}

/// Returns true for ice with prescribed motion that stands still in the water.
inline bool is_held(const Bodies& bodies, BodyIndex i) {
  return bodies.kind[i] == BodyKind::kFloe && bodies.inverse_mass[i] == 0 && bodies.velocity[i] == geometry::Vector{} &&
         bodies.angular_velocity[i] == 0;
}

/// Returns the velocity of a point of the body at `arm` from its centre of mass, v + ω × r [m/s].
inline geometry::Vector velocity_at(const Bodies& bodies, BodyIndex i, geometry::Vector arm) {
  return bodies.velocity[i] + cross(bodies.angular_velocity[i], arm);
}

/// Returns a force or an impulse at a point of the water frame, in the axes of the body and about its centre.
inline Planar planar_of(const Bodies& bodies, BodyIndex i, geometry::Point at, geometry::Vector impulse) {
  const geometry::Vector in_body = rotate_back(bodies.rotation[i], impulse);
  return {in_body.x, in_body.y, cross(at - bodies.position[i], impulse)};
}

/// Gives a body an impulse in the water frame [N s] and an angular impulse about its centre [N m s]. Returns their work
/// on the body, which is the impulse times the mean of the velocities before and after [J].
inline double push(Bodies& bodies, BodyIndex i, geometry::Vector impulse, double turning = 0) {
  const geometry::Vector change = bodies.inverse_mass[i] * impulse;
  const double spin = bodies.inverse_moment[i] * turning;
  const double work =
      dot(impulse, bodies.velocity[i] + 0.5 * change) + turning * (bodies.angular_velocity[i] + 0.5 * spin);
  bodies.velocity[i] += change;
  bodies.angular_velocity[i] += spin;
  return work;
}

/// Turns a body by an angle [rad]. The angle is a compensated sum (TwoSum [Knuth1997]): after any number of turns angle
/// + angle_rest is their sum up to the last bit or two. The rotation is the rotation by this angle.
inline void turn_body(Bodies& bodies, BodyIndex i, double turn) {
  const double before = bodies.angle[i];
  const double added = turn + bodies.angle_rest[i];
  const double sum = before + added;
  const double taken = sum - before;
  bodies.angle[i] = sum;
  bodies.angle_rest[i] = (before - (sum - taken)) + (added - taken);
  bodies.rotation[i] = geometry::Rotation::by(sum);
}

/// Moves a body by a displacement [m] and a turn [rad].
void move_body(Bodies& bodies, BodyIndex i, geometry::Vector shift, double turn);

/// Returns an upper bound of the present speed of any point of a body [m/s].
inline double rim_speed_of(const Bodies& bodies, BodyIndex i) {
  return length(bodies.velocity[i]) + std::abs(bodies.angular_velocity[i]) * bodies.bounding_radius[i];
}

/// Moves every awake body with its velocity over dt [s]. Returns the largest rim speed [m/s], or NaN if one is NaN.
double integrate(Bodies& bodies, const std::vector<BodyIndex>& awake, double dt, int threads = 1);

/// Number of bodies that one thread takes at a time; fewer are not worth another thread. Results do not change.
inline constexpr std::size_t kBodiesPerChunk = 1024;

}  // namespace polynya::dynamics
