#include "io/scene/floe_list_reader.hpp"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "io/scene/field_reader.hpp"
#include "io/scene/floe_group.hpp"
#include "io/scene/scene_resolve.hpp"
#include "simulation/setup.hpp"

namespace polynya::io {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

JsonValue to_json(geometry::Point point) {
  return {JsonValue::Array{{point.x}, {point.y}}};
}
JsonValue to_json(const geometry::Ring& ring) {
  JsonValue value{JsonValue::Array{}};
  for (const geometry::Point p : ring) value.items().push_back(to_json(p));
  return value;
}
JsonValue to_json(const geometry::Polygon& polygon) {
  JsonValue holes{JsonValue::Array{}};
  for (const geometry::Ring& hole : polygon.holes) holes.items().push_back(to_json(hole));
  JsonValue value{JsonValue::Object{}};
  value.members().push_back({"outer_m", 0, to_json(polygon.outer)});
  value.members().push_back({"holes_m", 0, std::move(holes)});
  return value;
}

}  // namespace

void FloeListReader::add(std::size_t index, const JsonValue& item) {
  auto ice = GroupIce::of(draft_, fmt::format("floes[{}]", index), problems_);
  if (!ice) return;
  ice_ = std::move(*ice);
  add_floes(index, item);
  for (IceReport& report : ice_.reports(index)) ice_reports_.push_back(report);
}

void FloeListReader::add_floes(std::size_t index, const JsonValue& item) {
  const std::string path = fmt::format("floes[{}]", index);
  const FloeGroup& group = draft_.group;
  if (group.form == FloeGroup::Form::kFile) return add_file(index, item);
  if (group.form == FloeGroup::Form::kField) return add_field(index, item);
  if (group.form == FloeGroup::Form::kLattice) {
    if (!check_lattice(item, path)) return;
  } else if (!has_room_for(1, item, path)) {
    return;
  }
  const auto polygons = floes_of(group);
  const bool is_rectangle = group.form != FloeGroup::Form::kPolygon;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    add_floe(polygons[i], {.offset = item.offset,
                           .group = index,
                           .member = group.form == FloeGroup::Form::kLattice ? static_cast<int>(i) : -1,
                           .is_known_valid = is_rectangle});
  }
  resolved_.items().push_back(item);
}

void FloeListReader::add_field(std::size_t index, const JsonValue& item) {
  const std::string path = fmt::format("floes[{}].field", index);
  JsonValue completed = item;
  const auto field = complete_field(completed, path, draft_, problems_);
  if (!field) return;
  const double count = simulation::floe_count(*field);
  if (count < 1)
    return report(item.find("field")->offset, path, "room for less than one floe",
                  "a region for some floes of that size at the concentration");
  if (!has_room_for(static_cast<std::size_t>(std::min(count, 1e9)), item, path)) return;
  if (problems_.count() > 0) return;  // a million floes take half a minute; the scene is refused anyway
  simulation::FloeFieldOutcome outcome = simulation::make_floe_field(*field);
  if (!check_cover(*field, outcome, completed, path, problems_)) return;
  int member = 0;
  for (geometry::Polygon& floe : outcome.floes) {
    add_floe(std::move(floe),
             {.offset = item.offset, .group = index, .member = member++, .is_known_valid = true});
  }
  outcome.floes.clear();
  outcome.floes.shrink_to_fit();
  fields_.push_back({index, field->gap, std::move(outcome)});
  resolved_.items().push_back(std::move(completed));
}

bool FloeListReader::check_lattice(const JsonValue& item, const std::string& path) {
  const FloeGroup& group = draft_.group;
  const bool is_too_wide =
      (group.size.x > group.pitch.x && group.columns > 1) || (group.size.y > group.pitch.y && group.rows > 1);
  if (is_too_wide)
    report(item.find("lattice")->find("size_m")->offset, path + ".lattice.size_m",
           fmt::format("{} × {} m, more than the pitch", group.size.x, group.size.y),
           fmt::format("at most pitch_m, {} × {} m, or neighbours overlap", group.pitch.x, group.pitch.y));
  const auto count = static_cast<std::size_t>(group.columns) * static_cast<std::size_t>(group.rows);
  return !is_too_wide && has_room_for(count, item, path);
}

bool FloeListReader::has_room_for(std::size_t count, const JsonValue& item, const std::string& path) {
  if (draft_.scene.floes.size() + count <= kMostFloes) return true;
  report(item.offset, path, fmt::format("{} floes in all", draft_.scene.floes.size() + count),
         fmt::format("at most {}", kMostFloes));
  return false;
}

