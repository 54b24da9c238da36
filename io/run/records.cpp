#include "io/run/records.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "geometry/cut/cut.hpp"
#include "geometry/shape/angle.hpp"
#include "io/run/csv_columns.hpp"
#include "io/scene/floe_ice.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"
#include "io/text/shape_parts.hpp"

namespace polynya::io {

std::string_view hull_name(const simulation::Scene& scene, int ship) {
  const auto hull = static_cast<std::size_t>(ship);
  return ship < 0 || hull >= hull_count(scene) ? std::string_view{} : hull_of(scene, hull).name;
}

namespace {

/// What a row of two bodies begins with: the time, and of each body the name of the ship or the number of the floe.
void append_bodies(std::string& text, double time, const simulation::ContactState::Body& on,
                   const simulation::ContactState::Body& by, const simulation::Scene& scene) {
  append_number(text, time);
  for (const simulation::ContactState::Body& body : {on, by}) {
    text.append(1, ',').append(hull_name(scene, body.ship)) += ',';
    if (body.floe != simulation::kNoFloe) append_number(text, body.floe);
  }
}

}  // namespace

std::string forces_header() {
  std::string header = "t_s,ship";
  for (const ForceColumn& column : force_columns()) header.append(1, ',').append(column.name);
  return header + '\n';
}

void append_forces_row(std::string& text, const simulation::HullSample& s, std::string_view hull_name) {
  append_number(text, s.time);
  text += ',';
  text += hull_name;
  for (const ForceColumn& column : force_columns()) append_csv(text, {column.read(s)});
  text += '\n';
}

std::string contacts_header() {
  std::string header = "t_s,ship,floe_id,by_ship,by_floe_id";
  append_header(header, contact_columns());
  return header;
}

void append_contact(std::string& text, double time, const simulation::ContactState& contact,
                    const simulation::Scene& scene) {
  append_bodies(text, time, contact.on, contact.by, scene);
  append_row(text, contact);
}

std::string panels_header() {
  std::string header = "t_s,ship";
  append_header(header, panel_columns());
  return header;
}

void append_panel(std::string& text, const simulation::PanelSample& sample, const simulation::Scene& scene) {
  append_number(text, sample.time);
  text.append(1, ',').append(hull_name(scene, sample.hull));
  append_row(text, sample);
}

std::string_view crushed_header() {
  return "t_s,ship,floe_id,by_ship,by_floe_id,crushed_m2,tilted_m2,crushed_m3,crushing_J\n";
}

void append_crushed(std::string& text, double time, const simulation::CrushedOverlap& overlap,
                    const simulation::Scene& scene) {
  append_bodies(text, time, overlap.on, overlap.by, scene);
  append_csv(text, {overlap.area, overlap.tilted, overlap.volume, overlap.work});
  text += '\n';
}

std::string_view states_header() {
  return "t_s,steps,state_hash\n";
}

void append_state(std::string& text, double time, std::int64_t steps, std::uint64_t hash) {
  append_number(text, time);
  text += fmt::format(",{},{:016x}\n", steps, hash);
}

void append_birth(std::string& text, const simulation::Birth& birth, const geometry::Polygon* parent,
                  const simulation::Scene* scene) {
  JsonWriter json(text);
  json.open('{').key("floe_id").value(birth.floe).key("parent_id").value(id_or_none(birth.parent));
  if (scene && birth.floe < std::ssize(scene->floes)) {
    const std::int64_t source = scene->floes[static_cast<std::size_t>(birth.floe)].source_floe;
    if (source >= 0) json.key("source_floe_id").value(source);
  }
  json.key("born_s").value(birth.time).key("generation").value(birth.generation);
  json.key("area_m2").value(birth.area).key("mass_kg").value(birth.mass);
  if (scene && birth.own_ice != simulation::kSceneIce) append_ice(json, ice_of(*scene, birth.own_ice));
  json.key("centroid_m").value(birth.centroid_in_body);
  append_shape(json, parent ? parts_of(birth.polygon_in_body, *parent) : whole(birth.polygon_in_body));
  json.close('}');
  text += '\n';
}

std::string to_geojson(const std::vector<simulation::FloeState>& floes, double time) {
  GeojsonLayer layer(time);
  for (const simulation::FloeState& floe : floes) append_floe(layer, floe);
  return layer.finish();
}

void append_floe(GeojsonLayer& layer, const simulation::FloeState& floe) {
  JsonWriter& json = layer.start();
  json.key("floe_id").value(floe.floe).key("parent_id").value(id_or_none(floe.parent));
  json.key("born_s").value(floe.born).key("generation").value(floe.generation);
  json.key("area_m2").value(floe.area).key("mass_kg").value(floe.mass);
  append_ice(json, *floe.ice);
  json.key("speed_m_per_s").value(geometry::length(floe.velocity));
  json.key("vx_m_per_s").value(floe.velocity.x).key("vy_m_per_s").value(floe.velocity.y);
  json.key("angular_velocity_deg_per_s").value(geometry::kDegreesPerRadian * floe.angular_velocity);
  if (floe.is_fast) json.key("fast_ice").value(true);
  if (!floe.under_hull_of.empty())
    json.key("under_hull_of").value(floe.under_hull_of).key("under_hull_path_m").value(floe.under_path);
  // Two corners of a cut may round to one point far from the origin, which a scene that continues the run would refuse.
  layer.end_with(normalised(transform(floe.world_from_body, *floe.polygon_in_body)));
}

using simulation::FloeId;

namespace {

double number(const JsonValue& value, std::string_view key) {
  return json_member(value, key, JsonValue::Kind::kNumber).number();
}
FloeId floe_id(const JsonValue& value, std::string_view key) {
  const JsonValue* found = value.find(key);
  if (!found) throw ReadError(fmt::format("\"{}\" is missing", key));
  return floe_id(*found);
}
double take_number(std::string_view& row) {
  const std::string_view field = csv_field(row);
  const auto value = csv_number(field);
  if (!value) throw ReadError(fmt::format("\"{}\" is not a number", field));
  return *value;
}

simulation::ContactState::Body body_of(std::string_view& line, const Run& run) {
  const std::string_view ship = csv_field(line);
  std::string_view floe = csv_field(line);
  simulation::ContactState::Body body{ship_index(run.scene.scene, ship), simulation::kNoFloe};
  if (ship.empty()) body.floe = static_cast<FloeId>(take_number(floe));
  if (body.ship < 0 && !run.floe(body.floe)) throw ReadError("a contact of what there is not");
  return body;
}

}  // namespace

JsonValue json_of(std::string_view text) {
  JsonDocument document = parse_json(text);
  if (!document.faults.empty()) throw ReadError("not JSON: " + document.faults.front().found);
  return std::move(document.root);
}

const JsonValue& json_member(const JsonValue& value, std::string_view key, JsonValue::Kind kind) {
  const JsonValue* found = value.find(key, kind);
  if (!found) throw ReadError(fmt::format("\"{}\" is not {}", key, name_of(kind)));
  return *found;
}

FloeId floe_id(const JsonValue& value) {
  if (value.is_null()) return simulation::kNoFloe;
  if (!value.is(JsonValue::Kind::kNumber) || !(value.number() >= 0 && value.number() < 1e9))
    throw ReadError("not a floe's id");
  return static_cast<FloeId>(value.number());
}

geometry::Point point(const JsonValue& value) {
  if (!value.is(JsonValue::Kind::kArray) || value.items().size() != 2 ||
      !value.items()[0].is(JsonValue::Kind::kNumber) || !value.items()[1].is(JsonValue::Kind::kNumber))
    throw ReadError("not a point");
  return {value.items()[0].number(), value.items()[1].number()};
}

int ship_index(const simulation::Scene& scene, std::string_view name) {
  return hull_named(scene, name);
}

simulation::BirthRecord birth_of(const JsonValue& line) {
  simulation::BirthRecord birth;
  birth.floe = floe_id(line, "floe_id");
  birth.parent = floe_id(line, "parent_id");
  birth.time = number(line, "born_s");
  birth.generation = static_cast<int>(number(line, "generation"));
  birth.area = number(line, "area_m2");
  birth.mass = number(line, "mass_kg");
  birth.centroid_in_body = point(json_member(line, "centroid_m", JsonValue::Kind::kArray));
  return birth;
}

simulation::HullSample sample_of(std::string_view line, const std::vector<const ForceColumn*>& columns,
                                 const simulation::Scene& scene) {
  simulation::HullSample s;
  s.time = take_number(line);
  s.ship = ship_index(scene, csv_field(line));
  for (const ForceColumn* column : columns) column->store(s, take_number(line));
  return s;
}

RunCrushed crushed_of(std::string_view line, const Run& run) {
  RunCrushed crushed;
  crushed.time = take_number(line);
  crushed.overlap.on = body_of(line, run);
  crushed.overlap.by = body_of(line, run);
  crushed.overlap.area = take_number(line);
  if (line.empty()) return crushed;  // of a version that did not book it
  crushed.overlap.tilted = take_number(line);
  crushed.overlap.volume = take_number(line);
  crushed.overlap.work = take_number(line);
  return crushed;
}

RunContact contact_of(std::string_view line, const Run& run) {
  RunContact contact;
  contact.time = take_number(line);
  simulation::ContactState& state = contact.state;
  state.on = body_of(line, run);
  state.by = body_of(line, run);
  if (!read_row(line, state)) throw ReadError("a contact with what is no number");
  return contact;
}

}  // namespace polynya::io
