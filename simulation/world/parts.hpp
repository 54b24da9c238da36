#pragma once

#include "simulation/world/world.hpp"

namespace polynya::simulation {

// A tick (Scene::time.step) is taken in equal parts where one step of that length would be too long for what happens
// in it. All awake bodies take the same parts, so that all of them are at the same instant after each part. By the law
// of impulses a tick is one step.

/// The most parts of a tick. More would make a tick that is chosen too long for its ship even slower to compute; ice
/// that needs more is counted (Counts::crowded_ticks) and warned of.
inline constexpr int kMostParts = 32;

/// Fraction of the ice thickness that a hull may move in one step relative to ice at it [-]. Within some tenths of the
/// thickness the crushing force grows to the force at which ice bends. Larger values find ice late, and loads fall.
inline constexpr double kWayOverThickness = 0.15;
/// The same for thick ice: the way times the thickness [m²]. Thick ice breaks in a few large cusps, and the order in
/// which they break decides where the next ones form. Larger values change that order.
inline constexpr double kWayTimesThickness = 0.0375;
/// Fraction of the radius of contact circles that a hull may move in one step relative to ice at it [-]. Larger values
/// lose contacts from one step to the next.
inline constexpr double kWayOverCircle = 0.25;
/// Factor by which a hull may exceed that way before a tick gets one more part [-]. At 1, a ship that moves just that
/// way in a tick would take two parts wherever ice comes to meet it.
inline constexpr double kWayExceeded = 1.1;

/// Longest step of a scene in which a wall presses [s]. Jams between walls take more sweeps to solve in longer steps,
/// and some are not solved.
inline constexpr double kStepUnderPressure = 0.025;

/// Mean number of bends in a step above which ticks get twice as many parts [-]. An overlap bends its ice once in a
/// step: where a hull comes on by more than one cusp in a step, overlaps join along it and it passes through the ice.
inline constexpr double kMostBends = 0.75;
/// Mean number of bends in a step below which ticks get half as many parts again [-]. It must be less than half of
/// kMostBends, or parts would change in every other tick.
inline constexpr double kFewBends = 0.25;
/// Mean number of bends in a step up to which loads are independent of the step [-].
inline constexpr double kCrowded = 2;
/// Weight of the last tick in that mean [-]. At 1, two bends that happen to fall into one step of thick ice would
/// change the parts.
inline constexpr double kLastTick = 0.125;

/// The longest way of a hull relative to ice of a thickness in one step [m].
double most_way(const ContactSettings& contact, double thickness);

/// The number of equal parts that the next tick has, from 1 to kMostParts: as many as keep every hull within
/// most_way() of the ice that it may reach in the tick, and steps within Setup::longest_step_by_walls; times
/// Pace::finer.
int parts_of_tick(const Setup& setup, const Pace& pace, const Population& population);

/// Adjusts the pace after a tick of so many parts with so many bends. Returns true if loads depend on the step although
/// the tick had the most parts.
bool follow_bends(int parts, std::int64_t bends, Pace& pace);

}  // namespace polynya::simulation
