#include <cmath>
#include <filesystem>
#include <memory>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/options.hpp"
#include "app/write_output.hpp"
#include "io/run/run_folder.hpp"
#include "io/text/output_file.hpp"
#include "views/player/player_page.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

constexpr auto kExamples =
    "Examples:\n"
    "  polynya view runs/sawamura2017-fig4b                    runs/sawamura2017-fig4b/view.html\n"
    "  polynya view runs/sawamura2017-fig4b --out voyage.html\n"
    "  polynya view runs/huge --every 5 --from 100 --until 400\n"
    "\n"
    "Exit codes: 0 done, 2 usage (also: larger than --limit), 5 input/output.\n";

struct Options {
  std::string run;
  std::string out;  ///< empty: view.html in the run folder
  io::FrameSelection frames;
  double most_megabytes = 100;  ///< a larger page is refused [10⁶ bytes]
};

std::string too_large(double megabytes, const Options& options) {
  return fmt::format(
      "the page would have {:.0f} MB, the limit is {:g}: take fewer frames with --every {}, a part of the "
      "run with --from and --until, or allow more with --limit {:.0f}",
      megabytes, options.most_megabytes,
      static_cast<int>(std::ceil(options.frames.every * megabytes / options.most_megabytes)) + 1,
      std::ceil(megabytes));
}

int write_view(const Options& options) {
  const auto run = io::read_run(options.run);
  if (!run) return fail(kInputOutput, run.error());
  const views::PlayerData data = views::player_data(*run, options.frames);
  if (data.frames == 0 && !run->frames.empty())
    return fail(kUsage, fmt::format("no frame of the run is in that part; they go from {:g} to {:g} s",
                                    run->start_time(), run->end_time()));
  const std::string page = player_page(*run, data);
  const double megabytes = static_cast<double>(page.size()) / 1e6;
  if (megabytes > options.most_megabytes) return fail(kUsage, too_large(megabytes, options));
  const fs::path in_run = fs::path(options.run) / io::run_file::kView;
  const auto written =
      options.out.empty() ? io::write_whole_file(in_run, page) : write_output(options.out, page);
  if (!written) return fail(kInputOutput, written.error());
  const bool is_on_stdout = !options.out.empty() && is_stdout(options.out);
  (is_on_stdout ? write_err : write_out)(
      fmt::format("{}  {:.1f} MB, {} frames, {} floes, {} events; open it in a browser\n",
                  options.out.empty() ? in_run.string() : options.out, megabytes, data.frames,
                  run->floes.size(), run->events.size()));
  return kDone;
}

}  // namespace

Command add_view(CLI::App& app) {
  auto* command = app.add_subcommand("view", "Write a page that plays a run in any browser, offline");
  command->footer(kExamples);
  auto options = std::make_shared<Options>();
  add_run_folder(*command, options->run);
  option(*command, "--out", options->out, "FILE", "The page; view.html in the run folder if not given");
  option(*command, "--every", options->frames.every, "N", "Only each N-th frame, and the last",
         CLI::Range(1, 1000000));
  option(*command, "--from", options->frames.from, "S", "Only from that time on [s]", finite());
  option(*command, "--until", options->frames.until, "S", "Only up to that time [s]", finite());
  option(*command, "--limit", options->most_megabytes, "MB",
         "The largest page to write [MB]; 100 if not given", between(0.001, 2000));
  return {command, [options] { return write_view(*options); }};
}

}  // namespace polynya::app
