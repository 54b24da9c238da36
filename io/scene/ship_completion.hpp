#pragma once

#include <optional>
#include <string>

#include "io/scene/scene_input.hpp"

namespace polynya::io {

/// A ship as the simulation has it. What is not given follows from its other particulars: mass, moment of
/// inertia, bollard pull, rudder, mooring, whether water acts on the hull. What is written of it with the
/// scene, masses, the speed of one at constant speed and the model of the water, is put into the input.
/// Reports what does not go together, at the ship's path; `given` is its JSON, `density` the water's [kg/m³].
simulation::Ship complete_ship(ShipInput& input, const JsonValue& given, const std::string& path, double density,
                               ProblemCollector& problems);

simulation::Structure complete_structure(const StructureInput& input);

/// A wall, or reports why it is none.
std::optional<simulation::Wall> complete_wall(const WallInput& input, const JsonValue& given, const std::string& path,
                                              ProblemCollector& problems);

/// Finds whom ships follow. Reports pilots that cannot do what they are to do: without an engine or steering,
/// beyond the rudder's stop, on a route that begins behind the ship or leads through a structure, behind a
/// ship that is not there or that follows them. `given` is the scene's JSON.
void complete_pilots(const JsonValue& given, SceneDraft& draft, ProblemCollector& problems);

}  // namespace polynya::io
