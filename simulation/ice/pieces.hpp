#pragma once

#include "geometry/cut/cut.hpp"
#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// Fate of the pieces inside the cutting polygon: they float as floes, go under for good, lie under the hull, or become
/// brash.
enum class InsideFate { kFloats, kSubmerged, kUnderHull, kBrash };

/// A floe that breaks, with its event and the accounts in which it is counted.
struct Breakage {
  Event event;  ///< event, to which replace_by_pieces() adds the children and areas
  const geometry::CutResult& cut;
  InsideFate inside = InsideFate::kFloats;
  /// Flow to which the kinetic energy of ice that leaves the floe list is added.
  double EnergyFlows::*energy_sink = nullptr;
  std::int64_t Counts::*count = nullptr;
  bool has_decks = false;  ///< true if pieces that go under the hull have a PressedDeck (add_decks)
};

/// Replaces a floe by the pieces of its cut: floes, ice under a hull, submerged ice and brash. Floes move on as parts
/// of the body that they were. Records the event with its children, and adds areas, kinetic energy, momentum and counts
/// to the accounts. `now` is the instant of the event.
void replace_by_pieces(const Setup& setup, const Instant& now, Breakage breakage, Population& population, Books books);

/// Returns the outline of a body with which the body cuts the ice that it has crushed: enlarged about a centre by a
/// factor of 1 + 1e-6 [m]. This is far more than the rounding of cuts, so that the sides of the notch do not touch the
/// body, and far less than any overlap that matters.
geometry::Polygon with_clearance(geometry::Polygon outline, geometry::Point centre);

/// Returns the event of a grind whose cut geometry refused, with the input of the cut, and counts it. `tool` is the
/// outline along which the floe was to be cut, in the floe's body frame.
RejectedCut rejected_grind(const GrindCriterion& criterion, const geometry::Polygon& floe, geometry::Ring tool,
                           const geometry::CutError& error, Accounts& accounts);

/// Returns true if geometry has refused to cut one of two bodies by the other. Such a cut is not tried again.
bool is_refused(const Accounts& accounts, BodyIndex a, BodyIndex b);

}  // namespace polynya::simulation
