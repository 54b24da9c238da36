#pragma once

#include "geometry/cut/cut.hpp"
#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// By the law of crushing ice: the impulse with which a hull sets in motion the cusp that a bend breaks off and that
/// goes under it (`InsideFate::kUnderHull`). Brakes the hull, and enters it in its loads and in the accounts.
void turn_cusp(const Setup& setup, const PendingFracture& bend, const geometry::CutResult& cut, Population& population,
               ShipLoads& loads, AuditSums& audit);

}  // namespace polynya::simulation
