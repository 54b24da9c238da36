#pragma once

#include <string>
#include <vector>

#include "io/scene/record.hpp"
#include "io/scene/scene_reader.hpp"

namespace polynya::io {

/// A number of a scene that another program, such as a co-simulation, may set before a run. Unit, meaning, range and
/// kind are those of its key in the description of scenes.
struct SceneParameter {
  std::string path;                     ///< path as in `polynya run --set`: "ice.thickness_m", "ships[0].mass_kg"
  std::string unit;                     ///< unit of the key: "m", "°"; empty: none
  std::string meaning;                  ///< description of the key for people, without its unit
  Range range;                          ///< allowed values, in the unit of the key
  FieldKind kind = FieldKind::kNumber;  ///< kNumber, kInteger or kBoolean; a number in place of a law is kNumber
  double value = 0;                     ///< value in the scene, in the unit of the key; a boolean is 0 or 1
};

/// Returns the numbers and truth values of the resolved scene, with all defaults, that determine a run, in the order of
/// the description: seed, time step, water, wind, ice, contacts, fracture, ships, structures, and random fields and
/// channels of floes. Of each list only the first 100 entries are searched, because a scene may list a million floes
/// one by one. Left out are the end of the run, walls, what is recorded, the origin, keys without a value in the
/// resolved scene, words, vectors, lists, outlines and laws from which values are drawn. A co-simulation unit has one
/// parameter for each, so a key that is left out cannot be set there.
std::vector<SceneParameter> scene_parameters(const LoadedScene& scene);

}  // namespace polynya::io
