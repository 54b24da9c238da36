#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "io/run/checksums.hpp"
#include "io/run/frames.hpp"
#include "io/run/records.hpp"
#include "io/run/run_folder.hpp"
#include "io/run/summary.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/output_file.hpp"
#include "simulation/simulation.hpp"

namespace polynya::io {

struct Checkpoint;

/// Length of a file at a checkpoint, and the CRC-32 of its bytes up to that length.
struct WrittenFile {
  std::uint64_t size = 0;  ///< [bytes]
  std::uint32_t crc = 0;   ///< resuming refuses a file whose first `size` bytes have another one
};

/// State of a run folder at a checkpoint. RunWriter::resume() needs it to cut the folder back to the checkpoint and to
/// continue it.
struct RunProgress {
  std::vector<WrittenFile> files;        ///< the files that grow, in the order of growing_files()
  std::vector<RecordedMotion> recorded;  ///< last record of each floe in frames.bin, by floe id
  std::vector<ShipPeaks> peaks;          ///< largest loads so far, for each hull of the scene
};

/// Writes the folder of a run while it runs (docs/run-folder.md). The files on disk always have whole lines and whole
/// frames, and summary.json has "finished": false from the start, so that a killed run leaves a usable folder. record()
/// and frame() only fill buffers, which are written from time to time. Disk errors are stored; the caller must look at
/// status() regularly and stop. After a failure, neither that file nor those behind it in growing_files() get more
/// records, so that no file names a record that is missing.
class RunWriter {
 public:
  /// Takes the folder for a new run (claim_run_folder; `overwrite` replaces an earlier run in it), and writes
  /// scene.json, the headers of all growing files and a first summary.json. `scene` must exist longer than this object.
  /// Fails if the folder cannot be used or a file cannot be written.
  static Result<RunWriter> create(const std::filesystem::path& folder, bool overwrite, const LoadedScene& scene);

  /// Does the same for a folder that is locked and already has its scene.json, for example of a run that was killed
  /// before its first checkpoint. All other files are written from the start, and its checkpoints are removed.
  static Result<RunWriter> begin(RunLock lock, const LoadedScene& scene);

  /// Continues the folder of a run that was interrupted, or that ended before the scene's end. Whatever its files have
  /// beyond the checkpoint is cut off, and newer checkpoints are removed. `file` is the file from which `checkpoint`
  /// was read, and `simulation` the simulation at the checkpoint. `scene` may have another end than scene.json, which
  /// then gets it (set_end()). Fails, without changing the folder, if the checkpoint is of another run, or if a growing
  /// file is shorter than at the checkpoint, damaged, or has columns of another version. Fails too if a file cannot be
  /// written or removed; the folder can then be resumed again.
  static Result<RunWriter> resume(RunLock lock, const LoadedScene& scene, const Checkpoint& checkpoint,
                                  const std::filesystem::path& file, const simulation::Simulation& simulation);

  /// Records the journal of the last step (new floes, events, loads and peaks of contacts), and empties it. Call it
  /// after every step and before frame(), because a frame needs the centroids of the floes that were born. Refused cuts
  /// are written to rejected-cuts/ at once.
  void record(simulation::Journal& journal);

  /// Records a frame: the present positions and velocities of all bodies in frames.bin, their contacts and crushed
  /// overlaps in contacts.csv and crushed.csv, and a hash of the state in states.csv. Overlaps below kLeastCrushedShare
  /// are left out. The caller decides when a frame is due.
  void frame(const simulation::Simulation& simulation);

  /// Returns true if the folder has a first frame, so that the initial state is recorded. A resumed run always has it.
  bool has_begun() const { return has_begun_; }

  /// Writes the buffers to the files if a second has passed since the last time, or if they have more than 256 KiB. It
  /// costs little if called after every step. A failure is stored for status().
  void flush_if_due();

