#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <numeric>
#include <vector>

#include "dynamics/bodies.hpp"
#include "dynamics/contact/broad_phase.hpp"
#include "dynamics/contact/contact_solver.hpp"
#include "dynamics/water/water_drag.hpp"
#include "geometry/exact/measures.hpp"
#include "tests/only.hpp"
#include "tests/shapes.hpp"

namespace polynya::scenery {

using shapes::rectangle;
using tests::only;

/// Random numbers that are the same on every machine (splitmix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double between(double low, double high) { return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53; }
  double angle() { return between(-std::numbers::pi, std::numbers::pi); }
  int below(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};
inline constexpr std::uint64_t kSeed = 20170611;  ///< for tests that have no seed

/// At a distance from the origin, turned.
inline geometry::Pose random_pose(Random& random, double least, double most) {
  const double away = random.between(least, most), towards = random.angle();
  return {{away * std::cos(towards), away * std::sin(towards)}, geometry::Rotation::by(random.angle())};
}

/// A star-shaped polygon of random radii, usually not convex.
inline geometry::Polygon random_star(Random& random, int corners, double least_radius, double most_radius) {
  geometry::Polygon polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.between(0.05, 0.95)) / corners;
    const double radius = random.between(least_radius, most_radius);
    polygon.outer.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return polygon;
}

/// Makes a body of a floe with the mass and the moment of inertia of its plate. `position` is the position of the
/// centre of mass.
inline dynamics::NewBody floe_body(const geometry::Polygon& polygon, geometry::Point position, double angle = 0,
                                   double circle_radius = 1.0) {
  constexpr double kThickness = 0.5;
  constexpr double kDensity = 900;
  const geometry::Measures measures = geometry::measure(polygon);
  dynamics::NewBody body;
  body.position = position;
  body.angle = angle;
  body.mass = kDensity * kThickness * measures.area;
  body.moment = kDensity * kThickness * measures.second_moment;
  body.centroid = measures.centroid;
  body.thickness = kThickness;
  body.boundary = std::make_shared<geometry::Boundary>(geometry::make_boundary(polygon, {circle_radius, true}));
  body.drag = std::make_shared<dynamics::DragShape>(dynamics::make_drag_shape(polygon, measures.centroid));
  return body;
}

inline dynamics::BodyIndex add_floe(dynamics::Bodies& bodies, const geometry::Polygon& polygon,
                                    geometry::Point position, geometry::Vector velocity = {},
                                    double angular_velocity = 0, bool is_prescribed = false) {
  dynamics::NewBody body = floe_body(polygon, position);
  body.is_prescribed = is_prescribed;
  body.velocity = velocity;
  body.angular_velocity = angular_velocity;
  return add_body(bodies, body);
}

/// One of prescribed motion.
inline dynamics::BodyIndex add_held(dynamics::Bodies& bodies, const geometry::Polygon& polygon,
                                    geometry::Point position, geometry::Vector velocity = {},
                                    double angular_velocity = 0) {
  return add_floe(bodies, polygon, position, velocity, angular_velocity, true);
}

inline double kinetic_energy(const dynamics::Bodies& bodies) {
  double energy = 0;
  for (dynamics::BodyIndex i = 0; i < bodies.size(); ++i) {
    energy += 0.5 * bodies.mass[i] * squared_length(bodies.velocity[i]) +
              0.5 * bodies.moment[i] * bodies.angular_velocity[i] * bodies.angular_velocity[i];
  }
  return energy;
}

inline double mass(const dynamics::Bodies& bodies) {
  return std::accumulate(bodies.mass.begin(), bodies.mass.end(), 0.0);
}

inline geometry::Vector momentum(const dynamics::Bodies& bodies) {
  geometry::Vector sum;
  for (dynamics::BodyIndex i = 0; i < bodies.size(); ++i) sum += bodies.mass[i] * bodies.velocity[i];
  return sum;
}

/// Returns the angular momentum about the origin.
inline double angular_momentum(const dynamics::Bodies& bodies) {
  double sum = 0;
  for (dynamics::BodyIndex i = 0; i < bodies.size(); ++i) {
    sum += bodies.mass[i] * cross(bodies.position[i] - geometry::Point{}, bodies.velocity[i]) +
           bodies.moment[i] * bodies.angular_velocity[i];
  }
  return sum;
}

inline std::vector<dynamics::BodyIndex> all_of(const dynamics::Bodies& bodies) {
  std::vector<dynamics::BodyIndex> all(static_cast<std::size_t>(bodies.size()));
  for (dynamics::BodyIndex i = 0; i < bodies.size(); ++i) all[static_cast<std::size_t>(i)] = i;
  return all;
}

/// The contacts of bodies that are all awake.
class ContactFinder {
 public:
  explicit ContactFinder(dynamics::Bodies& bodies) : finder_({}, 20) {
    for (const dynamics::BodyIndex i : all_of(bodies)) finder_.add(bodies, i);
    for (const dynamics::BodyIndex i : all_of(bodies)) finder_.wake(bodies, i);
  }
  std::vector<dynamics::Contact>& contacts(dynamics::Bodies& bodies, double time_step) {
    finder_.update(bodies, all_of(bodies));
    finder_.find_contacts(bodies, time_step, contacts_);
    return contacts_;
  }

 private:
  dynamics::BroadPhase finder_;
  std::vector<dynamics::Contact> contacts_;
};

/// A contact over a line of `width` about a point, not limited by crushing.
inline dynamics::Contact contact_at(dynamics::BodyIndex a, dynamics::BodyIndex b, geometry::Point middle,
                                    geometry::Vector normal, double width = 0, double friction = 0) {
  dynamics::Contact contact;
  contact.a = a;
  contact.b = b;
  contact.normal = normal;
  contact.ends[0] = middle - 0.5 * width * perpendicular(normal);
  contact.ends[1] = middle + 0.5 * width * perpendicular(normal);
  contact.tip_of_b = middle;
  contact.width = width;
  contact.friction = friction;
  return contact;
}

/// Returns the velocity of b relative to a in the middle of their contact.
inline geometry::Vector relative_velocity(const dynamics::Bodies& bodies, const dynamics::Contact& c) {
  const auto velocity = [&](dynamics::BodyIndex i) { return velocity_at(bodies, i, c.middle() - bodies.position[i]); };
  return velocity(c.b) - velocity(c.a);
}

/// Speed at which the two bodies of a contact part; negative when approaching [m/s].
inline double parting_speed(const dynamics::Bodies& bodies, const dynamics::Contact& c) {
  return dot(relative_velocity(bodies, c), c.normal);
}

/// Speed of b along a contact's line, as a sees it [m/s].
inline double slip_speed(const dynamics::Bodies& bodies, const dynamics::Contact& c) {
  return dot(relative_velocity(bodies, c), perpendicular(c.normal));
}

}  // namespace polynya::scenery
