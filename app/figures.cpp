#include "views/map/figures.hpp"

#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/options.hpp"
#include "app/write_output.hpp"
#include "io/run/run_folder.hpp"
#include "views/map/svg_convert.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

constexpr auto kExamples =
    "Examples:\n"
    "  polynya figures runs/sawamura2017-fig4b                       figure-floes.svg, -loads, -motion, "
    "...\n"
    "  polynya figures runs/sawamura2017-fig4b --at 0,185,285,550\n"
    "  polynya figures runs/6a runs/6b --out figures                 side by side, in one scale\n"
    "\n"
    "  polynya figures runs/6a runs/6b --label \"10 m\",\"20 m\" --width-mm 85 --title \"\"\n"
    "\n"
    "A PNG and a PDF are made beside each SVG where rsvg-convert is installed.\n"
    "Exit codes: 0 done, 2 usage, 5 input/output.\n";

struct Options {
  std::vector<std::string> runs;
  std::string out;                   ///< folder; empty: the first run's
  std::vector<double> at;            ///< instants of the maps [s]; empty: chosen
  std::string load = "true";         ///< views/map/figures.hpp, chosen_loads
  std::optional<std::string> title;  ///< instead of the figures' own; empty: none
  std::vector<std::string> labels;   ///< of the runs, instead of their scenes' names
  double width = 170;                ///< of a figure on paper [mm]
  std::vector<double> window;        ///< of the maps: x0, y0, x1, y1; empty: all of it [m]
};

/// One run: a third, two thirds and the end of it, and its start. Several: their ends.
std::vector<double> chosen_times(const std::vector<io::Run>& runs, const std::vector<double>& wanted) {
  if (!wanted.empty()) return wanted;
  const double end = runs.front().end_time();
  if (runs.size() > 1) return {std::numeric_limits<double>::infinity()};
  return {runs.front().start_time(), std::round(end / 3), std::round(end * 2 / 3), end};
}

/// What is wrong with the options for these runs; empty where nothing is.
std::string problem_of(const Options& options, const std::vector<io::Run>& runs) {
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

views::PictureSheet maps(const std::vector<io::Run>& runs, const Options& options,
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

int draw_figures(const Options& options) {
  std::vector<io::Run> runs;
  for (const std::string& folder : options.runs) {
    auto run = io::read_run(folder);
    if (!run || run->frames.empty())
      return fail(kInputOutput, run ? folder + ": it has no frames" : run.error());
    if (runs.size() < options.labels.size()) run->label = options.labels[runs.size()];
    runs.push_back(std::move(*run));
  }
  if (const std::string problem = problem_of(options, runs); !problem.empty()) return fail(kUsage, problem);
  const fs::path folder = options.out.empty() ? options.runs.front() : options.out;
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
    if (const auto written = write_product(options.out, options.runs.front(), name, text); !written)
      return fail(kInputOutput, written.error());
    const std::string more = converted(folder / name);
    has_converter = has_converter && !more.empty();
    write_out((folder / name).string() + "\n" + more);
  }
  if (!has_converter) print_err("note: rsvg-convert (./setup.sh) makes PNG and PDF of these\n");
  return kDone;
}

}  // namespace

Command add_figures(CLI::App& app) {
  auto* command = app.add_subcommand("figures", "Draw a run, or several side by side, for print");
  command->footer(kExamples);
  auto options = std::make_shared<Options>();
  option(*command, "runs", options->runs, "RUN", "The run folders")->required();
  option(*command, "--at", options->at, "S,S,...", "Instants of the maps [s]; chosen if not given", finite())
      ->delimiter(',');
  set_choices(
      *command->add_option(
          "--load", options->load,
          "True force of the ice (mean of each recorded interval and largest step, or one of the two), "
          "force of other ships and structures, or the paper's j/tau_c"),
      {"true", "mean", "max", "ships", "j-over-tau-c"});
  option(*command, "--label", options->labels, "NAME,...", "Names of the runs; their scenes' if not given")
      ->delimiter(',');
  option(*command, "--title", options->title, "TEXT",
         "Title of the figures instead of their own; \"\" for none");
  option(*command, "--width-mm", options->width, "MM",
         "Width on paper, on which text has 7 to 9 pt; 170 if not given", between(60, 400));
  option(*command, "--window", options->window, "X0,Y0,X1,Y1",
         "The part of the world that the maps show [m]; all if not given", finite())
      ->delimiter(',')
      ->expected(4);
  option(*command, "--out", options->out, "DIR", "Folder for the figures; the first run's if not given");
  return {command, [options] { return draw_figures(*options); }};
}

}  // namespace polynya::app
