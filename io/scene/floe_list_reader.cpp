#include "io/scene/floe_list_reader.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "geometry/shape/pose.hpp"
#include "io/scene/field_reader.hpp"
#include "simulation/world/setup.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using geometry::Vector;

void open_ring(Ring& ring) {
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
}

std::vector<Polygon> floes_of(const LatticeInput& lattice) {
  std::vector<Polygon> floes;
  floes.reserve(static_cast<std::size_t>(lattice.columns) * static_cast<std::size_t>(lattice.rows));
  const Vector margin = 0.5 * (lattice.pitch - lattice.size);
  for (int row = 0; row < lattice.rows; ++row) {
    for (int column = 0; column < lattice.columns; ++column) {
      const Vector cell{column * lattice.pitch.x, row * lattice.pitch.y};
      floes.push_back(rectangle(lattice.origin + cell + margin, lattice.size));
    }
  }
  return floes;
}

Polygon floe_of(const RectangleInput& input) {
  Polygon floe = rectangle(input.corner, input.size);
  if (input.angle == 0) return floe;
  const geometry::Pose turned{input.corner, geometry::Rotation::by(input.angle)};
  for (Point& p : floe.outer) p = transform(turned, Point{} + (p - input.corner));
  return floe;
}

}  // namespace

Polygon rectangle(Point corner, Vector size) {
  return {{corner, {corner.x + size.x, corner.y}, corner + size, {corner.x, corner.y + size.y}}, {}};
}

Polygon in_house_notation(Polygon polygon) {
  open_ring(polygon.outer);
  if (geometry::signed_area(polygon.outer) < 0) std::ranges::reverse(polygon.outer);
  for (Ring& hole : polygon.holes) {
    open_ring(hole);
    if (geometry::signed_area(hole) > 0) std::ranges::reverse(hole);
  }
  return polygon;
}

void FloeListReader::add(std::size_t index, FloeGroup group, const JsonValue& item) {
  index_ = index;
  item_ = &item;
  path_ = fmt::format("floes[{}]", index);
  group_ = std::move(group);
  check_fast_ice(group_.is_fast);
  auto ice_of_group = GroupIce::of(draft_.scene, group_, item, path_, problems_);
  if (!ice_of_group) return;
  ice_ = std::move(*ice_of_group);
  std::visit([&](auto& form) { add_floes(form); }, group_.form);
  for (IceReport& one : ice_.reports(index)) ice.push_back(one);
}

/// Fast ice does not turn, and what rigid impulses do between two prescribed motions is not defined.
void FloeListReader::check_fast_ice(bool is_fast) {
  if (!is_fast) return;
  if (group_.is_fast && group_.angular_velocity != 0)
    report(offset_of("angular_velocity_deg_per_s"), path_ + ".angular_velocity_deg_per_s",
           fmt::format("{:g}, of fast ice", from_si("°", group_.angular_velocity)), "0: fast ice does not turn");
  if (draft_.scene.contact.law == simulation::ContactLaw::kImpulse)
    report(offset_of("fast_ice"), path_ + ".fast_ice", "true with contact.law impulse", "contact.law crush, or false");
}

void FloeListReader::add_floes(const LatticeInput& lattice) {
  const bool is_too_wide = (lattice.size.x > lattice.pitch.x && lattice.columns > 1) ||
                           (lattice.size.y > lattice.pitch.y && lattice.rows > 1);
  if (is_too_wide)
    report(offset_of("lattice.size_m"), path_ + ".lattice.size_m",
           fmt::format("{} × {} m, more than the pitch", lattice.size.x, lattice.size.y),
           fmt::format("at most pitch_m, {} × {} m, or neighbours overlap", lattice.pitch.x, lattice.pitch.y));
  const auto count = static_cast<std::size_t>(lattice.columns) * static_cast<std::size_t>(lattice.rows);
  if (is_too_wide || !has_room_for(count, path_)) return;
  int member = 0;
  for (geometry::Polygon& floe : floes_of(lattice))
    add_floe(group_, std::move(floe), {},
             {.offset = item_->offset, .group = index_, .member = member++, .is_known_valid = true});
  write_group();
}

void FloeListReader::add_floes(const RectangleInput& rectangle) {
  if (!has_room_for(1, path_)) return;
  add_floe(group_, floe_of(rectangle), {}, {.offset = item_->offset, .group = index_, .is_known_valid = true});
  write_group();
}

void FloeListReader::add_floes(const geometry::Polygon& polygon) {
  if (!has_room_for(1, path_)) return;
  add_floe(group_, in_house_notation(polygon), {}, {.offset = item_->offset, .group = index_});
  write_group();
}

void FloeListReader::add_floes(FieldInput& input) {
  const std::string path = path_ + ".field";
  const auto field = complete_field(input, *item_, path, draft_.scene, problems_);
  if (!field) return;
  const double count = simulation::floe_count(*field);
  if (count < 1)
    return report(offset_of("field"), path, "room for less than one floe",
                  "a region for some floes of that size at the concentration");
  if (!has_room_for(static_cast<std::size_t>(std::min(count, 1e9)), path)) return;
  if (problems_.count() > 0) return;  // a million floes take half a minute; the scene is refused anyway
  simulation::FloeFieldOutcome outcome = simulation::make_floe_field(*field);
  if (!check_cover(*field, outcome, *item_, path, problems_)) return;
  int member = 0;
  for (geometry::Polygon& floe : outcome.floes)
    add_floe(group_, std::move(floe), {},
             {.offset = item_->offset, .group = index_, .member = member++, .is_known_valid = true});
  outcome.floes.clear();
  outcome.floes.shrink_to_fit();
  fields.push_back({index_, field->gap, std::move(outcome)});
  write_group();
}

