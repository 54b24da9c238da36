#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>

#include "io/scene/scene_reader.hpp"
#include "io/text/output_file.hpp"
#include "io/text/source_text.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::io {

/// What a run folder's files are like, in its summary.json. 5: peaks in contacts.csv; 4: ice under hulls; 3:
/// crushed.csv and ground overlaps; 2: floes.ndjson has parts of parents' shapes; folders without a number are 1.
inline constexpr int kRunFolderVersion = 6;

/// The files of a run (docs/run-folder.md).
namespace run_file {
inline constexpr std::string_view kLock = ".polynya";  ///< RunLock
inline constexpr std::string_view kScene = "scene.json";
inline constexpr std::string_view kSummary = "summary.json";
inline constexpr std::string_view kForces = "forces.csv";
inline constexpr std::string_view kEvents = "events.ndjson";
inline constexpr std::string_view kFloes = "floes.ndjson";
inline constexpr std::string_view kFrames = "frames.bin";
inline constexpr std::string_view kStates = "states.csv";
inline constexpr std::string_view kContacts = "contacts.csv";
inline constexpr std::string_view kCrushed = "crushed.csv";
inline constexpr std::string_view kPanels = "panels.csv";  ///< of scenes that have panels
inline constexpr std::string_view kFinalGeojson = "final.geojson";
inline constexpr std::string_view kFinalSvg = "final.svg";
inline constexpr std::string_view kFinalPng = "final.png";
inline constexpr std::string_view kView = "view.html";           ///< `polynya view` writes it, not the run
inline constexpr std::string_view kChannel = "channel.geojson";  ///< `polynya channel` writes these two
inline constexpr std::string_view kChannelCsv = "channel.csv";
// `polynya figures` writes these, and a PNG and a PDF beside each.
inline constexpr std::string_view kFigureFloes = "figure-floes.svg";
inline constexpr std::string_view kFigureLoads = "figure-loads.svg";
inline constexpr std::string_view kFigureMotion = "figure-motion.svg";
inline constexpr std::string_view kFigureSizes = "figure-sizes.svg";
inline constexpr std::string_view kFigureEnergy = "figure-energy.svg";
inline constexpr std::array kFigures{kFigureFloes, kFigureLoads, kFigureMotion, kFigureSizes, kFigureEnergy};
inline constexpr std::string_view kLoads = "loads";  // a folder, of `polynya loads`
inline constexpr std::string_view kFailure = "failure.bin";
inline constexpr std::string_view kChecksums = "checksums.txt";     ///< of a finished run
inline constexpr std::string_view kRejectedCuts = "rejected-cuts";  // a folder
/// The files that grow, in the order they are flushed: what is named before what names it. A run without panels has
/// all but the last.
inline constexpr std::array kGrowing{kFloes, kEvents, kFrames, kContacts, kCrushed, kStates, kForces, kPanels};
// `polynya management` writes these.
inline constexpr std::string_view kManagement = "management.csv";
inline constexpr std::string_view kManagementSizes = "management-sizes.csv";
inline constexpr std::string_view kManagementPng = "management.png";
inline constexpr std::array kMadeAtEnd{kFinalGeojson, kFinalSvg,   kFinalPng,        kView,         kChannel,
                                       kChannelCsv,   kManagement, kManagementSizes, kManagementPng};
}  // namespace run_file

/// The files that grow in a run of the scene.
std::span<const std::string_view> growing_files(const simulation::Scene& scene);

/// What reads runs takes no longer file; a run that writes one warns [bytes].
inline constexpr std::uint64_t kLongestRunFile = std::uint64_t{4} << 30;

/// A run of more floes at the start writes no final.geojson unless it is asked for: the other files have what
/// `polynya export --geojson` makes it of.
inline constexpr std::size_t kMostFloesInFinal = 100'000;

/// About how long the files with all floes become, of the floes at the start [bytes].
struct FolderSize {
  double floes = 0;          ///< floes.ndjson
  double final_geojson = 0;  ///< where it is written
};
FolderSize estimate_folder_size(const simulation::Scene& scene);

/// Keeps other processes from writing a run folder as long as it lives: a lock on the folder's file
/// `.polynya`, which ends with the process, however that ends. The file stays: it marks the folder as a
/// run's, and a file that is never replaced can be locked by one process only.
class RunLock {
 public:
  /// Makes the file where there is none. The error names what is in the way.
  static Result<RunLock> take(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }

  /// Whether the folder is still there under its name: it was neither removed, moved nor replaced.
  bool is_in_place() const { return is_still_at(descriptor_, folder_ / run_file::kLock); }

 private:
  RunLock(Descriptor descriptor, std::filesystem::path folder)
      : descriptor_(std::move(descriptor)), folder_(std::move(folder)) {}
  Descriptor descriptor_;
  std::filesystem::path folder_;
};

/// Takes a folder for a new run, making it where there is none, and locks it: of several processes that take
/// one folder, one gets it. A folder with anything in it is refused, but for what a run leaves that was
/// killed before it had its scene. With `overwrite`, a run folder (finished or not, or in part removed) loses
/// the files that polynya writes there, and nothing else; any other folder is refused even then, and nothing
/// is written into it. The error names the folder, what is in it and what to do.
Result<RunLock> claim_run_folder(const std::filesystem::path& folder, bool overwrite);

/// Makes a folder that of a run to the end of the scene, which is that of its scene.json but for `time.until_s`,
/// where the run has ended or was to end at another time: its summary is that of an unfinished one, what was made at
/// and after its end is removed, and scene.json names the new end. A kill in between leaves a run that is resumed.
Result<> set_end(const std::filesystem::path& folder, const LoadedScene& scene);

/// Whether polynya marked the folder as a run's.
bool is_marked_run_folder(const std::filesystem::path& folder);

}  // namespace polynya::io
