#include "app/python.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/exit_code.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

constexpr auto kModule =
    "polynya.command";  ///< python/polynya/command.py starts every command of the package

/// The folder that holds the Python package: beside the build's app/, or the installed one.
std::optional<fs::path> package_folder(const fs::path& program) {
  const fs::path above = program.parent_path().parent_path();
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

/// What Python prints on stdout; nothing where it cannot be started or fails.
std::string printed_by_python(const std::vector<std::string>& words) {
  int ends[2];
  if (pipe(ends) != 0) return "";
  flush_out();
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    close(ends[1]);
    _exit(become_python(words));
  }
  close(ends[1]);
  std::string text;
  char block[1 << 12];
  for (ssize_t count = 0; child > 0 && (count = read(ends[0], block, sizeof block)) > 0;)
    text.append(block, static_cast<std::size_t>(count));
  close(ends[0]);
  int status = 0;
  return child > 0 && waitpid(child, &status, 0) == child && status == 0 ? text : "";
}

/// Members of an object whose values are texts, as Python wrote them.
std::string text_of(const io::JsonValue& object, std::string_view key) {
  const io::JsonValue* found = object.find(key, io::JsonValue::Kind::kText);
  return found ? found->text() : "";
}

/// As `python3 -m polynya.command --describe` has it.
void describe(CLI::App& command, const io::JsonValue& described) {
  command.footer(text_of(described, "footer"));
  command.set_help_flag("-h,--help", "Print this help message and exit");
  for (const io::JsonValue& option : described.find("options")->items()) {
    const std::string name = text_of(option, "name"), type = text_of(option, "type"),
                      meaning = text_of(option, "meaning");
    if (type.empty())
      command.add_flag(name, meaning);
    else
      command
          .add_option_function<std::string>(
              name, [](const std::string&) {}, meaning)
          ->type_name(type);
  }
  for (const io::JsonValue& action : described.find("commands")->items())
    describe(*command.add_subcommand(text_of(action, "name"), text_of(action, "meaning")), action);
}

/// All that follows the command's name is for Python, --help too.
Command add_python_command(CLI::App& app, const char* name, const char* meaning) {
  auto* command = app.add_subcommand(name, meaning);
  command->set_help_flag();
  command->prefix_command();
  return {command, [command, name] {
            std::vector<std::string> words{name};
            for (std::string& word : command->remaining()) words.push_back(std::move(word));
            return become_python(words);
          }};
}

}  // namespace

Command add_figures(CLI::App& app) {
  return add_python_command(app, "figures", "Draw a run, or several side by side, for print");
}
Command add_movie(CLI::App& app) {
  return add_python_command(app, "movie", "Make a film of a run: the ice, and the force on the ship");
}
Command add_performance(CLI::App& app) {
  return add_python_command(app, "performance",
                            "Find the speed that a ship keeps in level ice, by thickness");
}
Command add_study(CLI::App& app) {
  return add_python_command(app, "study", "Plan, run and gather many runs of one scene");
}

int become_python(const std::vector<std::string>& words) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const auto package = package_folder(program);
  if (!package)
    return fail(
        kInputOutput,
        fmt::format("the Python package is neither in {0}/python nor in {0}/lib/polynya/python; build "
                    "or install polynya again",
                    program.parent_path().parent_path().string()));
  const char* const more = std::getenv("PYTHONPATH");
  setenv("PYTHONPATH", (package->string() + (more && *more ? ":" + std::string(more) : "")).c_str(), 1);
  setenv("PYTHONSAFEPATH", "1", 1);  // no module of the working folder
  setenv("POLYNYA_PROGRAM", program.c_str(), 1);
  std::vector<std::string> line{python(), "-m", kModule};
  line.insert(line.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  arguments.reserve(line.size() + 1);
  for (std::string& word : line) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  flush_out();
  execvp(arguments[0], arguments.data());
  return fail(kInputOutput,
              fmt::format("{}: {}; this command needs Python: ./setup.sh python, or apt-get install python3",
                          line[0], std::strerror(errno)));
}

void describe_python_commands(CLI::App& app) {
  const io::JsonDocument described = io::parse_json(printed_by_python({"--describe"}));
  for (const char* name : {"figures", "movie", "performance", "study"}) {
    CLI::App& command = *app.get_subcommand(name);
    if (const io::JsonValue* found = described.root.find(name))
      describe(command, *found);
    else
      command.footer(fmt::format("polynya {} --help explains its options.\n", name));
  }
}

}  // namespace polynya::app
