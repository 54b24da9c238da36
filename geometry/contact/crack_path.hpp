#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/contact/boundary.hpp"

namespace polynya::geometry {

/// A crossing of a line with a boundary.
struct LineCrossing {
  double at = 0;  ///< distance along the line [m]
  std::uint32_t edge = 0;
};

/// Returns the crossings of the line through a point with a boundary, in order. Their number is even, since every ring
/// is closed. Computed in doubles; only edges near the line are tested if the boundary is ready.
std::vector<LineCrossing> crossings_of_line(const Boundary& boundary, Point point, Vector direction);

/// A path through a floe, from a point on or near its boundary to its far side: straight, or with two legs.
struct CrackPath {
  Point start;                               ///< just outside the ice behind the point [m]
  Point end;                                 ///< just outside the ice at its far end [m]
  double length_in_ice = 0;                  ///< [m]
  std::uint32_t first_edge = 0;              ///< boundary edge at its start; meaningful if length_in_ice > 0
  std::uint32_t last_edge = 0;               ///< boundary edge at its end
  int stretches = 0;                         ///< stretches of ice; more than one if it crosses holes or other water
  std::optional<Point> knee = std::nullopt;  ///< point at which it turns [m]

  std::vector<Point> points() const;
};

/// The extent of a crack.
enum class CrackReach {
  kFarSide,    ///< through all ice ahead, also beyond open water
  kFirstEdge,  ///< to the first part of the outer boundary: the side of the floe, an older crack or channel
};

/// Returns the path from `point` along the unit vector `direction` through the ice ahead of it. Its ends lie `margin`
/// [m] outside of the ice, so that a cut along it separates. Computed in doubles; the cut itself is exact. Only edges
/// near the line are tested if the boundary is ready.
CrackPath crack_path(const Boundary& boundary, Point point, Vector direction, double margin,
                     CrackReach reach = CrackReach::kFarSide);

/// Returns the stretches of ice of a straight crack_path with the same arguments, each as a path: more than one if it
/// crosses holes.
std::vector<CrackPath> ligaments_of(const Boundary& boundary, Point point, Vector direction, double margin,
                                    const CrackPath& path);

/// The place at which a crack turns, and its direction beyond.
struct CrackTurn {
  Point knee;     ///< [m]
  Vector onward;  ///< unit
};

/// Returns the path that follows a straight one from its first ice to the knee, and from there runs onward to the edge
/// of the floe; nullopt if it would cross water on its way.
std::optional<CrackPath> turned_path(const Boundary& boundary, const CrackPath& straight, Point first_ice,
                                     const CrackTurn& turn, double margin);

/// The areas of ice on the two sides of a crack, with holes counted as ice [m²].
struct CrackSides {
  double left = 0;
  double right = 0;
};

/// Returns the areas that a crack would separate, by the outer boundary between its ends. Both are 0 if it separates
/// nothing, that is, if it starts or ends in a hole.
CrackSides sides_of_crack(const Boundary& boundary, const CrackPath& path);

/// The ice between a straight crack and the boundary beside it, on the side on which that is nearer.
struct Arm {
  double width = 0;      ///< across the crack [m]
  bool is_left = false;  ///< true if it lies on the left of the crack
};

/// Returns the arm beside a crack that begins at `first_ice`, measured where the length of the crack is `share` of the
/// width of the arm; nullopt if there is no boundary beside it.
std::optional<Arm> arm_beside(const Boundary& boundary, Point first_ice, Vector direction, double share);

/// The places at which a line through a point of a body leaves the body: behind the point (≤ 0) and ahead of it (≥ 0).
/// Both are 0 if the point is not inside [m].
struct Passage {
  double behind = 0;
  double ahead = 0;
  double again = 0;  ///< where the line ahead enters the body once more; infinite if it does not
};
Passage passage_through(const Boundary& body, Point point, Vector direction);

/// Returns twice the width of the ice on a crack's narrower side [m]. It is measured across the crack, at a fraction of
/// its length, to the nearest boundary on either side, holes included.
double crack_width(const Boundary& boundary, const CrackPath& path, double share_of_way);

/// The two half-angles of the wedge of ice that a boundary forms at a place, from an inward direction.
struct WedgeAngles {
  double front = 0;  ///< to the boundary that follows the tip (counter-clockwise around the ice) [rad]
  double back = 0;   ///< to the boundary that precedes the tip [rad]
};

/// The tip of a wedge on the boundary.
struct WedgeTip {
  std::uint32_t edge = 0;  ///< edge that starts at the tip or contains it
  Point at;                ///< [m]
};

/// Measures the wedge over a length. From the tip the boundary is followed either way to the point where it first
/// leaves the circle of radius `length` [m] about the tip; the angle is that between this chord and the unit vector
/// `inward`. Jagged edges and the short edges of earlier cusps therefore count by where they lead, not by which of them
/// happens to be touched.
WedgeAngles wedge_angles(const EdgeList& edges, const WedgeTip& tip, Vector inward, double length);

/// The same for several lengths, ascending, with one element of `angles` each.
void wedge_angles(const EdgeList& edges, const WedgeTip& tip, Vector inward, std::span<const double> lengths,
                  std::span<WedgeAngles> angles);

}  // namespace polynya::geometry
