#include <algorithm>
#include <cmath>

#include "geometry/contact/first_touch.hpp"
#include "simulation/step.hpp"

namespace polynya::simulation {
namespace {

using geometry::Point;
using geometry::Vector;

bool is_known(const World& world, BodyIndex ship, BodyIndex other) {
  return std::ranges::any_of(world.ship_contacts,
                             [&](const ShipContact& c) { return c.ship == ship && c.other == other; });
}

void note(World& world, const ShipContact& contact) {
  world.ship_contacts.push_back(contact);
  world.journal.ship_contacts.push_back(contact);
}

/// Where the scene prescribes the motion of both, the contact search leaves the two out: no impulse moves
/// them.
bool are_both_held(const dynamics::Bodies& bodies, BodyIndex ship, BodyIndex other) {
  return bodies.inverse_mass[ship] == 0 && bodies.inverse_mass[other] == 0;
}

geometry::Ring waterline_in_water(const World& world, BodyIndex ship) {
  const geometry::Pose pose = dynamics::water_from_body(world.bodies, ship);
  geometry::Ring ring = world.scene.ships[static_cast<std::size_t>(ship)].hull.waterline;
  for (Point& p : ring) p = transform(pose, p);
  return ring;
}

/// Notes the contact of two held ships whose outlines came to touch in the step.
void note_held_pair(World& world, BodyIndex ship, BodyIndex other) {
  const dynamics::Bodies& bodies = world.bodies;
  const Vector velocity = bodies.velocity[other] - bodies.velocity[ship];
  const double speed = length(velocity);
  const double dt = world.scene.time.step;
  // The touch may lie in the step before, where rounding hid it.
  const double earliest = -2 * dt;
  const double reach = bodies.bounding_radius[ship] + bodies.bounding_radius[other] - earliest * speed;
  if (speed == 0 || distance(bodies.position[ship], bodies.position[other]) > reach) return;
  if (is_known(world, ship, other)) return;
  const auto touch = geometry::first_touch(waterline_in_water(world, ship), waterline_in_water(world, other),
                                           velocity, earliest, 0);
  if (!touch) return;
  note(world, {.time = world.time(),
               .ship = ship,
               .other = other,
               .point_in_world = touch->point + world.drift(),
               .closing_speed = -dot(velocity, touch->normal),
               .relative_speed = speed,
               .is_prescribed = true});
}

}  // namespace

void note_ship_contacts(World& world) {
  for (const dynamics::Contact& c : world.contacts) {
    if (!world.is_ship(c.b) || is_known(world, c.a, c.b)) continue;
    note(world, {.time = world.time(),
                 .ship = c.a,
                 .other = c.b,
                 .point_in_world = c.middle() + world.drift(),
                 .closing_speed = c.approach_speed,
                 .relative_speed = std::hypot(c.approach_speed, c.slip_speed)});
  }
  for (BodyIndex ship = 0; ship < world.ship_count(); ++ship) {
    for (BodyIndex other = ship + 1; other < world.ship_count(); ++other) {
      if (are_both_held(world.bodies, ship, other)) note_held_pair(world, ship, other);
    }
  }
}

}  // namespace polynya::simulation
