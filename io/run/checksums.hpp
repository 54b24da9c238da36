#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/checksum.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {

// The checksums of a finished run's files, in its file checksums.txt: a line a file,
//
//   0f3a2b1c 123456 forces.csv        CRC-32 and length [bytes], as they were when the run finished
//
// and last the line of checksums.txt itself, of all lines above it.
// The file is there only while all that it names is as it was written: it is written last, when the run has finished,
// and removed before anything of the run is changed. Only checkpoints and pictures may be removed before it.

using Checksums = std::map<std::string, Checksum>;  ///< by the name of the file, relative to the folder

/// The checksum of a regular file, or of its first bytes; the error names the file.
Result<Checksum> checksum_of(const std::filesystem::path& file,
                             std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

/// Writes the checksums of a run that has finished.
Result<> write_checksums(const std::filesystem::path& folder, const Checksums& checksums);

/// Adds files that were written after the end of a run, by reading them; only where the run has checksums.
Result<> add_checksums(const std::filesystem::path& folder, const std::vector<std::string_view>& names);

/// Removes the checksums, so that the run may be changed.
Result<> remove_checksums(const std::filesystem::path& folder);

/// What the checksums of a run say about its files.
struct FilesCheck {
  bool has_checksums = false;        ///< older runs, and those that have not finished, have none
  std::size_t files = 0;             ///< that were compared
  std::vector<std::string> damaged;  ///< of each file that is not as the run wrote it, its path and what is wrong
};

/// Compares the files of a run's folder with its checksums.
FilesCheck check_files(const std::filesystem::path& folder);

}  // namespace polynya::io
