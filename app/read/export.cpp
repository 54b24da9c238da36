#include <filesystem>
#include <memory>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "app/command_line/files.hpp"
#include "io/text/output_file.hpp"
#include "views/export/geojson_export.hpp"
#include "views/export/scene_export.hpp"
#include "views/export/vtk_export.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

constexpr auto kExportExamples =
    "Examples:\n"
    "  polynya export runs/sawamura2017-fig4b --vtk paraview         open paraview/run.pvd in ParaView\n"
    "  polynya export runs/at-sea --geojson qgis --at 300            longitude, latitude from the scene's "
    "origin\n"
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

}  // namespace

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

}  // namespace polynya::app
