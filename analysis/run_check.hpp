#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/final_places.hpp"
#include "io/run/checksums.hpp"
#include "io/run/run_reader.hpp"

namespace polynya::analysis {

/// A floe whose polygon is not valid.
struct InvalidFloe {
  simulation::FloeId floe = 0;                  ///< id of the floe
  std::string defect;                           ///< name of the first defect that was found
  std::vector<geometry::Point> places_in_body;  ///< places of that defect in the floe's body frame [m]
};

/// A balance of areas that should be zero for every floe, at the floe for which it deviates most.
struct Worst {
  double value = 0;                               ///< largest deviation, with its sign [m²]
  simulation::FloeId floe = simulation::kNoFloe;  ///< floe with that deviation; kNoFloe if all balances are zero
  std::size_t wrong = 0;  ///< number of floes with a deviation of more than kAreaTolerance times their area
};
/// Relative tolerance of areas [-]. Areas of rings are computed exactly; recorded areas are sums of doubles, whose
/// error is much smaller than this. A run in which an area deviates by more is not sound. A much smaller value would
/// report rounding; a larger one would miss ice that is lost or counted twice.
inline constexpr double kAreaTolerance = 1e-9;

/// Area that two floes, or a hull and a floe, share.
struct SharedIce {
  simulation::FloeId first = simulation::kNoFloe;   ///< kNoFloe for a hull, and if no two bodies share any area
  simulation::FloeId second = simulation::kNoFloe;  ///< the other floe
  double time = 0;  ///< instant of the overlap, or time of the fracture for pieces of one fracture [s]
  double area = 0;  ///< exact area, rounded to the nearest double [m²]
  /// Largest distance of an outer vertex of one inside the other from the other's edge [m]; 0 if no vertex is inside,
  /// if they share at most kTouchingArea, or for pieces of one fracture.
  double depth = 0;
};

/// Overlap of two bodies beyond crushed ice and ice in contact that is accepted, as a fraction of the smaller body's
/// area [-]. The effect of a time step and of the accuracy of frames is accepted in addition. A smaller value reports
/// more overlaps, and a run with any is not sound; a larger one may miss bodies that pass through each other.
inline constexpr double kUncrushedShare = 0.01;
/// Largest number of such overlaps that are stored and listed; the others are only counted. The text also lists at most
/// this number of UnpaidOverlap. Larger: longer reports and more memory; smaller: fewer bodies are named. It has no
/// effect on whether a run is sound.
inline constexpr std::size_t kMostUncrushed = 20;

/// Two bodies whose overlap is larger than the recorded crushed, tilted and pressing overlaps between them together.
struct UncrushedOverlap {
  simulation::ContactState::Body first, second;  ///< in RunCheck::uncrushed `second` is always a floe
  double time = 0;                               ///< time of the frame [s]
  double shared = 0;                             ///< exact overlap, rounded to the nearest double [m²]
  double crushed = 0;                            ///< recorded crushed area, with the area that tilted down [m²]
  double in_contact = 0;  ///< recorded overlap whose crushing has not been done yet; it presses the bodies apart [m²]
  /// Accepted overlap beyond these: kUncrushedShare of the smaller body, and an allowance for one time step of relative
  /// motion and for the accuracy of frames [m²].
  double allowed = 0;
  geometry::Point place_in_world{};  ///< middle of the common part of the two bounding boxes [m]
};

/// Largest accepted ratio between the work that the crushed volume needs (σ_c V) and the recorded work, in either
/// direction [-]. It applies only to pairs that crushed more than kUncrushedShare of the smaller body; smaller volumes
/// are too inaccurate to compare. A smaller value reports more pairs, and a run with any is not sound; a larger one
/// accepts forces that are further from the strength of the ice.
inline constexpr double kMostWorkFactor = 1.5;

/// Two bodies whose crushed ice does not match the recorded work.
struct UnpaidOverlap {
  simulation::ContactState::Body first, second;  ///< `second` is always a floe
  double time = 0;      ///< of the frames at which the two differ, the one with the largest `expected` [s]
  double area = 0;      ///< crushed area [m²]
  double expected = 0;  ///< compressive strength σ_c times the recorded crushed volume [J]
  double work = 0;      ///< recorded work of crushing [J]
};

/// Results of checking a run.
struct RunCheck {
  io::FilesCheck files;              ///< comparison of the files with their checksums
  std::size_t shapes = 0;            ///< number of floes whose polygons were checked
  std::vector<InvalidFloe> invalid;  ///< all floes with invalid polygons, in the order of the run
  Worst recorded_area;               ///< recorded area − area of the polygon
  std::size_t fractures = 0;         ///< number of events that ended a floe
  /// Areas of such an event: children + submerged + stayed under the ice + brash − rounding defect − parent. The floe
  /// is the parent.
  Worst balance;
  /// Pairs of pieces of one fracture that share more than kAreaTolerance of their parent's area.
  std::size_t overlapping_siblings = 0;
  SharedIce siblings;  ///< the largest overlap of pieces of one fracture in their body frame

