#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/scene/scene_input.hpp"

namespace polynya::io {

/// The floes of a lattice, row by row, in the world.
std::vector<geometry::Polygon> floes_of(const LatticeInput& lattice);
/// The floe of a rectangle, turned about its corner.
geometry::Polygon floe_of(const RectangleInput& input);

/// A rectangle along the axes, counter-clockwise from its corner with the least x and y.
geometry::Polygon rectangle(geometry::Point corner, geometry::Vector size);

/// The same region with rings that are not closed by a repeated first point, outer counter-clockwise, holes
/// clockwise. Which way rings run and whether they are closed are matters of notation; nothing else is
/// changed.
geometry::Polygon in_house_notation(geometry::Polygon polygon);

}  // namespace polynya::io
