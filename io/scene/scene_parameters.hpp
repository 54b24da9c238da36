#pragma once

#include <string>
#include <vector>

#include "io/scene/record.hpp"
#include "io/scene/scene_reader.hpp"

namespace polynya::io {

/// A number of a scene that another program may set before a run. It has the path of `polynya run --set` and the
/// properties from the description of scenes.
struct SceneParameter {
  std::string path;     ///< "ice.thickness_m", "ships[0].mass_kg"
  std::string unit;     ///< unit for people; empty: none
  std::string meaning;  ///< without its unit
  Range range;
  FieldKind kind = FieldKind::kNumber;  ///< kNumber, kInteger or kBoolean
  double value = 0;                     ///< value in the scene, in the unit of the key; a boolean is 0 or 1
};

/// Returns the numbers and truth values of a scene that determine a run, in the order of the description: seed, time
/// step, water, wind, ice, contacts, fracture, ships, structures and random fields of floes. Left out are keys without
/// a value in the scene, words, lists and outlines.
std::vector<SceneParameter> scene_parameters(const LoadedScene& scene);

}  // namespace polynya::io
