#include <array>

#include "app/inspect_views.hpp"
#include "io/run/records.hpp"
#include "io/scene/floe_ice.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::app {
namespace {

using io::id_or_none;
using io::JsonWriter;

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

}  // namespace

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
    if (at.death_event) {
      const simulation::Event& event = run.events[*at.death_event];
      std::string line;
      io::append_event(line, event, io::ship_name(run.scene.scene, event.ship), at.birth.parent);
      line.pop_back();  // its newline
      json.json(line);
    } else {
      json.null();
    }
    json.close('}');
  }
  json.close(']').close('}');
  return text + "\n";
}

namespace {

void write_hulls(JsonWriter& json, const analysis::RunCheck& check,
                 const std::vector<simulation::ShipSpec>& ships) {
  const auto write_body = [&](std::string_view key, const simulation::ContactState::Body& body) {
    json.key(key);
    if (body.ship >= 0)
      json.value(ships[static_cast<std::size_t>(body.ship)].name);
    else
      json.value(body.floe);
  };
  json.key("hull_pairs").value(check.hull_pairs).key("largest_overlap_with_hull");
  if (check.worst_hull >= 0) {
    json.open('{').key("ship").value(ships[static_cast<std::size_t>(check.worst_hull)].name);
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
  json.close(']');
}

}  // namespace

std::string check_json(const analysis::RunCheck& check, const std::vector<simulation::ShipSpec>& ships) {
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
  write_hulls(json, check, ships);
  json.close('}');
  return text + "\n";
}

}  // namespace polynya::app
