#include <map>
#include <memory>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "app/choice_option.hpp"
#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/exit_code.hpp"
#include "app/guide.hpp"
#include "app/memory_check.hpp"
#include "app/number_option.hpp"
#include "app/usage.hpp"
#include "app/write_output.hpp"
#include "geometry/exact/exact_memory.hpp"
#include "io/text/version.hpp"

namespace polynya::app {

void add_progress(CLI::App& command, ProgressKind& kind) {
  set_choices<ProgressKind>(
      *command.add_option("--progress", kind,
                          "auto: a bar on a terminal, else a line every ten seconds; on stderr"),
      {{"auto", ProgressKind::kAuto},
       {"bar", ProgressKind::kBar},
       {"json", ProgressKind::kJson},
       {"none", ProgressKind::kNone}});
}

namespace {

int write_page(const std::string& file, const std::string& text) {
  const std::string wrong = write_output(file.empty() ? "-" : file, text);
  if (!wrong.empty()) print_err("polynya: {}\n", wrong);
  return wrong.empty() ? kDone : kInputOutput;
}

/// What starting a run and going on with one have in common.
void add_carry(CLI::App& command, CarryOptions& options) {
  command.add_option("--threads", options.threads, "Threads to step on; results do not depend on it")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command
      .add_option("--checkpoint-every", options.checkpoint_every,
                  "Simulated time between checkpoints, beside those by the clock [s]")
      ->type_name("S")
      ->check(between(1e-5, 1e7));
  command
      .add_option("--checkpoint-every-wall", options.checkpoint_every_wall,
                  "Time by the clock between checkpoints, 60 if not given; 0: none by the clock [s]")
      ->type_name("S")
      ->check(between(0, 1e7));
  command.add_flag("--check", options.check,
                   "Derive every cross-index and sum anew after every step; stop if one is off");
  add_progress(command, options.progress);
}

Command add_run(CLI::App& app) {
  auto* command = app.add_subcommand("run", "Run a scene and write its run folder");
  command->footer(
      "Examples:\n"
      "  polynya run scenes/sawamura2017-fig4b.json\n"
      "  polynya run scenes/level-plate.json --until 60 --out /tmp/plate --overwrite\n");
  auto options = std::make_shared<RunOptions>();
  command->add_option("scene", options->scene, "The scene's JSON file; - for stdin")
      ->required()
      ->type_name("SCENE");
  command->add_option("--out", options->out, "The run folder; runs/<scene name> if not given")
      ->type_name("DIR");
  command->add_option("--until", options->until, "Simulated time to run to, instead of the scene's [s]")
      ->type_name("S")
      ->check(between(1e-9, 1e7));
  command->add_option("--seed", options->seed, "Seed instead of the scene's")
      ->type_name("N")
      ->check(CLI::Range(0.0, 9007199254740991.0));
  add_carry(*command, options->carry);
  command->add_flag("--overwrite", options->overwrite, "Replace the run that is in the folder");
  return [options] { return run(*options); };
}

Command add_resume(CLI::App& app) {
  auto* command =
      app.add_subcommand("resume", "Go on with a run that was stopped, killed or ran out of disk");
  command->footer(
      "Examples:\n"
      "  polynya resume runs/level-plate\n"
      "  polynya resume runs/level-plate --checkpoint runs/level-plate/checkpoint-000000012000.bin\n"
      "  polynya resume runs/level-plate --from-failure     only the step that failed, once more\n");
  auto options = std::make_shared<ResumeOptions>();
  command->add_option("folder", options->folder, "The run folder")->required()->type_name("RUN");
  auto* checkpoint =
      command->add_option("--checkpoint", options->checkpoint, "This one, instead of the newest");
  checkpoint->type_name("FILE");
  command
      ->add_flag("--from-failure", options->from_failure,
                 "Repeat the step for which failure.bin was dumped; nothing is written")
      ->excludes(checkpoint);
  add_carry(*command, options->carry);
  return [options] { return resume(*options); };
}

Command add_validate(CLI::App& app) {
  auto* command = app.add_subcommand("validate", "Check a scene, and tell everything that is wrong with it");
  command->footer(
      "Examples:\n"
      "  polynya validate scene.json\n"
      "  polynya validate scene.json --resolved   with every default filled in\n"
      "  polynya validate scene.json --json       the problems as a JSON array, for editors\n"
      "  make-scene | polynya validate -          a scene from stdin\n");
  auto options = std::make_shared<ValidateOptions>();
  command->add_option("scene", options->scene, "The scene's JSON file; - for stdin")
      ->required()
      ->type_name("SCENE");
  auto* resolved =
      command->add_flag("--resolved", options->resolved, "Print the scene with every default filled in");
  command->add_flag("--json", options->json, "Print the problems as a JSON array; [] for none")
      ->excludes(resolved);
  return [options] { return validate(*options); };
}

Command add_schema(CLI::App& app) {
  auto* command = app.add_subcommand("schema", "Print the JSON Schema of scenes");
  command->footer(
      "Examples:\n  polynya schema > polynya.schema.json\n  polynya schema --markdown            the tables "
      "of docs/scene.md\n");
  auto options = std::make_shared<SchemaOptions>();
  command->add_flag("--markdown", options->markdown, "Print the fields as Markdown tables");
  return [options] { return schema(*options); };
}

Command add_init(CLI::App& app) {
  auto* command = app.add_subcommand("init", "Write a commented scene to start from");
  command->footer(
      "Examples:\n  polynya init my-scene.json && polynya run my-scene.json\n  polynya init                  "
      "       to stdout\n");
  auto options = std::make_shared<InitOptions>();
  command->add_option("file", options->file, "Where to; stdout if not given")->type_name("FILE");
  return [options] { return init(*options); };
}

/// `polynya man` and `polynya completion`, for the installation: not in the help.
Command add_page(CLI::App& app, const char* name, const char* words, std::string (*page)(const CLI::App&)) {
  auto* command = app.add_subcommand(name, words);
  command->group("");
  auto file = std::make_shared<std::string>();
  command->add_option("file", *file, "Where to; stdout if not given")->type_name("FILE");
  return [file, page, &app] { return write_page(*file, page(app)); };
}

constexpr auto kExamples =
    "Examples:\n"
    "  polynya run scenes/sawamura2017-fig4b.json     the paper's voyage, to runs/sawamura2017-fig4b\n"
    "  polynya init my-scene.json                     a commented scene to start from\n"
    "  polynya validate my-scene.json                 everything that is wrong with a scene\n"
    "  polynya inspect runs/my-scene --check          the floes of a run, and whether they are right\n"
    "  polynya view runs/my-scene                     a page that plays the run in a browser\n"
    "  polynya channel runs/my-scene                  how wide the channel behind the ship is\n"
    "  polynya figures runs/my-scene                  pictures for print: ice, loads, motion, sizes\n"
    "  polynya export runs/my-scene --vtk paraview    for ParaView; --geojson for QGIS\n"
    "  polynya cut floes.geojson --disc 10,5,3        cut floes outside any simulation\n"
    "\n"
    "Polynya simulates an icebreaker in pack ice: floes are pushed, plates break by bending and splitting.\n";

constexpr auto kCodes =
    "Exit codes: 0 done, 2 usage, 3 scene invalid, 4 numerical failure, geometry refused or out of memory, "
    "5 input/output, 75 stopped on a "
    "signal with a checkpoint (polynya resume), 141 the reader of stdout or stderr closed the pipe.\n"
    "Data goes to stdout, messages to stderr.\n";

int report_out_of_memory() {
  try {
    print_err("polynya: {}\n", out_of_memory());
  } catch (const std::bad_alloc&) {
    write_err("polynya: out of memory\n");
  }
  return kOutOfMemory;
}

int command_line(int count, char** words) {
  CLI::App app(kExamples, "polynya");
  lead_with_examples(app);
  app.footer(kCodes);
  app.set_version_flag("--version", "polynya " + std::string(io::version()));
  app.require_subcommand(1);
  std::map<std::string, Command> commands;
  constexpr std::pair<const char*, Command (*)(CLI::App&)> kCommands[] = {
      {"run", add_run},         {"resume", add_resume},   {"validate", add_validate},
      {"schema", add_schema},   {"init", add_init},       {"view", add_view},
      {"channel", add_channel}, {"figures", add_figures}, {"export", add_export},
      {"inspect", add_inspect}, {"cut", add_cut},         {"database", add_database}};
  for (const auto& [name, add] : kCommands) {
    commands[name] = add(app);
  }
  commands["man"] = add_page(app, "man", "Write the manual page", man_page);
  commands["completion"] = add_page(app, "completion", "Write the completion for bash", bash_completion);
  try {
    app.parse(count, words);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, unused;
    if (app.exit(error, out, unused) != 0) {
      write_err(usage_message(app, error));
      return kUsage;
    }
    write_out(out.str());  // what was asked for: help or version
    return kDone;
  }
  return commands.at(app.get_subcommands().front()->get_name())();
}

/// What the standard library throws, as an exit code.
int guarded_command_line(int count, char** words) {
  try {
    return command_line(count, words);
  } catch (const std::bad_alloc&) {
    return report_out_of_memory();
  } catch (const std::length_error&) {
    return report_out_of_memory();
  } catch (const std::system_error& error) {
    print_err("polynya: {}\n", error.what());
    return kInputOutput;
  }
}

}  // namespace
}  // namespace polynya::app

int main(int count, char** words) {
  polynya::app::open_streams();
  polynya::geometry::let_exact_numbers_outlast_memory();
  return polynya::app::close_streams(polynya::app::guarded_command_line(count, words));
}
