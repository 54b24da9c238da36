#include "io/run/run_folder.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "analysis/channel.hpp"
#include "analysis/run_check.hpp"
#include "analysis/run_listing.hpp"
#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "app/read/live_page.hpp"
#include "io/import/floe_properties.hpp"
#include "io/import/gdal.hpp"
#include "io/run/records.hpp"
#include "io/run/run_reader.hpp"
#include "io/scene/scene_file.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/output_file.hpp"
#include "views/export/export.hpp"
#include "views/player/player_page.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;
using simulation::FloeId;

// ---- polynya channel

constexpr auto kChannelExamples =
    "Examples:\n"
    "  polynya channel runs/sawamura2017-fig4b                 also writes channel.csv and channel.geojson there\n"
    "  polynya channel runs/sawamura2017-fig4b --at 300 --out /tmp\n"
    "  polynya channel runs/sawamura2017-fig4b --json | jq .mean_width_m\n"
    "\n"
    "Exit codes: 0 done, 2 usage, 5 input/output.\n";

struct MeasureOptions {
  std::string run;
  std::string out;  ///< folder for channel.csv and channel.geojson; empty: the run's folder
  std::string ship;
  analysis::ChannelOptions measure;
  std::string format = "table";  ///< format of the output on stdout
  bool is_json = false;          ///< the same as --format json
  ProgressKind progress = ProgressKind::kAuto;
};

std::string no_ship_named(const std::string& name, const simulation::Scene& scene) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < hull_count(scene); ++i) names.push_back(io::hull_name(scene, static_cast<int>(i)));
  return fmt::format("no ship or structure of the run is named \"{}\"; it has: {}", name,
                     names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")));
}

int measure(const MeasureOptions& options) {
  const auto run = read_run(options.run, options.progress);
  if (!run) return fail(kInputOutput, run.error());
  analysis::ChannelOptions wanted = options.measure;
  if (!options.ship.empty()) {
    const int ship = hull_named(run->scene.scene, options.ship);
    if (ship < 0) return fail(kUsage, no_ship_named(options.ship, run->scene.scene));
    wanted.ship = static_cast<std::size_t>(ship);
  }
  const auto channel =
      with_progress(options.progress, "measuring the channel", [&] { return analysis::measure_channel(*run, wanted); });
  if (!channel) return fail(kUsage, channel.error());
  for (const auto& [name, text] : {std::pair{io::run_file::kChannelCsv, to_csv(*channel)},
                                   std::pair{io::run_file::kChannel, to_geojson(*channel)}}) {
    if (const auto written = write_product(options.out, options.run, name, text); !written)
      return fail(kInputOutput, written.error());
  }
  write_out(options.is_json || options.format == "json" ? to_json_text(*channel)
            : options.format == "csv"                   ? to_csv(*channel)
                                                        : to_table(*channel));
  return kDone;
}

// ---- polynya export

constexpr auto kExportExamples =
    "Examples:\n"
    "  polynya export runs/sawamura2017-fig4b --vtk paraview         open paraview/run.pvd in ParaView\n"
    "  polynya export runs/at-sea --geojson qgis --at 300            longitude, latitude from the scene's origin\n"
    "  polynya export runs/at-sea --geojson qgis --crs EPSG:3413     the polar stereographic of NSIDC\n"
    "  polynya export --scene runs/sawamura2017-fig4b --at 300       a scene that continues from there\n"
    "\n"
    "Exit codes: 0 done, 2 usage, 5 input/output.\n";

struct ExportOptions {
  std::string run;
  std::string vtk;           ///< folder; empty: no VTK files
  std::string geojson;       ///< folder; empty: no GeoJSON files
  std::optional<double> at;  ///< instant of the GeoJSON [s]; none: the end
  int every = 1;             ///< only each N-th frame is written as VTK
  bool is_scene = false;     ///< write a scene that continues the run
  std::string out;           ///< folder for that scene; empty: a folder in the run's folder
  ProgressKind progress = ProgressKind::kAuto;
  bool is_in_metres = false;  ///< GeoJSON in the scene's plane although the scene has an origin
  views::LayerPlane plane;    ///< plane of the GeoJSON otherwise
};

