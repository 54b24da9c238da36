#pragma once

#include <string>
#include <vector>

#include "app/command_line/command_line.hpp"

namespace polynya::app {

/// Becomes Python, which runs a command of the package (python/polynya/command.py): its name and its words.
/// Returns, with an ExitCode, only where that fails.
int become_python(const std::vector<std::string>& words);

/// Gives those of the commands that are written in Python the options and examples that Python has for them:
/// for pages that list all commands. Where there is no Python, each refers to its --help.
void describe_python_commands(std::vector<CommandDescription>& commands);

}  // namespace polynya::app
