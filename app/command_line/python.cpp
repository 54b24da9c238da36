#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

constexpr std::pair<const char*, const char*> kCommands[] = {
    {"performance", "Find the speed that a ship can keep in level ice of each thickness"},
    {"figures", "Draw figures of a run, or of several side by side, for print"},
    {"loads", "Peaks of the ice force by place on the hull: statistics, return values, figures"},
    {"management", "Measure the effect of ice management, and rank the patterns of a study"},
    {"movie", "Make a film of a run: the ice, and the force on the ship"},
    {"study", "Plan, run and gather many runs of one scene"}};
constexpr auto kModule = "polynya.command";  ///< python/polynya/command.py starts all commands of the package

/// Returns the folder with the Python package: beside app/ in the build tree, the installed one, or that of a wheel,
/// whose program is in the package's bin/.
std::optional<fs::path> package_folder(const fs::path& program) {
  const fs::path above = program.parent_path().parent_path();
  if (fs::exists(above / "__init__.py")) return above.parent_path();
  for (const char* place : {"python", "lib/polynya/python"})
    if (fs::exists(above / place / "polynya" / "__init__.py")) return above / place;
  return {};
}

/// Debian's Python finds Debian's modules; another Python earlier on the path may not.
std::string python() {
  if (const char* chosen = std::getenv("POLYNYA_PYTHON"); chosen && *chosen) return chosen;
  const char* const debians = "/usr/bin/python3";
  return access(debians, X_OK) == 0 ? debians : "python3";
}

}  // namespace

int become_python(const std::vector<std::string>& words) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const auto package = package_folder(program);
  if (!package)
    return fail(kInputOutput,
                fmt::format("the Python package is neither in {0}/python nor in {0}/lib/polynya/python; build or "
                            "install polynya again",
                            program.parent_path().parent_path().string()));
  const char* const more = std::getenv("PYTHONPATH");
  setenv("PYTHONPATH", (package->string() + (more && *more ? ":" + std::string(more) : "")).c_str(), 1);
  setenv("PYTHONSAFEPATH", "1", 1);  // do not import modules from the working folder
  setenv("POLYNYA_PROGRAM", program.c_str(), 1);
  std::vector<std::string> line{python(), "-m", kModule};
  line.insert(line.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  arguments.reserve(line.size() + 1);
  for (std::string& word : line) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  flush_out();
  execvp(arguments[0], arguments.data());
  return fail(kInputOutput, fmt::format("{}: {}; this command needs Python: ./setup.sh python, or apt-get install "
                                        "python3",
                                        line.front(), std::strerror(errno)));
}

/// All words after the command's name are passed to Python, including --help.
void add_python_commands(CommandLine& app, Commands& commands) {
  for (const auto& [name, meaning] : kCommands) {
    CommandLine command = app.add_command(name, meaning, "");
    command.hand_on_arguments();
    commands.push_back({command, [command, name = name] {
                          std::vector<std::string> words = command.remaining();
                          words.insert(words.begin(), name);
                          return become_python(words);
                        }});
  }
}

}  // namespace polynya::app
