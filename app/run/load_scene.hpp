#pragma once

#include <string>
#include <vector>

#include "app/command_line/console.hpp"
#include "io/run/available_memory.hpp"
#include "io/scene/scene_reader.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::app {

/// Reads a scene from a file, or from stdin if the name is "-", with progress on stderr. Floe files that the scene
/// names are searched for in the folder of the scene, for stdin in the working folder. `overrides` replace values of
/// the scene (--set, --until, --seed and the like). If the scene is wrong, all its problems are printed, by
/// print_problems() on stderr, or with `as_json` (`polynya validate --json`) as one array on stdout, and kSceneInvalid
/// is returned. If the file cannot be read, that is reported on stderr, and with `as_json` also on stdout, and
/// kInputOutput is returned.
Outcome<io::LoadedScene> load_scene(const std::string& file, const io::SceneOverrides& overrides = {},
                                    ProgressKind progress = ProgressKind::kNone, bool as_json = false);

/// Prints each problem of a scene or of a file with a ship on stderr, one per line, then their number and that nothing
/// was written. `name` is the file's name in the last line.
void print_problems(const std::string& name, const std::vector<io::Problem>& problems);

/// Prints the result of the scene's random fields of floes and channels of brash on stdout, some lines for each: the
/// number and the sizes of the floes, the covered fraction of the region, how many floes were left out, the thickness
/// and the volume of brash, and how well the sizes follow the requested law. A scene without them prints nothing.
void print_fields(const io::LoadedScene& scene);

/// Checks before a run whether it can fit into the available memory (memory_estimate.hpp). If not even the memory
/// before the first step is available, this is reported on stderr and false is returned; the caller then does not start
/// the run. If the run fits only while most of the ice rests, a note is printed on stderr and true is returned. `name`
/// names the scene in messages. The estimate depends on the scene alone, not on the recorded files.
bool may_fit(const simulation::Scene& scene, const std::string& name, const io::MemoryAvailable& available);

/// Prints a note on stderr about the lengths of the files with all floes, if there are more than io::kMostFloesInFinal
/// floes. `has_final_geojson` is true if final.geojson was asked for with --final-geojson; the note says whether it
/// will be written.
void print_folder_size(const simulation::Scene& scene, bool has_final_geojson);

/// Returns the message for memory that ran out, with the total amount that is available and its limit, if one is known.
std::string out_of_memory();

/// Advice to the user that callers add to messages about memory. out_of_memory() does not contain it.
inline constexpr const char* kToNeedLessMemory =
    "use fewer floes, fewer vertices or larger contact circles (contact.circle_radius_m), or more memory";

}  // namespace polynya::app
