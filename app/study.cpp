#include <array>
#include <memory>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/options.hpp"
#include "app/python.hpp"

namespace polynya::app {
namespace {

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

/// All that follows is for Python, --help too.
Command add_action(CommandLine& study, const Action& action) {
  CommandLine command = study.add_command(action.name, action.meaning, "");
  command.hand_on_arguments();
  auto given = std::make_shared<std::string>();
  command.option("study", *given, "FILE", "The study's JSON file, or the folder that plan made of it");
  return {command, [command, given, name = std::string(action.name)] {
            std::vector<std::string> words{name};
            if (!given->empty()) words.push_back(*given);
            for (std::string& word : command.remaining()) words.push_back(std::move(word));
            return become_python("polynya.study", words);
          }};
}

}  // namespace

Command add_study(CommandLine& app) {
  CommandLine command = app.add_command(
      "study", "Plan, run and gather many runs of one scene",
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
  command.require_command();
  auto commands = std::make_shared<std::vector<Command>>();
  for (const Action& action : kActions) commands->push_back(add_action(command, action));
  return {command, [commands] { return run_chosen(*commands); }};
}

}  // namespace polynya::app
