#pragma once

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

}  // namespace polynya::io
