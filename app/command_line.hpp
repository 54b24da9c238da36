#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "app/progress.hpp"

namespace polynya::app {

/// A subcommand: adds its options to the command line and returns what to do when it is chosen.
using Command = std::function<int()>;

/// `polynya database`, with its own subcommands.
Command add_database(CLI::App& app);

/// `polynya cut` and `polynya inspect`.
Command add_cut(CLI::App& app);
Command add_inspect(CLI::App& app);

/// `polynya view`.
Command add_view(CLI::App& app);

/// `polynya channel`, `figures` and `export`.
Command add_channel(CLI::App& app);
Command add_figures(CLI::App& app);
Command add_export(CLI::App& app);

/// --progress, as every long command has it.
void add_progress(CLI::App& command, ProgressKind& kind);

}  // namespace polynya::app