int write_vtk(const io::Run& run, const ExportOptions& options) {
  if (const auto made = make_folder(options.vtk); !made) return fail(kInputOutput, made.error());
  io::FrameSelection selection;
  selection.every = options.every;
  const auto written = with_progress(options.progress, "writing the frames",
                                     [&] { return views::export_vtk(run, selection, options.vtk); });
  if (!written) return fail(kInputOutput, written.error());
  if (const std::size_t count = written->only_outlines.size(); count > 0)
    print_err(
        "note: {} without triangles, only with outlines, since the rings bound no valid area; the first is "
        "floe {}; polynya inspect {} --check lists what is wrong\n",
        counted(count, "floe"), written->only_outlines.front(), options.run);
  print_out("{}  {}; open it in ParaView\n", (fs::path(options.vtk) / "run.pvd").string(),
            counted(written->frames, "frame"));
  return kDone;
}

/// Writes files to a folder, which is created if necessary, and prints their paths.
int write_files(const fs::path& folder, const std::vector<std::pair<std::string, std::string>>& files) {
  if (const auto made = make_folder(folder); !made) return fail(kInputOutput, made.error());
  for (const auto& [name, text] : files) {
    if (const auto written = io::write_named_file(folder / name, text); !written)
      return fail(kInputOutput, written.error());
    write_out((folder / name).string() + "\n");
  }
  return kDone;
}

int write_geojson(const io::Run& run, double time, const ExportOptions& options) {
  views::LayerPlane plane = options.plane;
  const bool has_origin = run.scene.scene.origin.has_value();
  if (!has_origin && !plane.system.empty())
    return fail(kUsage, fmt::format("--crs {}: the scene has no \"origin\", so its place on the Earth is not known; "
                                    "add an \"origin\" to the scene, or leave --crs out",
                                    plane.system));
  if (!has_origin && !options.is_in_metres)
    print_err("note: the scene has no \"origin\"; coordinates are metres in its plane\n");
  if (has_origin && !options.is_in_metres && plane.system.empty()) plane.system = io::kDegreesOnEarth;
  const auto layers =
      with_progress(options.progress, "making the layers", [&] { return views::geojson_layers(run, time, plane); });
  if (!layers) return fail(kInputOutput, layers.error() + "; --metres writes the scene's plane");
  return write_files(options.geojson, *layers);
}

/// Writes a scene that starts with the state of the run at a time [s].
int write_scene(const io::Run& run, double time, const ExportOptions& options) {
  const auto scene =
      with_progress(options.progress, "making the scene", [&] { return views::continued_scene(run, time); });
  if (!scene) return fail(kInputOutput, scene.error());
  const fs::path folder =
      options.out.empty() ? fs::path(options.run) / fmt::format("from-{:g}s", scene->time) : fs::path(options.out);
  if (const int code = write_files(folder, scene->files); code != kDone) return code;
  if (scene->time != time) print_err("note: as of the frame at {:g} s\n", scene->time);
  for (const std::string& words : scene->left_out) print_err("note: not in the scene: {}\n", words);
  return kDone;
}

int export_run(const ExportOptions& options) {
  if (options.vtk.empty() && options.geojson.empty() && !options.is_scene)
    return fail(kUsage, "give --vtk DIR (for ParaView), --geojson DIR (for QGIS) or --scene (to continue the run)");
  const auto run = read_run(options.run, options.progress);
  if (!run) return fail(kInputOutput, run.error());
  const bool has_instant = !options.geojson.empty() || options.is_scene;
  const double time = options.at.value_or(run->end_time());
  int code = kDone;
  if (!options.vtk.empty()) code = write_vtk(*run, options);
  if (code == kDone && has_instant && !(time >= run->start_time() && time <= run->end_time()))
    return fail(kUsage,
                fmt::format("--at {:g}: the run goes from {:g} to {:g} s", time, run->start_time(), run->end_time()));
  if (code == kDone && !options.geojson.empty()) code = write_geojson(*run, time, options);
  if (code == kDone && options.is_scene) code = write_scene(*run, time, options);
  return code;
}

// ---- polynya inspect

constexpr auto kInspectExamples =
    "Examples:\n"
    "  polynya inspect runs/level-plate                        the floes at the end, one per line\n"
    "  polynya inspect runs/level-plate --at 30                at 30 s\n"
    "  polynya inspect runs/level-plate --floe 17 --format geojson > floe-17.geojson\n"
    "  polynya inspect runs/level-plate --lineage 17           the fractures that led to floe 17\n"
    "  polynya inspect runs/level-plate --events               fractures, contacts of ships, ice under hulls\n"
    "  polynya inspect runs/level-plate --check                check files, polygons, areas and overlaps\n"
    "  polynya inspect runs/level-plate --fsd                  floe size distribution\n"
    "  polynya inspect runs/level-plate --accounts             where ice, energy and momentum went\n"
    "  polynya inspect runs/level-plate --json                 any of these except a shape as JSON\n"
    "\n"
    "Exit codes: 0 done, 2 usage, 4 --check found the run not sound, 5 input/output.\n";

