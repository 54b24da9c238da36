// A ship in water: engine, rudder, mooring, and what the water does to its hull.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/world/step.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

constexpr double kLength = 120;

/// The reference ship in water, alone.
Scene in_water(const Propulsion& propulsion, double speed, double step = 0.05) {
  Scene scene;
  scene.time.step = step;
  Ship ship = icebreaker({60, 0}, propulsion, speed);
  ship.hull.draught = 6;
  ship.water.acts = true;
  ship.water.block_coefficient = 0.579;
  scene.ships = {ship};
  scene.record.forces_interval = step;
  return scene;
}

Engine engine(double pull = 1e6, double speed = 8) {
  return {.bollard_pull = pull, .open_water_speed = speed, .propeller_area = 12};
}

World world_of(const Scene& scene, dynamics::Planar motion) {
  World world(scene);
  dynamics::Bodies& bodies = world.population.bodies;
  bodies.velocity[0] = rotate(bodies.rotation[0], {motion.surge, motion.sway});
  bodies.angular_velocity[0] = motion.yaw;
  open_accounts(bodies, world.accounts.audit);
  return world;
}

dynamics::Planar motion_of(const World& world) {
  const dynamics::Bodies& b = world.population.bodies;
  const geometry::Vector v = rotate_back(b.rotation[0], b.velocity[0]);
  return {v.x, v.y, b.angular_velocity[0]};
}

/// Of the ship and of the water that it sets in motion. Right after a step the ship has turned, the water has
/// not: its motion is that in the axes of before.
double wet_energy(const World& world) {
  const dynamics::Bodies& b = world.population.bodies;
  const dynamics::Planar now = motion_of(world);
  const geometry::Vector before =
      rotate(dynamics::turned({}, now.yaw * world.clock.step), {now.surge, now.sway});
  const dynamics::Planar in_water{before.x, before.y, now.yaw};
  return kinetic_energy(b) + 0.5 * dot(in_water, world.setup.sailing[0].hull.added_mass * in_water);
}

TEST(Sailing, NoEnergyComesFromNothing) {
  for (const double step : {0.005, 0.1, 1.0}) {
    for (const dynamics::Planar start :
         {dynamics::Planar{6, 0, 0}, {3, 2, 0.05}, {-4, 1, -0.08}, {0.1, 2, 0.1}, {0, 0, 0.15}}) {
      World world = world_of(in_water(ConstantThrust{0}, 0, step), start);
      double before = wet_energy(world) * (1 + 1e-3);  // the first step's turn is not known
      for (int i = 0; i < 600; ++i) {
        simulation::step(world);
        const double now = wet_energy(world);
        ASSERT_LE(now, before * (1 + 1e-12)) << "step " << i << " of " << step << " s";
        before = now;
      }
    }
  }
}

TEST(Sailing, AShipWithoutAnEngineCoastsToAStop) {
  Simulation simulation(in_water(ConstantThrust{0}, 6, 0.5));
  const Story story = run(simulation, 3600);
  const double m = 1.05e7, d = 0.5 * 1000 * 0.004 * (1.7 * 120 * 6 + 0.579 * 120 * 24);
  for (std::size_t i = 1; i < story.samples.size(); ++i)
    ASSERT_LT(length(story.samples[i].velocity_in_world), length(story.samples[i - 1].velocity_in_world));
  // m v̇ = −d v²
  EXPECT_NEAR(length(story.samples.back().velocity_in_world), 6 / (1 + 6 * d / m * 3600), 0.01);
  EXPECT_NEAR(story.samples.back().position_in_world.x, m / d * std::log(1 + 6 * d / m * 3600), 20);
  EXPECT_TRUE(simulation.audit().is_closed());
}

TEST(Sailing, AnEngineComesToItsOpenWaterSpeed) {
  Simulation simulation(in_water(engine(), 0, 0.1));
  const Story story = run(simulation, 900);
  EXPECT_NEAR(story.samples.back().velocity_in_world.x, 8, 0.005 * 8);
  EXPECT_NEAR(story.samples.back().thrust, 2 / 3.0 * 1e6, 0.005 * 1e6);
  EXPECT_NEAR(story.samples.front().thrust, 1e6, 1e3);
  EXPECT_TRUE(simulation.audit().is_closed());
}

/// Σ of the forces on the ship by cause [N, N m], in the ship's axes.
dynamics::Planar sum_of_causes(const ShipSample& s, bool has_engine) {
  dynamics::Planar sum = s.from_water + s.from_rudder + s.from_mooring;
  sum += {s.from_ice.surge + s.from_ships.surge + s.from_submerged.surge, s.from_ice.sway + s.from_ships.sway,
          s.from_ice.yaw + s.from_ships.yaw + s.from_submerged.yaw};
  return sum + (has_engine ? s.from_engine : dynamics::Planar{s.thrust, 0, 0});
}

