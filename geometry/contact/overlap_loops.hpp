#pragma once

#include "geometry/contact/boundary.hpp"

namespace polynya::geometry {

/// Traces the boundaries of all overlaps of two bodies, from the scratch's crossings in their orders, into
/// the scratch's loops: by the first crossing of each along a. One that does not close is marked so.
void trace_loops(const Boundary& a, const Boundary& b, ManifoldScratch& scratch);

/// Writes each loop's points and finds which loops are holes of which: only where a body has holes, or where
/// a loop has several stretches of a boundary.
void measure_loops(const Boundary& a, const Boundary& b, const Pose& a_from_b, ManifoldScratch& scratch);

/// Of a loop's overlap with one stretch: the area of the bodies' holes that lie in it whole [m²].
double area_of_whole_holes(const Boundary& a, const Boundary& b, const Pose& a_from_b,
                           const ManifoldScratch& scratch, const OverlapLoop& loop);

/// The manifold of a connected overlap with any number of stretches, by the gradient of its area
/// (docs/theory.md, "Contact"). `loop` is its outer one. Area is 0 where it has none.
ContactManifold gradient_manifold(const Boundary& a, const Boundary& b, const Pose& a_from_b,
                                  const ManifoldScratch& scratch, const OverlapLoop& loop);

}  // namespace polynya::geometry
