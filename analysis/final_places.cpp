#include "analysis/final_places.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "io/run/final_floes.hpp"
#include "io/run/frames.hpp"
#include "io/run/records.hpp"
#include "io/text/problem.hpp"

namespace polynya::analysis {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using simulation::FloeId;

/// Rounding of coordinates in the world may move a vertex by this distance [m]. A double near 1e6 m, the farthest that
/// coordinates go, has steps of 1.2e-10 m. Two vertices that round to one point are one vertex in final.geojson.
constexpr double kRounding = 1e-8;

constexpr std::size_t kMostMisplaced = 20;  ///< number of floes that the text lists

/// Largest accepted distance of a vertex from its place by a frame [m]. The frame's tolerance applies to each axis, so
/// the position may be wrong by √2 times as much. `arm` is the distance from the floe's centre of mass [m].
double allowed_distance(double arm) {
  return std::numbers::sqrt2 * io::kFramePositionTolerance + io::kFrameAngleTolerance * arm + kRounding;
}

/// Returns the ring without vertices whose distance from the vertex before them is within rounding.
Ring without_near_repeats(const Ring& ring) {
  Ring kept;
  for (const Point p : ring)
    if (kept.empty() || distance(kept.back(), p) > kRounding) kept.push_back(p);
  while (kept.size() > 1 && distance(kept.front(), kept.back()) <= kRounding) kept.pop_back();
  return kept;
}

/// Compares the floes of final.geojson with the floes of the run. It records which floes final.geojson contained.
class PlaceComparison {
 public:
  PlaceComparison(const io::Run& run, double time, FinalPlaces& result)
      : run_(run), time_(time), result_(result), motions_(run), is_seen_(run.floes.size()) {}

  void compare(const io::FinalFloe& in_file) {
    const FloeId id = in_file.floe;
    if (!run_.is_alive(id, time_)) return name(id, "final.geojson has the floe, which does not float then");
    if (is_seen_[static_cast<std::size_t>(id)]) return name(id, "final.geojson has the floe twice");
    is_seen_[static_cast<std::size_t>(id)] = true;
    const auto motion = motions_.floe_at(id, time_);
    if (!motion) return name(id, "final.geojson has the floe, and no frame has it");
    ++result_.compared;
    compare_rings(in_file, *motion);
  }

  void find_missing() {
    for (const io::RunFloe& floe : run_.floes)
      if (run_.is_alive(floe.birth.floe, time_) && !is_seen_[static_cast<std::size_t>(floe.birth.floe)])
        name(floe.birth.floe, "the floe floats then, and final.geojson does not have it");
  }

 private:
  void name(FloeId floe, std::string defect) { result_.misplaced.push_back({floe, std::move(defect)}); }

  void compare_rings(const io::FinalFloe& in_file, const io::Motion& motion) {
    const FloeId id = in_file.floe;
    const Polygon by_frame = polygon_in_world(*run_.shape(id), run_.floe(id)->birth.centroid_in_body, motion);
    const Polygon& polygon = in_file.polygon_in_world;
    if (polygon.holes.size() != by_frame.holes.size())
      return name(id, fmt::format("the floe has {} in final.geojson and {} in floes.ndjson",
                                  io::counted(polygon.holes.size(), "hole"), by_frame.holes.size()));
    MisplacedFloe worst{id, ""};
    compare_ring(by_frame.outer, polygon.outer, motion.position, worst);
    for (std::size_t i = 0; i < polygon.holes.size(); ++i)
      compare_ring(by_frame.holes[i], polygon.holes[i], motion.position, worst);
    if (!worst.defect.empty() || worst.distance > worst.allowed) result_.misplaced.push_back(std::move(worst));
  }

