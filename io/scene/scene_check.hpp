#pragma once

#include <optional>
#include <string>

#include "geometry/exact/validity.hpp"
#include "io/scene/scene_input.hpp"

namespace polynya::io {

// What no single field of a scene shows. Every problem is reported with its place; `given` is the scene's
// JSON.

/// The scene's list of bodies of a kind: "ships".
std::string_view list_of(simulation::BodyKind kind);

/// "ships[0]" or "structures[2]", "floes[1]" or "floes[1] (its floe 7)": for messages.
std::string hull_path(const SceneDraft& draft, std::size_t hull);
std::string floe_path(const SceneDraft& draft, std::size_t floe);

/// Of a waterline, along and across the hull's axis [m].
geometry::Vector size_of(const simulation::Hull& hull);

/// Constant thrust or bollard pull along the heading; 0 of a ship at constant speed [N].
double thrust_of(const simulation::Ship& ship);

/// A waterline in the world.
geometry::Polygon waterline_in_world(const simulation::PlacedHull& hull);

/// "self-crossing at (5, 5), (0, 0)".
std::string describe(const geometry::DefectAt& defect);

/// What needs no floe: water, time, walls, hulls, bodies that start faster than a run allows, and a step in
/// which one moves as far as a contact circle's radius. Speeds are those of rims, relative to the water;
/// ships' include what thrust adds in the first step.
void check_without_ice(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems);

/// The rest, once the floes are there: ice that would sink, the speeds of floes, loads that no ice bears,
/// invalid outlines, floes that overlap each other or lie in a ship.
void check_ice(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems);

/// What in a valid scene is probably not meant: a ship far from the weight of the water its hull displaces,
/// one that leaves all ice behind, speeds and thicknesses beyond those of ships and level ice, prescribed
/// courses that cross, no ice. Added to `hints` with their severity; a run is never refused for them.
void add_scene_hints(const SceneDraft& draft, const JsonValue& given, ProblemCollector& hints);

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
