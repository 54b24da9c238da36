#include "tests/passing/random_scene.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cut/overlap.hpp"
#include "tests/dynamics/scenery.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::tests {
namespace {

using geometry::Polygon;
using geometry::Pose;
using geometry::Rotation;
using scenery::Random;
using simulation::Scene;
using simulation::scenes::Build;

constexpr double kRegion = 110;  ///< bodies are within half of it of the origin [m]

Polygon arch(double width, double height, double thickness) {
  const double x = 0.5 * width;
  return {{{-x, 0},
           {x, 0},
           {x, height},
           {x - thickness, height},
           {x - thickness, thickness},
           {-x + thickness, thickness},
           {-x + thickness, height},
           {-x, height}},
          {}};
}

Polygon hook(double width, double height, double thickness) {
  return {{{0, 0}, {width, 0}, {width, thickness}, {thickness, thickness}, {thickness, height}, {0, height}}, {}};
}

Polygon random_floe(Random& random) {
  const double size = random.between(3, 22);
  switch (random.below(6)) {
    case 0:
      return scenery::rectangle(size, std::max(0.3, size * random.between(0.03, 0.2)));
    case 1:
      return arch(size, size * random.between(0.6, 1.2), size * random.between(0.08, 0.3));
    case 2:
      return hook(size, size * random.between(0.5, 1.5), size * random.between(0.08, 0.3));
    case 3:
      return scenery::random_star(random, 5 + random.below(8), 0.15 * size, 0.6 * size);
    case 4: {
      Polygon ring = scenery::rectangle(size, size);
      const double hole = size * random.between(0.1, 0.4);
      ring.holes.push_back({{-hole, -hole}, {-hole, hole}, {hole, hole}, {hole, -hole}});
      return ring;
    }
    default:
      return scenery::random_star(random, 4 + random.below(5), 0.5 * size, 0.5 * size);
  }
}

bool is_free(const std::vector<Polygon>& placed, const Polygon& polygon) {
  const auto shared = [&](const Polygon& other) {
    const auto area = geometry::shared_area(other, {}, polygon, {});
    return !area || *area > 0;
  };
  return std::ranges::none_of(placed, [&](const Polygon& other) {
    return overlaps(bounding_box(other.outer), bounding_box(polygon.outer)) && shared(other);
  });
}

/// Gives the scene a ship or a structure where there is room.
bool add_random_ship(Random& random, int number, std::vector<Polygon>& placed, Build& scene) {
  simulation::Ship ship;
  ship.name = "ship-" + std::to_string(number);
  ship.mass = random.between(3e5, 8e6);
  ship.heading = random.angle();
  ship.position_in_world = {random.between(-0.4, 0.4) * kRegion, random.between(-0.4, 0.4) * kRegion};
  const double length = random.between(25, 70);
  ship.moment_of_inertia = ship.mass * length * length / 16;
  ship.hull.waterline =
      simulation::wedge_bow_waterline(length, length * random.between(0.15, 0.25), random.between(0.25, 0.8));
  ship.hull.stem_angle = random.between(0.4, 1.2);
  ship.speed = random.between(0.5, 5);
  const int kind = random.below(3);
  ship.propulsion = simulation::ConstantSpeed{ship.speed};
  if (kind == 0) ship.propulsion = simulation::ConstantThrust{random.between(5e4, 2e6)};
  if (kind == 1) ship.hull.waterline = simulation::cylinder_waterline(random.between(1, 8));
  const Polygon hull =
      transform(Pose{ship.position_in_world, Rotation::by(ship.heading)}, Polygon{ship.hull.waterline, {}});
  if (!is_free(placed, hull)) return false;
  placed.push_back(hull);
  if (kind == 1)
    scene.structure(ship.hull.waterline, ship.position_in_world);
  else
    scene.ship(ship);
  return true;
}

}  // namespace

Scene random_scene(std::uint64_t seed) {
  Random random(seed);
  Build scene;
  scene.name = "random " + std::to_string(seed);
  scene.time.step = random.below(2) == 0 ? 0.005 : 0.02;
  scene.time.until = 8;
  scene.contact.law = seed % 2 == 0 ? simulation::ContactLaw::kCrush : simulation::ContactLaw::kImpulse;
  scene.fracture.bending = simulation::BendingModelKind::kNevel;
  scene.fracture.splitting = fracture::SplittingModel::kLefm;
  scene.fracture.cusp_fate = random.below(2) == 0 ? simulation::CuspFate::kFloat : simulation::CuspFate::kSubmerge;
  scene.ice.thickness = random.between(0.2, 1.2);
  scene.ice.friction = random.below(3) == 0 ? 0 : 0.1;
  std::vector<Polygon> placed;
  const int ships = 1 + random.below(3);
  for (int tries = 0, added = 0; tries < 30 && added < ships; ++tries)
    added += add_random_ship(random, tries, placed, scene) ? 1 : 0;
  const int tries = 30 + random.below(120);
  for (int i = 0; i < tries; ++i) {
    const Pose pose{{random.between(-0.5, 0.5) * kRegion, random.between(-0.5, 0.5) * kRegion},
                    Rotation::by(random.angle())};
    const Polygon floe = transform(pose, random_floe(random));
    if (!is_free(placed, floe)) continue;
    placed.push_back(floe);
    geometry::Vector velocity;
    if (random.below(3) == 0) velocity = {random.between(-1, 1), random.between(-1, 1)};
    scene.floe(floe, velocity, random.below(6) == 0 ? random.between(-0.2, 0.2) : 0);
  }
  return scene;
}

}  // namespace polynya::tests
