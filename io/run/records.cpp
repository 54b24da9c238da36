#include "io/run/records.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "geometry/cut/repair.hpp"
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
  return csv_header("t_s,ship", force_columns());
}

void append_forces_row(std::string& text, const simulation::HullSample& sample, const simulation::Scene& scene) {
  append_number(text, sample.time);
  text.append(1, ',').append(hull_name(scene, sample.ship));
  append_row(text, sample, force_columns(), "null");
}

std::string contacts_header() {
  return csv_header("t_s,ship,floe_id,by_ship,by_floe_id", contact_columns());
}

void append_contact(std::string& text, double time, const simulation::ContactState& contact,
                    const simulation::Scene& scene) {
  append_bodies(text, time, contact.on, contact.by, scene);
  append_row(text, contact, contact_columns());
}

std::string panels_header() {
  return csv_header("t_s,ship", panel_columns());
}

void append_panel(std::string& text, const simulation::PanelSample& sample, const simulation::Scene& scene) {
  append_number(text, sample.time);
  text.append(1, ',').append(hull_name(scene, sample.hull));
  append_row(text, sample, panel_columns());
}

std::string crushed_header() {
  return csv_header("t_s,ship,floe_id,by_ship,by_floe_id", crushed_columns());
}

void append_crushed(std::string& text, double time, const simulation::CrushedOverlap& overlap,
                    const simulation::Scene& scene) {
  append_bodies(text, time, overlap.on, overlap.by, scene);
  append_row(text, overlap, crushed_columns(), "null");
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
double take_number(std::string_view& row) {
  const std::string_view field = csv_field(row);
  const auto value = csv_number(field);
  if (!value) throw ReadError(fmt::format("\"{}\" is not a number", field));
  return *value;
}

simulation::ContactState::Body body_of(std::string_view& line, const Run& run) {
  const std::string_view ship = csv_field(line);
  std::string_view floe = csv_field(line);
  simulation::ContactState::Body body{hull_named(run.scene.scene, ship), simulation::kNoFloe};
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

FloeId floe_id(const JsonValue& value) {
  if (value.is_null()) return simulation::kNoFloe;
  if (!value.is(JsonValue::Kind::kNumber) || !(value.number() >= 0 && value.number() < 1e9))
    throw ReadError("not a floe's id");
  return static_cast<FloeId>(value.number());
}

simulation::BirthRecord birth_of(const JsonValue& line) {
  simulation::BirthRecord birth;
  birth.floe = floe_id(json_member(line, "floe_id"));
  birth.parent = floe_id(json_member(line, "parent_id"));
  birth.time = number(line, "born_s");
  birth.generation = static_cast<int>(number(line, "generation"));
  birth.area = number(line, "area_m2");
  birth.mass = number(line, "mass_kg");
  birth.centroid_in_body = point_of(json_member(line, "centroid_m"));
  return birth;
}

simulation::HullSample sample_of(std::string_view line, const std::vector<const ForceColumn*>& columns,
                                 const simulation::Scene& scene) {
  simulation::HullSample s;
  s.time = take_number(line);
  s.ship = hull_named(scene, csv_field(line));
  for (const ForceColumn* column : columns) column->store(s, take_number(line));
  return s;
}

namespace {

/// A row of two bodies at an instant.
template <class Record, class Row>
Record record_of(std::string_view line, const Run& run, Row Record::*row, std::span<const Column<Row>> columns) {
  Record record;
  record.time = take_number(line);
  (record.*row).on = body_of(line, run);
  (record.*row).by = body_of(line, run);
  read_row(line, record.*row, columns);
  return record;
}

}  // namespace

RunCrushed crushed_of(std::string_view line, const Run& run) {
  return record_of(line, run, &RunCrushed::overlap, crushed_columns());
}

RunContact contact_of(std::string_view line, const Run& run) {
  return record_of(line, run, &RunContact::state, contact_columns());
}

}  // namespace polynya::io
