#include "io/run/records.hpp"

#include <fmt/format.h>

#include "geometry/shape/angle.hpp"
#include "io/run/force_columns.hpp"
#include "io/scene/floe_ice.hpp"
#include "io/text/csv_row.hpp"
#include "io/text/geojson_layer.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/shape_parts.hpp"

namespace polynya::io {
namespace {

/// What put a floe under a hull; a cusp goes under as it breaks off.
void append_tilting(JsonWriter& json, const simulation::TiltCriterion& c) {
  if (c.least_deflection == 0) {
    json.key("kind").value("a cusp broken off at the hull").close('}');
    return;
  }
  json.key("kind").value("edge deflection >= least deflection");
  json.key("deflection_m").value(c.deflection).key("least_deflection_m").value(c.least_deflection);
  json.key("vertical_force_N").value(c.vertical_force).key("tilting_capacity_N").value(c.capacity).close('}');
}

/// What let a piece come up, or kept it under the ice.
void append_resurfacing(JsonWriter& json, const simulation::Event& event) {
  const simulation::ResurfaceCriterion& c = event.resurfacing;
  const bool is_up = event.kind == simulation::EventKind::kResurface;
  json.key("kind").value(!is_up       ? "waited >= longest wait"
                         : c.path < 0 ? "the ship backed off it"
                                      : "path >= least path");
  json.key("path_m").value(c.path).key("least_path_m").value(c.least_path);
  json.key("waited_s").value(c.waited).key("longest_wait_s").value(c.longest_wait).close('}');
}

/// What decided a fracture: the load that reached the capacity.
void append_criterion(JsonWriter& json, const simulation::Event& event) {
  const fracture::FailureCriteria& c = event.criteria;
  json.key("criterion").open('{');
  if (event.kind == simulation::EventKind::kSubmerge) return append_tilting(json, event.tilting);
  if (event.kind == simulation::EventKind::kResurface || event.kind == simulation::EventKind::kStayUnder)
    return append_resurfacing(json, event);
  if (event.grinding.least_width > 0) {
    json.key("kind").value("overlap width < least width");
    json.key("width_m").value(event.grinding.width).key("least_width_m").value(event.grinding.least_width);
    json.key("overlap_area_m2").value(event.grinding.overlap_area);
    json.key("least_area_m2").value(event.grinding.least_area).close('}');
    return;
  }
  const simulation::DecidingLoad deciding = simulation::deciding_load(event);
  json.key("kind").value(fmt::format("{} {} {}", deciding.name, deciding.comparison, deciding.capacity_name));
  json.key("load_N").value(deciding.load).key("capacity_N").value(deciding.capacity);
  json.key("floe_size_m").value(c.floe_size).key("breakable_size_m").value(c.breakable_size);
  json.key("collision_force_N").value(c.collision_force).key("splitting_force_N").value(c.splitting_force);
  json.key("crack_length_m").value(c.crack_length).key("crack_width_m").value(c.crack_width);
  json.key("contact_force_N").value(c.contact_force);
  if (c.opening_capacity > 0) {
    json.key("opening_force_N").value(c.opening_force).key("opening_capacity_N").value(c.opening_capacity);
    json.key("left_flank_force_N").value(c.flank_forces[0]);
    json.key("right_flank_force_N").value(c.flank_forces[1]);
    json.key("fracture_toughness_Pa_sqrt_m").value(c.fracture_toughness);
  }
  json.key("vertical_force_N").value(c.vertical_force).key("bending_capacity_N").value(c.bending_capacity);
  if (c.flexural_strength > 0) json.key("flexural_strength_Pa").value(c.flexural_strength);
  json.close('}');
}

/// The two columns that name a ship or a floe.
void append_body(std::string& text, std::string_view ship, simulation::FloeId floe) {
  text += ',';
  text += ship;
  text += ',';
  if (floe != simulation::kNoFloe) append_number(text, floe);
}

}  // namespace

std::string_view ship_name(const simulation::Scene& scene, int ship) {
  const auto hull = static_cast<std::size_t>(ship);
  return ship < 0 || hull >= hull_count(scene) ? std::string_view{} : hull_of(scene, hull).name;
}

std::string forces_header() {
  std::string header = "t_s,ship";
  for (const ForceColumn& column : force_columns()) header.append(1, ',').append(column.name);
  return header + '\n';
}

void append_forces_row(std::string& text, const simulation::ShipSample& s, std::string_view ship_name) {
  append_number(text, s.time);
  text += ',';
  text += ship_name;
  for (const ForceColumn& column : force_columns()) append_csv(text, {column.read(s)});
  text += '\n';
}

std::string_view contacts_header() {
  return "t_s,ship,floe_id,by_ship,by_floe_id,x_m,y_m,fx_N,fy_N,depth_m,is_crushing\n";
}

void append_contact(std::string& text, double time, const simulation::ContactState& contact,
                    std::string_view on_ship, std::string_view by_ship) {
  append_number(text, time);
  append_body(text, on_ship, contact.on.floe);
  append_body(text, by_ship, contact.by.floe);
  append_csv(text, {contact.point_in_world.x, contact.point_in_world.y, contact.force.x, contact.force.y,
                    contact.depth});
  text += contact.is_crushing ? ",1\n" : ",0\n";
}

std::string_view crushed_header() {
  return "t_s,ship,floe_id,by_ship,by_floe_id,crushed_m2\n";
}

void append_crushed(std::string& text, double time, const simulation::CrushedOverlap& overlap,
                    std::string_view on_ship, std::string_view by_ship) {
  append_number(text, time);
  append_body(text, on_ship, overlap.on.floe);
  append_body(text, by_ship, overlap.by.floe);
  append_csv(text, {overlap.area});
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

void append_event(std::string& text, const simulation::Event& event, std::string_view ship_name,
                  simulation::FloeId parent) {
  JsonWriter json(text);
  json.open('{').key("t_s").value(event.time).key("kind").value(name_of(event.kind));
  json.key("ship").value(ship_name);
  if (event.by_floe != simulation::kNoFloe) json.key("by_floe").value(event.by_floe);
  json.key("floe").value(event.floe).key("parent").value(id_or_none(parent));
  json.key("children").list(event.children);
  json.key("point_m").value(event.point_in_world).key("normal").value(event.normal_in_world);
  append_criterion(json, event);
  json.key("penetration_m").value(event.penetration);
  if (event.cusp_radius > 0) json.key("cusp_radius_m").value(event.cusp_radius);
  json.key("submerged_area_m2").value(event.submerged_area).key("brash_area_m2").value(event.brash_area);
  if (event.under_hull_area > 0) json.key("under_hull_area_m2").value(event.under_hull_area);
  if (event.under_ice_area > 0) json.key("under_ice_area_m2").value(event.under_ice_area);
  json.key("rounding_defect_m2").value(event.rounding_defect);
  if (!event.reason.empty()) json.key("reason").value(event.reason);
  json.close('}');
  text += '\n';
}

void append_ship_contact(std::string& text, const simulation::ShipContact& contact,
                         std::string_view ship_name, std::string_view by_ship_name) {
  JsonWriter json(text);
  json.open('{').key("t_s").value(contact.time).key("kind").value(kShipContactKind);
  json.key("ship").value(ship_name).key("by_ship").value(by_ship_name);
  json.key("point_m").value(contact.point_in_world);
  json.key("closing_speed_m_per_s").value(contact.closing_speed);
  json.key("relative_speed_m_per_s").value(contact.relative_speed);
  json.key("is_prescribed").value(contact.is_prescribed).close('}');
  text += '\n';
}

void append_mooring_break(std::string& text, const simulation::MooringBreak& broken,
                          std::string_view ship_name) {
  JsonWriter json(text);
  json.open('{').key("t_s").value(broken.time).key("kind").value(kMooringBreakKind);
  json.key("ship").value(ship_name).key("point_m").value(broken.point_in_world);
  json.key("force_N").value(broken.force).key("break_load_N").value(broken.break_load);
  json.key("offset_m")
      .value(geometry::Point{broken.offset_in_moored_place.x, broken.offset_in_moored_place.y});
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
  layer.end_with(transform(floe.world_from_body, *floe.polygon_in_body));
}

}  // namespace polynya::io
