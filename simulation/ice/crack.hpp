#pragma once

#include "fracture/decision.hpp"
#include "geometry/contact/crack_path.hpp"
#include "simulation/world/population.hpp"
#include "simulation/world/setup.hpp"

namespace polynya::simulation {

/// A crack starts and ends this far outside the ice, so that it separates [m].
inline constexpr double kCrackMargin = 1e-3;

/// The crack through a floe from a point along a unit direction, both in the water frame.
geometry::CrackPath crack_through(const dynamics::Bodies& bodies, BodyIndex floe, geometry::Point point,
                                  geometry::Vector direction, geometry::CrackReach reach);

/// Enters the crack's length, and its width where the force that it takes is largest: a lower bound, by the
/// boundaries near that place alone.
void measure_crack(const dynamics::Bodies& bodies, BodyIndex floe, const geometry::CrackPath& path,
                   fracture::FailureCriteria& criteria);

/// Enters whether the crack would pare the floe's edge, and its width: at least twice the mean one of the ice
/// on the narrower side, since a crack that leaves an edge at a slant has that edge beside it. Takes a walk
/// around the floe; after measure_crack. Returns the ice on the two sides.
geometry::CrackSides measure_sides(const Setup& setup, const Population& population, BodyIndex floe,
                                   const geometry::CrackPath& path, fracture::FailureCriteria& criteria);

/// Twice the mean width of the ice on a crack's narrower side [m].
double mean_width_beside(const geometry::CrackPath& path, const geometry::CrackSides& sides);

/// Both, one after the other.
void measure_crack_and_sides(const Setup& setup, const Population& population, BodyIndex floe,
                             const geometry::CrackPath& path, fracture::FailureCriteria& criteria);

}  // namespace polynya::simulation
