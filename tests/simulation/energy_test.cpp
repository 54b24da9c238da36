// Energy and momentum are measured where they flow; the kinetic energy and the momentum at the end are those
// of the accounts.
#include "simulation/world/energy.hpp"

#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

constexpr double kClosed = 1e-11;  ///< share of the turnover; what rounding leaves

void expect_closed(const Audit& audit) {
  EXPECT_LT(std::abs(audit.energy_imbalance), kClosed * audit.turnover);
  EXPECT_LT(length(audit.momentum_imbalance), kClosed * audit.momentum_turnover);
  EXPECT_TRUE(audit.is_closed());
}

Audit after(const Scene& scene, double until) {
  Simulation simulation(scene);
  run(simulation, until);
  return simulation.audit();
}

/// A ship through two plates and small floes, all sinks at work.
Scene busy_scene(const Propulsion& propulsion) {
  Scene scene = paper_scene();
  scene.ships = {icebreaker({0, 3}, propulsion, 2)};
  scene.floes = {floe(rectangle(0.5, -40, 70, 50), {-0.2, 0.05}, 1e-3), floe(rectangle(72, -40, 120, 60))};
  for (int i = 0; i < 12; ++i)
    scene.floes.push_back(floe(rectangle(-60 + 6 * i, -25, -55 + 6 * i, -18), {0.05 * i, 0.4}));
  return scene;
}

TEST(EnergyAudit, ClosesWhereAShipUnderThrustBreaksIce) {
  const Audit audit = after(busy_scene(ConstantThrust{2e5}), 40);
  expect_closed(audit);
  const EnergyFlows& e = audit.sums.energy;
  EXPECT_GT(e.thrust, 0);
  EXPECT_GT(e.drag, 0);
  EXPECT_GT(e.friction, 0);
  EXPECT_GT(e.crushing, 0);
  EXPECT_GT(e.bending, 0) << "cusps leave with their motion";
  EXPECT_EQ(e.current, 0);
}

TEST(EnergyAudit, ClosesWithAPrescribedShipInADriftAndWithStructuresInAShearedCurrent) {
  Scene prescribed = busy_scene(ConstantSpeed{2});
  prescribed.water.drift = {0.3, -0.1};
  const Audit audit_prescribed = after(prescribed, 30);
  expect_closed(audit_prescribed);
  EXPECT_GT(audit_prescribed.sums.energy.thrust, 0) << "what holds the speed works";
  EXPECT_GT(length(audit_prescribed.sums.momentum.held), 0);

  Scene sheared = busy_scene(ConstantSpeed{0});
  sheared.structures = {standing(sheared.ships[0])};
  sheared.ships.clear();
  sheared.water.drift = {-0.5, 0};
  sheared.water.shear.rate = 1e-3;
  const Audit audit_sheared = after(sheared, 30);
  expect_closed(audit_sheared);
  EXPECT_NE(audit_sheared.sums.energy.current, 0);
}

TEST(EnergyAudit, ClosesWhereCuspsFloatAndPlatesSplit) {
  Scene scene = busy_scene(ConstantThrust{2e5});
  scene.fracture.cusp_fate = CuspFate::kFloat;
  scene.fracture.splitting = fracture::SplittingModel::kLefm;
  expect_closed(after(scene, 20));
}

TEST(EnergyAudit, NoticesAChangeWithoutAnEntry) {
  Simulation simulation(busy_scene(ConstantThrust{2e5}));
  run(simulation, 5);
  ASSERT_TRUE(simulation.audit().is_closed());
  auto& world = const_cast<World&>(simulation.world());
  world.population.bodies.velocity[0].y += 0.01;  // a ship pushed aside by nothing
  EXPECT_FALSE(simulation.audit().is_closed());
}

}  // namespace
}  // namespace polynya::simulation
