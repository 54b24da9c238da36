#pragma once

#include <optional>
#include <vector>

#include "geometry/cut/internal/cut_pieces.hpp"
#include "geometry/cut/internal/window_faces.hpp"

namespace polynya::geometry {

/// A ring of a piece, written out.
struct WindowPieceRing {
  WindowRing steps;   ///< none where it is a far ring
  int far_ring = -1;  ///< or this ring of the shape
  Ring points;        ///< nearest doubles
  RingArea area;      ///< of `points`
  int turn = 0;       ///< of the exact ring: +1 counter-clockwise
};

struct WindowPiece {
  std::vector<WindowPieceRing> rings;  ///< the outer one first
  Part part = Part::kOutside;
};

/// Everything a cut in a window has found out.
struct WindowCut {
  const Rings& shape;
  const Window& window;
  const std::vector<exact::SourceSegment>& tool;
  WindowOverlay overlay;
  std::vector<Point> nearest;    ///< of each vertex of the graph
  std::vector<char> is_rounded;  ///< of each vertex: its nearest doubles are not itself
};

/// Writes out all rings and finds which bound which piece. None where that cannot be told safely.
std::optional<std::vector<WindowPiece>> plan_pieces(const WindowCut& cut, const exact::Classifier& classify);

/// A piece before rounding.
exact::Polygon write_exactly(const WindowCut& cut, const WindowPiece& piece);

/// Calls visit(from, to) for every edge of the ring that was arranged, by vertices of the graph.
template <typename Visit>
void for_each_near_edge(const WindowRing& ring, Visit visit) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const WindowStep& from = ring[i];
    const WindowStep& to = ring[i + 1 == ring.size() ? 0 : i + 1];
    if (from.chain < 0 && to.chain < 0) visit(from.vertex, to.vertex);
  }
}

}  // namespace polynya::geometry
