#pragma once

#include <string>

#include "io/run/available_memory.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::app {

/// An amount in words: "2.15 GB".
std::string amount_of_memory(double bytes);

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