void FloeListReader::add_file(std::size_t index, const JsonValue& item) {
  const std::string path = fmt::format("floes[{}].file", index);
  const JsonValue& name = *item.find("file");
  const auto found = locate(name.text());
  if (!found)
    return report(name.offset, path, show(name) + ": " + found.error(),
                  "a floe file in the scene's folder or below");
  auto file =
      read_floe_file(*found, draft_.group.file_settings, draft_.scene.origin, path, name.offset, problems_);
  if (!file || !has_room_for(file->floes.size(), item, path)) return;
  for (std::size_t i = 0; i < file->floes.size(); ++i) {
    FileFloe& floe = file->floes[i];
    const std::int32_t own_ice = ice_.add_to(draft_.scene, ice_of(floe.properties));
    draft_.scene.floes.emplace_back().own_ice = own_ice;
    resolved_.items().push_back(spelled_out(floe, item, file->run_time.has_value()));
    fill_in(draft_.scene.floes.back(), resolved_.items().back());
    draft_.scene.floes.back().polygon_in_world = std::move(floe.polygon);
    draft_.floe_origins.push_back({.source = file->source,
                                   .offset = floe.offset,
                                   .group = index,
                                   .member = static_cast<int>(i),
                                   .is_known_valid = file->totals.has_value()});
  }
  const auto with_thickness = std::ranges::count_if(
      file->floes, [](const FileFloe& floe) { return floe.properties.thickness.has_value(); });
  files_.push_back({index, std::move(file->plane), file->run_time, file->totals, file->floes.size(),
                    static_cast<std::size_t>(with_thickness), std::move(file->near_misses), name.offset});
}

/// The entry that the floe of a file that was added last is in the resolved scene: what the file states of it
/// stands there instead of what the file's entry has for all.
JsonValue FloeListReader::spelled_out(const FileFloe& floe, const JsonValue& item, bool is_of_run) const {
  const FloeProperties& own = floe.properties;
  const bool is_fast = draft_.group.is_fast || own.is_fast.value_or(false);
  JsonValue entry{JsonValue::Object{}, item.offset};
  const auto put = [&](std::string_view key, JsonValue value) {
    value.offset = item.offset;
    entry.members().push_back({std::string(key), item.offset, std::move(value)});
  };
  put("polygon", to_json(floe.polygon));
  const geometry::Point centroid = geometry::measure(floe.polygon).centroid;
  const simulation::WaterSettings& water = draft_.scene.water;
  const dynamics::ShearCurrent shear = simulation::current_of(water.shear);
  for (const JsonMember& member : item.members()) {
    if (member.key == "file" || member.key == "import" || member.key == "ice") continue;
    const bool has_velocity = own.velocity_x || own.velocity_y;
    if (member.key == "velocity_m_per_s" && has_velocity) {
      geometry::Vector velocity{own.velocity_x.value_or(0), own.velocity_y.value_or(0)};
      if (!is_fast) velocity -= water.drift + shear.velocity_at(centroid);  // relative to the water there
      put(member.key, to_json(geometry::Point{velocity.x + 0.0, velocity.y + 0.0}));  // no −0
    } else if (member.key == "angular_velocity_deg_per_s" && own.angular_velocity) {
      put(member.key, {is_fast ? 0 : *own.angular_velocity - kDegrees * shear.angular_velocity()});
    } else if (member.key == "fast_ice") {
      put(member.key, {is_fast});
    } else {
      entry.members().push_back(member);
    }
  }
  if (JsonValue ice = ice_.spelled_out(draft_.scene, ice_of(own)); !ice.is_null()) put("ice", std::move(ice));
  if (is_of_run && !item.find("crushed_overlaps")) put("crushed_overlaps", {true});
  if (own.floe_id && !item.find("source_floe_id")) put("source_floe_id", {static_cast<double>(*own.floe_id)});
  return entry;
}

/// What a spelled-out entry has beside its polygon, as reading the resolved scene would find it.
void FloeListReader::fill_in(simulation::FloeSpec& spec, const JsonValue& entry) {
  const JsonValue& velocity = *entry.find("velocity_m_per_s");
  spec.velocity = {velocity.items()[0].number(), velocity.items()[1].number()};
  spec.angular_velocity = entry.find("angular_velocity_deg_per_s")->number() * std::numbers::pi / 180;
  spec.is_fast = entry.find("fast_ice")->boolean();
  const JsonValue* crushed = entry.find("crushed_overlaps");
  spec.has_crushed_overlaps = crushed && crushed->boolean();
  if (const JsonValue* id = entry.find("source_floe_id"))
    spec.source_floe = static_cast<std::int64_t>(id->number());
}

/// The path of a file named in the scene, if it stays in the scene's folder, links followed.
Result<std::filesystem::path> FloeListReader::locate(const std::string& name) const {
  namespace fs = std::filesystem;
  std::error_code error;
  if (name.empty() || fs::path(name).is_absolute()) return fail("not a relative path");
  const fs::path folder = fs::canonical(folder_.empty() ? "." : folder_, error);
  if (error) return fail(error.message());
  const fs::path target = fs::weakly_canonical(folder / name, error);
  if (error) return fail(error.message());
  const auto [end, unused] = std::ranges::mismatch(folder, target);
  if (end != folder.end()) return fail("it leaves the scene's folder");
  return folder_ / name;
}

void FloeListReader::add_floe(geometry::Polygon polygon, Origin origin) {
  const FloeGroup& group = draft_.group;
  const std::int32_t own_ice = ice_.add_to(draft_.scene, {});
  draft_.scene.floes.push_back({std::move(polygon), group.velocity, group.angular_velocity, group.is_fast,
                                own_ice, group.has_crushed_overlaps, group.source_floe});
  draft_.floe_origins.push_back(origin);
}

}  // namespace polynya::io