  /// Compares two rings. `worst` keeps the vertex whose distance is the largest multiple of the accepted one.
  void compare_ring(Ring by_frame, Ring in_file, Point centre, MisplacedFloe& worst) {
    if (by_frame.size() != in_file.size()) {
      const std::string sizes = fmt::format("a ring of the floe has {} in final.geojson and {} in floes.ndjson",
                                            io::counted(in_file.size(), "vertex", "vertices"), by_frame.size());
      by_frame = without_near_repeats(by_frame);
      in_file = without_near_repeats(in_file);
      if (by_frame.size() != in_file.size()) worst.defect = sizes;
    }
    for (std::size_t i = 0; i < by_frame.size() && worst.defect.empty(); ++i) {
      const double apart = distance(by_frame[i], in_file[i]);
      const double allowed = allowed_distance(distance(by_frame[i], centre));
      if (!std::isfinite(apart + allowed)) {
        worst.defect = "the place of a vertex is not finite";
        return;
      }
      if (apart > result_.farthest) {
        result_.farthest = apart;
        result_.farthest_floe = worst.floe;
      }
      if (apart * worst.allowed < worst.distance * allowed) continue;
      worst.distance = apart;
      worst.allowed = allowed;
    }
  }

  const io::Run& run_;
  double time_;  ///< instant of the comparison [s]
  FinalPlaces& result_;
  io::MotionIndex motions_;
  std::vector<bool> is_seen_;  ///< by floe id: true if final.geojson has the floe
};

}  // namespace

FinalPlaces compare_final_places(const io::Run& run) {
  FinalPlaces result;
  const auto file = io::FinalFloes::read(run.folder);
  if (!file) result.fault = file.error();
  if (file && !*file) result.not_compared = "the run has no final.geojson";
  if (!file || !*file) return result;
  const double time = (*file)->time();
  if (std::ranges::find(run.frames, time, &io::Frame::time) == run.frames.end()) {
    result.not_compared = fmt::format("final.geojson is of {:.6g} s, and no frame is", time);
    return result;
  }
  PlaceComparison comparison(run, time, result);
  const auto read = (*file)->for_each([&](const io::FinalFloe& floe) { comparison.compare(floe); });
  if (!read) {
    result = {};
    result.fault = read.error();
    return result;
  }
  comparison.find_missing();
  result.time = time;
  return result;
}

void add_text(std::string& text, const FinalPlaces& places) {
  const auto add = [&text](const std::string& line) { text += line + "\n"; };
  if (!places.time)
    return add(fmt::format("places     not compared: {}", places.fault.empty() ? places.not_compared : places.fault));
  const std::string of_floe = places.farthest > 0 ? fmt::format(" (floe {})", places.farthest_floe) : std::string();
  add(fmt::format(
      "places     {} at {:.6g} s: vertices in final.geojson are at most {:.2e} m from their places by frames.bin{}; {}",
      io::counted(places.compared, "floe"), *places.time, places.farthest, of_floe,
      places.misplaced.size() == 1 ? "1 floe is wrong" : fmt::format("{} floes are wrong", places.misplaced.size())));
  for (std::size_t i = 0; i < std::min(places.misplaced.size(), kMostMisplaced); ++i) {
    const MisplacedFloe& one = places.misplaced[i];
    const std::string words = one.defect.empty()
                                  ? fmt::format(
                                        "a vertex in final.geojson is {:.6g} m from its place by frames.bin, {:.6g} m "
                                        "are allowed",
                                        one.distance, one.allowed)
                                  : one.defect;
    add(fmt::format("           floe {} at {:.6g} s: {}", one.floe, *places.time, words));
  }
}

void write_members(io::JsonWriter& json, const FinalPlaces& places) {
  const auto text_or_none = [](const std::string& text) { return text.empty() ? std::nullopt : std::optional(text); };
  json.key("final_places").open('{').key("not_compared").value(text_or_none(places.not_compared));
  json.key("fault").value(text_or_none(places.fault)).key("t_s").value(places.time);
  json.key("floes").value(places.compared).key("farthest_m").value(places.farthest);
  json.key("farthest_floe_id").value(io::id_or_none(places.farthest_floe));
  json.key("misplaced").object_lines(places.misplaced, [&](const MisplacedFloe& one) {
    const bool is_apart = one.defect.empty();
    json.key("floe_id").value(one.floe).key("t_s").value(places.time).key("defect").value(text_or_none(one.defect));
    json.key("distance_m").value(is_apart ? std::optional(one.distance) : std::nullopt);
    json.key("allowed_m").value(is_apart ? std::optional(one.allowed) : std::nullopt);
  });
  json.close('}');
}

}  // namespace polynya::analysis
