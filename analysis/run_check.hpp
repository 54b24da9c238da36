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
  simulation::FloeId floe = 0;
  std::string defect;
  std::vector<geometry::Point> places_in_body;  ///< [m]
};

/// A balance that should be zero, at the floe for which it deviates most.
struct Worst {
  double value = 0;  ///< [m²]
  simulation::FloeId floe = simulation::kNoFloe;
  std::size_t wrong = 0;  ///< number of floes with a deviation of more than kAreaTolerance times their area
};
/// Relative tolerance of areas [-]. Areas of rings are computed exactly; recorded areas are sums of doubles, whose
/// error is much smaller than this.
inline constexpr double kAreaTolerance = 1e-9;

/// Area that two floes share.
struct SharedIce {
  simulation::FloeId first = simulation::kNoFloe;
  simulation::FloeId second = simulation::kNoFloe;
  double time = 0;   ///< [s]
  double area = 0;   ///< exact area, rounded to the nearest double [m²]
  double depth = 0;  ///< depth of the deepest vertex of one floe in the other [m]
};

/// Overlap of two bodies in excess of the crushed ice that is accepted, as a fraction of the smaller body's area [-].
/// The effect of a time step and of the accuracy of frames is accepted in addition. A smaller value reports more
/// overlaps.
inline constexpr double kUncrushedShare = 0.01;
inline constexpr std::size_t kMostUncrushed = 20;  ///< number of such overlaps that are listed

/// Two bodies that overlap more than ice was crushed there, or than a contact presses.
struct UncrushedOverlap {
  simulation::ContactState::Body first, second;
  double time = 0;                 ///< [s]
  double shared = 0;               ///< exact overlap, rounded to the nearest double [m²]
  double crushed = 0;              ///< recorded crushed area, with the area that tilted down [m²]
  double in_contact = 0;           ///< recorded overlap that is not paid, and presses the two bodies apart [m²]
  double allowed = 0;              ///< accepted excess [m²]
  geometry::Point place_in_world;  ///< approximate position [m]
};

/// Largest accepted ratio between crushed ice and the work that crushed it, in either direction [-]. It applies to
/// pairs that crushed more than kUncrushedShare.
inline constexpr double kMostWorkFactor = 1.5;

/// Two bodies whose crushed ice does not match the recorded work.
struct UnpaidOverlap {
  simulation::ContactState::Body first, second;
  double time = 0;      ///< time at which the most is crushed [s]
  double area = 0;      ///< crushed area [m²]
  double expected = 0;  ///< σ_c times the recorded volume [J]
  double work = 0;      ///< recorded work [J]
};

/// Results of checking a run.
struct RunCheck {
  io::FilesCheck files;  ///< comparison of the files with their checksums
  std::size_t shapes = 0;
  std::vector<InvalidFloe> invalid;
  Worst recorded_area;  ///< recorded area − area of the ring
  std::size_t fractures = 0;
  Worst balance;  ///< children + submerged + brash − rounding defect − parent
  /// Pairs of pieces of one fracture that share more than kAreaTolerance of their parent's area.
  std::size_t overlapping_siblings = 0;
  SharedIce siblings;  ///< the largest overlap of pieces of one fracture in their body frame

  std::size_t instants = 0;  ///< number of instants at which overlaps were measured
  std::size_t pairs = 0;     ///< number of pairs whose boxes overlapped, over all instants
  /// Pairs that shared more than kTouchingArea (geometry/cut/overlap.hpp) at some instant.
  std::size_t overlapping_pairs = 0;
  double most_shared = 0;       ///< largest sum of the overlaps of all pairs at one instant [m²]
  double most_shared_time = 0;  ///< that instant [s]
  double ice_then = 0;          ///< area of all floes at that instant [m²]
  SharedIce deepest;            ///< the pair with the largest depth among those that share more than kTouchingArea
  SharedIce worst;              ///< the pair with the largest overlap
  /// Number of pairs of a ship or structure and a floe whose boxes overlapped, over all instants.
  std::size_t hull_pairs = 0;
  SharedIce worst_with_hull;                ///< the floe (second) with the largest overlap with a hull
  int worst_hull = -1;                      ///< index of that hull
  bool has_crushed = false;                 ///< the run recorded crushed ice, and overlaps were compared with it
  std::size_t uncrushed_pairs = 0;          ///< number of overlaps without crushed ice, over all instants
  std::vector<UncrushedOverlap> uncrushed;  ///< the first of these
  UncrushedOverlap most_in_contact;         ///< the largest overlap that a contact presses and that is not paid
  std::size_t paid_pairs = 0;               ///< number of pairs whose crushed ice was compared with the work
  std::vector<UnpaidOverlap> unpaid;        ///< pairs in which the two differ
  double most_expected = 0;                 ///< largest Σ σ_c V over all pairs at one instant [J]
  double work_then = 0;                     ///< Σ of the recorded work at that instant [J]
  std::size_t undecided = 0;                ///< number of pairs whose overlap geometry failed to compute
  FinalPlaces final_places;

  bool is_sound() const {
    return files.damaged.empty() && invalid.empty() && recorded_area.wrong == 0 && balance.wrong == 0 &&
           overlapping_siblings == 0 && uncrushed_pairs == 0 && unpaid.empty() && undecided == 0 &&
           final_places.is_sound();
  }
};

/// Compares the files of a run with their checksums, and checks polygons, areas, balances and overlaps. All are exact
/// for the recorded doubles; areas are rounded once for the report. Overlaps are measured at every frame, or only at
/// the instant `only_at` [s]. Positions in frames are right to 1 mm (frames.hpp). The overlap of two bodies, hulls and
/// structures included, is compared with the crushed or tilted area (crushed.csv), and the crushed ice with the work.
/// In runs of versions that did not record these, overlaps are only measured. The floes of final.geojson are compared
/// with their places in frames.bin, also with `only_at`. `on_part` is called often with the completed fraction (0..1).
RunCheck check_run(const io::Run& run, std::optional<double> only_at = {},
                   const std::function<void(double)>& on_part = {});

/// Return the results as `polynya inspect --check` prints them, for people and as JSON (docs/inspect.md).
std::string to_text(const RunCheck& check, const simulation::Scene& scene);
std::string to_json_text(const RunCheck& check, const simulation::Scene& scene);

}  // namespace polynya::analysis
