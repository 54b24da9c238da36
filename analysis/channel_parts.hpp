#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "geometry/shape/polygon.hpp"
#include "io/run/run_reader.hpp"
#include "simulation/world/journal.hpp"

namespace polynya::analysis {
/// What a channel is measured with: ice as valid polygons, and what moves with the water.

/// A valid polygon of ice at some instant, with its box.
struct PlacedIce {
  const simulation::BirthRecord* birth = nullptr;  ///< of the floe; null: of the scene
  geometry::Polygon polygon;                       ///< in the world [m]
  geometry::Box box;
};

/// Adds a floe's polygon in the world. A placed shape is rounded and may not be valid any more: it is then
/// what its rings wind around, in as many polygons as that takes; none where they enclose nothing. Fails with
/// words where a coordinate is not finite.
tl::expected<void, std::string> add_ice(std::vector<PlacedIce>& ice, const simulation::BirthRecord* birth,
                                        geometry::Polygon polygon_in_world);

/// The polygons whose boxes meet a box.
std::vector<geometry::Polygon> near(const std::vector<PlacedIce>& ice, const geometry::Box& box);

/// What of a polygon others cover and what not.
struct Parted {
  std::vector<geometry::Polygon> inside;
  std::vector<geometry::Polygon> outside;
  double inside_area = 0;  ///< [m²]
};

/// Exact but for one rounding of vertices. Fails with words where geometry refuses the cut.
tl::expected<Parted, std::string> part(const geometry::Polygon& polygon, const std::vector<geometry::Polygon>& by);

/// A point that moves with the water (the scene's drift and shear), from one time to another [s]. The map is
/// affine in the plane; the motion of floes does not enter.
geometry::Point carried_by_water(const simulation::WaterSettings& water, geometry::Point point, double from, double to);
geometry::Polygon carried_by_water(const simulation::WaterSettings& water, geometry::Polygon polygon, double from,
                                   double to);

/// The longest pieces of time from the run's start to `time` over which no corner of the hull, carried by the
/// water to `time`, leaves the straight line between its ends by more than `tolerance` [m]: their ends [s].
std::vector<double> straight_pieces(const io::Run& run, const io::MotionIndex& motions, std::size_t ship, double time,
                                    double tolerance);

/// The convex hulls of a ship's waterline at both ends of each straight piece, carried by the water to
/// `time`: together they are what the hull swept, right to the tolerance. A waterline that is not convex is
/// taken as its convex hull.
std::vector<geometry::Polygon> swept_pieces(const io::Run& run, const io::MotionIndex& motions, std::size_t ship,
                                            double time, double tolerance);

}  // namespace polynya::analysis
