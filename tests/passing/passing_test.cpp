// No body passes through another: at the end of a run no two share more ice than what was crushed there, and
// 1 % of the smaller floe's area.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "geometry/cut/overlap.hpp"
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
using simulation::Scene;
using simulation::Simulation;
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

/// A scene in which bodies run into each other: one to three ships and structures, and floes of hard shapes
/// (planks, arches, hooks, stars, rings) at rest or moving at up to 1 m/s. The laws take turns.
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

const std::filesystem::path kSource = POLYNYA_SOURCE_DIR;

struct Placed {
  simulation::ContactState::Body body;
  const Polygon* polygon;
  Pose world_from_body;
  geometry::Box box;
  double area;
  geometry::Vector velocity;
};

struct Passed {
  double parted = 0;         ///< largest share of the smaller of two bodies that overlap and do not press
  std::string parted_where;  ///< these two
  double uncrushed = 0;      ///< largest share of a floe that overlaps and was not crushed
  double covered = 0;        ///< largest share of a floe that is in a hull
  std::string where;
};

bool is_new(const Simulation& run, simulation::ContactState::Body body) {
  return body.ship < 0 && run.time() > 0 && run.world().population.floes[body.floe].born == run.time();
}

std::string name_of(const Simulation& run, simulation::ContactState::Body body) {
  return body.ship >= 0 ? hull_of(run.scene(), static_cast<std::size_t>(body.ship)).name
                        : "floe " + std::to_string(body.floe);
}

Passed measure(const Simulation& run) {
  std::vector<Polygon> hulls;
  hulls.reserve(hull_count(run.scene()));
  std::vector<Placed> bodies;
  const auto ships = run.ship_states();
  for (std::size_t i = 0; i < ships.size(); ++i) {
    hulls.push_back({hull_of(run.scene(), i).hull.waterline, {}});
    bodies.push_back({{static_cast<int>(i), simulation::kNoFloe},
                      &hulls.back(),
                      ships[i].world_from_ship,
                      {},
                      1e30,
                      ships[i].velocity});
  }
  const auto floes = run.floe_states();
  for (const simulation::FloeState& floe : floes)
    bodies.push_back({{-1, floe.floe}, floe.polygon_in_body, floe.world_from_body, {}, floe.area, floe.velocity});
  for (Placed& body : bodies)
    body.box = grown(bounding_box(transform(body.world_from_body, body.polygon->outer)), 1e-6);
  std::map<std::pair<std::int64_t, std::int64_t>, double> crushed;
  const auto key = [&](simulation::ContactState::Body body) {
    return body.ship >= 0 ? -1 - std::int64_t{body.ship} : body.floe;
  };
  for (const simulation::CrushedOverlap& overlap : run.crushed_overlaps())
    crushed[{key(overlap.on), key(overlap.by)}] = overlap.area + overlap.tilted;
  std::set<std::pair<std::int64_t, std::int64_t>> pressing;
  for (const simulation::ContactState& contact : run.contact_states())
    if (squared_length(contact.force) > 0) pressing.insert({key(contact.on), key(contact.by)});
  Passed passed;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t k = std::max(i + 1, ships.size()); k < bodies.size(); ++k) {
      const Placed& a = bodies[i];
      const Placed& b = bodies[k];
      if (!overlaps(a.box, b.box)) continue;
      const auto shared = shared_area(*a.polygon, a.world_from_body, *b.polygon, b.world_from_body);
      EXPECT_TRUE(shared.has_value());
      if (!shared || *shared == 0) continue;
      const double smaller = std::min(a.area, b.area);
      // The contacts of a floe that was cut from another in this step are found in the next.
      const bool is_known = !is_new(run, a.body) && !is_new(run, b.body);
      if (is_known && !pressing.contains({key(a.body), key(b.body)}) && *shared > passed.parted * smaller) {
        passed.parted = *shared / smaller;
        passed.parted_where = name_of(run, a.body) + " and " + name_of(run, b.body) + " share " +
                              std::to_string(*shared) + " m2 of " + std::to_string(smaller);
      }
      // A contact is found, and what has pressed is known, a step late.
      const double step = run.scene().time.step * length(a.velocity - b.velocity);
      const geometry::Vector diagonal =
          std::min(a.area, b.area) == a.area ? a.box.high - a.box.low : b.box.high - b.box.low;
      if (a.body.ship >= 0) passed.covered = std::max(passed.covered, (*shared - step * length(diagonal)) / smaller);
      const double uncrushed = (*shared - crushed[{key(a.body), key(b.body)}] - step * length(diagonal)) / smaller;
      if (uncrushed <= passed.uncrushed) continue;
      passed.uncrushed = uncrushed;
      passed.where = name_of(run, a.body) + " and " + name_of(run, b.body) + " share " + std::to_string(*shared) +
                     " m2 of " + std::to_string(smaller) + ", " + std::to_string(crushed[{key(a.body), key(b.body)}]) +
                     " crushed";
    }
  }
  return passed;
}

