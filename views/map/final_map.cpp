#include "views/map/final_map.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "io/run/run_folder.hpp"
#include "io/text/output_file.hpp"
#include "views/map/figures.hpp"
#include "views/map/svg_convert.hpp"

namespace polynya::views {
namespace {

constexpr std::size_t kLargestConverted = std::size_t{20}
                                          << 20;  ///< an SVG that a converter is given [bytes]

Picture final_picture(const io::Run& run) {
  Picture picture = picture_at(run, io::MotionIndex(run), run.end_time());
  const auto count = [&](simulation::EventKind kind) {
    return std::ranges::count(picture.fractures, kind, &Picture::Fracture::kind);
  };
  picture.title = fmt::format("{} at {:.6g} s", run.label, run.end_time());
  picture.caption = fmt::format("{} cusps broken by bending, {} splits, {} floes, {} at the start",
                                count(simulation::EventKind::kBend), count(simulation::EventKind::kSplit),
                                picture.floes.size(), picture.ice_at_start.size());
  return picture;
}

}  // namespace

tl::expected<std::string, std::string> draw_final_map(const io::Run& run) {
  const std::string svg = to_svg(final_picture(run));
  const auto file = run.folder / io::run_file::kFinalSvg;
  if (const auto written = io::write_whole_file(file, svg, io::Durability::kSynced); !written)
    return io::fail(written.error());
  const auto png = run.folder / io::run_file::kFinalPng;
  if (svg.size() > kLargestConverted || !convert_svg(file, png)) return std::string(io::run_file::kFinalSvg);
  return std::string(io::run_file::kFinalPng);
}

}  // namespace polynya::views
