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

// The file checksums.txt of a finished run has one line for each file that the run wrote:
//
//   0f3a2b1c 123456 forces.csv        CRC-32, length [bytes] and name
//
// Its last line has the checksum of the lines above it, under the name checksums.txt. The program writes the file last,
// when the run has finished, and removes it before it changes the record of the run. So while checksums.txt exists,
// every file must be as the run wrote it. Only checkpoints and pictures may be missing; those that exist are compared.
// Pictures are drawn after the end of the run, and their lines are then added.

using Checksums = std::map<std::string, Checksum>;  ///< by file name, relative to the folder

/// Returns the checksum of the first `most` bytes of a regular file, or of all bytes if it has fewer. A resumed run
/// compares with it the part of a growing file up to its checkpoint. Anything but a regular file is refused, also a
/// link to one. The error names the file.
Result<Checksum> checksum_of(const std::filesystem::path& file,
                             std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

/// Writes an empty file under the temporary name of checksums.txt, before summary.json says that the run has finished.
/// It is there until write_checksums() has given it its name.
Result<> announce_checksums(const std::filesystem::path& folder);

/// Writes the checksums of a run that has finished.
Result<> write_checksums(const std::filesystem::path& folder, const Checksums& checksums);

/// Reads files that were written after the end of a run and adds their checksums, in place of older ones of the same
/// names. Replaces checksums.txt in one step. Does nothing if the run has none; fails if checksums.txt is damaged.
Result<> add_checksums(const std::filesystem::path& folder, const std::vector<std::string_view>& names);

/// Removes checksums.txt if it exists. Every function that changes the record of a finished run calls this first.
/// Drawing pictures and removing checkpoints do without it.
Result<> remove_checksums(const std::filesystem::path& folder);

/// Returns true if checksums.txt was announced and is missing: the program was killed at the end of the run. `polynya
/// resume` then does not take the run for finished, and writes its last files again.
bool lacks_checksums(const std::filesystem::path& folder);

/// Result of comparing the files of a run with their checksums.
struct FilesCheck {
  bool has_checksums = false;        ///< checksums.txt exists; false for runs of older versions and unfinished runs
  std::size_t files = 0;             ///< number of compared files, without checksums.txt and files that are missing
  std::vector<std::string> damaged;  ///< one message for each file that differs: its path and what is wrong
};

/// Compares the files of a run's folder with its checksums. If checksums.txt itself is damaged, only that is reported.
FilesCheck check_files(const std::filesystem::path& folder);

}  // namespace polynya::io
