#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/ranges.h>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "app/command_line/files.hpp"
#include "app/run/load_scene.hpp"
#include "io/scene/record.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/scene/ship_presets.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"

namespace polynya::app {
namespace {

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
  for (const io::Particular& p : ship.particulars)
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

/// A line for each particular below an object, and whose it is: the file's, its preset's or a default.
void print_particulars(const std::string& path, const io::JsonValue& resolved, const io::JsonValue* given,
                       const io::JsonValue* preset, const std::string& preset_name) {
  for (const io::JsonMember& member : resolved.members()) {
    const std::string below = path.empty() ? member.key : path + "." + member.key;
    const io::JsonValue* own = given ? given->find(member.key) : nullptr;
    const io::JsonValue* filled = preset ? preset->find(member.key) : nullptr;
    if (member.value.is(io::JsonValue::Kind::kObject))
      print_particulars(below, member.value, own, filled, preset_name);
    else
      print_out("{:<46}{:>12}  {}\n", below, io::show(member.value), own ? "given" : filled ? preset_name : "default");
  }
}

struct ShipsOptions {
  std::string ship;  ///< a preset's name or a file; empty: all presets
  bool is_json = false;
  bool is_for_performance = false;
};

/// A ship that is read as one of a scene. `name` stands in messages; its places are not shown where the text
/// is no file.
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
  if (!options.is_json) {
    const io::JsonValue of_preset = preset ? json_of(*preset) : io::JsonValue{nullptr, 0};
    print_out("{}\n\n{:<46}{:>12}  {}\n", title, "particular", "value", "from");
    print_particulars("", ship->resolved, &ship->given, &of_preset, ship->preset);
    return kDone;
  }
  io::JsonValue root = described(stem, title, std::move(ship->resolved), preset);
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
  return fail(kUsage, fmt::format("no ship \"{}\"; {}there are {}; no file has that name", name,
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

}  // namespace

Command add_ships(CommandLine& app) {
  CommandLine command = app.add_command(
      "ships", "List the ships that scenes can ask for by name; check one of a file",
      "Examples:\n"
      "  polynya ships                  all of them\n"
      "  polynya ships polaris          every particular, its source, and which are assumed\n"
      "  polynya ships polaris --json   its \"ship\" as scenes have one\n"
      "  polynya ships our-ship.json    a ship as scenes have it: what is wrong, or all its particulars\n");
  auto options = std::make_shared<ShipsOptions>();
  command.option("ship", &options->ship, "SHIP", "Its name, or a JSON file with one; - for stdin", not_empty());
  command.flag("--json", options->is_json,
               "Print that ship, or the list of all, as JSON; of a file with every default filled in");
  command.flag("--for-performance", options->is_for_performance,
               "Require also what polynya performance needs: main dimensions, draught and engine");
  return {command, [options] { return show(*options); }};
}

}  // namespace polynya::app
