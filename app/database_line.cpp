#include <map>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "app/choice_option.hpp"
#include "app/command_line.hpp"
#include "app/database.hpp"
#include "app/number_option.hpp"

namespace polynya::app {
namespace {

using Commands = std::map<std::string, Command>;

/// For files and folders: an empty name is a shell variable that is not set, not the default.
CLI::Validator name() {
  return {[](std::string& word) -> std::string { return word.empty() ? "the name is empty" : ""; }, ""};
}

void add_threads(CLI::App& command, int& threads) {
  command
      .add_option("--threads", threads,
                  "As many as the machine runs at once if not given; no result depends on it")
      ->type_name("N")
      ->check(whole(1, 1024));
}

void add_database_file(CLI::App& command, std::string& file) {
  command.add_option("--database", file, "The database; the shipped one if not given")
      ->type_name("FILE")
      ->check(name());
}

void add_database_build(CLI::App& app, Commands& commands) {
  auto* command = app.add_subcommand("build", "Solve the wedges and write a database");
  command->footer(
      "Examples:\n"
      "  polynya database build                     byte for byte the database that ships with Polynya\n"
      "  polynya database build --fluid winkler --wedge-angles 30,60,90,120 --out winkler.txt\n");
  auto options = std::make_shared<DatabaseBuildOptions>();
  command->add_option("--out", options->out, "The file to write")
      ->type_name("FILE")
      ->check(name())
      ->capture_default_str();
  set_choices<fracture::FluidModel>(
      *command->add_option("--fluid", options->fluid, "What the water does; potential if not given"),
      {{"winkler", fracture::FluidModel::kWinkler},
       {"local-mass", fracture::FluidModel::kLocalMass},
       {"potential", fracture::FluidModel::kPotential},
       {"free-surface", fracture::FluidModel::kFreeSurface}});
  command
      ->add_option("--wedge-angles", options->wedge_angles_deg,
                   "Opening angles of the wedges, ascending; the shipped database's if not given [deg]")
      ->type_name("DEG,DEG,...")
      ->delimiter(',')
      ->check(between(5, 180));
  add_threads(*command, options->threads);
  add_progress(*command, options->progress);
  command->add_flag("--overwrite", options->overwrite, "Replace the file");
  commands["build"] = [options] { return database_build(*options); };
}

/// The ice, the water and the hull of a question; defaults are the paper's.
void add_load(CLI::App& command, DatabaseLoadOptions& load) {
  const auto number = [&command](const char* name, auto& value, const char* meaning, const char* unit,
                                 double least, double most) {
    return command.add_option(name, value, meaning)->type_name(unit)->check(between(least, most));
  };
  number("--wedge-angle", load.wedge_angle_deg, "Opening angle of the wedge of ice", "DEG", 0.1, 179.9);
  number("--front-angle", load.front_angle_deg, "Instead: from the inward normal to the front edge", "DEG", 0,
         89.9);
  number("--back-angle", load.back_angle_deg, "and to the back edge", "DEG", 0, 89.9);
  const auto group = [&](auto* option) { option->group("Ice and water")->capture_default_str(); };
  group(number("--density", load.ice.density, "of the ice", "KG_PER_M3", 1, 5000));
  group(number("--youngs-modulus", load.ice.youngs_modulus, "of the ice", "PA", 1e3, 1e12));
  group(number("--poisson-ratio", load.ice.poisson_ratio, "of the ice", "NU", 0, 0.5));
  group(number("--flexural-strength", load.ice.flexural_strength, "of the ice", "PA", 1, 1e9));
  group(number("--compressive-strength", load.ice.compressive_strength, "of the ice", "PA", 1, 1e9));
  group(number("--friction", load.ice.friction, "hull on ice", "MU", 0, 2));
  group(number("--water-density", load.water.density, "", "KG_PER_M3", 1, 5000));
}

/// The load's size and speed, asked for or with the defaults of a slice.
void add_point(CLI::App& command, DatabaseLoadOptions& load, bool is_required) {
  const auto number = [&](const char* name, double& value, const char* meaning, const char* unit,
                          double least, double most) {
    auto* option = command.add_option(name, value, meaning)->type_name(unit)->check(between(least, most));
    if (is_required)
      option->required();
    else
      option->capture_default_str();
  };
  number("--thickness", load.ice.thickness, "of the ice", "M", 1e-3, 100);
  number("--speed", load.speed, "of approach, normal to the hull's waterline", "M_PER_S", 0, 100);
  number("--hull-angle", load.hull_angle_deg, "the hull's inclination from the vertical", "DEG", 0, 89.9);
}

void add_database_show(CLI::App& app, Commands& commands) {
  auto* command =
      app.add_subcommand("show", "Print a database's parameters, grids and slices, and plot them");
  command->footer(
      "Examples:\n"
      "  polynya database show                      the database that ships with Polynya\n"
      "  polynya database show winkler.txt --svg plots --thickness 1\n");
  auto options = std::make_shared<DatabaseShowOptions>();
  command->add_option("file", options->file, "The database; the shipped one if not given")
      ->type_name("FILE")
      ->check(name());
  command
      ->add_option("--svg", options->svg_folder,
                   "Draw the slices to speed.svg, wedge-angle.svg, thickness.svg")
      ->type_name("DIR")
      ->check(name());
  add_point(*command, options->load, false);
  add_load(*command, options->load);
  commands["show"] = [options] { return database_show(*options); };
}

void add_database_query(CLI::App& app, Commands& commands) {
  auto* command =
      app.add_subcommand("query", "What a wedge of ice bears, by the database and by published forms");
  command->footer(
      "Examples:\n"
      "  polynya database query --thickness 0.5 --speed 0.89 --wedge-angle 90 --hull-angle 60\n"
      "  polynya database query --thickness 1 --speed 2 --front-angle 30 --back-angle 70 --hull-angle 50 "
      "--json\n");
  auto options = std::make_shared<DatabaseQueryOptions>();
  add_point(*command, options->load, true);
  add_load(*command, options->load);
  command->add_option("--slip-speed", options->load.slip_speed, "along the hull's waterline")
      ->type_name("M_PER_S")
      ->check(between(-100, 100))
      ->capture_default_str();
  add_database_file(*command, options->file);
  command->add_flag("--json", options->json, "Answer as JSON, in SI units");
  commands["query"] = [options] { return database_query(*options); };
}

void add_database_study(CLI::App& app, Commands& commands) {
  auto* command = app.add_subcommand("study", "Print the tables of docs/theory-bending.md");
  command->footer(
      "Examples:\n"
      "  polynya database study fluid               what each fluid model changes against speed\n"
      "  polynya database study couple              what the ice's own deflection changes\n"
      "  polynya database study accuracy            table against finer solutions at random points\n"
      "  polynya database study accuracy --inner-radius 0.001 --elements 72\n");
  auto options = std::make_shared<DatabaseStudyOptions>();
  set_choices<DatabaseStudy>(*command->add_option("study", options->study, "Which one")->required(),
                             {{"fluid", DatabaseStudy::kFluid},
                              {"couple", DatabaseStudy::kCouple},
                              {"accuracy", DatabaseStudy::kAccuracy}});
  add_point(*command, options->load, false);
  add_load(*command, options->load);
  command->add_option("--points", options->points, "of accuracy")
      ->check(whole(1, 100000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "of accuracy's points")
      ->check(whole(0, 9007199254740991))
      ->capture_default_str();
  command
      ->add_option("--inner-radius", options->inner_radius,
                   "of the solution that accuracy compares with; a quarter of the table's if not given")
      ->type_name("L")
      ->check(between(1e-6, 0.1));
  command
      ->add_option("--elements", options->elements,
                   "along its radius; as closely spaced as the table's if not given")
      ->type_name("N")
      ->check(whole(8, 400));
  add_threads(*command, options->threads);
  add_database_file(*command, options->file);
  commands["study"] = [options] { return database_study(*options); };
}

}  // namespace

Command add_database(CLI::App& app) {
  auto* command = app.add_subcommand("database", "Build, show, ask and study the icebreaking database");
  command->footer(
      "Examples:\n"
      "  polynya database query --thickness 0.5 --speed 0.89 --wedge-angle 90 --hull-angle 60\n"
      "  polynya database show --svg plots\n"
      "  polynya database build --fluid free-surface\n"
      "  polynya database study accuracy\n"
      "\n"
      "Exit codes: 0 done, 2 usage, 4 a wedge does not break, 5 input/output, or a file that is no such "
      "database.\n");
  command->require_subcommand(1);
  auto commands = std::make_shared<Commands>();
  for (const auto add : {add_database_build, add_database_show, add_database_query, add_database_study})
    add(*command, *commands);
  return [command, commands] { return commands->at(command->get_subcommands().front()->get_name())(); };
}

}  // namespace polynya::app
