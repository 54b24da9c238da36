#include "io/scene/scene_reader.hpp"

#include <algorithm>
#include <charconv>
#include <span>

#include <fmt/format.h>

#include "io/scene/floe_list_reader.hpp"
#include "io/scene/scene_check.hpp"
#include "io/scene/ship_presets.hpp"
#include "io/text/json_writer.hpp"
#include "simulation/world/default_tick.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;
using simulation::BodyKind;

/// Returns the hash (FNV-1a, 64 bits) of consecutive texts.
std::string hash_of(std::initializer_list<std::string_view> texts) {
  std::uint64_t hash = 14695981039346656037U;
  for (const std::string_view text : texts)
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return fmt::format("{:016x}", hash);
}

/// Returns the hash of a resolved scene without the value of time.until_s. No other key has that name, and quotes
/// within texts are escaped.
std::string course_hash_of(std::string_view resolved) {
  constexpr std::string_view kKey = R"("until_s":)";
  const std::size_t value = resolved.find(kKey) + kKey.size();
  return hash_of({resolved.substr(0, value), resolved.substr(resolved.find_first_of(",}", value))});
}

/// Sets the length of the panels of each ship and structure.
void set_panels(JsonValue& root, double length) {
  for (const char* list : {"ships", "structures"}) {
    JsonValue* hulls = root.find(list);
    if (!hulls || !hulls->is(JsonValue::Kind::kArray)) continue;
    for (JsonValue& hull : hulls->items()) {
      if (!hull.is(JsonValue::Kind::kObject)) continue;
      if (!hull.find("panels", JsonValue::Kind::kObject)) hull.set("panels", JsonValue::Object{});
      hull.find("panels")->set("length_m", length);
    }
  }
}

void override_scene(JsonValue& root, const SceneOverrides& overrides) {
  if (overrides.seed) root.set("seed", static_cast<double>(*overrides.seed));
  if (overrides.panel_length) set_panels(root, *overrides.panel_length);
  if (!overrides.until) return;
  if (!root.find("time")) root.set("time", JsonValue::Object{});
  if (JsonValue* time = root.find("time")) time->set("until_s", *overrides.until);
}

/// Describes for a message which items a list of a scene has.
std::string items_of(const JsonValue& list, std::string_view path) {
  if (!list.is(JsonKind::kArray)) return "a key: it is no list";
  if (list.items().empty()) return "nothing: the list is empty";
  if (list.items().size() == 1) return fmt::format("{}[0]", path);
  return fmt::format("{0}[0] to {0}[{1}]", path, list.items().size() - 1);
}

/// Returns the value at a path such as "ships[0].position_m[1]". Objects on the way are created if the scene has none;
/// items of lists must exist. If the path leads nowhere, reports it and returns null.
template <class Report>
JsonValue* place_of(JsonValue& scene, std::string_view path, std::uint32_t offset, Report report) {
  JsonValue* at = &scene;
  for (std::size_t begin = 0; begin < path.size();) {
    const std::size_t end = std::min(path.find_first_of(".[", begin + 1), path.size());
    const std::string_view so_far = path.substr(0, end);
    std::size_t index = 0;
    if (path[begin] == '[' && begin > 0) {
      const auto read = std::from_chars(path.data() + begin + 1, path.data() + end, index);
      if (read.ec != std::errc() || read.ptr + 1 != path.data() + end || *read.ptr != ']') return report.no_path();
      if (!at->is(JsonKind::kArray) || index >= at->items().size())
        return report(so_far, show(*at), items_of(*at, path.substr(0, begin)));
      at = &at->items()[index];
    } else {
      if (path[begin] == '.' && begin > 0) ++begin;
      const std::string_view key = path.substr(begin, end - begin);
      if (key.empty() || key[0] == '.' || key[0] == '[') return report.no_path();
      if (!at->is(JsonKind::kObject)) {
        const std::string_view of = path.substr(0, begin - 1);
        const bool is_item = at->is(JsonKind::kArray) && key.find_first_not_of("0123456789") == std::string_view::npos;
        return report(of, show(*at), is_item ? items_of(*at, of) : fmt::format("an object, to have \"{}\"", key));
      }
      JsonValue* there = at->find(key);
      if (!there && end < path.size() && path[end] == '[')
        return report(so_far, "nothing", "a list that the scene has");
      if (!there)
        there = &at->members().emplace_back(JsonMember{std::string(key), offset, {JsonValue::Object{}, offset}}).value;
      at = there;
    }
    begin = end;
  }
  return at;
}

