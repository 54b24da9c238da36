// The state at the end of a short run of every scene, by its hash. After a change that is meant to change results, run
//   tests/golden/renew
// and state the reason in the commit. The hashes hold for any build and any number of threads (docs/reliability.md).
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "io/scene/scene_file.hpp"
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

/// "scene until_s hash fractures", a line each.
struct Golden {
  double until = 0;  ///< [s]
  std::string hash;
  std::int64_t fractures = 0;
};

std::map<std::string, Golden> read_goldens() {
  std::map<std::string, Golden> goldens;
  std::ifstream file(kGoldens);
  std::string scene;
  Golden golden;
  while (file >> scene >> golden.until >> golden.hash >> golden.fractures) goldens[scene] = golden;
  return goldens;
}

/// No crack runs at a force larger than its criterion with the default laws.
void expect_met_in_time(simulation::Simulation& simulation, const std::filesystem::path& scene) {
  if (simulation.scene().contact.law != simulation::ContactLaw::kCrush) return;
  if (simulation.scene().fracture.splitting != fracture::SplittingModel::kLefm) return;
  for (const simulation::Event& event : simulation.journal().events) {
    if (!event.is<simulation::Split>()) continue;
    EXPECT_LE(event.criteria().opening_force, 1.05 * event.criteria().opening_capacity)
        << scene << " at " << event.time << " s";
  }
}

Golden run(const std::filesystem::path& scene, double until) {
  simulation::Simulation simulation(scene_of(scene));
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
  return {until, hash.str(), counts.bends + counts.splits};
}

/// The scenes whose names begin so, or the others.
void expect_goldens(std::string_view prefix, bool has_prefix) {
  const auto goldens = read_goldens();
  const bool renews = std::getenv("POLYNYA_RENEW_GOLDENS") != nullptr;
  std::ptrdiff_t used = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kSource / "scenes")) {
    const bool is_study = entry.path().parent_path().filename() == "studies";  // and what only studies run
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".json" || is_study || name.starts_with(prefix) != has_prefix) continue;
    const auto golden = goldens.find(name);
    if (golden == goldens.end()) {
      ADD_FAILURE() << name << " has no golden: add \"" << name << " <until_s> - 0\" to " << kGoldens
                    << " and run tests/golden/renew";
      continue;
    }
    const Golden now = run(entry.path(), golden->second.until);
    std::cout << name << ' ' << now.until << ' ' << now.hash << ' ' << now.fractures << std::endl;
    if (renews) continue;
    ++used;
    EXPECT_EQ(now.hash, golden->second.hash) << name;
    EXPECT_EQ(now.fractures, golden->second.fractures) << name;
  }
  const auto wanted =
      std::ranges::count_if(goldens, [&](const auto& one) { return one.first.starts_with(prefix) == has_prefix; });
  if (!renews) {
    EXPECT_EQ(used, wanted) << "a golden without its scene";
  }
}

// Two cases, for two processors: the replicas of the paper, and all other scenes.
TEST(Golden, ReplicasOfThePaperEndInTheirStates) {
  expect_goldens("sawamura2017", true);
}
TEST(Golden, OtherScenesEndInTheirStates) {
  expect_goldens("sawamura2017", false);
}

}  // namespace
}  // namespace polynya::tests
