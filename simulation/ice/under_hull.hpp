#pragma once

#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// A floe, and the ship under whose hull it goes.
struct FloeAtHull {
  FloeId floe = 0;
  int ship = 0;
  bool has_deck = false;  ///< the hull carries the water that is missing on the floe's deck (SubmergedPiece)
};

/// Takes a floe out of the contact world and puts it under a ship's hull, where it rests in the water. Enters
/// its motion and counts it.
void go_under(const Setup& setup, const Instant& now, const FloeAtHull& at, Population& population, Accounts& accounts);

/// The event of a floe that goes under, without what decided it.
Event submersion_event(const Instant& now, const Population& population, const FloeAtHull& at);

}  // namespace polynya::simulation
