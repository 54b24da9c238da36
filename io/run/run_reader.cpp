#include "io/run/run_reader.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "geometry/shape/pose.hpp"
#include "io/run/force_columns.hpp"
#include "io/run/records.hpp"
#include "io/run/run_folder.hpp"
#include "io/text/csv_row.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {
namespace {

using simulation::FloeId;

/// What is wrong with a file; told to the caller of read_run as its error value.
struct ReadError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string text_of(const std::filesystem::path& folder, std::string_view name) {
  auto text = read_text_file(folder / name, kLongestRunFile);
  if (!text) throw ReadError(fmt::format("{}: {}", (folder / name).string(), text.error()));
  return std::move(*text);
}

/// Uses each whole line of a file.
template <class Use>
void for_lines(const std::filesystem::path& folder, std::string_view name, Use use) {
  const std::string text = text_of(folder, name);
  std::size_t start = 0;
  for (int number = 1;; ++number) {
    const std::size_t end = text.find('\n', start);
    if (end == std::string::npos) return;
    try {
      use(std::string_view(text).substr(start, end - start), number);
    } catch (const ReadError& damage) {
      throw ReadError(fmt::format("{}:{}: {}", (folder / name).string(), number, damage.what()));
    }
    start = end + 1;
  }
}

JsonValue json_of(std::string_view text) {
  JsonDocument document = parse_json(text);
  if (!document.faults.empty()) throw ReadError("not JSON: " + document.faults.front().found);
  return std::move(document.root);
}

const JsonValue& member(const JsonValue& value, std::string_view key, JsonValue::Kind kind) {
  const JsonValue* found = value.find(key);
  if (!found || !found->is(kind)) throw ReadError(fmt::format("\"{}\" is not {}", key, name_of(kind)));
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

int ship_index(const simulation::Scene& scene, std::string_view name) {
  const auto found = std::ranges::find(scene.ships, name, &simulation::ShipSpec::name);
  return found == scene.ships.end() ? -1 : static_cast<int>(found - scene.ships.begin());
}

simulation::EventKind event_kind(std::string_view name) {
  for (const auto kind :
       {simulation::EventKind::kBend, simulation::EventKind::kSplit, simulation::EventKind::kRejectedCut}) {
    if (name_of(kind) == name) return kind;
  }
  throw ReadError(fmt::format("an unknown kind of event, \"{}\"", name));
}

simulation::Event event_of(const JsonValue& line, const simulation::Scene& scene) {
  simulation::Event event;
  event.time = number(line, "t_s");
  event.kind = event_kind(member(line, "kind", JsonValue::Kind::kText).text());
  event.ship = ship_index(scene, member(line, "ship", JsonValue::Kind::kText).text());
  event.floe = floe_id(line, "floe");
  for (const JsonValue& child : member(line, "children", JsonValue::Kind::kArray).items())
    event.children.push_back(floe_id(child));
  event.point_in_world = point(line, "point_m");
  const geometry::Point normal = point(line, "normal");
  event.normal_in_world = {normal.x, normal.y};
  const JsonValue& criterion = member(line, "criterion", JsonValue::Kind::kObject);
  event.criteria.floe_size = number(criterion, "floe_size_m");
  event.criteria.breakable_size = number(criterion, "breakable_size_m");
  event.criteria.collision_force = number(criterion, "collision_force_N");
  event.criteria.splitting_force = number(criterion, "splitting_force_N");
  event.criteria.crack_length = number(criterion, "crack_length_m");
  event.criteria.vertical_force = number(criterion, "vertical_force_N");
  event.criteria.bending_capacity = number(criterion, "bending_capacity_N");
  event.penetration = number(line, "penetration_m");
  event.cusp_radius = number_or(line, "cusp_radius_m", 0);
  event.submerged_area = number(line, "submerged_area_m2");
  event.brash_area = number(line, "brash_area_m2");
  event.rounding_defect = number(line, "rounding_defect_m2");
  if (const JsonValue* reason = line.find("reason"); reason && reason->is(JsonValue::Kind::kText))
    event.reason = reason->text();
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

double take_number(std::string_view& row) {
  const std::string_view field = csv_field(row);
  const auto value = csv_number(field);
  if (!value) throw ReadError(fmt::format("\"{}\" is not a number", field));
  return *value;
}

simulation::ShipSample sample_of(std::string_view line, const std::vector<const ForceColumn*>& columns,
                                 const simulation::Scene& scene) {
  simulation::ShipSample s;
  s.time = take_number(line);
  s.ship = ship_index(scene, csv_field(line));
  for (const ForceColumn* column : columns) column->store(s, take_number(line));
  return s;
}

simulation::ContactState::Body body_of(std::string_view& line, const Run& run) {
  const std::string_view ship = csv_field(line);
  std::string_view floe = csv_field(line);
  simulation::ContactState::Body body{ship_index(run.scene.scene, ship), simulation::kNoFloe};
  if (ship.empty()) body.floe = static_cast<FloeId>(take_number(floe));
  if (body.ship < 0 && !run.floe(body.floe)) throw ReadError("a contact of what there is not");
  return body;
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

/// Uses each row of a table whose first line is to be the header.
template <class Use>
void for_rows(const std::filesystem::path& folder, std::string_view name, std::string_view header, Use use) {
  for_lines(folder, name, [&](std::string_view line, int number) {
    if (number > 1)
      use(line);
    else if (header.substr(0, line.size()) != line)
      throw ReadError("columns of another version");
  });
}

void check_version(const Run& run) {
  const JsonValue* found = run.summary.find("folder_version");
  if (!found) return;
  const double version = found->is(JsonValue::Kind::kNumber) ? found->number() : std::nan("");
  if (!(version <= kRunFolderVersion))
    throw ReadError(fmt::format("{}: a run folder of version {}; this program reads up to {}",
                                (run.folder / run_file::kSummary).string(), version, kRunFolderVersion));
}

void read_floes(Run& run) {
  for_lines(run.folder, run_file::kFloes, [&](std::string_view line, int) {
    const JsonValue json = json_of(line);
    const simulation::BirthRecord birth = birth_of(json);
    if (birth.floe != static_cast<FloeId>(run.floes.size()))
      throw ReadError("floes are not in the order of their ids");
    auto shape = read_shape(json);
    if (!shape) throw ReadError(shape.error());
    if (const auto added = run.shapes.add(std::move(*shape), birth.parent); !added)
      throw ReadError(added.error());
    run.floes.push_back({.birth = birth, .died = std::numeric_limits<double>::infinity(), .death_event = {}});
  });
}

void read_events(Run& run) {
  for_lines(run.folder, run_file::kEvents, [&](std::string_view line, int) {
    const JsonValue json = json_of(line);
    if (member(json, "kind", JsonValue::Kind::kText).text() == kShipContactKind) {
      run.ship_contacts.push_back(ship_contact_of(json, run.scene.scene));
      return;
    }
    simulation::Event event = event_of(json, run.scene.scene);
    if (!run.floe(event.floe)) throw ReadError(fmt::format("floe {} was never born", event.floe));
    if (event.kind != simulation::EventKind::kRejectedCut) {
      RunFloe& broken = run.floes[static_cast<std::size_t>(event.floe)];
      broken.died = event.time;
      broken.death_event = run.events.size();
    }
    run.events.push_back(std::move(event));
  });
}

void read_forces(Run& run) {
  std::vector<const ForceColumn*> columns;
  for_lines(run.folder, run_file::kForces, [&](std::string_view line, int number) {
    if (number > 1) return run.samples.push_back(sample_of(line, columns, run.scene.scene));
    auto found = force_columns_in(line);
    if (!found) throw ReadError(found.error());
    columns = std::move(*found);
  });
}

/// Why a folder without a scene is none of a run.
std::string what_is_missing(const std::filesystem::path& folder) {
  std::error_code error;
  const auto status = std::filesystem::status(folder, error);
  if (!exists(status)) return "does not exist";
  return is_directory(status) ? fmt::format("has no {}", run_file::kScene) : "is a file";
}

}  // namespace

std::vector<FloeId> Run::lineage(FloeId id) const {
  std::vector<FloeId> ids;
  while (const RunFloe* at = floe(id)) {
    ids.push_back(id);
    if (at->birth.parent >= id) break;  // a parent is older than its child
    id = at->birth.parent;
  }
  std::ranges::reverse(ids);
  return ids;
}

std::span<const RunContact> Run::contacts_at(double time) const {
  const auto first = std::ranges::lower_bound(contacts, time, {}, &RunContact::time);
  const auto last = std::ranges::upper_bound(contacts, time, {}, &RunContact::time);
  return {first, last};
}

tl::expected<Run, std::string> read_run(const std::filesystem::path& folder) {
  try {
    Run run;
    run.folder = folder;
    if (std::error_code error; !std::filesystem::is_regular_file(folder / run_file::kScene, error))
      return tl::unexpected(fmt::format("not a run folder: {} {}", folder.string(), what_is_missing(folder)));
    auto scene = read_scene_file(folder / run_file::kScene);
    if (!scene) return tl::unexpected(to_string(scene.error().front()));
    run.scene = std::move(*scene);
    run.label = run.scene.scene.name;
    run.summary = json_of(text_of(folder, run_file::kSummary));
    check_version(run);
    read_floes(run);
    read_events(run);
    read_forces(run);
    if (std::filesystem::exists(folder / run_file::kContacts))
      for_rows(folder, run_file::kContacts, contacts_header(),
               [&](std::string_view line) { run.contacts.push_back(contact_of(line, run)); });
    auto frames = decode_frames(text_of(folder, run_file::kFrames));
    if (!frames)
      return tl::unexpected(fmt::format("{}: {}", (folder / run_file::kFrames).string(), frames.error()));
    run.frames = std::move(*frames);
    return run;
  } catch (const ReadError& damage) {
    return tl::unexpected(std::string(damage.what()));
  }
}

}  // namespace polynya::io
