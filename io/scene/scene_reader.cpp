#include "io/scene/scene_reader.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "geometry/exact/validity.hpp"
#include "io/scene/floe_group.hpp"
#include "io/scene/geojson_reader.hpp"
#include "io/scene/scene_check.hpp"
#include "io/scene/scene_hints.hpp"
#include "io/scene/scene_resolve.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;

/// FNV-1a, 64 bits.
std::string hash_of(std::string_view text) {
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return fmt::format("{:016x}", hash);
}

void put(JsonValue& object, const std::string& key, JsonValue::Data data) {
  if (!object.is(JsonKind::kObject)) return;
  JsonValue* member = object.find(key);
  if (!member)
    member = &object.members().emplace_back(JsonMember{key, object.offset, {nullptr, object.offset}}).value;
  member->data = std::move(data);
}

void override_scene(JsonValue& root, const SceneOverrides& overrides) {
  if (overrides.seed) put(root, "seed", static_cast<double>(*overrides.seed));
  if (!overrides.until) return;
  if (!root.find("time")) put(root, "time", JsonValue::Object{});
  if (JsonValue* time = root.find("time")) put(*time, "until_s", *overrides.until);
}

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

/// Reads a scene's text into a draft. One use.
class SceneReading {
 public:
  SceneReading(std::string text, const std::string& name, std::filesystem::path folder)
      : folder_(std::move(folder)), problems_(SourceText{name, std::move(text)}) {}

  SceneOutcome read(const std::string& default_name, const SceneOverrides& overrides, std::size_t longest) {
    JsonDocument document = parse_json(problems_.source(0).text);
    bool is_cut_short = false;
    for (const JsonFault& fault : document.faults) {
      problems_.add(
          0, fault.offset,
          {.path = fault.path, .found = fault.found, .allowed = fault.allowed, .sentence = fault.sentence});
      is_cut_short = is_cut_short || fault.path.empty();
    }
    if (is_cut_short) return tl::unexpected(problems_.take());
    if (!document.root.find("name")) put(document.root, "name", default_name);
    override_scene(document.root, overrides);
    resolved_ = resolve_scene(document.root, problems_);
    if (resolved_.members().empty()) return tl::unexpected(problems_.take());
    hold_constant_speeds(document.root);
    build();
    check_scene(draft_, resolved_, problems_);
    if (problems_.count() > 0) return tl::unexpected(problems_.take());
    add_scene_hints(draft_, resolved_, problems_);
    std::vector<Problem> hints = problems_.take();
    LoadedScene loaded{std::move(draft_.scene), std::move(draft_.description),
                       to_json_text(resolved_), "",
                       std::move(fields_),      std::move(hints)};
    if (const std::size_t length = loaded.resolved_text.size(); length > longest) {
      tell(0, "", fmt::format("{} bytes with every default filled in and floe files read in", length),
           fmt::format("at most {} bytes: fewer floes, or coordinates of fewer digits", longest));
      return tl::unexpected(problems_.take());
    }
    loaded.hash = hash_of(loaded.resolved_text);
    return loaded;
  }

 private:
  void tell(std::uint32_t offset, std::string path, std::string found, std::string allowed) {
    problems_.add(0, offset,
                  {.path = std::move(path), .found = std::move(found), .allowed = std::move(allowed)});
  }

  /// A ship at constant speed starts at that speed.
  void hold_constant_speeds(const JsonValue& root) {
    JsonValue* ships = resolved_.find("ships");
    for (std::size_t i = 0; i < ships->items().size(); ++i) {
      JsonValue& ship = ships->items()[i];
      const JsonValue* propulsion = ship.find("propulsion");
      const JsonValue* held = propulsion ? propulsion->find("constant_speed_m_per_s") : nullptr;
      if (!held) continue;
      JsonValue& speed = *ship.find("speed_m_per_s");
      const bool is_given = root.find("ships")->items()[i].find("speed_m_per_s") != nullptr;
      if (is_given && speed.number() != held->number()) {
        tell(speed.offset, fmt::format("ships[{}].speed_m_per_s", i), show(speed),
             fmt::format("the constant speed, {} [m/s], or nothing", show(*held)));
      }
      speed.data = held->number();
    }
  }

  void build() {
    JsonValue floes{JsonValue::Array{}, resolved_.find("floes")->offset};
    bind_scene(resolved_, draft_, [&](std::string_view list, std::size_t index, const JsonValue& item) {
      if (list == "ships")
        add_ship(index, item);
      else if (list == "structures")
        add_structure(index, item);
      else
        add_floes(index, item, floes);
    });
    *resolved_.find("floes") = std::move(floes);
  }