/// Steps a scene and compares what the causes gave in each step with the change of the ship's momentum.
void expect_balance(const Scene& scene, double until) {
  World world(scene);
  const dynamics::Bodies& b = world.population.bodies;
  const bool has_engine = std::holds_alternative<Engine>(scene.ships[0].propulsion);
  double largest = 0;
  while (world.clock.time() < until) {
    const geometry::Vector velocity = b.velocity[0];
    const double omega = b.angular_velocity[0];
    const geometry::Rotation rotation = b.rotation[0];
    simulation::step(world);
    const dynamics::Planar sum = sum_of_causes(world.journal.samples.back(), has_engine);
    const geometry::Vector force = (b.mass[0] / scene.time.step) * (b.velocity[0] - velocity);
    const geometry::Vector in_ship = rotate_back(rotation, force);
    const double moment = b.moment[0] / scene.time.step * (b.angular_velocity[0] - omega);
    const double size = 1e5 + length(force);
    ASSERT_NEAR(sum.surge, in_ship.x, 1e-8 * size) << world.clock.time();
    ASSERT_NEAR(sum.sway, in_ship.y, 1e-8 * size);
    ASSERT_NEAR(sum.yaw, moment, 1e-8 * size * kLength);
    largest = std::max(largest, length(force));
    world.journal.clear();
  }
  EXPECT_GT(largest, 1e4);
  EXPECT_TRUE(audit(world.accounts.audit, kinetic_energy(b), momentum(b)).is_closed());
}

TEST(Sailing, ForcesByCauseBalanceMassTimesAcceleration) {
  Scene scene = in_water(engine(1e6), 3, 0.01);
  scene.ships[0].steering = RudderSettings{.area = 13};
  scene.ships[0].heading = 0.3;
  scene.ships[0].mooring = MooringSettings{.position_in_world = {10, 3},
                                           .heading = 0.2,
                                           .surge_stiffness = 1e4,
                                           .sway_stiffness = 3e4,
                                           .yaw_stiffness = 1e8,
                                           .surge_damping = 1e5,
                                           .break_load = 6e5};
  scene.water.drift = {0.2, -0.1};
  scene.fracture.going_under.is_enabled = true;
  scene.floes = {floe(rectangle(80, -60, 250, 80))};
  expect_balance(scene, 20);
}

TEST(Sailing, TheSumBalancesUnderPrescribedThrustToo) {
  Scene scene = in_water(ConstantThrust{4e5}, 2, 0.01);
  scene.floes = {floe(rectangle(61, -60, 250, 80))};
  expect_balance(scene, 15);
}

TEST(Sailing, ARunGoesOnFromItsStateAsIfItHadNotStopped) {
  Scene scene = in_water(engine(), 2, 0.01);
  scene.record.forces_interval = 0.3;
  scene.ships[0].mooring = MooringSettings{.position_in_world = {0, 0}, .break_load = 1e5};
  scene.ships[0].mooring->surge_damping = 1e5;  // breaks at once
  scene.floes = {floe(rectangle(61, -60, 250, 80))};
  Simulation whole(scene);
  run(whole, 5);
  EXPECT_TRUE(whole.world().population.helms[0].is_adrift);
  auto resumed = Simulation::resumed(scene, whole.state());
  ASSERT_TRUE(resumed.has_value()) << resumed.error();
  const Story one = run(whole, 8), other = run(*resumed, 8);
  EXPECT_EQ(whole.state_hash(), resumed->state_hash());
  ASSERT_EQ(one.samples.size(), other.samples.size());
  EXPECT_EQ(one.samples.front().from_water, other.samples.front().from_water);
}

/// A short blow from the side by a mass far smaller than the ship.
TEST(Sailing, TheWaterSharesABlow) {
  Scene scene = in_water(ConstantThrust{0}, 0, 0.005);
  scene.floes = {floe(rectangle(-10, 12.1, 10, 32.1), {0, -1})};
  World world(scene);
  while (world.clock.time() < 3) simulation::step(world);
  const dynamics::Bodies& b = world.population.bodies;
  const double given = b.mass[1] * (-1 - b.velocity[1].y);  // by the ship, and a little by the water
  const double wet_mass = 1e7 + world.setup.sailing[0].hull.added_mass.rows[1].sway;
  EXPECT_NEAR(b.velocity[0].y / (given / wet_mass), 1, 0.1);
  EXPECT_GT(wet_mass, 1.5e7);
}

