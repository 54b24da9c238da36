#include "app/commands.hpp"
#include "app/python.hpp"

namespace polynya::app {

/// All that follows is for Python, --help too.
Command add_performance(CLI::App& app) {
  auto* command =
      app.add_subcommand("performance", "Find the speed that a ship keeps in level ice, by thickness");
  command->set_help_flag();
  command->prefix_command();
  return {command, [command] { return become_python("polynya.performance", command->remaining()); }};
}

}  // namespace polynya::app
