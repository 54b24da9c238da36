#pragma once

#include "geometry/contact/boundary.hpp"

namespace polynya::geometry {

/// Appends where near edges of two boundaries cross, in the frame of a. Touching counts as if b were moved by
/// (ε, ε²), ε → 0, so that along each ring crossings enter and leave in turn.
void find_crossings(const Pose& a_from_b, const NearEdges& edges,
                    std::vector<ManifoldScratch::Crossing>& crossings);

/// Orders the scratch's crossings along a, and a copy of them along b.
void order_crossings(const Boundary& a, const Boundary& b, ManifoldScratch& scratch);

bool is_before_on_a(const ManifoldScratch::Crossing& p, const ManifoldScratch::Crossing& q);
bool is_before_on_b(const ManifoldScratch::Crossing& p, const ManifoldScratch::Crossing& q);

/// The crossing that follows number i along its ring, in an order of crossings. `ring` is the boundary's
/// ring of each edge, `edge` which of a crossing's two edges is on it.
std::size_t next_on_ring(const std::vector<ManifoldScratch::Crossing>& order, std::size_t i,
                         const std::vector<std::uint32_t>& ring,
                         std::uint32_t ManifoldScratch::Crossing::*edge);

}  // namespace polynya::geometry
