#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/scene/scene_reader.hpp"

namespace polynya::cosim {

/// Folder of the archive that contains the scene as its only file. The file has the scene's name; the unit's library
/// finds it by its suffix.
inline constexpr const char* kResources = "resources/";

/// A shared library that a unit contains, and the folder of its system below binaries: linux64 or win64.
struct UnitLibrary {
  std::filesystem::path file;
  std::string system;
  std::string name;  ///< file name in the unit
};

/// Returns the bytes of a Functional Mock-up Unit (.fmu). `text` is the scene as the unit will read it, and
/// `scene` is the result of reading it. `libraries` are the unit's shared library for each system and the libraries
/// that it needs.
io::Result<std::string> pack_unit(const std::string& text, const io::LoadedScene& scene,
                                  const std::vector<UnitLibrary>& libraries);

}  // namespace polynya::cosim
