#pragma once

#include "geometry/contact/boundary.hpp"

namespace polynya::geometry {

/// Appends where near edges of two boundaries cross, in the frame of a. Touching counts as if b were moved by
/// (ε, ε²), ε → 0, so that along each ring crossings enter and leave in turn.
void find_crossings(const Pose& a_from_b, const NearEdges& edges, std::vector<ManifoldScratch::Crossing>& crossings);

/// Orders the scratch's crossings along a, and a copy of them along b.
void order_crossings(const Boundary& a, const Boundary& b, ManifoldScratch& scratch);

bool is_before_on_a(const ManifoldScratch::Crossing& p, const ManifoldScratch::Crossing& q);
bool is_before_on_b(const ManifoldScratch::Crossing& p, const ManifoldScratch::Crossing& q);

/// The crossing that follows number i along its ring, in an order of crossings. `ring` is the boundary's
/// ring of each edge, `edge` which of a crossing's two edges is on it.
std::size_t next_on_ring(const std::vector<ManifoldScratch::Crossing>& order, std::size_t i,
                         const std::vector<std::uint32_t>& ring, std::uint32_t ManifoldScratch::Crossing::*edge);

/// Traces the boundaries of all overlaps of two bodies, from the scratch's crossings in their orders, into
/// the scratch's loops: by the first crossing of each along a. One that does not close is marked so.
void trace_loops(const Boundary& a, const Boundary& b, ManifoldScratch& scratch);

/// Writes each loop's points and finds which loops are holes of which: only where a body has holes, or where
/// a loop has several stretches of a boundary.
void measure_loops(const Boundary& a, const Boundary& b, const Pose& a_from_b, ManifoldScratch& scratch);

/// Of a loop's overlap with one stretch: the area of the bodies' holes that lie in it whole [m²].
double area_of_whole_holes(const Boundary& a, const Boundary& b, const Pose& a_from_b, const ManifoldScratch& scratch,
                           const OverlapLoop& loop);

/// The manifold of a connected overlap with any number of stretches, by the gradient of its area
/// (docs/theory/contact.md). `loop` is its outer one. Area is 0 where it has none.
ContactManifold gradient_manifold(const Boundary& a, const Boundary& b, const Pose& a_from_b,
                                  const ManifoldScratch& scratch, const OverlapLoop& loop);

}  // namespace polynya::geometry
