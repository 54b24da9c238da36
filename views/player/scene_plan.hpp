#pragma once

#include <string>

#include "io/scene/scene_reader.hpp"

namespace polynya::views {

/// What the page of a scene that has not run shows beside its ice and hulls, as the page's options: routes of ships,
/// wind, and what `polynya validate` warns of. `stamp` is of this page: the script `stamp_file` beside it, where one is
/// named, has that of the newest (`--watch`).
std::string scene_plan(const io::LoadedScene& scene, const std::string& stamp, const std::string& stamp_file);

}  // namespace polynya::views
