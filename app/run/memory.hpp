#pragma once

#include <filesystem>
#include <string>

#include "simulation/world/scene.hpp"

namespace polynya::app {

/// How much memory this process can have in all, what it has already included.
struct MemoryAvailable {
  double bytes = 0;    ///< infinite where nothing limits it
  std::string source;  ///< what sets the limit, in words
};

/// The least of what is free on the machine, swap included (/proc/meminfo), of the control groups' limits
/// (version 2 and 1), and of the limits of the process (ulimit -v and -d). What cannot be read limits
/// nothing. `root` is where /proc and /sys are.
MemoryAvailable memory_available(const std::filesystem::path& root = "/");

/// An amount in words: "2.15 GB".
std::string amount_of_memory(double bytes);

/// Whether a run of a scene may fit into memory. Where it surely does not, that is reported on stderr; where
/// it does only while most of the ice rests, a note is. `name` stands in messages.
bool may_fit(const simulation::Scene& scene, const std::string& name, const MemoryAvailable& available);

/// Prints how large the files with all floes become, where they are many (io/run/run_folder.hpp).
void print_folder_size(const simulation::Scene& scene, bool has_final_geojson);

/// The message where memory ran out, with how much there is.
std::string out_of_memory();

/// What there is to be done about it.
inline constexpr const char* kToNeedLessMemory =
    "use fewer floes, fewer vertices or larger contact circles (contact.circle_radius_m), or more memory";

}  // namespace polynya::app
