#pragma once

#include <filesystem>

#include "io/text/result.hpp"
#include "simulation/world/event.hpp"

namespace polynya::io {

/// At most this many of a run are written; events.ndjson has all.
inline constexpr std::int64_t kMostRejectedCuts = 100;

/// Writes a cut that geometry refused into a run folder as `polynya cut` reads it (docs/cut.md):
///   polynya cut rejected-cuts/000001.geojson --ops rejected-cuts/000001-ops.json
/// The files are on the disk then, whatever happens to the machine.
Result<> write_rejected_cut(const std::filesystem::path& run_folder, double time,
                            const simulation::RejectedCut& cut);

/// Removes the files that write_rejected_cut() wrote, and their folder if nothing else is in it.
Result<> remove_rejected_cuts(const std::filesystem::path& run_folder);

}  // namespace polynya::io
