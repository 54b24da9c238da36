#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/scene/scene_reader.hpp"

namespace polynya::cosim {

/// Folder in the archive with the scene, the only file there. The unit's library finds the file by its suffix; its name
/// is that of the scene.
inline constexpr const char* kResources = "resources/";

/// Returns the bytes of a Functional Mock-up Unit (.fmu). `text` is the scene as the unit will read it, `scene` what it
/// becomes, `libraries` the unit's shared library and those that it needs beside it.
io::Result<std::string> pack_unit(const std::string& text, const io::LoadedScene& scene,
                                  const std::vector<std::filesystem::path>& libraries);

}  // namespace polynya::cosim