bool FloeListReader::has_room_for(std::size_t count, const std::string& path) {
  if (draft_.scene.floes.size() + count <= kMostFloes) return true;
  report(item_->offset, path, fmt::format("{} floes in all", draft_.scene.floes.size() + count),
         fmt::format("at most {}", kMostFloes));
  return false;
}

void FloeListReader::add_floes(const FileInput& input) {
  const std::string path = path_ + ".file";
  const std::uint32_t name = offset_of("file");
  const auto found = locate(input.name);
  if (!found)
    return report(name, path, show({input.name}) + ": " + found.error(), "a floe file in the scene's folder or below");
  auto file = read_floe_file(*found, input.import, draft_.scene.origin, path, name, problems_);
  if (!file || !has_room_for(file->floes.size(), path)) return;
  const auto is_fast = [](const FileFloe& floe) { return floe.properties.is_fast.value_or(false); };
  check_fast_ice(!group_.is_fast && std::ranges::any_of(file->floes, is_fast));
  for (std::size_t i = 0; i < file->floes.size(); ++i) {
    const GivenIce given = ice_of(file->floes[i].properties);
    FloeGroup entry = spelled_out(file->floes[i], file->run_time.has_value());
    add_floe(entry, std::get<geometry::Polygon>(entry.form), given,
             {.source = file->source,
              .offset = file->floes[i].offset,
              .group = index_,
              .member = static_cast<int>(i),
              .is_known_valid = file->totals.has_value()});
    entry.ice = ice_.spelled_out(draft_.scene, given);
    written.items().push_back(write(floes_description(), entry));
  }
  const auto with_thickness =
      std::ranges::count_if(file->floes, [](const FileFloe& floe) { return floe.properties.thickness.has_value(); });
  files.push_back({index_, std::move(file->plane), file->run_time, file->totals, file->floes.size(),
                   static_cast<std::size_t>(with_thickness), std::move(file->near_misses), name});
}

/// The entry that a floe of a file is in the resolved scene: what the file states of it stands there instead
/// of what the file's entry has for all. The floe's polygon is moved there.
FloeGroup FloeListReader::spelled_out(FileFloe& floe, bool is_of_run) const {
  const FloeProperties& own = floe.properties;
  const simulation::WaterSettings& water = draft_.scene.water;
  const dynamics::ShearCurrent shear = simulation::current_of(water.shear);
  FloeGroup entry{.is_fast = group_.is_fast || own.is_fast.value_or(false),
                  .velocity = group_.velocity,
                  .angular_velocity = group_.angular_velocity,
                  .has_crushed_overlaps = group_.has_crushed_overlaps,
                  .source_floe = group_.source_floe,
                  .under_hull_of = own.under_hull_of ? own.under_hull_of : group_.under_hull_of,
                  .under_hull_path = own.under_hull_path ? own.under_hull_path : group_.under_hull_path};
  if (own.velocity_x || own.velocity_y) {
    geometry::Vector velocity{own.velocity_x.value_or(0), own.velocity_y.value_or(0)};
    if (!entry.is_fast)  // relative to the water there
      velocity -= water.drift_at(0) + shear.velocity_at(geometry::measure(floe.polygon).centroid);
    entry.velocity = {velocity.x + 0.0, velocity.y + 0.0};  // no −0
  }
  if (own.angular_velocity)
    entry.angular_velocity =
        entry.is_fast ? 0 : to_si("°/s", *own.angular_velocity - from_si("°/s", shear.angular_velocity()));
  if (is_of_run && !entry.has_crushed_overlaps) entry.has_crushed_overlaps = true;
  if (!entry.source_floe) entry.source_floe = own.floe_id;
  entry.form = std::move(floe.polygon);
  return entry;
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

/// The number of the ship under whose hull a floe is; −1, and a report, where there is none with a draught.
int FloeListReader::ship_over(const std::string& name, const Origin& origin) {
  const auto& ships = draft_.scene.ships;
  const auto ship = std::ranges::find(ships, name, &simulation::Ship::name);
  if (ship != ships.end() && ship->hull.draught > 0) return static_cast<int>(ship - ships.begin());
  problems_.report(origin.source, origin.offset, path_ + ".under_hull_of", show({name}),
                   "the name of a ship with a hull.draught_m");
  return -1;
}

void FloeListReader::add_floe(const FloeGroup& group, geometry::Polygon polygon, const GivenIce& given, Origin origin) {
  const std::int32_t own_ice = ice_.add_to(draft_.scene, given);
  draft_.scene.floes.push_back({std::move(polygon), group.velocity, group.angular_velocity, group.is_fast, own_ice,
                                group.has_crushed_overlaps.value_or(false), group.source_floe.value_or(-1),
                                group.under_hull_of ? ship_over(*group.under_hull_of, origin) : -1,
                                group.under_hull_path.value_or(0)});
  draft_.floe_origins.push_back(origin);
}

}  // namespace polynya::io
