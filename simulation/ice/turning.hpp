#pragma once

#include "geometry/cut/cut.hpp"
#include "simulation/world/clock.hpp"
#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// Where an impulse on a hull is entered.
struct HullBooks {
  HullLoads& loads;
  AuditSums& audit;
};

/// By the law of crushing ice: the impulse with which a hull sets in motion the cusp that a bend breaks off and that
/// goes under it (`InsideFate::kUnderHull`). It is given with no more than the force at which the ice broke, so that it
/// may last for some steps: press_started() gives the rest. Brakes the hull, and enters it in its loads and in the
/// accounts.
/// `mass` is what the cut's cusps weigh at the edge that the hull presses down [kg] (pressed_mass()).
void turn_cusp(const Step& step, const PendingFracture& bend, double mass, Population& population, HullBooks books);

/// Returns what the cusps of a cut weigh at the edge that the hull presses down, with the water that moves with them
/// [kg].
double pressed_mass(const Setup& setup, const Population& population, const PendingFracture& bend,
                    const geometry::CutResult& cut);

/// Returns whether the hull carries the water that is missing on the decks of the cusps that a bend breaks off:
/// where water floods decks (`has_flooding_decks`) and the hull presses the cusps down.
bool has_decks(const Setup& setup, const PendingFracture& bend);

/// Keeps the decks of the cut's cusps, which the hull presses down from now on. Call it where has_decks().
void add_decks(const Setup& setup, const PendingFracture& bend, const geometry::CutResult& cut, Population& population);

/// Goes on to set in motion the cusps that have not all of their edge's speed yet. Those that the hull has passed end.
void press_started(const Step& step, Population& population, std::vector<HullLoads>& loads, AuditSums& audit);

/// Presses the decks on that hulls press down, by the way of a step, and lets water onto them: brakes the hulls by the
/// pressure of the water that is missing there. Those that lie along the hull end.
void press_decks(const Setup& setup, const Step& step, Population& population, std::vector<HullLoads>& loads,
                 AuditSums& audit);

}  // namespace polynya::simulation
