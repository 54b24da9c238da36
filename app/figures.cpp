#include "views/map/figures.hpp"

#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "app/console.hpp"
#include "app/exit_code.hpp"
#include "app/run_commands.hpp"
#include "app/write_output.hpp"
#include "io/run/run_folder.hpp"
#include "views/map/svg_convert.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

/// One run: a third, two thirds and the end of it, and its start. Several: their ends.
std::vector<double> chosen_times(const std::vector<io::Run>& runs, const std::vector<double>& wanted) {
  if (!wanted.empty()) return wanted;
  const double end = runs.front().end_time();
  if (runs.size() > 1) return {std::numeric_limits<double>::infinity()};
  return {runs.front().start_time(), std::round(end / 3), std::round(end * 2 / 3), end};
}

/// What is wrong with the options for these runs; empty where nothing is.
std::string problem_of(const FiguresOptions& options, const std::vector<io::Run>& runs) {
  for (const double time : options.at) {
    if (time < runs.front().start_time() || time > runs.front().end_time())
      return fmt::format("--at {:g}: the run goes from {:g} to {:g} s", time, runs.front().start_time(),
                         runs.front().end_time());
  }
  if (!options.labels.empty() && options.labels.size() != runs.size())
    return fmt::format("--label: {} names for {} runs", options.labels.size(), runs.size());
  const auto& w = options.window;
  if (!w.empty() && (w[0] >= w[2] || w[1] >= w[3]))
    return fmt::format("--window {:g},{:g},{:g},{:g}: x0 must be below x1, and y0 below y1", w[0], w[1], w[2],
                       w[3]);
  for (const io::Run& run : runs) {
    const simulation::Scene& scene = run.scene.scene;
    if (scene.ships.empty() || !views::chosen_loads(scene, options.load).empty()) continue;
    return fmt::format("--load {}: {} {}", options.load, run.folder.string(),
                       options.load == "ships"
                           ? "has one ship and no structure"
                           : "does not split floes by j/tau_c (fracture.splitting.model michel)");
  }
  return "";
}

views::PictureSheet maps(const std::vector<io::Run>& runs, const FiguresOptions& options,
                         const views::PageStyle& page) {
  views::PictureSheet sheet = views::map_figure(runs, chosen_times(runs, options.at));
  sheet.page = page;
  const auto& w = options.window;
  if (!w.empty()) sheet.window = geometry::Box{{w[0], w[1]}, {w[2], w[3]}};
  return sheet;
}

views::Chart on(const views::PageStyle& page, views::Chart chart) {
  chart.page = page;
  return chart;
}

/// The PNG and the PDF of an SVG, as far as there is a converter, in lines.
std::string converted(const fs::path& svg) {
  std::string names;
  for (const char* suffix : {".png", ".pdf"}) {
    const fs::path target = fs::path(svg).replace_extension(suffix);
    if (views::convert_svg(svg, target)) names += target.string() + "\n";
  }
  return names;
}

}  // namespace

int figures(const FiguresOptions& options) {
  std::vector<io::Run> runs;
  for (const std::string& folder : options.runs) {
    auto run = io::read_run(folder);
    if (!run || run->frames.empty()) {
      print_err("polynya: {}\n", run ? folder + ": it has no frames" : run.error());
      return kInputOutput;
    }
    if (runs.size() < options.labels.size()) run->label = options.labels[runs.size()];
    runs.push_back(std::move(*run));
  }
  if (const std::string problem = problem_of(options, runs); !problem.empty()) {
    print_err("polynya: {}\n", problem);
    return kUsage;
  }
  const fs::path folder = options.out.empty() ? options.runs.front() : options.out;
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  const views::PageStyle page{options.width, options.title};
  const std::pair<std::string_view, std::string> pages[] = {
      {io::run_file::kFigureFloes, views::to_svg(maps(runs, options, page))},
      {io::run_file::kFigureLoads, views::to_svg(on(page, views::load_figure(runs, options.load, page)))},
      {io::run_file::kFigureMotion, views::to_svg(on(page, views::motion_figure(runs)))},
      {io::run_file::kFigureSizes, views::to_svg(on(page, views::size_figure(runs)))},
      {io::run_file::kFigureEnergy, views::energy_figure(runs, page)}};
  bool has_converter = true;
  for (const auto& [name, text] : pages) {
    if (text.empty()) {
      print_err("note: there is no energy in summary.json; {} is left out\n", name);
      continue;
    }
    if (const std::string wrong = write_product(options.out, options.runs.front(), name, text);
        !wrong.empty()) {
      print_err("polynya: {}\n", wrong);
      return kInputOutput;
    }
    const std::string more = converted(folder / name);
    has_converter = has_converter && !more.empty();
    write_out((folder / name).string() + "\n" + more);
  }
  if (!has_converter) print_err("note: rsvg-convert (./setup.sh) makes PNG and PDF of these\n");
  return kDone;
}

}  // namespace polynya::app
