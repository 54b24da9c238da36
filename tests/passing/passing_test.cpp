// No body passes through another: at the end of a run no two share more ice than what was crushed there, and
// 1 % of the smaller floe's area.
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "geometry/cut/overlap.hpp"
#include "io/scene/scene_reader.hpp"
#include "simulation/simulation.hpp"
#include "simulation/world/world.hpp"
#include "tests/passing/random_scene.hpp"

namespace polynya::tests {
namespace {

using geometry::Polygon;
using geometry::Pose;
using simulation::Simulation;

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
    simulation::Scene scene = random_scene(static_cast<std::uint64_t>(seed));
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
