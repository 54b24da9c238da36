#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "io/run/run_folder.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/output_file.hpp"
#include "views/player/player_page.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

constexpr auto kBetweenLooks = std::chrono::milliseconds(300);

/// The page beside its scene, and with `watch` the script by which pages that are open learn of it.
io::Result<> write_page(const io::LoadedScene& scene, const std::string& out, bool watch) {
  const std::string stamp = fmt::format("{:x}", std::chrono::system_clock::now().time_since_epoch().count());
  const fs::path stamp_file = watch ? fs::path(out + ".js") : fs::path();
  const auto page = views::scene_page(scene, stamp, stamp_file.filename().string());
  if (!page) return io::fail(page.error());
  auto written = write_output(out, *page);
  if (written && watch)
    written = io::write_named_file(stamp_file, fmt::format("window.polynyaStamp = \"{}\";\n", stamp));
  return written;
}

int write_once(const std::string& file, const std::string& out, bool watch) {
  const auto scene = io::read_scene_file(file);
  print_lines(scene ? scene->hints : scene.error());
  if (!scene) return kSceneInvalid;
  if (const auto written = write_page(*scene, out, watch); !written) return fail(kInputOutput, written.error());
  const std::string words =
      fmt::format("{}  {}, {}; open it in a browser\n", out, counted(scene->scene.floes.size(), "floe"),
                  counted(hull_count(scene->scene), "hull"));
  (is_stdout(out) ? write_err : write_out)(words);
  flush_out();
  return kDone;
}

/// `polynya view SCENE.json`: the page of a scene that has not run, beside it as SCENE.html if `out` is empty. With
/// `watch` again each time that the scene's file changes, until a signal.
int write_scene_view(const std::string& scene, const std::string& out, bool watch) {
  const std::string page = out.empty() ? fs::path(scene).replace_extension(".html").string() : out;
  int code = write_once(scene, page, watch);
  if (!watch || code == kInputOutput) return code;
  watch_signals();
  std::error_code error;
  for (auto last = fs::last_write_time(scene, error); stop_signal() == 0; std::this_thread::sleep_for(kBetweenLooks)) {
    const auto now = fs::last_write_time(scene, error);  // an editor may have the file away for an instant
    if (error || now == last) continue;
    last = now;
    code = write_once(scene, page, watch);  // what is wrong is on stderr; the page stays as it was
  }
  if (fs::remove(page + ".js", error); error) return fail(kInputOutput, error.message());
  return code;
}

constexpr auto kViewExamples =
    "Examples:\n"
    "  polynya view runs/sawamura2017-fig4b                    runs/sawamura2017-fig4b/view.html\n"
    "  polynya view runs/sawamura2017-fig4b --out voyage.html\n"
    "  polynya view runs/long --every 5 --from 100 --until 400\n"
    "  polynya view runs/wide --area 0,-200,900,200            only floes that come within 900 x 400 m\n"
    "  polynya view runs/6a runs/6b --out both.html            side by side, with one clock\n"
    "  polynya view scene.json --watch                         a scene before it runs; again when its file is saved\n"
    "\n"
    "Exit codes: 0 done, 2 usage (also: larger than --limit), 5 input/output.\n";

struct ViewOptions {
  std::vector<std::string> runs;    ///< one, or two side by side
  std::vector<std::string> labels;  ///< of two; chosen if empty
  std::string out;                  ///< empty: view.html in the run folder
  views::PlayerSelection part;
  std::vector<double> area;     ///< x0, y0, x1, y1 [m]; of `part` once it is checked
  bool is_watched = false;      ///< a scene whose page is written again when its file changes
  double most_megabytes = 100;  ///< a larger page is refused [10⁶ bytes]
};

/// A run as it is read, with what the page holds of it.
struct ViewedRun {
  io::Run run;
  views::PlayerData data;
};

Outcome<ViewedRun> read_viewed(const std::string& folder, const views::PlayerSelection& part) {
  auto run = io::read_run(folder);
  if (!run) return failure(kInputOutput, run.error());
  views::PlayerData data = views::player_data(*run, part);
  if (data.frames == 0 && !run->frames.empty())
    return failure(kUsage, fmt::format("no frame of {} is in that part; they go from {:g} to {:g} s", folder,
                                       run->start_time(), run->end_time()));
  if (data.floes == 0 && !run->floes.empty())
    return failure(kUsage, fmt::format("no floe of {} comes within --area", folder));
  return ViewedRun{std::move(*run), std::move(data)};
}

/// What two runs are called: as their scenes, their folders, or their whole paths; the first of these that
/// differ.
std::array<std::string, 2> labels_of(const std::vector<ViewedRun>& viewed, const ViewOptions& options) {
  if (!options.labels.empty()) return {options.labels[0], options.labels[1]};
  const auto both = [&](auto name) { return std::array<std::string, 2>{name(0), name(1)}; };
  auto scenes = both([&](std::size_t k) { return shown_name(viewed[k].run.scene.scene); });
  if (scenes[0] != scenes[1]) return scenes;
  const auto folders = both([&](std::size_t k) {
    const fs::path path = fs::path(options.runs[k]).lexically_normal();
    return (path.has_filename() ? path.filename() : path.parent_path().filename()).string();
  });
  return folders[0] != folders[1] ? folders : both([&](std::size_t k) { return options.runs[k]; });
}

