#pragma once

#include <string>
#include <vector>

#include "app/command_line/console.hpp"
#include "io/run/available_memory.hpp"
#include "io/scene/scene_reader.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::app {

/// The scene of that file, or of stdin where its name is "-" (floe files are then searched in the working
/// folder), with its progress on stderr. Where it cannot be read or is wrong, every problem has been printed,
/// and it is the code to exit with: a line each on stderr, with `as_json` as one array on stdout.
Outcome<io::LoadedScene> load_scene(const std::string& file, const io::SceneOverrides& overrides = {},
                                    ProgressKind progress = ProgressKind::kNone, bool as_json = false);

/// Each problem of that file on stderr, a line each, and how many there are.
void print_problems(const std::string& name, const std::vector<io::Problem>& problems);

/// How the scene's random fields came out, on stdout: sizes, cover, and of a size law how near the floes are to it.
void print_fields(const io::LoadedScene& scene);

/// Whether a run of a scene may fit into memory. Where it surely does not, that is reported on stderr; where
/// it does only while most of the ice rests, a note is. `name` stands in messages.
bool may_fit(const simulation::Scene& scene, const std::string& name, const io::MemoryAvailable& available);

/// Prints how large the files with all floes become, where they are many (io/run/run_folder.hpp).
void print_folder_size(const simulation::Scene& scene, bool has_final_geojson);

/// The message where memory ran out, with how much there is.
std::string out_of_memory();

/// What there is to be done about it.
inline constexpr const char* kToNeedLessMemory =
    "use fewer floes, fewer vertices or larger contact circles (contact.circle_radius_m), or more memory";

}  // namespace polynya::app
