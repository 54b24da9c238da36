// The end of a run folder: its last files, on the disk, and then no checkpoint any more.

#include <fmt/format.h>

#include "geometry/pose.hpp"
#include "io/checkpoint.hpp"
#include "io/records.hpp"
#include "io/run_writer.hpp"
#include "io/svg_convert.hpp"

namespace polynya::io {
namespace {

constexpr std::size_t kLargestConverted = std::size_t{20}
                                          << 20;  ///< an SVG that a converter is given [bytes]

}  // namespace

Picture RunWriter::picture(const RunSummary& summary, const simulation::Simulation& simulation) const {
  Picture picture;
  picture.title = fmt::format("{} at {:.6g} s", scene_->scene.name, summary.sim_time);
  picture.caption =
      fmt::format("{} cusps broken by bending, {} splits, {} floes, {} at the start", summary.counts.bends,
                  summary.counts.splits, summary.counts.floes_final, summary.counts.floes_initial);
  for (const auto& floe : scene_->scene.floes) picture.ice_at_start.push_back(floe.polygon_in_world);
  const auto moved = [](const geometry::Pose& pose, geometry::Ring ring) {
    for (geometry::Point& p : ring) p = point_in_world(pose, p);
    return ring;
  };
  for (const simulation::FloeState& floe : simulation.floe_states()) {
    geometry::Polygon polygon{moved(floe.world_from_body, floe.polygon_in_body->outer), {}};
    for (const auto& hole : floe.polygon_in_body->holes)
      polygon.holes.push_back(moved(floe.world_from_body, hole));
    picture.floes.push_back({std::move(polygon), floe.generation});
  }
  std::size_t ship = 0;
  for (const simulation::ShipState& state : simulation.ship_states()) {
    picture.ships.push_back(
        {moved(state.world_from_ship, scene_->scene.ships[ship].hull.waterline), tracks_[ship]});
    ++ship;
  }
  picture.fractures = fractures_;
  return picture;
}

std::string RunWriter::finish(const RunSummary& summary, const simulation::Simulation& simulation) {
  sync();
  if (is_displaced_) return failure_;  // whatever is there now is not this run's
  std::string problem = failure();
  const auto write = [&](std::string_view name, const std::string& text) {
    const std::string wrong = write_whole_file(folder() / name, text, Durability::kSynced);
    if (problem.empty()) problem = wrong;
    return wrong.empty();
  };
  const auto write_pictures = [&] {
    write(run_file::kFinalGeojson, to_geojson(simulation.floe_states(), simulation.time()));
    const std::string svg = to_svg(picture(summary, simulation));
    if (!write(run_file::kFinalSvg, svg) || svg.size() > kLargestConverted) return;
    const auto png = folder() / run_file::kFinalPng;
    has_png_ = convert_svg(folder() / run_file::kFinalSvg, png);
    if (has_png_ && problem.empty()) problem = sync_file(png);
  };
  // A summary that says "finished" comes last, when all is there, and on the disk. Of a run that stopped it
  // comes first: where space is short it matters more than the picture.
  if (summary.finished) write_pictures();
  if (problem.empty() || !summary.finished) write(run_file::kSummary, to_json_text(summary, *scene_));
  if (!summary.finished) write_pictures();
  if (summary.finished && problem.empty()) problem = remove_checkpoints(folder());
  return problem;
}

}  // namespace polynya::io
