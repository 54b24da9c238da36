#pragma once

#include "geometry/exact/validity.hpp"
#include "io/scene/scene_input.hpp"
#include "io/text/json_value.hpp"
#include "io/text/problem_collector.hpp"

namespace polynya::io {

/// "ships[0]" or "structures[2]", "floes[1]" or "floes[1] (its floe 7)": for messages.
std::string ship_path(const SceneDraft& draft, std::size_t ship);
std::string floe_path(const SceneDraft& draft, std::size_t floe);

/// A waterline in the world.
geometry::Polygon waterline_in_world(const simulation::ShipSpec& ship);

/// "self-crossing at (5, 5), (0, 0)".
std::string describe(const geometry::DefectAt& defect);

/// What no single field shows: ice that would sink, a step too long for the speeds, invalid outlines,
/// floes that overlap each other or lie in a ship. Reports every problem with its place.
void check_scene(const SceneDraft& draft, const JsonValue& resolved, ProblemCollector& problems);

}  // namespace polynya::io
