#pragma once

#include <optional>
#include <string>
#include <vector>

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

/// What re-deriving a run's geometry found.
struct RunCheck {
  std::size_t shapes = 0;
  std::vector<InvalidFloe> invalid;
  Worst recorded_area;  ///< recorded − that of the ring
  std::size_t fractures = 0;
  Worst balance;  ///< children + submerged + brash − rounding defect − parent
  std::size_t overlapping_siblings =
      0;               ///< pieces of one fracture sharing more than kAreaTolerance of their parent
  SharedIce siblings;  ///< the most that pieces of one fracture share in their body frame

  std::size_t instants = 0;  ///< at which overlaps were measured
  std::size_t pairs = 0;     ///< whose boxes met, over all instants
  std::size_t overlapping_pairs =
      0;                   ///< that shared more than kTouchingArea (overlapping_pairs.hpp) at some instant
  double most_shared = 0;  ///< Σ over all pairs at the instant it is most [m²]
  double most_shared_time = 0;  ///< [s]
  double ice_then = 0;          ///< area of all floes at that instant [m²]
  SharedIce deepest;            ///< the deepest pair of those that share more than kTouchingArea
  SharedIce worst;              ///< the pair that shares most
  std::size_t undecided = 0;    ///< pairs whose overlap geometry failed to find

  bool is_sound() const {
    return invalid.empty() && recorded_area.wrong == 0 && balance.wrong == 0 && overlapping_siblings == 0 &&
           undecided == 0;
  }
};

/// Finds validity, areas, balances and shared areas exactly, for the doubles on record; areas are rounded
/// once for the report. Measures overlaps at every frame, or at one instant only. Frames are right to 1 mm
/// (frames.hpp), and the contact model lets floes overlap by the depth they crush: the check does not
/// separate the two.
RunCheck check_run(const io::Run& run, std::optional<double> only_at = {});

}  // namespace polynya::analysis
