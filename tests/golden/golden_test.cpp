// The state at the end of a short run of every scene, by its hash. After a change that is meant to change results:
//   tests/golden/renew
// and the commit tells why. The hashes are those of any build and any number of threads (docs/reliability.md).
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
  auto loaded = io::read_scene_file(scene);
  EXPECT_TRUE(loaded.has_value()) << scene;
  if (steps == Steps::kOneForAll) loaded->scene.time.levels = 0;
  simulation::Simulation simulation(std::move(loaded->scene));
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

TEST(Golden, EverySceneEndsInItsState) {
  const auto goldens = read_goldens();
  const bool renews = std::getenv("POLYNYA_RENEW_GOLDENS") != nullptr;
  std::ostringstream renewed;
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
    const auto compare = [&](const std::string& of, const Golden& now) {
      ++used;
      std::cout << of << ' ' << now.until << ' ' << now.hash << ' ' << now.fractures << std::endl;
      if (renews) return;
      const auto golden = goldens.find(of);
      ASSERT_NE(golden, goldens.end()) << of;
      EXPECT_EQ(now.hash, golden->second.hash) << of;
      EXPECT_EQ(now.fractures, golden->second.fractures) << of;
    };
    const Golden now = run(entry.path(), until->second.until, Steps::kOfNeed);
    compare(now.has_parts ? name + "/parts" : name, now);
    if (now.has_parts) compare(name, run(entry.path(), until->second.until, Steps::kOneForAll));
  }
  if (renews) return;
  EXPECT_EQ(used, goldens.size()) << "a golden without its scene";
}

// ---- no crack runs under more than it takes: the force is stopped at F_max within the step (docs/theory/splitting.md)

const std::filesystem::path kScenes = std::filesystem::path(POLYNYA_SOURCE_DIR) / "tests/golden/splits";

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
    auto loaded = io::read_scene_file(entry.path());
    ASSERT_TRUE(loaded.has_value()) << entry.path();
    simulation::Simulation simulation(std::move(loaded->scene));
    const Shares shares = shares_of(simulation);
    std::cout << entry.path().stem().string() << ": " << shares.splits << " splits, F/F_max " << shares.least << " to "
              << shares.most << ", " << simulation.counts().unresolved_splits << " unresolved\n";
    EXPECT_FALSE(simulation.numerical_failure().has_value());
    if (shares.splits == 0) continue;
    splits += shares.splits;
    EXPECT_GE(shares.least, 1) << entry.path();
    EXPECT_LE(shares.most, 1.05) << entry.path();
    EXPECT_LE(10 * simulation.counts().unresolved_splits, shares.splits) << entry.path();
    const simulation::Audit audit = simulation.audit();
    EXPECT_TRUE(audit.is_closed()) << entry.path();
  }
  EXPECT_GT(splits, 20);
}

/// Each step that is solved again is so on any number of threads.
TEST(Splits, AreTheSameOnAnyNumberOfThreads) {
  std::uint64_t hashes[2];
  for (const int threads : {1, 2}) {
    auto loaded = io::read_scene_file(kScenes / "besiege-pressure.json");
    ASSERT_TRUE(loaded.has_value());
    loaded->scene.time.until = 7;
    simulation::Simulation simulation(std::move(loaded->scene));
    simulation.set_threads(threads);
    EXPECT_GT(shares_of(simulation).splits, 2);
    hashes[threads - 1] = simulation.state_hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace polynya::tests
