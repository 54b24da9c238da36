#pragma once

#include <string>
#include <vector>

namespace polynya::app {

/// Becomes Python, which runs a module of the package (python/polynya) with these words. Returns, with an
/// ExitCode, only where that fails.
int become_python(const std::string& module, const std::vector<std::string>& words);

}  // namespace polynya::app
