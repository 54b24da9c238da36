#pragma once

#include <string>

#include "io/scene/scene_reader.hpp"
#include "io/text/problem.hpp"

namespace polynya::views {

/// One HTML file that shows a scene that has not run (docs/view.md). `stamp` is of this page: the script `stamp_file`
/// beside it, where one is named, has that of the newest (`--watch`).
io::Result<std::string> scene_page(const io::LoadedScene& scene, const std::string& stamp,
                                   const std::string& stamp_file);

}  // namespace polynya::views
