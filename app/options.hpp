#pragma once

#include <string>
#include <vector>

#include "app/command_line.hpp"
#include "app/progress.hpp"
#include "io/scene/scene_assign.hpp"

namespace polynya::app {

// Options that several commands have.

/// The positionals SCENE and RUN.
void add_scene(CommandLine& command, std::string& scene);
void add_run_folder(CommandLine& command, std::string& folder);
/// --set, which every command that reads a scene to run or check it has.
void add_set(CommandLine& command, std::vector<io::Assignment>& assignments);
/// --progress, as every long command has it.
void add_progress(CommandLine& command, ProgressKind& kind);

}  // namespace polynya::app
