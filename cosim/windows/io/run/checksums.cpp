#include "io/run/checksums.hpp"

// A co-simulation unit has no run folder, so there is nothing to check.

namespace polynya::io {

Result<Checksum> checksum_of(const std::filesystem::path& file, std::uint64_t) {
  return fail(file.string() + ": a co-simulation unit on Windows reads no files of runs");
}

Result<> announce_checksums(const std::filesystem::path& folder) {
  return fail(folder.string() + ": a co-simulation unit on Windows writes no files");
}

Result<> write_checksums(const std::filesystem::path& folder, const Checksums&) {
  return fail(folder.string() + ": a co-simulation unit on Windows writes no files");
}

}  // namespace polynya::io
