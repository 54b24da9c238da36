#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/run/run_writer.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {

/// An instant of a run from which it can be resumed, and the state of the run folder at that instant. The file
/// failure.bin, a dump of the state before a faulty step, has the same format.
///
///   file = "PLYNYCKP" u32:version u32:crc u64:length payload{length}
///
/// All numbers are little-endian. `version` is kCheckpointVersion, `crc` the CRC-32 of the payload, and `length` the
/// number of its bytes. The payload has the members of this struct in their order, in the layout of
/// simulation/state/archive.hpp.
struct Checkpoint {
  std::string program_version;  ///< version of the program that wrote it, for information; it is not compared
  /// Hash of the run's scene without its end (LoadedScene::course_hash). A run of another scene cannot be resumed from
  /// the checkpoint, but the end may be changed.
  std::string course_hash;
  std::int64_t steps = 0;  ///< number of ticks that are done
  /// Wall time of the run so far, including the parts before it was resumed [s]. The last checkpoint of a finished run
  /// has 0 instead, so that two folders of the same run have equal bytes; summary.json then has the wall time.
  double wall_time = 0;
  RunProgress progress;  ///< state of the run folder; empty in a dump
  std::string state;     ///< state of the simulation (simulation/state/state.hpp)
  /// Hash of the simulation's state (Simulation::state_hash). A simulation that was restored from `state` must have the
  /// same hash; otherwise the checkpoint is refused as damaged.
  std::uint64_t state_hash = 0;
  std::string failure;  ///< in a dump: message about the failure in the next step; empty in a checkpoint
};

/// Version of the format. Raise it whenever the layout of the payload changes, including that of the simulation's
/// state. Files of other versions are refused, so runs of an older program cannot be resumed. If it is not raised, such
/// files are refused as damaged, or are read wrongly.
inline constexpr std::uint32_t kCheckpointVersion = 27;

/// Returns the bytes of a checkpoint file with this payload: mark, version, checksum, length and payload.
std::string checkpoint_file_of(std::string_view payload);
/// Returns the bytes of the file of a checkpoint.
std::string checkpoint_bytes(const Checkpoint& checkpoint);

/// Writes a checkpoint to a temporary name, waits until the disk has stored it, and renames it to `path`. A file of
/// that name is replaced; if writing fails, it stays as it was. The error names the file.
Result<> write_checkpoint_file(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Reads the bytes of a checkpoint file. Fails if they are no checkpoint, are damaged, or have another version. The
/// error does not name a file. The simulation's state in it is not checked; simulation_at() does that.
Result<Checkpoint> read_checkpoint(std::string_view bytes);

/// Returns true if a file has the name of a checkpoint: "checkpoint-", 12 digits, ".bin". The file is not read.
bool is_checkpoint(const std::filesystem::path& path);

/// Returns the checkpoints in a run folder, newest first; none if there is no such folder. The name of a checkpoint has
/// its number of steps: "checkpoint-000000012000.bin". Only names are looked at, so a file may be damaged.
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& folder);

/// Writes a checkpoint into a run folder. Then all other checkpoints are removed except the newest older one, which
/// remains in case the new one turns out to be damaged or to contain a failure. A failure to remove one is ignored. If
/// the new one cannot be written, this fails and removes none.
Result<> write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint);

/// Prepares a run folder for resuming from a checkpoint. Copies the checkpoint into the folder if `file`, from which it
/// was read, is not the folder's own file, and removes newer checkpoints, which belong to the part of the run that is
/// discarded. Older ones stay. Fails if a file cannot be written or removed; what was removed before is then lost.
Result<> rewind_to(const std::filesystem::path& folder, const Checkpoint& checkpoint,
                   const std::filesystem::path& file);

/// Reads a checkpoint from a file. Fails if it cannot be read, or if `course_hash` (LoadedScene::course_hash) of the
/// scene that is to be resumed is not that of the checkpoint. The error names the file. Fails also as read_checkpoint()
/// does.
Result<Checkpoint> read_checkpoint_file(const std::filesystem::path& path, std::string_view course_hash);

/// Removes checkpoints from a folder, except the newest `kept` ones. Also removes unfinished files of checkpoints
/// ("….bin.part"), which a crash left. Stops and fails at the first file that cannot be removed. A folder that does not
/// exist has none, so this succeeds.
Result<> remove_checkpoints(const std::filesystem::path& folder, std::size_t kept = 0);

}  // namespace polynya::io
