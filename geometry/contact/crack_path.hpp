#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/contact/boundary.hpp"

namespace polynya::geometry {

/// Where a line crosses a boundary.
struct LineCrossing {
  double at = 0;  ///< along the line [m]
  std::uint32_t edge = 0;
};

/// The crossings of the line through a point with a boundary, in order: an even number, since every ring is
/// closed. In doubles; tests only edges near the line where the boundary is ready.
std::vector<LineCrossing> crossings_of_line(const Boundary& boundary, Point point, Vector direction);

/// A path through a floe, from a point on or near its boundary to its far side: straight, or of two legs.
struct CrackPath {
  Point start;                               ///< just outside the ice behind the point [m]
  Point end;                                 ///< just outside the ice at its far end [m]
  double length_in_ice = 0;                  ///< [m]
  std::uint32_t first_edge = 0;              ///< of the boundary, that it starts at; of use where length_in_ice > 0
  std::uint32_t last_edge = 0;               ///< that it ends at
  int stretches = 0;                         ///< of ice: more than one where it crosses holes or other water
  std::optional<Point> knee = std::nullopt;  ///< where it turns [m]

  std::vector<Point> points() const;
};

/// How far a crack runs.
enum class CrackReach {
  kFarSide,    ///< through all ice ahead, also beyond open water
  kFirstEdge,  ///< to the first part of the outer boundary: the floe's side, an older crack or channel
};

/// The path from `point` along the unit `direction` through the ice ahead of it. `margin` [m] is how far
/// outside the ice its ends lie, so that a cut along it separates. Measured in doubles; the cut itself is
/// exact. Tests only edges near the line where the boundary is ready.
CrackPath crack_path(const Boundary& boundary, Point point, Vector direction, double margin,
                     CrackReach reach = CrackReach::kFarSide);

/// The stretches of ice of a straight crack_path, each as a path of its own: more than one where it crosses
/// holes. Of the same arguments.
std::vector<CrackPath> ligaments_of(const Boundary& boundary, Point point, Vector direction, double margin,
                                    const CrackPath& path);

/// The place where a crack turns, and its direction from there on.
struct CrackTurn {
  Point knee;     ///< [m]
  Vector onward;  ///< unit
};

/// The path that follows a straight one from its first ice on to the knee, and from there goes onward to the edge of
/// the floe. None where it would cross water on its way.
std::optional<CrackPath> turned_path(const Boundary& boundary, const CrackPath& straight, Point first_ice,
                                     const CrackTurn& turn, double margin);

/// The ice on the two sides of a crack, holes counted as ice [m²].
struct CrackSides {
  double left = 0;
  double right = 0;
};

/// What a crack would part, by the outer boundary between its ends. Both 0 where it parts nothing: where it
/// starts or ends in a hole.
CrackSides sides_of_crack(const Boundary& boundary, const CrackPath& path);

/// The ice between a straight crack and the boundary beside it, on the side where that is nearer.
struct Arm {
  double width = 0;      ///< across the crack [m]
  bool is_left = false;  ///< of the crack
};

/// The arm beside a crack that begins at `first_ice`, where the crack is `share` as long as the arm is wide.
/// None where no boundary is beside it.
std::optional<Arm> arm_beside(const Boundary& boundary, Point first_ice, Vector direction, double share);

/// Where a line through a point of a body leaves that body: behind the point (≤ 0) and ahead of it (≥ 0),
/// both 0 where the point is not inside [m].
struct Passage {
  double behind = 0;
  double ahead = 0;
  double again = 0;  ///< where the line ahead enters the body once more; infinite where it does not
};
Passage passage_through(const Boundary& body, Point point, Vector direction);

/// Twice the ice on a crack's narrower side, measured across it from a share of its way to the nearest
/// boundary on either side, holes included [m].
double crack_width(const Boundary& boundary, const CrackPath& path, double share_of_way);

/// The two half-angles of the wedge of ice that a boundary makes at a place, against an inward direction.
struct WedgeAngles {
  double front = 0;  ///< to the boundary that follows the tip (counter-clockwise around the ice) [rad]
  double back = 0;   ///< to the boundary that comes before it [rad]
};

/// The tip of a wedge, on the boundary.
struct WedgeTip {
  std::uint32_t edge = 0;  ///< edge that starts at the tip or holds it
  Point at;                ///< [m]
};

/// Measures the wedge over a length: from the tip, along the boundary either way to where it first leaves the
/// circle of radius `length` about the tip [m], and the angle of that chord with the unit vector `inward`.
/// Jagged edges and the short edges of earlier cusps so count by where they lead, not by which of them
/// happens to be touched.
WedgeAngles wedge_angles(const EdgeList& edges, const WedgeTip& tip, Vector inward, double length);

/// The same over several lengths, ascending, one of `angles` each.
void wedge_angles(const EdgeList& edges, const WedgeTip& tip, Vector inward, std::span<const double> lengths,
                  std::span<WedgeAngles> angles);

}  // namespace polynya::geometry
