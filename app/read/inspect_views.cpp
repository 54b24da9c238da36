#include "app/read/inspect_views.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "app/command_line/console.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "io/run/event_records.hpp"
#include "io/run/motion_index.hpp"
#include "io/run/records.hpp"
#include "io/scene/floe_ice.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"
#include "io/text/wkt.hpp"

namespace polynya::app {
namespace {

using geometry::Ring;
using io::id_or_none;
using io::JsonWriter;
using simulation::FloeId;

std::string_view validity_of(const geometry::Polygon& polygon) {
  const auto found = find_defect(polygon);
  return found ? name_of(found->defect) : "yes";
}

std::string as_geojson(const ShapeView& view) {
  const simulation::BirthRecord& birth = view.birth;
  std::string text;
  io::JsonWriter json(text);
  json.open('{').key("type").value("Feature").key("properties").open('{').key("floe_id").value(birth.floe);
  json.key("parent_id").value(io::id_or_none(birth.parent));
  json.key("born_s").value(birth.time).key("generation").value(birth.generation);
  json.key("area_m2").value(birth.area).key("mass_kg").value(birth.mass);
  io::append_ice(json, view.ice);
  json.key("frame").value(view.time_in_world ? "world" : "body");
  if (view.time_in_world) json.key("t_s").value(*view.time_in_world);
  json.close('}').key("geometry").polygon(view.polygon).close('}');
  return text + "\n";
}

std::string as_svg(const ShapeView& view) {
  const geometry::Box box = bounding_box(view.polygon.outer);
  const geometry::Vector size = box.high - box.low;
  const double margin = 0.02 * std::max(size.x, size.y);
  std::string text = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='{} {} {} {}'>\n<title>floe {} {}, "
      "metres</title>\n<path "
      "d='",
      box.low.x - margin, -box.high.y - margin, size.x + 2 * margin, size.y + 2 * margin, view.birth.floe,
      view.time_in_world ? fmt::format("in the world at {:g} s", *view.time_in_world) : "in its body frame");
  const auto write = [&text](const Ring& ring) {
    char command = 'M';
    for (const geometry::Point p : ring) {
      fmt::format_to(std::back_inserter(text), "{}{} {}", command, p.x, 0.0 - p.y);
      command = 'L';
    }
    text += 'Z';
  };
  write(view.polygon.outer);
  std::ranges::for_each(view.polygon.holes, write);
  text +=
      fmt::format("' fill='#fbeec2' fill-rule='evenodd' stroke='#3d5261' stroke-width='{}'/>\n</svg>\n", margin / 8);
  return text;
}

void add_hulls_and_crushed(std::string& text, const analysis::RunCheck& check, const simulation::Scene& scene) {
  const auto add = [&text](const std::string& line) { text += line + "\n"; };
  if (check.worst_with_hull.area > 0)
    add(fmt::format(
        "hulls      {} with floes whose boxes meet; largest: {} and floe {} at {:.6g} s, {:.6g} m2, a "
        "vertex {:.4g} m deep",
        counted(check.hull_pairs, "pair"), io::ship_name(scene, check.worst_hull), check.worst_with_hull.second,
        check.worst_with_hull.time, check.worst_with_hull.area, check.worst_with_hull.depth));
  if (!check.has_crushed) {
    add("crushed    not on record (no crushed.csv): overlaps are measured, not judged");
  } else {
    add(fmt::format("crushed    {} more than was crushed there and {:g} % of the smaller body",
                    check.uncrushed_pairs == 1 ? "1 pair shares" : fmt::format("{} pairs share", check.uncrushed_pairs),
                    100 * analysis::kUncrushedShare));
    const auto name = [&](const simulation::ContactState::Body& body) {
      return body.ship >= 0 ? std::string(io::ship_name(scene, body.ship)) : fmt::format("floe {}", body.floe);
    };
    for (const analysis::UncrushedOverlap& pair : check.uncrushed)
      add(
          fmt::format("           {} and {} at {:.6g} s about ({:.3f}, {:.3f}): {:.6g} m2 shared, {:.6g} m2 crushed, "
                      "{:.6g} m2 beyond it allowed",
                      name(pair.first), name(pair.second), pair.time, pair.place_in_world.x, pair.place_in_world.y,
                      pair.shared, pair.crushed, pair.allowed));
    add(fmt::format("work       {} of more than that; {} from the work on record by more than a factor of {:g}",
                    counted(check.paid_pairs, "crushed overlap"),
                    check.unpaid.size() == 1 ? "1 differs" : fmt::format("{} differ", check.unpaid.size()),
                    analysis::kMostWorkFactor));
    add(fmt::format(
        "           most at once, smaller overlaps included: {:.6g} kJ by what is crushed, {:.6g} kJ on record",
        1e-3 * check.most_expected, 1e-3 * check.work_then));
    for (std::size_t i = 0; i < std::min(check.unpaid.size(), analysis::kMostUncrushed); ++i) {
      const analysis::UnpaidOverlap& pair = check.unpaid[i];
      add(fmt::format("           {} and {} at {:.6g} s: {:.6g} m2 crushed, which takes {:.6g} kJ; {:.6g} kJ on record",
                      name(pair.first), name(pair.second), pair.time, pair.area, 1e-3 * pair.expected,
                      1e-3 * pair.work));
    }
  }
}

// ---- parts of the lines of events

/// What happened, where and what decided it, in a line.
std::string described(const io::Run& run, const simulation::Event& event) {
  const std::string_view ship = io::ship_name(run.scene.scene, event.ship);
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

// ---- parts of the JSON

void write_worst(JsonWriter& json, std::string_view key, const analysis::Worst& worst) {
  json.key(key).open('{').key("largest_m2").value(worst.value);
  json.key("floe_id").value(id_or_none(worst.floe)).key("wrong").value(worst.wrong).close('}');
}

void write_shared(JsonWriter& json, std::string_view key, const analysis::SharedIce& shared) {
  json.key(key);
  if (shared.first == simulation::kNoFloe) {
    json.null();
    return;
  }
  json.open('{').key("floe_ids").list(std::array{shared.first, shared.second});
  json.key("t_s").value(shared.time).key("area_m2").value(shared.area).key("depth_m").value(shared.depth);
  json.close('}');
}

void write_invalid(JsonWriter& json, const std::vector<analysis::InvalidFloe>& invalid) {
  json.key("invalid").open('[');
  for (const analysis::InvalidFloe& floe : invalid) {
    json.open('{').key("floe_id").value(floe.floe).key("defect").value(floe.defect);
    json.key("places_m").value(floe.places_in_body).close('}');
  }
  json.close(']');
}

void write_hulls(JsonWriter& json, const analysis::RunCheck& check, const simulation::Scene& scene) {
  const auto write_body = [&](std::string_view key, const simulation::ContactState::Body& body) {
    json.key(key);
    if (body.ship >= 0)
      json.value(io::ship_name(scene, body.ship));
    else
      json.value(body.floe);
  };
  json.key("hull_pairs").value(check.hull_pairs).key("largest_overlap_with_hull");
  if (check.worst_hull >= 0) {
    json.open('{').key("ship").value(io::ship_name(scene, check.worst_hull));
    json.key("floe_id").value(check.worst_with_hull.second).key("t_s").value(check.worst_with_hull.time);
    json.key("area_m2").value(check.worst_with_hull.area).key("depth_m").value(check.worst_with_hull.depth);
    json.close('}');
  } else {
    json.null();
  }
  json.key("has_crushed").value(check.has_crushed).key("uncrushed_pairs").value(check.uncrushed_pairs);
  json.key("uncrushed").open('[');
  for (const analysis::UncrushedOverlap& pair : check.uncrushed) {
    json.start_line();
    json.open('{');
    write_body("first", pair.first);
    write_body("second", pair.second);
    json.key("t_s").value(pair.time).key("place_m").value(pair.place_in_world);
    json.key("shared_m2").value(pair.shared).key("crushed_m2").value(pair.crushed);
    json.key("allowed_beyond_m2").value(pair.allowed).close('}');
  }
  json.close(']').key("compared_with_work").value(check.paid_pairs).key("most_expected_J").value(check.most_expected);
  json.key("crushing_then_J").value(check.work_then).key("unpaid").open('[');
  for (const analysis::UnpaidOverlap& pair : check.unpaid) {
    json.start_line();
    json.open('{');
    write_body("first", pair.first);
    write_body("second", pair.second);
    json.key("t_s").value(pair.time).key("crushed_m2").value(pair.area);
    json.key("expected_J").value(pair.expected).key("crushing_J").value(pair.work).close('}');
  }
  json.close(']');
}

}  // namespace

std::string to_text(const ShapeView& view, ShapeFormat format) {
  if (format == ShapeFormat::kGeojson) return as_geojson(view);
  if (format == ShapeFormat::kSvg) return as_svg(view);
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

std::string size_text(const analysis::SizeDistribution& sizes) {
  std::string text = fmt::format("{}, {:.6f} m2 at {:.6g} s; size is the root of the area\n",
                                 counted(sizes.count, "floe"), sizes.area, sizes.time);
  if (sizes.without_size > 0)
    text +=
        fmt::format("left out: {} whose recorded area is not a positive number\n", counted(sizes.without_size, "floe"));
  if (sizes.count == 0) return text;
  text +=
      fmt::format("size_m: least {:.6g}, median {:.6g}, largest {:.6g}\n", sizes.least, sizes.median, sizes.largest);
  text += fmt::format("{:>10} {:>10} {:>8} {:>16} {:>8} {:>10}\n", "from_m", "below_m", "floes", "area_m2", "area_%",
                      "from_on");
  for (const analysis::SizeClass& one : sizes.classes)
    text += fmt::format("{:>10g} {:>10g} {:>8} {:>16.6f} {:>8.3f} {:>10}\n", one.from, one.below, one.count, one.area,
                        100 * one.area / sizes.area, one.from_on);
  return text;
}

std::string check_text(const analysis::RunCheck& check, const simulation::Scene& scene) {
  std::string text;
  const auto add = [&text](const std::string& line) { text += line + "\n"; };
  const auto from = [](simulation::FloeId floe) {
    return floe == simulation::kNoFloe ? std::string() : fmt::format(" (floe {})", floe);
  };
  add(fmt::format("validity   {}, {} invalid", counted(check.shapes, "shape"), check.invalid.size()));
  for (const analysis::InvalidFloe& floe : check.invalid) {
    add(fmt::format("           floe {}: {}{}", floe.floe, floe.defect, io::places_in_words(floe.places_in_body, 4)));
  }
  add(fmt::format("areas      recorded - ring at most {:.2e} m2{}, {} beyond {:g} of the area",
                  check.recorded_area.value, from(check.recorded_area.floe), check.recorded_area.wrong,
                  analysis::kAreaTolerance));
  add(fmt::format(
      "fractures  {}: pieces + submerged + brash - rounding - parent at most {:.2e} m2{}, {} "
      "beyond {:g} of it",
      check.fractures, check.balance.value, from(check.balance.floe), check.balance.wrong, analysis::kAreaTolerance));
  add(check.siblings.area > 0 ? fmt::format("           pieces of one fracture share at most {:.2e} m2 in "
                                            "their body frame (floes {} and {})",
                                            check.siblings.area, check.siblings.first, check.siblings.second)
                              : "           pieces of one fracture share 0 m2 in their body frame, exactly");
  add(fmt::format("overlap    {}, {} with boxes that meet, {} not decided; {} more than 1e-6 m2 at some instant",
                  counted(check.instants, "instant"), counted(check.pairs, "pair"), check.undecided,
                  check.overlapping_pairs == 1 ? "1 pair of floes shares"
                                               : fmt::format("{} pairs of floes share", check.overlapping_pairs)));
  add(fmt::format("           most at once {:.6g} m2 at {:.6g} s, {:.2e} of the {:.6g} m2 of ice", check.most_shared,
                  check.most_shared_time, check.ice_then > 0 ? check.most_shared / check.ice_then : 0, check.ice_then));
  const auto add_pair = [&](const char* words, const analysis::SharedIce& pair) {
    if (pair.first == simulation::kNoFloe) return;
    add(fmt::format("           {}: floes {} and {} at {:.6g} s, {:.6g} m2, a vertex {:.4g} m deep", words, pair.first,
                    pair.second, pair.time, pair.area, pair.depth));
  };
  add_pair("largest", check.worst);
  add_pair("deepest", check.deepest);
  add_hulls_and_crushed(text, check, scene);
  add("           Overlap is part of the contact model: ice in contact is let in by what it crushes, and "
      "frames are right to");
  add("           1 mm and 1e-5 rad. All areas are exact for the rings and poses on record.");
  add(check.is_sound() ? "sound" : "NOT SOUND");
  return text;
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
  std::string text;
  io::JsonWriter json(text);
  json.open('{').key("events").open('[');
  for (const simulation::Event& event : in_order(run.events)) {
    json.start_line();
    json.json(json_of(run, event));
  }
  json.close(']').close('}');
  return text + "\n";
}

std::string floes_json(const std::vector<FloeRow>& rows, double time) {
  std::string text;
  JsonWriter json(text);
  json.open('{').key("t_s").value(time).key("floes").open('[');
  for (const FloeRow& row : rows) {
    json.start_line();
    json.open('{').key("floe_id").value(row.birth.floe).key("parent_id").value(id_or_none(row.birth.parent));
    json.key("born_s").value(row.birth.time).key("area_m2").value(row.birth.area);
    json.key("perimeter_m").value(row.perimeter).key("vertices").value(row.vertices);
    json.key("holes").value(row.holes).key("mass_kg").value(row.birth.mass);
    io::append_ice(json, row.ice);
    json.key("speed_m_per_s").value(row.speed).key("valid").value(row.validity).close('}');
  }
  json.close(']').close('}');
  return text + "\n";
}

std::string size_json(const analysis::SizeDistribution& sizes) {
  std::string text;
  JsonWriter json(text);
  json.open('{').key("t_s").value(sizes.time).key("floes").value(sizes.count);
  json.key("left_out").value(sizes.without_size);
  json.key("area_m2").value(sizes.area).key("least_m").value(sizes.least).key("median_m").value(sizes.median);
  json.key("largest_m").value(sizes.largest).key("classes").open('[');
  for (const analysis::SizeClass& one : sizes.classes) {
    json.start_line();
    json.open('{').key("from_m").value(one.from).key("below_m").value(one.below);
    json.key("floes").value(one.count).key("area_m2").value(one.area);
    json.key("from_on").value(one.from_on).close('}');
  }
  json.close(']').close('}');
  return text + "\n";
}

std::string lineage_json(const io::Run& run, simulation::FloeId floe) {
  std::string text;
  JsonWriter json(text);
  json.open('{').key("floe_id").value(floe).key("lineage").open('[');
  for (const simulation::FloeId id : run.lineage(floe)) {
    const io::RunFloe& at = *run.floe(id);
    json.start_line();
    json.open('{').key("floe_id").value(id).key("born_s").value(at.birth.time);
    json.key("area_m2").value(at.birth.area).key("broken_by");
    if (at.death_event)
      json.json(json_of(run, run.events[*at.death_event]));
    else
      json.null();
    json.close('}');
  }
  json.close(']').close('}');
  return text + "\n";
}

std::string check_json(const analysis::RunCheck& check, const simulation::Scene& scene) {
  std::string text;
  JsonWriter json(text, JsonWriter::Layout::kIndented);
  json.open('{').key("is_sound").value(check.is_sound()).key("shapes").value(check.shapes);
  write_invalid(json, check.invalid);
  write_worst(json, "recorded_area", check.recorded_area);
  json.key("fractures").value(check.fractures);
  write_worst(json, "balance", check.balance);
  json.key("overlapping_siblings").value(check.overlapping_siblings);
  json.key("most_shared_by_siblings_m2").value(check.siblings.area);
  json.key("moments").value(check.instants).key("pairs").value(check.pairs);
  json.key("undecided").value(check.undecided).key("overlapping_pairs").value(check.overlapping_pairs);
  json.key("most_shared_m2").value(check.most_shared).key("most_shared_s").value(check.most_shared_time);
  json.key("ice_then_m2").value(check.ice_then);
  write_shared(json, "largest_overlap", check.worst);
  write_shared(json, "deepest_overlap", check.deepest);
  write_hulls(json, check, scene);
  json.close('}');
  return text + "\n";
}

}  // namespace polynya::app
