#include "app/command_line/python.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <unistd.h>

#include "app/command_line/commands.hpp"
#include "app/command_line/console.hpp"
#include "io/text/child_process.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 7> kPythonCommands{"calibrate", "figures",     "loads", "management",
                                                          "movie",     "performance", "study"};
constexpr auto kModule = "polynya.command";  ///< python/polynya/command.py starts every command of the package

/// The folder that holds the Python package: beside the build's app/, the installed one, or that of a wheel, whose
/// program is in the package's bin/.
std::optional<fs::path> package_folder(const fs::path& program) {
  const fs::path above = program.parent_path().parent_path();
  if (fs::exists(above / "__init__.py")) return above.parent_path();
  for (const char* place : {"python", "lib/polynya/python"})
    if (fs::exists(above / place / "polynya" / "__init__.py")) return above / place;
  return {};
}

/// Debian's Python sees Debian's modules; another one first in the path may not.
std::string python() {
  if (const char* chosen = std::getenv("POLYNYA_PYTHON"); chosen && *chosen) return chosen;
  const char* const debians = "/usr/bin/python3";
  return access(debians, X_OK) == 0 ? debians : "python3";
}

/// The line that starts a command of the package, and its environment; reports where there is no package.
std::optional<std::vector<std::string>> python_line(const std::vector<std::string>& words) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const auto package = package_folder(program);
  if (!package) {
    fail(kInputOutput, fmt::format("the Python package is neither in {0}/python nor in {0}/lib/polynya/python; build "
                                   "or install polynya again",
                                   program.parent_path().parent_path().string()));
    return std::nullopt;
  }
  const char* const more = std::getenv("PYTHONPATH");
  setenv("PYTHONPATH", (package->string() + (more && *more ? ":" + std::string(more) : "")).c_str(), 1);
  setenv("PYTHONSAFEPATH", "1", 1);  // no module of the working folder
  setenv("POLYNYA_PROGRAM", program.c_str(), 1);
  std::vector<std::string> line{python(), "-m", kModule};
  line.insert(line.end(), words.begin(), words.end());
  flush_out();
  return line;
}

int fail_without_python(const std::string& reason) {
  return fail(kInputOutput, reason + "; this command needs Python: ./setup.sh python, or apt-get install python3");
}

/// What Python prints on stdout; nothing where it cannot be started or fails.
std::string printed_by_python(const std::vector<std::string>& words) {
  constexpr std::size_t kLongest = std::size_t{1} << 24;  // [bytes]
  const auto line = python_line(words);
  if (!line) return "";
  const auto output = io::run_child(*line, kLongest);
  if (!output) {
    fail_without_python(output.error());
    return "";
  }
  write_err(output->err);
  return output->code == 0 ? output->out : "";
}

/// Members of an object whose values are texts, as Python wrote them.
std::string text_of(const io::JsonValue& object, std::string_view key) {
  const io::JsonValue* found = object.find(key, io::JsonValue::Kind::kText);
  return found ? found->text() : "";
}

/// As `python3 -m polynya.command --describe` has a command.
void describe(CommandDescription& command, const io::JsonValue& described) {
  command.examples = text_of(described, "examples");
  command.rest = text_of(described, "rest");
  command.options.clear();
  for (const io::JsonValue& option : described.find("options")->items()) {
    OptionDescription added;
    added.type = text_of(option, "type");
    added.meaning = text_of(option, "meaning");
    for (const io::JsonValue& name : option.find("names")->items()) added.names.push_back(name.text());
    added.is_positional = added.names.empty();
    added.takes_value = !added.is_positional && !added.type.empty();
    command.options.push_back(std::move(added));
  }
  for (const io::JsonValue& action : described.find("commands")->items()) {
    CommandDescription& added = command.commands.emplace_back();
    added.name = text_of(action, "name");
    added.meaning = text_of(action, "meaning");
    describe(added, action);
  }
}

/// All that follows the command's name is for Python, --help too.
Command add_python_command(CommandLine& app, const char* name, const char* meaning) {
  CommandLine command = app.add_command(name, meaning, "");
  command.hand_on_arguments();
  return {command, [command, name] {
            std::vector<std::string> words{name};
            for (std::string& word : command.remaining()) words.push_back(std::move(word));
            return become_python(words);
          }};
}

}  // namespace

Command add_calibrate(CommandLine& app) {
  return add_python_command(app, "calibrate", "Fit the two factors of bending to level-ice tests of a ship");
}
Command add_figures(CommandLine& app) {
  return add_python_command(app, "figures", "Draw a run, or several side by side, for print");
}
Command add_loads(CommandLine& app) {
  return add_python_command(app, "loads", "Peaks of the ice's force by place: statistics, return values, figures");
}
Command add_management(CommandLine& app) {
  return add_python_command(app, "management",
                            "State what ice management did: floes through gates, hits, loads, effort");
}
Command add_movie(CommandLine& app) {
  return add_python_command(app, "movie", "Make a film of a run: the ice, and the force on the ship");
}
Command add_performance(CommandLine& app) {
  return add_python_command(app, "performance", "Find the speed that a ship keeps in level ice, by thickness");
}
Command add_study(CommandLine& app) {
  return add_python_command(app, "study", "Plan, run and gather many runs of one scene");
}

int become_python(const std::vector<std::string>& words) {
  auto line = python_line(words);
  if (!line) return kInputOutput;
  std::vector<char*> arguments;
  arguments.reserve(line->size() + 1);
  for (std::string& word : *line) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  return fail_without_python(fmt::format("{}: {}", line->front(), std::strerror(errno)));
}

void describe_python_commands(std::vector<CommandDescription>& commands) {
  const io::JsonDocument described = io::parse_json(printed_by_python({"--describe"}));
  for (CommandDescription& command : commands) {
    if (std::ranges::find(kPythonCommands, command.name) == kPythonCommands.end()) continue;
    if (const io::JsonValue* found = described.root.find(command.name))
      describe(command, *found);
    else
      command.rest = fmt::format("polynya {} --help explains its options.\n", command.name);
  }
}

}  // namespace polynya::app
