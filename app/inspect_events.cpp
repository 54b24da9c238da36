#include <algorithm>

#include "app/console.hpp"
#include "app/inspect_views.hpp"
#include "io/run/records.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::app {
namespace {

std::string how_it_went_under(const simulation::TiltCriterion& c) {
  if (c.least_deflection == 0) return "a cusp broken off at the hull";
  return fmt::format("edge {:.3g} m down >= {:.3g} m", c.deflection, c.least_deflection);
}

/// Both sides of what decided a bend or a split.
std::string decided_by(const simulation::Event& event) {
  const simulation::DecidingLoad deciding = simulation::deciding_load(event);
  std::string text = fmt::format("{} {:.4g} N {} {} {:.4g} N", deciding.name, deciding.load,
                                 deciding.comparison, deciding.capacity_name, deciding.capacity);
  const auto& c = event.criteria;
  if (event.kind != simulation::EventKind::kSplit || c.crack_width == 0) return text;
  text += fmt::format("; crack L {:.4g} m, W {:.4g} m", c.crack_length, c.crack_width);
  text += fmt::format("; contact force {:.4g} N, flanks {:.4g} and {:.4g} N", c.contact_force,
                      c.flank_forces[0], c.flank_forces[1]);
  if (deciding.load != c.opening_force)
    text += fmt::format(", opening {:.4g} N of {:.4g} N", c.opening_force, c.opening_capacity);
  return text + fmt::format(", K_IC {:.4g} Pa sqrt(m)", c.fracture_toughness);
}

std::string described(const io::Run& run, const simulation::ShipContact& contact) {
  return fmt::format("{:.6g} s  {} of {} and {} at ({:.3f}, {:.3f}): closing at {:.3g} m/s", contact.time,
                     io::kShipContactKind, io::ship_name(run.scene.scene, contact.ship),
                     io::ship_name(run.scene.scene, contact.other), contact.point_in_world.x,
                     contact.point_in_world.y, contact.closing_speed);
}

std::string described(const io::Run& run, const simulation::MooringBreak& broken) {
  return fmt::format(
      "{:.6g} s  {} of {} at ({:.3f}, {:.3f}): force {:.4g} N > {:.4g} N, {:.3g} m off its place",
      broken.time, io::kMooringBreakKind, io::ship_name(run.scene.scene, broken.ship),
      broken.point_in_world.x, broken.point_in_world.y, broken.force, broken.break_load,
      length(broken.offset_in_moored_place));
}

/// A line of text for each event, with its time [s].
using Lines = std::vector<std::pair<double, std::string>>;

/// In order of time; those of one time as they come in events.ndjson.
Lines in_order(Lines lines) {
  std::ranges::stable_sort(lines, {}, &Lines::value_type::first);
  return lines;
}

}  // namespace

std::string described(const io::Run& run, const simulation::Event& event) {
  const std::string_view name = io::ship_name(run.scene.scene, event.ship);
  const bool is_by_floe = event.by_floe != simulation::kNoFloe;
  const std::string by = is_by_floe     ? fmt::format(" by floe {}", event.by_floe)
                         : name.empty() ? ""
                                        : fmt::format(" by {}", name);
  std::string text = fmt::format("{:.6g} s  {}{} at ({:.3f}, {:.3f}): ", event.time, name_of(event.kind), by,
                                 event.point_in_world.x, event.point_in_world.y);
  if (event.kind == simulation::EventKind::kSubmerge)
    text += how_it_went_under(event.tilting);
  else if (event.resurfacing.longest_wait > 0 || event.resurfacing.path != 0)
    text += fmt::format("{:.4g} m after the stem, {:.4g} s for room", event.resurfacing.path,
                        event.resurfacing.waited);
  else if (event.grinding.least_width > 0)
    text += fmt::format("{:.4g} m2 overlapped, width {:.4g} m < {:.4g} m", event.grinding.overlap_area,
                        event.grinding.width, event.grinding.least_width);
  else
    text += decided_by(event);
  if (event.under_hull_area > 0) text += fmt::format("; {:.6g} m2 under the hull", event.under_hull_area);
  if (event.under_ice_area > 0) text += fmt::format("; {:.6g} m2 under the ice", event.under_ice_area);
  if (event.submerged_area > 0) text += fmt::format("; {:.6g} m2 submerged", event.submerged_area);
  if (event.brash_area > 0) text += fmt::format("; {:.6g} m2 brash", event.brash_area);
  return text;
}

std::string event_list(const io::Run& run) {
  Lines lines;
  const auto add = [&](const auto& events) {
    for (const auto& event : events) lines.emplace_back(event.time, described(run, event));
  };
  for (const simulation::Event& event : run.events) {
    const std::string of_floe =
        event.floe == simulation::kNoFloe ? "" : fmt::format("  (floe {})", event.floe);
    lines.emplace_back(event.time, described(run, event) + of_floe);
  }
  add(run.ship_contacts);
  add(run.mooring_breaks);
  if (lines.empty()) return "no events\n";
  std::string text;
  for (const auto& [time, line] : in_order(std::move(lines))) text += line + "\n";
  return text;
}

std::string events_json(const io::Run& run) {
  const simulation::Scene& scene = run.scene.scene;
  Lines lines;
  const auto add = [&](const auto& events, auto append) {
    for (const auto& event : events) {
      append(lines.emplace_back(event.time, "").second, event);
      lines.back().second.pop_back();  // its newline
    }
  };
  add(run.events, [&](std::string& line, const simulation::Event& event) {
    const io::RunFloe* floe = run.floe(event.floe);
    io::append_event(line, event, io::ship_name(scene, event.ship),
                     floe ? floe->birth.parent : simulation::kNoFloe);
  });
  add(run.ship_contacts, [&](std::string& line, const simulation::ShipContact& contact) {
    io::append_ship_contact(line, contact, io::ship_name(scene, contact.ship),
                            io::ship_name(scene, contact.other));
  });
  add(run.mooring_breaks, [&](std::string& line, const simulation::MooringBreak& broken) {
    io::append_mooring_break(line, broken, io::ship_name(scene, broken.ship));
  });
  std::string text;
  io::JsonWriter json(text);
  json.open('{').key("events").open('[');
  for (const auto& [time, line] : in_order(std::move(lines))) {
    json.start_line();
    json.json(line);
  }
  json.close(']').close('}');
  return text + "\n";
}

}  // namespace polynya::app
