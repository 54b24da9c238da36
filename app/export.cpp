#include <filesystem>

#include "app/console.hpp"
#include "app/exit_code.hpp"
#include "app/run_commands.hpp"
#include "io/text/output_file.hpp"
#include "views/export/geojson_export.hpp"
#include "views/export/vtk_export.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

int fail(ExitCode code, const std::string& words) {
  print_err("polynya: {}\n", words);
  return code;
}

/// Makes a folder; what went wrong, or empty.
std::string make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  return error ? fmt::format("{}: {}", folder.string(), error.message()) : "";
}

int write_vtk(const io::Run& run, const ExportOptions& options) {
  if (const std::string wrong = make_folder(options.vtk); !wrong.empty()) return fail(kInputOutput, wrong);
  io::FrameSelection selection;
  selection.every = options.every;
  const auto written = views::export_vtk(run, selection, options.vtk);
  if (!written) return fail(kInputOutput, written.error());
  if (const std::size_t count = written->only_outlines.size(); count > 0)
    print_err(
        "note: {} floe{} without triangles, only with outlines, since the rings bound no valid area; the "
        "first is "
        "floe {}; polynya inspect {} --check lists what is wrong\n",
        count, count == 1 ? "" : "s", written->only_outlines.front(), options.run);
  print_out("{}  {} frames; open it in ParaView\n", (fs::path(options.vtk) / "run.pvd").string(),
            written->frames);
  return kDone;
}

int write_geojson(const io::Run& run, const ExportOptions& options) {
  const double time = options.at.value_or(run.end_time());
  if (!(time >= run.start_time() && time <= run.end_time()))
    return fail(kUsage, fmt::format("--at {:g}: the run goes from {:g} to {:g} s", time, run.start_time(),
                                    run.end_time()));
  if (const std::string wrong = make_folder(options.geojson); !wrong.empty())
    return fail(kInputOutput, wrong);
  auto origin = run.scene.scene.origin;
  if (options.is_in_metres) origin.reset();
  if (!origin && !options.is_in_metres)
    print_err("note: the scene has no \"origin\"; coordinates are metres in its plane\n");
  for (const auto& [name, text] : views::geojson_layers(run, time, origin)) {
    const fs::path file = fs::path(options.geojson) / name;
    if (const std::string wrong = io::write_named_file(file, text); !wrong.empty())
      return fail(kInputOutput, wrong);
    write_out(file.string() + "\n");
  }
  return kDone;
}

}  // namespace

int export_run(const ExportOptions& options) {
  if (options.vtk.empty() && options.geojson.empty())
    return fail(kUsage, "export what? --vtk DIR for ParaView, --geojson DIR for QGIS");
  const auto run = io::read_run(options.run);
  if (!run) return fail(kInputOutput, run.error());
  int code = kDone;
  if (!options.vtk.empty()) code = write_vtk(*run, options);
  if (code == kDone && !options.geojson.empty()) code = write_geojson(*run, options);
  return code;
}

}  // namespace polynya::app