  void add_ship(std::size_t index, const JsonValue& item) {
    simulation::ShipSpec& ship = draft_.ship();
    simulation::Hull& hull = ship.hull;
    if (draft_.hull_length > 0) {
      hull.waterline =
          simulation::wedge_bow_waterline(draft_.hull_length, draft_.hull_beam, draft_.hull_entrance_angle);
    } else if (geometry::Polygon outline{hull.waterline, {}};
               in_house_notation(outline).outer != hull.waterline) {
      const std::size_t given = hull.waterline.size();
      hull.waterline = in_house_notation(outline).outer;
      auto& angles = hull.angles_from_vertical;
      if (angles.size() == given) angles.resize(hull.waterline.size());
      if (hull.waterline.front() != outline.outer.front()) std::ranges::reverse(angles);
    }
    draft_.ship_origins.push_back({.offset = item.offset, .group = index});
  }

  /// A structure is a ship that stands on the ground.
  void add_structure(std::size_t index, const JsonValue& item) {
    simulation::ShipSpec& structure = draft_.ship();
    simulation::Hull& hull = structure.hull;
    hull.waterline = draft_.structure_radius > 0
                         ? simulation::cylinder_waterline(draft_.structure_radius)
                         : in_house_notation(geometry::Polygon{hull.waterline, {}}).outer;
    hull.angles_from_vertical.assign(hull.waterline.size(), draft_.structure_slope);
    structure.mass = structure.moment_of_inertia = std::numeric_limits<double>::infinity();
    structure.propulsion = simulation::FixedInPlace{};
    draft_.ship_origins.push_back({.offset = item.offset, .group = index, .is_structure = true});
  }

  void add_floes(std::size_t index, const JsonValue& item, JsonValue& resolved_floes) {
    const std::string path = fmt::format("floes[{}]", index);
    const FloeGroup& group = draft_.group;
    if (group.form == FloeGroup::Form::kFile) return add_file(index, item, resolved_floes);
    if (group.form == FloeGroup::Form::kField) return add_field(index, item, resolved_floes);
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
    resolved_floes.items().push_back(item);
  }

  void add_field(std::size_t index, const JsonValue& item, JsonValue& resolved_floes) {
    const std::string path = fmt::format("floes[{}].field", index);
    const JsonValue& json = *item.find("field");
    simulation::FloeField field = draft_.group.field;
    complete(field);
    if (!check_rings(field, json, path)) return;
    const double count = simulation::floe_count(field);
    if (count < 1)
      return tell(json.offset, path, "room for less than one floe",
                  "a region for some floes of floe_size_m at the concentration");
    if (!has_room_for(static_cast<std::size_t>(std::min(count, 1e9)), item, path)) return;
    simulation::FloeFieldOutcome outcome = simulation::make_floe_field(field);
    if (outcome.reachable_concentration < field.concentration)
      return tell(json.find("concentration")->offset, path + ".concentration",
                  show(*json.find("concentration")),
                  fmt::format("at most {:.3g} with this gap_m", outcome.reachable_concentration));
    int member = 0;
    for (geometry::Polygon& floe : outcome.floes) {
      add_floe(std::move(floe),
               {.offset = item.offset, .group = index, .member = member++, .is_known_valid = true});
    }
    outcome.floes.clear();
    fields_.push_back({index, std::move(outcome)});
    resolved_floes.items().push_back(item);
  }

  /// What a field needs to know of the rest of the scene.
  void complete(simulation::FloeField& field) const {
    const FloeGroup& group = draft_.group;
    field.is_rectangle = group.extent != geometry::Vector{};
    field.region = field.is_rectangle ? rectangle(group.origin, group.extent).outer
                                      : in_house_notation({field.region, {}}).outer;
    field.seed += draft_.scene.seed;
    for (geometry::Polygon& clear : field.kept_clear) clear = in_house_notation(std::move(clear));
    for (const auto& ship : draft_.scene.ships) {
      if (ship.hull.waterline.size() >= 3) field.kept_clear.push_back(waterline_in_world(ship));
    }
  }

  bool check_rings(const simulation::FloeField& field, const JsonValue& json, const std::string& path) {
    const auto check = [&](const geometry::Ring& ring, const JsonValue& at, const std::string& key) {
      const auto defect = geometry::find_defect({ring, {}});
      if (defect) tell(at.offset, path + "." + key, "an invalid ring: " + describe(*defect), "a simple ring");
      return !defect;
    };
    bool is_good = field.is_rectangle || check(field.region, *json.find("outline_m"), "outline_m");
    const JsonValue& rings = *json.find("keep_clear_m");
    for (std::size_t i = 0; i < rings.items().size(); ++i) {
      const std::string key = fmt::format("keep_clear_m[{}]", i);
      is_good = check(field.kept_clear[i].outer, rings.items()[i], key) && is_good;
    }
    return is_good;
  }

