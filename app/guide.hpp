#pragma once

#include <vector>

namespace CLI {
class App;
}

namespace polynya::app {

/// Help with the examples before everything else; set it before subcommands are added, they inherit it.
void lead_with_examples(CLI::App& app);

/// The commands of a command line that its help lists.
std::vector<const CLI::App*> commands_of(const CLI::App& app);

}  // namespace polynya::app