struct InspectOptions {
  std::string run;
  std::optional<double> at;       ///< [s]; none: the end of the run
  std::optional<FloeId> floe;     ///< floe whose shape is printed
  bool is_geojson = false;        ///< true: GeoJSON; false: WKT
  std::optional<FloeId> lineage;  ///< floe whose lineage is printed
  bool events = false;
  bool check = false;
  bool fsd = false;
  bool accounts = false;
  ProgressKind progress = ProgressKind::kAuto;
  bool json = false;  ///< the report as JSON; the shape of a floe has its own formats
};

std::string unknown_floe(const io::Run& run, FloeId id) {
  return fmt::format("there is no floe {}; the run has floes 0 to {}", id, std::ssize(run.floes) - 1);
}

int print_floe(const io::Run& run, const InspectOptions& options) {
  const io::RunFloe* floe = run.floe(*options.floe);
  if (!floe) return fail(kUsage, unknown_floe(run, *options.floe));
  analysis::ShapeView view{
      floe->birth, ice_of(run.scene.scene, floe->birth.own_ice), *run.shape(*options.floe), {}, run.scene.scene.origin};
  if (options.at) {
    if (!run.is_alive(floe->birth.floe, *options.at)) {
      const std::string end = floe->death_event ? fmt::format("to {:g} s", floe->died) : std::string("to the end");
      return fail(kUsage, fmt::format("floe {} lived from {:g} s {}", *options.floe, floe->birth.time, end));
    }
    const auto motion = io::MotionIndex(run).floe_at(floe->birth.floe, *options.at);
    if (!motion) {
      return fail(kUsage, fmt::format("floe {} lived from {:g} to {:g} s, between two frames: where is not on record",
                                      *options.floe, floe->birth.time, floe->died));
    }
    view.polygon = polygon_in_world(view.polygon, floe->birth.centroid_in_body, *motion);
    view.time_in_world = options.at;
  }
  std::string text;
  io::append_wkt(text, view.polygon);
  if (!view.time_in_world && !options.is_geojson)
    print_err("note: floe {} in its body frame [m]; --at T gives it where it was in the world at T\n", *options.floe);
  write_out(options.is_geojson ? to_geojson(view) : text + "\n");
  return kDone;
}

int print(const io::Run& run, const InspectOptions& options) {
  if (options.at && !(*options.at >= run.start_time() && *options.at <= run.end_time())) {
    return fail(kUsage, fmt::format("--at {:g}: the run goes from {:g} to {:g} s", *options.at, run.start_time(),
                                    run.end_time()));
  }
  const double time = options.at.value_or(run.end_time());
  if (options.floe) return print_floe(run, options);
  int code = kDone;
  if (options.lineage) {
    if (!run.floe(*options.lineage)) return fail(kUsage, unknown_floe(run, *options.lineage));
    write_out(options.json ? analysis::lineage_json(run, *options.lineage)
                           : analysis::lineage_tree(run, *options.lineage));
  } else if (options.events) {
    write_out(options.json ? analysis::events_json(run) : analysis::event_list(run));
  } else if (options.check) {
    const auto check = with_progress(options.progress, "checking the run", [&](WorkProgress& progress) {
      return analysis::check_run(run, options.at, [&](double part) { progress.set_part(part); });
    });
    write_out(options.json ? to_json_text(check, run.scene.scene) : to_text(check, run.scene.scene));
    code = check.is_sound() ? kDone : kRefused;
  } else if (options.fsd) {
    write_out(options.json ? analysis::sizes_json(run, time) : analysis::size_table(run, time));
  } else if (options.accounts) {
    write_out(options.json ? analysis::accounts_json(run) : analysis::account_table(run));
  } else {
    write_out(options.json ? analysis::floes_json(run, time) : analysis::floe_table(run, time));
  }
  return code;
}

int inspect(const InspectOptions& options) {
  const auto run = read_run(options.run, options.progress);
  return run ? print(*run, options) : fail(kInputOutput, run.error());
}

// ---- polynya view

/// Time between two looks at the scene's file with --watch.
constexpr auto kBetweenLooks = std::chrono::milliseconds(300);

