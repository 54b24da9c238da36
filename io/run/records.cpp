#include "io/run/records.hpp"

#include <fmt/format.h>

#include "geometry/shape/angle.hpp"
#include "io/run/force_columns.hpp"
#include "io/run/load_columns.hpp"
#include "io/scene/floe_ice.hpp"
#include "io/text/csv_row.hpp"
#include "io/text/geojson_layer.hpp"
#include "io/text/json_writer.hpp"
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
  layer.end_with(transform(floe.world_from_body, *floe.polygon_in_body));
}

}  // namespace polynya::io
