#include <memory>

#include "app/commands.hpp"

namespace polynya::app {

Command add_database(CommandLine& app) {
  CommandLine command = app.add_command(
      "database", "Build, show, query and study the icebreaking database",
      "Examples:\n"
      "  polynya database query --thickness 0.5 --speed 0.89 --wedge-angle 90 --hull-angle 60\n"
      "  polynya database show --svg plots\n"
      "  polynya database build --fluid free-surface\n"
      "  polynya database study accuracy\n"
      "\n"
      "Exit codes: 0 done, 2 usage, 4 a wedge does not break, 5 input/output, or a file that is no such "
      "database.\n");
  command.require_command();
  auto commands = std::make_shared<std::vector<Command>>();
  for (const auto add : {add_database_build, add_database_show, add_database_query, add_database_study})
    commands->push_back(add(command));
  return {command, [commands] { return run_chosen(*commands); }};
}

}  // namespace polynya::app
