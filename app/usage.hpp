#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace polynya::app {

/// What is wrong with a command line, for stderr: the command, the fault, the nearest name where one was
/// meant, and where to read on.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace polynya::app
