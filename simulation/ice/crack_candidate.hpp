#pragma once

#include <optional>

#include "simulation/ice/crack.hpp"
#include "simulation/ship/pressing.hpp"

namespace polynya::simulation {

/// A crack that a body may open in a floe.
struct CrackCandidate {
  Mouth mouth;
  geometry::Point begins_at;  ///< in the water frame: at the edge of the ice that the body has not crushed [m]
  geometry::CrackPath path_in_body;
  fracture::FailureCriteria criteria;
  double share() const { return criteria.opening_force / criteria.opening_capacity; }
};

/// The opening of a crack, and F_max by the length and width measured so far.
void enter_opening(const fracture::Opening& opening, const fracture::Ice& ice, fracture::FailureCriteria& criteria);

/// The crack from a mouth along a direction, where it can run: it does not pare, and it is no less than a
/// share of its way to F_max. One that would leave a strip turns to the free edge beside it. One that crosses
/// holes has to break each stretch of ice by itself.
std::optional<CrackCandidate> crack_candidate(const Setup& setup, const Population& population, BodyIndex floe,
                                              const PressedFloe& pressed, const Mouth& mouth,
                                              geometry::Vector direction, double least_share);

}  // namespace polynya::simulation
