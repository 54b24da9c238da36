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

/// The winding numbers of the closed curves of each source around the points of a face.
struct Winding {
  int shape = 0;
  int tool = 0;
};

/// A maximal connected region of one class: a valid polygon by OGC, not yet rounded. Where its boundary touches itself
/// in a point, it is divided into rings there.
struct Region {
  Polygon polygon;
  int label = 0;  ///< label from the classifier
};

/// Returns the class of a face; faces with a negative class are left out.
using Classifier = std::function<int(Winding)>;

/// Treatment of segments that separate two faces of one class.
enum class Seams {
  kDissolve,  ///< ignored: the faces form one region
  kKeep,      ///< kept: the segments between them separate (a crack)
};

struct Overlay {
  std::vector<Region> regions;
  bool tool_meets_interior = false;  ///< a tool segment runs through the shape's interior; false: the tool misses it
  double dangling_length = 0;        ///< length of these segments with one face on both sides: dangles and bridges [m]
};

/// An overlay cannot be computed: a precondition of CGAL does not hold, or a region has no outer ring.
struct OverlayFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns the exact overlay of all segments by CGAL's arrangement. It is used by the general path, and as the
/// reference for tests of the local path. Segments may cross, touch, overlap and repeat. An open polyline separates
/// only where it divides a face, and with Seams::kDissolve nowhere. It has no winding number, so `classify` must not
/// use Winding::tool for it. Throws OverlayFailure if CGAL refuses the segments or no regions follow from them.
Overlay overlay(const std::vector<SourceSegment>& segments, const Classifier& classify, Seams seams);

}  // namespace polynya::geometry::exact
