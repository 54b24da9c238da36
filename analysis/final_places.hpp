#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/run/run_reader.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::analysis {

/// A floe that is not in the same place in final.geojson and in frames.bin.
struct MisplacedFloe {
  simulation::FloeId floe = simulation::kNoFloe;
  /// Reason why its vertices cannot be compared, such as that one of the files lacks the floe; empty if they can. With
  /// a reason, `distance` and `allowed` mean nothing, and the output does not have them.
  std::string defect;
  double distance = 0;  ///< distance between the two places of the vertex that most exceeds its allowed distance [m]
  double allowed = 0;   ///< largest distance that the accuracy of frames allows that vertex [m]
};

/// Comparison of the floes in final.geojson with their places in frames.bin at the same instant.
struct FinalPlaces {
  std::string not_compared;    ///< reason why there is nothing to compare; empty if there is something
  std::string fault;           ///< reason why final.geojson cannot be read, with file and line; empty if it can
  std::optional<double> time;  ///< instant of final.geojson [s]; nullopt if the floes were not compared, for any reason
  std::size_t compared = 0;    ///< number of floes that final.geojson and the frames both have
  double farthest = 0;         ///< greatest distance between the two places of a vertex, allowed or not [m]
  simulation::FloeId farthest_floe = simulation::kNoFloe;  ///< floe of that vertex; kNoFloe if `farthest` is 0
  std::vector<MisplacedFloe> misplaced;  ///< also floes that only one of the files has, or final.geojson has twice

  /// Returns false if the file cannot be read or any floe is misplaced. `polynya inspect --check` then calls the run
  /// not sound and fails. A run without a comparison is sound.
  bool is_sound() const { return fault.empty() && misplaced.empty(); }
};

/// Compares every vertex of final.geojson with the floe's polygon on record, placed by its motion in frames.bin.
/// final.geojson must have exactly the floes that float at its instant. The two places of a vertex may differ by the
/// error that a frame may have: 1 mm along each axis, and 1e-5 rad times the distance of the vertex from the floe's
/// centre of mass. Further allowances are for rounding only. A run without final.geojson, or without a frame at its
/// instant, is not compared and is sound. A file that cannot be read to its end gives only `fault`, although floes
/// before the fault were compared.
FinalPlaces compare_final_places(const io::Run& run);

/// Add the comparison to the output of `polynya inspect --check`: lines of its text (at most 20 misplaced floes are
/// listed), or the member `final_places` of its JSON (all are listed).
void add_text(std::string& text, const FinalPlaces& places);
void write_members(io::JsonWriter& json, const FinalPlaces& places);

}  // namespace polynya::analysis
