#pragma once

#include <optional>

#include "geometry/cut/cut.hpp"
#include "geometry/cut/internal/cut_nodes.hpp"

namespace polynya::geometry {

/// The local path: finds where the tool meets the boundary by exact predicates, rebuilds only the chains
/// between those nodes, rounds only the nodes, and validates only the edges that end in one. Equal to the
/// general path wherever it answers; none where it does not cover the case (rings that touch each other where
/// they are cut or in a floe of which several rings are cut). The shape is valid; the tool is a simple
/// counter-clockwise ring or a simple open polyline.
std::optional<CutOutcome> cut_locally(const Polygon& shape, const Tool& tool);

}  // namespace polynya::geometry
