// Settings that must not change a run: interrupting and resuming it, the number of threads, culling, and sleep within
// the effect of the rest speed.
#include "simulation/state/state.hpp"

#include <array>
#include <bit>

#include <gtest/gtest.h>

#include "simulation/field/floe_field.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation::scenes {
namespace {

/// Bends, splits, sleeping and waking floes, pinched small ones.
Scene broken_plate(Laws laws = Laws::kDefault) {
  Build scene = Build(laws)
                    .step(0.01)
                    .ship(icebreaker({-0.5, 0}, ConstantThrust{5e5}, 2))
                    .floe(rectangle(0, -40, 60, 40))
                    .floe(rectangle(60.5, -40, 140, 40));
  for (int i = 0; i < 6; ++i) scene.floe(rectangle(2 + 16 * i, 41, 12 + 16 * i, 51), {0, -0.2});
  return scene.floe(rectangle(300, 0, 310, 10));  // far from all others
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
    EXPECT_EQ(std::bit_cast<std::uint64_t>(p.bodies.mass[i]), std::bit_cast<std::uint64_t>(q.bodies.mass[i])) << i;
  }
}

TEST(State, AResumedRunContinuesBitByBitFromAnyStep) {
  for (const Laws laws : kBothLaws) {
    const Scene scene = broken_plate(laws);
    Simulation whole(scene);
    std::vector<Simulation> all;
    for (int step = 0; step < 2500; ++step) {
      if (step % 250 == 37) {
        all.push_back(resumed(scene, whole));
        // The bytes may differ: after reading, the boxes of bodies are new, so that more pairs may be near each other.
        ASSERT_EQ(all.back().state_hash(), whole.state_hash()) << "what is read back is what was written";
      }
      skip(whole);
      for (Simulation& one : all) {
        skip(one);
        if (step % 50 == 0) expect_same_bits(whole, one);
      }
    }
    for (Simulation& one : all) {
      expect_same_bits(whole, one);
      EXPECT_EQ(one.counts().bends, whole.counts().bends);
      EXPECT_EQ(one.counts().crush_contacts, whole.counts().crush_contacts);
      EXPECT_EQ(one.area_ledger().imbalance(), whole.area_ledger().imbalance());
    }
    EXPECT_GT(whole.counts().bends, 20) << "the trial should have broken something";
    EXPECT_LE(std::ssize(whole.world().population.awake), whole.counts().floes_final) << "and some should sleep";
  }
}

/// A state with a changed byte is either refused, or read as another complete state.
TEST(State, DamageIsRefusedOrIsAnotherState) {
  const Scene scene = broken_plate();
  Simulation whole(scene);
  while (whole.counts().bends < 2) skip(whole);
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

/// A position or velocity that no run can reach is refused, whichever of its two components is too large.
TEST(State, ABodyBeyondTheWorldOrFasterThanAnyIsRefused) {
  const Scene scene = Build().floe(rectangle(0, 0, 10, 10), {0.123, 0.321}).floe(rectangle(50, 70, 62, 84));
  const Simulation whole(scene);
  const Point place = whole.world().population.bodies.position[1];
  const std::string state = whole.state();
  const auto is_read_with = [&](double was, double is) {
    std::string changed = state;
    const auto bytes = std::bit_cast<std::array<char, sizeof was>>(was);
    const std::size_t at = changed.find({bytes.data(), bytes.size()});
    EXPECT_NE(at, std::string::npos) << was;
    const auto others = std::bit_cast<std::array<char, sizeof is>>(is);
    changed.replace(at, others.size(), others.data(), others.size());
    return Simulation::resumed(scene, changed).has_value();
  };
  for (const double velocity : {0.123, 0.321}) {
    EXPECT_TRUE(is_read_with(velocity, 0.2)) << velocity;
    EXPECT_FALSE(is_read_with(velocity, -1e7)) << velocity;
  }
  for (const double coordinate : {place.x, place.y}) {
    EXPECT_TRUE(is_read_with(coordinate, coordinate + 0.5)) << coordinate;
    EXPECT_FALSE(is_read_with(coordinate, -1e10)) << coordinate;
  }
}

TEST(State, AStateOfAnotherSceneIsRefused) {
  const Simulation whole(broken_plate());
  Scene fewer = broken_plate(), larger = broken_plate(), accompanied = broken_plate();
  fewer.floes.resize(1);
  for (geometry::Point& p : larger.floes[1].polygon_in_world.outer) p.x *= 1.01;
  accompanied.ships.push_back(accompanied.ships[0]);
  for (const Scene& other : {fewer, larger, accompanied})
    EXPECT_FALSE(Simulation::resumed(other, whole.state()).has_value());
}

/// The bits are the same on several threads, also on more threads than there are cores. The scene is large enough to be
/// divided among threads: it has more than 1024 awake floes (dynamics::kBodiesPerChunk), some of which collide.
TEST(State, TheHashIsTheSameOnAnyNumberOfThreads) {
  Build scene = Build().step(0.02).ship(icebreaker({-1, 400}, ConstantSpeed{2}, 2));
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 60; ++k) {
      const double x = 14.0 * i, y = 14.0 * k;
      scene.floe(rectangle(x, y, x + 12, y + 13), {0.3 * std::sin(0.7 * i + k), 0.3 * std::cos(k)});
    }
  }
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 8}) {
    Simulation simulation(scene);
    simulation.set_threads(threads);
    while (simulation.time() < 8) skip(simulation);
    EXPECT_GT(simulation.world().data.contacts.size(), 600U) << "too few to share out";
    EXPECT_GT(simulation.counts().peak_awake, 2048);
    EXPECT_GT(simulation.counts().bends, 0);
    hashes.push_back(simulation.state_hash());
  }
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
}

