#include <array>
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
    "  polynya view runs/6a runs/6b --out both.html            side by side, with one clock\n"
    "\n"
    "Exit codes: 0 done, 2 usage (also: larger than --limit), 5 input/output.\n";

struct Options {
  std::vector<std::string> runs;    ///< one, or two side by side
  std::vector<std::string> labels;  ///< of two; chosen if empty
  std::string out;                  ///< empty: view.html in the run folder
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

/// A run as it is read, with what the page holds of it.
struct ViewedRun {
  io::Run run;
  views::PlayerData data;
};

/// The error has its exit code.
tl::expected<ViewedRun, int> read_viewed(const std::string& folder, const io::FrameSelection& frames) {
  auto run = io::read_run(folder);
  if (!run) return tl::unexpected(fail(kInputOutput, run.error()));
  views::PlayerData data = views::player_data(*run, frames);
  if (data.frames == 0 && !run->frames.empty())
    return tl::unexpected(
        fail(kUsage, fmt::format("no frame of {} is in that part; they go from {:g} to {:g} s", folder,
                                 run->start_time(), run->end_time())));
  return ViewedRun{std::move(*run), std::move(data)};
}

/// What two runs are called: as their scenes, their folders, or their whole paths; the first of these that
/// differ.
std::array<std::string, 2> labels_of(const std::vector<ViewedRun>& viewed, const Options& options) {
  if (!options.labels.empty()) return {options.labels[0], options.labels[1]};
  const auto both = [&](auto name) { return std::array<std::string, 2>{name(0), name(1)}; };
  auto scenes = both([&](std::size_t k) { return viewed[k].run.scene.scene.name; });
  if (scenes[0] != scenes[1]) return scenes;
  const auto folders = both([&](std::size_t k) {
    const fs::path path = fs::path(options.runs[k]).lexically_normal();
    return (path.has_filename() ? path.filename() : path.parent_path().filename()).string();
  });
  return folders[0] != folders[1] ? folders : both([&](std::size_t k) { return options.runs[k]; });
}

std::string page_of(std::vector<ViewedRun> viewed, const Options& options) {
  if (viewed.size() == 1) return player_page(viewed[0].run, viewed[0].data);
  const auto labels = labels_of(viewed, options);
  return views::pair_page({{{std::move(viewed[0].data), labels[0]}, {std::move(viewed[1].data), labels[1]}}});
}

/// What is wrong with the options; empty where nothing is.
std::string problem_of(const Options& options) {
  if (options.runs.size() == 2 && options.out.empty())
    return "two runs: --out FILE has to state where their page goes";
  if (!options.labels.empty() && (options.runs.size() != 2 || options.labels.size() != 2))
    return fmt::format("--label: {} for {}; two names for two runs", counted(options.labels.size(), "name"),
                       counted(options.runs.size(), "run"));
  return "";
}

/// "276 frames, 491 floes, 356 events", of several runs one after the other.
std::string contents(const std::vector<ViewedRun>& viewed) {
  std::vector<std::string> all;
  all.reserve(viewed.size());
  for (const ViewedRun& one : viewed)
    all.push_back(fmt::format("{} frames, {} floes, {} events", one.data.frames, one.run.floes.size(),
                              one.run.events.size()));
  return fmt::format("{}", fmt::join(all, "; "));
}

int write_view(const Options& options) {
  if (const std::string problem = problem_of(options); !problem.empty()) return fail(kUsage, problem);
  std::vector<ViewedRun> viewed;
  for (const std::string& folder : options.runs) {
    auto one = read_viewed(folder, options.frames);
    if (!one) return one.error();
    viewed.push_back(std::move(*one));
  }
  const std::string held = contents(viewed);
  const std::string page = page_of(std::move(viewed), options);
  const double megabytes = static_cast<double>(page.size()) / 1e6;
  if (megabytes > options.most_megabytes) return fail(kUsage, too_large(megabytes, options));
  const fs::path in_run = fs::path(options.runs[0]) / io::run_file::kView;
  const auto written =
      options.out.empty() ? io::write_whole_file(in_run, page) : write_output(options.out, page);
  if (!written) return fail(kInputOutput, written.error());
  const bool is_on_stdout = !options.out.empty() && is_stdout(options.out);
  (is_on_stdout ? write_err : write_out)(fmt::format("{}  {:.1f} MB, {}; open it in a browser\n",
                                                     options.out.empty() ? in_run.string() : options.out,
                                                     megabytes, held));
  return kDone;
}

}  // namespace

Command add_view(CommandLine& app) {
  CommandLine command = app.add_command(
      "view", "Write a page that plays a run, or two side by side, in any browser, offline", kExamples);
  auto options = std::make_shared<Options>();
  command.option("run", options->runs, "RUN", "The run folder; two are shown side by side, with one clock")
      .required()
      .takes(1, 2);
  command.option("--out", options->out, "FILE", "The page; view.html in the run folder if not given");
  command.option("--label", options->labels, "NAME,NAME", "Names of two runs").separated_by(',');
  command.option("--every", options->frames.every, "N", "Only each N-th frame, and the last",
                 whole(1, 1000000));
  command.option("--from", options->frames.from, "S", "Only from that time on [s]", finite());
  command.option("--until", options->frames.until, "S", "Only up to that time [s]", finite());
  command.option("--limit", options->most_megabytes, "MB", "The largest page to write [MB]; 100 if not given",
                 between(0.001, 2000));
  return {command, [options] { return write_view(*options); }};
}

}  // namespace polynya::app
