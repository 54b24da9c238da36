#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "app/console.hpp"
#include "app/exit_code.hpp"
#include "app/geometry_commands.hpp"
#include "app/inspect_json.hpp"
#include "app/inspect_views.hpp"
#include "io/run/motion_index.hpp"

namespace polynya::app {
namespace {

using simulation::FloeId;

int usage_error(const std::string& words) {
  print_err("polynya: {}\n", words);
  return kUsage;
}

std::string unknown_floe(const io::Run& run, FloeId id) {
  return fmt::format("there is no floe {}; they go from 0 to {}", id, std::ssize(run.floes) - 1);
}

int print_floe(const io::Run& run, const InspectOptions& options) {
  const io::RunFloe* floe = run.floe(*options.floe);
  if (!floe) return usage_error(unknown_floe(run, *options.floe));
  ShapeView view{floe->birth, *run.shape(*options.floe), {}};
  if (options.at) {
    if (!run.is_alive(floe->birth.floe, *options.at)) {
      const std::string end =
          floe->death_event ? fmt::format("to {:g} s", floe->died) : std::string("to the end");
      return usage_error(fmt::format("floe {} lived from {:g} s {}", *options.floe, floe->birth.time, end));
    }
    const auto motion = io::MotionIndex(run).floe_at(floe->birth.floe, *options.at);
    if (!motion) {
      return usage_error(
          fmt::format("floe {} lived from {:g} to {:g} s, between two frames: where is not on record",
                      *options.floe, floe->birth.time, floe->died));
    }
    view.polygon = polygon_in_world(view.polygon, floe->birth.centroid_in_body, *motion);
    view.time_in_world = options.at;
  }
  write_out(to_text(view, options.format));
  return kDone;
}

int print(const io::Run& run, const InspectOptions& options) {
  if (options.at && !(*options.at >= run.start_time() && *options.at <= run.end_time())) {
    return usage_error(fmt::format("--at {:g}: the run goes from {:g} to {:g} s", *options.at,
                                   run.start_time(), run.end_time()));
  }
  const double time = options.at.value_or(run.end_time());
  if (options.floe) return print_floe(run, options);
  if (options.lineage) {
    if (!run.floe(*options.lineage)) return usage_error(unknown_floe(run, *options.lineage));
    write_out(options.json ? lineage_json(run, *options.lineage) : lineage_tree(run, *options.lineage));
    return kDone;
  }
  if (options.check) {
    const analysis::RunCheck check = analysis::check_run(run, options.at);
    write_out(options.json ? check_json(check) : check_text(check));
    return check.is_sound() ? kDone : kRefused;
  }
  if (options.fsd) {
    const SizeDistribution sizes = size_distribution(run, time);
    write_out(options.json ? size_json(sizes) : size_text(sizes));
    return kDone;
  }
  const std::vector<FloeRow> rows = floe_rows(run, time);
  write_out(options.json ? floes_json(rows, time) : floe_table(rows));
  return kDone;
}

}  // namespace

int inspect(const InspectOptions& options) {
  const auto run = io::read_run(options.run);
  if (!run) {
    print_err("polynya: {}\n", run.error());
    return kInputOutput;
  }
  return print(*run, options);
}

}  // namespace polynya::app
