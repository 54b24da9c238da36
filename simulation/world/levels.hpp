#pragma once

#include <array>

#include "simulation/world/world.hpp"

namespace polynya::simulation {

// How long steps are: a tick, Scene::time.step, a part of it where a hull goes so fast through ice that it would pass
// through more than it can break, or several for bodies that need no more (components.hpp). The stages of a step take
// its length as it is (Setup::step) and the bodies that are due (Population::due), and have no part in this.

/// The longest way of a hull in a step, relative to ice at it, in thicknesses: F grows to V_b within some tenths.
/// Greater, ice is found late and loads fall.
inline constexpr double kWayOverThickness = 0.15;
/// And times the thickness [m²]: thick ice breaks in a few large cusps, whose order decides on the next ones.
inline constexpr double kWayTimesThickness = 0.0375;
/// Of a floe relative to another, in thicknesses.
inline constexpr double kFloesWayOverThickness = 0.1;
/// And in radii of contact circles: farther on, a contact is lost from one step to the next.
inline constexpr double kWayOverCircle = 0.25;

/// By so much a hull may exceed its way before a tick has one more part: else a ship that goes one way a tick has half
/// the step wherever ice at it moves aside or comes to meet it.
inline constexpr double kWayExceeded = 1.1;

/// Steps are made shorter from so many bends in one on, in the mean of the last ticks. An overlap bends its ice once
/// in a step: where a hull comes on by more than that takes away, overlaps join along it, and the hull passes through.
inline constexpr double kMostBends = 0.75;
/// And longer again below so many. More than half of the above, steps would change in every other tick.
inline constexpr double kFewBends = 0.25;
/// Loads are right up to so many.
inline constexpr double kCrowded = 2;
/// Of the last tick in that mean: two bends in a step of thick ice are by chance.
inline constexpr double kLastTick = 0.125;

/// Of a tick that is chosen: more, and floes meet late that no hull touches; less, and steps are short where a ship is
/// slower than it can be. Of the parts of a tick there must be left some for ice that breaks faster.
inline constexpr double kTickOverStep = 8;
/// Ticks to choose from [s]. Longer ones slow dense ice down: its jams are harder to solve.
inline constexpr std::array kTickChoices{0.05, 0.025, 0.02, 0.01, 0.005, 0.0025, 0.002, 0.001, 0.0005};
/// Where a wall presses, at most [s]: the jams of longer ones take as long in all, and some are not solved
/// (scenes/pressure.json: all of ticks of .025 s, .1 % not of .05 s, 2.6 % not of .1 s).
inline constexpr double kTickUnderPressure = 0.025;
/// A ship's speed in ice by a constant thrust, at most [m/s]: nothing states it. A tick has parts for more.
inline constexpr double kUnderThrust = 4;
/// Of a scene's ice, by area, that its thin ice is thinner than: a few thin floes have parts of ticks.
inline constexpr double kMostIce = 0.95;

/// The longest way of a hull in a step, relative to ice of that thickness [m].
double most_way(const ContactSettings& contact, double thickness);
/// The same of floes, of which the thinner is so thick.
double most_way_of_floes(const ContactSettings& contact, double thickness);

/// The tick of a scene that gives none [s]: kTickOverStep of the longest steps in which its fastest hull stays within
/// its share of its thinnest ice, as a round number that goes into what is recorded. Ships are as fast as at the start,
/// or as their engines make them in open water, and the ice comes on by drift, current and wind.
double default_tick(const Scene& scene);
/// In how many equal parts the next tick is taken: up to 2^levels, 1 where levels is 0 [-].
int parts_of_tick(const Setup& setup, const Clock& clock, const Population& population);

/// Has the next tick taken in more or fewer parts, by the bends of the one that has passed. Returns whether loads
/// depend on the step, in the most parts that there are.
bool follow_bends(const Setup& setup, std::int64_t bends, Clock& clock);

}  // namespace polynya::simulation
