#pragma once

#include <cstdint>
#include <initializer_list>

#include "fracture/scatter.hpp"
#include "geometry/shape/point.hpp"

namespace polynya::simulation {

/// Returns a random number, evenly distributed in (0, 1), that depends only on the seed and the keys. It is the same in
/// whatever order numbers are drawn, with any number of threads, and after a resume.
double drawn_share(std::uint64_t seed, std::initializer_list<std::uint64_t> keys);

/// Returns a random property of a floe of the scene, distributed by `law`. `floe` is the floe's index in the scene, and
/// `property` a number that is different for each property.
double drawn_property(const fracture::ScatterLaw& law, std::uint64_t seed, std::size_t floe, std::size_t property);

/// Returns the factor on the flexural strength of a floe at a contact [-]: log-normal with mean 1 and standard
/// deviation `spread`. It depends on the point of the floe that the hull touched first. Floes keep the scene's
/// coordinates in their body frames, so the point identifies a place in the ice, and a contact has the same strength
/// from its first touch until its ice breaks, even if another contact breaks the floe meanwhile.
double strength_factor(std::uint64_t seed, geometry::Point first_touch_in_body, double spread);

}  // namespace polynya::simulation
