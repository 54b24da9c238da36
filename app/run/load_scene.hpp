#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "app/command_line/console.hpp"
#include "app/command_line/progress.hpp"
#include "io/scene/scene_reader.hpp"

namespace polynya::app {

/// How problems are printed: a line each on stderr, or as one JSON array on stdout.
enum class ProblemFormat { kText, kJson };

/// The scene of that file, or of stdin where its name is "-" (floe files are then searched in the working
/// folder), with its progress on stderr. Where it cannot be read or is wrong, every problem has been printed,
/// and it is the code to exit with.
tl::expected<io::LoadedScene, ExitCode> load_scene(const std::string& file, const io::SceneOverrides& overrides = {},
                                                   ProblemFormat format = ProblemFormat::kText,
                                                   ProgressKind progress = ProgressKind::kNone);

/// Each problem of that file on stderr, a line each, and how many there are.
void print_problems(const std::string& name, const std::vector<io::Problem>& problems);

/// How the scene's random fields came out, on stdout: sizes, cover, and of a size law how near the floes are
/// to it.
void print_fields(const io::LoadedScene& scene);

}  // namespace polynya::app
