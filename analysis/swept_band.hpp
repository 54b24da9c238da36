#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/run/motion_index.hpp"
#include "io/run/run_reader.hpp"

namespace polynya::analysis {

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
