#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include <tl/expected.hpp>

namespace polynya::io {

/// The files of a run (docs/run-folder.md).
namespace run_file {
inline constexpr std::string_view kScene = "scene.json";
inline constexpr std::string_view kSummary = "summary.json";
inline constexpr std::string_view kForces = "forces.csv";
inline constexpr std::string_view kEvents = "events.ndjson";
inline constexpr std::string_view kFloes = "floes.ndjson";
inline constexpr std::string_view kFrames = "frames.bin";
inline constexpr std::string_view kStates = "states.csv";
inline constexpr std::string_view kContacts = "contacts.csv";
inline constexpr std::string_view kFinalGeojson = "final.geojson";
inline constexpr std::string_view kFinalSvg = "final.svg";
inline constexpr std::string_view kFinalPng = "final.png";
inline constexpr std::string_view kView = "view.html";           ///< `polynya view` writes it, not the run
inline constexpr std::string_view kChannel = "channel.geojson";  ///< `polynya channel` writes these two
inline constexpr std::string_view kChannelCsv = "channel.csv";
// `polynya figures` writes these, and a PNG beside each where there is a converter.
inline constexpr std::string_view kFigureFloes = "figure-floes.svg";
inline constexpr std::string_view kFigureLoads = "figure-loads.svg";
inline constexpr std::string_view kFigureMotion = "figure-motion.svg";
inline constexpr std::string_view kFigureSizes = "figure-sizes.svg";
inline constexpr std::string_view kFigureEnergy = "figure-energy.svg";
inline constexpr std::array kFigures{kFigureFloes, kFigureLoads, kFigureMotion, kFigureSizes, kFigureEnergy};
inline constexpr std::string_view kFailure = "failure.bin";
inline constexpr std::string_view kRejectedCuts = "rejected-cuts";  // a folder
inline constexpr std::array kAll{kScene,    kSummary, kForces,   kEvents,       kFloes,
                                 kFrames,   kStates,  kContacts, kFinalGeojson, kFinalSvg,
                                 kFinalPng, kView,    kChannel,  kChannelCsv};
}  // namespace run_file

/// Keeps others from writing a run's folder as long as it lives (an advisory lock on its scene.json).
class RunLock {
 public:
  /// The error says who or what is in the way.
  static tl::expected<RunLock, std::string> take(const std::filesystem::path& folder);
  RunLock(RunLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  RunLock& operator=(RunLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~RunLock();

 private:
  explicit RunLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

/// Makes an empty run folder. A folder with anything in it is refused; if told to overwrite, a run's folder
/// (one with scene.json and summary.json) loses the files a run writes, what other commands made of it in the
/// folder, and nothing else. Returns what went wrong; empty where all is well.
std::string prepare_run_folder(const std::filesystem::path& folder, bool overwrite);

}  // namespace polynya::io
