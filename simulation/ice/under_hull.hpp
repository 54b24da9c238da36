#pragma once

#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// A floe, and the ship under whose hull it goes.
struct FloeAtHull {
  FloeId floe = 0;
  int ship = 0;
  bool has_deck = false;  ///< true for a cusp with a PressedDeck (SubmergedPiece::had_deck)
};

/// Puts a floe under a ship's hull. The floe takes part in no contact any more and is at rest in the water. Its kinetic
/// energy and momentum are added to the accounts, and the floe is counted.
void go_under(const Setup& setup, const Instant& now, const FloeAtHull& at, Population& population, Accounts& accounts);

/// Returns the event of a floe that goes under a hull, with its position and area. The caller sets its criterion.
Event submersion_event(const Instant& now, const Population& population, const FloeAtHull& at);

}  // namespace polynya::simulation
