#pragma once

#include <optional>
#include <vector>

#include "geometry/cut/cut.hpp"
#include "geometry/cut/internal/cut_nodes.hpp"

namespace polynya::geometry {

/// A run of consecutive vertices between two places of a ring or polyline, ends left out.
struct Run {
  int first = 0;  ///< its first vertex
  int count = 0;  ///< how many; they wrap around the ring
};

/// A directed stretch of boundary between two active nodes, a face of the cut shape on its left.
struct HalfEdge {
  int from = 0;            ///< node
  int to = 0;              ///< node
  bool is_chord = false;   ///< along the tool through the ice, else along the shape
  bool is_forward = true;  ///< chords are used once in each direction
  int ring = 0;            ///< of the shape, where it is no chord
  Run run;                 ///< vertices strictly between the nodes, in the ring's or tool's own order
};

/// A simple closed chain of half-edges.
using Loop = std::vector<int>;

/// One closed walk along a face's boundary, split at the nodes it visits twice.
struct Walk {
  std::vector<Loop> loops;
  Part part = Part::kOutside;
};

/// The cut as a planar graph of chains: only nodes and chains, never single edges.
struct CutGraph {
  std::vector<HalfEdge> half_edges;  ///< all shape chains, then each chord forward and backward
  std::vector<Walk> walks;
  std::vector<HalfEdge> bridges;  ///< stretches of the tool from ring to ring that separate nothing
  int rings_met = 0;              ///< how many rings of the shape chords and bridges end on
  std::vector<char> ring_is_cut;  ///< per ring of the shape: has it active nodes?
  bool is_consistent = true;      ///< false only if the shape or the tool is not valid
  int first_node = -1;            ///< along the tool
  int last_node = -1;
  bool starts_inside = false;  ///< an open tool comes to its first node through the shape's interior
  bool ends_inside = false;    ///< and leaves its last one into it
};

/// Which stretches of the tool are chords, and which faces they and the shape's chains bound. Marks active
/// nodes.
CutGraph trace_faces(const Rings& rings, const Tool& tool, std::vector<Node>& nodes);

}  // namespace polynya::geometry
