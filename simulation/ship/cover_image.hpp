#pragma once

#include <cstddef>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "geometry/shape/pose.hpp"

namespace polynya::simulation {

struct World;

/// Frame of an image from above that moves with a ship. The first row is the farthest ahead, and the first column is
/// the farthest to port.
struct ImageFrame {
  std::size_t rows = 0, columns = 0;
  double cell = 1;   ///< side of a cell [m]
  double ahead = 0;  ///< distance of the image's middle ahead of the ship's centre of gravity [m]

  /// Returns the radius of the circle about the middle that contains the image [m].
  double radius() const;
};

/// Computes the fraction of each cell that polygons cover. Each cell is sampled on kLines lines along its row, and the
/// fraction is exact on each line. If polygons overlap, the fraction is at most 1. Outer rings run counter-clockwise,
/// holes clockwise.
class CoverImage {
 public:
  /// Number of lines in each row of cells. More lines resolve floes that are smaller than a cell and cost time.
  static constexpr int kLines = 4;

  explicit CoverImage(const ImageFrame& frame);
  /// Adds a polygon in the body frame of its floe.
  void add(const geometry::Polygon& polygon, const geometry::Pose& ship_from_body);
  /// Writes the fractions row by row into rows × columns numbers.
  void write(float* cells) const;

 private:
  void add_ring(const geometry::Ring& ring, const geometry::Pose& ship_from_body);
  void add_edge(geometry::Point a, geometry::Point b);
  void add_crossing(std::size_t row, double x, double share);

  ImageFrame frame_;
  /// For each cell, the change of the fraction from the cell before; columns + 1 for each row.
  std::vector<double> steps_;
};

/// Adds the floes whose bounding circle touches the image. Floes under hulls are left out, because they are not in the
/// way.
void add_floes(const World& world, const geometry::Pose& world_from_ship, const ImageFrame& frame, CoverImage& image);

/// Returns the fraction of the water ahead of a hull that floating ice covers [-], in a rectangle that is as wide as
/// the hull's beam and extends from its foremost point to one hull length ahead.
double cover_ahead(const World& world, int ship);

}  // namespace polynya::simulation
