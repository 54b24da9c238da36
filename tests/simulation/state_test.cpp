// A run that is interrupted and resumed continues as if it had not been.

#include "simulation/state/state.hpp"

#include <bit>

#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation::scenes {
namespace {

/// Bends, splits, sleeping and waking floes, pinched small ones.
Scene broken_plate() {
  Scene scene = paper_scene();
  scene.time.step = 0.01;
  scene.fracture.radial_cracks = fracture::RadialCracks::kSplitWedge;
  scene.ships = {icebreaker({-0.5, 0}, ConstantThrust{5e5}, 2)};
  scene.floes = {floe(rectangle(0, -40, 60, 40)), floe(rectangle(60.5, -40, 140, 40))};
  for (int i = 0; i < 6; ++i)
    scene.floes.push_back(floe(rectangle(2 + 16 * i, 41, 12 + 16 * i, 51), {0, -0.2}));
  scene.floes.push_back(floe(rectangle(300, 0, 310, 10)));  // far from all others
  return scene;
}

void expect_same_bits(const Simulation& a, const Simulation& b) {
  EXPECT_EQ(a.state_hash(), b.state_hash()) << a.time();
  const Population& p = a.world().population;
  const Population& q = b.world().population;
  ASSERT_EQ(p.bodies.size(), q.bodies.size());
  EXPECT_EQ(p.awake, q.awake);
  for (BodyIndex i = 0; i < p.bodies.size(); ++i) {
    ASSERT_EQ(p.bodies.is_alive[i], q.bodies.is_alive[i]);
    if (!p.bodies.is_alive[i]) continue;
    EXPECT_EQ(p.bodies.position[i], q.bodies.position[i]) << i;
    EXPECT_EQ(p.bodies.velocity[i], q.bodies.velocity[i]) << i;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(p.bodies.mass[i]), std::bit_cast<std::uint64_t>(q.bodies.mass[i]))
        << i;
  }
}

TEST(State, AResumedRunContinuesBitByBitFromAnyStep) {
  const Scene scene = broken_plate();
  Simulation whole(scene);
  std::vector<Simulation> resumed;
  for (int step = 0; step < 2500; ++step) {
    if (step % 250 == 37) {
      auto again = Simulation::resumed(scene, whole.state());
      ASSERT_TRUE(again.has_value()) << again.error();
      resumed.push_back(std::move(*again));
      // Not the bytes: read back, bodies' boxes are new, so that more pairs may be near each other.
      ASSERT_EQ(resumed.back().state_hash(), whole.state_hash()) << "what is read back is what was written";
    }
    whole.step();
    whole.journal().clear();
    for (Simulation& one : resumed) {
      one.step();
      one.journal().clear();
      if (step % 50 == 0) expect_same_bits(whole, one);
    }
  }
  for (Simulation& one : resumed) {
    expect_same_bits(whole, one);
    EXPECT_EQ(one.counts().bends, whole.counts().bends);
    EXPECT_EQ(one.counts().crush_contacts, whole.counts().crush_contacts);
    EXPECT_EQ(one.area_ledger().imbalance, whole.area_ledger().imbalance);
  }
  EXPECT_GT(whole.counts().bends, 20) << "the trial should have broken something";
  EXPECT_GT(whole.counts().floes_final, static_cast<std::int64_t>(whole.world().population.awake.size()) - 1)
      << "and something should sleep";
}

TEST(State, TheHashDiffersBetweenStates) {
  Simulation a(broken_plate());
  Simulation b(broken_plate());
  EXPECT_EQ(a.state_hash(), b.state_hash());
  a.step();
  EXPECT_NE(a.state_hash(), b.state_hash());
  b.step();
  EXPECT_EQ(a.state_hash(), b.state_hash());
}

/// Every byte of a state is either refused when it is changed, or read as another state: never half believed.
TEST(State, DamageIsRefusedOrIsAnotherState) {
  const Scene scene = broken_plate();
  Simulation whole(scene);
  while (whole.counts().bends < 2) whole.step();
  whole.journal().clear();
  const std::string state = whole.state();
  for (std::size_t length = 0; length < state.size(); length += 1 + length / 50)
    EXPECT_FALSE(Simulation::resumed(scene, std::string_view(state).substr(0, length)).has_value()) << length;
  int refused = 0;
  for (std::size_t at = 0; at < state.size(); at += 13) {
    std::string damaged = state;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    const auto read = Simulation::resumed(scene, damaged);
    if (read)
      EXPECT_NE(read->state(), state) << at;
    else
      ++refused;
  }
  EXPECT_GT(refused, 20);
}

TEST(State, AStateOfAnotherSceneIsRefused) {
  Simulation whole(broken_plate());
  Scene other = broken_plate();
  other.floes.resize(1);
  EXPECT_FALSE(Simulation::resumed(other, whole.state()).has_value());
  other = broken_plate();
  for (geometry::Point& p : other.floes[1].polygon_in_world.outer) p.x *= 1.01;
  EXPECT_FALSE(Simulation::resumed(other, whole.state()).has_value());
  other = broken_plate();
  other.ships.push_back(other.ships[0]);
  EXPECT_FALSE(Simulation::resumed(other, whole.state()).has_value());
}

/// On several threads, on more than there are cores, the same bits. The scene is large enough to share out:
/// more than 1024 awake floes (dynamics::kBodiesPerChunk), some of them colliding.
TEST(State, TheHashIsTheSameOnAnyNumberOfThreads) {
  Scene scene = paper_scene();
  scene.time.step = 0.02;
  scene.ships = {icebreaker({-1, 400}, ConstantSpeed{2}, 2)};
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 60; ++k) {
      const double x = 14.0 * i;
      const double y = 14.0 * k;
      scene.floes.push_back(
          floe(rectangle(x, y, x + 12, y + 13), {0.3 * std::sin(0.7 * i + k), 0.3 * std::cos(k)}));
    }
  }
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 8}) {
    Simulation simulation(scene);
    simulation.set_threads(threads);
    while (simulation.time() < 12) {
      simulation.step();
      simulation.journal().clear();
    }
    EXPECT_GT(simulation.world().step.contacts.size(), 600U) << "too few to share out";
    EXPECT_GT(simulation.counts().peak_awake, 2048);
    EXPECT_GT(simulation.counts().bends, 0);
    hashes.push_back(simulation.state_hash());
  }
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
}

}  // namespace
}  // namespace polynya::simulation::scenes
