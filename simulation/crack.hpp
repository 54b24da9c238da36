#pragma once

#include "fracture/decision.hpp"
#include "fracture/materials.hpp"
#include "geometry/contact/crack_path.hpp"
#include "simulation/population.hpp"
#include "simulation/setup.hpp"

namespace polynya::simulation {

/// The crack through a floe from a point along a unit direction, both in the water frame.
geometry::CrackPath crack_through(const dynamics::Bodies& bodies, BodyIndex floe, geometry::Point point,
                                  geometry::Vector direction, geometry::CrackReach reach);

/// Enters the crack's width, and whether it would pare the floe's edge.
void measure_sides(const Setup& setup, const dynamics::Bodies& bodies, BodyIndex floe,
                   const geometry::CrackPath& path, fracture::FailureCriteria& criteria);

}  // namespace polynya::simulation
