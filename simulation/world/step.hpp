#pragma once

#include <array>
#include <string_view>

#include "simulation/world/world.hpp"

namespace polynya::simulation {

// The stages of one time step. A stage reads what it takes as const and changes only what it takes as a
// plain reference.

/// Puts levers and steering where the pilots' first commands want them.
void take_helms(const Setup& setup, const Clock& clock, Population& population);

/// Where the drift changes, gives the water frame its mean velocity over the step, and keeps what stands or moves
/// over ground at its velocity there. Free bodies go with the water: what speeds it up, the slope of its surface,
/// speeds them up alike.
void follow_water(const Setup& setup, Clock& clock, Population& population, AuditSums& audit);

/// Asks the pilots, and moves levers and steering towards their commands.
void steer(const Setup& setup, const Clock& clock, const std::vector<ExternalPilot>& external, Population& population);

/// Moves the walls that press by their loads. Before the contacts, so that the ice answers within the step.
void press_walls(const Setup& setup, const Clock& clock, Population& population, AuditSums& audit);

/// Takes from walls that press what impulses gave them beside their normals.
void hold_walls(const Setup& setup, const Clock& clock, Population& population, AuditSums& audit);

/// Keeps the ships' motion before the step's impulses, and where all hulls are.
void keep_motion(const Population& population, StepData& step);

void find_pairs(int threads, Population& population);

void find_contacts(const Setup& setup, int threads, const Components& components, Population& population,
                   StepData& step, Counts& counts);

/// What each contact can carry, and whether ice breaks there: impulse, crush, bend or split.
void decide(const Setup& setup, const Clock& clock, int threads, const Population& population, StepData& step,
            Counts& counts);

/// Limits what contacts carry by what the floes that they press down resist.
void limit_by_tilt(const Setup& setup, const Population& population, StepData& step);

/// Finds the impulses of all contacts, and with them what floes split: where contacts would come to more than
/// a split takes, they are stopped there and the step is solved again (ice/split_instant.hpp).
void solve_impulses(const Setup& setup, int threads, Population& population, StepData& step, Accounts& accounts);

/// By the law of crushing ice: drops the bends whose contacts were not loaded up to V_b.
void drop_unbroken(const Setup& setup, StepData& step);

/// Enters the splits by true forces among what breaks, and the true forces into what breaks otherwise.
void enter_splits(const Setup& setup, const Population& population, StepData& step);

/// Tilts the floes that hulls press down, by the impulses found; those pressed down far enough are to go
/// under.
void tilt_floes(const Setup& setup, Population& population, StepData& step);

/// By the law of crushing ice: books what overlaps have grown in the step, as crushed, with the work that it took,
/// or as tilted, where the ice edge gave way.
void book_overlaps(const Setup& setup, int threads, const Population& population, const StepData& step);

/// Adds what the impulses did to the ships.
void tally_loads(const Population& population, const std::vector<dynamics::Contact>& contacts,
                 std::vector<HullLoads>& loads);

/// Water and wind on the bodies that are due.
void apply_forces(const Setup& setup, const Clock& clock, int threads, Population& population, AuditSums& audit);

/// Constant thrust.
void push_ships(const Setup& setup, Population& population, AuditSums& audit);

/// Brakes ships by the ice under their hulls, and moves that ice along its path.
void pull_of_submerged_ice(const Setup& setup, Population& population, std::vector<HullLoads>& loads, AuditSums& audit);

/// Moves ships by water, engine, steering and mooring (sailing.hpp). After all other impulses of the step,
/// since the water shares those too.
void sail(const Setup& setup, const Clock& clock, StepData& step, Population& population, Accounts& accounts);

/// Returns why the numbers cannot be trusted any more, where a body has no finite speed below kRunawaySpeed.
std::optional<std::string> integrate_motion(const Setup& setup, const Clock& clock, int threads,
                                            const std::vector<dynamics::Contact>& contacts, Population& population);

/// Brakes ships by the cusps that they push down. With the next three all that changes which floes there are: serially,
/// in floe-id order.
void apply_fractures(const Setup& setup, const Clock& clock, StepData& step, Population& population, Accounts& accounts,
                     Journal& journal);

/// Cuts overlaps that no contact can part from the floe and makes them brash, in the order of the pairs.
void grind_blind_overlaps(const Setup& setup, const Clock& clock, const std::vector<dynamics::BlindOverlap>& overlaps,
                          Population& population, Accounts& accounts, Journal& journal);

/// Cuts the ice that hulls of prescribed motion have crushed out of fast ice, and makes it brash: their
/// channels are open.
void carve_channels(const Setup& setup, const Clock& clock, const StepData& step, Population& population,
                    Accounts& accounts, Journal& journal);

/// Why the step's loads cannot be trusted, where one is above all that its ice can bear.
std::optional<std::string> overload_of(const Setup& setup, const Clock& clock, const Population& population,
                                       const StepData& step);

/// By the law of crushing ice: cuts off what contacts crushed that have parted, or that crushed much, and
/// makes it brash, in the order of the pairs.
void shed_crushed_ice(const Setup& setup, const Clock& clock, const StepData& step, Population& population,
                      Accounts& accounts, Journal& journal);

/// By the law of crushing ice: cuts floes that hulls have come through into those that are left of them. What is
/// in the hull is brash.
void cut_through_floes(const Setup& setup, const Clock& clock, const StepData& step, Population& population,
                       Accounts& accounts, Journal& journal);

/// Puts floes that tilted far enough under the hulls.
void apply_submersions(const Setup& setup, const Clock& clock, const std::vector<PendingSubmersion>& pending,
                       Population& population, Accounts& accounts, Journal& journal);

/// Lets ice come up that ships have passed, in the order in which it went under.
void come_up(const Setup& setup, const Clock& clock, Population& population, Accounts& accounts, Journal& journal);

/// Records the first contact of each two ships, and the moorings that broke.
void record_hull_contacts(const Setup& setup, const Clock& clock, const Population& population, const StepData& step,
                          std::vector<Event>& known_contacts, Journal& journal);

/// Keeps which bodies touch others, at the ticks that put floes to rest.
void note_touches(const Setup& setup, const Clock& clock, const Population& population, StepData& step);

void put_to_rest(const Setup& setup, const Clock& clock, const StepData& step, Population& population,
                 AuditSums& audit);

void record(const Setup& setup, const Clock& clock, const Population& population,
            const std::vector<HullLoads>& step_loads, Accounts& accounts, Journal& journal);

/// Where bodies take different steps: in which of them a stage runs.
enum class RunsIn : std::uint8_t {
  kAllSteps,
  kTicks,     ///< with what goes by the tick: hulls and what is at them
  kTogether,  ///< of these, where no body lags behind: floes are where they are seen
};

/// A stage with the parts of the world that it takes.
struct Stage {
  std::string_view name;
  RunsIn in;
  void (*run)(World& world);
};

/// All of them, in their order.
extern const std::array<Stage, 34> kStages;

/// One tick: all stages, once or in each of its parts (levels.hpp). Where floes can take longer steps: up to so many
/// ticks, after which all bodies have come to the same one (components.hpp).
void step(World& world, std::int64_t most_ticks = 1);

}  // namespace polynya::simulation
