#pragma once

#include <optional>
#include <vector>

#include "geometry/cut/internal/lattice.hpp"

namespace polynya::geometry::exact {

/// Snap rounding [Hobby1999; GuibasMarimont1998]: every vertex of a valid polygon moves to the point of the
/// lattice whose cell it lies in, and every edge that passes through such a cell bends to its point too. What
/// lies closer together than a cell becomes one, and no edge crosses another: on evenly spaced lattices that
/// is a theorem, on all doubles, whose cells differ in size, it may fail.
///
/// Returns what the rings then enclose, as valid polygons: several where a neck closed, none where nothing is
/// left. No value where they are not valid.
std::optional<std::vector<geometry::Polygon>> snapped(const Polygon& polygon, const Lattice& lattice);

}  // namespace polynya::geometry::exact
