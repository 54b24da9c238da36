#pragma once

#include <optional>
#include <string>

#include "geometry/exact/validity.hpp"
#include "io/scene/scene_input.hpp"

namespace polynya::io {

// Checks that concern several fields of a scene. Every problem is reported with its place. `given` is the JSON of the
// scene.

/// Returns the name of the scene's list of bodies of a kind, such as "ships".
std::string_view list_of(simulation::BodyKind kind);

/// Return the path of a body for messages: "ships[0]", "structures[2]"; "floes[1]" or "floes[1] (its floe 7)".
std::string hull_path(const SceneDraft& draft, std::size_t hull);
std::string floe_path(const SceneDraft& draft, std::size_t floe);

/// Returns length and width of a waterline, along and across the hull's axis [m].
geometry::Vector size_of(const simulation::Hull& hull);

/// Returns the constant thrust or the bollard pull of a ship [N]; 0 for a ship at constant speed.
double thrust_of(const simulation::Ship& ship);

/// Returns the waterline of a hull in the world.
geometry::Polygon waterline_in_world(const simulation::PlacedHull& hull);

/// Describes a fault of an outline: "self-crossing at (5, 5), (0, 0)".
std::string describe(const geometry::DefectAt& defect);

/// Checks everything that does not depend on floes: water, time, walls, hulls, initial speeds above the limit of a run,
/// and time steps in which a body moves by the radius of a contact circle. Speeds are those of the outermost points
/// relative to the water. For ships they include the gain from the thrust in the first step.
void check_without_ice(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems);

/// Checks everything that depends on floes: ice that would sink, speeds of floes, loads that no ice can carry, outlines
/// that are not valid, floes that overlap each other or lie in a ship.
void check_ice(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems);

/// Adds warnings and hints on values of a valid scene that are probably not intended: a mass that does not match the
/// displacement of the hull, a ship that moves away from all ice, unusual speeds and thicknesses, prescribed motions
/// that cross, a scene without ice. They never prevent a run.
void add_scene_hints(const SceneDraft& draft, const JsonValue& given, ProblemCollector& hints);

/// Returns the ship of the simulation. Values that are not given are computed from others: mass, moment of inertia,
/// bollard pull, rudder, mooring, and whether water acts on the hull. Values that the resolved scene states are stored
/// in the input: masses, the speed of a ship at constant speed, and the model of the water. Values that contradict each
/// other are reported at the ship's path. `given` is the JSON of the ship, `density` that of the water [kg/m³].
simulation::Ship complete_ship(ShipInput& input, const JsonValue& given, const std::string& path, double density,
                               ProblemCollector& problems);

simulation::Structure complete_structure(const StructureInput& input);

/// Returns a wall; if the input is wrong, reports it and returns nothing.
std::optional<simulation::Wall> complete_wall(const WallInput& input, const JsonValue& given, const std::string& path,
                                              ProblemCollector& problems);

/// Finds the ship that each following ship follows. Reports pilots that cannot work: without an engine or steering,
/// with a rudder angle beyond the stop, on a route that begins behind the ship or leads through a structure, behind a
/// ship that does not exist or that in turn follows this one. `given` is the JSON of the scene.
void complete_pilots(const JsonValue& given, SceneDraft& draft, ProblemCollector& problems);

}  // namespace polynya::io