Simulation run(simulation::Scene scene, double until) {
  Simulation simulation(std::move(scene));
  while (simulation.time() < until - 1e-9 && !simulation.numerical_failure()) {
    simulation.step();
    simulation.journal().clear();
  }
  EXPECT_FALSE(simulation.numerical_failure().has_value());
  EXPECT_TRUE(simulation.audit().is_closed());
  return simulation;
}

simulation::Scene read(const std::filesystem::path& file) {
  auto loaded = io::read_scene_file(file);
  EXPECT_TRUE(loaded.has_value()) << file;
  return loaded ? loaded->scene : simulation::Scene{};
}

int scene_count() {
  const char* given = std::getenv("POLYNYA_PASSING_SCENES");
  return given ? std::atoi(given) : 20;
}

TEST(Passing, NoRandomSceneEndsWithMoreOverlapThanWasCrushed) {
  const int scenes = scene_count();
  std::int64_t contacts = 0;
  for (int seed = 0; seed < scenes; ++seed) {
    const Simulation simulation = run(random_scene(static_cast<std::uint64_t>(seed)), 8);
    const Passed passed = measure(simulation);
    EXPECT_LE(passed.uncrushed, 0.01) << "seed " << seed << ": " << passed.where;
    contacts += simulation.counts().crush_contacts;
  }
  EXPECT_GT(contacts, 0);
}

TEST(Passing, NoRandomSceneKeepsWhatItCrushed) {
  const int scenes = scene_count();
  std::int64_t ground = 0;
  for (int seed = 0; seed < scenes; ++seed) {
    Scene scene = random_scene(static_cast<std::uint64_t>(seed));
    scene.contact.law = simulation::ContactLaw::kCrush;
    scene.record.contacts = simulation::RecordedContacts::kAll;
    const Simulation simulation = run(std::move(scene), 8);
    const Passed passed = measure(simulation);
    EXPECT_LE(passed.parted, 0.01) << "seed " << seed << ": " << passed.parted_where;
    EXPECT_LE(passed.covered, 0.5) << "seed " << seed;
    ground += simulation.counts().ground;
  }
  EXPECT_GT(ground, 0);
}

/// Floes of 15 m that a wall presses onto three others.
TEST(Passing, NoPackBetweenFourWallsDoes) {
  simulation::Scene scene = read(kSource / "tests/passing/pack_between_walls.json");
  const double until = scene_count() > 20 ? 600 : 20;
  const Simulation simulation = run(std::move(scene), until);
  EXPECT_LE(measure(simulation).parted, 0.01);
  EXPECT_GT(simulation.counts().ground, 0);
}

/// The first seconds of each, or as long as the long trial lasts.
TEST(Passing, NoShippedSceneDoes) {
  const bool is_long = scene_count() > 20;
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kSource / "scenes")) {
    if (entry.path().extension() != ".json" || entry.path().stem().string().starts_with("field-")) continue;
    simulation::Scene scene = read(entry.path());
    const double until = std::min(scene.time.until, is_long ? 400.0 : 2.0);
    const Simulation simulation = run(std::move(scene), until);
    const Passed passed = measure(simulation);
    EXPECT_LE(passed.uncrushed, 0.01) << entry.path() << ": " << passed.where;
    ++scenes;
  }
  EXPECT_GE(scenes, 9);
}

TEST(Passing, TheDirectedTrialsDoNot) {
  for (const char* name :
       {"pierced_floe_4x3", "pierced_floe_backed", "pierced_floe_free", "pierced_in_random_scene_54"}) {
    for (const auto law : {simulation::ContactLaw::kCrush, simulation::ContactLaw::kImpulse}) {
      simulation::Scene scene = read(kSource / "tests/passing" / (std::string(name) + ".json"));
      scene.contact.law = law;
      const double until = scene.time.until;
      const Simulation simulation = run(std::move(scene), until);
      const Passed passed = measure(simulation);
      EXPECT_LE(passed.uncrushed, 0.01) << name << ": " << passed.where;
    }
  }
}

}  // namespace
}  // namespace polynya::tests
