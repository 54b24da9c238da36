// The state at the end of a short run of every scene, by its hash. After a change that is meant to change
// results:
//   tests/golden/renew
// and the commit tells why. The hashes are those of any build and any number of threads
// (docs/reliability.md).

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
  if (!renews) EXPECT_EQ(used, goldens.size()) << "a golden without its scene";
}

}  // namespace
}  // namespace polynya::tests
