#pragma once

#include <functional>
#include <vector>

#include <CLI/CLI.hpp>

namespace polynya::app {

/// A subcommand on the command line, and what it does; it returns an ExitCode. Data goes to stdout, messages
/// to stderr.
struct Command {
  const CLI::App* app;
  std::function<int()> run;
};

/// Runs the command that the parsed line chose.
inline int run_chosen(const std::vector<Command>& commands) {
  for (const Command& command : commands) {
    if (command.app->parsed()) return command.run();
  }
  return 0;
}

}  // namespace polynya::app
