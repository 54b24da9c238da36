#include "io/final_map.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "io/figures.hpp"
#include "io/output_file.hpp"
#include "io/run_folder.hpp"
#include "io/svg_convert.hpp"

namespace polynya::io {
namespace {

constexpr std::size_t kLargestConverted = std::size_t{20}
                                          << 20;  ///< an SVG that a converter is given [bytes]

Picture final_picture(const Run& run) {
  Picture picture = picture_at(run, MotionIndex(run), run.end_time());
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

tl::expected<std::string, std::string> draw_final_map(const Run& run) {
  const std::string svg = to_svg(final_picture(run));
  const auto file = run.folder / run_file::kFinalSvg;
  if (std::string wrong = write_whole_file(file, svg, Durability::kSynced); !wrong.empty())
    return tl::unexpected(std::move(wrong));
  const auto png = run.folder / run_file::kFinalPng;
  if (svg.size() > kLargestConverted || !convert_svg(file, png)) return std::string(run_file::kFinalSvg);
  if (std::string wrong = sync_file(png); !wrong.empty()) return tl::unexpected(std::move(wrong));
  return std::string(run_file::kFinalPng);
}

}  // namespace polynya::io
