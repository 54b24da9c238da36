#pragma once

#include "simulation/world/world.hpp"

namespace polynya::simulation {

// Division of a tick (Scene::time.step) into equal parts, where a single step of that length would be too long for the
// events in it. A part is then one step of the simulation. All awake bodies take the same parts, so all of them are at
// the same instant after each part. With the law of impulses a tick is always one step (step.cpp).

/// Largest number of parts of a tick. If so much ice bends that more would be needed, the tick is counted
/// (Counts::crowded_ticks), and the run gives a warning. A tick that would need more parts because of the displacement
/// of a hull is not counted: the hull then moves farther in a step than allowed. With a larger number, ticks that are
/// too long for their ship would take more time to compute. The check of a scene also uses the number: it judges speeds
/// by the shortest step, the tick divided by kMostParts.
inline constexpr int kMostParts = 32;

// The next three limits apply together (allowed_displacement()). They determine the number of parts by the motion of
// hulls. The automatic choice of the tick (default_tick.hpp) applies them to the motion of floes as well.

/// Largest displacement of a hull relative to ice in one step, as a fraction of the ice thickness [-]. The crushing
/// force grows to the force at which ice bends within some tenths of the thickness. Larger values find contacts too
/// late, and loads become too small; smaller values cost time.
inline constexpr double kDisplacementOverThickness = 0.15;
/// Largest displacement of a hull relative to ice in one step, times the ice thickness [m²]. It is the stricter limit
/// for ice thicker than 0.5 m. Thick ice breaks in a few large cusps, and the order in which they break determines
/// where the next ones form. Larger values change that order.
inline constexpr double kDisplacementTimesThickness = 0.0375;
/// Largest displacement of a hull relative to ice in one step, as a fraction of ContactSettings::circle_radius [-]. It
/// matters for radii below 0.3 m. Larger values lose contacts from one step to the next, because a contact that moved
/// farther is not recognized. The automatic choice of the tick also applies it to the rims of floes.
inline constexpr double kDisplacementOverRadius = 0.25;
/// Factor by which a hull may exceed the allowed displacement before a tick is divided further [-]. With 1, a ship
/// whose displacement in a tick is just the allowed one would need two parts wherever ice moves towards it. Larger
/// values have the effect of larger limits above.
inline constexpr double kToleratedExcess = 1.1;

/// Longest step of a scene with walls that press ice together [s]; longest_step_by_walls() may require a shorter one.
/// In longer steps, jams between walls need more sweeps of the contact solver, and some are not solved; shorter steps
/// cost time.
inline constexpr double kStepUnderPressure = 0.025;

/// Mean number of bends in a step above which ticks are divided into twice as many parts [-]. Here and below, the bends
/// of the whole scene count together. A contact can bend its ice only once in a step. If a hull advances by more than
/// one cusp in a step, overlaps along it join, and the hull passes through ice without breaking it. Larger values make
/// loads depend on the step; smaller values cost time.
inline constexpr double kManyBends = 0.75;
/// Mean number of bends in a step below which the factor on the number of parts (Pace::finer), which kManyBends has
/// doubled, is halved again, down to 1 [-]. It must be less than half of kManyBends, because halving the parts
/// doubles the bends in each; otherwise the number of parts would change in every other tick.
inline constexpr double kFewBends = 0.25;
/// Mean number of bends in a step above which loads are taken to depend on the step, if the tick already has kMostParts
/// parts [-]. Such ticks are counted in Counts::crowded_ticks. The value affects only this count and its warning: a
/// larger one would not warn of some runs whose loads are too small.
inline constexpr double kCrowdedBends = 2;
/// Weight of the last tick in the running mean of bends in a step, Pace::bends [-]: a mean over about eight ticks. With
/// 1, two bends that happen to fall into one step in thick ice would change the number of parts. Smaller values adapt
/// the number of parts more slowly.
inline constexpr double kWeightOfLastTick = 0.125;

/// Returns the largest displacement of a hull relative to ice of a thickness [m] in one step [m]: the smallest of the
/// three limits above.
double allowed_displacement(const ContactSettings& contact, double thickness);

/// Returns the number of equal parts of the next tick, from 1 to kMostParts. It is the smallest number with which every
/// hull stays within kToleratedExcess times allowed_displacement() relative to each body of ice that it may reach in
/// the tick, and with which steps are no longer than Setup::longest_step_by_walls. Displacements follow from the
/// velocities of the centres of mass; rotation only extends what a hull may reach. This number is multiplied by
/// Pace::finer, the factor that many bends have raised. The product is limited to kMostParts; steps may then be longer
/// than these limits.
int parts_of_tick(const Setup& setup, const Pace& pace, const Population& population);

/// Updates the pace, by which the parts of the next ticks are chosen, after a tick with the given numbers of parts and
/// of bends. If it doubles or halves Pace::finer, it halves or doubles the running mean, Pace::bends, to the value that
/// the new parts are expected to have. It does not raise the factor after a tick of kMostParts parts, so the factor is
/// at most kMostParts. Saved states contain the pace. Returns true if the mean number of bends in a step exceeds
/// kCrowdedBends although the tick had the largest number of parts; the caller counts such ticks.
bool follow_bends(int parts, std::int64_t bends, Pace& pace);

}  // namespace polynya::simulation
