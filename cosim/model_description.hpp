#pragma once

#include <string>

#include "cosim/variables.hpp"

namespace polynya::cosim {

/// Name of the unit's library without its suffix, and of the model in its description.
inline constexpr const char* kModelIdentifier = "polynya";

/// Returns the identifier by which a unit's library and its modelDescription.xml know that they belong together. It
/// follows from the scene, its variables and the program's version.
std::string guid_of(const io::LoadedScene& scene, const Interface& interface);

/// Returns modelDescription.xml of a scene as a unit for co-simulation, FMI 2.0.
std::string model_description(const io::LoadedScene& scene, const Interface& interface);

}  // namespace polynya::cosim
