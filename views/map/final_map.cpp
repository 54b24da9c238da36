#include "views/map/final_map.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "io/run/motion_index.hpp"
#include "io/run/run_folder.hpp"
#include "io/text/child_process.hpp"
#include "io/text/output_file.hpp"
#include "io/text/problem.hpp"

namespace polynya::views {

Picture picture_at(const io::Run& run, const io::MotionIndex& motions, double time) {
  Picture picture;
  const simulation::Scene& scene = run.scene.scene;
  picture.ice_at_start.reserve(scene.floes.size());
  picture.floes.reserve(scene.floes.size());
  for (const auto& floe : scene.floes) picture.ice_at_start.push_back(floe.polygon_in_world);
  for_floes_at(run, motions, time, [&](const io::PlacedFloe& floe) {
    picture.floes.push_back({transform(floe.world_from_body, *floe.polygon_in_body), floe.birth->generation,
                             run.floe(floe.birth->floe)->came_up});
  });
  for (const io::PlacedFloe& floe : floes_under_hulls_at(run, motions, time))
    picture.ice_under_hulls.push_back(transform(floe.world_from_body, *floe.polygon_in_body));
  for (std::size_t ship = 0; ship < hull_count(scene); ++ship) {
    Picture::Ship drawn{transform(ship_pose_at(run, motions, ship, time), hull_of(scene, ship).hull.waterline),
                        {},
                        kind_of_hull(scene, ship) == simulation::BodyKind::kWall};
    for (const double t : drawn.is_wall ? std::vector<double>{} : frame_times_until(run, time))
      drawn.track.push_back(ship_pose_at(run, motions, ship, t).position);
    picture.ships.push_back(std::move(drawn));
  }
  for (const simulation::Event& event : run.events) {
    if (event.time > time || !event.is_fracture()) continue;
    const FractureMark mark = event.is<simulation::Bend>()    ? FractureMark::kBend
                              : event.is<simulation::Split>() ? FractureMark::kSplit
                                                              : FractureMark::kGrind;
    picture.fractures.push_back({event.point_in_world, mark});
  }
  return picture;
}

namespace {

constexpr std::size_t kLargestConverted = std::size_t{20} << 20;  ///< an SVG that a converter is given [bytes]

std::ptrdiff_t count_of(const Picture& picture, FractureMark mark) {
  return std::ranges::count(picture.fractures, mark, &Picture::Fracture::mark);
}

/// How many pieces went under hulls and came up until a time; empty where none went under.
std::string words_of_ice_under_hulls(const io::Run& run, double time) {
  const auto count = [&](bool (simulation::Event::*is_kind)() const) {
    return std::ranges::count_if(
        run.events, [&](const simulation::Event& event) { return (event.*is_kind)() && event.time <= time; });
  };
  const auto went = count(&simulation::Event::is<simulation::Submerge>);
  if (went == 0) return {};
  return fmt::format("; {} went under the hull, {} came up", io::counted(went, "piece"),
                     count(&simulation::Event::is<simulation::Resurface>));
}

/// Makes a PNG of 240 dots per inch of an SVG file where rsvg-convert is installed. False where it is not or fails.
bool convert_to_png(const std::filesystem::path& svg, const std::filesystem::path& png) {
  constexpr std::size_t kLongest = std::size_t{1} << 30;  // [bytes]
  std::error_code error;
  const auto there = std::filesystem::symlink_status(png, error);
  if (exists(there) && !is_regular_file(there) && !is_symlink(there)) return false;
  // It writes into a pipe: no folder is written to by a program that may outlive this one.
  const auto output =
      io::run_child({"rsvg-convert", "--format=png", "--dpi-x=240", "--dpi-y=240", svg.string()}, kLongest);
  const bool is_made = output && output->code == 0 && !output->out.empty();
  if (is_made && io::write_whole_file(png, output->out, io::Durability::kSynced)) return true;
  std::filesystem::remove(png, error);  // of an earlier picture
  return false;
}

}  // namespace

Picture final_picture(const io::Run& run) {
  Picture picture = picture_at(run, io::MotionIndex(run), run.end_time());
  picture.title = fmt::format("{} at {:.6g} s", run.label, run.end_time());
  picture.caption = fmt::format("{} broken by bending, {}, {}, {} at the start{}",
                                io::counted(count_of(picture, FractureMark::kBend), "cusp"),
                                io::counted(count_of(picture, FractureMark::kSplit), "split"),
                                io::counted(static_cast<std::int64_t>(picture.floes.size()), "floe"),
                                picture.ice_at_start.size(), words_of_ice_under_hulls(run, run.end_time()));
  return picture;
}

io::Result<std::string> draw_final_map(const io::Run& run) {
  const std::string svg = to_svg(final_picture(run));
  const auto file = run.folder / io::run_file::kFinalSvg;
  if (const auto written = io::write_whole_file(file, svg, io::Durability::kSynced); !written)
    return io::fail(written.error());
  const auto png = run.folder / io::run_file::kFinalPng;
  if (svg.size() > kLargestConverted || !convert_to_png(file, png)) return std::string(io::run_file::kFinalSvg);
  return std::string(io::run_file::kFinalPng);
}

}  // namespace polynya::views
