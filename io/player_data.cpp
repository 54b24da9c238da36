#include "io/player_data.hpp"

#include "io/json_writer.hpp"
#include "io/version.hpp"

namespace polynya::io {
namespace {

void add_frames(PlayerData& data, const Run& run, const FrameSelection& selection) {
  std::string bytes = FrameEncoder::header();
  for (const Frame& frame : thinned_frames(run, selection)) {
    bytes += frame_bytes(frame.time, frame.ships, frame.floes);
    ++data.frames;
  }
  data.columns.add("frames", bytes);
}

void add_forces(ColumnWriter& columns, const Run& run, const FrameSelection& selection) {
  std::vector<std::int32_t> ship, contacts;
  std::vector<double> time, surge, sway, yaw, surge_peak, sway_peak, yaw_peak, speed, thrust;
  for (const simulation::ShipSample& s : run.samples) {
    if (!selection.has(s.time)) continue;
    ship.push_back(s.ship);
    contacts.push_back(s.contacts);
    time.push_back(s.time);
    surge.push_back(s.surge_force);
    sway.push_back(s.sway_force);
    yaw.push_back(s.yaw_moment);
    surge_peak.push_back(s.surge_peak);
    sway_peak.push_back(s.sway_peak);
    yaw_peak.push_back(s.yaw_peak);
    speed.push_back(length(s.velocity_in_world));
    thrust.push_back(s.thrust);
  }
  columns.add("force_ship", ship);
  columns.add("force_contacts", contacts);
  columns.add("force_t_s", time);
  columns.add("surge_N", surge);
  columns.add("sway_N", sway);
  columns.add("yaw_Nm", yaw);
  columns.add("surge_j_over_tau_c_N", surge_peak);
  columns.add("sway_j_over_tau_c_N", sway_peak);
  columns.add("yaw_j_over_tau_c_Nm", yaw_peak);
  columns.add("speed_m_per_s", speed);
  columns.add("thrust_N", thrust);
}

void write_events(JsonWriter& json, const Run& run) {
  json.key("events").open('[');
  for (const simulation::Event& event : run.events) {
    json.open('{').key("t_s").value(event.time).key("kind").value(name_of(event.kind));
    json.key("ship").value(event.ship).key("floe").value(event.floe).key("children").open('[');
    for (const simulation::FloeId child : event.children) json.value(child);
    json.close(']').key("point_m").value(event.point_in_world);
    const auto& c = event.criteria;
    const bool is_split = event.kind == simulation::EventKind::kSplit;
    json.key("load_N").value(is_split ? c.collision_force : c.vertical_force);
    json.key("capacity_N").value(is_split ? c.splitting_force : c.bending_capacity);
    if (!event.reason.empty()) json.key("reason").value(event.reason);
    json.close('}');
  }
  json.close(']');
}

void write_ships(JsonWriter& json, const simulation::Scene& scene) {
  json.key("ships").open('[');
  for (const simulation::ShipSpec& ship : scene.ships) {
    json.open('{').key("name").value(ship.name);
    json.key("waterline_m").value(ship.hull.waterline).close('}');
  }
  json.close(']');
}

void write_summary(JsonWriter& json, const Run& run) {
  const JsonValue* finished = run.summary.find("finished");
  json.key("finished").value(finished && finished->is(JsonValue::Kind::kBoolean) && finished->boolean());
  if (const JsonValue* by = run.summary.find("stopped_by"); by && by->is(JsonValue::Kind::kText))
    json.key("stopped_by").value(by->text());
}

std::string info_of(const Run& run, const PlayerData& data, const PlayerOptions& options) {
  std::string text;
  JsonWriter json(text);
  const simulation::Scene& scene = run.scene.scene;
  json.open('{').key("polynya").value(version()).key("scene").value(scene.name);
  json.key("description").value(run.scene.description).key("scene_hash").value(run.scene.hash);
  json.key("seed").value(static_cast<std::int64_t>(scene.seed)).key("until_s").value(scene.time.until);
  json.key("frames").value(static_cast<std::int64_t>(data.frames));
  json.key("frames_of_run").value(static_cast<std::int64_t>(run.frames.size()));
  json.key("circle_radius_m").value(scene.contact.circle_radius).key("has_circles").value(data.has_circles);
  write_summary(json, run);
  write_ships(json, scene);
  write_events(json, run);
  json.key("channel");
  if (options.channel.empty())
    json.null();
  else
    json.json(options.channel);
  json.key("columns").open('[');
  for (const ColumnWriter::Column& column : data.columns.table()) {
    json.open('{').key("name").value(column.name).key("type").value(column.type);
    json.key("offset").value(static_cast<std::int64_t>(column.offset));
    json.key("count").value(static_cast<std::int64_t>(column.count)).close('}');
  }
  json.close(']').close('}');
  return text;
}

}  // namespace

PlayerData player_data(const Run& run, const PlayerOptions& options) {
  PlayerData data;
  add_floes(data.columns, run);
  add_frames(data, run, options.frames);
  add_forces(data.columns, run, options.frames);
  data.has_circles = options.most_circles > 0 && add_contact_circles(data.columns, run, options.most_circles);
  data.info = info_of(run, data, options);
  return data;
}

}  // namespace polynya::io