/// The same records and the same end, bit by bit.
void expect_same_course(const Trial& one, const Trial& other) {
  EXPECT_EQ(one.simulation.state_hash(), other.simulation.state_hash());
  EXPECT_TRUE(one.story.samples == other.story.samples);
  EXPECT_TRUE(one.story.deaths == other.story.deaths);
  const auto of_birth = [](const Birth& b) { return std::tuple(b.floe, b.time, b.area, b.polygon_in_body); };
  EXPECT_TRUE(std::ranges::equal(one.story.births, other.story.births, {}, of_birth, of_birth));
  const auto of_event = [](const Event& e) {
    const fracture::FailureCriteria c = e.criteria();
    return std::tuple(e.time, e.what.index(), e.ice()->floe, e.point_in_world, e.ice()->penetration, c.collision_force,
                      c.vertical_force, c.bending_capacity);
  };
  EXPECT_TRUE(std::ranges::equal(one.story.events, other.story.events, {}, of_event, of_event));
}

void add_field(Build& scene, const geometry::Polygon& region, double concentration, double size,
               const std::vector<geometry::Polygon>& kept_clear = {}) {
  FloeField field;
  field.region = region.outer;
  field.floe_size = size;
  field.concentration = concentration;
  field.seed = 5;
  field.kept_clear = kept_clear;
  for (const auto& polygon : make_floe_field(field).floes) scene.floe(polygon);
}

/// Returns a ship that breaks its way through a plate and pushes floes in a drift.
Scene voyage() {
  Build scene = Build(Laws::kPaper)
                    .step(0.01)
                    .drift({-0.1, 0.05})
                    .ship(icebreaker({0, 0}, ConstantThrust{4e5}, 2))
                    .floe(rectangle(5, -50, 45, 40));
  add_field(scene, rectangle(47, -50, 100, 50), 0.6, 14);
  add_field(scene, rectangle(47, 200, 80, 230), 0.6, 14);  // far off, never touched
  return scene;
}

/// Floes that a sheared current carries past a pile: all awake, jammed and parting.
Scene pile_in_shear() {
  Build scene = Build().step(0.02).drift({0.6, 0}).shear(0.004).pile({40, 0}, 8);
  add_field(scene, rectangle(-60, -40, 60, 40), 0.75, 12, {shapes::regular(64, 8, {40, 0})});
  return scene;
}

TEST(Shortcuts, CullingChangesNoByte) {
  for (const auto& [scene, until, bends] : {std::tuple(voyage(), 40.0, 3), {pile_in_shear(), 60.0, -1}}) {
    const Trial with = run(scene, until);
    const Trial without = run(scene, until, {.culls = false});
    const Counts counts = with.simulation.counts();
    EXPECT_GT(counts.peak_contacts, 10);
    EXPECT_GT(counts.bends, bends) << "ice did break";
    EXPECT_GT(with.story.samples.size(), 200u);
    expect_same_course(with, without);
  }
}

TEST(Shortcuts, WhereNothingComesToRestSleepChangesNoByte) {
  // In the shear no floe ever may sleep.
  expect_same_course(run(pile_in_shear(), 30), run(pile_in_shear(), 30, {.culls = false, .sleeps = false}));
}

TEST(Shortcuts, FloesComeToRestOnceASecondWhereIceCrushesAndInEachStepOfTheImpulseLaw) {
  for (const Laws laws : kBothLaws) {
    Simulation simulation(Build(laws).step(0.01).floe(rectangle(0, 0, 10, 10), {0.5 * kRestSpeed, 0}));
    for (int i = 1; i <= (laws == Laws::kDefault ? 100 : 1); ++i) {
      EXPECT_EQ(simulation.world().population.awake.size(), 1u) << i;
      simulation.step();
    }
    EXPECT_TRUE(simulation.world().population.awake.empty());
  }
}

TEST(Shortcuts, SleepMovesFloesByNoMoreThanTheRestSpeedDoes) {
  // A floe put to rest would have moved on at less than the rest speed. Until a collision changes the course of events,
  // positions differ by less than the displacement at that speed, and every fracture is the same. Later, collisions
  // amplify any difference, and only means can be compared.
  const Shortcuts all_awake{.culls = false, .sleeps = false};
  const double before_chaos = 20;
  const Trial with = run(voyage(), before_chaos), without = run(voyage(), before_chaos, all_awake);
  EXPECT_LT(with.simulation.counts().peak_awake, without.simulation.counts().peak_awake / 2) << "most slept";
  const auto p = with.simulation.floe_states(), q = without.simulation.floe_states();
  for (std::size_t i = 0; i < std::min(p.size(), q.size()); ++i)
    EXPECT_LT(distance(p[i].world_from_body.position, q[i].world_from_body.position), kRestSpeed * before_chaos);
  ASSERT_EQ(with.story.events.size(), without.story.events.size());
  EXPECT_GT(with.story.events.size(), 10u);
  for (std::size_t i = 0; i < with.story.events.size(); ++i)
    EXPECT_EQ(with.story.events[i].time, without.story.events[i].time);
  const auto mean_surge = [](const Trial& run) { return mean(run.story, &HullSample::from_ice); };
  EXPECT_NEAR(mean_surge(with) / mean_surge(without), 1, 1e-4);
  EXPECT_NEAR(mean_surge(run(voyage(), 40)) / mean_surge(run(voyage(), 40, all_awake)), 1, 0.05);
}

}  // namespace
}  // namespace polynya::simulation::scenes
