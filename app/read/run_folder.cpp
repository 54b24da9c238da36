#include "io/run/run_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/channel.hpp"
#include "analysis/run_check.hpp"
#include "analysis/run_listing.hpp"
#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "io/run/motion_index.hpp"
#include "io/scene/floe_ice.hpp"
#include "io/text/output_file.hpp"
#include "io/text/wkt.hpp"
#include "views/export/export.hpp"

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
  std::string out;  ///< folder for channel.csv and channel.geojson; empty: the run's
  std::string ship;
  analysis::ChannelOptions measure;
  std::string format = "table";  ///< of stdout
  bool is_json = false;          ///< likewise
  ProgressKind progress = ProgressKind::kAuto;
};

int measure(const MeasureOptions& options) {
  const auto run = read_run(options.run, options.progress);
  if (!run) return fail(kInputOutput, run.error());
  analysis::ChannelOptions wanted = options.measure;
  if (!options.ship.empty()) {
    const int ship = hull_named(run->scene.scene, options.ship);
    if (ship < 0) return fail(kUsage, fmt::format("the run has no ship \"{}\"", options.ship));
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
    "  polynya export --scene runs/sawamura2017-fig4b --at 300       a scene that continues from there\n"
    "\n"
    "Exit codes: 0 done, 2 usage, 5 input/output.\n";

struct ExportOptions {
  std::string run;
  std::string vtk;           ///< folder; empty: none
  std::string geojson;       ///< folder; empty: none
  std::optional<double> at;  ///< instant of the GeoJSON [s]; the end if not given
  int every = 1;             ///< of VTK: each N-th frame
  bool is_scene = false;     ///< a scene that continues the run
  std::string out;           ///< folder of that; empty: one in the run's
  ProgressKind progress = ProgressKind::kAuto;
  bool is_in_metres = false;  ///< GeoJSON in the scene's plane though it has an origin
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

/// Into a folder that is made where it is missing; prints their paths.
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
  io::Project project;
  if (const auto& origin = run.scene.scene.origin; origin && !options.is_in_metres) {
    auto degrees = views::degrees_about(*origin);
    if (!degrees) return fail(kInputOutput, degrees.error() + "; --metres writes the scene's plane");
    project = std::move(*degrees);
  } else if (!options.is_in_metres) {
    print_err("note: the scene has no \"origin\"; coordinates are metres in its plane\n");
  }
  return write_files(options.geojson, with_progress(options.progress, "making the layers",
                                                    [&] { return views::geojson_layers(run, time, project); }));
}

/// A scene of its own that starts where the run was then.
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
    return fail(kUsage,
                "--vtk DIR (for ParaView), --geojson DIR (for QGIS) or --scene (to continue the run) is needed");
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

enum class ShapeFormat { kWkt, kGeojson };

std::string to_text(const analysis::ShapeView& view, ShapeFormat format) {
  if (format == ShapeFormat::kGeojson) return to_geojson(view);
  std::string text;
  io::append_wkt(text, view.polygon);
  return text + "\n";
}

constexpr auto kInspectExamples =
    "Examples:\n"
    "  polynya inspect runs/level-plate                        the floes at the end, a line each\n"
    "  polynya inspect runs/level-plate --at 30                at 30 s\n"
    "  polynya inspect runs/level-plate --floe 17 --format geojson > floe-17.geojson\n"
    "  polynya inspect runs/level-plate --lineage 17           the fractures that led to it\n"
    "  polynya inspect runs/level-plate --events               what broke, met and went under\n"
    "  polynya inspect runs/level-plate --check                validity, areas, overlaps, exactly\n"
    "  polynya inspect runs/level-plate --fsd                  floe size distribution\n"
    "  polynya inspect runs/level-plate --json                 each of these but a shape as JSON\n"
    "\n"
    "Exit codes: 0 done, 2 usage, 4 --check found a shape or an area wrong, 5 input/output.\n";

struct InspectOptions {
  std::string run;
  std::optional<double> at;    ///< [s]; the end of the run if not given
  std::optional<FloeId> floe;  ///< its shape
  ShapeFormat format = ShapeFormat::kWkt;
  std::optional<FloeId> lineage;  ///< the fractures that led to it
  bool events = false;
  bool check = false;
  bool fsd = false;
  ProgressKind progress = ProgressKind::kAuto;
  bool json = false;  ///< the report as JSON; a floe's shape has its own formats
};

std::string unknown_floe(const io::Run& run, FloeId id) {
  return fmt::format("there is no floe {}; they go from 0 to {}", id, std::ssize(run.floes) - 1);
}

int print_floe(const io::Run& run, const InspectOptions& options) {
  const io::RunFloe* floe = run.floe(*options.floe);
  if (!floe) return fail(kUsage, unknown_floe(run, *options.floe));
  analysis::ShapeView view{floe->birth, ice_of(run.scene.scene, floe->birth.own_ice), *run.shape(*options.floe), {}};
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
  if (!view.time_in_world && options.format == ShapeFormat::kWkt)
    print_err("note: floe {} in its body frame [m]; --at T gives it where it was in the world at T\n", *options.floe);
  write_out(to_text(view, options.format));
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
  } else {
    write_out(options.json ? analysis::floes_json(run, time) : analysis::floe_table(run, time));
  }
  return code;
}

int inspect(const InspectOptions& options) {
  const auto run = read_run(options.run, options.progress);
  return run ? print(*run, options) : fail(kInputOutput, run.error());
}

}  // namespace