  bool check_lattice(const JsonValue& item, const std::string& path) {
    const FloeGroup& group = draft_.group;
    const bool is_too_wide = (group.size.x > group.pitch.x && group.columns > 1) ||
                             (group.size.y > group.pitch.y && group.rows > 1);
    if (is_too_wide)
      tell(item.find("lattice")->find("size_m")->offset, path + ".lattice.size_m",
           fmt::format("{} × {} m, more than the pitch", group.size.x, group.size.y),
           fmt::format("at most pitch_m, {} × {} m, or neighbours overlap", group.pitch.x, group.pitch.y));
    const auto count = static_cast<std::size_t>(group.columns) * static_cast<std::size_t>(group.rows);
    return !is_too_wide && has_room_for(count, item, path);
  }

  bool has_room_for(std::size_t count, const JsonValue& item, const std::string& path) {
    if (draft_.scene.floes.size() + count <= kMostFloes) return true;
    tell(item.offset, path, fmt::format("{} floes in all", draft_.scene.floes.size() + count),
         fmt::format("at most {}", kMostFloes));
    return false;
  }

  void add_file(std::size_t index, const JsonValue& item, JsonValue& resolved_floes) {
    const std::string path = fmt::format("floes[{}].file", index);
    const JsonValue& file = *item.find("file");
    const auto found = locate(file.text());
    if (!found)
      return tell(file.offset, path, show(file) + ": " + found.error(),
                  "a GeoJSON file in the scene's folder or below");
    auto text = read_text_file(*found, kLongestFloesFile);
    if (!text)
      return tell(file.offset, path, show(file) + ": " + text.error(),
                  fmt::format("a file of at most {} bytes", kLongestFloesFile));
    const std::size_t source = problems_.add_source({found->string(), std::move(*text)});
    const auto [polygons, run_time] = read_geojson(source, problems_);
    if (run_time) draft_.run_times[source] = *run_time;
    if (!has_room_for(polygons.size(), item, path)) return;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      add_floe(
          polygons[i].polygon,
          {.source = source, .offset = polygons[i].offset, .group = index, .member = static_cast<int>(i)});
      JsonValue spelled_out{JsonValue::Object{}, item.offset};
      spelled_out.members().push_back({"polygon", 0, to_json(polygons[i].polygon)});
      for (const JsonMember& member : item.members()) {
        if (member.key != "file") spelled_out.members().push_back(member);
      }
      resolved_floes.items().push_back(std::move(spelled_out));
    }
  }

  /// The path of a file named in the scene, if it stays in the scene's folder, links followed.
  tl::expected<std::filesystem::path, std::string> locate(const std::string& name) const {
    namespace fs = std::filesystem;
    std::error_code error;
    if (name.empty() || fs::path(name).is_absolute())
      return tl::unexpected(std::string("not a relative path"));
    const fs::path folder = fs::canonical(folder_.empty() ? "." : folder_, error);
    if (error) return tl::unexpected(error.message());
    const fs::path target = fs::weakly_canonical(folder / name, error);
    if (error) return tl::unexpected(error.message());
    const auto [end, unused] = std::ranges::mismatch(folder, target);
    if (end != folder.end()) return tl::unexpected(std::string("it leaves the scene's folder"));
    return folder_ / name;
  }

  void add_floe(geometry::Polygon polygon, Origin origin) {
    draft_.scene.floes.push_back({std::move(polygon), draft_.group.velocity, draft_.group.angular_velocity});
    draft_.floe_origins.push_back(origin);
  }

  std::filesystem::path folder_;
  ProblemCollector problems_;
  JsonValue resolved_;
  SceneDraft draft_;
  std::vector<FieldReport> fields_;
};

/// A file's stem as a scene's name.
std::string name_from(const std::string& file) {
  std::string name = std::filesystem::path(file).stem().string().substr(0, 100);
  const auto is_plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  std::ranges::replace_if(
      name, [&](char c) { return !is_plain(c) && c != '.' && c != '_' && c != '-'; }, '-');
  return name.empty() || !is_plain(name.front()) ? "scene" : name;
}

}  // namespace

SceneOutcome read_scene(std::string text, const std::string& name, const std::filesystem::path& folder,
                        const SceneOverrides& overrides, std::size_t longest) {
  return SceneReading(std::move(text), name, folder).read(name_from(name), overrides, longest);
}

SceneOutcome read_scene_file(const std::filesystem::path& path, const SceneOverrides& overrides) {
  auto text = read_text_file(path, kLongestScene);
  if (!text) {
    return tl::unexpected(
        std::vector<Problem>{{.file = path.string(),
                              .found = text.error(),
                              .allowed = fmt::format("a scene of at most {} bytes", kLongestScene)}});
  }
  return read_scene(std::move(*text), path.string(), path.parent_path(), overrides);
}

}  // namespace polynya::io
