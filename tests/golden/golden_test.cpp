// The state at the end of a short run of every scene, by its hash. After a change that is meant to change results:
//   tests/golden/renew
// and the commit states why. The hashes are those of any build and any number of threads (docs/reliability.md).
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "io/scene/scene_reader.hpp"
#include "simulation/simulation.hpp"
#include "simulation/world/world.hpp"

namespace polynya::tests {
namespace {

const std::filesystem::path kSource = POLYNYA_SOURCE_DIR;
const std::filesystem::path kGoldens = kSource / "tests/golden/goldens.txt";

simulation::Scene scene_of(const std::filesystem::path& file) {
  auto loaded = io::read_scene_file(file);
  EXPECT_TRUE(loaded.has_value()) << file;
  return loaded ? std::move(loaded->scene) : simulation::Scene();
}

/// "scene until_s hash fractures", a line each; a scene that takes ticks in parts has another line, "scene/parts".
struct Golden {
  double until = 0;  ///< [s]
  std::string hash;
  std::int64_t fractures = 0;
  bool has_parts = false;  ///< of ticks; not in the file
};

std::map<std::string, Golden> read_goldens() {
  std::map<std::string, Golden> goldens;
  std::ifstream file(kGoldens);
  std::string scene;
  Golden golden;
  while (file >> scene >> golden.until >> golden.hash >> golden.fractures) goldens[scene] = golden;
  return goldens;
}

/// No crack runs under more than it takes (splits_test.cpp): by the default laws.
void expect_met_in_time(simulation::Simulation& simulation, const std::filesystem::path& scene) {
  if (!is_crush_law(simulation.world().setup)) return;
  if (simulation.scene().fracture.splitting != fracture::SplittingModel::kLefm) return;
  for (const simulation::Event& event : simulation.journal().events) {
    if (!event.is<simulation::Split>()) continue;
    EXPECT_LE(event.criteria().opening_force, 1.05 * event.criteria().opening_capacity)
        << scene << " at " << event.time << " s";
  }
}

/// How long steps may be (simulation/world/levels.hpp).
enum class Steps { kOneForAll, kOfNeed };

Golden run(const std::filesystem::path& scene, double until, Steps steps) {
  simulation::Scene loaded = scene_of(scene);
  if (steps == Steps::kOneForAll) loaded.time.levels = 0;
  simulation::Simulation simulation(std::move(loaded));
  if (const char* threads = std::getenv("POLYNYA_GOLDEN_THREADS")) simulation.set_threads(std::atoi(threads));
  while (simulation.time() < until - 1e-9 && !simulation.numerical_failure()) {
    simulation.step();
    expect_met_in_time(simulation, scene);
    simulation.journal().clear();
  }
  EXPECT_FALSE(simulation.numerical_failure().has_value());
  std::ostringstream hash;
  hash << std::hex << std::setfill('0') << std::setw(16) << simulation.state_hash();
  const simulation::Counts counts = simulation.counts();
  return {until, hash.str(), counts.bends + counts.splits,
          counts.steps_at_level[simulation::kMostLevels] < counts.steps};
}

/// Of steps for all only scenes that take ticks in parts have a golden of their own.
void expect_goldens(Steps steps) {
  const auto goldens = read_goldens();
  const bool renews = std::getenv("POLYNYA_RENEW_GOLDENS") != nullptr;
  std::size_t used = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kSource / "scenes")) {
    const bool is_study = entry.path().parent_path().filename() == "studies";  // and what only studies run
    if (entry.path().extension() != ".json" || is_study) continue;
    const std::string name = entry.path().stem().string();
    const auto until = goldens.find(name);
    if (until == goldens.end()) {
      ADD_FAILURE() << name << " has no golden: add \"" << name << " <until_s> - 0\" to " << kGoldens
                    << " and run tests/golden/renew";
      continue;
    }
    const bool had_parts = goldens.contains(name + "/parts");
    if (steps == Steps::kOneForAll && !had_parts && !renews) continue;
    const Golden now = run(entry.path(), until->second.until, steps);
    const std::string of = now.has_parts ? name + "/parts" : name;
    std::cout << of << ' ' << now.until << ' ' << now.hash << ' ' << now.fractures << std::endl;
    if (renews) continue;
    ++used;
    const auto golden = goldens.find(of);
    ASSERT_NE(golden, goldens.end()) << of;
    EXPECT_EQ(now.hash, golden->second.hash) << of;
    EXPECT_EQ(now.fractures, golden->second.fractures) << of;
    EXPECT_EQ(now.has_parts, had_parts && steps == Steps::kOfNeed) << of;
  }
  const auto parts = std::ranges::count_if(goldens, [](const auto& one) { return one.first.ends_with("/parts"); });
  const std::size_t wanted = steps == Steps::kOneForAll ? parts : goldens.size() - parts;
  if (renews) return;
  EXPECT_EQ(used, wanted) << "a golden without its scene";
}

// Two cases, for two processors.
TEST(Golden, EverySceneEndsInItsStateByStepsOfNeed) {
  expect_goldens(Steps::kOfNeed);
}
TEST(Golden, EverySceneEndsInItsStateByStepsForAll) {
  expect_goldens(Steps::kOneForAll);
}

// ---- no crack runs under more than it takes: the force is stopped at F_max within the step (docs/theory/splitting.md)

const std::filesystem::path kScenes = kSource / "tests/golden/splits";

/// F/F_max of the splits of a run.
struct Shares {
  std::int64_t splits = 0;
  double least = 2;
  double most = 0;
};

Shares shares_of(simulation::Simulation& simulation) {
  Shares shares;
  while (simulation.time() < simulation.scene().time.until - 1e-9 && !simulation.numerical_failure()) {
    simulation.step();
    for (const simulation::Event& event : simulation.journal().events) {
      if (!event.is<simulation::Split>()) continue;
      const double share = event.criteria().split_share();
      ++shares.splits;
      shares.least = std::min(shares.least, share);
      shares.most = std::max(shares.most, share);
    }
    simulation.journal().clear();
  }
  return shares;
}

TEST(Splits, RunAtTheForceThatTheyTakeInEveryStep) {
  std::int64_t splits = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kScenes)) {
    simulation::Simulation simulation(scene_of(entry.path()));
    const Shares shares = shares_of(simulation);
    std::cout << entry.path().stem().string() << ": " << shares.splits << " splits, F/F_max " << shares.least << " to "
              << shares.most << ", " << simulation.counts().unresolved_splits << " unresolved\n";
    EXPECT_FALSE(simulation.numerical_failure().has_value());
    if (shares.splits == 0) continue;
    splits += shares.splits;
    EXPECT_GE(shares.least, 1) << entry.path();
    EXPECT_LE(shares.most, 1.05) << entry.path();
    EXPECT_LE(10 * simulation.counts().unresolved_splits, shares.splits) << entry.path();
    EXPECT_TRUE(simulation.audit().is_closed()) << entry.path();
  }
  EXPECT_GT(splits, 20);
}

/// Each step that is solved again is so on any number of threads.
TEST(Splits, AreTheSameOnAnyNumberOfThreads) {
  std::uint64_t hashes[2];
  for (const int threads : {1, 2}) {
    simulation::Scene scene = scene_of(kScenes / "besiege-pressure.json");
    scene.time.until = 7;
    simulation::Simulation simulation(std::move(scene));
    simulation.set_threads(threads);
    EXPECT_GT(shares_of(simulation).splits, 2);
    hashes[threads - 1] = simulation.state_hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace polynya::tests
