#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "analysis/run_report.hpp"
#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "app/command_line/files.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "io/run/event_records.hpp"
#include "io/run/motion_index.hpp"
#include "io/run/records.hpp"
#include "io/scene/floe_ice.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/wkt.hpp"

namespace polynya::app {
namespace {

using io::id_or_none;
using io::JsonWriter;
using simulation::FloeId;

enum class ShapeFormat { kWkt, kGeojson };

/// A floe's shape in its body frame, or in the world at a time.
struct ShapeView {
  const simulation::BirthRecord& birth;
  const fracture::Ice& ice;
  geometry::Polygon polygon;
  std::optional<double> time_in_world;  ///< [s]; none: the body frame
};
/// A floe alive at some time.
struct FloeRow {
  const simulation::BirthRecord& birth;
  const fracture::Ice& ice;
  double perimeter = 0;  ///< [m]
  std::size_t vertices = 0;
  std::size_t holes = 0;
  std::optional<double> speed;  ///< [m/s]; none between two frames
  std::string_view validity;    ///< "yes" or a defect's name
};
std::string_view validity_of(const geometry::Polygon& polygon) {
  const auto found = find_defect(polygon);
  return found ? name_of(found->defect) : "yes";
}

std::string as_geojson(const ShapeView& view) {
  const simulation::BirthRecord& birth = view.birth;
  return io::json_object([&](JsonWriter& json) {
    json.key("type").value("Feature").key("properties").open('{').key("floe_id").value(birth.floe);
    json.key("parent_id").value(id_or_none(birth.parent));
    json.key("born_s").value(birth.time).key("generation").value(birth.generation);
    json.key("area_m2").value(birth.area).key("mass_kg").value(birth.mass);
    io::append_ice(json, view.ice);
    json.key("frame").value(view.time_in_world ? "world" : "body");
    if (view.time_in_world) json.key("t_s").value(*view.time_in_world);
    json.close('}').key("geometry").polygon(view.polygon);
  });
}

/// What happened, where and what decided it, in a line.
std::string described(const io::Run& run, const simulation::Event& event) {
  const std::string_view ship = io::hull_name(run.scene.scene, event.ship);
  const bool is_by_floe = event.ice() && event.ice()->by_floe != simulation::kNoFloe;
  const std::string by = is_by_floe     ? fmt::format(" by floe {}", event.ice()->by_floe)
                         : ship.empty() ? ""
                                        : fmt::format(" {} {}", event.ice() ? "by" : "of", ship);
  return fmt::format("{:.6g} s  {}{} at ({:.3f}, {:.3f}): {}", event.time, name_of(event), by, event.point_in_world.x,
                     event.point_in_world.y, io::words_of(event, run.scene.scene));
}

/// A line of events.ndjson, without its end.
std::string json_of(const io::Run& run, const simulation::Event& event) {
  const io::RunFloe* floe = event.ice() ? run.floe(event.ice()->floe) : nullptr;
  std::string line;
  io::append_event(line, event, run.scene.scene, floe ? floe->birth.parent : simulation::kNoFloe);
  line.pop_back();
  return line;
}

/// In order of time; those of one time as they come in events.ndjson.
std::vector<simulation::Event> in_order(std::vector<simulation::Event> events) {
  std::ranges::stable_sort(events, {}, &simulation::Event::time);
  return events;
}

std::string to_text(const ShapeView& view, ShapeFormat format) {
  if (format == ShapeFormat::kGeojson) return as_geojson(view);
  std::string text;
  io::append_wkt(text, view.polygon);
  return text + "\n";
}

std::vector<FloeRow> floe_rows(const io::Run& run, double time) {
  const io::MotionIndex motions(run);
  std::vector<FloeRow> rows;
  for (const io::RunFloe& floe : run.floes) {
    const simulation::BirthRecord& birth = floe.birth;
    if (!run.is_alive(birth.floe, time)) continue;
    const auto polygon = run.shape(birth.floe);
    FloeRow& row = rows.emplace_back(FloeRow{.birth = birth,
                                             .ice = ice_of(run.scene.scene, birth.own_ice),
                                             .perimeter = perimeter(*polygon),
                                             .vertices = vertex_count(*polygon),
                                             .holes = polygon->holes.size(),
                                             .speed = {},
                                             .validity = validity_of(*polygon)});
    if (const auto motion = motions.floe_at(birth.floe, time)) row.speed = length(motion->velocity);
  }
  return rows;
}

std::string floe_table(const std::vector<FloeRow>& rows) {
  std::string text =
      fmt::format("{:>7} {:>7} {:>10} {:>14} {:>12} {:>8} {:>5} {:>12} {:>11} {:>9} {}\n", "floe", "parent", "born_s",
                  "area_m2", "perimeter_m", "vertices", "holes", "mass_kg", "thickness_m", "m_per_s", "valid");
  for (const FloeRow& row : rows) {
    const simulation::BirthRecord& birth = row.birth;
    text += fmt::format("{:>7} {:>7} {:>10.6g} {:>14.6f} {:>12.4f} {:>8} {:>5} {:>12.6g} {:>11.6g} {:>9} {}\n",
                        birth.floe, birth.parent == simulation::kNoFloe ? "-" : std::to_string(birth.parent),
                        birth.time, birth.area, row.perimeter, row.vertices, row.holes, birth.mass, row.ice.thickness,
                        row.speed ? fmt::format("{:.5f}", *row.speed) : "-", row.validity);
  }
  return text;
}

/// The trunk from the scene's floe down to this one: each fracture with what decided it, and the pieces beside.
std::string lineage_tree(const io::Run& run, FloeId floe) {
  std::string text;
  const std::vector<FloeId> ids = run.lineage(floe);
  for (const FloeId id : ids) {
    const io::RunFloe& at = *run.floe(id);
    text += fmt::format("floe {}  {:.6f} m2{}\n", id, at.birth.area,
                        at.birth.parent == simulation::kNoFloe ? "  as in the scene" : "");
    if (id == floe) {
      text += at.death_event ? fmt::format("broke at {:.6g} s\n", at.died) : "lives to the end\n";
      continue;
    }
    if (!at.death_event) continue;
    const simulation::Event& event = run.events[*at.death_event];
    text += fmt::format("|  {}\n", described(run, event));
    for (const FloeId child : event.ice()->children) {
      if (std::ranges::find(ids, child) == ids.end() && run.floe(child))
        text += fmt::format("|--floe {}  {:.6f} m2\n", child, run.floe(child)->birth.area);
    }
  }
  return text;
}

/// Every event of the run in a line, as time goes: of ice, of ships that meet, of moorings that break.
std::string event_list(const io::Run& run) {
  std::string text;
  for (const simulation::Event& event : in_order(run.events)) {
    text += described(run, event);
    if (event.ice()) text += fmt::format("  (floe {})", event.ice()->floe);
    text += '\n';
  }
  return text.empty() ? "no events\n" : text;
}

std::string events_json(const io::Run& run) {
  return io::json_object([&](JsonWriter& json) {
    json.key("events").open('[');
    for (const simulation::Event& event : in_order(run.events)) {
      json.start_line();
      json.json(json_of(run, event));
    }
    json.close(']');
  });
}

std::string floes_json(const std::vector<FloeRow>& rows, double time) {
  return io::json_object([&](JsonWriter& json) {
    json.key("t_s").value(time).key("floes").object_lines(rows, [&](const FloeRow& row) {
      json.key("floe_id").value(row.birth.floe).key("parent_id").value(id_or_none(row.birth.parent));
      json.key("born_s").value(row.birth.time).key("area_m2").value(row.birth.area);
      json.key("perimeter_m").value(row.perimeter).key("vertices").value(row.vertices);
      json.key("holes").value(row.holes).key("mass_kg").value(row.birth.mass);
      io::append_ice(json, row.ice);
      json.key("speed_m_per_s").value(row.speed).key("valid").value(row.validity);
    });
  });
}

/// The floes from the scene's down to this one; of each the fracture that broke it, as in events.ndjson.
std::string lineage_json(const io::Run& run, FloeId floe) {
  return io::json_object([&](JsonWriter& json) {
    json.key("floe_id").value(floe).key("lineage").object_lines(run.lineage(floe), [&](FloeId id) {
      const io::RunFloe& at = *run.floe(id);
      json.key("floe_id").value(id).key("born_s").value(at.birth.time).key("area_m2").value(at.birth.area);
      json.key("broken_by").json(at.death_event ? json_of(run, run.events[*at.death_event]) : "null");
    });
  });
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
  ShapeView view{floe->birth, ice_of(run.scene.scene, floe->birth.own_ice), *run.shape(*options.floe), {}};
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
    write_out(options.json ? lineage_json(run, *options.lineage) : lineage_tree(run, *options.lineage));
  } else if (options.events) {
    write_out(options.json ? events_json(run) : event_list(run));
  } else if (options.check) {
    const analysis::RunCheck check = check_of(run, options);
    write_out(options.json ? to_json_text(check, run.scene.scene) : to_text(check, run.scene.scene));
    code = check.is_sound() ? kDone : kRefused;
  } else if (options.fsd) {
    const analysis::SizeDistribution sizes = analysis::size_distribution(run, time);
    write_out(options.json ? to_json_text(sizes) : to_text(sizes));
  } else {
    const std::vector<FloeRow> rows = floe_rows(run, time);
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
