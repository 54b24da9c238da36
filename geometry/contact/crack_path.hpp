#pragma once

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

/// A straight path through a floe, from a point on or near its boundary to its far side.
struct CrackPath {
  Point start;                   ///< just outside the ice behind the point [m]
  Point end;                     ///< just outside the ice at its far end [m]
  double length_in_ice = 0;      ///< [m]
  std::uint32_t first_edge = 0;  ///< of the boundary, that it starts at; of use where length_in_ice > 0
  std::uint32_t last_edge = 0;   ///< that it ends at
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

/// The ice on the two sides of a crack, holes counted as ice [m²].
struct CrackSides {
  double left = 0;
  double right = 0;
};

/// What a crack would part, by the outer boundary between its ends. Both 0 where it parts nothing: where it
/// starts or ends in a hole.
CrackSides sides_of_crack(const Boundary& boundary, const CrackPath& path);

/// Twice the ice on a crack's narrower side, measured across it from a share of its way to the nearest
/// boundary on either side, holes included [m].
double crack_width(const Boundary& boundary, const CrackPath& path, double share_of_way);

}  // namespace polynya::geometry