Command add_channel(CommandLine& app) {
  CommandLine command = app.add_command("channel", "Measure the channel behind a ship", kChannelExamples);
  auto options = std::make_shared<MeasureOptions>();
  add_run_folder(command, options->run);
  command.option("--at", &options->measure.time, "S", "At that time instead of the end [s]", finite());
  command.option("--ship", &options->ship, "NAME", "Which ship; the first one if not given");
  command.option("--spacing", &options->measure.spacing, "M", "Length of a station [m]; the beam if not given",
                 between(0.1, 1e5));
  command.option("--reach", &options->measure.reach, "M",
                 "How far from the track ice is searched [m]; four beams if not given", between(0.1, 1e5));
  command.choice<std::string>("--format", options->format, "What stdout gets; json: as --json",
                              {{"table", "table"}, {"csv", "csv"}, {"json", "json"}});
  command.flag("--json", options->is_json, "Print the sums as JSON instead of the table", {.excludes = {"--format"}});
  command.option("--out", &options->out, "DIR", "Folder for channel.csv and channel.geojson; the run's if not given");
  add_progress(command, options->progress);
  return {command, [options] { return measure(*options); }};
}

Command add_export(CommandLine& app) {
  CommandLine command =
      app.add_command("export", "Write a run for ParaView or QGIS, or a scene that continues it", kExportExamples);
  auto options = std::make_shared<ExportOptions>();
  add_run_folder(command, options->run);
  command.option("--vtk", &options->vtk, "DIR", "Folder for run.pvd and its .vtp frames");
  command.option("--every", &options->every, "N", "Of VTK only each N-th frame, and the last", whole(1, 1000000));
  command.option("--geojson", &options->geojson, "DIR",
                 "Folder for floes, fractures, tracks and channel as GeoJSON: longitude and latitude where the "
                 "scene has an origin, metres where not");
  command.option("--at", &options->at, "S", "Instant of GeoJSON and scene [s]; the end if not given", finite());
  command.flag("--scene", options->is_scene,
               "A scene of its own, scene.json and floes.geojson, that starts where the run was then");
  command.option("--out", &options->out, "DIR", "Folder of the scene; one in the run's if not given", not_empty());
  command.flag("--metres", options->is_in_metres, "GeoJSON in metres though the scene has an origin");
  add_progress(command, options->progress);
  return {command, [options] { return export_run(*options); }};
}

Command add_inspect(CommandLine& app) {
  CommandLine command = app.add_command("inspect", "Show the floes of a run", kInspectExamples);
  auto options = std::make_shared<InspectOptions>();
  add_run_folder(command, options->run);
  command.option("--at", &options->at, "T", "At that time; the end of the run if not given [s]", finite());
  command.option("--floe", &options->floe, "N",
                 "The shape of one floe: in its body frame, or with --at where it was in the world");
  command.option("--lineage", &options->lineage, "N", "The tree of fractures that led to a floe", {},
                 {.excludes = {"--floe"}});
  command.flag("--events", options->events, "Every event of the run: fractures, ships that meet, moorings that break",
               {.excludes = {"--floe", "--lineage"}});
  command.flag("--check", options->check, "Re-derive validity, areas and overlaps of the whole run",
               {.excludes = {"--floe", "--lineage", "--events"}});
  command.flag("--fsd", options->fsd, "The distribution of floe sizes",
               {.excludes = {"--floe", "--lineage", "--events", "--check"}});
  command.choice<ShapeFormat>("--format", options->format, "Of --floe; wkt if not given",
                              {{"wkt", ShapeFormat::kWkt}, {"geojson", ShapeFormat::kGeojson}}, {.needs = "--floe"});
  command.flag("--json", options->json, "Print the report as JSON; a shape: --format geojson",
               {.excludes = {"--floe"}});
  add_progress(command, options->progress);
  return {command, [options] { return inspect(*options); }};
}

}  // namespace polynya::app
