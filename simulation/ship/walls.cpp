#include <algorithm>

#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using geometry::Vector;

/// A wall that presses on the ice, with its body and its present normal.
struct PressingWall {
  const Wall& wall;
  BodyIndex body = 0;
  Vector normal;  ///< unit normal into the ice
};

/// Calls use(wall) for each wall that presses.
template <class Use>
void for_pressing(const Setup& setup, const Population& population, Use use) {
  auto body = population.hull_count - static_cast<BodyIndex>(setup.scene.walls.size());
  for (const Wall& wall : setup.scene.walls) {
    const geometry::Rotation rotation = population.bodies.rotation[body];
    if (wall.pressure) use(PressingWall{wall, body, {rotation.cosine, rotation.sine}});
    ++body;
  }
}

/// Sets the velocity of a wall, and adds the impulse and the work of the change to the accounts.
void change_velocity(Vector to, BodyIndex wall, dynamics::Bodies& bodies, AuditSums& audit) {
  const Vector before = bodies.velocity[wall];
  const Vector impulse = bodies.mass[wall] * (to - before);
  audit.boundaries.walls += 0.5 * dot(impulse, before + to);
  audit.boundaries.wall_impulse += impulse;
  audit.impulses += length(impulse);
  bodies.velocity[wall] = to;
}

}  // namespace

void follow_water(const Setup& setup, const Step& step, Population& population, AuditSums& audit) {
  const Vector change = step.water_velocity - population.water_velocity;
  population.water_velocity = step.water_velocity;
  if (change == Vector{}) return;
  dynamics::Bodies& bodies = population.bodies;
  for (BodyIndex i = 0; i < bodies.size(); ++i) {
    if (bodies.is_alive[i] == 0 || bodies.inverse_mass[i] != 0) continue;
    bodies.velocity[i] -= change;
    wake(i, population);
  }
  for_pressing(setup, population, [&](const PressingWall& p) {
    change_velocity(bodies.velocity[p.body] - change, p.body, bodies, audit);
  });
}

void press_walls(const Setup& setup, const Step& step, Population& population, AuditSums& audit) {
  for_pressing(setup, population, [&](const PressingWall& p) {
    dynamics::Bodies& bodies = population.bodies;
    // M dv/dt = q L (1 − v/v_c), with the speed v over ground along the normal. The damping uses the speed at the start
    // of the step, which the ice has determined. If the ice resists the whole load, the force on it is then exactly q
    // L.
    const double most = step.length * p.wall.load() / bodies.mass[p.body];
    const double speed = dot(bodies.velocity[p.body] + population.water_velocity, p.normal);
    const double closing_speed = p.wall.pressure->closing_speed;
    const double gain = std::min(most, closing_speed) * (1 - speed / closing_speed);
    change_velocity(bodies.velocity[p.body] + gain * p.normal, p.body, bodies, audit);
  });
}

void constrain_walls(const Setup& setup, Population& population, AuditSums& audit) {
  for_pressing(setup, population, [&](const PressingWall& p) {
    const Vector over_ground = population.bodies.velocity[p.body] + population.water_velocity;
    const Vector held = dot(over_ground, p.normal) * p.normal - population.water_velocity;
    change_velocity(held, p.body, population.bodies, audit);
    population.bodies.angular_velocity[p.body] = 0;  // the moment of inertia is finite, so rounding may turn the wall
  });
}

}  // namespace polynya::simulation