  std::size_t instants = 0;  ///< number of instants at which overlaps were measured
  std::size_t pairs = 0;     ///< number of pairs of floes whose bounding boxes overlapped, over all instants
  /// Number of pairs of floes that shared more than kTouchingArea (geometry/cut/overlap.hpp) at some instant.
  std::size_t overlapping_pairs = 0;
  double most_shared = 0;       ///< largest sum of the overlaps of all pairs of floes at one instant [m²]
  double most_shared_time = 0;  ///< that instant [s]
  double ice_then = 0;          ///< area of all floes at that instant [m²]
  SharedIce deepest;            ///< the pair with the largest depth among those that share more than kTouchingArea
  SharedIce worst;              ///< the pair of floes with the largest overlap
  /// Number of pairs of a ship or structure and a floe whose boxes overlapped, over all instants.
  std::size_t hull_pairs = 0;
  SharedIce worst_with_hull;                ///< the floe (second) with the largest overlap with a hull
  int worst_hull = -1;                      ///< index of that hull (hull_of()); -1 if no hull overlaps a floe
  bool has_crushed = false;                 ///< the run recorded crushed ice, so overlaps can be compared with it
  std::size_t uncrushed_pairs = 0;          ///< number of overlaps beyond the accepted ones, over all instants
  std::vector<UncrushedOverlap> uncrushed;  ///< the first kMostUncrushed of these
  /// The pair with the largest in_contact. Only its bodies, time, crushed and in_contact are set.
  UncrushedOverlap most_in_contact;
  std::size_t paid_pairs = 0;         ///< number of pairs whose crushed ice was compared with the work
  std::vector<UnpaidOverlap> unpaid;  ///< pairs in which the two differ by more than kMostWorkFactor
  double most_expected = 0;           ///< largest Σ σ_c V over all pairs at one instant [J]
  double work_then = 0;               ///< Σ of the recorded work at that instant [J]
  std::size_t undecided = 0;          ///< number of pairs whose overlap geometry failed to compute
  FinalPlaces final_places;           ///< comparison of final.geojson with frames.bin

  /// Returns true if nothing is wrong; otherwise `polynya inspect --check` exits with kRefused. Accepted overlaps,
  /// missing checksums and a missing crushed.csv do not make a run unsound.
  bool is_sound() const {
    return files.damaged.empty() && invalid.empty() && recorded_area.wrong == 0 && balance.wrong == 0 &&
           overlapping_siblings == 0 && uncrushed_pairs == 0 && unpaid.empty() && undecided == 0 &&
           final_places.is_sound();
  }
};

/// Compares the files of a run with their checksums, and checks polygons, areas, balances and overlaps. All are exact
/// for the recorded doubles; areas are rounded once for the report. Overlaps are measured at every frame, or only at
/// the instant `only_at` [s]. Positions in frames are right to 1 mm (frames.hpp). The overlap of two bodies, of which
/// at most one is a hull, is compared with the crushed or tilted area (crushed.csv), and the crushed ice with the work.
/// In runs of versions that did not record these, and at an `only_at` that is not the time of a frame, overlaps are
/// only measured. The floes of final.geojson are compared with their places in frames.bin, also with `only_at`.
/// `on_part` is called often with the completed fraction (0..1). Faults of the run are in the result; nothing is thrown
/// for them.
RunCheck check_run(const io::Run& run, std::optional<double> only_at = {},
                   const std::function<void(double)>& on_part = {});

/// Return the results as `polynya inspect --check` prints them, for people and as JSON (docs/inspect.md). `scene` is
/// the scene of the run; it gives the names of hulls.
std::string to_text(const RunCheck& check, const simulation::Scene& scene);
std::string to_json_text(const RunCheck& check, const simulation::Scene& scene);

}  // namespace polynya::analysis
