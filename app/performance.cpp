#include <array>
#include <memory>
#include <string>
#include <utility>

#include "app/commands.hpp"
#include "app/options.hpp"
#include "app/python.hpp"

namespace polynya::app {
namespace {

/// polynya.performance (python/polynya/performance) reads and checks their values.
constexpr std::array kOptions{
    PythonOption{"--thickness", "LIST",
                 "Thicknesses [m], as 0.4,0.8,1.2; ten up to where formulas stop the ship if not given"},
    PythonOption{"--flexural-strength", "PA", "Of the ice; 500e3 if not given"},
    PythonOption{"--friction", "MU", "Of ice on the hull; 0.1 if not given"},
    PythonOption{"--error", "SHARE", "Largest error of a mean speed, of that speed; 0.03 if not given"},
    PythonOption{"--step", "S", "Time step; 0.01 if not given"},
    PythonOption{"--out", "DIR",
                 "Folder of the runs, the table and the figure; runs/performance-SHIP if not given"},
    PythonOption{"--jobs", "N", "Runs at a time; one a processor if not given"},
};

}  // namespace

Command add_performance(CommandLine& app) {
  CommandLine command = app.add_command(
      "performance", "Find the speed that a ship keeps in level ice, by thickness",
      "Examples:\n"
      "  polynya performance polaris                       ten thicknesses, on all processors\n"
      "  polynya performance araon --flexural-strength 630e3 --friction 0.1\n"
      "  polynya performance ship.json --thickness 0.4,0.8,1.2 --out runs/our-ship\n"
      "  polynya performance oden --list                   the formulas alone, without a run\n"
      "\n"
      "Each thickness is a run in a plate of fast ice, repeated twice as long until the mean speed's "
      "standard error "
      "and its change between the halves are below the error asked for. Finished runs are kept: a curve that "
      "was "
      "stopped goes on. Points outside the range of validation are marked (docs/ships.md). Needs Python 3 "
      "with numpy, and matplotlib for the figure (./setup.sh python).\n");
  auto ship = std::make_shared<std::string>();
  auto values = std::make_shared<PythonOptions>(kOptions);
  auto is_list = std::make_shared<bool>(false);
  command
      .option("ship", *ship, "SHIP",
              "A preset (polynya ships), or a JSON file with a ship as scenes have it, which polynya ships "
              "checks")
      .required();
  values->add_to(command);
  command.flag("--list", *is_list, "Print the formulas' speeds and run nothing");
  return {command, [ship, values, is_list] {
            std::vector<std::string> words{*ship};
            values->append_to(words);
            if (*is_list) words.emplace_back("--list");
            return become_python("polynya.performance", words);
          }};
}

}  // namespace polynya::app
