#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/ranges.h>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "app/run/load_scene.hpp"
#include "io/import/floe_import.hpp"
#include "io/import/floe_properties.hpp"
#include "io/scene/record.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/scene_input.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/scene/ship_presets.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/output_file.hpp"
#include "io/text/problem.hpp"

namespace polynya::app {
namespace {

// ---- polynya validate --cases

constexpr std::size_t kLongestCases = std::size_t{4} << 30;  ///< [bytes]
constexpr std::size_t kMostPrinted = 100;                    ///< number of cases whose problems are printed

/// Reads the scene of one case and returns its problems.
std::vector<io::Problem> problems_of(const io::SourceText& scene, std::string_view line, const std::string& cases,
                                     std::size_t number, io::SceneOverrides overrides) {
  auto assignments = io::parse_case(line, cases, static_cast<int>(number));
  if (!assignments) return {std::move(assignments.error())};
  std::ranges::move(*assignments, std::back_inserter(overrides.assignments));
  const auto loaded =
      io::read_scene(scene.text, scene.name, std::filesystem::path(scene.name).parent_path(), overrides);
  return loaded ? std::vector<io::Problem>{} : loaded.error();
}

/// Checks a scene with the values of each line of a file of cases (docs/studies.md) and prints the problems of each:
/// one per line on stderr, or one JSON object on stdout for each case that is refused. Returns the exit code.
int validate_cases(const std::string& scene, const std::string& cases, const io::SceneOverrides& overrides,
                   bool as_json) {
  auto scene_text = read_input(scene, io::kLongestScene);
  if (!scene_text) return fail(kInputOutput, fmt::format("{}: {}", scene, scene_text.error()));
  const io::SourceText named_scene{scene, *std::move(scene_text)};
  const auto text = read_input(cases, kLongestCases);
  if (!text) return fail(kInputOutput, fmt::format("{}: {}", cases, text.error()));
  std::size_t count = 0, refused = 0;
  for (std::size_t begin = 0; begin < text->size();) {
    const std::size_t end = std::min(text->find('\n', begin), text->size());
    const std::string_view line = std::string_view(*text).substr(begin, end - begin);
    const auto problems = problems_of(named_scene, line, cases, ++count, overrides);
    refused += problems.empty() ? 0 : 1;
    if (as_json && !problems.empty()) {
      std::string list = io::to_json_text(problems);
      std::erase(list, '\n');
      write_out(fmt::format("{{\"line\": {}, \"problems\": {}}}\n", count, list));
    } else if (refused <= kMostPrinted) {
      for (const io::Problem& problem : problems)
        print_err("{}{}\n", problem.file == cases ? "" : fmt::format("{}:{}: ", cases, count), to_string(problem));
    }
    begin = end + 1;
  }
  if (as_json) return refused == 0 ? kDone : kSceneInvalid;
  if (refused > 0)
    return fail(
        kSceneInvalid,
        fmt::format("{} of {} are refused{}; nothing was written", refused, counted(count, "case"),
                    refused > kMostPrinted ? fmt::format(", of which the first {} are listed", kMostPrinted) : ""));
  print_out("{}: {}, all valid\n", cases, counted(count, "case"));
  return kDone;
}

// ---- polynya validate

constexpr auto kSceneExamples =
    "Examples:\n"
    "  polynya validate scene.json\n"
    "  polynya validate scene.json --resolved   the scene with all defaults filled in\n"
    "  polynya validate scene.json --set ice.thickness_m=0.7\n"
    "  polynya validate scene.json --cases cases.ndjson   values of each line, as with --set: {\"ice.thickness_m\": "
    "0.7}\n"
    "  polynya validate scene.json --json       the problems as a JSON array, for editors\n"
    "  make-scene | polynya validate -          a scene from stdin\n";

struct ValidateOptions {
  std::string scene;
  std::vector<std::string> set;
  std::string cases;      ///< file of cases; empty: none
  bool resolved = false;  ///< print the scene with all defaults filled in
  ProgressKind progress = ProgressKind::kAuto;
  bool json = false;  ///< print the problems as a JSON array
};

/// Prints the results of the scene's fields, drawn ice properties and floe files.
void print_floes(const io::LoadedScene& loaded) {
  print_fields(loaded);
  for (const io::IceReport& report : loaded.ice) {
    const io::FloeProperty& property = io::floe_ice_properties()[report.property];
    const fracture::ScatterMeasures& drawn = report.measures;
    print_out("floes[{}].ice.{}: {} drawn, {:.4g} {} ± {:.3g} %, from {:.4g} to {:.4g}, {:.2g} off the law (KS)\n",
              report.group, property.key, drawn.count, drawn.mean, property.unit, 100 * drawn.spread, drawn.least,
              drawn.most, drawn.distance);
  }
  for (const io::FileReport& file : loaded.files) {
    print_out("floes[{}]: {}{}; {}\n", file.group, io::plane_in_words(file.plane),
              file.run_time ? fmt::format("; {} of a run at {:g} s", counted(file.floes, "floe"), *file.run_time)
              : file.totals ? "; " + io::counts_in_words(*file.totals)
                            : "; " + counted(file.floes, "floe"),
              io::thickness_in_words(file.with_thickness, file.floes));
    if (file.totals) print_out("floes[{}]: {}\n", file.group, io::areas_in_words(*file.totals));
  }
}

int validate(const ValidateOptions& options) {
  io::SceneOverrides overrides;
  overrides.assignments = assignments_of(options.set);
  if (!options.cases.empty()) return validate_cases(options.scene, options.cases, overrides, options.json);
  const auto loaded = load_scene(options.scene, overrides, options.progress, options.json);
  if (!loaded) return loaded.error();
  if (options.json) {
    write_out(io::to_json_text(loaded->hints));
    return kDone;
  }
  print_lines(loaded->hints);
  if (options.resolved) {
    write_out(loaded->resolved_text);
    return kDone;
  }
  const simulation::Scene& scene = loaded->scene;
  const auto listed = [](std::size_t count, std::string_view noun) {
    return count > 0 ? ", " + counted(count, noun) : "";
  };
  print_out("{}: valid; \"{}\" with {}{}{} and {}, {:g} s in ticks of {:g} s{}, hash {}\n", input_name(options.scene),
            scene.name, counted(scene.ships.size(), "ship"), listed(scene.structures.size(), "structure"),
            listed(scene.walls.size(), "wall"), counted(scene.floes.size(), "floe"), scene.time.until, scene.time.step,
            loaded->is_step_chosen ? " as chosen" : "", loaded->hash);
  print_floes(*loaded);
  return kDone;
}

// ---- polynya init

int init(const std::string& file) {
  if (file.empty()) {
    write_out(io::commented_scene());
    return kDone;
  }
  if (std::filesystem::exists(file)) return fail(kInputOutput, file + ": it exists already");
  if (const auto written = io::write_named_file(file, io::commented_scene()); !written)
    return fail(kInputOutput, written.error());
  print_out("{}: a commented scene; run it with\n  polynya run {}\n", file, file);
  return kDone;
}

// ---- polynya ships

std::string reported_of(const io::ShipPreset& ship) {
  std::string text;
  for (const io::ReportedSpeed& speed : ship.reported)
    text += fmt::format("{}{:g} m at {:.1f} kn", text.empty() ? "" : ", ", speed.thickness, speed.speed / io::kKnot);
  return text;
}

void print_list() {
  print_out("{:<14}{:<58}{}\n", "name", "ship", "level ice as reported");
  for (const io::ShipPreset& ship : io::ship_presets())
    print_out("{:<14}{:<58}{}\n", ship.name, ship.title, reported_of(ship));
  print_out(
      "\npolynya ships NAME lists a ship's particulars and their sources; a scene asks for one by "
      "\"ship\": \"NAME\".\n");
}

void print_ship(const io::ShipPreset& ship) {
  print_out("{}: {}\n\n", ship.name, ship.title);
  print_out("{:<46}{:>12}  {:<10}{}\n", "particular", "value", "basis", "source");
  for (const io::PresetValue& p : ship.particulars)
    print_out("{:<46}{:>12}  {:<10}{}\n", p.path, p.json, p.basis, p.source);
  if (!ship.reported.empty()) print_out("\nlevel ice as reported\n");
  for (const io::ReportedSpeed& speed : ship.reported) {
    const std::string strength =
        speed.flexural_strength > 0 ? fmt::format(", flexural strength {:g} kPa", 1e-3 * speed.flexural_strength) : "";
    print_out("{:g} m at {:.2f} m/s ({:.1f} kn){}: {}\n", speed.thickness, speed.speed, speed.speed / io::kKnot,
              strength, speed.source);
  }
  print_out("\nassumed: nobody has published it. recall: from memory. Sources: docs/references.md.\n");
}

io::JsonValue described(std::string_view name, std::string_view title, io::JsonValue ship,
                        const io::ShipPreset* preset) {
  io::JsonValue reported{io::JsonValue::Array{}, 0};
  for (const io::ReportedSpeed& speed : preset ? preset->reported : std::vector<io::ReportedSpeed>{}) {
    io::JsonValue item{io::JsonValue::Object{}, 0};
    item.set("thickness_m", speed.thickness);
    item.set("speed_m_per_s", speed.speed);
    if (speed.flexural_strength > 0) item.set("flexural_strength_kPa", 1e-3 * speed.flexural_strength);
    item.set("source", speed.source);
    reported.items().push_back(std::move(item));
  }
  io::JsonValue root{io::JsonValue::Object{}, 0};
  root.set("name", std::string(name));
  root.set("title", std::string(title));
  root.set("ship", std::move(ship.data));
  root.set("reported", std::move(reported.data));
  return root;
}

io::JsonValue described(const io::ShipPreset& ship) {
  return described(ship.name, ship.title, json_of(ship), &ship);
}

void print_json(const io::JsonValue& value) {
  write_out(to_json_text(value) + "\n");
}

void print_list_as_json() {
  io::JsonValue all{io::JsonValue::Array{}, 0};
  for (const io::ShipPreset& ship : io::ship_presets()) all.items().push_back(described(ship));
  print_json(all);
}

/// The values at one path in a ship's file and in its preset; null if they have none.
struct Stated {
  const io::JsonValue* by_file = nullptr;
  const io::JsonValue* by_preset = nullptr;
};

using UseParticular =
    std::function<void(const std::string& path, const io::JsonValue& value, const std::string& source)>;

/// Calls use(path, value, source) for each value below an object. The source is "given" if the file states it, the name
/// of the preset, "estimated" or "default".
void each_particular(const std::string& path, const io::JsonValue& resolved, const Stated& stated,
                     const io::LoadedShip& ship, const UseParticular& use) {
  for (const io::JsonMember& member : resolved.members()) {
    const std::string below = path.empty() ? member.key : path + "." + member.key;
    const Stated here{stated.by_file ? stated.by_file->find(member.key) : nullptr,
                      stated.by_preset ? stated.by_preset->find(member.key) : nullptr};
    const bool is_estimate = std::ranges::find(ship.estimates, below, &io::Estimate::path) != ship.estimates.end();
    if (member.value.is(io::JsonValue::Kind::kObject))
      each_particular(below, member.value, here, ship, use);
    else
      use(below, member.value,
          here.by_file     ? "given"
          : here.by_preset ? ship.preset
          : is_estimate    ? "estimated"
                           : "default");
  }
}

void print_estimates(const std::vector<io::Estimate>& estimates, const std::string& name) {
  if (estimates.empty()) return;
  print_out("\n{:<46}{:>12}  {}\n", "estimated, not stated", "value", "by");
  for (const io::Estimate& estimate : estimates)
    print_out("{:<46}{:>12g}  {}\n", estimate.path, estimate.value, estimate.by);
  print_out("State what you know better. polynya performance {} --list prints how far the answer moves with each.\n",
            name);
}

/// Adds to the output the source of each value, and the formulas of estimates.
void set_sources(io::JsonValue& root, const io::LoadedShip& ship, const io::JsonValue& of_preset) {
  io::JsonValue from{io::JsonValue::Object{}, 0}, estimated{io::JsonValue::Object{}, 0};
  each_particular(
      "", ship.resolved, {&ship.given, &of_preset}, ship,
      [&](const std::string& path, const io::JsonValue&, const std::string& source) { from.set(path, source); });
  for (const io::Estimate& estimate : ship.estimates) estimated.set(estimate.path, estimate.by);
  root.set("from", std::move(from.data));
  root.set("estimated", std::move(estimated.data));
}

struct ShipsOptions {
  std::string ship;  ///< name of a preset, or a file; empty: all presets
  bool is_json = false;
  bool is_for_performance = false;
};

/// Reads a ship as a ship of a scene and prints it. `name` names it in messages. Places in the text are shown only if
/// it is a file.
ExitCode show_text(std::string text, const std::string& name, bool is_file, const ShipsOptions& options) {
  const auto use = options.is_for_performance ? io::ShipUse::kLevelIce : io::ShipUse::kScene;
  auto ship = io::read_ship(std::move(text), name, use);
  if (!ship) {
    if (!is_file)
      for (io::Problem& problem : ship.error()) problem.line = problem.column = 0;
    print_problems(name, ship.error());
    return kSceneInvalid;
  }
  const io::ShipPreset* preset = io::find_ship_preset(ship->preset);
  const std::string stem = is_file ? io::name_from(name) : name;
  const std::string title = is_file || !preset ? stem : preset->title;
  const io::JsonValue of_preset = preset ? json_of(*preset) : io::JsonValue{nullptr, 0};
  if (!options.is_json) {
    print_out("{}\n\n{:<46}{:>12}  {}\n", title, "particular", "value", "from");
    each_particular("", ship->resolved, {&ship->given, &of_preset}, *ship,
                    [](const std::string& path, const io::JsonValue& value, const std::string& source) {
                      print_out("{:<46}{:>12}  {}\n", path, io::show(value), source);
                    });
    print_estimates(ship->estimates, name);
    return kDone;
  }
  io::JsonValue root = described(stem, title, ship->resolved, preset);
  set_sources(root, *ship, of_preset);
  if (ship->engine) {
    io::JsonValue engine{io::JsonValue::Object{}, 0};
    engine.set("bollard_pull_N", ship->engine->bollard_pull);
    engine.set("open_water_speed_m_per_s", ship->engine->open_water_speed);
    root.set("engine", std::move(engine.data));
  }
  print_json(root);
  return kDone;
}

ExitCode no_such_ship(const std::string& name) {
  std::vector<std::string_view> names;
  for (const io::ShipPreset& other : io::ship_presets()) names.push_back(other.name);
  const std::string meant = io::nearest(name, names);
  return fail(kUsage, fmt::format("no preset and no file is named \"{}\"; {}presets: {}", name,
                                  meant.empty() ? "" : fmt::format("did you mean {}? ", meant), fmt::join(names, " ")));
}

ExitCode show(const ShipsOptions& options) {
  const std::string& name = options.ship;
  if (name.empty()) {
    options.is_json ? print_list_as_json() : print_list();
    return kDone;
  }
  if (const io::ShipPreset* ship = io::find_ship_preset(name)) {
    if (options.is_for_performance) return show_text(fmt::format(R"({{"ship": "{}"}})", name), name, false, options);
    options.is_json ? print_json(described(*ship)) : print_ship(*ship);
    return kDone;
  }
  std::error_code error;
  const bool is_file = name == "-" || name.ends_with(".json") || name.find('/') != std::string::npos ||
                       std::filesystem::exists(name, error);
  if (!is_file) return no_such_ship(name);
  const std::string shown = input_name(name);
  auto text = read_input(name, io::kLongestShip);
  if (!text) return fail(kInputOutput, fmt::format("{}: {}", shown, text.error()));
  return show_text(*std::move(text), shown, true, options);
}

// ---- polynya read-json

/// Writes the place of every value of a document by its JSON pointer (RFC 6901): line and column, then those of its
/// key.
class PlaceWriter {
 public:
  explicit PlaceWriter(std::string_view text) : lines_(text) { json_.open('{'); }

