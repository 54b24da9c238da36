#pragma once

#include <string>

namespace polynya::io {

/// The descriptions of a scene (scene_input.hpp) in other forms.

std::string scene_schema();     ///< JSON Schema, draft 2020-12
std::string scene_tables();     ///< Markdown tables, as they stand in docs/scene.md
std::string commented_scene();  ///< a scene with every setting, its default and its meaning, ready to run

}  // namespace polynya::io
