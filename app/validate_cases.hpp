#pragma once

#include <string>

#include "app/load_scene.hpp"

namespace polynya::app {

/// Checks a scene once for each line of a file of cases (docs/studies.md) and prints what is wrong with each:
/// a line a problem on stderr, or on stdout a JSON object for each case that is refused. The code to exit
/// with.
int validate_cases(const std::string& scene, const std::string& cases, const io::SceneOverrides& overrides,
                   ProblemFormat format);

}  // namespace polynya::app
