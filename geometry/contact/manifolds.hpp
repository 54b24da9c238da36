#pragma once

#include <cstdint>
#include <vector>

#include "geometry/contact/near_boundaries.hpp"

namespace polynya::geometry {

/// The boundaries of two bodies, each in its body frame, and the pose between the frames.
struct BoundaryPair {
  const Boundary& a;
  const Boundary& b;
  const Pose& a_from_b;
};

/// An overlap of two bodies as one contact, in the frame of a.
struct ContactManifold {
  Point ends[2];                    ///< the ends of the contact line [m]
  Vector normal;                    ///< unit vector from a into b
  double width = 0;                 ///< length of the contact line [m]
  double depth = 0;                 ///< extent of the overlap along the normal [m]
  double area = 0;                  ///< of the overlap [m²]
  Point tip_of_b;                   ///< point of b farthest inside a [m]
  Point tip_of_a;                   ///< corner of a farthest inside b; the middle of the line if there is none [m]
  std::uint32_t tip_edge_of_b = 0;  ///< edge of b that starts at the tip or contains it

  // For a pierced body, whose overlap has several stretches of a boundary:
  bool is_pierced = false;
  Point centroid;     ///< of the overlap [m]
  double reach = 0;   ///< largest distance of the overlap from its centroid [m]
  double extent = 0;  ///< larger extent of the overlap, along the normal or along the line [m]
};

/// Width up to which a contact line counts as a point [m]: it would be rounding error. Smaller: normals are directions
/// of rounding errors. Larger than about 1e-6: contacts that have just begun are lost for a step.
inline constexpr double kNoWidth = 1e-12;

/// A stretch of a's boundary inside b, and the stretch of b's boundary inside a that follows it around an overlap: the
/// numbers of their crossings along a.
struct OverlapStretch {
  std::uint32_t enter, leave, next;
};

/// A boundary of an overlap: consecutive stretches.
struct OverlapLoop {
  std::uint32_t first = 0;      ///< first stretch
  std::uint32_t stretches = 0;  ///< number of stretches of each of the two boundaries
  std::uint32_t first_point = 0;
  std::uint32_t points = 0;
  std::uint32_t outer = 0;  ///< loop of which it is a hole; itself if it is none
  double area = 0;          ///< signed; known if the loop's points are [m²]
  bool is_closed = false;
  bool has_holes = false;
};

inline constexpr std::uint32_t kNotOnB = UINT32_MAX;

struct OverlapPoint {
  Point point;
  std::uint32_t edge_of_b = kNotOnB;  ///< edge of b on which the point lies or that starts there
};

/// Memory that find_manifolds reuses.
struct ManifoldScratch {
  struct Crossing {
    Point point;
    std::uint32_t edge_a, edge_b;
    double along_a, along_b;
    bool is_entering;          ///< a's boundary enters b here
    std::uint32_t place_on_a;  ///< place in the order along a
  };
  std::vector<Crossing> crossings;
  std::vector<Crossing> by_b;         ///< the same crossings in the order along b
  std::vector<Point> side_a, side_b;  ///< the two sides of an overlap (along the line, off the line) [m]

  // For boundaries that cross more than twice:
  std::vector<std::uint32_t> place_on_b;  ///< place in the order along b of each crossing along a
  std::vector<bool> is_traced;            ///< for each crossing along a
  std::vector<OverlapStretch> stretches;
  std::vector<OverlapLoop> loops;
  std::vector<OverlapPoint> loop_points;
};

/// Finds the contact manifolds of two overlapping bodies from the edges near each other (edges_of), one for each
/// connected overlap. If one stretch of each boundary bounds the overlap, the contact line joins the points where the
/// boundaries cross, and the normal is perpendicular to it. If several stretches do (a body is pierced), line and
/// normal follow from the gradient of the overlap's area, which is the same rule. Appends to `manifolds`. Returns the
/// number of overlaps that were left out because their crossings did not pair up (through rounding at a touching
/// vertex; they pair up one step later).
int find_manifolds(const BoundaryPair& pair, const NearEdges& edges, ManifoldScratch& scratch,
                   std::vector<ContactManifold>& manifolds);

/// Width of a contact line below which its overlap is blind, as a fraction of the overlap's mean width, area / extent
/// [-]. Larger: healthy contacts of wedges (one half) are ground off. Smaller: bodies lie in each other without a force
/// that separates them.
inline constexpr double kBlindShare = 0.25;

/// Returns true if the gradient of an overlap's area does not show the overlap: in whatever direction the bodies
/// separate, the area decreases by less than a quarter of its mean width per metre.
inline bool is_blind(double width, double area, double extent) {
  return width * extent < kBlindShare * area;
}

/// The paper's own rule: every pair of overlapping contact circles is a contact, with its normal along the line of
/// centres and its contact point half-way into the overlap. [Sawamura2017], Fig. 1. The depth is the overlap of the
/// circles; width and area are those of the circles' lens.
void find_circle_manifolds(const Covered& a, const Covered& b, const Pose& a_from_b,
                           const std::vector<NearPair>& circle_pairs, std::vector<ContactManifold>& manifolds);

}  // namespace polynya::geometry
