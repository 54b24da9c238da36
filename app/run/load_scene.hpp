#pragma once

#include <string>
#include <vector>

#include "app/command_line/console.hpp"
#include "io/run/available_memory.hpp"
#include "io/scene/scene_reader.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::app {

/// Reads the scene of a file, with progress on stderr, or that of stdin if the name is "-"; its floe files are then
/// searched for in the working folder. If the scene cannot be read or is wrong, all problems are printed, one per line
/// on stderr, or with `as_json` as one array on stdout, and the exit code is returned.
Outcome<io::LoadedScene> load_scene(const std::string& file, const io::SceneOverrides& overrides = {},
                                    ProgressKind progress = ProgressKind::kNone, bool as_json = false);

/// Prints each problem of a file on stderr, one per line, and their number.
void print_problems(const std::string& name, const std::vector<io::Problem>& problems);

/// Prints the result of the scene's random fields on stdout: sizes, cover, and for a law of sizes how well the floes
/// follow it.
void print_fields(const io::LoadedScene& scene);

/// Checks whether a run of a scene can fit into memory. If it certainly cannot, this is reported on stderr and false is
/// returned. If it can only while most of the ice rests, a note is printed. `name` names the scene in messages.
bool may_fit(const simulation::Scene& scene, const std::string& name, const io::MemoryAvailable& available);

/// Prints how long the files with all floes will be, if there are many floes (io/run/run_folder.hpp).
void print_folder_size(const simulation::Scene& scene, bool has_final_geojson);

/// Returns the message for a lack of memory, with the available amount.
std::string out_of_memory();

/// Advice at the end of that message.
inline constexpr const char* kToNeedLessMemory =
    "use fewer floes, fewer vertices or larger contact circles (contact.circle_radius_m), or more memory";

}  // namespace polynya::app
