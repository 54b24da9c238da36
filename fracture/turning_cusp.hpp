#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "fracture/materials.hpp"
#include "geometry/shape/point.hpp"

namespace polynya::fracture {

/// A cusp when it breaks off: the hull presses its near edge down, and it rotates about its far edge.
struct TurningCusp {
  double area = 0;           ///< A [m²]
  double depth = 0;          ///< R, distance from the axis to the farthest point of the cusp [m]
  double second_moment = 0;  ///< J, about the axis [m⁴]
};

/// Returns the effective mass of the edge of a turning cusp, M = ρ_i h J/R² + (9π/256) ρ_w A R/√(1 + (R/b)²) with b =
/// A/R [kg]. It consists of the inertia of the cusp and of the water below, which is half of the inertia of a plate
/// that rotates about its edge in unbounded water. This holds if the surrounding water has a free surface; surrounding
/// ice increases it (docs/theory/bow.md).
double edge_mass(const Ice& ice, const Water& water, const TurningCusp& cusp);

// Water on the deck of a cusp that a hull presses down. The cusp is a plate that rotates about the lower corner of its
// far edge. Water reaches its deck only through the gaps that open at its edges meanwhile, and the hull carries the
// pressure of the missing water. Own law (docs/theory/bow.md, "Water on the deck of a turning cusp").

/// The neighbours of an edge of a cusp.
enum class Beside : std::uint8_t {
  kSheet,      ///< the ice sheet from which the cusp broke off
  kOlderCusp,  ///< a cusp that the hull presses down ahead of this one
  kWater,      ///< open water
};

/// The neighbour of an edge of a cusp's outline.
struct DeckEdge {
  Beside beside = Beside::kSheet;
  double older_far = 0;    ///< x of the older cusp's farthest point, in the outline's frame [m]
  double older_depth = 0;  ///< R' of the older cusp [m]
};

/// The edges of a strip next to an older cusp.
struct DeckSide {
  double facing = 0;  ///< dy, their width across the hull's normal; > 0 if they face the hull [m]
  double length = 0;  ///< dl [m]
  double axis = 0;    ///< x_a, axis of the older cusp from this one's axis, towards the hull [m]
  double depth = 0;   ///< R' of the older cusp [m]
};

/// A strip of a cusp in plan, across the hull's normal: its width, and its edges by their neighbours.
struct DeckStrip {
  double width = 0;         ///< b [m]
  double sheet = 0;         ///< length of edge next to the sheet [m]
  double sheet_across = 0;  ///< |dy| of this edge [m]
  double water = 0;         ///< length of edge next to open water [m]
  std::array<DeckSide, 2> sides;  ///< next to older cusps, on either side of the cusp
};

/// A cusp that turns, divided into strips of equal depth; the first one lies at the axis.
struct Deck {
  /// Number of strips. More follow the outline more closely and take more time.
  static constexpr int kStrips = 8;
  double depth = 0;       ///< R, distance from the axis to the farthest point of the cusp [m]
  double thickness = 0;   ///< h [m]
  double freeboard = 0;   ///< f [m]
  double hull_angle = 0;  ///< θ_s, from the vertical [rad]
  std::array<DeckStrip, kStrips> strips;
};

/// Returns the distance that the hull moves along its normal until the cusp lies along it, R − h(1 − sin θ_s)/cos θ_s;
/// 0 or negative if the cusp is too short to turn [m].
double distance_to_lie_along(const Deck& deck);

/// Returns the deck of a cusp from its outline, which runs counter-clockwise in a frame whose x axis is the hull's
/// normal, away from the hull, so that the axis of rotation is at the largest x. `edges` has the edge after each point.
Deck deck_of(const Ice& ice, const Water& water, double hull_angle, std::span<const geometry::Point> outline,
             std::span<const DeckEdge> edges);

/// How far a cusp has turned, and the water on its deck.
struct DeckState {
  double displacement = 0;  ///< s, displacement of the hull along its normal since the cusp broke off [m]
  double pool = 0;          ///< Q, volume of water on the deck [m³]
};

/// The forces that follow from the missing water between deck and hull.
struct DeckForces {
  double down = 0;   ///< force of the hull on the near edge, which balances the moment about the axis [N]
  double ahead = 0;  ///< P, force on the hull along its normal, because water is missing on its own face [N]
};

/// The motion of a hull against a cusp in a step.
struct HullAdvance {
  double thrust = 0;    ///< force along the hull's normal over its force down [-]
  double distance = 0;  ///< distance along its normal [m]
  double duration = 0;  ///< [s]
};

/// Moves the hull, but not farther than the cusp can turn, and lets water flow for that time. Returns the mean forces.
DeckForces turn_deck(const Deck& deck, const Water& water, const HullAdvance& advance, DeckState& state);

}  // namespace polynya::fracture
