#pragma once

#include <filesystem>
#include <string>

#include "simulation/journal.hpp"

namespace polynya::io {

/// Of a run, only so many are written; events.ndjson has all.
inline constexpr std::int64_t kMostRejectedCuts = 100;

/// Writes a cut that geometry refused into a run folder as `polynya cut` reads it (docs/cut.md):
///   polynya cut rejected-cuts/000001.geojson --ops rejected-cuts/000001-ops.json
/// Returns what went wrong; empty where all is well.
/// The files are on the disk then, whatever happens to the machine.
std::string write_rejected_cut(const std::filesystem::path& run_folder, const simulation::RejectedCut& cut);

/// Removes the files that write_rejected_cut() wrote, and their folder if nothing else is in it. Returns what
/// went wrong; empty where all is well.
std::string remove_rejected_cuts(const std::filesystem::path& run_folder);

}  // namespace polynya::io
