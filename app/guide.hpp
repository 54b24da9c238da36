#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace polynya::app {

/// Help with the examples before everything else; set it before subcommands are added, they inherit it.
void lead_with_examples(CLI::App& app);

/// The commands of a command line that its help lists.
std::vector<const CLI::App*> commands_of(const CLI::App& app);

/// The manual page (roff, section 1) of the command line, all subcommands in it.
std::string man_page(const CLI::App& app);

/// A script that completes the command line in bash: commands, options, an option's choices, and files.
std::string bash_completion(const CLI::App& app);

}  // namespace polynya::app
