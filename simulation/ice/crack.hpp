#pragma once

#include "fracture/decision.hpp"
#include "geometry/contact/crack_path.hpp"
#include "simulation/world/population.hpp"
#include "simulation/world/setup.hpp"

namespace polynya::simulation {

/// Distance by which the path of a crack extends beyond the ice at both ends [m]. It ensures that the cut separates the
/// floe in spite of rounding. Larger values may reach other parts of a concave floe.
inline constexpr double kCrackMargin = 1e-3;

/// Returns the straight crack through a floe from a point along a unit direction, both in the water frame. `reach`
/// states whether it ends at the first free edge or crosses holes up to the far side. The path is in the floe's body
/// frame.
geometry::CrackPath crack_through(const dynamics::Bodies& bodies, BodyIndex floe, geometry::Point point,
                                  geometry::Vector direction, geometry::CrackReach reach);

/// Sets the length and the width of a crack in `criteria` [m]. The width is twice the distance to the boundary at the
/// place where the force that drives the crack is largest. It is a lower bound, because only the boundary near that
/// place is searched.
void measure_crack(const dynamics::Bodies& bodies, BodyIndex floe, const geometry::CrackPath& path,
                   fracture::FailureCriteria& criteria);

/// Sets in `criteria` whether a crack would leave a sliver, and increases its width to the value of mean_width_beside()
/// if that is larger: a crack that leaves an edge at a slant has that edge beside it. Must be called after
/// measure_crack(). Its time is proportional to the number of vertices of the floe. Returns the areas of ice on the two
/// sides.
geometry::CrackSides measure_sides(const Setup& setup, const Population& population, BodyIndex floe,
                                   const geometry::CrackPath& path, fracture::FailureCriteria& criteria);

/// Returns twice the mean width of the ice on the narrower side of a crack [m].
double mean_width_beside(const geometry::CrackPath& path, const geometry::CrackSides& sides);

/// Calls measure_crack() and then measure_sides().
void measure_crack_and_sides(const Setup& setup, const Population& population, BodyIndex floe,
                             const geometry::CrackPath& path, fracture::FailureCriteria& criteria);

}  // namespace polynya::simulation
