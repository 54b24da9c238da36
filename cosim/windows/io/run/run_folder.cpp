#include "io/run/run_folder.hpp"

// A co-simulation unit has no run folder.

namespace polynya::io {

std::span<const std::string_view> growing_files(const simulation::Scene&) {
  return {};
}

Result<RunLock> claim_run_folder(const std::filesystem::path& folder, bool) {
  return fail(folder.string() + ": a co-simulation unit on Windows writes no files");
}

Result<> set_end(const std::filesystem::path& folder, const LoadedScene&) {
  return fail(folder.string() + ": a co-simulation unit on Windows writes no files");
}

}  // namespace polynya::io
