#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// The reasons why a polygon is not valid by OGC Simple Features. Decided exactly. In the order of name_of().
enum class Defect {
  kTooFewPoints,      ///< fewer than three distinct points in a ring
  kNotFinite,         ///< a coordinate that is NaN, infinite or beyond 1e70 m
  kRepeatedPoint,     ///< consecutive equal vertices
  kZeroArea,          ///< a ring that encloses nothing
  kSelfCrossing,      ///< two edges of one ring cross, or a ring touches itself
  kOverlappingEdges,  ///< edges share more than a point
  kWrongOrientation,  ///< outer ring clockwise or hole counter-clockwise
  kHoleOutside,       ///< a hole not inside the outer ring
  kHolesOverlap,      ///< two holes share area
  kRingsCross,        ///< edges of two rings cross
  kDisconnected,      ///< holes that touch cut the interior apart
};

/// Returns a short name that people can search for, such as "self-crossing".
std::string_view name_of(Defect defect);

struct DefectAt {
  Defect defect;
  std::vector<Point> places;  ///< the offending vertices or crossing points, nearest doubles [m]
};

/// Returns the first defect found; nullopt if the polygon is valid.
std::optional<DefectAt> find_defect(const Polygon& polygon);

}  // namespace polynya::geometry
