#include "analysis/run_listing.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "io/import/floe_properties.hpp"
#include "io/run/event_records.hpp"
#include "io/run/records.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::analysis {
namespace {

using io::id_or_none;
using io::JsonWriter;
using simulation::FloeId;

std::string_view validity_of(const geometry::Polygon& polygon) {
  const auto found = find_defect(polygon);
  return found ? name_of(found->defect) : "yes";
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

}  // namespace

std::string to_geojson(const ShapeView& view) {
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

std::string lineage_json(const io::Run& run, FloeId floe) {
  return io::json_object([&](JsonWriter& json) {
    json.key("floe_id").value(floe).key("lineage").object_lines(run.lineage(floe), [&](FloeId id) {
      const io::RunFloe& at = *run.floe(id);
      json.key("floe_id").value(id).key("born_s").value(at.birth.time).key("area_m2").value(at.birth.area);
      json.key("broken_by").json(at.death_event ? json_of(run, run.events[*at.death_event]) : "null");
    });
  });
}

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

}  // namespace polynya::analysis
