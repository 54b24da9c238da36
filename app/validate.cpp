#include <algorithm>
#include <memory>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/field_report.hpp"
#include "app/load_scene.hpp"
#include "app/options.hpp"
#include "app/validate_cases.hpp"
#include "io/import/import_report.hpp"
#include "io/scene/floe_ice.hpp"

namespace polynya::app {
namespace {

constexpr auto kExamples =
    "Examples:\n"
    "  polynya validate scene.json\n"
    "  polynya validate scene.json --resolved   with every default filled in\n"
    "  polynya validate scene.json --set ice.thickness_m=0.7\n"
    "  polynya validate scene.json --cases cases.ndjson   each line as many --set: {\"ice.thickness_m\": "
    "0.7}\n"
    "  polynya validate scene.json --json       the problems as a JSON array, for editors\n"
    "  make-scene | polynya validate -          a scene from stdin\n";

struct Options {
  std::string scene;
  std::vector<io::Assignment> set;
  std::string cases;      ///< a file of them; empty: none
  bool resolved = false;  ///< print the scene with every default filled in
  ProgressKind progress = ProgressKind::kAuto;
  bool json = false;  ///< print its problems as a JSON array
};

/// How the scene's fields, drawn ice and floe files came out.
void print_floes(const io::LoadedScene& loaded) {
  print_fields(loaded);
  for (const io::IceReport& report : loaded.ice) {
    const io::FloeIceProperty& property = io::floe_ice_properties()[report.property];
    const fracture::ScatterMeasures& drawn = report.measures;
    print_out(
        "floes[{}].ice.{}: {} drawn, {:.4g} {} ± {:.3g} %, from {:.4g} to {:.4g}, {:.2g} off the law (KS)\n",
        report.group, property.key, drawn.count, drawn.mean, property.unit, 100 * drawn.spread, drawn.least,
        drawn.most, drawn.distance);
  }
  for (const io::FileReport& file : loaded.files) {
    print_out("floes[{}]: {}{}; {}\n", file.group, io::plane_in_words(file.plane),
              file.run_time
                  ? fmt::format("; {} of a run at {:g} s", counted(file.floes, "floe"), *file.run_time)
              : file.totals ? "; " + io::counts_in_words(*file.totals)
                            : "; " + counted(file.floes, "floe"),
              io::thickness_in_words(file.with_thickness, file.floes));
    if (file.totals) print_out("floes[{}]: {}\n", file.group, io::areas_in_words(*file.totals));
  }
}

int validate(const Options& options) {
  const ProblemFormat format = options.json ? ProblemFormat::kJson : ProblemFormat::kText;
  io::SceneOverrides overrides;
  overrides.assignments = options.set;
  if (!options.cases.empty()) return validate_cases(options.scene, options.cases, overrides, format);
  const auto loaded = load_scene(options.scene, overrides, format, options.progress);
  if (!loaded) return loaded.error();
  if (options.json) {
    write_out(io::to_json_text(loaded->hints));
    return kDone;
  }
  print_hints(*loaded);
  if (options.resolved) {
    write_out(loaded->resolved_text);
    return kDone;
  }
  const simulation::Scene& scene = loaded->scene;
  const auto grounded = static_cast<std::size_t>(std::ranges::count_if(scene.ships, simulation::is_grounded));
  const auto walls =
      static_cast<std::size_t>(std::ranges::count_if(scene.ships, [](const simulation::ShipSpec& ship) {
        return std::holds_alternative<simulation::Wall>(ship.propulsion);
      }));
  print_out("{}: valid; \"{}\" with {}{}{} and {}, {:g} s in steps of {:g} s, hash {}\n",
            options.scene == "-" ? "stdin" : options.scene, scene.name,
            counted(scene.ships.size() - grounded, "ship"),
            grounded > walls ? ", " + counted(grounded - walls, "structure") : "",
            walls > 0 ? ", " + counted(walls, "wall") : "", counted(scene.floes.size(), "floe"),
            scene.time.until, scene.time.step, loaded->hash);
  print_floes(*loaded);
  return kDone;
}

}  // namespace

Command add_validate(CommandLine& app) {
  CommandLine command =
      app.add_command("validate", "Check a scene and report everything that is wrong with it", kExamples);
  auto options = std::make_shared<Options>();
  add_scene(command, options->scene);
  add_set(command, options->set);
  auto cases = command.option(
      "--cases", options->cases, "FILE",
      "Check the scene once for each line of this file, an object of paths and values", not_empty());
  auto resolved =
      command.flag("--resolved", options->resolved, "Print the scene with every default filled in");
  resolved.excludes(cases);
  command.flag("--json", options->json, "Print the problems as a JSON array; [] for none").excludes(resolved);
  add_progress(command, options->progress);
  return {command, [options] { return validate(*options); }};
}

}  // namespace polynya::app