std::string page_of(const std::vector<ViewedRun>& viewed, const ViewOptions& options) {
  if (viewed.size() == 1) return player_page(viewed[0].run, viewed[0].data);
  const auto labels = labels_of(viewed, options);
  return views::pair_page({{{viewed[0].data, labels[0]}, {viewed[1].data, labels[1]}}});
}

/// What of a page too large takes the room, and the options that leave some of it out.
std::string too_large(const std::vector<ViewedRun>& viewed, const ViewOptions& options, double megabytes) {
  std::size_t floes = 0, frames = 0, floe_bytes = 0, frame_bytes = 0;
  for (const auto& [run, data] : viewed) {
    floes += data.floes, frames += data.frames;
    floe_bytes += data.floe_bytes, frame_bytes += data.frame_bytes;
  }
  const auto in_page = [](std::size_t bytes) { return static_cast<double>(bytes) * 4 / 3 / 1e6; };  // base64
  return fmt::format(
      "the page would have {:.0f} MB, the limit is {:g}: {:.3g} MB of it are the shapes of {}, which --area limits, "
      "{:.3g} MB where they are in {}, which --every, --from and --until limit; or --limit {:.0f}",
      megabytes, options.most_megabytes, in_page(floe_bytes), counted(floes, "floe"), in_page(frame_bytes),
      counted(frames, "frame"), std::ceil(megabytes));
}

/// What is wrong with the options; empty where nothing is.
std::string problem_of(const ViewOptions& options) {
  if (options.runs.size() == 2 && options.out.empty()) return "two runs: --out FILE has to state where their page goes";
  if (!options.labels.empty() && (options.runs.size() != 2 || options.labels.size() != 2))
    return fmt::format("--label: {} for {}; two names for two runs", counted(options.labels.size(), "name"),
                       counted(options.runs.size(), "run"));
  if (const auto& a = options.area; !a.empty() && (a[0] >= a[2] || a[1] >= a[3]))
    return "--area: X0,Y0,X1,Y1, X0 below X1 and Y0 below Y1";
  return "";
}

/// "276 frames, 491 floes, 356 events", of several runs one after the other.
std::string contents(const std::vector<ViewedRun>& viewed) {
  std::vector<std::string> all;
  all.reserve(viewed.size());
  for (const ViewedRun& one : viewed)
    all.push_back(fmt::format("{}, {}, {}", counted(one.data.frames, "frame"), counted(one.data.floes, "floe"),
                              counted(one.run.events.size(), "event")));
  return fmt::format("{}", fmt::join(all, "; "));
}

int write_view(ViewOptions options) {
  const fs::path first = options.runs[0];
  if (options.runs.size() == 1 && first.extension() == ".json" && !fs::is_directory(first))
    return write_scene_view(options.runs[0], options.out, options.is_watched);
  if (options.is_watched) return fail(kUsage, "--watch: takes a scene, SCENE.json");
  if (const std::string problem = problem_of(options); !problem.empty()) return fail(kUsage, problem);
  if (const auto& a = options.area; !a.empty()) options.part.area = {{a[0], a[1]}, {a[2], a[3]}};
  std::vector<ViewedRun> viewed;
  for (const std::string& folder : options.runs) {
    auto one = read_viewed(folder, options.part);
    if (!one) return one.error();
    viewed.push_back(std::move(*one));
  }
  const std::string held = contents(viewed);
  const std::string page = page_of(viewed, options);
  const double megabytes = static_cast<double>(page.size()) / 1e6;
  if (megabytes > options.most_megabytes) return fail(kUsage, too_large(viewed, options, megabytes));
  const fs::path in_run = fs::path(options.runs[0]) / io::run_file::kView;
  const auto written = options.out.empty() ? io::write_whole_file(in_run, page) : write_output(options.out, page);
  if (!written) return fail(kInputOutput, written.error());
  const bool is_on_stdout = !options.out.empty() && is_stdout(options.out);
  (is_on_stdout ? write_err
                : write_out)(fmt::format("{}  {:.1f} MB, {}; open it in a browser\n",
                                         options.out.empty() ? in_run.string() : options.out, megabytes, held));
  return kDone;
}

}  // namespace

Command add_view(CommandLine& app) {
  CommandLine command = app.add_command(
      "view", "Write a page that plays a run, or two side by side, or shows a scene, in any browser, offline",
      kViewExamples);
  auto options = std::make_shared<ViewOptions>();
  command.option("run", &options->runs, "RUN", "The run folder, two to be shown side by side, or a scene, SCENE.json",
                 {}, {.is_required = true, .most = 2});
  command.option("--out", &options->out, "FILE",
                 "The page; view.html in the run folder, or beside the scene, if not given");
  command.flag("--watch", options->is_watched,
               "Of a scene: write the page again whenever the file is saved, until Ctrl-C");
  command.option("--label", &options->labels, "NAME,NAME", "Names of two runs", {}, {.delimiter = ','});
  command.option("--every", &options->part.frames.every, "N", "Only each N-th frame, and the last", whole(1, 1000000));
  command.option("--from", &options->part.frames.from, "S", "Only from that time on [s]", finite());
  command.option("--until", &options->part.frames.until, "S", "Only up to that time [s]", finite());
  command.option("--area", &options->area, "X0,Y0,X1,Y1",
                 "Only floes that come within that part of the world [m], and what broke from the same floes of the "
                 "scene",
                 finite(), {.delimiter = ',', .least = 4, .most = 4});
  command.option("--limit", &options->most_megabytes, "MB", "The largest page to write [MB]; 100 if not given",
                 between(0.001, 2000));
  return {command, [options] { return write_view(*options); }};
}

}  // namespace polynya::app
