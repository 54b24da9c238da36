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
  std::uint32_t crc = 0;
};

/// State of a run folder at a checkpoint. The writer needs it to continue the folder.
struct RunProgress {
  std::vector<WrittenFile> files;        ///< the files that grow, in the order of growing_files()
  std::vector<RecordedMotion> recorded;  ///< last record of each floe, by floe id
  std::vector<ShipPeaks> peaks;
};

/// Writes the folder of a run while it runs (docs/run-folder.md). The files on disk always have whole lines and whole
/// frames, and summary.json has "finished": false from the start, so that a killed run leaves a usable folder. Disk
/// errors are stored; the caller must look at status() regularly and stop.
class RunWriter {
 public:
  /// Prepares the folder (run_folder.hpp), and writes scene.json and a first summary.json. `scene` must exist longer
  /// than this object.
  static Result<RunWriter> create(const std::filesystem::path& folder, bool overwrite, const LoadedScene& scene);

  /// Does the same for a folder that already has its scene.json. All other files are written from the start.
  static Result<RunWriter> begin(RunLock lock, const LoadedScene& scene);

  /// Continues the folder of a run that was interrupted, or that ended before the scene's end. Whatever its files have
  /// beyond the checkpoint is cut off, and newer checkpoints are removed. `file` is the file of the checkpoint.
  static Result<RunWriter> resume(RunLock lock, const LoadedScene& scene, const Checkpoint& checkpoint,
                                  const std::filesystem::path& file, const simulation::Simulation& simulation);

  /// Writes the journal of the last step and empties it.
  void record(simulation::Journal& journal);

  /// Writes a frame: the present positions of all bodies.
  void frame(const simulation::Simulation& simulation);

  /// Returns true if the initial state has been written.
  bool has_begun() const { return has_begun_; }

  /// Writes the buffers if a second has passed or if they are large. It costs little if called after every step.
  void flush_if_due();

  /// Writes everything to the disk for a checkpoint, and returns the state of the folder.
  Result<RunProgress> sync();

  /// The first failure to write a file of the folder.
  Result<> status() const;

  /// Returns the names of files that have become too long to be read back.
  std::vector<std::string> overlong(std::uint64_t longest = kLongestRunFile) const;

  /// Largest loads recorded so far.
  const std::vector<ShipPeaks>& peaks() const { return peaks_; }

  /// Ends the run: writes the buffers, final.geojson if a simulation is given, and the last summary.json. The order
  /// makes the folder valid at any time: first all files, then the summary with "finished": true, then all checkpoints
  /// except that of the end are removed, and the checksums of all files are written.
  Result<> finish(const RunSummary& summary, const simulation::Simulation* simulation);

  /// Continues with a scene that differs only by its end (set_end()); it must exist longer than this object.
  Result<> end_with(const LoadedScene& scene) {
    scene_ = &scene;
    return set_end(folder(), scene);
  }

  const std::filesystem::path& folder() const { return lock_.folder(); }
  /// Returns true if another program removed, moved or replaced the folder or one of its files.
  bool is_displaced() const { return is_displaced_; }

 private:
  RunWriter(const LoadedScene& scene, std::vector<OutputFile> files, RunLock lock);
  /// Stores the properties of a floe that its events and frames need.
  void add_floe(simulation::FloeId floe, simulation::FloeId parent, geometry::Point centroid_in_body);
  OutputFile& file(std::size_t which) { return files_[which]; }
  /// Appends the text that `write` makes as one record. A file never contains only a part of a record.
  template <class Write>
  void append(std::size_t which, Write write) {
    record_.clear();
    write(record_);
    if (!record_.empty()) file(which).append(record_);
  }
  void flush();
  Result<> sync_files();
  /// Writes checksums.txt. `known` has the checksums of the files that were just written; other files are read.
  Result<> write_checksums(Checksums known) const;
  /// Stores a failure if the folder or one of its files no longer has its name.
  void check_place();

  const LoadedScene* scene_;
  std::vector<OutputFile> files_;  ///< in the order of growing_files()
  FrameEncoder frames_;
  std::vector<simulation::FloeId> parents_;         ///< by floe id
  std::vector<geometry::Point> centroids_in_body_;  ///< by floe id [m]
  std::vector<const ForceColumn*> peak_columns_;
  std::vector<ShipPeaks> peaks_;
  RunLock lock_;
  std::string record_;
  Result<> status_;  ///< failure of a file that is written in one step
  std::chrono::steady_clock::time_point last_flush_;
  bool is_displaced_ = false;
  bool has_begun_ = false;
};

}  // namespace polynya::io
