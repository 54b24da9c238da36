// Fast ice: floes whose motion is prescribed. Hulls crush and break them; their largest piece stays fast.
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/state/state.hpp"
#include "simulation/world/step.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

FloeSpec fast(const geometry::Polygon& polygon, geometry::Vector velocity = {}) {
  FloeSpec spec = floe(polygon, velocity);
  spec.is_fast = true;
  return spec;
}

Scene in_ice(const Propulsion& propulsion, FloeSpec ice) {
  Scene scene;
  scene.time.step = 0.01;
  scene.ships = {icebreaker({-0.5, 0}, propulsion, 1)};
  scene.floes = {std::move(ice)};
  return scene;
}

double mean_surge(const Story& story) {
  double sum = 0;
  for (const ShipSample& sample : story.samples) sum += sample.from_ice.surge;
  return sum / static_cast<double>(story.samples.size());
}

void expect_closed(const Simulation& simulation) {
  const AreaLedger ledger = simulation.area_ledger();
  EXPECT_LT(std::abs(ledger.imbalance), 1e-9 * ledger.initial_ice_area);
  EXPECT_TRUE(simulation.audit().is_closed())
      << simulation.audit().energy_imbalance << " J of " << simulation.audit().turnover;
}

/// The only floe that is fast.
FloeId fast_floe(const Simulation& simulation) {
  const Population& population = simulation.world().population;
  FloeId found = kNoFloe;
  for (FloeId id = 0; id < population.floe_count(); ++id) {
    if (!population.is_floating(id) || !population.is_fast(id)) continue;
    EXPECT_EQ(found, kNoFloe);
    found = id;
  }
  return found;
}

TEST(FastIce, StaysWhereAShipThrustsIntoIt) {
  Simulation simulation(in_ice(ConstantThrust{5e5}, fast(rectangle(0, -60, 200, 60))));
  const Story story = run(simulation, 30);
  ASSERT_GT(simulation.counts().bends, 5);
  const BodyIndex body = simulation.world().population.body_of(fast_floe(simulation));
  const dynamics::Bodies& bodies = simulation.world().population.bodies;
  EXPECT_EQ(bodies.velocity[body], geometry::Vector{});
  EXPECT_EQ(bodies.position[body], bodies.centroid[body]) << "its frame has not moved";
  EXPECT_LT(mean_surge(story), -1e4);
  expect_closed(simulation);
}

TEST(FastIce, LoadsAShipAtConstantSpeedAsAPlateTooHeavyToMoveDoes) {
  const double until = 40;
  Simulation held(in_ice(ConstantSpeed{1}, fast(rectangle(0, -300, 600, 300))));
  Simulation heavy(in_ice(ConstantSpeed{1}, floe(rectangle(0, -1500, 3000, 1500))));
  const double on_held = mean_surge(run(held, until));
  const double on_heavy = mean_surge(run(heavy, until));
  EXPECT_LT(on_heavy, -1e4);
  EXPECT_NEAR(on_held / on_heavy, 1, 0.05);
  EXPECT_GT(held.counts().bends, 10);
  EXPECT_NEAR(static_cast<double>(held.counts().bends) / static_cast<double>(heavy.counts().bends), 1, 0.1);
  expect_closed(held);
}

TEST(FastIce, ThatMovesCrushesOnAStructure) {
  Scene scene = in_ice(ConstantSpeed{0}, fast(rectangle(0.01, -40, 100, 40), {-0.2, 0}));
  scene.ships.clear();
  scene.structures = {standing(barge({0, 0}, ConstantSpeed{0}))};
  scene.fracture.breakable_size_factor = 1e9;
  Simulation simulation(scene);
  const Story story = run(simulation, 5);
  const double crushing = scene.ice.compressive_strength * scene.ice.thickness * 24;
  EXPECT_NEAR(story.samples.back().from_ice.surge / -crushing, 1, 0.02);
  expect_closed(simulation);
}

TEST(FastIce, ItsPiecesAreFreeAndMoveOnAsItDid) {
  Scene scene = in_ice(ConstantSpeed{1}, fast(rectangle(0, -60, 200, 60), {-0.3, 0.1}));
  scene.water.drift = {0.05, 0};
  scene.water.drag_coefficient = 0;
  scene.fracture.cusp_fate = CuspFate::kFloat;
  Simulation simulation(scene);
  Story story;
  while (story.events.empty()) {
    simulation.step();
    listen(simulation, story);
  }
  ASSERT_TRUE(story.events[0].is<Bend>());
  ASSERT_GE(story.events[0].ice()->children.size(), 2u);
  const Population& population = simulation.world().population;
  for (const FloeId child : story.events[0].ice()->children) {
    EXPECT_EQ(population.is_fast(child), child == fast_floe(simulation));
    const geometry::Vector velocity = population.bodies.velocity[population.body_of(child)];
    EXPECT_NEAR(velocity.x, -0.35, 1e-12);
    EXPECT_NEAR(velocity.y, 0.1, 1e-12);
  }
  expect_closed(simulation);
  run(simulation, 10);
  expect_closed(simulation);
  const BodyIndex body = population.body_of(fast_floe(simulation));
  EXPECT_EQ(population.bodies.velocity[body], (geometry::Vector{-0.35, 0.1}));
}

TEST(Cusp, WhoseFirstTouchHasBrokenOffIsCentredAtTheIceNearestToTheContact) {
  World world(in_ice(ConstantSpeed{8}, fast(rectangle(0, -60, 200, 60))));
  dynamics::PersistentContact record;
  PendingFracture pending;
  pending.failure = fracture::Failure::kBend;
  pending.floe = 0;
  pending.point_in_water = {-3, 5};
  pending.first_touch_in_body = {-4, 0};  // with the radius below, it reaches no ice
  pending.normal = {1, 0};
  pending.cusp_radius = 2;
  pending.penetration = 3;
  pending.record = &record;
  std::vector<PendingFracture> fractures{pending};
  apply_fractures(world.setup, world.clock, fractures, world.population, world.accounts, world.journal);
  EXPECT_EQ(world.accounts.counts.bends, 1);
  EXPECT_EQ(world.accounts.counts.rejected_cuts, 0);
  EXPECT_FALSE(record.was_refused);
  EXPECT_NEAR(world.accounts.ledger.submerged_area, std::numbers::pi * 2, 0.1) << "half a disc about (0, 5)";
}

TEST(FastIce, IsSavedWithItsPieces) {
  const Scene scene = in_ice(ConstantSpeed{1}, fast(rectangle(0, -60, 200, 60)));
  Simulation whole(scene);
  run(whole, 12);
  ASSERT_GT(whole.counts().bends, 1);
  auto resumed = Simulation::resumed(scene, whole.state());
  ASSERT_TRUE(resumed) << resumed.error();
  run(whole, 20);
  run(*resumed, 20);
  EXPECT_EQ(resumed->state_hash(), whole.state_hash());
  EXPECT_EQ(fast_floe(*resumed), fast_floe(whole));
}

}  // namespace
}  // namespace polynya::simulation
