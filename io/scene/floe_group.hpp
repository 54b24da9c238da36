#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/scene/scene_draft.hpp"

namespace polynya::io {

/// The floes of a lattice (row by row), a rectangle or a polygon, in the world. A file's are not
/// (geojson_reader.hpp), nor a field's (simulation/floe_field.hpp).
std::vector<geometry::Polygon> floes_of(const FloeGroup& group);

/// A rectangle along the axes, counter-clockwise from its corner with the least x and y.
geometry::Polygon rectangle(geometry::Point corner, geometry::Vector size);

/// The same region with rings that are not closed by a repeated first point, outer counter-clockwise, holes
/// clockwise. Which way rings run and whether they are closed are matters of notation; nothing else is
/// changed.
geometry::Polygon in_house_notation(geometry::Polygon polygon);

}  // namespace polynya::io
