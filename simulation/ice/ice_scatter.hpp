#pragma once

#include <cstdint>
#include <initializer_list>

#include "fracture/scatter.hpp"
#include "geometry/shape/point.hpp"

namespace polynya::simulation {

/// A number of the seed and its keys alone, evenly in (0, 1): the same in whatever order numbers are drawn,
/// on any number of threads and after a resume.
double drawn_share(std::uint64_t seed, std::initializer_list<std::uint64_t> keys);

/// A property of a floe of the scene, by the floe's index there and the property's own number.
double drawn_property(const fracture::ScatterLaw& law, std::uint64_t seed, std::size_t floe, std::size_t property);

/// What the flexural strength of a floe is multiplied by where a hull first touched it, log-normal with mean
/// 1 and that standard deviation. Floes keep the scene's coordinates in their body frames, so that the point
/// names a place in the ice: a contact has one strength from its first touch to its break, also where another
/// contact breaks its floe meanwhile.
double strength_factor(std::uint64_t seed, geometry::Point first_touch_in_body, double spread);

}  // namespace polynya::simulation
