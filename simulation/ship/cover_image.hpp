#pragma once

#include <cstddef>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "geometry/shape/pose.hpp"

namespace polynya::simulation {

struct World;

/// An image from above in a ship's frame: its first row is the farthest ahead, its first column to port.
struct ImageFrame {
  std::size_t rows = 0, columns = 0;
  double cell = 1;   ///< [m]
  double ahead = 0;  ///< of its middle, from the ship's centre of gravity [m]

  /// Of a circle about the middle that holds the image [m].
  double radius() const;
};

/// The share of each cell that polygons cover. Along a row it is exact on each of kLines lines a cell; cells
/// on which polygons overlap are 1 at most. Outer rings run counter-clockwise, holes clockwise.
class CoverImage {
 public:
  static constexpr int kLines = 4;

  explicit CoverImage(const ImageFrame& frame);
  void add(const geometry::Polygon& polygon, const geometry::Pose& ship_from_body);
  /// Row by row, into rows × columns numbers.
  void write(float* cells) const;

 private:
  void add_ring(const geometry::Ring& ring, const geometry::Pose& ship_from_body);
  void add_edge(geometry::Point a, geometry::Point b);
  void add_crossing(std::size_t row, double x, double share);

  ImageFrame frame_;
  std::vector<double> steps_;  ///< of the share, from each cell of a row to the next; one more than columns
};

/// Adds the floes whose circle touches the image. Floes under hulls are not in the way, and are left out.
void add_floes(const World& world, const geometry::Pose& world_from_ship, const ImageFrame& frame, CoverImage& image);

/// Returns the share of the water ahead of a hull that floating ice covers [-]: of a rectangle as wide as its beam,
/// from its foremost point to one length ahead.
double cover_ahead(const World& world, int ship);

}  // namespace polynya::simulation
