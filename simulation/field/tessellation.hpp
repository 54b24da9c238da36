#pragma once

#include <cmath>
#include <vector>

#include "geometry/shape/box_tree.hpp"
#include "simulation/field/portable_math.hpp"

namespace polynya::simulation {

/// The plane in which a field's floes are roundish: turned by `along`, and shrunk along it by as much as it
/// is stretched across. Areas are the same as in the world.
struct Plane {
  geometry::Vector along{1, 0};  ///< unit vector in the world
  double stretch = 1;            ///< of a floe along that direction over its width, ≥ 1

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

/// Where a field's floes may be: a region less what is kept clear, in the field's plane.
class FreeArea {
 public:
  /// Rings in the world, counter-clockwise and simple. Cells stay half the gap away from what is kept clear.
  FreeArea(const geometry::Ring& region, const std::vector<geometry::Polygon>& kept_clear, double gap,
           const Plane& plane);

  /// Convex, counter-clockwise, around all of it: the region itself where that is convex.
  const geometry::Ring& hull() const { return hull_; }
  /// Whether that is all there is to it.
  bool is_hull() const { return edges_.empty(); }
  bool holds(geometry::Point p) const;
  /// Of a convex ring, leaves a convex part that is free, nearly the largest; nothing where none is. True
  /// where the ring met a boundary.
  bool clip(geometry::Ring& ring) const;

 private:
  void add_edges(const geometry::Ring& in_world, bool is_free_inside, double margin, const Plane& plane);

  geometry::Ring hull_;
  geometry::Ring region_;  ///< empty where it is the hull
  std::vector<geometry::Ring> clear_;
  std::vector<geometry::Box> clear_boxes_;
  std::vector<geometry::Edge> edges_;  ///< the free side is to their left
  geometry::BoxTree tree_{edges_};     ///< of them
};

/// Area of the region that is not kept clear, exactly found [m²]. Rings are valid and counter-clockwise.
double free_area(const geometry::Ring& region, const std::vector<geometry::Polygon>& kept_clear);

struct FieldCell {
  geometry::Ring ring;      ///< convex, counter-clockwise, in the field's plane [m]; empty where no room was found
  bool is_clipped = false;  ///< by a boundary other than the hull's
};

/// Convex cells that tile the free area but for narrow corners at what is kept clear, cell i with an area in
/// proportion to areas[i] as nearly as the passes bring it (mostly within 1 %). A cell that found no room is
/// empty.
///
/// The areas lie in the plane as they stand in the list: points strewn evenly over the free area are halved
/// again and again, across the longer side of what they span, in proportion to the areas that are to lie
/// there. So every site starts amid about the area it needs, beside however large a neighbour. Weights start
/// as those of discs of the areas. Sites then move to their cells' centroids while each weight follows its
/// cell's error; at last sites stay, and all weights change together by parts of Newton's step [Balzer2009,
/// deGoes2012].
std::vector<FieldCell> tessellate(const FreeArea& free, const std::vector<double>& areas, Random& random);

}  // namespace polynya::simulation
