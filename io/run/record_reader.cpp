#include "io/run/record_reader.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "io/text/csv_row.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {

using simulation::FloeId;

namespace {

const JsonValue& member(const JsonValue& value, std::string_view key, JsonValue::Kind kind) {
  const JsonValue* found = value.find(key, kind);
  if (!found) throw ReadError(fmt::format("\"{}\" is not {}", key, name_of(kind)));
  return *found;
}
double number(const JsonValue& value, std::string_view key) {
  return member(value, key, JsonValue::Kind::kNumber).number();
}
double number_or(const JsonValue& value, std::string_view key, double otherwise) {
  return value.find(key) ? number(value, key) : otherwise;
}
FloeId floe_id(const JsonValue& value) {
  if (value.is_null()) return simulation::kNoFloe;
  if (!value.is(JsonValue::Kind::kNumber) || !(value.number() >= 0 && value.number() < 1e9))
    throw ReadError("not a floe's id");
  return static_cast<FloeId>(value.number());
}
FloeId floe_id(const JsonValue& value, std::string_view key) {
  const JsonValue* found = value.find(key);
  if (!found) throw ReadError(fmt::format("\"{}\" is missing", key));
  return floe_id(*found);
}
geometry::Point point(const JsonValue& value) {
  if (!value.is(JsonValue::Kind::kArray) || value.items().size() != 2 ||
      !value.items()[0].is(JsonValue::Kind::kNumber) || !value.items()[1].is(JsonValue::Kind::kNumber))
    throw ReadError("not a point");
  return {value.items()[0].number(), value.items()[1].number()};
}
geometry::Point point(const JsonValue& value, std::string_view key) {
  return point(member(value, key, JsonValue::Kind::kArray));
}

int ship_index(const simulation::Scene& scene, std::string_view name) {
  return hull_named(scene, name);
}

simulation::EventKind event_kind(std::string_view name) {
  for (const auto kind :
       {simulation::EventKind::kBend, simulation::EventKind::kSplit, simulation::EventKind::kGrind,
        simulation::EventKind::kRejectedCut, simulation::EventKind::kSubmerge,
        simulation::EventKind::kResurface, simulation::EventKind::kStayUnder}) {
    if (name_of(kind) == name) return kind;
  }
  throw ReadError(fmt::format("an unknown kind of event, \"{}\"", shortened(name, 60)));
}

fracture::FailureCriteria criteria_of(const JsonValue& criterion) {
  fracture::FailureCriteria criteria;
  criteria.floe_size = number(criterion, "floe_size_m");
  criteria.breakable_size = number(criterion, "breakable_size_m");
  criteria.collision_force = number(criterion, "collision_force_N");
  criteria.splitting_force = number(criterion, "splitting_force_N");
  criteria.crack_length = number(criterion, "crack_length_m");
  criteria.crack_width = number_or(criterion, "crack_width_m", 0);
  criteria.contact_force = number_or(criterion, "contact_force_N", 0);
  criteria.opening_force = number_or(criterion, "opening_force_N", 0);
  criteria.opening_capacity = number_or(criterion, "opening_capacity_N", 0);
  criteria.flank_forces[0] = number_or(criterion, "left_flank_force_N", 0);
  criteria.flank_forces[1] = number_or(criterion, "right_flank_force_N", 0);
  criteria.fracture_toughness = number_or(criterion, "fracture_toughness_Pa_sqrt_m", 0);
  criteria.vertical_force = number(criterion, "vertical_force_N");
  criteria.bending_capacity = number(criterion, "bending_capacity_N");
  criteria.flexural_strength = number_or(criterion, "flexural_strength_Pa", 0);
  return criteria;
}

void read_criterion(const JsonValue& criterion, simulation::Event& event) {
  if (event.kind == simulation::EventKind::kSubmerge)
    event.tilting = {number_or(criterion, "deflection_m", 0), number_or(criterion, "least_deflection_m", 0),
                     number_or(criterion, "vertical_force_N", 0),
                     number_or(criterion, "tilting_capacity_N", 0)};
  else if (criterion.find("least_path_m"))
    event.resurfacing = {number(criterion, "path_m"), number(criterion, "least_path_m"),
                         number(criterion, "waited_s"), number(criterion, "longest_wait_s")};
  else if (criterion.find("least_width_m"))
    event.grinding = {number(criterion, "overlap_area_m2"), number(criterion, "least_area_m2"),
                      number(criterion, "width_m"), number(criterion, "least_width_m")};
  else
    event.criteria = criteria_of(criterion);
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

std::string_view kind_of(const JsonValue& line) {
  return member(line, "kind", JsonValue::Kind::kText).text();
}

simulation::BirthRecord birth_of(const JsonValue& line) {
  simulation::BirthRecord birth;
  birth.floe = floe_id(line, "floe_id");
  birth.parent = floe_id(line, "parent_id");
  birth.time = number(line, "born_s");
  birth.generation = static_cast<int>(number(line, "generation"));
  birth.area = number(line, "area_m2");
  birth.mass = number(line, "mass_kg");
  birth.centroid_in_body = point(line, "centroid_m");
  return birth;
}

simulation::Event event_of(const JsonValue& line, const simulation::Scene& scene) {
  simulation::Event event;
  event.time = number(line, "t_s");
  event.kind = event_kind(member(line, "kind", JsonValue::Kind::kText).text());
  event.ship = ship_index(scene, member(line, "ship", JsonValue::Kind::kText).text());
  if (const JsonValue* by = line.find("by_floe")) event.by_floe = floe_id(*by);
  event.floe = floe_id(line, "floe");
  for (const JsonValue& child : member(line, "children", JsonValue::Kind::kArray).items())
    event.children.push_back(floe_id(child));
  event.point_in_world = point(line, "point_m");
  const geometry::Point normal = point(line, "normal");
  event.normal_in_world = {normal.x, normal.y};
  read_criterion(member(line, "criterion", JsonValue::Kind::kObject), event);
  event.penetration = number(line, "penetration_m");
  event.cusp_radius = number_or(line, "cusp_radius_m", 0);
  event.submerged_area = number(line, "submerged_area_m2");
  event.under_hull_area = number_or(line, "under_hull_area_m2", 0);
  event.under_ice_area = number_or(line, "under_ice_area_m2", 0);
  event.brash_area = number(line, "brash_area_m2");
  event.rounding_defect = number(line, "rounding_defect_m2");
  if (const JsonValue* reason = line.find("reason", JsonValue::Kind::kText)) event.reason = reason->text();
  return event;
}

simulation::ShipContact ship_contact_of(const JsonValue& line, const simulation::Scene& scene) {
  simulation::ShipContact contact;
  contact.time = number(line, "t_s");
  contact.ship = ship_index(scene, member(line, "ship", JsonValue::Kind::kText).text());
  contact.other = ship_index(scene, member(line, "by_ship", JsonValue::Kind::kText).text());
  if (contact.ship < 0 || contact.other < 0) throw ReadError("a contact of ships that are not in the scene");
  contact.point_in_world = point(line, "point_m");
  contact.closing_speed = number(line, "closing_speed_m_per_s");
  contact.relative_speed = number(line, "relative_speed_m_per_s");
  contact.is_prescribed = member(line, "is_prescribed", JsonValue::Kind::kBoolean).boolean();
  return contact;
}

simulation::MooringBreak mooring_break_of(const JsonValue& line, const simulation::Scene& scene) {
  simulation::MooringBreak broken;
  broken.time = number(line, "t_s");
  broken.ship = ship_index(scene, member(line, "ship", JsonValue::Kind::kText).text());
  if (broken.ship < 0) throw ReadError("a mooring of a ship that is not in the scene");
  broken.point_in_world = point(line, "point_m");
  broken.force = number(line, "force_N");
  broken.break_load = number(line, "break_load_N");
  const geometry::Point offset = point(line, "offset_m");
  broken.offset_in_moored_place = {offset.x, offset.y};
  return broken;
}

simulation::ShipSample sample_of(std::string_view line, const std::vector<const ForceColumn*>& columns,
                                 const simulation::Scene& scene) {
  simulation::ShipSample s;
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
  return crushed;
}

RunContact contact_of(std::string_view line, const Run& run) {
  RunContact contact;
  contact.time = take_number(line);
  simulation::ContactState& state = contact.state;
  state.on = body_of(line, run);
  state.by = body_of(line, run);
  for (double* value :
       {&state.point_in_world.x, &state.point_in_world.y, &state.force.x, &state.force.y, &state.depth})
    *value = take_number(line);
  state.is_crushing = take_number(line) != 0;
  return contact;
}

}  // namespace polynya::io