/// Reports a path that leads nowhere, at the place of the path.
struct ReportPath {
  std::string_view path;
  std::uint32_t offset;
  ProblemCollector& problems;

  JsonValue* operator()(std::string_view at, std::string found, std::string allowed) const {
    problems.report(0, offset, std::string(at), std::move(found), std::move(allowed));
    return nullptr;
  }
  JsonValue* no_path() const {
    return (*this)(path, fmt::format("\"{}\"", path),
                   "a path of a scene's key, as ice.thickness_m or ships[0].position_m[1]");
  }
};

/// Sets values in a scene before it is resolved, in order. Objects on the way are created if the scene has none; items
/// of lists must exist. Unknown keys are reported later, when the scene is resolved.
void assign(JsonValue& scene, const std::vector<Assignment>& assignments, ProblemCollector& problems) {
  for (const Assignment& assignment : assignments) {
    const std::uint32_t begin = problems.add_overlay(assignment.text);
    const std::uint32_t offset = begin + assignment.key_offset;
    const ReportPath report{assignment.path, offset, problems};
    JsonValue* const target =
        assignment.path.empty() ? report.no_path() : place_of(scene, assignment.path, offset, report);
    if (!target) continue;
    *target = assignment.value;
    for_offsets(*target, [begin](std::uint32_t& place) { place += begin; });
  }
}

/// Reads a scene into a draft. Each object reads one scene.
class SceneReader {
 public:
  SceneReader(std::string text, const std::string& name, FloeFiles files)
      : files_(std::move(files)), problems_(SourceText{name, std::move(text)}) {}

  SceneOutcome read(const std::string& default_name, const SceneOverrides& overrides, std::size_t longest) {
    JsonDocument document;
    if (!parse(document)) return tl::unexpected(problems_.take());
    assign(document.root, overrides.assignments, problems_);
    if (!document.root.find("name")) document.root.set("name", default_name);
    override_scene(document.root, overrides);
    if (!complete(document.root)) return tl::unexpected(problems_.take());
    add_scene_hints(draft_, document.root, problems_);
    for (const FileReport& file : loaded_.files) add_file_hints(file);
    loaded_.hints = problems_.take();
    loaded_.scene = std::move(draft_.scene);
    loaded_.description = std::move(input_.description);
    loaded_.resolved_text = to_json_text(resolved_);
    if (const std::size_t length = loaded_.resolved_text.size(); length > longest) {
      report(0, "", fmt::format("{} bytes with every default filled in and floe files read in", length),
             fmt::format("at most {} bytes: fewer floes, or coordinates of fewer digits", longest));
      return tl::unexpected(problems_.take());
    }
    loaded_.hash = hash_of({loaded_.resolved_text});
    loaded_.course_hash = course_hash_of(loaded_.resolved_text);
    return std::move(loaded_);
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
    LoadedShip ship;
    ship.given = given;
    if (const JsonValue* preset = given.find("ship", JsonKind::kText)) ship.preset = preset->text();
    JsonValue scene{JsonValue::Object{}, given.offset};
    scene.set("ships", JsonValue::Array{std::move(given)});
    fill_in_presets(scene);
    JsonValue& item = scene.find("ships")->items().front();
    if (use == ShipUse::kLevelIce) ship.estimates = add_estimates(item, input_.scene.water.water.density);
    const bool is_valid = complete(scene);
    std::vector<Problem> problems = problems_of_ship();
    if (use == ShipUse::kLevelIce && item.is(JsonKind::kObject)) add_problems_of_level_ice(item, problems);
    if (!is_valid || !problems.empty()) return tl::unexpected(std::move(problems));
    ship.resolved = std::move(resolved_.find("ships")->items().front());
    if (auto* engine = std::get_if<simulation::Engine>(&draft_.scene.ships.back().propulsion)) ship.engine = *engine;
    return ship;
  }

 private:
  bool parse(JsonDocument& document) {
    document = parse_json(problems_.source(0).text);
    problems_.add_faults(0, document.faults);
    return std::ranges::none_of(document.faults, [](const JsonFault& fault) { return fault.path.empty(); });
  }

  std::vector<Problem> problems_of_ship() {
    std::vector<Problem> problems = problems_.take();
    for (Problem& problem : problems) {
      constexpr std::string_view kShipPath = "ships[0]";
      if (!problem.path.starts_with(kShipPath)) continue;
      problem.path.erase(0, kShipPath.size());
      if (problem.path.starts_with('.')) problem.path.erase(0, 1);
    }
    return problems;
  }

