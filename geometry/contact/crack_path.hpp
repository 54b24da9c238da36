#pragma once

#include "geometry/contact/boundary.hpp"

namespace polynya::geometry {

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

}  // namespace polynya::geometry
