#include <memory>
#include <string>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/options.hpp"
#include "io/scene/ship_presets.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::app {
namespace {

std::string reported_of(const io::ShipPreset& ship) {
  std::string text;
  for (const io::ReportedSpeed& speed : ship.reported)
    text += fmt::format("{}{:g} m at {:.1f} kn", text.empty() ? "" : ", ", speed.thickness,
                        speed.speed / io::kKnot);
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
    print_out("{:<46}{:>12}  {:<10}{}\n", p.path, p.json, name_of(p.basis), p.source);
  if (!ship.reported.empty()) print_out("\nlevel ice as reported\n");
  for (const io::ReportedSpeed& speed : ship.reported) {
    const std::string strength = speed.flexural_strength > 0 ? fmt::format(", flexural strength {:g} kPa",
                                                                           1e-3 * speed.flexural_strength)
                                                             : "";
    print_out("{:g} m at {:.2f} m/s ({:.1f} kn){}: {}\n", speed.thickness, speed.speed,
              speed.speed / io::kKnot, strength, speed.source);
  }
  print_out("\nassumed: nobody has published it. recall: from memory. Sources: docs/references.md.\n");
}

io::JsonValue described(const io::ShipPreset& ship) {
  io::JsonValue reported{io::JsonValue::Array{}, 0};
  for (const io::ReportedSpeed& speed : ship.reported) {
    io::JsonValue item{io::JsonValue::Object{}, 0};
    const auto put = [&](const char* key, double value) { item.members().push_back({key, 0, {value, 0}}); };
    put("thickness_m", speed.thickness);
    put("speed_m_per_s", speed.speed);
    if (speed.flexural_strength > 0) put("flexural_strength_kPa", 1e-3 * speed.flexural_strength);
    item.members().push_back({"source", 0, {std::string(speed.source), 0}});
    reported.items().push_back(std::move(item));
  }
  io::JsonValue root{io::JsonValue::Object{}, 0};
  root.members().push_back({"name", 0, {std::string(ship.name), 0}});
  root.members().push_back({"title", 0, {std::string(ship.title), 0}});
  root.members().push_back({"ship", 0, json_of(ship)});
  root.members().push_back({"reported", 0, std::move(reported)});
  return root;
}

void print_json(const io::JsonValue& value) {
  write_out(to_json_text(value) + "\n");
}

void print_list_as_json() {
  io::JsonValue all{io::JsonValue::Array{}, 0};
  for (const io::ShipPreset& ship : io::ship_presets()) all.items().push_back(described(ship));
  print_json(all);
}

ExitCode show(const std::string& name, bool is_json) {
  if (name.empty()) {
    is_json ? print_list_as_json() : print_list();
    return kDone;
  }
  const io::ShipPreset* ship = io::find_ship_preset(name);
  if (!ship) {
    std::string names;
    for (const io::ShipPreset& other : io::ship_presets()) names += fmt::format(" {}", other.name);
    return fail(kUsage, fmt::format("no ship \"{}\"; there are{}", name, names));
  }
  is_json ? print_json(described(*ship)) : print_ship(*ship);
  return kDone;
}

}  // namespace

Command add_ships(CommandLine& app) {
  CommandLine command =
      app.add_command("ships", "List the ships that scenes can ask for by name",
                      "Examples:\n"
                      "  polynya ships                  all of them\n"
                      "  polynya ships polaris          every particular, its source, and which are assumed\n"
                      "  polynya ships polaris --json   its \"ship\" as scenes have one\n");
  auto name = std::make_shared<std::string>();
  auto is_json = std::make_shared<bool>(false);
  command.option("ship", *name, "NAME", "Its name");
  command.flag("--json", *is_json, "Print that ship, or the list of all, as JSON");
  return {command, [name, is_json] { return show(*name, *is_json); }};
}

}  // namespace polynya::app