  /// Reports all values that `polynya performance` needs and does not have, each at its own path. These replace the
  /// reader's problems about the same values, because the reader stops at an object with a missing part and would
  /// report the rest only after that is added.
  void add_problems_of_level_ice(const JsonValue& ship, std::vector<Problem>& problems) {
    report_for_level_ice(ship, {problems_, ship, "ships[0]"});
    const std::vector<Problem> lacking = problems_of_ship();
    if (lacking.empty()) return;
    std::erase_if(problems, [](const Problem& problem) {
      const bool is_absence =
          problem.found == "nothing" || problem.found == "none of them" || problem.found.starts_with("neither ");
      const bool is_of_level_ice = problem.path.empty() || problem.path.starts_with("hull") ||
                                   problem.path.starts_with("propulsion") || problem.path == "mass_kg" ||
                                   problem.path == "moment_of_inertia_kg_m2";
      return is_absence && is_of_level_ice;
    });
    problems.insert(problems.end(), lacking.begin(), lacking.end());
    std::ranges::stable_sort(problems, {},
                             [](const Problem& problem) { return std::pair(problem.line, problem.column); });
  }

  void report(std::uint32_t offset, std::string path, std::string found, std::string allowed) {
    problems_.report(0, offset, std::move(path), std::move(found), std::move(allowed));
  }

  /// Makes the draft and the resolved scene. Returns false if there is a problem, which has been reported.
  bool complete(JsonValue& given) {
    fill_in_presets(given);
    RecordReader reader(problems_);
    const bool is_whole = reader.read(kSceneDescription, given, "", input_);
    if (!given.is(JsonKind::kObject)) return false;
    auto ships = items(given, "ships", kShipDescription, reader);
    auto structures = items(given, "structures", kStructureDescription, reader);
    auto walls = items(given, "walls", kWallDescription, reader);
    complete_fate_of_ice(given, ships);
    complete_skin_drag(given);
    resolved_ = write(kSceneDescription, input_);
    simulation::Scene& scene = draft_.scene = std::move(input_.scene);
    scene.name = input_.name;
    add_hulls(given, BodyKind::kShip, kShipDescription, ships, [&](auto& ship, auto& item, const auto& path) {
      scene.ships.push_back(complete_ship(ship, item, path, scene.water.water.density, problems_));
    });
    add_hulls(given, BodyKind::kStructure, kStructureDescription, structures,
              [&](auto& structure, auto&, auto&&) { scene.structures.push_back(complete_structure(structure)); });
    add_hulls(given, BodyKind::kWall, kWallDescription, walls, [&](auto& wall, auto& item, const auto& path) {
      if (auto completed = complete_wall(wall, item, path, problems_)) scene.walls.push_back(*std::move(completed));
    });
    if (is_whole) {
      complete_pilots(given, draft_, problems_);
      complete_step(given);
      check_without_ice(draft_, given, problems_);
    }
    add_floes(given, is_whole, reader);
    if (!is_whole) return false;
    complete_step(given);
    check_ice(draft_, given, problems_);
    return problems_.count() == 0;
  }

  /// Returns the items of a list of the scene; none if the value is no list.
  static std::span<const JsonValue> items_of(const JsonValue& given, std::string_view list) {
    const JsonValue* found = given.find(list, JsonKind::kArray);
    return found ? std::span(found->items()) : std::span<const JsonValue>{};
  }

  /// Reads the items of a list. An item that is wrong gives nothing.
  template <class Item>
  std::vector<std::optional<Item>> items(const JsonValue& given, const std::string& list,
                                         const Description<Item>& description, RecordReader& reader) {
    std::vector<std::optional<Item>> read;
    for (const JsonValue& item : items_of(given, list)) {
      Item input;
      const std::size_t index = read.size();
      const bool is_good = reader.read(description, item, fmt::format("{}[{}]", list, index), input, index + 1);
      read.push_back(is_good ? std::optional(std::move(input)) : std::nullopt);
    }
    return read;
  }

