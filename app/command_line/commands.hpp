#pragma once

#include <string_view>

#include "app/command_line/command_line.hpp"

namespace polynya::app {

/// Each adds one command to the command line: its help, its options and what it does, all in one file
/// (docs/architecture.md, "To add").
Command add_channel(CommandLine& app);
Command add_completion(CommandLine& app);
Command add_cut(CommandLine& app);
Command add_database(CommandLine& app);
Command add_database_build(CommandLine& app);
Command add_database_query(CommandLine& app);
Command add_database_show(CommandLine& app);
Command add_export(CommandLine& app);
Command add_figures(CommandLine& app);
Command add_import(CommandLine& app);
Command add_init(CommandLine& app);
Command add_inspect(CommandLine& app);
Command add_man(CommandLine& app);
Command add_loads(CommandLine& app);
Command add_management(CommandLine& app);
Command add_movie(CommandLine& app);
Command add_calibrate(CommandLine& app);
Command add_performance(CommandLine& app);
Command add_read_json(CommandLine& app);
Command add_resume(CommandLine& app);
Command add_run(CommandLine& app);
Command add_schema(CommandLine& app);
Command add_ships(CommandLine& app);
Command add_study(CommandLine& app);
Command add_validate(CommandLine& app);
Command add_view(CommandLine& app);

/// Of the source that the program is built of; empty outside of git (cmake/PolynyaCommit.cmake).
extern const std::string_view kCommit;

}  // namespace polynya::app
