#pragma once

#include <functional>
#include <stdexcept>
#include <vector>

#include "geometry/exact/internal/exact_polygon.hpp"

namespace polynya::geometry::exact {

/// A directed segment of one of two sources: 0 the shape, 1 the tool.
struct SourceSegment {
  Point from;
  Point to;
  int source = 0;
};

void append_segments(std::vector<SourceSegment>& segments, const Ring& ring, int source);
void append_segments(std::vector<SourceSegment>& segments, const Polygon& polygon, int source);

/// How often each source's closed curves wind around the points of a face.
struct Winding {
  int shape = 0;
  int tool = 0;
};

/// A maximal connected region of one class: a valid polygon by OGC (pinches retraced), not yet rounded.
struct Region {
  Polygon polygon;
  int label = 0;  ///< the classifier's
};

/// Gives a face its class; faces of a negative class are left out.
using Classifier = std::function<int(Winding)>;

/// What separates two faces of one class.
enum class Seams {
  kDissolve,  ///< nothing: they are one region
  kKeep,      ///< the segments between them (a crack)
};

struct Overlay {
  std::vector<Region> regions;
  bool tool_meets_interior = false;  ///< some tool segment runs where the shape winds on both sides
  double dangling_length = 0;        ///< of those that have one face on both sides: dangles and bridges [m]
};

/// An overlay that cannot be computed: a precondition of CGAL that does not hold, or a region without an outer ring.
struct OverlayFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The exact overlay of all segments, by CGAL's arrangement: the general path and the oracle of the local
/// one. Segments may cross, touch, overlap and repeat. Open polylines separate nothing and wind around
/// nothing. Throws OverlayFailure if CGAL refuses the segments or their regions do not follow from them.
Overlay overlay(const std::vector<SourceSegment>& segments, const Classifier& classify, Seams seams);

}  // namespace polynya::geometry::exact
