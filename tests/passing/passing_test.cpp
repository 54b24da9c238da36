// No body passes through another. At the end of a run the overlap of two bodies is at most the ice that was crushed
// there plus 1 % of the area of the smaller floe.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "geometry/cut/overlap.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/scene_reader.hpp"
#include "simulation/simulation.hpp"
#include "simulation/world/world.hpp"
#include "tests/dynamics/scenery.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::tests {
namespace {

using geometry::Polygon;
using geometry::Pose;
using geometry::Rotation;
using scenery::Random;
using simulation::ContactLaw;
using Body = simulation::ContactState::Body;
using simulation::Scene;
using simulation::Simulation;
using simulation::scenes::Build;

constexpr double kRegion = 110;  ///< bodies are within half of it of the origin [m]

/// Returns an arch of thickness t.
Polygon arch(double width, double height, double t) {
  const double x = 0.5 * width;
  return {{{-x, 0}, {x, 0}, {x, height}, {x - t, height}, {x - t, t}, {t - x, t}, {t - x, height}, {-x, height}}, {}};
}

Polygon hook(double width, double height, double t) {
  return {{{0, 0}, {width, 0}, {width, t}, {t, t}, {t, height}, {0, height}}, {}};
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

/// A scene in which bodies run into each other: one to three ships and structures, and floes of hard shapes
/// (planks, arches, hooks, stars, rings) at rest or moving at up to 1 m/s.
Scene random_scene(std::uint64_t seed) {
  Random random(seed);
  Build scene;
  scene.name = "random " + std::to_string(seed);
  scene.time.step = random.below(2) == 0 ? 0.005 : 0.02;
  scene.time.until = 8;
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

const std::filesystem::path kSource = POLYNYA_SOURCE_DIR;

struct Placed {
  Body body;
  Polygon polygon;
  Pose world_from_body;
  double area;
  geometry::Vector velocity;
  geometry::Box box = grown(bounding_box(transform(world_from_body, polygon.outer)), 1e-6);
};

/// Hulls, then floes.
std::vector<Placed> bodies_of(const Simulation& run) {
  std::vector<Placed> bodies;
  for (const simulation::HullState& hull : run.ship_states()) {
    const auto i = static_cast<int>(bodies.size());
    bodies.push_back({{i}, {hull_of(run.scene(), i).hull.waterline, {}}, hull.world_from_ship, 1e30, hull.velocity});
  }
  for (const simulation::FloeState& floe : run.floe_states())
    bodies.push_back({{-1, floe.floe}, *floe.polygon_in_body, floe.world_from_body, floe.area, floe.velocity});
  return bodies;
}

auto pair_of(Body a, Body b) {
  return std::tuple(a.ship, a.floe, b.ship, b.floe);
}

/// The largest share of the smaller of two bodies, and which they are.
struct Share {
  void take(double found, const std::string& found_where) {
    if (found > share) *this = {found, found_where};
  }
  double share = 0;
  std::string where;
};

struct Passed {
  Share parted;     ///< pairs that overlap and do not press
  Share uncrushed;  ///< pairs that overlap without having been crushed
  Share covered;    ///< pairs of which one body is a hull
};

bool is_new(const Simulation& run, Body body) {
  return body.ship < 0 && run.time() > 0 && run.world().population.floes[body.floe].born == run.time();
}

std::string name_of(const Simulation& run, Body body) {
  return body.ship >= 0 ? hull_of(run.scene(), body.ship).name : "floe " + std::to_string(body.floe);
}

Passed measure(const Simulation& run) {
  std::map<decltype(pair_of({}, {})), double> crushed;
  for (const simulation::CrushedOverlap& overlap : run.crushed_overlaps())
    crushed[pair_of(overlap.on, overlap.by)] = overlap.area + overlap.tilted + overlap.unpaid;
  std::set<decltype(pair_of({}, {}))> pressing;
  for (const simulation::ContactState& contact : run.contact_states())
    if (squared_length(contact.force) > 0) pressing.insert(pair_of(contact.on, contact.by));
  Passed passed;
  const std::vector<Placed> bodies = bodies_of(run);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t k = i + 1; k < bodies.size(); ++k) {
      const Placed &a = bodies[i], &b = bodies[k];
      if (b.body.ship >= 0 || !overlaps(a.box, b.box)) continue;
      const double shared = shared_area(a.polygon, a.world_from_body, b.polygon, b.world_from_body).value();
      if (shared == 0) continue;
      const Placed& smaller = b.area < a.area ? b : a;
      const double was_crushed = crushed[pair_of(a.body, b.body)];
      const std::string where = name_of(run, a.body) + " and " + name_of(run, b.body) + " share " +
                                std::to_string(shared) + " m2 of " + std::to_string(smaller.area) + ", " +
                                std::to_string(was_crushed) + " crushed or in contact";
      // The contacts of a floe that was cut from another in this step are found in the next.
      if (!is_new(run, a.body) && !is_new(run, b.body) && !pressing.contains(pair_of(a.body, b.body)))
        passed.parted.take(shared / smaller.area, where);
      // A contact is found one step late, and so is the ice that it has crushed.
      const double late =
          run.scene().time.step * length(a.velocity - b.velocity) * length(smaller.box.high - smaller.box.low);
      if (a.body.ship >= 0) passed.covered.take((shared - late) / smaller.area, where);
      passed.uncrushed.take((shared - was_crushed - late) / smaller.area, where);
    }
  }
  return passed;
}

Simulation run(const Scene& scene, double until) {
  Simulation simulation = simulation::scenes::run(scene, until).simulation;
  EXPECT_FALSE(simulation.numerical_failure().has_value());
  EXPECT_TRUE(simulation.audit().is_closed());
  return simulation;
}

Scene read(const std::filesystem::path& file) {
  auto loaded = io::read_scene_file(file);
  EXPECT_TRUE(loaded.has_value()) << file;
  return loaded ? loaded->scene : Scene{};
}

int scene_count() {
  const char* given = std::getenv("POLYNYA_PASSING_SCENES");
  return given ? std::atoi(given) : 20;
}

/// No random scene with the crushing law ends with an overlap larger than the crushed ice.
TEST(Passing, NoRandomSceneEndsWithMoreOverlapThanWasCrushed) {
  std::int64_t ground = 0;
  for (int seed = 0; seed < scene_count(); ++seed) {
    for (const ContactLaw law : {ContactLaw::kCrush, ContactLaw::kImpulse}) {
      if (law == ContactLaw::kImpulse && seed % 2 == 0) continue;
      SCOPED_TRACE(testing::Message() << "seed " << seed << " by law " << static_cast<int>(law));
      Scene scene = random_scene(static_cast<std::uint64_t>(seed));
      scene.contact.law = law;
      scene.record.contacts = simulation::RecordedContacts::kAll;
      const Simulation simulation = run(scene, 8);
      const Passed passed = measure(simulation);
      EXPECT_GT(simulation.counts().crush_contacts, 0);
      EXPECT_LE(passed.uncrushed.share, 0.01) << passed.uncrushed.where;
      if (law == ContactLaw::kImpulse) continue;
      EXPECT_LE(passed.parted.share, 0.01) << passed.parted.where;
      EXPECT_LE(passed.covered.share, 0.5) << passed.covered.where;
      ground += simulation.counts().ground;
    }
  }
  EXPECT_GT(ground, 0);
}

/// Floes of 15 m that a wall presses onto three others.
TEST(Passing, NoPackBetweenFourWallsDoes) {
  const Scene scene = read(kSource / "tests/passing/pack_between_walls.json");
  const Simulation simulation = run(scene, scene_count() > 20 ? 600 : 20);
  EXPECT_LE(measure(simulation).parted.share, 0.01);
  EXPECT_GT(simulation.counts().ground, 0);
}

/// The first seconds of each, or as long as the long trial lasts.
TEST(Passing, NoShippedSceneDoes) {
  const bool is_long = scene_count() > 20;
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kSource / "scenes")) {
    if (entry.path().extension() != ".json" || entry.path().stem().string().starts_with("field-")) continue;
    const Scene scene = read(entry.path());
    const Passed passed = measure(run(scene, std::min(scene.time.until, is_long ? 400.0 : 2.0)));
    EXPECT_LE(passed.uncrushed.share, 0.01) << entry.path() << ": " << passed.uncrushed.where;
    ++scenes;
  }
  EXPECT_GE(scenes, 9);
}

TEST(Passing, TheDirectedTrialsDoNot) {
  for (const char* name :
       {"pierced_floe_4x3", "pierced_floe_backed", "pierced_floe_free", "pierced_in_random_scene_54"}) {
    for (const auto law : {ContactLaw::kCrush, ContactLaw::kImpulse}) {
      Scene scene = read(kSource / "tests/passing" / (std::string(name) + ".json"));
      scene.contact.law = law;
      const Passed passed = measure(run(scene, scene.time.until));
      EXPECT_LE(passed.uncrushed.share, 0.01) << name << ": " << passed.uncrushed.where;
    }
  }
}

}  // namespace
}  // namespace polynya::tests