  /// Sets the fate of broken ice: unless the scene states otherwise, it goes under hulls with a draught and surfaces
  /// behind them.
  void complete_fate_of_ice(const JsonValue& given, const std::vector<std::optional<ShipInput>>& ships) {
    const JsonValue* root = given.find("fracture");
    const auto is_given = [&](std::string_view object, std::string_view key) {
      const JsonValue* in = root && !object.empty() ? root->find(object) : root;
      return in && in->find(key) != nullptr;
    };
    const ReportAt report_at{problems_, given, ""};
    const bool has_draught =
        std::ranges::any_of(ships, [](const auto& ship) { return ship && ship->spec.hull.draught > 0; });
    simulation::FractureSettings& fracture = input_.scene.fracture;
    simulation::CuspFate& fate = fracture.cusp_fate;
    bool& going_under = fracture.going_under.is_enabled;
    bool& coming_up = fracture.resurface.is_enabled;
    if (has_draught && !is_given("", "cusp_fate")) fate = simulation::CuspFate::kUnderHull;
    if (!is_given("going_under", "enabled")) going_under = has_draught;
    const bool is_under_hull = fate == simulation::CuspFate::kUnderHull;
    const bool goes_under = has_draught && (is_under_hull || going_under);
    if (!is_given("resurface", "enabled")) coming_up = goes_under;
    const std::string draught = "a hull with a draught (hull.draught_m)";
    if (!has_draught && is_under_hull)
      report_at("fracture.cusp_fate", "under_hull without " + draught, "submerge or float");
    if (!has_draught && going_under) report_at("fracture.going_under.enabled", "true without " + draught, "false");
    if (!goes_under && coming_up)
      report_at("fracture.resurface.enabled", "true where no ice goes under a hull",
                "false, or cusp_fate under_hull, or going_under.enabled");
  }

  /// Sets the skin drag of the water on floes: unless the scene states otherwise, it acts if there is wind.
  void complete_skin_drag(const JsonValue& given) {
    constexpr double kSkinDragInWind = 0.004;  // [-]
    const JsonValue* water = given.find("water");
    if (input_.scene.wind.blows() && !(water && water->find("skin_drag_coefficient")))
      input_.scene.water.skin_drag_coefficient = kSkinDragInWind;
  }

  /// Chooses the tick from speeds and thickness, unless the scene states it. The first choice uses the scene's ice,
  /// because checks that need no floe come before the floes are made.
  void complete_step(const JsonValue& given) {
    const JsonValue* time = given.find("time");
    loaded_.is_step_chosen = !(time && time->find("step_s"));
    if (!loaded_.is_step_chosen) return;
    draft_.scene.time.step = simulation::default_tick(draft_.scene);
    resolved_.find("time")->set("step_s", draft_.scene.time.step);
  }

