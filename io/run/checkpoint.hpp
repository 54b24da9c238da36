#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/run/run_writer.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {

/// An instant of a run from which it can be resumed, and what was on disk then.
///
///   file = "PLYNYCKP" u32:version u32:crc u64:length payload{length}
///
/// crc is the CRC-32 of the payload; the payload is the field list of this and of RunProgress in the layout
/// of simulation/state/archive.hpp. Little-endian.
struct Checkpoint {
  std::string program_version;  ///< that wrote it
  std::string course_hash;      ///< of the run's scene (LoadedScene::course_hash): it may end at another time
  std::int64_t steps = 0;       ///< done
  double wall_time =
      0;  ///< that the run has taken so far, all its parts together; 0 at its end: summary.json has it [s]
  RunProgress progress;  ///< of the run folder
  std::string state;     ///< simulation/state/state.hpp
  std::uint64_t state_hash = 0;
  std::string failure;  ///< of a dump: what went wrong in the step after it; empty in a checkpoint
};

inline constexpr std::uint32_t kCheckpointVersion = 25;

/// The file around a payload: mark, version, checksum, length.
std::string checkpoint_file_of(std::string_view payload);
std::string checkpoint_bytes(const Checkpoint& checkpoint);

/// Writes a file of these bytes to a temporary name, synced and renamed.
Result<> write_checkpoint_file(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// The error is why the bytes are no checkpoint, or a damaged one, or one of another version.
Result<Checkpoint> read_checkpoint(std::string_view bytes);

/// Whether a file has the name of a checkpoint.
bool is_checkpoint(const std::filesystem::path& path);

/// The checkpoints in a run folder, the newest first: "checkpoint-000000012000.bin" after 12 000 steps.
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& folder);

/// Writes a checkpoint into a run folder; only then all others are removed but the newest that is older.
Result<> write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint);

/// Makes a checkpoint, read from a file in the folder or elsewhere, the newest of a run folder that is to be
/// resumed from it: newer ones are of a course of the run that is now cut off.
Result<> rewind_to(const std::filesystem::path& folder, const Checkpoint& checkpoint,
                   const std::filesystem::path& file);

/// Reads a checkpoint of the folder whose scene has that LoadedScene::course_hash.
Result<Checkpoint> read_checkpoint_file(const std::filesystem::path& path, std::string_view course_hash);

/// Removes the checkpoints but the newest `kept`, and what a crash left of one, from a folder.
Result<> remove_checkpoints(const std::filesystem::path& folder, std::size_t kept = 0);

}  // namespace polynya::io
