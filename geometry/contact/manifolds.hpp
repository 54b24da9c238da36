#pragma once

#include <cstdint>
#include <vector>

#include "geometry/contact/boundary.hpp"

namespace polynya::geometry {

/// The boundaries of two bodies, each in its body frame, and the pose between the frames.
struct BoundaryPair {
  const Boundary& a;
  const Boundary& b;
  const Pose& a_from_b;
};

/// Where two bodies overlap, seen as one contact. In the frame of a.
struct ContactManifold {
  Point ends[2];                    ///< the ends of the contact line [m]
  Vector normal;                    ///< unit, from a into b
  double width = 0;                 ///< length of the contact line [m]
  double depth = 0;                 ///< extent of the overlap along the normal [m]
  double area = 0;                  ///< of the overlap [m²]
  Point tip_of_b;                   ///< the point of b farthest inside a [m]
  Point tip_of_a;                   ///< the corner of a farthest inside b; the line's middle where none is [m]
  std::uint32_t tip_edge_of_b = 0;  ///< the edge of b that starts at the tip, or that the tip is on

  // Of a pierced body, whose overlap has several stretches of a boundary:
  bool is_pierced = false;
  Point centroid;     ///< of the overlap [m]
  double reach = 0;   ///< no point of the overlap is farther from its centroid [m]
  double extent = 0;  ///< of the overlap along the normal or along the line, the greater [m]
};

/// Widths of a contact line below this are 0 but for rounding [m]. Smaller, normals are directions of
/// rounding errors; larger than some 1e-6, contacts that just begin are lost for a step.
inline constexpr double kNoWidth = 1e-12;

/// A stretch of a's boundary inside b and the stretch of b's inside a that follows it around an overlap: the
/// numbers of their crossings along a.
struct OverlapStretch {
  std::uint32_t enter, leave, next;
};

/// A boundary of an overlap: stretches one after the other.
struct OverlapLoop {
  std::uint32_t first = 0;      ///< stretch
  std::uint32_t stretches = 0;  ///< of each of the two boundaries
  std::uint32_t first_point = 0;
  std::uint32_t points = 0;
  std::uint32_t outer = 0;  ///< the loop whose hole it is; itself where it is none
  double area = 0;          ///< signed; found where the loop's points are [m²]
  bool is_closed = false;
  bool has_holes = false;
};

inline constexpr std::uint32_t kNotOnB = UINT32_MAX;

struct OverlapPoint {
  Point point;
  std::uint32_t edge_of_b = kNotOnB;  ///< that it is on or that starts there
};

/// Reusable memory of find_manifolds.
struct ManifoldScratch {
  struct Crossing {
    Point point;
    std::uint32_t edge_a, edge_b;
    double along_a, along_b;
    bool is_entering;          ///< a's boundary enters b here
    std::uint32_t place_on_a;  ///< in the order along a
  };
  std::vector<Crossing> crossings;
  std::vector<Crossing> by_b;         ///< the same, in the order along b
  std::vector<Point> side_a, side_b;  ///< the overlap's two sides, (along the line, off it) [m]

  // Where boundaries cross more than twice:
  std::vector<std::uint32_t> place_on_b;  ///< in the order along b, of the crossings along a
  std::vector<bool> is_traced;            ///< of the crossings along a
  std::vector<OverlapStretch> stretches;
  std::vector<OverlapLoop> loops;
  std::vector<OverlapPoint> loop_points;
};

/// The contact manifolds of two overlapping bodies, from the edges near each other (edges_of): one for each connected
/// overlap. Where one stretch of each boundary makes it, the contact line joins the points where the boundaries cross
/// and the normal stands on it; where several do (a body is pierced), line and normal follow from the gradient of the
/// overlap's area, which is the same rule. Appends to `manifolds`. Returns how many overlaps were left out because
/// their crossings did not pair up (rounding at a touching vertex; they pair up one step later).
int find_manifolds(const BoundaryPair& pair, const NearEdges& edges, ManifoldScratch& scratch,
                   std::vector<ContactManifold>& manifolds);

/// A width below this share of an overlap's mean width, area / extent, is blind [-]. Larger, healthy contacts
/// of wedges (a half) are ground off; smaller, bodies lie in each other without a force that parts them.
inline constexpr double kBlindShare = 0.25;

/// Whether the gradient of an overlap's area does not show the overlap: whichever way the bodies move apart,
/// the area falls by less than a quarter of its mean width per metre.
inline bool is_blind(double width, double area, double extent) {
  return width * extent < kBlindShare * area;
}

/// The paper's own rule: every pair of overlapping contact circles is a contact with its normal along the
/// line of centres and its contact point half-way into the overlap. [Sawamura2017], Fig. 1. Depth is the
/// circles' overlap; width and area are those of the circles' lens.
void find_circle_manifolds(const Covered& a, const Covered& b, const Pose& a_from_b,
                           const std::vector<NearPair>& circle_pairs, std::vector<ContactManifold>& manifolds);

}  // namespace polynya::geometry