TEST(Sailing, ShipsThatMeetAreAnEventAndNoLoadOfIce) {
  Scene scene = in_water(engine(), 2, 0.01);
  Ship other = in_water(ConstantThrust{0}, 0).ships[0];
  other.name = "other";
  other.position_in_world = {125, 3};
  scene.ships.push_back(other);
  Simulation simulation(scene);
  const Story story = run(simulation, 10);
  ASSERT_EQ(of_kind<ShipContact>(story).size(), 1U);
  double by_ships = 0;
  for (const ShipSample& s : story.samples) {
    EXPECT_EQ(s.from_ice.surge, 0);
    EXPECT_EQ(s.friction_of_ice, dynamics::Planar{});
    by_ships = std::max(by_ships, std::abs(s.from_ships.surge));
  }
  EXPECT_GT(by_ships, 1e5);
  EXPECT_TRUE(simulation.audit().is_closed());
}

TEST(Sailing, EquilibriumOfAPrescribedResistanceIsTheClosedForm) {
  // A mooring without stiffness is a linear resistance of 166.4 kN s/m; 391 kN are left out of T_B.
  Scene scene = in_water(engine(1e6, 8), 1, 0.1);
  scene.ships[0].mooring = MooringSettings{};
  scene.ships[0].mooring->surge_damping = 166.4e3;
  const double linear = 1e6 / 24 + 166.4e3, quadratic = 2 / 3.0 * 1e6 / 64;
  const double expected = (-linear + std::sqrt(linear * linear + 4 * quadratic * 1e6)) / (2 * quadratic);
  Simulation simulation(scene);
  EXPECT_NEAR(run(simulation, 600).samples.back().velocity_in_world.x, expected, 0.005 * expected);
}

TEST(Sailing, ASideWindOfCurrentCarriesAShipAlong) {
  Scene scene = in_water(ConstantThrust{0}, 0, 0.1);
  scene.water.drift = {0, 0.5};
  scene.ships[0].speed = 0;
  Simulation simulation(scene);
  const Story story = run(simulation, 1200);
  EXPECT_NEAR(story.samples.back().velocity_in_world.y, 0.5, 0.05);
  EXPECT_TRUE(simulation.audit().is_closed());
}

TEST(Sailing, AMooringHoldsInACurrentAndBreaksAboveItsLoad) {
  Scene scene = in_water(ConstantThrust{0}, 0, 0.1);
  scene.water.drift = {0, 0.5};
  MooringSettings mooring{.position_in_world = {0, 0},
                          .surge_stiffness = 1e5,
                          .sway_stiffness = 1e5,
                          .yaw_stiffness = 1e9,
                          .surge_damping = 1e5,
                          .sway_damping = 5e5,
                          .yaw_damping = 1e9};
  scene.ships[0].mooring = mooring;
  Simulation held(scene);
  const ShipSample last = run(held, 600).samples.back();
  const double drag = 0.5 * 1000 * 6 * 0.8 * 0.25 * kLength;  // ½ρ T C_d L v²
  EXPECT_NEAR(last.from_water.sway, drag, 0.01 * drag);
  EXPECT_NEAR(last.from_mooring.sway, -drag, 0.01 * drag);
  EXPECT_NEAR(last.position_in_world.y, drag / 1e5, 0.02);
  EXPECT_TRUE(held.audit().is_closed());
  EXPECT_FALSE(held.world().population.helms[0].is_adrift);
  scene.ships[0].mooring->break_load = 0.5 * drag;
  Simulation broken(scene);
  const ShipSample after = run(broken, 600).samples.back();
  EXPECT_TRUE(broken.world().population.helms[0].is_adrift);
  EXPECT_EQ(after.from_mooring, dynamics::Planar{});
  EXPECT_GT(after.position_in_world.y, 100);
}

