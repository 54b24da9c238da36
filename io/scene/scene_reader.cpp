#include "io/scene/scene_reader.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "io/scene/floe_group.hpp"
#include "io/scene/floe_list_reader.hpp"
#include "io/scene/pilot_check.hpp"
#include "io/scene/scene_check.hpp"
#include "io/scene/scene_hints.hpp"
#include "io/scene/scene_presets.hpp"
#include "io/scene/scene_resolve.hpp"
#include "io/scene/ship_completion.hpp"
#include "io/scene/wall_check.hpp"
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

/// Reads a scene's text into a draft. One use.
class SceneReader {
 public:
  SceneReader(std::string text, const std::string& name, std::filesystem::path folder)
      : folder_(std::move(folder)), problems_(SourceText{name, std::move(text)}) {}

  SceneOutcome read(const std::string& default_name, const SceneOverrides& overrides, std::size_t longest) {
    JsonDocument document = parse_json(problems_.source(0).text);
    problems_.add_faults(0, document.faults);
    if (std::ranges::any_of(document.faults, [](const JsonFault& fault) { return fault.path.empty(); }))
      return tl::unexpected(problems_.take());
    assign(document.root, overrides.assignments, problems_);
    if (!document.root.find("name")) put(document.root, "name", default_name);
    override_scene(document.root, overrides);
    fill_in_presets(document.root);
    resolved_ = resolve_scene(document.root, problems_);
    if (resolved_.members().empty()) return tl::unexpected(problems_.take());
    hold_constant_speeds(document.root);
    choose_fate_of_ice(document.root);
    choose_hull_water(document.root, resolved_);
    choose_skin_drag(document.root, resolved_);
    build();
    fill_in_masses(draft_, resolved_);
    check_ice(draft_, resolved_, problems_);
    if (problems_.count() > 0) return tl::unexpected(problems_.take());
    add_scene_hints(draft_, resolved_, problems_);
    std::vector<Problem> hints = problems_.take();
    LoadedScene loaded{std::move(draft_.scene), std::move(draft_.description),
                       to_json_text(resolved_), "",
                       std::move(fields_),      std::move(files_),
                       std::move(ice_),         std::move(hints)};
    if (const std::size_t length = loaded.resolved_text.size(); length > longest) {
      report(0, "", fmt::format("{} bytes with every default filled in and floe files read in", length),
             fmt::format("at most {} bytes: fewer floes, or coordinates of fewer digits", longest));
      return tl::unexpected(problems_.take());
    }
    loaded.hash = hash_of(loaded.resolved_text);
    return loaded;
  }

 private:
  void report(std::uint32_t offset, std::string path, std::string found, std::string allowed) {
    problems_.report(0, offset, std::move(path), std::move(found), std::move(allowed));
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
        report(speed.offset, fmt::format("ships[{}].speed_m_per_s", i), show(speed),
               fmt::format("the constant speed, {} [m/s], or nothing", show(*held)));
      }
      speed.data = held->number();
    }
  }

  /// Ice goes under hulls with a draught and comes up behind them, unless the scene states otherwise.
  void choose_fate_of_ice(const JsonValue& root) {
    const auto is_given = [&](std::string_view object, std::string_view key) {
      const JsonValue* fracture = root.find("fracture");
      const JsonValue* in = fracture && !object.empty() ? fracture->find(object) : fracture;
      return in && in->find(key) != nullptr;
    };
    bool has_draught = false;
    for (const JsonValue& ship : resolved_.find("ships")->items()) {
      const JsonValue* hull = ship.find("hull");
      has_draught = has_draught || (hull && hull->find("draught_m"));
    }
    JsonValue* fracture = resolved_.find("fracture");
    JsonValue* fate = fracture ? fracture->find("cusp_fate") : nullptr;
    JsonValue* tilting = fracture ? fracture->find("going_under")->find("enabled") : nullptr;
    JsonValue* coming_up = fracture ? fracture->find("resurface")->find("enabled") : nullptr;
    if (!fate || !tilting || !coming_up) return;
    if (has_draught && !is_given("", "cusp_fate")) fate->data = std::string("under_hull");
    if (!is_given("going_under", "enabled")) tilting->data = has_draught;
    const bool goes_under = has_draught && (fate->text() == "under_hull" || tilting->boolean());
    if (!is_given("resurface", "enabled")) coming_up->data = goes_under;
    const std::string draught = "a hull with a draught (hull.draught_m)";
    if (!has_draught && fate->text() == "under_hull")
      report(fate->offset, "fracture.cusp_fate", "under_hull without " + draught, "submerge or float");
    if (!has_draught && tilting->boolean())
      report(tilting->offset, "fracture.going_under.enabled", "true without " + draught, "false");
    if (!goes_under && coming_up->boolean())
      report(coming_up->offset, "fracture.resurface.enabled", "true where no ice goes under a hull",
             "false, or cusp_fate under_hull, or going_under.enabled");
  }

  /// The floes come last, since fields take long: what needs no ice is checked before (FloeListReader).
  void build() {
    JsonValue floes{JsonValue::Array{}, resolved_.find("floes")->offset};
    FloeListReader reader{folder_, draft_, problems_, floes, fields_, ice_, files_};
    bool is_checked = false;
    const auto check_the_rest = [&] {
      if (std::exchange(is_checked, true)) return;
      complete_pilots(resolved_, draft_, problems_);
      check_without_ice(draft_, resolved_, problems_);
    };
    bind_scene(resolved_, draft_, [&](std::string_view list, std::size_t index, const JsonValue& item) {
      if (list == "floes") check_the_rest();
      if (list == "ships")
        add_ship(index, item);
      else if (list == "structures")
        add_structure(index, item);
      else if (list == "walls")
        add_wall(index, item, draft_, problems_);
      else if (list == "floes")
        reader.add(index, item);
    });
    check_the_rest();
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
    complete_ship(item, fmt::format("ships[{}]", index), draft_, problems_);
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
    draft_.ship_origins.push_back(
        {.offset = item.offset, .group = index, .is_structure = true, .list = "structures"});
  }

  std::filesystem::path folder_;
  ProblemCollector problems_;
  JsonValue resolved_;
  SceneDraft draft_;
  std::vector<FieldReport> fields_;
  std::vector<FileReport> files_;
  std::vector<IceReport> ice_;
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
  return SceneReader(std::move(text), name, folder).read(name_from(name), overrides, longest);
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
