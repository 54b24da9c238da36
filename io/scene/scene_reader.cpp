#include "io/scene/scene_reader.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "io/import/import_report.hpp"
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
    JsonDocument document;
    if (!parse(document)) return tl::unexpected(problems_.take());
    assign(document.root, overrides.assignments, problems_);
    if (!document.root.find("name")) put(document.root, "name", default_name);
    override_scene(document.root, overrides);
    if (!complete(document.root)) return tl::unexpected(problems_.take());
    add_scene_hints(draft_, resolved_, problems_);
    for (const FileReport& file : files_) add_file_hints(file);
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

  tl::expected<LoadedShip, std::vector<Problem>> read_ship(ShipUse use) {
    JsonDocument document;
    if (!parse(document)) return tl::unexpected(problems_of_ship());
    JsonValue& given = document.root;
    for (const char* key : {"ships", "floes"}) {
      if (!given.find(key)) continue;
      report(given.offset, "", fmt::format("a scene, with its \"{}\"", key),
             "one ship, as an entry of a scene's \"ships\"");
      return tl::unexpected(problems_of_ship());
    }
    LoadedShip ship{.given = given};
    if (const JsonValue* preset = given.find("ship", JsonKind::kText)) ship.preset = preset->text();
    JsonValue scene{JsonValue::Object{}, given.offset};
    put(scene, "ships", JsonValue::Array{std::move(given)});
    const bool is_valid = complete(scene);
    if (use == ShipUse::kLevelIce) check_for_level_ice(scene.find("ships")->items().front());
    if (!is_valid || problems_.count() > 0) return tl::unexpected(problems_of_ship());
    ship.resolved = std::move(resolved_.find("ships")->items().front());
    if (auto* engine = std::get_if<simulation::Engine>(&draft_.ship().propulsion)) ship.engine = *engine;
    return ship;
  }

 private:
  bool parse(JsonDocument& document) {
    document = parse_json(problems_.source(0).text);
    problems_.add_faults(0, document.faults);
    return std::ranges::none_of(document.faults, [](const JsonFault& fault) { return fault.path.empty(); });
  }

  /// Makes the draft and the resolved scene; false where anything is wrong, which has been reported.
  bool complete(JsonValue& root) {
    fill_in_presets(root);
    resolved_ = resolve_scene(root, problems_);
    if (resolved_.members().empty()) return false;
    hold_constant_speeds(root);
    choose_fate_of_ice(root);
    choose_hull_water(root, resolved_);
    choose_skin_drag(root, resolved_);
    build();
    fill_in_masses(draft_, resolved_);
    check_ice(draft_, resolved_, problems_);
    return problems_.count() == 0;
  }

  std::vector<Problem> problems_of_ship() {
    std::vector<Problem> problems = problems_.take();
    for (Problem& problem : problems) {
      constexpr std::string_view kPrefix = "ships[0]";
      if (!problem.path.starts_with(kPrefix)) continue;
      problem.path.erase(0, kPrefix.size());
      if (problem.path.starts_with('.')) problem.path.erase(0, 1);
    }
    return problems;
  }

  /// What the formulas and the course of `polynya performance` need, of a ship with its preset filled in.
  void check_for_level_ice(const JsonValue& ship) {
    const auto report_at = [&](const JsonValue& at, const std::string& key, std::string found,
                               std::string allowed) {
      report(at.offset, "ships[0]." + key, std::move(found), std::move(allowed));
    };
    const std::string reason = ": the formulas and the course in level ice need it";
    if (const JsonValue* hull = ship.find("hull", JsonKind::kObject)) {
      if (const JsonValue* waterline = hull->find("waterline_m"))
        report_at(*waterline, "hull.waterline_m", "a waterline point by point",
                  "length_m, beam_m and entrance_angle_deg, which the formulas and the course need");
      if (!hull->find("draught_m"))
        report_at(*hull, "hull.draught_m", "nothing", "a number > 0, ≤ 1000 [m]" + reason);
    }
    const JsonValue* propulsion = ship.find("propulsion", JsonKind::kObject);
    if (propulsion && !propulsion->members().empty() && !propulsion->find("engine"))
      report_at(*propulsion, "propulsion.engine", "nothing",
                "an engine, by which is known what the ship can push with");
    if (const JsonValue* mooring = ship.find("mooring"))
      report_at(*mooring, "mooring", "a mooring", "none: the ship sails");
  }

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

  /// Properties of a floe file that are probably meant to be read, and floes without a thickness among
  /// others.
  void add_file_hints(const FileReport& file) {
    const auto add = [&](Severity severity, std::string sentence) {
      problems_.add(0, file.offset,
                    {.path = fmt::format("floes[{}].file", file.group),
                     .sentence = std::move(sentence),
                     .severity = severity});
    };
    const std::string thickness = thickness_in_words(file.with_thickness, file.floes);
    bool is_partial = file.with_thickness > 0 && file.with_thickness < file.floes;
    for (const NearMiss& miss : file.near_misses) {
      if (miss.floes == 0) continue;
      const bool is_thickness = miss.meant == "thickness_m";
      add(Severity::kWarning,
          fmt::format("property \"{}\" of {} floe{} is not read; did you mean {}? \"import\": "
                      "{{\"properties\": \"{}\"}} reads it{}",
                      miss.key, miss.floes, miss.floes == 1 ? "" : "s", miss.meant, as_property_name(miss),
                      is_thickness ? "; " + thickness : ""));
      is_partial = is_partial && !is_thickness;
    }
    if (is_partial) add(Severity::kHint, thickness + "; the others have that of the scene");
  }

  std::filesystem::path folder_;
  ProblemCollector problems_;
  JsonValue resolved_;
  SceneDraft draft_;
  std::vector<FieldReport> fields_;
  std::vector<FileReport> files_;
  std::vector<IceReport> ice_;
};

}  // namespace

std::string name_from(const std::string& file) {
  std::string name = std::filesystem::path(file).stem().string().substr(0, 100);
  const auto is_plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  std::ranges::replace_if(
      name, [&](char c) { return !is_plain(c) && c != '.' && c != '_' && c != '-'; }, '-');
  return name.empty() || !is_plain(name.front()) ? "scene" : name;
}

SceneOutcome read_scene(std::string text, const std::string& name, const std::filesystem::path& folder,
                        const SceneOverrides& overrides, std::size_t longest) {
  return SceneReader(std::move(text), name, folder).read(name_from(name), overrides, longest);
}

tl::expected<LoadedShip, std::vector<Problem>> read_ship(std::string text, const std::string& name,
                                                         ShipUse use) {
  return SceneReader(std::move(text), name, {}).read_ship(use);
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
