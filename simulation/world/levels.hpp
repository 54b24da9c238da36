#pragma once

#include "simulation/world/world.hpp"

namespace polynya::simulation {

// How long steps are: a tick, Scene::time.step, a part of it where a hull goes so fast through ice that it would pass
// through more than it can break, or several for bodies that need no more (components.hpp). The stages of a step take
// its length as it is (Setup::step) and the bodies that are due (Population::due), and have no part in this.

/// The longest way of a hull in a step, relative to ice at it, in thicknesses: F grows to V_b within some tenths.
/// Greater, ice is found late and loads fall.
inline constexpr double kWayOverThickness = 0.1;
/// And in radii of contact circles: farther on, a contact is lost from one step to the next.
inline constexpr double kWayOverCircle = 0.25;

/// Steps are made shorter from so many bends in one on, in the mean of the last ticks. An overlap bends its ice once
/// in a step: where a hull comes on by more than that takes away, overlaps join along it, and the hull passes through.
inline constexpr double kMostBends = 0.75;
/// And longer again below so many. More than half of the above, steps would change in every other tick.
inline constexpr double kFewBends = 0.25;
/// Loads are right up to so many.
inline constexpr double kCrowded = 2;
/// Of the last tick in that mean: two bends in a step of thick ice are by chance.
inline constexpr double kLastTick = 0.125;

/// The longest way in a step, relative to ice of that thickness [m].
double most_way(const Setup& setup, double thickness);

/// In how many equal parts the next tick is taken: a power of two up to 2^levels, 1 where levels is 0 [-].
int parts_of_tick(const Setup& setup, const Clock& clock, const Population& population);

/// Has the next tick taken in more or fewer parts, by the bends of the one that has passed. Returns whether loads
/// depend on the step, in the most parts that there are.
bool follow_bends(const Setup& setup, std::int64_t bends, Clock& clock);

}  // namespace polynya::simulation
