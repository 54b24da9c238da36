#pragma once

#include <string>

namespace polynya::app {

/// `polynya view SCENE.json`: the page of a scene that has not run, beside it as SCENE.html if `out` is empty. With
/// `watch` again each time that the scene's file changes, until a signal.
int write_scene_view(const std::string& scene, const std::string& out, bool watch);

}  // namespace polynya::app
