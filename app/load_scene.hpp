#pragma once

#include <optional>
#include <string>

#include "io/scene_reader.hpp"

namespace polynya::app {

/// The scene of that file. Where it is wrong, every problem has been told on stderr and there is none.
std::optional<io::LoadedScene> load_scene(const std::string& file, const io::SceneOverrides& overrides = {});

}  // namespace polynya::app
