#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/frames.hpp"
#include "io/output_file.hpp"
#include "io/picture.hpp"
#include "io/scene_reader.hpp"
#include "io/summary.hpp"
#include "simulation/simulation.hpp"

namespace polynya::io {

/// Writes a run's folder while it runs (docs/run-folder.md). What is on disk is whole lines and whole frames
/// at all times, and summary.json says from the start that the run is not finished: a killed run leaves a
/// usable folder. Disk errors are kept: the caller asks failure() now and then and stops.
class RunWriter {
 public:
  /// Prepares the folder (run_folder.hpp) and writes scene.json and a first summary.json. `scene` must
  /// outlive this.
  static tl::expected<RunWriter, std::string> create(const std::filesystem::path& folder, bool overwrite,
                                                     const LoadedScene& scene);

  /// Takes down what the journal tells and clears it.
  void record(simulation::Journal& journal);

  /// Takes down a frame: where everything is now.
  void frame(const simulation::Simulation& simulation);

  /// Writes what is buffered if a second has passed or much has gathered. Cheap to call after every step.
  void flush_if_due();

  /// What went wrong with a file; empty where all is well.
  std::string failure() const;

  /// Peaks of the samples so far.
  const std::vector<ShipPeaks>& peaks() const { return peaks_; }

  /// Ends the run: everything buffered, final.geojson, final.svg and final.png (where there is a converter),
  /// and last summary.json. Returns what went wrong; empty where all is well.
  std::string finish(const RunSummary& summary, const simulation::Simulation& simulation);

  const std::filesystem::path& folder() const { return folder_; }
  bool has_png() const { return has_png_; }

 private:
  RunWriter(std::filesystem::path folder, const LoadedScene& scene, std::vector<OutputFile> files);
  OutputFile& file(std::size_t which) { return files_[which]; }
  void flush();
  std::string_view ship_name(int ship) const;
  Picture picture(const RunSummary& summary, const simulation::Simulation& simulation) const;

  std::filesystem::path folder_;
  const LoadedScene* scene_;
  std::vector<OutputFile> files_;  ///< in the order they are flushed: what is named before what names it
  FrameEncoder frames_;
  std::vector<simulation::FloeId> parents_;           ///< by floe id
  std::vector<geometry::Point> centroids_in_body_;    ///< by floe id [m]
  std::vector<std::vector<geometry::Point>> tracks_;  ///< by ship, one point a frame [m]
  std::vector<Picture::Fracture> fractures_;
  std::vector<ShipPeaks> peaks_;
  std::string line_;
  std::chrono::steady_clock::time_point last_flush_;
  bool has_png_ = false;
};

}  // namespace polynya::io
