#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "app/command_line/files.hpp"
#include "app/run/load_scene.hpp"
#include "io/import/floe_import.hpp"
#include "io/import/floe_properties.hpp"
#include "io/scene/scene_input.hpp"
#include "io/text/output_file.hpp"

namespace polynya::app {
namespace {

// ---- polynya validate --cases

constexpr std::size_t kLongestCases = std::size_t{4} << 30;  ///< [bytes]
constexpr std::size_t kMostPrinted = 100;                    ///< cases whose problems are printed

/// Reads one case's scene; what is wrong with it.
std::vector<io::Problem> problems_of(const std::string& scene_text, const std::string& scene_name,
                                     std::string_view line, const std::string& cases, std::size_t number,
                                     io::SceneOverrides overrides) {
  auto assignments = io::parse_case(line, cases, static_cast<int>(number));
  if (!assignments) return {std::move(assignments.error())};
  std::ranges::move(*assignments, std::back_inserter(overrides.assignments));
  const auto loaded =
      io::read_scene(scene_text, scene_name, std::filesystem::path(scene_name).parent_path(), overrides);
  return loaded ? std::vector<io::Problem>{} : loaded.error();
}

/// Checks a scene once for each line of a file of cases (docs/studies.md) and prints what is wrong with each:
/// a line a problem on stderr, or on stdout a JSON object for each case that is refused. The code to exit
/// with.
int validate_cases(const std::string& scene, const std::string& cases, const io::SceneOverrides& overrides,
                   ProblemFormat format) {
  const auto scene_text = read_input(scene, io::kLongestScene);
  if (!scene_text) return fail(kInputOutput, fmt::format("{}: {}", scene, scene_text.error()));
  const auto text = read_input(cases, kLongestCases);
  if (!text) return fail(kInputOutput, fmt::format("{}: {}", cases, text.error()));
  std::size_t count = 0, refused = 0;
  for (std::size_t begin = 0; begin < text->size();) {
    const std::size_t end = std::min(text->find('\n', begin), text->size());
    const std::string_view line = std::string_view(*text).substr(begin, end - begin);
    const auto problems = problems_of(*scene_text, scene, line, cases, ++count, overrides);
    refused += problems.empty() ? 0 : 1;
    if (format == ProblemFormat::kJson && !problems.empty()) {
      std::string list = io::to_json_text(problems);
      std::erase(list, '\n');
      write_out(fmt::format("{{\"line\": {}, \"problems\": {}}}\n", count, list));
    } else if (refused <= kMostPrinted) {
      for (const io::Problem& problem : problems)
        print_err("{}{}\n", problem.file == cases ? "" : fmt::format("{}:{}: ", cases, count), to_string(problem));
    }
    begin = end + 1;
  }
  if (format == ProblemFormat::kJson) return refused == 0 ? kDone : kSceneInvalid;
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
    "  polynya validate scene.json --resolved   with every default filled in\n"
    "  polynya validate scene.json --set ice.thickness_m=0.7\n"
    "  polynya validate scene.json --cases cases.ndjson   each line as many --set: {\"ice.thickness_m\": "
    "0.7}\n"
    "  polynya validate scene.json --json       the problems as a JSON array, for editors\n"
    "  make-scene | polynya validate -          a scene from stdin\n";

struct ValidateOptions {
  std::string scene;
  std::vector<std::string> set;
  std::string cases;      ///< a file of them; empty: none
  bool resolved = false;  ///< print the scene with every default filled in
  ProgressKind progress = ProgressKind::kAuto;
  bool json = false;  ///< print its problems as a JSON array
};

/// How the scene's fields, drawn ice and floe files came out.
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
  const ProblemFormat format = options.json ? ProblemFormat::kJson : ProblemFormat::kText;
  io::SceneOverrides overrides;
  overrides.assignments = assignments_of(options.set);
  if (!options.cases.empty()) return validate_cases(options.scene, options.cases, overrides, format);
  const auto loaded = load_scene(options.scene, overrides, format, options.progress);
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

}  // namespace

Command add_validate(CommandLine& app) {
  CommandLine command =
      app.add_command("validate", "Check a scene and report everything that is wrong with it", kSceneExamples);
  auto options = std::make_shared<ValidateOptions>();
  add_scene(command, options->scene);
  add_set(command, options->set);
  command.option("--cases", &options->cases, "FILE",
                 "Check the scene once for each line of this file, an object of paths and values", not_empty());
  command.flag("--resolved", options->resolved, "Print the scene with every default filled in",
               {.excludes = {"--cases"}});
  command.flag("--json", options->json, "Print the problems as a JSON array; [] for none",
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
  command.option("file", file.get(), "FILE", "Where to; stdout if not given");
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

}  // namespace polynya::app