  /// Completes the items of a list of hulls and adds them to the draft. Items that could not be read have been reported
  /// and are skipped.
  template <class Input, class Complete>
  void add_hulls(const JsonValue& given, BodyKind kind, const Description<Input>& description,
                 std::vector<std::optional<Input>>& inputs, Complete complete) {
    const std::string list(list_of(kind));
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (!inputs[i]) continue;
      const JsonValue& item = items_of(given, list)[i];
      const std::size_t problems = problems_.count();
      complete(*inputs[i], item, fmt::format("{}[{}]", list, i));
      if (draft_.hull_origins.size() < hull_count(draft_.scene))
        draft_.hull_origins.push_back({.offset = item.offset, .group = i, .kind = kind});
      JsonValue written = write(description, *inputs[i]);
      if (problems_.count() == problems) check_completed(description, written, item, fmt::format("{}[{}]", list, i));
      resolved_.find(list)->items().push_back(std::move(written));
    }
  }

  /// Reports a value that was computed from others and is outside the range of its key, because a run could not read
  /// its own scene.json.
  template <class Input>
  void check_completed(const Description<Input>& description, const JsonValue& written, const JsonValue& given,
                       const std::string& path) {
    ProblemCollector found{SourceText{}};
    Input again;
    RecordReader(found).read(description, written, path, again);
    for (const Problem& problem : found.take()) {
      const std::string key = problem.path.substr(std::min(problem.path.size(), path.size() + 1));
      ReportAt{problems_, given, path}(key, problem.found + ", which follows from what is given",
                                       problem.allowed + "; give it, or change what it follows from");
    }
  }

  void add_floes(const JsonValue& given, bool is_whole, RecordReader& reader) {
    const auto list = items_of(given, "floes");
    for (std::size_t i = 0; i < list.size(); ++i) {
      FloeGroup group;
      const bool is_good = reader.read(kFloesDescription, list[i], fmt::format("floes[{}]", i), group);
      if (is_good && is_whole) floes_.add(i, std::move(group), list[i]);
    }
    *resolved_.find("floes") = std::move(floes_.written);
  }

  /// Hints at properties of a floe file that are probably meant to be read, and at floes without a thickness among
  /// floes with one.
  void add_file_hints(const FileReport& file) {
    const auto add = [&](Severity severity, std::string sentence) {
      problems_.add(
          0, file.offset,
          {.path = fmt::format("floes[{}].file", file.group), .sentence = std::move(sentence), .severity = severity});
    };
    const std::string thickness = thickness_in_words(file.with_thickness, file.floes);
    bool is_partial = file.with_thickness > 0 && file.with_thickness < file.floes;
    for (const NearMiss& miss : file.near_misses) {
      if (miss.floes == 0) continue;
      const bool is_thickness = miss.meant == "thickness_m";
      add(Severity::kWarning, fmt::format("property \"{}\" of {} floe{} is not read; did you mean {}? \"import\": "
                                          "{{\"properties\": \"{}\"}} reads it{}",
                                          miss.key, miss.floes, miss.floes == 1 ? "" : "s", miss.meant,
                                          as_property_name(miss), is_thickness ? "; " + thickness : ""));
      is_partial = is_partial && !is_thickness;
    }
    for (const std::string& note : file.notes) add(Severity::kHint, note);
    if (!file.place.empty() && !draft_.scene.origin)
      add(Severity::kHint, fmt::format("its metres are of {}, and the scene has no \"origin\": the run does not know "
                                       "where it lies on the Earth",
                                       file.place));
    if (is_partial) add(Severity::kHint, thickness + "; the others have that of the scene");
  }

  FloeFiles files_;
  ProblemCollector problems_;
  SceneInput input_;
  JsonValue resolved_;
  SceneDraft draft_;
  LoadedScene loaded_;
  FloeListReader floes_{files_, draft_, loaded_, problems_};
};

}  // namespace

Result<Assignment> parse_assignment(std::string_view words, std::string_view option) {
  const std::size_t equals = words.find('=');
  if (equals == 0 || equals == std::string_view::npos)
    return fail(fmt::format("\"{}\" is not KEY=VALUE, as ice.thickness_m=0.7", words));
  const std::string_view value = words.substr(equals + 1);
  JsonDocument document = parse_json(value);
  const bool is_json = document.faults.empty();
  if (!is_json) document.root = {std::string(value)};
  return Assignment{std::string(words.substr(0, equals)),
                    std::move(document.root),
                    0,
                    {fmt::format("{} {}", option, words), 0, words.size(),
                     is_json ? std::nullopt : std::optional(std::string(value))}};
}

tl::expected<std::vector<Assignment>, Problem> parse_case(std::string_view text, const std::string& file, int line) {
  JsonDocument document = parse_json(text);
  if (!document.faults.empty()) {
    const JsonFault& fault = document.faults.front();
    return tl::unexpected(Problem{
        .file = file, .line = line, .column = static_cast<int>(fault.offset) + 1, .sentence = message_of(fault)});
  }
  if (!document.root.is(JsonKind::kObject))
    return tl::unexpected(Problem{.file = file,
                                  .line = line,
                                  .column = 1,
                                  .found = show(document.root),
                                  .allowed = "an object of paths and values"});
  std::vector<Assignment> assignments;
  for (JsonMember& member : document.root.members())
    assignments.push_back({member.key, std::move(member.value), member.key_offset, {file, line, text.size()}});
  return assignments;
}

std::string name_from(const std::string& file) {
  std::string name = std::filesystem::path(file).stem().string().substr(0, 100);
  const auto is_plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  std::ranges::replace_if(
      name, [&](char c) { return !is_plain(c) && c != '.' && c != '_' && c != '-'; }, '-');
  return name.empty() || !is_plain(name.front()) ? "scene" : name;
}

SceneOutcome read_scene(std::string text, const std::string& name, const FloeFiles& files,
                        const SceneOverrides& overrides, std::size_t longest) {
  return SceneReader(std::move(text), name, files).read(name_from(name), overrides, longest);
}

tl::expected<LoadedShip, std::vector<Problem>> read_ship(std::string text, const std::string& name, ShipUse use) {
  return SceneReader(std::move(text), name, no_floe_files()).read_ship(use);
}

}  // namespace polynya::io
