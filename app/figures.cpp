#include "io/figures.hpp"

#include <cmath>
#include <filesystem>
#include <limits>

#include "app/console.hpp"
#include "app/exit_code.hpp"
#include "app/run_commands.hpp"
#include "app/write_output.hpp"
#include "io/run_folder.hpp"

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

}  // namespace

int figures(const FiguresOptions& options) {
  std::vector<io::Run> runs;
  for (const std::string& folder : options.runs) {
    auto run = io::read_run(folder);
    if (!run || run->frames.empty()) {
      print_err("polynya: {}\n", run ? folder + ": it has no frames" : run.error());
      return kInputOutput;
    }
    runs.push_back(std::move(*run));
  }
  for (const double time : options.at) {
    if (time >= runs.front().start_time() && time <= runs.front().end_time()) continue;
    print_err("polynya: --at {:g}: the run goes from {:g} to {:g} s\n", time, runs.front().start_time(),
              runs.front().end_time());
    return kUsage;
  }
  for (const io::Run& run : runs) {
    const simulation::Scene& scene = run.scene.scene;
    if (scene.ships.empty() || !io::chosen_loads(scene, options.load).empty()) continue;
    print_err("polynya: --load {}: {} {}\n", options.load, run.folder.string(),
              options.load == "ships" ? "has one ship and no structure"
                                      : "does not split floes by j/tau_c (fracture.splitting.model michel)");
    return kUsage;
  }
  const fs::path folder = options.out.empty() ? options.runs.front() : options.out;
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  const std::vector<double> times = chosen_times(runs, options.at);
  const std::pair<std::string_view, std::string> pages[] = {
      {io::run_file::kFigureFloes, to_svg(map_figure(runs, times))},
      {io::run_file::kFigureLoads, to_svg(load_figure(runs, options.load))},
      {io::run_file::kFigureMotion, to_svg(motion_figure(runs))},
      {io::run_file::kFigureSizes, to_svg(size_figure(runs))},
      {io::run_file::kFigureEnergy, energy_figure(runs)}};
  for (const auto& [name, page] : pages) {
    if (page.empty()) {
      print_err("note: there is no energy in summary.json; {} is left out\n", name);
      continue;
    }
    const fs::path svg = folder / name;
    if (const std::string wrong = write_product(options.out, options.runs.front(), name, page);
        !wrong.empty()) {
      print_err("polynya: {}\n", wrong);
      return kInputOutput;
    }
    const fs::path png = fs::path(svg).replace_extension(".png");
    write_out(svg.string() + (io::convert_to_png(svg, png) ? "\n" + png.string() + "\n" : "\n"));
  }
  return kDone;
}

}  // namespace polynya::app