  /// Writes the buffers and waits until the disk has stored the growing files, as is necessary before a checkpoint.
  /// Returns the state of the folder, which the checkpoint contains. Fails with status().
  Result<RunProgress> sync();

  /// Returns a failure to write a file of the folder, or the message that the folder was displaced (is_displaced());
  /// success if there was none. A failure stays for ever.
  Result<> status() const;

  /// Returns the names of growing files that have become longer than `longest` [bytes], so that they cannot be read
  /// back. Buffers that are not yet written count. The run goes on; the caller warns the user.
  std::vector<std::string> overlong(std::uint64_t longest = kLongestRunFile) const;

  /// Largest loads recorded so far, also before the run was resumed, for each hull of the scene, in the hull's frame.
  const std::vector<ShipPeaks>& peaks() const { return peaks_; }

  /// Ends the run: writes the buffers, final.geojson if a simulation is given (null: it is not written), and the last
  /// summary.json. For a finished run, the order makes the folder valid at any time: first all files, then the summary
  /// with "finished": true, then all checkpoints but the last one are removed, and the checksums of all files are
  /// written. For a run that was stopped, the summary is written before final.geojson, checkpoints stay, and there are
  /// no checksums. If is_displaced(), nothing is written. Fails if a file cannot be written. After a failure the other
  /// files are still written, except the summary and the checksums of a finished run, which must not claim more than is
  /// there. Call it once, as the last function.
  Result<> finish(const RunSummary& summary, const simulation::Simulation* simulation);

  /// Continues with a scene that differs only by its end, and writes that end to the folder (set_end()). The scene must
  /// exist longer than this object. Fails as set_end() does; the writer has the new scene even then.
  Result<> end_with(const LoadedScene& scene) {
    scene_ = &scene;
    return set_end(folder(), scene);
  }

  const std::filesystem::path& folder() const { return lock_.folder(); }
  /// Returns true if another program removed, moved or replaced the folder or one of its growing files, as noticed when
  /// buffers were written. No more is written then, and status() is a failure.
  bool is_displaced() const { return is_displaced_; }

 private:
  RunWriter(const LoadedScene& scene, std::vector<OutputFile> files, RunLock lock);
  /// Stores the parent of a floe, which its events name, and its centroid, whose motion its frames record.
  void add_floe(simulation::FloeId floe, simulation::FloeId parent, geometry::Point centroid_in_body);
  /// Returns a growing file by its index in growing_files().
  OutputFile& file(std::size_t which) { return files_[which]; }
  /// Appends the text that `write` makes as one record. A file never contains only a part of a record.
  template <class Write>
  void append(std::size_t which, Write write) {
    record_.clear();
    write(record_);
    if (!record_.empty()) file(which).append(record_);
  }
  /// Writes the buffers to the files in their order. After a failure the rest is dropped.
  void flush();
  /// Writes the buffers and waits for the disk.
  Result<> sync_files();
  /// Writes checksums.txt. `known` has the checksums of the files that were just written; other files are read.
  Result<> write_checksums(Checksums known) const;
  /// Sets is_displaced_ and stores a failure if the folder or one of its growing files no longer has its name.
  void check_place();

  const LoadedScene* scene_;
  std::vector<OutputFile> files_;  ///< in the order of growing_files()
  FrameEncoder frames_;
  std::vector<simulation::FloeId> parents_;         ///< by floe id
  std::vector<geometry::Point> centroids_in_body_;  ///< by floe id [m]
  std::vector<const ForceColumn*> peak_columns_;    ///< columns of ShipPeaks::of_column
  std::vector<ShipPeaks> peaks_;
  RunLock lock_;
  std::string record_;  ///< record that append() builds; a member so that its memory is used again
  Result<> status_;     ///< failure to write a rejected cut, or displacement of the folder or a growing file
  std::chrono::steady_clock::time_point last_flush_;
  bool is_displaced_ = false;
  bool has_begun_ = false;
};

}  // namespace polynya::io
