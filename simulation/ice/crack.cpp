#include "simulation/ice/crack.hpp"

#include <algorithm>

#include "fracture/characteristic_length.hpp"

namespace polynya::simulation {
namespace {

/// Place along a crack, as a fraction of its length, at which its width is measured [-]. The force that is needed to
/// extend a crack is largest when 0.05 to 0.175 of it have run, for a square plate at 0.15; beyond that place the crack
/// runs on. Another value would measure the width where it does not decide.
constexpr double kPeak = 0.15;

}  // namespace

geometry::CrackPath crack_through(const dynamics::Bodies& bodies, BodyIndex floe, geometry::Point point,
                                  geometry::Vector direction, geometry::CrackReach reach) {
  const geometry::Pose water_from_floe = dynamics::water_from_body(bodies, floe);
  return geometry::crack_path(*bodies.boundary[floe], inverse_transform(water_from_floe, point),
                              rotate_back(water_from_floe.rotation, direction), kCrackMargin, reach);
}

void measure_crack(const dynamics::Bodies& bodies, BodyIndex floe, const geometry::CrackPath& path,
                   fracture::FailureCriteria& criteria) {
  criteria.crack_length = path.length_in_ice;
  criteria.crack_width = geometry::crack_width(*bodies.boundary[floe], path, kPeak);
}

geometry::CrackSides measure_sides(const Setup& setup, const Population& population, BodyIndex floe,
                                   const geometry::CrackPath& path, fracture::FailureCriteria& criteria) {
  const geometry::CrackSides sides = sides_of_crack(*population.bodies.boundary[floe], path);
  const double l = fracture::characteristic_length(ice_of_body(setup, population, floe), setup.scene.water.water);
  criteria.crack_width = std::max(criteria.crack_width, mean_width_beside(path, sides));
  criteria.leaves_sliver =
      fracture::leaves_sliver(setup.scene.fracture.least_piece, l, path.length_in_ice, sides.left, sides.right);
  return sides;
}

double mean_width_beside(const geometry::CrackPath& path, const geometry::CrackSides& sides) {
  return 2 * std::min(sides.left, sides.right) / path.length_in_ice;
}

void measure_crack_and_sides(const Setup& setup, const Population& population, BodyIndex floe,
                             const geometry::CrackPath& path, fracture::FailureCriteria& criteria) {
  measure_crack(population.bodies, floe, path, criteria);
  measure_sides(setup, population, floe, path, criteria);
}

}  // namespace polynya::simulation
