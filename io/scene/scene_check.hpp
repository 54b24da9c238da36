#pragma once

#include <optional>
#include <string>

#include "geometry/exact/validity.hpp"
#include "io/scene/scene_input.hpp"

namespace polynya::io {

// Checks that concern several fields of a scene, and the completion of bodies by values that are computed from others.
// The reader of scenes calls complete_ship() and the like for each body, then complete_pilots(), check_without_ice(),
// makes the floes, and calls check_ice(). If there are no problems, it calls add_scene_hints(). Every problem is added
// to `problems` with its place, and a scene with a problem is refused. `given` is the JSON of the scene unless stated
// otherwise.

/// Returns the name of the scene's list of bodies of a kind: "ships", "structures", "walls" or "floes".
std::string_view list_of(simulation::BodyKind kind);

/// Return the path of a body for messages: "ships[0]", "structures[2]"; "floes[1]" or "floes[1] (its floe 7)". `hull`
/// is the number of a hull in the scene, from 0, counted through ships, structures and walls; `floe` is the index of a
/// floe of the scene. An entry of the list "floes" may make several floes, which the part in brackets counts from 0.
std::string hull_path(const SceneDraft& draft, std::size_t hull);
std::string floe_path(const SceneDraft& draft, std::size_t floe);

/// Returns length (x) and width (y) of the box around a waterline in the hull's frame, along and across its axis [m].
geometry::Vector size_of(const simulation::Hull& hull);

/// Returns the constant thrust, which is negative astern, or the bollard pull of a ship [N]; 0 for a ship at constant
/// speed.
double thrust_of(const simulation::Ship& ship);

/// Returns the waterline of a hull in the world at the start [m].
geometry::Polygon waterline_in_world(const simulation::PlacedHull& hull);

/// Describes a fault of an outline for messages, with at most three of its places [m]:
/// "self-crossing at (5, 5), (0, 0)".
std::string describe(const geometry::DefectAt& defect);

/// Checks everything that does not depend on floes: water and wind, number of time steps, contact settings, walls,
/// hulls, thrusts, speeds of ships and currents that a run would stop at (simulation::kRunawaySpeed, 1000 m/s), and
/// time steps in which a ship or the water moves by the radius of a contact circle. The speed of a ship is its initial
/// speed along the heading, over ground, plus the gain from the thrust in the first step.
void check_without_ice(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems);

/// Checks everything that depends on floes: ice that would sink, the same limits for the speeds of floes, loads of
/// walls that no ice can carry, outlines that are not valid, fast ice that would run onto other fast ice, and bodies
/// that overlap. The speed of a floe is that of its outermost point over the water of the uniform drift, so that the
/// velocity of a sheared current is added to its own. Overlaps with floes that a run left
/// (FloeSpec::has_crushed_overlaps) are accepted, unless they cover more than 90 % of the smaller body, because the
/// same ice would then be counted twice. Other overlaps are refused, at most 200 of them by name. Walls may cross each
/// other and structures, and ice under a hull may overlap anything. Refuses a scene with neither hulls nor floes.
void check_ice(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems);

/// Adds warnings and hints on values of a valid scene that are probably not intended: a mass that does not match the
/// displacement of the hull, a ship that moves away from all ice, unusual speeds and thicknesses, prescribed motions
/// that cross, a scene without ice, and keys of earlier versions. They never prevent a run. Call it only if there are
/// no problems, because it relies on values that the checks accept.
void add_scene_hints(const SceneDraft& draft, const JsonValue& given, ProblemCollector& hints);

/// Returns the ship of the simulation. Values that are not given are computed from others: mass, moment of inertia,
/// bollard pull, rudder, mooring, and whether water acts on the hull. The computed values that the resolved scene
/// states are stored in the input: mass, moment of inertia, the speed of a ship at constant speed, and the model of the
/// water. Values that are missing or contradict each other are reported; the returned ship is then not meant for a run,
/// and a mass that is missing is infinite in it, so that it causes no further messages. `given` is the JSON of the
/// ship, `path` its path for messages ("ships[0]"), and `density` that of the water [kg/m³].
simulation::Ship complete_ship(ShipInput& input, const JsonValue& given, const std::string& path, double density,
                               ProblemCollector& problems);

/// Returns the structure of the simulation. All its sides have the slope of the input. It needs no check of its own.
simulation::Structure complete_structure(const StructureInput& input);

/// Returns the wall of the simulation. If its face is shorter than 0.1 m, reports that and returns nothing. `given` is
/// the JSON of the wall, and `path` its path for messages ("walls[0]").
std::optional<simulation::Wall> complete_wall(const WallInput& input, const JsonValue& given, const std::string& path,
                                              ProblemCollector& problems);

/// Completes the pilots of all ships. It finds the ship that each following ship follows. For each ship that manages
/// ice it finds the protected body, the ships on the same line, and the depth of the pattern if none is given. Reports
/// pilots that cannot work: without an engine or steering, with a steering angle beyond the stop, with rows that are
/// not in order of time, on a route that begins behind the ship or leads through a structure or wall, behind a ship
/// that does not exist or that in turn follows this one, or on a pattern that has no valid form or comes too near to
/// the body or to another ship.
void complete_pilots(const JsonValue& given, SceneDraft& draft, ProblemCollector& problems);

}  // namespace polynya::io
