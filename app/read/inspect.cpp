#include <memory>
#include <optional>
#include <vector>

#include "analysis/run_listing.hpp"
#include "analysis/run_report.hpp"
#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "app/command_line/files.hpp"
#include "io/import/floe_properties.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/floe_text.hpp"

namespace polynya::app {
namespace {

using simulation::FloeId;

enum class ShapeFormat { kWkt, kGeojson };

std::string to_text(const analysis::ShapeView& view, ShapeFormat format) {
  if (format == ShapeFormat::kGeojson) return to_geojson(view);
  std::string text;
  io::append_wkt(text, view.polygon);
  return text + "\n";
}

// ---- the command

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

analysis::RunCheck check_of(const io::Run& run, const InspectOptions& options) {
  return with_progress(options.progress, "checking the run", [&](WorkProgress& progress) {
    return analysis::check_run(run, options.at, [&](double part) { progress.set_part(part); });
  });
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
    const analysis::RunCheck check = check_of(run, options);
    write_out(options.json ? to_json_text(check, run.scene.scene) : to_text(check, run.scene.scene));
    code = check.is_sound() ? kDone : kRefused;
  } else if (options.fsd) {
    const analysis::SizeDistribution sizes = analysis::size_distribution(run, time);
    write_out(options.json ? to_json_text(sizes) : to_text(sizes));
  } else {
    const std::vector<analysis::FloeRow> rows = analysis::floe_rows(run, time);
    write_out(options.json ? floes_json(rows, time) : floe_table(rows));
  }
  return code;
}

int inspect(const InspectOptions& options) {
  const auto run = read_run(options.run, options.progress);
  return run ? print(*run, options) : fail(kInputOutput, run.error());
}

}  // namespace

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
