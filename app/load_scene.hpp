#pragma once

#include <string>

#include <tl/expected.hpp>

#include "app/exit_code.hpp"
#include "io/scene_reader.hpp"

namespace polynya::app {

/// The scene of that file. Where it cannot be read or is wrong, every problem has been told on stderr, and it
/// is the code to exit with.
tl::expected<io::LoadedScene, ExitCode> load_scene(const std::string& file,
                                                   const io::SceneOverrides& overrides = {});

}  // namespace polynya::app
