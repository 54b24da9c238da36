#pragma once

#include "geometry/cut/cut.hpp"
#include "simulation/world/clock.hpp"
#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// The loads and accounts in which an impulse on a hull is recorded.
struct HullBooks {
  HullLoads& loads;
  AuditSums& audit;
};

/// Law of crushing ice: accelerates a cusp that a bend breaks off and that goes under the hull
/// (`InsideFate::kUnderHull`). The edge of the cusp must reach the speed that the slope of the hull gives it, and the
/// impulse for this brakes the hull. The force never exceeds the one at which the ice broke, so the impulse may take
/// several steps; accelerate_cusps() gives the rest of it. The impulse is added to the loads of the hull and to the
/// accounts. `mass` is the effective mass of the cusps at the edge that the hull presses down [kg] (pressed_mass()).
void start_cusp(const Step& step, const PendingFracture& bend, double mass, Population& population, HullBooks books);

/// Returns the effective mass of a cut's cusps at the edge that the hull presses down, including the water that moves
/// with them [kg].
double pressed_mass(const Setup& setup, const Population& population, const PendingFracture& bend,
                    const geometry::CutResult& cut);

/// Returns true if the hull carries the water that is missing on the decks of the cusps that a bend breaks off. It does
/// if water floods decks (`has_flooding_decks`) and the hull presses the cusps down.
bool has_decks(const Setup& setup, const PendingFracture& bend);

/// Adds the cusps of a cut to Population::decks. press_decks() turns them from the next step on. Call it only where
/// has_decks() is true.
void add_decks(const Setup& setup, const PendingFracture& bend, const geometry::CutResult& cut, Population& population);

/// Continues to accelerate the cusps whose edges have not reached the hull's speed yet. A cusp is removed from the list
/// when it has reached it, or when the hull has passed it.
void accelerate_cusps(const Step& step, Population& population, std::vector<HullLoads>& loads, AuditSums& audit);

/// Turns the cusps under hulls further by the displacement of their hull in the step, and lets water flow onto their
/// decks. The hulls are braked by the pressure of the water that is missing there. A cusp that lies along the hull is
/// removed from the list.
void press_decks(const Setup& setup, const Step& step, Population& population, std::vector<HullLoads>& loads,
                 AuditSums& audit);

}  // namespace polynya::simulation