/// One event where it breaks, whose force is stiffness times offset, above what the mooring holds; none after
/// a resume.
TEST(Sailing, AMooringBreaksInOneEventWithItsForceAndItsOffset) {
  Scene scene = in_water(ConstantThrust{2e5}, 0, 0.1);
  scene.water.drift = {0, 0.5};
  const double heading = 30 * kDegree, along = 1e5, across = 2e5;
  scene.ships[0].mooring = MooringSettings{.position_in_world = scene.ships[0].position_in_world,
                                           .heading = heading,
                                           .surge_stiffness = along,
                                           .sway_stiffness = across,
                                           .break_load = 3e5};
  Simulation simulation(scene);
  const Story story = run(simulation, 200);
  ASSERT_EQ(of_kind<MooringBreak>(story).size(), 1U);
  const Event event = of_kind<MooringBreak>(story)[0];
  const auto& broken = std::get<MooringBreak>(event.what);
  EXPECT_EQ(event.ship, 0);
  EXPECT_EQ(event.time, simulation.world().population.helms[0].adrift_since);
  EXPECT_EQ(broken.break_load, 3e5);
  EXPECT_GT(broken.force, 3e5);
  EXPECT_LT(broken.force, 3.1e5) << "it breaks in the first step above its load";
  const geometry::Vector offset = broken.offset_in_moored_place;
  EXPECT_NEAR(broken.force, std::hypot(along * offset.x, across * offset.y), 1e-6 * broken.force);
  const geometry::Vector in_world = rotate(geometry::Rotation::by(heading), offset);
  EXPECT_NEAR(distance(event.point_in_world, scene.ships[0].position_in_world + in_world), 0, 1e-9);
  const auto row = std::ranges::find_if(
      story.samples, [&](const ShipSample& s) { return s.time > event.time - 0.5 * scene.time.step; });
  EXPECT_NEAR(std::hypot(row->from_mooring.surge, row->from_mooring.sway), broken.force, 1e-6 * broken.force);
  EXPECT_NEAR(distance(row->position_in_world, event.point_in_world), 0, 1e-9);
  auto resumed = Simulation::resumed(scene, simulation.state());
  ASSERT_TRUE(resumed.has_value()) << resumed.error();
  EXPECT_TRUE(of_kind<MooringBreak>(run(*resumed, 210)).empty());
}

TEST(Sailing, AStiffMooringIsStableInALongStep) {
  Scene scene = in_water(ConstantThrust{0}, 1, 0.5);
  scene.ships[0].mooring = MooringSettings{.position_in_world = scene.ships[0].position_in_world,
                                           .surge_stiffness = 1e10,
                                           .sway_stiffness = 1e10,
                                           .yaw_stiffness = 1e14};
  Simulation simulation(scene);
  EXPECT_LT(length(run(simulation, 60).samples.back().velocity_in_world), 1e-3);
}

/// A turn of 540° at a rudder angle from 6 m/s, at the thrust that holds that speed.
struct TurningCircle {
  double steady_diameter = 0;    ///< [L]
  double tactical_diameter = 0;  ///< across the course at 180° [L]
  double advance = 0;            ///< along it at 90° [L]
  double speed_kept = 0;
};

TurningCircle turn(double rudder_angle) {
  Scene scene = in_water(engine(314e3, 6), 6, 0.1);
  RudderSettings rudder{.area = 0.018 * kLength * 6};
  scene.ships[0].steering = rudder;
  scene.ships[0].pilot = ConstantPilot{1, rudder_angle * kDegree};
  World world(scene);
  while (world.clock.time() < 2500) step(world);
  TurningCircle circle;
  const std::vector<ShipSample>& samples = world.journal.samples;
  const geometry::Point start = samples.front().position_in_world;
  for (const ShipSample& s : samples) {
    const geometry::Vector off = s.position_in_world - start;
    if (circle.advance == 0 && s.heading > M_PI / 2) circle.advance = off.x / kLength;
    if (circle.tactical_diameter == 0 && s.heading > M_PI) circle.tactical_diameter = off.y / kLength;
  }
  const ShipSample& last = samples.back();
  const double speed = length(last.velocity_in_world);
  circle.steady_diameter = 2 * speed / last.yaw_rate / kLength;
  circle.speed_kept = speed / 6;
  return circle;
}

TEST(Sailing, TurningCirclesAreThoseOfShips) {
  const TurningCircle ten = turn(10), twenty = turn(20), full = turn(35);
  const auto expect_within = [](double value, double low, double high) {
    EXPECT_GT(value, low);
    EXPECT_LT(value, high);
  };
  // A prototype of these laws had these ranges over C_d .4 to .8.
  expect_within(ten.steady_diameter, 8.1, 9.7);
  expect_within(twenty.steady_diameter, 4.4, 5.4);
  expect_within(full.steady_diameter, 2.2, 2.8);
  expect_within(full.tactical_diameter, 3.1, 3.8);
  expect_within(full.advance, 2.6, 2.9);
  expect_within(full.speed_kept, 0.36, 0.45);
  // What the IMO asks of ships (MSC.137(76)).
  EXPECT_LE(full.tactical_diameter, 5);
  EXPECT_LE(full.advance, 4.5);
}

}  // namespace
}  // namespace polynya::simulation
