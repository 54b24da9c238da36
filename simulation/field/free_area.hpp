#pragma once

#include <cstdint>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "simulation/field/plane.hpp"

namespace polynya::simulation {

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
  struct Edge {
    geometry::Point from;  ///< the free side is to its left
    geometry::Point to;
  };
  void add_edges(const geometry::Ring& in_world, bool is_free_inside, double margin, const Plane& plane);
  void bin_edges();
  template <class Visit>
  void for_bins(const geometry::Box& box, Visit visit) const;

  geometry::Ring hull_;
  geometry::Ring region_;  ///< empty where it is the hull
  std::vector<geometry::Ring> clear_;
  std::vector<geometry::Box> clear_boxes_;
  std::vector<Edge> edges_;
  geometry::Box box_;
  int bins_ = 1;  ///< along each side of the box
  std::vector<std::vector<std::uint32_t>> near_edges_;
};

/// Area of the region that is not kept clear, exactly found [m²]. Rings are valid and counter-clockwise.
double free_area(const geometry::Ring& region, const std::vector<geometry::Polygon>& kept_clear);

}  // namespace polynya::simulation
