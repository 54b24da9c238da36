#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/run/run_writer.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {

/// An instant of a run from which it can be resumed, and the state of the run folder at that instant.
///
///   file = "PLYNYCKP" u32:version u32:crc u64:length payload{length}
///
/// crc is the CRC-32 of the payload. The payload is the field list of this struct and of RunProgress in the layout of
/// simulation/state/archive.hpp, little-endian.
struct Checkpoint {
  std::string program_version;  ///< version of the program that wrote it
  std::string course_hash;      ///< hash of the run's scene without its end (LoadedScene::course_hash)
  std::int64_t steps = 0;       ///< number of ticks that are done
  /// Wall time of the run so far, with its earlier parts [s]. The last checkpoint of a run has 0 instead, so that two
  /// folders of the same run have equal bytes; summary.json has the time.
  double wall_time = 0;
  RunProgress progress;  ///< state of the run folder
  std::string state;     ///< state of the simulation (simulation/state/state.hpp)
  /// Hash of the simulation's state, which shows after reading whether it is complete.
  std::uint64_t state_hash = 0;
  std::string failure;  ///< in a dump: message about the failure in the next step; empty in a checkpoint
};

/// Version of the format. It is raised whenever the layout changes; files of other versions are refused.
inline constexpr std::uint32_t kCheckpointVersion = 27;

/// Returns the bytes of a checkpoint file with this payload: mark, version, checksum, length and payload.
std::string checkpoint_file_of(std::string_view payload);
std::string checkpoint_bytes(const Checkpoint& checkpoint);

/// Writes a checkpoint to a temporary name, waits until the disk has stored it, and renames it to `path`.
Result<> write_checkpoint_file(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Reads a checkpoint. Fails if the bytes are no checkpoint, are damaged, or have another version.
Result<Checkpoint> read_checkpoint(std::string_view bytes);

/// Returns true if the name of a file is that of a checkpoint.
bool is_checkpoint(const std::filesystem::path& path);

/// Returns the checkpoints in a run folder, newest first. One after 12 000 steps is "checkpoint-000000012000.bin".
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& folder);

/// Writes a checkpoint into a run folder. Then it removes all others except the newest of the older ones.
Result<> write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint);

/// Makes a checkpoint the newest of a run folder that is to be resumed from it, and removes newer ones, which belong to
/// the part of the run that is discarded. `file` is the file from which it was read, in the folder or elsewhere.
Result<> rewind_to(const std::filesystem::path& folder, const Checkpoint& checkpoint,
                   const std::filesystem::path& file);

/// Reads a checkpoint of the folder. Fails if its scene has another LoadedScene::course_hash.
Result<Checkpoint> read_checkpoint_file(const std::filesystem::path& path, std::string_view course_hash);

/// Removes all checkpoints except the newest `kept`, and unfinished files that a crash left, from a folder.
Result<> remove_checkpoints(const std::filesystem::path& folder, std::size_t kept = 0);

}  // namespace polynya::io
