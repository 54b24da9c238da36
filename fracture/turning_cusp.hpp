#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "fracture/materials.hpp"
#include "geometry/shape/point.hpp"

namespace polynya::fracture {

/// A cusp as it breaks off: the hull presses its near edge down, and it turns about its far one.
struct TurningCusp {
  double area = 0;           ///< A [m²]
  double depth = 0;          ///< R, from the axis to the point that is farthest from it [m]
  double second_moment = 0;  ///< J, about the axis [m⁴]
};

/// What the edge of a turning cusp weighs, M = ρ_i h J/R² + (9π/256) ρ_w A R/√(1 + (R/b)²), b = A/R [kg]: its own
/// inertia, and that of the water below, half of a plate's that turns about its edge in water without bounds. That
/// is what water with a free surface around has; ice around makes it more (docs/theory/bow.md).
double edge_mass(const Ice& ice, const Water& water, const TurningCusp& cusp);

// Water on the deck of a cusp that a hull presses down. The cusp, a plate, turns about the lower corner of its far
// edge, and water comes over its deck only through what opens at its edges meanwhile; the hull bears the pressure of
// the water that is missing. Own law (docs/theory/bow.md, "Water on the deck of a turning cusp").

/// What is beside an edge of a cusp.
enum class Beside : std::uint8_t {
  kSheet,      ///< the ice that it broke off
  kOlderCusp,  ///< one that the hull presses down ahead of it
  kWater,      ///< open
};

/// An edge of a cusp's outline by what is beside it.
struct DeckEdge {
  Beside beside = Beside::kSheet;
  double older_far = 0;    ///< x of the older cusp's farthest point, in the outline's frame [m]
  double older_depth = 0;  ///< R' of the older cusp [m]
};

/// Edges of a strip beside an older cusp.
struct DeckSide {
  double facing = 0;  ///< dy, their width across the hull's normal; > 0 where they face the hull [m]
  double length = 0;  ///< dl [m]
  double axis = 0;    ///< x_a, of the older cusp from this one's, towards the hull [m]
  double depth = 0;   ///< R' of the older cusp [m]
};

/// A cusp in plan, across the hull's normal: its width there, and its edges by what is beside them.
struct DeckStrip {
  double width = 0;         ///< b [m]
  double sheet = 0;         ///< length of edge [m]
  double sheet_across = 0;  ///< |dy| of it [m]
  double water = 0;         ///< length of edge [m]
  std::array<DeckSide, 2> sides;
};

/// A cusp that turns, by strips of even depth; the first lies at the axis.
struct Deck {
  static constexpr int kStrips = 8;
  double depth = 0;       ///< R, from the axis to the point that is farthest from it [m]
  double thickness = 0;   ///< h [m]
  double freeboard = 0;   ///< f [m]
  double hull_angle = 0;  ///< θ_s, from the vertical [rad]
  std::array<DeckStrip, kStrips> strips;
};

/// Of the hull along its normal until the cusp lies along it, R − h(1 − sin θ_s)/cos θ_s; not more than 0 where
/// a cusp is too short to turn [m].
double way_to_lie_along(const Deck& deck);

/// The deck of a cusp by its outline, counter-clockwise in a frame whose x axis is the hull's normal, with the edge
/// after each point.
Deck deck_of(const Ice& ice, const Water& water, double hull_angle, std::span<const geometry::Point> outline,
             std::span<const DeckEdge> edges);

/// How far a cusp has turned.
struct DeckState {
  double way = 0;   ///< s, of the hull along its normal since the cusp broke off [m]
  double pool = 0;  ///< Q, of water on the deck [m³]
};

/// What the water that is missing between deck and hull does.
struct DeckForces {
  double down = 0;   ///< of the hull on the cusp's near edge, for its moment about the axis [N]
  double ahead = 0;  ///< P, on the hull along its normal, for the water that is missing on its own face [N]
};

/// How a hull goes on against a cusp in a step.
struct HullAdvance {
  double thrust = 0;    ///< force along the hull's normal over its force down [-]
  double way = 0;       ///< distance along its normal [m]
  double duration = 0;  ///< [s]
};

/// Lets the hull go on, not farther than the cusp turns, and water flow for that time. Returns the mean forces.
DeckForces turn_deck(const Deck& deck, const Water& water, const HullAdvance& advance, DeckState& state);

}  // namespace polynya::fracture
