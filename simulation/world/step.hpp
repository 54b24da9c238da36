#pragma once

#include <span>
#include <string_view>

#include "simulation/world/world.hpp"

namespace polynya::simulation {

// One tick of a run, and the stages of a time step. The clock stands still while stages run: a stage is given the
// step, reads what it takes as const, and changes only what it takes as a plain reference. Stages before
// integrate_motion see the bodies at step.begin, the ones behind it at step.end. Only the stages from apply_fractures
// to come_up change which floes there are; they work serially, in an order that does not depend on threads.

// ---- before the contacts

/// Sets levers and steering to what the pilots command at the start of the run.
void take_helms(const Setup& setup, const Step& step, Population& population);

/// Gives the water frame its mean velocity over the step. Bodies of prescribed motion and walls keep their velocity
/// over ground. Free bodies keep theirs in the water, because the slope of its surface speeds both up alike.
void follow_water(const Setup& setup, const Step& step, Population& population, AuditSums& audit);

/// Asks the pilots, and moves levers and steering towards their commands.
void steer(const Setup& setup, const Step& step, const std::vector<ExternalPilot>& external, Population& population);

/// Accelerates the walls that press by their loads, so that the ice answers within the step.
void press_walls(const Setup& setup, const Step& step, Population& population, AuditSums& audit);

/// Stores the ships' motion before the step's impulses, and the places of all hulls.
void keep_motion(const Population& population, StepData& data);

// ---- contacts and their impulses

/// Updates the pairs of bodies that are near each other.
void find_pairs(const Step& step, Population& population);

/// Finds the contacts of all pairs.
void find_contacts(const Step& step, Population& population, StepData& data, Counts& counts);

/// Law of crushing ice: finds what each contact can bear, and at which force its ice bends.
void decide_by_crushing(const Setup& setup, const Step& step, const Population& population, StepData& data);

/// Law of impulses: finds what each contact can bear, and whether its ice breaks by the collision force j/τ_c.
void decide_by_collision(const Setup& setup, const Step& step, const Population& population, StepData& data);

/// Reduces what contacts bear to what the floes that they press down resist.
void limit_by_tilt(const Setup& setup, const Step& step, const Population& population, StepData& data);

/// Law of crushing ice: finds the impulses of all contacts, and which floes split by them. Where the contacts would
/// bear more than a split needs, they are stopped there and the step is solved again (ice/split_instant.hpp).
void solve_crushing(const Setup& setup, const Step& step, Population& population, StepData& data, Accounts& accounts);

/// Law of impulses: finds the impulses of all contacts, and which floes split by them.
void solve_collisions(const Setup& setup, const Step& step, Population& population, StepData& data, Accounts& accounts);

/// Takes from walls that press all velocity that is not along their normals.
void hold_walls(const Setup& setup, Population& population, AuditSums& audit);

/// Law of crushing ice: removes the bends whose contacts were not loaded up to V_b.
void drop_unbroken(StepData& data);

/// Adds the splits by true forces to the fractures of the step, and the true forces to its other fractures.
void enter_splits(const Setup& setup, const Step& step, const Population& population, StepData& data);

/// Law of crushing ice: returns why the step's loads cannot be trusted, where one exceeds all that its ice can bear.
std::optional<std::string> overload_of(const Setup& setup, const Step& step, const Population& population,
                                       const StepData& data);

/// Turns the edges of floes that hulls press down, and lists the floes that are to go under.
void tilt_floes(const Setup& setup, const Step& step, Population& population, StepData& data);

/// Law of crushing ice: books what each overlap has grown in the step as crushed, with its work, or as tilted, where
/// the ice edge gave way.
void book_overlaps(const Setup& setup, const Step& step, const Population& population, const StepData& data);

/// Sums what the impulses did to the hulls.
void tally_loads(const Population& population, const std::vector<dynamics::Contact>& contacts,
                 std::vector<HullLoads>& loads);

// ---- forces and motion

/// Lets water and wind act on all awake bodies.
void apply_forces(const Setup& setup, const Step& step, Population& population, AuditSums& audit);

/// Gives ships their constant thrust, and the forces from outside, if any [N, N m].
void push_ships(const Setup& setup, const Step& step, std::span<const dynamics::Planar> external_forces,
                Population& population, AuditSums& audit);

/// Brakes ships by the ice under their hulls, and moves that ice along its path.
void pull_of_submerged_ice(const Setup& setup, const Step& step, Population& population, std::vector<HullLoads>& loads,
                           AuditSums& audit);

/// Moves ships by water, engine, steering and mooring (ship/sailing.hpp). It is the last of the step's impulses, since
/// the water around a ship takes its share of all others.
void sail(const Setup& setup, const Step& step, StepData& data, Population& population, Accounts& accounts);

/// Law of impulses: pushes overlaps apart, over several steps. Adds the work that this does on moorings to the
/// accounts.
void separate_overlaps(const Setup& setup, const Step& step, const StepData& data, Population& population,
                       AuditSums& audit);

/// Moves all awake bodies. Returns why the numbers cannot be trusted any more, where a body has no finite speed below
/// kRunawaySpeed.
std::optional<std::string> integrate_motion(const Step& step, Population& population);

// ---- what happens to the ice

/// Breaks the floes whose fractures the step has decided. Ships are braked by the cusps that they push down.
void apply_fractures(const Setup& setup, const Step& step, StepData& data, Population& population, Books books);

/// Cuts overlaps that no contact can part from the floe and makes them brash.
void grind_blind_overlaps(const Setup& setup, const Step& step, const StepData& data, Population& population,
                          Books books);

/// Law of crushing ice: cuts the ice that hulls of prescribed motion have crushed out of fast ice, and makes it brash.
void carve_channels(const Setup& setup, const Step& step, const StepData& data, Population& population, Books books);

/// Law of crushing ice: cuts off what contacts crushed that have parted, or that crushed much, and makes it brash.
void shed_crushed_ice(const Setup& setup, const Step& step, const StepData& data, Population& population, Books books);

/// Law of crushing ice: cuts floes that hulls have come through into their remaining parts. The ice within the hull
/// becomes brash.
void cut_through_floes(const Setup& setup, const Step& step, const StepData& data, Population& population, Books books);

/// Puts floes that tilted far enough under the hulls.
void apply_submersions(const Setup& setup, const Step& step, const StepData& data, Population& population, Books books);

/// Lets ice that ships have passed come up, in the order in which it went under.
void come_up(const Setup& setup, const Step& step, Population& population, Books books);

// ---- what is recorded

/// Records the first contact of each two hulls, and the moorings that broke.
void record_hull_contacts(const Setup& setup, const Step& step, const Population& population, const StepData& data,
                          Books books);

/// Adds the step's loads to those of the recording interval.
void sum_loads(const Step& step, const StepData& data, Accounts& accounts);

/// Puts floes to sleep that are as good as at rest and touch nothing.
void put_to_rest(const Setup& setup, const StepData& data, Population& population, AuditSums& audit);

/// Writes a row for each hull and panel, and begins new sums.
void sample_loads(const Setup& setup, const Clock& clock, const Population& population, Books books);

/// A stage of a step, with the parts of the world that it takes.
struct Stage {
  std::string_view name;
  void (*run)(World& world, const Step& step);
};

/// The stages of a step by a law of contacts, in their order.
std::span<const Stage> stages_of(ContactLaw law);

/// The given one of the equal parts of the tick that follows the clock; the whole tick is part 0 of 1.
Step step_of(const Setup& setup, const Clock& clock, int part, int parts);

/// Does what is done once in a tick, after its last part: floes that hulls pierce are cut, floes are put to rest, and
/// rows are written, each at its interval.
void end_tick(World& world);

/// Advances the world by one tick: all stages, in each of the tick's parts (parts.hpp).
void step(World& world);

}  // namespace polynya::simulation
