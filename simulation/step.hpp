#pragma once

#include "simulation/world.hpp"

namespace polynya::simulation {

/// The stages of one time step, in their order. Each works on the world as the one before left it.

void find_pairs(World& world);
void find_contacts(World& world);
/// What each contact can carry, and whether ice breaks there: impulse, crush, bend or split.
void decide(World& world);
void solve_impulses(World& world);
/// What the impulses did to the ships.
void tally_loads(World& world);
void apply_forces(World& world);
void integrate_motion(World& world);
/// Enters the first contact of each two ships. After the motion, so that a contact has the step's time.
void note_ship_contacts(World& world);
/// The only stage that changes which floes there are: serially, in floe-id order.
void apply_fractures(World& world);
void put_to_rest(World& world);
void record(World& world);

void step(World& world);

}  // namespace polynya::simulation
