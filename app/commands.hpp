#pragma once

#include "app/command_line.hpp"

namespace polynya::app {

/// Each adds one command to the command line: its help, its options and what it does, all in the file of its
/// name (docs/architecture.md, "To add").
Command add_channel(CLI::App& app);
Command add_completion(CLI::App& app);
Command add_cut(CLI::App& app);
Command add_database(CLI::App& app);
Command add_database_build(CLI::App& app);
Command add_database_query(CLI::App& app);
Command add_database_show(CLI::App& app);
Command add_database_study(CLI::App& app);
Command add_export(CLI::App& app);
Command add_figures(CLI::App& app);
Command add_import(CLI::App& app);
Command add_init(CLI::App& app);
Command add_inspect(CLI::App& app);
Command add_man(CLI::App& app);
Command add_movie(CLI::App& app);
Command add_performance(CLI::App& app);
Command add_read_json(CLI::App& app);
Command add_resume(CLI::App& app);
Command add_run(CLI::App& app);
Command add_schema(CLI::App& app);
Command add_ships(CLI::App& app);
Command add_study(CLI::App& app);
Command add_validate(CLI::App& app);
Command add_view(CLI::App& app);

}  // namespace polynya::app
