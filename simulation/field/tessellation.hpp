#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"
#include "simulation/field/free_area.hpp"
#include "simulation/field/random.hpp"

namespace polynya::simulation {

struct FieldCell {
  geometry::Ring ring;      ///< convex, counter-clockwise, in the field's plane [m]; empty where no room was found
  bool is_clipped = false;  ///< by a boundary other than the hull's
};

/// Convex cells that tile the free area but for narrow corners at what is kept clear, cell i with an area in
/// proportion to areas[i] as nearly as the passes bring it (mostly within 1 %). A cell that found no room is
/// empty.
///
/// The areas lie in the plane as they stand in the list: points strewn evenly over the free area are halved
/// again and again, across the longer side of what they span, in proportion to the areas that are to lie
/// there. So every site starts amid about the area it needs, beside however large a neighbour. Weights start
/// as those of discs of the areas. Sites then move to their cells' centroids while each weight follows its
/// cell's error; at last sites stay, and all weights change together by parts of Newton's step [Balzer2009,
/// deGoes2012].
std::vector<FieldCell> tessellate(const FreeArea& free, const std::vector<double>& areas, Random& random);

}  // namespace polynya::simulation
