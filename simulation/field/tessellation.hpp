#pragma once

#include <cmath>
#include <vector>

#include "geometry/shape/box_tree.hpp"
#include "simulation/field/portable_math.hpp"

namespace polynya::simulation {

/// The plane in which cells are made. It is the world turned to the direction `along`, and shrunk along it and
/// stretched across it by √stretch, so that long floes of the world become round. Areas are the same as in the world.
struct Plane {
  geometry::Vector along{1, 0};  ///< unit vector in the world
  double stretch = 1;            ///< length over width of a floe in that direction, ≥ 1 [-]

  geometry::Point from_world(geometry::Point p) const {
    const geometry::Vector v = p - geometry::Point{};
    const double root = std::sqrt(stretch);
    return {dot(along, v) / root, cross(along, v) * root};
  }
  geometry::Point to_world(geometry::Point p) const {
    const double root = std::sqrt(stretch);
    return geometry::Point{} + (p.x * root) * along + (p.y / root) * perpendicular(along);
  }
  geometry::Ring from_world(geometry::Ring ring) const {
    if (!is_world()) {
      for (geometry::Point& p : ring) p = from_world(p);
    }
    return ring;
  }
  geometry::Ring to_world(geometry::Ring ring) const {
    if (!is_world()) {
      for (geometry::Point& p : ring) p = to_world(p);
    }
    return ring;
  }
  bool is_world() const { return stretch == 1 && along == geometry::Vector{1, 0}; }
};

/// The area in which a field's floes may lie: a region without the areas that are kept clear, in the plane of the
/// cells.
class FreeArea {
 public:
  /// All rings are in the world frame, counter-clockwise and simple. Cells stay half of the gap away from areas kept
  /// clear.
  FreeArea(const geometry::Ring& region, const std::vector<geometry::Polygon>& kept_clear, double gap,
           const Plane& plane);

  /// Returns a convex counter-clockwise ring around the whole area: the region itself if it is convex, and otherwise
  /// its bounding box.
  const geometry::Ring& hull() const { return hull_; }
  /// Returns true if the area is exactly that ring.
  bool is_hull() const { return edges_.empty(); }
  /// Returns true if a point is in the area.
  bool holds(geometry::Point p) const;
  /// Reduces a convex ring to a convex part of it that is free, nearly the largest one; empty if there is none. Returns
  /// true if the ring met a boundary.
  bool clip(geometry::Ring& ring) const;

 private:
  void add_edges(const geometry::Ring& in_world, bool is_free_inside, double margin, const Plane& plane);

  geometry::Ring hull_;
  geometry::Ring region_;  ///< region in the plane; empty if it equals the hull
  std::vector<geometry::Ring> clear_;
  std::vector<geometry::Box> clear_boxes_;
  std::vector<geometry::Edge> edges_;  ///< edges of region and clearings, with the free side to their left
  geometry::BoxTree tree_{edges_};     ///< search tree of edges_
};

/// Returns the area of a region that is not kept clear, computed by exact cuts [m²]. Rings must be valid and
/// counter-clockwise.
double free_area(const geometry::Ring& region, const std::vector<geometry::Polygon>& kept_clear);

/// A cell of a tessellation.
struct FieldCell {
  /// Convex counter-clockwise ring in the plane of the cells [m]; empty if the cell found no space.
  geometry::Ring ring;
  bool is_clipped = false;  ///< true if it was cut by a boundary other than the hull's
};

/// Returns convex cells that tile the free area, except for narrow corners at areas kept clear. The area of cell i is
/// in proportion to areas[i], mostly within 1 %. A cell that found no space is empty.
///
/// Neighbouring areas of the list lie near each other in the plane. Points that are distributed evenly over the free
/// area are divided into halves again and again, across the longer side of their bounding box, in proportion to the
/// areas of either half of the list. So each site starts in the middle of about the area that it needs, however large
/// its neighbours are. The weights of the power diagram start as the squared radii of discs with these areas. Then
/// sites move to the centroids of their cells while each weight follows the error of its cell. Finally the sites stay,
/// and all weights change together by fractions of Newton's step [Balzer2009, deGoes2012].
std::vector<FieldCell> tessellate(const FreeArea& free, const std::vector<double>& areas, Random& random);

}  // namespace polynya::simulation
