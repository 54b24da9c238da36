#include "simulation/world/levels.hpp"

#include <algorithm>

namespace polynya::simulation {
namespace {

/// The longest step in which a hull stays within its share of the ice that is at it [s].
double longest_step(const Setup& setup, const Population& population, BodyIndex hull) {
  const dynamics::Bodies& bodies = population.bodies;
  double longest = setup.scene.time.step;
  population.pairs.for_bodies_at(bodies, hull, [&](BodyIndex other) {
    if (population.is_hull(other)) return;
    const double way = most_way(setup, bodies.thickness[other]);
    const double speed = length(bodies.velocity[hull] - bodies.velocity[other]);
    if (speed * longest > way) longest = way / speed;
  });
  return longest;
}

}  // namespace

double most_way(const Setup& setup, double thickness) {
  return std::min(kWayOverThickness * thickness, kWayOverCircle * setup.scene.contact.circle_radius);
}

int parts_of_tick(const Setup& setup, const Clock& clock, const Population& population) {
  const int most = 1 << setup.levels;
  if (most == 1) return 1;
  double longest = setup.scene.time.step;
  for (BodyIndex hull = 0; hull < population.hull_count; ++hull)
    longest = std::min(longest, longest_step(setup, population, hull));
  int parts = 1;
  while (parts < most && parts * longest < setup.scene.time.step) parts *= 2;
  return std::min(most, parts * clock.finer);
}

bool follow_bends(const Setup& setup, std::int64_t bends, Clock& clock) {
  if (setup.levels == 0) return false;
  const double in_a_step = static_cast<double>(bends) / clock.parts;
  clock.bends += kLastTick * (in_a_step - clock.bends);
  const bool is_finest = clock.parts == 1 << setup.levels;
  if (clock.bends > kMostBends && !is_finest) {
    clock.finer *= 2;
    clock.bends /= 2;
  } else if (clock.bends < kFewBends && clock.finer > 1) {
    clock.finer /= 2;
    clock.bends *= 2;
  }
  return is_finest && clock.bends > kCrowded;
}

}  // namespace polynya::simulation