/// Writes the page of a scene, and with `watch` the script by which open pages learn of the new version.
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

/// `polynya view SCENE.json --live`: writes the page that contains the simulator with this scene. The floes of its floe
/// files are included.
int write_live_view(const std::string& file, const std::string& out) {
  const std::string to = out.empty() ? fs::path(file).replace_extension(".html").string() : out;
  const auto scene = io::read_scene_file(file);
  print_lines(scene ? scene->hints : scene.error());
  if (!scene) return kSceneInvalid;
  const auto text = io::read_text_file(file, io::kLongestScene);
  if (!text) return fail(kInputOutput, fmt::format("{}: {}", file, text.error()));
  const auto page = live_page(scene->files.empty() ? *text : scene->resolved_text);
  if (!page) return fail(kInputOutput, page.error());
  if (const auto written = write_output(to, *page); !written) return fail(kInputOutput, written.error());
  (is_stdout(to) ? write_err : write_out)(fmt::format("{}  {:.1f} MB, with the simulator; open it in a browser\n", to,
                                                      static_cast<double>(page->size()) / 1e6));
  flush_out();
  return kDone;
}

/// `polynya view SCENE.json`: writes the page of a scene that has not run, as SCENE.html beside the scene if `out` is
/// empty. With `watch` it is written again each time the scene's file changes, until a signal stops the program.
int write_scene_view(const std::string& scene, const std::string& out, bool watch) {
  const std::string page = out.empty() ? fs::path(scene).replace_extension(".html").string() : out;
  int code = write_once(scene, page, watch);
  if (!watch || code == kInputOutput) return code;
  watch_signals();
  std::error_code error;
  for (auto last = fs::last_write_time(scene, error); stop_signal() == 0; std::this_thread::sleep_for(kBetweenLooks)) {
    const auto now = fs::last_write_time(scene, error);  // editors may remove the file for a moment while they save it
    if (error || now == last) continue;
    last = now;
    code = write_once(scene, page, watch);  // errors are printed on stderr, and the page stays unchanged
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
    "  polynya view scene.json --watch                         a scene before it runs; written again when its file is "
    "saved\n"
    "  polynya view scene.json --live                          a page that contains the simulator and runs the scene\n"
    "\n"
    "Exit codes: 0 done, 2 usage (also: larger than --limit), 5 input/output.\n";

struct ViewOptions {
  std::vector<std::string> runs;    ///< one run, or two that are shown side by side
  std::vector<std::string> labels;  ///< names of two runs; empty: they are chosen
  std::string out;                  ///< empty: view.html in the run's folder
  views::PlayerSelection part;
  std::vector<double> area;     ///< x0, y0, x1, y1 [m]; it becomes part of `part` after checking
  bool is_watched = false;      ///< write the page of a scene again when its file changes
  bool is_live = false;         ///< write the page that contains the simulator
  double most_megabytes = 100;  ///< a larger page is refused [10⁶ bytes]
};

/// A run that was read, with the data for its page.
struct ViewedRun {
  io::Run run;
  views::PlayerData data;
};

Outcome<ViewedRun> read_viewed(const std::string& folder, const views::PlayerSelection& part) {
  auto run = io::read_run(folder);
  if (!run) return failure(kInputOutput, run.error());
  views::PlayerData data = views::player_data(*run, part);
  if (data.frames == 0 && !run->frames.empty())
    return failure(kUsage, fmt::format("{} has no frame in that part; its frames are from {:g} to {:g} s", folder,
                                       run->start_time(), run->end_time()));
  if (data.floes == 0 && !run->floes.empty())
    return failure(kUsage, fmt::format("no floe of {} comes within --area", folder));
  return ViewedRun{std::move(*run), std::move(data)};
}

/// Returns names for two runs: the names of their scenes, or their folders, or their whole paths, whichever is the
/// first to differ.
std::array<std::string, 2> labels_of(const std::vector<ViewedRun>& viewed, const ViewOptions& options) {
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

std::string page_of(const std::vector<ViewedRun>& viewed, const ViewOptions& options) {
  if (viewed.size() == 1) return player_page(viewed[0].run, viewed[0].data);
  const auto labels = labels_of(viewed, options);
  return views::pair_page({{{viewed[0].data, labels[0]}, {viewed[1].data, labels[1]}}});
}

/// Says what makes a page too large, and which options leave parts of it out.
std::string too_large(const std::vector<ViewedRun>& viewed, const ViewOptions& options, double megabytes) {
  std::size_t floes = 0, frames = 0, floe_bytes = 0, frame_bytes = 0;
  for (const auto& [run, data] : viewed) {
    floes += data.floes, frames += data.frames;
    floe_bytes += data.floe_bytes, frame_bytes += data.frame_bytes;
  }
  // Base64 makes them longer by a third.
  const auto in_page = [](std::size_t bytes) { return static_cast<double>(bytes) * 4 / 3 / 1e6; };
  return fmt::format(
      "the page would have {:.0f} MB, more than --limit {:g}: {:.3g} MB are shapes of {} (--area keeps fewer), {:.3g} "
      "MB are positions in {} (--every, --from and --until keep fewer); or give --limit {:.0f}",
      megabytes, options.most_megabytes, in_page(floe_bytes), counted(floes, "floe"), in_page(frame_bytes),
      counted(frames, "frame"), std::ceil(megabytes));
}

/// Returns a message about options that contradict each other; empty if there is none.
std::string problem_of(const ViewOptions& options) {
  if (options.runs.size() == 2 && options.out.empty()) return "two runs need --out FILE for their page";
  if (!options.labels.empty() && (options.runs.size() != 2 || options.labels.size() != 2))
    return fmt::format("--label: {} for {}; two names for two runs", counted(options.labels.size(), "name"),
                       counted(options.runs.size(), "run"));
  if (const auto& a = options.area; !a.empty() && (a[0] >= a[2] || a[1] >= a[3]))
    return "--area: X0,Y0,X1,Y1, X0 below X1 and Y0 below Y1";
  return "";
}

/// Returns "276 frames, 491 floes, 356 events", for several runs one after the other.
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
  const bool is_scene = options.runs.size() == 1 && first.extension() == ".json" && !fs::is_directory(first);
  if (options.is_live && !is_scene) return fail(kUsage, "--live: takes a scene, SCENE.json");
  if (options.is_live) return write_live_view(options.runs[0], options.out);
  if (is_scene) return write_scene_view(options.runs[0], options.out, options.is_watched);
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

Command add_channel(CommandLine& app) {
  CommandLine command = app.add_command("channel", "Measure the channel behind a ship", kChannelExamples);
  auto options = std::make_shared<MeasureOptions>();
  add_run_folder(command, options->run);
  command.option("--at", &options->measure.time, "S", "Time [s]; the end of the run if not given", finite());
  command.option("--ship", &options->ship, "NAME", "Name of the ship; the first one if not given");
  command.option("--spacing", &options->measure.spacing, "M",
                 "Length of a station along the track [m]; the ship's beam if not given", between(0.1, 1e5));
  command.option("--reach", &options->measure.reach, "M",
                 "Distance to either side of the track within which ice is searched [m]; four beams if not given",
                 between(0.1, 1e5));
  command.choice<std::string>("--format", options->format, "Format of the output on stdout; json is the same as --json",
                              {{"table", "table"}, {"csv", "csv"}, {"json", "json"}});
  command.flag("--json", options->is_json, "Print totals as JSON instead of the table", {.excludes = {"--format"}});
  command.option("--out", &options->out, "DIR",
                 "Folder for channel.csv and channel.geojson; the run folder if not given");
  add_progress(command, options->progress);
  return {command, [options] { return measure(*options); }};
}

Command add_export(CommandLine& app) {
  CommandLine command =
      app.add_command("export", "Write a run for ParaView or QGIS, or a scene that continues it", kExportExamples);
  auto options = std::make_shared<ExportOptions>();
  add_run_folder(command, options->run);
  command.option("--vtk", &options->vtk, "DIR", "Folder for run.pvd and its .vtp frames");
  command.option("--every", &options->every, "N", "Write only each N-th frame, and the last one, as VTK",
                 whole(1, 1000000));
  command.option("--geojson", &options->geojson, "DIR",
                 "Folder for floes, fractures, tracks and channel as GeoJSON, in longitude and latitude if the scene "
                 "has an origin, otherwise in metres");
  command.option("--at", &options->at, "S", "Time of the GeoJSON and of the scene [s]; the end of the run if not given",
                 finite());
  command.flag("--scene", options->is_scene,
               "Write a scene (scene.json and floes.geojson) that continues from the state of the run at that time");
  command.option("--out", &options->out, "DIR", "Folder for the scene; a folder in the run folder if not given",
                 not_empty());
  command.flag("--metres", options->is_in_metres, "GeoJSON in metres even if the scene has an origin");
  command.option("--crs", &options->plane.system, "EPSG:n",
                 "GeoJSON in this coordinate system instead of longitude and latitude on WGS 84", not_empty(),
                 {.excludes = {"--metres"}});
  command.option("--tolerance", &options->plane.tolerance, "M",
                 "Add points to edges that are not straight in the GeoJSON's coordinates until they are within this "
                 "distance of their true course [m]; 0: none",
                 between(0, 1e5));
  add_progress(command, options->progress);
  return {command, [options] { return export_run(*options); }};
}

Command add_inspect(CommandLine& app) {
  CommandLine command =
      app.add_command("inspect", "Show floes, events and balances of a run, or check it", kInspectExamples);
  auto options = std::make_shared<InspectOptions>();
  add_run_folder(command, options->run);
  command.option("--at", &options->at, "T", "Time [s]; the end of the run if not given", finite());
  command.option("--floe", &options->floe, "N",
                 "Shape of a floe: in its body frame, or with --at at its place in the world");
  command.option("--lineage", &options->lineage, "N", "Tree of the fractures that led to a floe", {},
                 {.excludes = {"--floe"}});
  command.flag("--events", options->events, "All events of the run: fractures, contacts of ships, broken moorings",
               {.excludes = {"--floe", "--lineage"}});
  command.flag("--check", options->check, "Check files, polygons, areas, overlaps and final positions of the whole run",
               {.excludes = {"--floe", "--lineage", "--events"}});
  command.flag("--fsd", options->fsd, "Floe size distribution",
               {.excludes = {"--floe", "--lineage", "--events", "--check"}});
  command.flag("--accounts", options->accounts, "Balances of ice, energy, moorings and momentum at the end",
               {.excludes = {"--at", "--floe", "--lineage", "--events", "--check", "--fsd"}});
  command.choice<bool>("--format", options->is_geojson, "Format of the shape of --floe; wkt if not given",
                       {{"wkt", false}, {"geojson", true}}, {.needs = "--floe"});
  command.flag("--json", options->json, "Print the report as JSON; for a shape use --format geojson",
               {.excludes = {"--floe"}});
  add_progress(command, options->progress);
  return {command, [options] { return inspect(*options); }};
}

Command add_view(CommandLine& app) {
  CommandLine command = app.add_command(
      "view",
      "Write a page that plays a run, or two runs side by side, or shows a scene, in any browser without a network",
      kViewExamples);
  auto options = std::make_shared<ViewOptions>();
  command.option("run", &options->runs, "RUN",
                 "A run folder, two run folders to be shown side by side, or a scene file, SCENE.json", {},
                 {.is_required = true, .most = 2});
  command.option("--out", &options->out, "FILE",
                 "File for the page; if not given, view.html in the run folder, or SCENE.html beside the scene");
  command.flag("--watch", options->is_watched,
               "For a scene: write the page again whenever the file is saved, until Ctrl-C");
  command.flag("--live", options->is_live, "For a scene: a page that contains the simulator and runs the scene",
               {.excludes = {"--watch"}});
  command.option("--label", &options->labels, "NAME,NAME", "Names of the two runs on the page", {}, {.delimiter = ','});
  command.option("--every", &options->part.frames.every, "N", "Keep only each N-th frame, and the last one",
                 whole(1, 1000000));
  command.option("--from", &options->part.frames.from, "S", "Show the run only from this time on [s]", finite());
  command.option("--until", &options->part.frames.until, "S", "Show the run only up to this time [s]", finite());
  command.option(
      "--area", &options->area, "X0,Y0,X1,Y1",
      "Keep only floes that come within this part of the world [m], and floes from the same floes of the scene",
      finite(), {.delimiter = ',', .least = 4, .most = 4});
  command.option("--limit", &options->most_megabytes, "MB", "Refuse a page larger than this [MB]; 100 if not given",
                 between(0.001, 2000));
  return {command, [options] { return write_view(*options); }};
}

/// Checks a run folder by reading it. Commands in Python call this before they read the folder themselves. The help
/// does not list it.
Command add_read_run(CommandLine& app) {
  CommandLine command = app.add_command("read-run", "", "");
  auto folder = std::make_shared<std::string>();
  add_run_folder(command, *folder);
  return {command, [folder]() -> int {
            const auto run = io::read_run(*folder);
            if (run) return kDone;
            print_err("{}\n", run.error());
            return kInputOutput;
          }};
}

}  // namespace polynya::app
