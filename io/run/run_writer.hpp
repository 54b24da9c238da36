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

/// Length of a file at a checkpoint, and the CRC-32 of these bytes.
struct WrittenFile {
  std::uint64_t size = 0;  ///< [bytes]
  std::uint32_t crc = 0;
};

/// What of a run's folder is written, and what the writer needs to continue it.
struct RunProgress {
  std::vector<WrittenFile> files;        ///< those that grow
  std::vector<RecordedMotion> recorded;  ///< by floe id
  std::vector<ShipPeaks> peaks;
};

/// Writes a run's folder while it runs (docs/run-folder.md). What is on disk is whole lines and whole frames
/// at all times, and summary.json has "finished": false from the start: a killed run leaves a
/// usable folder. Disk errors are kept: the caller asks for status() now and then and stops.
class RunWriter {
 public:
  /// Prepares the folder (run_folder.hpp) and writes scene.json and a first summary.json. `scene` must
  /// outlive this.
  static Result<RunWriter> create(const std::filesystem::path& folder, bool overwrite, const LoadedScene& scene);

  /// The same for a folder that has its scene.json already: everything else of the run is written from the
  /// start.
  static Result<RunWriter> begin(RunLock lock, const LoadedScene& scene);

  /// Continues the folder of a run that was interrupted, or has come to an earlier end than the scene's: what its
  /// files have beyond the checkpoint is cut off, newer checkpoints too. `file` is where the checkpoint was read.
  static Result<RunWriter> resume(RunLock lock, const LoadedScene& scene, const Checkpoint& checkpoint,
                                  const std::filesystem::path& file, const simulation::Simulation& simulation);

  /// Records the journal and clears it.
  void record(simulation::Journal& journal);

  /// Records a frame: where everything is now.
  void frame(const simulation::Simulation& simulation);

  /// Whether the folder has what there is before the first step.
  bool has_begun() const { return has_begun_; }

  /// Writes what is buffered if a second has passed or much has gathered. Cheap to call after every step.
  void flush_if_due();

  /// Brings everything to the disk, for a checkpoint, and returns how far the folder is.
  Result<RunProgress> sync();

  /// The first failure to write a file of the folder.
  Result<> status() const;

  /// The files that have become too long to be read back.
  std::vector<std::string> overlong(std::uint64_t longest = kLongestRunFile) const;

  /// Peaks of the samples so far.
  const std::vector<ShipPeaks>& peaks() const { return peaks_; }

  /// Ends the run: everything buffered, final.geojson of a simulation, and last summary.json. All of it is on
  /// the disk before a summary with "finished": true is, and that one before the checkpoints are removed but that of
  /// the end, and the checksums of all written.
  Result<> finish(const RunSummary& summary, const simulation::Simulation* simulation);

  /// The same scene with the end that the run has come to instead of its own (set_end()); it outlives this.
  Result<> end_with(const LoadedScene& scene) {
    scene_ = &scene;
    return set_end(folder(), scene);
  }

  const std::filesystem::path& folder() const { return lock_.folder(); }
  /// Whether the folder and its files were removed, moved or replaced by another program.
  bool is_displaced() const { return is_displaced_; }

 private:
  RunWriter(const LoadedScene& scene, std::vector<OutputFile> files, RunLock lock);
  /// Keeps what events and frames need of a floe.
  void add_floe(simulation::FloeId floe, simulation::FloeId parent, geometry::Point centroid_in_body);
  OutputFile& file(std::size_t which) { return files_[which]; }
  /// Appends what `write` puts into a text as one record, of which no file holds a part.
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
  /// Keeps it as the failure if the folder or a file in it has lost its name.
  void check_place();

  const LoadedScene* scene_;
  std::vector<OutputFile> files_;  ///< in the order they are flushed: what is named before what names it
  FrameEncoder frames_;
  std::vector<simulation::FloeId> parents_;         ///< by floe id
  std::vector<geometry::Point> centroids_in_body_;  ///< by floe id [m]
  std::vector<const ForceColumn*> peak_columns_;
  std::vector<ShipPeaks> peaks_;
  RunLock lock_;
  std::string record_;
  Result<> status_;  ///< of what is written at once
  std::chrono::steady_clock::time_point last_flush_;
  bool is_displaced_ = false;
  bool has_begun_ = false;
};

}  // namespace polynya::io
