#pragma once

#include <string>

#include "io/scene/scene_input.hpp"

namespace polynya::io {

/// A ship as the simulation has it. What is not given follows from its other particulars: mass, moment of
/// inertia, bollard pull, rudder, mooring, whether water acts on the hull. What is written of it with the
/// scene, masses, the speed of one at constant speed and the model of the water, is put into the input.
/// Reports what does not go together, at the ship's path; `given` is its JSON, `density` the water's [kg/m³].
simulation::ShipSpec complete_ship(ShipInput& input, const JsonValue& given, const std::string& path,
                                   double density, ProblemCollector& problems);

/// A structure is a ship that stands on the ground.
simulation::ShipSpec complete_structure(const StructureInput& input);

}  // namespace polynya::io
