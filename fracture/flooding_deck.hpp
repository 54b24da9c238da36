#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "fracture/materials.hpp"
#include "geometry/shape/point.hpp"

namespace polynya::fracture {

// Water on the deck of a cusp that a hull presses down. The cusp turns about its far edge, and water comes over its
// deck only through what opens at its edges meanwhile; the hull bears the pressure of the water that is missing. Own
// law (docs/theory/bow.md, "Water on the deck of a turning cusp").

/// What is beside an edge of a cusp.
enum class Beside : std::uint8_t {
  kSheet,      ///< the ice that it broke off
  kOlderCusp,  ///< one that lies along the hull, below
  kWater,      ///< open
};

/// A cusp in plan, across the hull's normal: its width there, and its edges by what is beside them.
struct DeckStrip {
  double width = 0;  ///< b [m]
  double sheet = 0;  ///< length of edge [m]
  double older = 0;  ///< |dy| of the edges that face the hull, their width across its normal [m]
  double water = 0;  ///< length of edge [m]
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

/// The deck of a cusp by its outline, counter-clockwise in a frame whose x axis is the hull's normal, with what is
/// beside the edge after each point.
Deck deck_of(const Ice& ice, const Water& water, double hull_angle, std::span<const geometry::Point> outline,
             std::span<const Beside> beside);

/// How far a cusp has turned.
struct DeckState {
  double way = 0;   ///< s, of the hull along its normal since the cusp broke off; at R the cusp lies along the hull [m]
  double pool = 0;  ///< Q, of water on the deck [m³]
};

/// Lets the hull go on by `way` [m] and water flow for dt [s]. Returns the mean force down on the cusp's near edge
/// that the missing water takes, where the hull presses with `thrust` times it along its normal: M / R(cos ψ + η sin ψ)
/// [N].
double turn_deck(const Deck& deck, const Water& water, double thrust, double way, double dt, DeckState& state);

}  // namespace polynya::fracture