  std::string places_of(const io::JsonValue& root) {
    add(root, {});
    json_.close('}');
    return places_;
  }

 private:
  void add(const io::JsonValue& value, std::optional<std::uint32_t> key_offset) {
    std::optional<io::LineAndColumn> key;
    if (key_offset) key = lines_.at(*key_offset);
    const io::LineAndColumn place = lines_.at(value.offset);
    json_.key(pointer_).open('[').value(place.line).value(place.column);
    if (key) json_.value(key->line).value(key->column);
    json_.close(']');
    if (value.is(io::JsonValue::Kind::kArray)) {
      std::size_t index = 0;
      for (const io::JsonValue& item : value.items()) add_below(std::to_string(index++), item, {});
    } else if (value.is(io::JsonValue::Kind::kObject)) {
      for (const io::JsonMember& member : value.members()) add_below(member.key, member.value, member.key_offset);
    }
  }
  void add_below(std::string_view step, const io::JsonValue& value, std::optional<std::uint32_t> key_offset) {
    const std::size_t length = pointer_.size();
    pointer_ += '/';
    for (const char c : step) pointer_ += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    add(value, key_offset);
    pointer_.resize(length);
  }

  io::LineIndex lines_;
  std::string places_, pointer_;
  io::JsonWriter json_{places_};
};

int read_json(const std::string& file) {
  const auto text = read_input(file, io::kLongestScene);
  if (!text) {
    print_err("{}: {}\n", file, text.error());
    return kInputOutput;
  }
  const io::JsonDocument document = io::parse_json(*text);
  if (document.faults.empty()) {
    print_out("{{\"value\": {}, \"places\": {}}}\n", io::to_json_text(document.root),
              PlaceWriter(*text).places_of(document.root));
    return kDone;
  }
  io::ProblemCollector problems({.name = file, .text = *text});
  problems.add_faults(0, document.faults);
  print_lines(problems.take());
  return kSceneInvalid;
}

}  // namespace

Command add_validate(CommandLine& app) {
  CommandLine command = app.add_command("validate", "Check a scene and report all its errors", kSceneExamples);
  auto options = std::make_shared<ValidateOptions>();
  add_scene(command, options->scene);
  add_set(command, options->set);
  command.option(
      "--cases", &options->cases, "FILE",
      "Check the scene with the values of each line of this file: one JSON object of paths and values per line",
      not_empty());
  command.flag("--resolved", options->resolved, "Print the scene with all defaults filled in",
               {.excludes = {"--cases"}});
  command.flag("--json", options->json, "Print the problems as a JSON array; [] if there are none",
               {.excludes = {"--resolved"}});
  add_progress(command, options->progress);
  return {command, [options] { return validate(*options); }};
}

Command add_init(CommandLine& app) {
  CommandLine command = app.add_command("init", "Write a commented scene to start from",
                                        "Examples:\n"
                                        "  polynya init my-scene.json && polynya run my-scene.json\n"
                                        "  polynya init                         to stdout\n");
  auto file = std::make_shared<std::string>();
  command.option("file", file.get(), "FILE", "File to write; stdout if not given");
  return {command, [file] { return init(*file); }};
}

Command add_schema(CommandLine& app) {
  CommandLine command = app.add_command("schema", "Print the JSON Schema of scenes",
                                        "Examples:\n"
                                        "  polynya schema > polynya.schema.json\n"
                                        "  polynya schema --markdown            the tables of docs/scene.md\n");
  auto is_markdown = std::make_shared<bool>(false);
  command.flag("--markdown", *is_markdown, "Print the fields as Markdown tables");
  return {command, [is_markdown] {
            write_out(*is_markdown ? io::scene_tables() : io::scene_schema());
            return kDone;
          }};
}

Command add_ships(CommandLine& app) {
  CommandLine command =
      app.add_command("ships", "List the ships that scenes can use by name, or check a ship in a file",
                      "Examples:\n"
                      "  polynya ships                  all of them\n"
                      "  polynya ships polaris          every particular with its source\n"
                      "  polynya ships polaris --json   the ship in the form of a scene\n"
                      "  polynya ships our-ship.json    check a ship in a file: its errors, or all its particulars\n");
  auto options = std::make_shared<ShipsOptions>();
  command.option("ship", &options->ship, "SHIP", "Name of a ship, or a JSON file with one; - for stdin", not_empty());
  command.flag("--json", options->is_json,
               "Print the ship, or the list of all ships, as JSON with all defaults filled in");
  command.flag("--for-performance", options->is_for_performance,
               "Also require the data that polynya performance needs (main dimensions, draught, engine), and estimate "
               "missing ones: open-water speed, block coefficient, entrance angle, propellers");
  return {command, [options] { return show(*options); }};
}

/// Prints the value of a JSON file and the places of all its parts, for commands in Python. The help does not list it.
Command add_read_json(CommandLine& app) {
  CommandLine command = app.add_command("read-json", "", "");
  auto file = std::make_shared<std::string>();
  command.option("file", file.get(), "FILE", "JSON with comments", {}, {.is_required = true});
  return {command, [file] { return read_json(*file); }};
}

}  // namespace polynya::app
