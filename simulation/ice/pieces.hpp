#pragma once

#include "geometry/cut/cut.hpp"
#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// What becomes of the pieces inside the cutting polygon.
enum class InsideFate { kFloats, kSubmerged, kUnderHull, kBrash };

/// A floe that breaks: what is recorded of it, and where it is counted.
struct Breakage {
  Event event;  ///< without children and areas
  const geometry::CutResult& cut;
  InsideFate inside = InsideFate::kFloats;
  double EnergyFlows::*energy_sink = nullptr;  ///< for the motion of ice that leaves the floe list
  std::int64_t Counts::*count = nullptr;
  bool has_decks = false;  ///< the hull carries the water that is missing on what goes under (add_decks)
};

/// Replaces the event's floe by the pieces of a cut: floes that move on as the parts of the body they were,
/// submerged ice and brash. Records the event and enters areas, motion and counts.
void replace_by_pieces(const Setup& setup, const Instant& now, Breakage breakage, Population& population, Books books);

/// The outline of a body [m] as it cuts ice that it has crushed: wider about a centre by a millionth. That is far more
/// than what cuts round, so that the sides of the notch do not touch the body that made it, and far less than any
/// overlap matters.
geometry::Polygon with_clearance(geometry::Polygon outline, geometry::Point centre);

/// A cut of ground ice that geometry refused: counted, with its input.
RejectedCut rejected_grind(const GrindCriterion& criterion, const geometry::Polygon& floe, geometry::Ring tool,
                           const geometry::CutError& error, Accounts& accounts);

/// Whether geometry refused to cut one of two bodies by the other: not tried again.
bool is_refused(const Accounts& accounts, BodyIndex a, BodyIndex b);

}  // namespace polynya::simulation
