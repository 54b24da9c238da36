#include "simulation/world/parts.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::simulation {
namespace {

/// Returns the distance by which two bodies may approach each other in a tick, where each contributes at most kLargest
/// [m]. The margins of the pair's boxes cover this distance (BroadPhase::update with `ahead` of a tick).
double approach_in_tick(const dynamics::Bodies& bodies, double tick, BodyIndex a, BodyIndex b) {
  // Largest contribution of a body [m]. It must not exceed the margin of a box (kBoxMargin, broad_phase.cpp); otherwise
  // ice that has no pair with the hull is missed.
  constexpr double kLargest = 1;
  return std::min(kLargest, tick * bodies.rim_speed[a]) + std::min(kLargest, tick * bodies.rim_speed[b]);
}

/// Returns the longest step in which a hull moves at most allowed_displacement() relative to any ice that it may reach
/// in the tick [s].
double longest_step(const Setup& setup, const Population& population, BodyIndex hull) {
  const dynamics::Bodies& bodies = population.bodies;
  const double tick = setup.scene.time.step;
  double longest = tick;
  const auto displacement = [&](BodyIndex other) {
    return allowed_displacement(setup.scene.contact, bodies.thickness[other]);
  };
  const auto speed = [&](BodyIndex other) { return length(bodies.velocity[hull] - bodies.velocity[other]); };
  const auto matters = [&](BodyIndex other) {
    return !population.is_hull(other) && speed(other) * longest > displacement(other);
  };
  const auto reach = [&](BodyIndex other) { return approach_in_tick(bodies, tick, hull, other); };
  population.pairs.for_bodies_at(bodies, hull, matters, reach,
                                 [&](BodyIndex other) { longest = displacement(other) / speed(other); });
  return longest;
}

}  // namespace

double allowed_displacement(const ContactSettings& contact, double thickness) {
  return std::min({kDisplacementOverThickness * thickness, kDisplacementTimesThickness / thickness,
                   kDisplacementOverRadius * contact.circle_radius});
}

int parts_of_tick(const Setup& setup, const Pace& pace, const Population& population) {
  const double tick = setup.scene.time.step;
  double longest = tick;
  for (BodyIndex hull = 0; hull < population.hull_count; ++hull)
    longest = std::min(longest, longest_step(setup, population, hull));
  const double needed = std::max(std::ceil(tick / longest / kToleratedExcess),
                                 std::ceil(tick / setup.longest_step_by_walls * (1 - 1e-9)));
  return static_cast<int>(std::min<double>(kMostParts, needed * pace.finer));
}

bool follow_bends(int parts, std::int64_t bends, Pace& pace) {
  pace.bends += kWeightOfLastTick * (static_cast<double>(bends) / parts - pace.bends);
  const bool is_finest = parts == kMostParts;
  if (pace.bends > kManyBends && !is_finest) {
    pace.finer *= 2;
    pace.bends /= 2;
  } else if (pace.bends < kFewBends && pace.finer > 1) {
    pace.finer /= 2;
    pace.bends *= 2;
  }
  return is_finest && pace.bends > kCrowdedBends;
}

}  // namespace polynya::simulation
