#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/options.hpp"
#include "app/python.hpp"

namespace polynya::app {
namespace {

constexpr auto kFooter =
    "Examples:\n"
    "  polynya figures runs/sawamura2017-fig4b                       figure-floes.svg, -loads, -motion, "
    "...\n"
    "  polynya figures runs/sawamura2017-fig4b --at 0,185,285,550 --style one-column --format pdf\n"
    "  polynya figures runs/6a runs/6b --out figures                 side by side, in one scale\n"
    "  polynya figures runs/6a runs/6b --label \"10 m\",\"20 m\" --width-mm 85 --title \"\"\n"
    "  polynya figures runs/6a --only loads --from 200 --until 300   a part of the time\n"
    "\n"
    "Needs Python 3 with numpy and matplotlib (./setup.sh python); a run's final.svg and the player need "
    "neither.\n"
    "Exit codes: 0 done, 2 usage, 5 input/output, or Python or matplotlib is missing.\n";

/// polynya.figures (python/polynya/figures) draws them; what is wrong with a word is found here.
struct Options {
  std::vector<std::string> runs;
  std::vector<std::string> only, formats, labels;
  std::vector<double> at, window;
  std::optional<double> from, until, width;
  std::optional<std::string> title;
  std::string load, style, out;
};

/// The options as words that Python reads to the same bits.
std::vector<std::string> words_of(const Options& options) {
  std::vector<std::string> words;
  const auto add = [&](const char* name, const std::string& value) {
    words.push_back(fmt::format("{}={}", name, value));
  };
  const auto add_list = [&](const char* name, const auto& values) {
    if (!values.empty()) add(name, fmt::format("{}", fmt::join(values, ",")));
  };
  add_list("--only", options.only);
  add_list("--format", options.formats);
  add_list("--at", options.at);
  add_list("--window", options.window);
  for (const std::string& label : options.labels) add("--label", label);
  for (const auto& [name, value] :
       {std::pair{"--from", options.from}, {"--until", options.until}, {"--width-mm", options.width}})
    if (value) add(name, fmt::format("{}", *value));
  if (options.title) add("--title", *options.title);
  for (const auto& [name, value] :
       {std::pair{"--load", &options.load}, {"--style", &options.style}, {"--out", &options.out}})
    if (!value->empty()) add(name, *value);
  words.emplace_back("--");
  words.insert(words.end(), options.runs.begin(), options.runs.end());
  return words;
}

void add_choices(CommandLine& command, Options& options) {
  command.option("--only", options.only, "", "Which figures, separated by commas; all if not given")
      .separated_by(',')
      .one_of({"floes", "loads", "motion", "sizes", "energy"});
  command
      .option("--load", options.load, "",
              "True force of the ice (mean of each recorded interval and largest step, or one of the two), "
              "force of other ships and structures, or the paper's j/tau_c; true if not given")
      .one_of({"true", "mean", "max", "ships", "j-over-tau-c"});
  command
      .option("--style", options.style, "",
              "What for: a column of a page, its whole width (if not given), or slides")
      .one_of({"one-column", "two-columns", "slides"});
  command.option("--format", options.formats, "", "Which files, separated by commas; all if not given")
      .separated_by(',')
      .one_of({"svg", "png", "pdf"});
}

}  // namespace

Command add_figures(CommandLine& app) {
  CommandLine command = app.add_command("figures", "Draw a run, or several side by side, for print", kFooter);
  auto options = std::make_shared<Options>();
  command.option("runs", options->runs, "RUN", "The run folders").required();
  add_choices(command, *options);
  command.option("--at", options->at, "S,S,...", "Instants of the maps [s]; chosen if not given", finite())
      .separated_by(',');
  command.option("--from", options->from, "S", "Draw from this time on [s]; from the start if not given",
                 finite());
  command.option("--until", options->until, "S", "Draw up to this time [s]; to the end if not given",
                 finite());
  command
      .option("--window", options->window, "X0,Y0,X1,Y1",
              "The part of the world that the maps show [m]; all if not given", finite())
      .separated_by(',')
      .takes(4);
  command.option("--label", options->labels, "NAME,...", "Names of the runs; their scenes' if not given")
      .separated_by(',');
  command.option("--title", options->title, "TEXT",
                 "Title of the figures instead of their own; \"\" for none");
  command.option("--width-mm", options->width, "MM",
                 "Width on paper instead of the style's, 85, 170 or 300; text keeps its size",
                 between(60, 400));
  command.option("--out", options->out, "DIR", "Folder for the figures; the first run's if not given");
  return {command, [options] { return become_python("polynya.figures", words_of(*options)); }};
}

}  // namespace polynya::app
