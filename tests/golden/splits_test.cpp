// No crack runs under more than it takes: the force is stopped at F_max within the step (docs/theory/splitting.md).
// Scenes whose cracks ran at up to 134 times that before; tests/golden/golden_test.cpp asks the same of all scenes that
// are shipped.

#include <filesystem>
#include <iostream>

#include <gtest/gtest.h>

#include "io/scene/scene_reader.hpp"
#include "simulation/simulation.hpp"

namespace polynya::tests {
namespace {

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
    loaded->scene.time.until = 5.5;
    simulation::Simulation simulation(std::move(loaded->scene));
    simulation.set_threads(threads);
    EXPECT_GT(shares_of(simulation).splits, 2);
    hashes[threads - 1] = simulation.state_hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace polynya::tests
