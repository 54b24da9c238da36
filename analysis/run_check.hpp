#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/final_places.hpp"
#include "io/run/checksums.hpp"
#include "io/run/run_reader.hpp"

namespace polynya::analysis {

struct InvalidFloe {
  simulation::FloeId floe = 0;
  std::string defect;
  std::vector<geometry::Point> places_in_body;  ///< [m]
};

/// Something that should be zero, where it is farthest from it.
struct Worst {
  double value = 0;  ///< [m²]
  simulation::FloeId floe = simulation::kNoFloe;
  std::size_t wrong = 0;  ///< how many are beyond kAreaTolerance of the floe's area
};
/// Relative. Areas of rings are exact; recorded ones are sums of doubles, this is far beyond their error.
inline constexpr double kAreaTolerance = 1e-9;

/// Ice that two floes share.
struct SharedIce {
  simulation::FloeId first = simulation::kNoFloe;
  simulation::FloeId second = simulation::kNoFloe;
  double time = 0;   ///< [s]
  double area = 0;   ///< exact, to the nearest double [m²]
  double depth = 0;  ///< of the deepest vertex of either in the other [m]
};

/// A pair of bodies may share more ice than was crushed there by this share of the smaller one, and by what
/// a step and the frames' accuracy make of it.
inline constexpr double kUncrushedShare = 0.01;
inline constexpr std::size_t kMostUncrushed = 20;  ///< of these are named

/// Two bodies that are farther in each other than what was crushed there or presses in a contact.
struct UncrushedOverlap {
  simulation::ContactState::Body first, second;
  double time = 0;                 ///< [s]
  double shared = 0;               ///< exact, to the nearest double [m²]
  double crushed = 0;              ///< on record, with what tilted [m²]
  double in_contact = 0;           ///< on record as not paid: it presses the two apart [m²]
  double allowed = 0;              ///< beyond it [m²]
  geometry::Point place_in_world;  ///< about where [m]
};

/// Crushed ice and the work that crushed it may differ by this factor, where more is crushed than the share above.
inline constexpr double kMostWorkFactor = 1.5;

/// Two bodies whose crushed ice is not what the work on record crushes.
struct UnpaidOverlap {
  simulation::ContactState::Body first, second;
  double time = 0;      ///< at which it is most [s]
  double area = 0;      ///< crushed [m²]
  double expected = 0;  ///< σ_c times the volume on record [J]
  double work = 0;      ///< on record [J]
};

/// What re-deriving a run's geometry found.
struct RunCheck {
  io::FilesCheck files;  ///< their checksums
  std::size_t shapes = 0;
  std::vector<InvalidFloe> invalid;
  Worst recorded_area;  ///< recorded − that of the ring
  std::size_t fractures = 0;
  Worst balance;                         ///< children + submerged + brash − rounding defect − parent
  std::size_t overlapping_siblings = 0;  ///< pieces of one fracture sharing more than kAreaTolerance of their parent
  SharedIce siblings;                    ///< the most that pieces of one fracture share in their body frame

  std::size_t instants = 0;           ///< at which overlaps were measured
  std::size_t pairs = 0;              ///< whose boxes met, over all instants
  /// Pairs that shared more than kTouchingArea (geometry/cut/overlap.hpp) at some instant.
  std::size_t overlapping_pairs = 0;
  double most_shared = 0;             ///< Σ over all pairs at the instant it is most [m²]
  double most_shared_time = 0;        ///< [s]
  double ice_then = 0;                ///< area of all floes at that instant [m²]
  SharedIce deepest;                  ///< the deepest pair of those that share more than kTouchingArea
  SharedIce worst;                    ///< the pair that shares most
  std::size_t hull_pairs = 0;         ///< of a ship or structure and a floe, whose boxes met, over all instants
  SharedIce worst_with_hull;          ///< the floe (second) that shares most with one
  int worst_hull = -1;                ///< that one
  bool has_crushed = false;           ///< the run states what was crushed: overlaps were compared with it
  std::size_t uncrushed_pairs = 0;    ///< over all instants
  std::vector<UncrushedOverlap> uncrushed;  ///< the first of these
  UncrushedOverlap most_in_contact;         ///< the most overlap that a contact presses and that is not paid
  std::size_t paid_pairs = 0;               ///< whose crushed ice was compared with the work that it took
  std::vector<UnpaidOverlap> unpaid;        ///< those of them that differ
  double most_expected = 0;                 ///< Σ σ_c V over all pairs at the instant it is most [J]
  double work_then = 0;                     ///< Σ of the work on record at that instant [J]
  std::size_t undecided = 0;                ///< pairs whose overlap geometry failed to find
  FinalPlaces final_places;

  bool is_sound() const {
    return files.damaged.empty() && invalid.empty() && recorded_area.wrong == 0 && balance.wrong == 0 &&
           overlapping_siblings == 0 && uncrushed_pairs == 0 && unpaid.empty() && undecided == 0 &&
           final_places.is_sound();
  }
};

/// Compares the files with their checksums, and finds validity, areas, balances and shared areas exactly, for the
/// doubles on record; areas are rounded once for the report. Measures overlaps at every frame, or at one instant only.
/// Frames are right to 1 mm (frames.hpp). What bodies share at a frame is compared with what was crushed or tilted
/// there (crushed.csv), and what was crushed with the work that it took, hulls and structures included; runs of
/// versions that did not record it are measured only. The floes of final.geojson are compared with their places in
/// frames.bin, also with `only_at`. `on_part` is called often, with how much is done (0..1).
RunCheck check_run(const io::Run& run, std::optional<double> only_at = {},
                   const std::function<void(double)>& on_part = {});

/// What it found as `polynya inspect --check` prints it: for people, and as JSON (docs/inspect.md).
std::string to_text(const RunCheck& check, const simulation::Scene& scene);
std::string to_json_text(const RunCheck& check, const simulation::Scene& scene);

}  // namespace polynya::analysis
