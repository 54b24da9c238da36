#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>

#include <unistd.h>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/options.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

struct Action {
  const char* name;
  const char* meaning;
};

/// polynya.study (python/polynya/study) does these and has their options.
constexpr std::array kActions{
    Action{"plan", "Expand a study into cases, check every one and estimate time and disk"},
    Action{"run", "Run one case, some, or all that are not finished"},
    Action{"slurm", "Write the sbatch scripts of a study, and submit them with --submit"},
    Action{"parallel", "Print the GNU parallel line that runs a study on several machines"},
    Action{"gather", "Make one table of all cases, and list what is missing or failed"},
    Action{"report", "Make a study's statistics, pictures and page"},
};

/// The folder that holds the Python package: beside the build's app/, or the installed one.
std::optional<fs::path> package_folder(const fs::path& program) {
  const fs::path above = program.parent_path().parent_path();
  for (const char* place : {"python", "lib/polynya/python"})
    if (fs::exists(above / place / "polynya" / "study" / "__main__.py")) return above / place;
  return {};
}

/// Debian's Python sees Debian's modules; another one first in the path may not.
std::string python() {
  if (const char* chosen = std::getenv("POLYNYA_PYTHON"); chosen && *chosen) return chosen;
  const char* const debians = "/usr/bin/python3";
  return access(debians, X_OK) == 0 ? debians : "python3";
}

/// Becomes Python with these words; returns only where that fails.
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
  std::vector<std::string> line{python(), "-m", "polynya.study"};
  line.insert(line.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : line) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  return fail(kInputOutput,
              fmt::format("{}: {}; studies need Python: ./setup.sh python, or apt-get install python3",
                          line[0], std::strerror(errno)));
}

/// All that follows is for Python, --help too.
Command add_action(CLI::App& study, const Action& action) {
  auto* command = study.add_subcommand(action.name, action.meaning);
  command->set_help_flag();
  command->prefix_command();
  auto given = std::make_shared<std::string>();
  option(*command, "study", *given, "FILE", "The study's JSON file, or the folder that plan made of it");
  return {command, [command, given, name = std::string(action.name)] {
            std::vector<std::string> words{name};
            if (!given->empty()) words.push_back(*given);
            for (std::string& word : command->remaining()) words.push_back(std::move(word));
            return become_python(words);
          }};
}

}  // namespace

Command add_study(CLI::App& app) {
  auto* command = app.add_subcommand("study", "Plan, run and gather many runs of one scene");
  command->footer(
      "Examples:\n"
      "  polynya study plan scenes/studies/pack-ice-loads.json   expand, check and estimate\n"
      "  polynya study run studies/pack-ice-loads --jobs 2       all cases on this machine; resumes what "
      "stopped\n"
      "  polynya study slurm studies/pack-ice-loads --submit     all cases as one Slurm job array\n"
      "  polynya study gather studies/pack-ice-loads             one table of all cases\n"
      "  polynya study report studies/pack-ice-loads             statistics, pictures and a page\n"
      "\n"
      "polynya study plan --help, and so on, explains each one's options. Studies need Python 3, report also "
      "numpy, scipy and matplotlib (./setup.sh python).\n"
      "\n"
      "Exit codes: 0 all cases finished, 2 usage, 3 study or scene invalid, 4 cases failed, 5 input/output, "
      "75 "
      "cases are unfinished or were stopped.\n");
  command->require_subcommand(1);
  auto commands = std::make_shared<std::vector<Command>>();
  for (const Action& action : kActions) commands->push_back(add_action(*command, action));
  return {command, [commands] { return run_chosen(*commands); }};
}

}  // namespace polynya::app
