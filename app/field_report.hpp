#pragma once

#include "io/scene/scene_reader.hpp"

namespace polynya::app {

/// How the scene's random fields came out, on stdout: sizes, cover, and of a size law how near the floes are
/// to it.
void print_fields(const io::LoadedScene& scene);

}  // namespace polynya::app
