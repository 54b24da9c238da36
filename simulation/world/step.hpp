#pragma once

#include <span>
#include <string_view>

#include "simulation/world/world.hpp"

namespace polynya::simulation {

// One tick of a run, and the stages of a time step. Every stage is called with the same step and with the parts of the
// world that it needs: a parameter that is a reference to const is only read, and any other reference is changed. The
// stages before integrate_motion() see the bodies at step.begin, the later ones at step.end. Only the stages from
// apply_fractures() to surface_ice(), and cut_through_floes() at the end of a tick, create and remove floes. They run
// on one thread, in an order that does not depend on the number of threads. The functions are grouped by subject;
// stages_of() has the order in which they run. With the law of crushing ice, apply_forces() and push_ships() come
// before find_pairs(). end_tick(), and not a step, calls cut_through_floes(), put_to_rest() and sample_loads().

// ---- before the contacts

/// Sets levers and steering of ships with an engine to the commands of the scene's pilots at the start of a run, and
/// initializes the memory of the pilots.
void initialize_helms(const Setup& setup, const Step& step, Population& population);

/// Gives the water frame its mean velocity over the step. The frame is accelerated when the drift changes. Bodies of
/// prescribed motion and walls keep their velocity over ground. Free bodies keep their velocity in the water frame,
/// because the slope of the water surface that accelerates the water also accelerates them.
void follow_water(const Setup& setup, const Step& step, Population& population, AuditSums& audit);

/// Calls the pilots, and moves levers and steering towards their commands, no faster than their rates allow. `external`
/// are pilots from outside, by ship; they replace the pilots of the scene.
void steer(const Setup& setup, const Step& step, const std::vector<ExternalPilot>& external, Population& population);

/// Accelerates the walls that press by their loads. It is done before the contacts are solved, so that the ice resists
/// within the same step.
void press_walls(const Setup& setup, const Step& step, Population& population, AuditSums& audit);

/// Stores the ships' motion before the step's impulses, from which sail() takes the part of the added mass, and the
/// poses of all hulls, from which records find the place of a contact on the waterline.
void store_motion(const Population& population, StepData& data);

// ---- contacts and their impulses

/// Updates the pairs of bodies that are near each other at the start of the step.
void find_pairs(const Step& step, Population& population);

/// Finds the contacts of all pairs, the contacts that have ended (StepData::parted), and the overlaps that no contact
/// can separate (StepData::inseparable_overlaps).
void find_contacts(const Step& step, Population& population, StepData& data, Counts& counts);

/// Law of crushing ice: sets the crushing force of each contact, the limits of its force, and the force at which its
/// ice bends.
void decide_by_crushing(const Setup& setup, const Step& step, const Population& population, StepData& data);

/// Law of impulses: sets the limit of each contact's force, and decides by the collision force j/τ_c whether its ice
/// breaks. j is the impulse of the collision, and τ_c is its assumed duration.
void decide_by_collision(const Setup& setup, const Step& step, const Population& population, StepData& data);

/// Reduces the forces of contacts that press floes down to the largest force with which the floes resist while the
/// slope of the hull slides their edges down.
void limit_by_tilt(const Setup& setup, const Step& step, const Population& population, StepData& data);

/// Law of crushing ice: computes the impulses of all contacts, and finds the floes that split. If the forces exceed
/// those at which a floe splits, they are limited to them and the step is solved again (ice/split_instant.hpp).
void solve_crushing(const Setup& setup, const Step& step, Population& population, StepData& data, Accounts& accounts);

/// Law of impulses: computes the impulses of all contacts, and finds the floes that split.
void solve_collisions(const Setup& setup, const Step& step, Population& population, StepData& data, Accounts& accounts);

/// Keeps only the velocity of pressing walls along their normals, and sets their angular velocity to 0. Without it
/// contacts would push these walls sideways and turn them.
void constrain_walls(const Setup& setup, Population& population, AuditSums& audit);

/// Law of crushing ice: removes the bends whose contacts were not loaded up to V_b, the force at which their ice bends.
void drop_unreached_bends(StepData& data);

/// Adds the splits by the true forces of the step to its fractures, and enters the true forces into the criteria of its
/// other fractures for the records.
void enter_splits(const Setup& setup, const Step& step, const Population& population, StepData& data);

/// Law of crushing ice: returns a reason to end the run if a load of the step is more than four times the largest force
/// that its ice can carry (kOverloadFactor in ice/prescribed.cpp), which is a numerical failure.
std::optional<std::string> overload_of(const Setup& setup, const Step& step, const Population& population,
                                       const StepData& data);

/// Moves the edges of floes that hulls press down, and lists the floes that go under (StepData::submersions).
void tilt_floes(const Setup& setup, const Step& step, Population& population, StepData& data);

/// Law of crushing ice: adds the growth of each paid overlap in the step to the contact's account (dynamics::Booked).
/// An overlap is paid if its ice is gone. Growth that work has paid counts as crushed; growth where the ice edge gave
/// way counts as tilted.
void book_overlaps(const Setup& setup, const Step& step, const Population& population, const StepData& data);

/// Adds the impulses of contacts to the loads of the hulls in the step.
void tally_loads(const Population& population, const std::vector<dynamics::Contact>& contacts,
                 std::vector<HullLoads>& loads);

// ---- forces and motion

/// Applies the drag of the water and the stress of the wind to all awake floes. Hulls have no DragShape; the water's
/// forces on ships are applied by sail().
void apply_forces(const Setup& setup, const Step& step, Population& population, AuditSums& audit);

/// Gives ships their constant thrust and, if there are any, the forces from outside in each ship's frame [N, N m].
void push_ships(const Setup& setup, const Step& step, std::span<const dynamics::Planar> external_forces,
                Population& population, AuditSums& audit);

/// Brakes ships by the ice under their hulls, and moves that ice along its path under the hull.
void pull_of_submerged_ice(const Setup& setup, const Step& step, Population& population, std::vector<HullLoads>& loads,
                           AuditSums& audit);

/// Moves ships by water, engine, steering and mooring (ship/sailing.hpp). The stages before it give their impulses to
/// ships without added mass, and the added mass takes its part of them here. It takes no part of later impulses, those
/// by which apply_fractures() brakes ships.
void sail(const Setup& setup, const Step& step, StepData& data, Population& population, Accounts& accounts);

/// Law of impulses: pushes overlaps apart, over several steps. Adds the work that this does on moorings to the
/// accounts.
void separate_overlaps(const Setup& setup, const Step& step, const StepData& data, Population& population,
                       AuditSums& audit);

/// Moves all awake bodies. Returns a reason to end the run if a body has no finite speed below kRunawaySpeed.
std::optional<std::string> integrate_motion(const Step& step, Population& population);

// ---- changes of the ice

/// Breaks the floes whose fractures were decided in the step. Ships are braked by the cusps that they accelerate.
void apply_fractures(const Setup& setup, const Step& step, StepData& data, Population& population, Books books);

/// Cuts off overlaps that no contact can part, and makes them brash, by both laws. Without it two bodies would stay one
/// inside the other.
void grind_inseparable_overlaps(const Setup& setup, const Step& step, const StepData& data, Population& population,
                                Books books);

/// Law of crushing ice: cuts the outlines of hulls of prescribed motion out of fast ice. The ice becomes brash.
void carve_channels(const Setup& setup, const Step& step, const StepData& data, Population& population, Books books);

/// Law of crushing ice: cuts crushed ice off floes, after a contact has ended, or when it has crushed 0.5 % of the area
/// of the smaller body (kLeastCrushedShare in ice/overlaps.cpp). The ice becomes brash.
void shed_crushed_ice(const Setup& setup, const Step& step, const StepData& data, Population& population, Books books);

/// Law of crushing ice: cuts floes that a hull has divided into their remaining parts. The ice inside the hull becomes
/// brash.
void cut_through_floes(const Setup& setup, const Step& step, const StepData& data, Population& population, Books books);

/// Puts the floes that tilted far enough under the hulls.
void apply_submersions(const Setup& setup, const Step& step, const StepData& data, Population& population, Books books);

/// Lets ice that ships have passed surface, in the order in which it went under.
void surface_ice(const Setup& setup, const Step& step, Population& population, Books books);

// ---- records

/// Records the first contact of each two hulls, and the moorings that broke.
void record_hull_contacts(const Setup& setup, const Step& step, const Population& population, const StepData& data,
                          Books books);

/// Adds the step's loads to those of the recording interval.
void sum_loads(const Step& step, const StepData& data, Accounts& accounts);

/// Puts floes to sleep that touch nothing, whose fastest point is slower than kRestSpeed, and that neither wind nor a
/// sheared current would move. Fast ice that moves stays awake.
void put_to_rest(const Setup& setup, const StepData& data, Population& population, AuditSums& audit);

/// Adds a sample for each hull and each loaded panel to the journal, and starts new sums. Impulses that contacts missed
/// before they were found and that are not booked yet (CarriedLoad) are kept for the next interval.
void sample_loads(const Setup& setup, const Clock& clock, const Population& population, Books books);

/// A stage of a step: its name, by which the benchmarks list its time, and a function that calls it with the parts of
/// the world that it needs.
struct Stage {
  std::string_view name;
  void (*run)(World& world, const Step& step);
};

/// Returns the stages of a step for a law of contact, in their order.
std::span<const Stage> stages_of(ContactLaw law);

/// Returns one of the equal parts of the tick that follows the clock. The whole tick is part 0 of 1.
Step step_of(const Setup& setup, const Clock& clock, int part, int parts);

/// Performs the work that is done once in a tick, after its last part. At their intervals, floes that hulls have
/// divided are cut, floes are put to sleep, and samples are taken.
void end_tick(World& world);

/// Advances the world by one tick: executes all stages in each of the tick's parts (parts.hpp). If a stage finds that
/// the run cannot continue, it sets World::failure, and the later parts of the tick are left out.
void step(World& world);

}  // namespace polynya::simulation
