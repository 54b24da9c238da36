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

/// Version of the format of a run folder, in its summary.json. Readers accept folders up to their own version and
/// refuse later ones, so a larger number makes folders that earlier programs cannot read. Raise it if such a program
/// would misread the files. Each version added: 2 references to vertices of parents in floes.ndjson, 3 crushed.csv and
/// ground overlaps, 4 ice under hulls, 5 peaks in contacts.csv, 6 unpaid_m2 in crushed.csv. Folders without a number
/// are version 1.
inline constexpr int kRunFolderVersion = 6;

/// Names of the files and folders in a run folder (docs/run-folder.md). Readers of all versions find them by these
/// names.
namespace run_file {
inline constexpr std::string_view kLock = ".polynya";  ///< locked by RunLock
inline constexpr std::string_view kScene = "scene.json";
inline constexpr std::string_view kSummary = "summary.json";
inline constexpr std::string_view kForces = "forces.csv";
inline constexpr std::string_view kEvents = "events.ndjson";
inline constexpr std::string_view kFloes = "floes.ndjson";
inline constexpr std::string_view kFrames = "frames.bin";
inline constexpr std::string_view kStates = "states.csv";
inline constexpr std::string_view kContacts = "contacts.csv";
inline constexpr std::string_view kCrushed = "crushed.csv";
inline constexpr std::string_view kPanels = "panels.csv";  ///< only in scenes with panels
inline constexpr std::string_view kFinalGeojson = "final.geojson";
inline constexpr std::string_view kFinalSvg = "final.svg";
inline constexpr std::string_view kFinalPng = "final.png";
inline constexpr std::string_view kView = "view.html";           ///< written by `polynya view`, not by the run
inline constexpr std::string_view kChannel = "channel.geojson";  ///< this and the next are written by `polynya channel`
inline constexpr std::string_view kChannelCsv = "channel.csv";
// Written by `polynya figures`, which unless --format says otherwise also writes a PNG and a PDF of each.
inline constexpr std::string_view kFigureFloes = "figure-floes.svg";
inline constexpr std::string_view kFigureLoads = "figure-loads.svg";
inline constexpr std::string_view kFigureMotion = "figure-motion.svg";
inline constexpr std::string_view kFigureSizes = "figure-sizes.svg";
inline constexpr std::string_view kFigureEnergy = "figure-energy.svg";
inline constexpr std::array kFigures{kFigureFloes, kFigureLoads, kFigureMotion, kFigureSizes, kFigureEnergy};
inline constexpr std::string_view kLoads = "loads";  ///< a folder, written by `polynya loads`
/// State before the tick that failed, or that broke the balance of ice, energy or momentum.
inline constexpr std::string_view kFailure = "failure.bin";
inline constexpr std::string_view kChecksums = "checksums.txt";     ///< only in a finished run
inline constexpr std::string_view kRejectedCuts = "rejected-cuts";  ///< a folder, written by write_rejected_cut()
/// The files to which a run appends while it runs. They are written to disk in this order, so that a floe is on the
/// disk before any record that names it. Runs without panels do not have the last one.
inline constexpr std::array kGrowing{kFloes, kEvents, kFrames, kContacts, kCrushed, kStates, kForces, kPanels};
// Written by `polynya management`.
inline constexpr std::string_view kManagement = "management.csv";
inline constexpr std::string_view kManagementSizes = "management-sizes.csv";
inline constexpr std::string_view kManagementPng = "management.png";
/// Files made from the end of a run, by the run or by later commands. They are removed if the run gets another end, and
/// so are the figures, failure.bin and the files of `polynya loads`. A file that is missing here would stay and show
/// the old end.
inline constexpr std::array kMadeAtEnd{kFinalGeojson, kFinalSvg,   kFinalPng,        kView,         kChannel,
                                       kChannelCsv,   kManagement, kManagementSizes, kManagementPng};
}  // namespace run_file

/// Returns the files that grow in a run of the scene: kGrowing, without panels.csv if no hull of the scene has panels.
std::span<const std::string_view> growing_files(const simulation::Scene& scene);

/// Longest file that the reader of runs accepts [bytes]: 4 GiB. It limits the memory that a wrong file can take,
/// because each file is read as a whole. A run that writes a longer file is not stopped, but ends with a warning, and
/// inspect, view and the other readers then refuse the run.
inline constexpr std::uint64_t kLongestRunFile = std::uint64_t{4} << 30;

/// Number of floes at the start above which a run writes no final.geojson unless it is asked to (--final-geojson),
/// because the file is long (some 50 MB or more), and `polynya export --geojson` can make it from the other files.
inline constexpr std::size_t kMostFloesInFinal = 100'000;

/// Estimated sizes of the files that contain all floes, from the floes at the start [bytes]. Floes that are born later
/// are not included. They are for messages only; no run is refused because of them.
struct FolderSize {
  double floes = 0;          ///< floes.ndjson at the start
  double final_geojson = 0;  ///< final.geojson, also if the run will not write it
};
FolderSize estimate_folder_size(const simulation::Scene& scene);

/// Prevents other processes of Polynya from writing to a run folder while this object exists. It locks the file
/// `.polynya` of the folder. The lock ends with the process, however that ends, but the file stays: it marks the folder
/// as that of a run, and a file that is never replaced can be locked by only one process. On file systems without locks
/// nothing is prevented.
class RunLock {
 public:
  /// Takes the lock, and creates the file if there is none. Does not wait: it fails if another process has the lock, or
  /// if the file is a link, is not a regular file, cannot be opened or is removed meanwhile. The folder must exist.
  static Result<RunLock> take(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }  ///< as given to take()

  /// Returns true if the folder still has its name, so that it was neither removed, moved nor replaced. Otherwise files
  /// would be written to a place where nobody looks for them, so the run must stop.
  bool is_in_place() const { return is_still_at(descriptor_, folder_ / run_file::kLock); }

 private:
  RunLock(Descriptor descriptor, std::filesystem::path folder)
      : descriptor_(std::move(descriptor)), folder_(std::move(folder)) {}
  Descriptor descriptor_;
  std::filesystem::path folder_;
};

/// Takes a folder for a new run and locks it. The folder and missing folders above it are created. If several processes
/// want one folder, one gets it. A folder that is not empty is refused, unless it has only the remains of a run that
/// was killed before it had its scene. With `overwrite`, a folder with a run, finished, unfinished or partly removed,
/// is accepted too. The files that Polynya writes are then removed from it, except `.polynya`, and nothing else is. Any
/// other folder is refused even then and stays unchanged. It also fails if the folder cannot be made or read, if
/// another process has its lock, or if a file cannot be removed. The error names the folder, its contents and what to
/// do.
Result<RunLock> claim_run_folder(const std::filesystem::path& folder, bool overwrite);

/// Changes the end of a run to the end of `scene`, which equals the scene of scene.json except for `time.until_s`. The
/// caller holds the lock of the folder. The checksums are removed, the summary becomes that of an unfinished run, files
/// made at and after the old end are removed, and at last scene.json gets the new end. If the program is killed in
/// between, the folder is that of a run that can be resumed. Of an unfinished run that already has this end, only the
/// checksums are removed. Checkpoints and the growing files stay. Fails if a file cannot be written or removed.
Result<> set_end(const std::filesystem::path& folder, const LoadedScene& scene);

/// Returns true if Polynya has marked the folder as that of a run, by the file `.polynya`. The folder need not have a
/// run yet. Folders of versions that made no such file are not marked.
bool is_marked_run_folder(const std::filesystem::path& folder);

}  // namespace polynya::io
