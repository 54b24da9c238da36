#include "app/inspect_views.hpp"
#include "io/run/records.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::app {
namespace {

using io::JsonWriter;

void write_id(JsonWriter& json, std::string_view key, simulation::FloeId floe) {
  json.key(key);
  if (floe == simulation::kNoFloe)
    json.null();
  else
    json.value(floe);
}

void write_count(JsonWriter& json, std::string_view key, std::size_t count) {
  json.key(key).value(static_cast<std::int64_t>(count));
}

void write_worst(JsonWriter& json, std::string_view key, const analysis::Worst& worst) {
  json.key(key).open('{').key("largest_m2").value(worst.value);
  write_id(json, "floe_id", worst.floe);
  write_count(json, "wrong", worst.wrong);
  json.close('}');
}

void write_shared(JsonWriter& json, std::string_view key, const analysis::SharedIce& shared) {
  json.key(key);
  if (shared.first == simulation::kNoFloe) {
    json.null();
    return;
  }
  json.open('{').key("floe_ids").open('[').value(shared.first).value(shared.second).close(']');
  json.key("t_s").value(shared.time).key("area_m2").value(shared.area).key("depth_m").value(shared.depth);
  json.close('}');
}

void write_invalid(JsonWriter& json, const std::vector<analysis::InvalidFloe>& invalid) {
  json.key("invalid").open('[');
  for (const analysis::InvalidFloe& floe : invalid) {
    json.open('{').key("floe_id").value(floe.floe).key("defect").value(std::string_view(floe.defect));
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
    json.open('{').key("floe_id").value(row.birth.floe);
    write_id(json, "parent_id", row.birth.parent);
    json.key("born_s").value(row.birth.time).key("area_m2").value(row.birth.area);
    json.key("perimeter_m").value(row.perimeter);
    write_count(json, "vertices", row.vertices);
    write_count(json, "holes", row.holes);
    json.key("mass_kg").value(row.birth.mass).key("speed_m_per_s");
    if (row.speed)
      json.value(*row.speed);
    else
      json.null();
    json.key("valid").value(row.validity).close('}');
  }
  json.close(']').close('}');
  return text + "\n";
}

std::string size_json(const analysis::SizeDistribution& sizes) {
  std::string text;
  JsonWriter json(text);
  json.open('{').key("t_s").value(sizes.time);
  write_count(json, "floes", sizes.count);
  write_count(json, "left_out", sizes.without_size);
  json.key("area_m2").value(sizes.area).key("least_m").value(sizes.least).key("median_m").value(sizes.median);
  json.key("largest_m").value(sizes.largest).key("classes").open('[');
  for (const analysis::SizeClass& one : sizes.classes) {
    json.start_line();
    json.open('{').key("from_m").value(one.from).key("below_m").value(one.below);
    write_count(json, "floes", one.count);
    json.key("area_m2").value(one.area);
    write_count(json, "from_on", one.from_on);
    json.close('}');
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
      const auto& ships = run.scene.scene.ships;
      const bool has_ship = event.ship >= 0 && event.ship < std::ssize(ships);
      std::string line;
      io::append_event(line, event, has_ship ? ships[static_cast<std::size_t>(event.ship)].name : "",
                       at.birth.parent);
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

std::string check_json(const analysis::RunCheck& check) {
  std::string text;
  JsonWriter json(text, JsonWriter::Layout::kIndented);
  json.open('{').key("is_sound").value(check.is_sound());
  write_count(json, "shapes", check.shapes);
  write_invalid(json, check.invalid);
  write_worst(json, "recorded_area", check.recorded_area);
  write_count(json, "fractures", check.fractures);
  write_worst(json, "balance", check.balance);
  write_count(json, "overlapping_siblings", check.overlapping_siblings);
  json.key("most_shared_by_siblings_m2").value(check.siblings.area);
  write_count(json, "moments", check.instants);
  write_count(json, "pairs", check.pairs);
  write_count(json, "undecided", check.undecided);
  write_count(json, "overlapping_pairs", check.overlapping_pairs);
  json.key("most_shared_m2").value(check.most_shared).key("most_shared_s").value(check.most_shared_time);
  json.key("ice_then_m2").value(check.ice_then);
  write_shared(json, "largest_overlap", check.worst);
  write_shared(json, "deepest_overlap", check.deepest);
  json.close('}');
  return text + "\n";
}

}  // namespace polynya::app
