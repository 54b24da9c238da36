// A ship in water: engine, rudder, mooring, the forces of water on the hull, and the control of lever and steering.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/ship/mooring.hpp"
#include "simulation/world/step.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

constexpr double kLength = 120;

/// Returns the reference ship alone in water.
Build in_water(const Propulsion& propulsion, double speed, double step = 0.05) {
  return Build().step(step).ship(scenes::in_water(icebreaker({60, 0}, propulsion, speed))).recorded_each_step();
}

/// Returns the samples that a run of that ship recorded, after checking that its accounts are closed.
std::vector<HullSample> sail(const Scene& scene, double until) {
  const Trial done = run(scene, until);
  EXPECT_TRUE(done.simulation.audit().is_closed());
  return done.story.samples;
}

Engine engine(double pull = 1e6, double speed = 8) {
  return {.bollard_pull = pull, .open_water_speed = speed, .propeller_area = 12};
}

/// Gives the only ship a motion, in her axes, before the first step.
void set_in_motion(dynamics::Planar motion, World& world) {
  dynamics::Bodies& bodies = world.population.bodies;
  bodies.velocity[0] = rotate(bodies.rotation[0], {motion.surge, motion.sway});
  bodies.angular_velocity[0] = motion.yaw;
  open_accounts(holdings(bodies, 0), world.accounts.audit);
}

dynamics::Planar motion_of(const World& world) {
  const dynamics::Bodies& b = world.population.bodies;
  const geometry::Vector v = rotate_back(b.rotation[0], b.velocity[0]);
  return {v.x, v.y, b.angular_velocity[0]};
}

/// Returns the kinetic energy of the ship and of the water that it sets in motion. Right after a step the ship has
/// turned but the water has not: the motion of the water is in the axes of before the step.
double wet_energy(const World& world) {
  const dynamics::Bodies& b = world.population.bodies;
  const dynamics::Planar now = motion_of(world);
  const geometry::Vector before = rotate(geometry::Rotation::by(now.yaw * world.clock.tick), {now.surge, now.sway});
  const dynamics::Planar in_water{before.x, before.y, now.yaw};
  return kinetic_energy(b) + 0.5 * dot(in_water, world.setup.sailing[0].hull.added_mass * in_water);
}

TEST(Sailing, NoEnergyComesFromNothing) {
  for (const double step : {0.005, 0.1, 1.0}) {
    for (const dynamics::Planar start :
         {dynamics::Planar{6, 0, 0}, {3, 2, 0.05}, {-4, 1, -0.08}, {0.1, 2, 0.1}, {0, 0, 0.15}}) {
      World world(in_water(ConstantThrust{0}, 0, step));
      set_in_motion(start, world);
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
  const std::vector<HullSample> samples = sail(in_water(ConstantThrust{0}, 6, 0.5), 3600);
  const double m = 1.05e7, d = 0.5 * 1000 * 0.004 * (1.7 * 120 * 6 + 0.579 * 120 * 24);
  for (std::size_t i = 1; i < samples.size(); ++i)
    ASSERT_LT(length(samples[i].velocity_in_world), length(samples[i - 1].velocity_in_world));
  // m v̇ = −d v²
  EXPECT_NEAR(length(samples.back().velocity_in_world), 6 / (1 + 6 * d / m * 3600), 0.01);
  EXPECT_NEAR(samples.back().position_in_world.x, m / d * std::log(1 + 6 * d / m * 3600), 20);
}

TEST(Sailing, AnEngineComesToItsOpenWaterSpeed) {
  const std::vector<HullSample> samples = sail(in_water(engine(), 0, 0.1), 900);
  EXPECT_NEAR(samples.back().velocity_in_world.x, 8, 0.005 * 8);
  EXPECT_NEAR(samples.back().thrust, 2 / 3.0 * 1e6, 0.005 * 1e6);
  EXPECT_NEAR(samples.front().thrust, 1e6, 1e3);
}

/// A plate ahead of the ship, with its larger part to port.
const geometry::Polygon kPlateAhead = rectangle(61, -60, 250, 80);

/// Σ of the forces on the ship by cause [N, N m], in the ship's axes.
dynamics::Planar sum_of_causes(const HullSample& s, bool has_engine) {
  return s.from_water + s.from_rudder + s.from_mooring + s.from_ice + s.from_ships + s.from_submerged +
         (has_engine ? s.from_engine : dynamics::Planar{s.thrust, 0, 0});
}

/// Steps a scene and compares what the causes gave in each step with the change of the ship's momentum.
void expect_balance(Scene scene, double until) {
  World world(scene);
  const dynamics::Bodies& b = world.population.bodies;
  const bool has_engine = std::holds_alternative<Engine>(scene.ships[0].propulsion);
  double largest = 0;
  dynamics::Planar carried;  // impulse that was missed before contacts were found, which is booked later
  while (world.clock.time() < until) {
    const geometry::Vector velocity = b.velocity[0];
    const double omega = b.angular_velocity[0], angle = b.angle[0];
    const geometry::Rotation rotation = b.rotation[0];
    const std::int64_t steps = world.accounts.counts.steps_taken;
    simulation::step(world);
    const HullSample& sample = world.journal.samples.back();
    const dynamics::Planar sum =
        sum_of_causes(sample, has_engine) + 1 / scene.time.step * (sample.carried + -1.0 * carried);
    carried = sample.carried;
    const geometry::Vector force = (b.mass[0] / scene.time.step) * (b.velocity[0] - velocity);
    const geometry::Vector in_ship = rotate_back(rotation, force);
    const double moment = b.moment[0] / scene.time.step * (b.angular_velocity[0] - omega);
    const dynamics::Planar& under = world.journal.samples.back().from_submerged;
    // Cusps brake at the end of the step, in axes that have turned. The later parts of a tick have turned as well.
    const bool has_parts = world.accounts.counts.steps_taken - steps > 1;
    const double turned =
        1e8 * std::abs(b.angle[0] - angle) * (std::hypot(under.surge, under.sway) + (has_parts ? length(force) : 0));
    const double size = 1e5 + length(force) + turned;
    ASSERT_NEAR(sum.surge, in_ship.x, 1e-8 * size) << world.clock.time();
    ASSERT_NEAR(sum.sway, in_ship.y, 1e-8 * size);
    ASSERT_NEAR(sum.yaw, moment, 1e-8 * size * kLength);
    largest = std::max(largest, length(force));
    world.journal.clear();
  }
  EXPECT_GT(largest, 1e4);
  const double stored = stored_in_moorings(world.setup, world.population, drift_at(world.setup, world.clock.time()));
  EXPECT_TRUE(audit(world.accounts.audit, holdings(b, stored)).is_closed());
}

TEST(Sailing, ForcesByCauseBalanceMassTimesAcceleration) {
  Scene scene = in_water(engine(1e6), 3, 0.01).drift({0.2, -0.1}).floe(rectangle(80, -60, 250, 80));
  scene.ships[0].steering = RudderSettings{.area = 13};
  scene.ships[0].heading = 0.3;
  scene.ships[0].mooring = moored({10, 3}, {1e4, 3e4, 1e8}, {1e5, 0, 0}, 6e5, 0.2);
  scene.fracture.going_under.is_enabled = true;
  expect_balance(scene, 20);
  expect_balance(in_water(ConstantThrust{4e5}, 2, 0.01).floe(kPlateAhead), 15);
}

TEST(Sailing, ARunGoesOnFromItsStateAsIfItHadNotStopped) {
  Scene scene = in_water(engine(), 2, 0.01).floe(kPlateAhead).recorded_every(0.3);
  scene.ships[0].mooring = moored({}, {}, {1e5, 0, 0}, 1e5);  // breaks at once
  const Trial again = expect_resumes(scene, 5, 8);
  EXPECT_TRUE(again.simulation.world().population.helms[0].is_adrift);
  const std::vector<HullSample> whole = sail(scene, 8), &resumed = again.story.samples;
  ASSERT_GT(resumed.size(), 5u);
  EXPECT_EQ(whole[whole.size() - resumed.size()].from_water, resumed.front().from_water);
}

/// A short blow from the side by a mass far smaller than the ship.
TEST(Sailing, TheWaterSharesABlow) {
  World world(in_water(ConstantThrust{0}, 0, 0.005).floe(rectangle(-10, 12.1, 10, 32.1), {0, -1}));
  while (world.clock.time() < 3) simulation::step(world);
  const dynamics::Bodies& b = world.population.bodies;
  const double given = b.mass[1] * (-1 - b.velocity[1].y);  // by the ship, and a little by the water
  const double wet_mass = 1e7 + world.setup.sailing[0].hull.added_mass.rows[1].sway;
  EXPECT_NEAR(b.velocity[0].y / (given / wet_mass), 1, 0.1);
  EXPECT_GT(wet_mass, 1.5e7);
}

TEST(Sailing, AMooringHoldsInACurrentAndBreaksAboveItsLoad) {
  Scene scene = in_water(ConstantThrust{0}, 0, 0.1).drift({0, 0.5});
  scene.ships[0].mooring = moored({}, {1e5, 1e5, 1e9}, {1e5, 5e5, 1e9});
  const auto [held, story_held] = run(scene, 600);
  const HullSample last = story_held.samples.back();
  const double drag = 0.5 * 1000 * 6 * 0.8 * 0.25 * kLength;  // ½ρ T C_d L v²
  EXPECT_NEAR(last.from_water.sway, drag, 0.01 * drag);
  EXPECT_NEAR(last.from_mooring.sway, -drag, 0.01 * drag);
  EXPECT_NEAR(last.position_in_world.y, drag / 1e5, 0.02);
  expect_closed(held);
  EXPECT_FALSE(held.world().population.helms[0].is_adrift);
  scene.ships[0].mooring->break_load = 0.5 * drag;
  const auto [broken, story_broken] = run(scene, 600);
  const HullSample after = story_broken.samples.back();
  EXPECT_TRUE(broken.world().population.helms[0].is_adrift);
  EXPECT_EQ(after.from_mooring, dynamics::Planar{});
  EXPECT_NEAR(after.velocity_in_world.y, 0.5, 0.1) << "the current carries it along";
}

/// One event where it breaks, whose force is stiffness times offset, above what the mooring holds; none after
/// a resume.
TEST(Sailing, AMooringBreaksInOneEventWithItsForceAndItsOffset) {
  Scene scene = in_water(ConstantThrust{2e5}, 0, 0.1).drift({0, 0.5});
  const double heading = 30 * kDegree, along = 1e5, across = 2e5;
  const geometry::Point moored_place = scene.ships[0].position_in_world;
  scene.ships[0].mooring = moored(moored_place, {along, across, 0}, {}, 3e5, heading);
  const auto [simulation, story] = run(scene, 200);
  const auto [time, ship, place, what] = only(story.of_kind<MooringBreak>());
  const auto& broken = std::get<MooringBreak>(what);
  EXPECT_EQ(ship, 0);
  EXPECT_EQ(time, simulation.world().population.helms[0].adrift_since);
  EXPECT_EQ(broken.break_load, 3e5);
  EXPECT_GT(broken.force, 3e5);
  EXPECT_LT(broken.force, 3.1e5) << "it breaks in the first step above its load";
  const geometry::Vector offset = broken.offset_in_moored_place;
  EXPECT_NEAR(broken.force, std::hypot(along * offset.x, across * offset.y), 1e-6 * broken.force);
  const geometry::Vector in_world = rotate(geometry::Rotation::by(heading), offset);
  EXPECT_NEAR(distance(place, moored_place + in_world), 0, 1e-9);
  const auto row = std::ranges::upper_bound(story.samples, time - 0.5 * scene.time.step, {}, &HullSample::time);
  // The row has the mean of the step, the event the force at its end: Δt/2 · K v less.
  EXPECT_NEAR(std::hypot(row->from_mooring.surge, row->from_mooring.sway), broken.force, 0.5 * 0.1 * 2e5 * 0.5);
  EXPECT_NEAR(distance(row->position_in_world, place), 0, 1e-9);
  EXPECT_TRUE(expect_resumes(scene, 200, 210).story.of_kind<MooringBreak>().empty());
}

/// In lengths of the ship.
struct TurningCircle {
  double steady_diameter = 0;
  double tactical_diameter = 0;  ///< across the course at 180°
  double advance = 0;            ///< along it at 90°
  double speed_kept = 0;         ///< share of the first speed that is kept [-]
};

/// A turn at a rudder angle [°] from 6 m/s, at the thrust that holds that speed.
TurningCircle turn(double rudder_angle) {
  Scene scene = in_water(engine(314e3, 6), 6, 0.1);
  scene.ships[0].steering = RudderSettings{.area = 0.018 * kLength * 6};
  scene.ships[0].pilot = ConstantPilot{1, rudder_angle * kDegree};
  World world(scene);
  while (world.clock.time() < 2500) step(world);
  TurningCircle circle;
  const std::vector<HullSample>& samples = world.journal.samples;
  const geometry::Point start = samples.front().position_in_world;
  for (const HullSample& s : samples) {
    const geometry::Vector off = s.position_in_world - start;
    if (circle.advance == 0 && s.heading > M_PI / 2) circle.advance = off.x / kLength;
    if (circle.tactical_diameter == 0 && s.heading > M_PI) circle.tactical_diameter = off.y / kLength;
  }
  const HullSample& last = samples.back();
  const double speed = length(last.velocity_in_world);
  circle.steady_diameter = 2 * speed / last.yaw_rate / kLength;
  circle.speed_kept = speed / 6;
  return circle;
}

TEST(Sailing, TurningCirclesAreThoseOfShips) {
  const TurningCircle full = turn(35);
  const auto expect_within = [](double value, double low, double high) {
    EXPECT_GT(value, low);
    EXPECT_LT(value, high);
  };
  // docs/validation.md has the values. The IMO asks of ships a tactical diameter of 5 and an advance of 4.5
  // (MSC.137(76)).
  expect_within(turn(10).steady_diameter, 8.4, 10.0);
  expect_within(turn(20).steady_diameter, 4.8, 5.7);
  expect_within(full.steady_diameter, 2.6, 3.2);
  expect_within(full.tactical_diameter, 3.4, 4.2);
  expect_within(full.advance, 2.8, 3.4);
  expect_within(full.speed_kept, 0.45, 0.55);
}

/// A ship under steady commands, lever ahead and any rudder angle, neither goes astern nor is faster than straight
/// ahead at full power.
TEST(Sailing, NoSteadyCommandMakesAShipGoAsternOrTooFast) {
  const RudderSettings single{.area = 0.018 * kLength * 6, .most = M_PI / 2};
  const RudderSettings large{.area = 0.07 * kLength * 6, .most = M_PI / 2};
  Engine twin = engine();
  twin.propellers = 2;
  for (const auto& [engine, rudder] : {std::pair{engine(), single}, {twin, single}, {twin, large}})
    for (const double lever : {0.2, 1.0})
      for (const double degrees : {0, 20, 35, 45, 60, 70, 80, 90}) {
        Scene scene = in_water(engine, 0, 0.2).recorded_every(10);
        scene.ships[0].steering = rudder;
        scene.ships[0].pilot = ConstantPilot{lever, degrees * kDegree};
        const std::vector<HullSample> samples = sail(scene, 900);
        // Rudders of four times the usual area at 80 degrees leave the ship almost no thrust. She turns on the spot,
        // about a point ahead of her centre. The sway of this motion moves the centre astern at some decimetres a
        // second.
        const double astern_by_turning = rudder.area > single.area ? -0.5 : -1e-3;
        const auto ahead = [](const HullSample& s) {
          return dot(s.velocity_in_world, geometry::Vector{std::cos(s.heading), std::sin(s.heading)});
        };
        SCOPED_TRACE(testing::Message() << engine.propellers << " propellers, " << rudder.area << " m², lever " << lever
                                        << ", " << degrees << "°");
        for (const HullSample& s : samples) {
          ASSERT_GE(ahead(s), astern_by_turning) << s.time << " s";
          ASSERT_GE(s.thrust + s.from_rudder.surge, 0) << s.time << " s";
          ASSERT_LT(length(s.velocity_in_world), 8) << s.time << " s";
        }
      }
}

// ---- pilots

Build piloted(const PilotSettings& pilot, double speed = 4, const Steering& steering = RudderSettings{13}) {
  Build scene = in_water(kEngine, speed, 0.1).recorded_every(1);
  scene.ships[0].steering = steering;
  scene.ships[0].pilot = pilot;
  return scene;
}

TEST(Pilot, LeverAndRudderMoveAtTheirRates) {
  Scene scene = piloted(TablePilot{{{0, 0, 0}, {10, 0, 0}, {10.001, 1, 35 * kDegree}}});
  std::get<Engine>(scene.ships[0].propulsion).lever_rate = 0.02;
  const std::vector<HullSample> samples = sail(scene, 80);
  EXPECT_EQ(samples[8].lever, 0);
  EXPECT_NEAR(samples[19].lever, 0.2, 0.01);                       // 10 s later
  EXPECT_NEAR(samples[14].steering_angle, 15 * kDegree, kDegree);  // 5 s at 3 °/s
  EXPECT_NEAR(samples.back().lever, 1, 1e-12);
  EXPECT_NEAR(samples.back().steering_angle, 35 * kDegree, 1e-12);
  EXPECT_NEAR(samples.back().delivered_power, 12e6, 1);
}

TEST(Pilot, ByTheClockItIsLinearBetweenRows) {
  const auto samples = sail(piloted(TablePilot{{{0, -0.2, 0}, {100, 0.8, 10 * kDegree}}}), 120);
  EXPECT_NEAR(samples[49].lever, 0.3, 0.01);
  EXPECT_NEAR(samples[49].steering_angle, 5 * kDegree, 0.2 * kDegree);
  EXPECT_NEAR(samples.back().lever, 0.8, 1e-12);
}

TEST(Pilot, HoldsASpeedAlsoAgainstAResistance) {
  for (const double damping : {0.0, 1e5}) {
    Scene scene = piloted(SpeedPilot{.speed = 3}, 0);
    scene.ships[0].mooring = moored({}, {}, {damping, 0, 0});
    const std::vector<HullSample> samples = sail(scene, 600);
    EXPECT_NEAR(samples.back().velocity_in_world.x, 3, 0.01);
    for (const HullSample& s : samples) EXPECT_LT(s.velocity_in_world.x, 3.3);
  }
}

TEST(Pilot, StopsAShipAstern) {
  const std::vector<HullSample> samples = sail(piloted(SpeedPilot{.speed = 0}, 6), 300);
  EXPECT_LT(samples[20].lever, -0.1);
  EXPECT_NEAR(length(samples.back().velocity_in_world), 0, 0.05);
}

TEST(Pilot, HoldsAHeadingByRudderAndByThrusters) {
  for (const Steering& steering : {Steering{RudderSettings{13}}, Steering{AzimuthSettings{}}}) {
    const auto samples = sail(piloted(HeadingPilot{.heading = 40 * kDegree, .lever = 0.5}, 4, steering), 500);
    for (const HullSample& s : samples) EXPECT_LT(s.heading, 45 * kDegree);
    EXPECT_NEAR(samples.back().heading, 40 * kDegree, 0.5 * kDegree);
    EXPECT_NEAR(samples.back().yaw_rate, 0, 1e-4);
  }
}

const RoutePilot kRoute{{{{800, 0}, 4}, {{1400, 600}, 3}, {{2400, 600}, 4}}};

TEST(Pilot, FollowsARouteAndStops) {
  const std::vector<HullSample> samples = sail(piloted(kRoute), 1500);
  for (const Waypoint& waypoint : kRoute.waypoints)
    EXPECT_TRUE(std::ranges::any_of(samples, [&](const HullSample& s) {
      return distance(s.position_in_world, waypoint.position_in_world) < kLength;
    }));
  for (const HullSample& s : samples)
    if (s.position_in_world.x > 2000 && s.position_in_world.x < 2280) {
      EXPECT_NEAR(s.position_in_world.y, 600, 0.1 * kLength);
    }
  EXPECT_LT(length(samples.back().velocity_in_world), 0.1);
  EXPECT_LT(distance(samples.back().position_in_world, {2400, 600}), 4 * kLength);
}

TEST(Pilot, MakesGoodADriftAcrossItsRoute) {
  double last = 0;
  for (const HullSample& s : sail(piloted(RoutePilot{{{{4000, 0}, 4}}}).drift({0, 0.5}), 900))
    if (s.position_in_world.x < 3800) last = s.position_in_world.y;
  EXPECT_NEAR(last, 0, 4);
}

TEST(Pilot, FollowsAShipAtADistance) {
  Ship follower = piloted(FollowingPilot{"icebreaker", 0, 100}, 3).ships[0];
  follower.name = "follower";
  follower.position_in_world = {-400, 30};
  const auto samples = sail(piloted(SpeedPilot{.speed = 3}, 3).ship(follower), 900);
  const geometry::Point leader = samples[samples.size() - 2].position_in_world;
  const geometry::Point behind = samples.back().position_in_world;
  EXPECT_NEAR(leader.x - behind.x - kLength, 100, 5);
  EXPECT_NEAR(behind.y, leader.y, 5);
}

TEST(Pilot, OneFromOutsideTakesThePlaceOfTheScenes) {
  Simulation simulation(piloted(ConstantPilot{1, 0}));
  std::vector<double> times;
  simulation.set_pilot(0, [&](const PilotView& view) {
    times.push_back(view.time);
    return Command{2, -10};  // beyond the stops
  });
  const Story story = run(simulation, 60);
  EXPECT_EQ(times.size(), 600U);
  EXPECT_EQ(story.samples.back().lever, 1);
  EXPECT_NEAR(story.samples.back().steering_angle, -35 * kDegree, 1e-12);
  EXPECT_LT(story.samples.back().heading, -0.1);
  simulation.set_pilot(0, {});
  EXPECT_NEAR(run(simulation, 100).samples.back().steering_angle, 0, 1e-12);
}

/// 10° of rudder to either side, laid over whenever the heading has changed by 10°.
/// [IMO2002] at L/V = 20 s: overshoots of at most 15° and 32.5°, and the first 10° within 2.5 L.
TEST(Pilot, ZigZagsAsShipsDo) {
  Scene scene = piloted(ConstantPilot{}, 6);
  scene.ships[0].propulsion = engine(314e3, 6);
  Simulation simulation(scene);
  std::vector<double> overshoots;  // [°]
  double side = 1, most = 0, first_turn = 0;
  simulation.set_pilot(0, [&](const PilotView& view) {
    const double heading = view.own().heading / kDegree;
    most = std::max(most, -side * heading);
    if (side * heading >= 10) {
      if (first_turn == 0)
        first_turn = distance(view.own().position_in_world, {0, 0});
      else
        overshoots.push_back(most - 10);
      side = -side;
      most = 0;
    }
    return Command{1, side * 10 * kDegree};
  });
  run(simulation, 800);
  ASSERT_GE(overshoots.size(), 3U);
  EXPECT_GT(overshoots[0], 1);
  EXPECT_LT(overshoots[0], 15);
  EXPECT_LT(overshoots[1], 32.5);
  EXPECT_LT(first_turn, 2.5 * kLength);
}

TEST(Pilot, GoesOnFromItsState) {
  const Simulation again = expect_resumes(piloted(kRoute), 250, 400).simulation;
  EXPECT_GT(again.world().population.helms[0].memory.waypoint, 0);
}

// ---- prescribed speeds, and several ships

TEST(ConstantSpeed, IsKeptExactlyAndTheForcesAreWhatItTakes) {
  const Scene scene =
      Build().unbreakable().without_drag().ship(icebreaker({0, 0}, ConstantSpeed{1.25})).grid({1, -40}, 3, 6, 10, 13.5);
  const auto [simulation, story] = run(scene, 20);
  geometry::Vector impulse, given;
  for (const HullSample& sample : story.samples) {
    ASSERT_EQ(sample.velocity_in_world, (geometry::Vector{1.25, 0}));
    ASSERT_EQ(sample.heading, 0);
    ASSERT_EQ(sample.yaw_rate, 0);
    ASSERT_EQ(sample.thrust, -sample.from_ice.surge);
    impulse += scene.record.forces_interval * geometry::Vector{sample.from_ice.surge, sample.from_ice.sway};
  }
  // Newton's third law: the impulse of the ice on the ship is opposite to the impulse of the ship on the floes.
  for (const FloeState& state : simulation.floe_states()) given += state.mass * state.velocity;
  EXPECT_GT(given.x, 1e4);
  EXPECT_NEAR(impulse.x / given.x, -1, 1e-9);
  EXPECT_NEAR(impulse.y, -given.y, 1e-9 * given.x);
  EXPECT_NEAR(simulation.ship_states()[0].world_from_ship.position.x, -60 + 1.25 * simulation.time(), 1e-9);
}

TEST(Ships, SeveralDoNotDisturbOneAnother) {
  // The same ship and ice, alone and with another ship at work 2 km away, give the same numbers to the last bit. The
  // steps have one length, because parts of a tick are taken by the whole world.
  Build scene = Build().ship(icebreaker({0, 0}, ConstantThrust{2e4})).floe(rectangle(0.5, -40, 40.5, 40));
  const Story alone = run(scene, 8).story;
  const Story both =
      run(scene.ship(icebreaker({0, 2000}, ConstantSpeed{2})).floe(rectangle(1.5, 1960, 50, 2040)), 8).story;
  ASSERT_EQ(both.samples.size(), 2 * alone.samples.size());
  for (std::size_t i = 0; i < alone.samples.size(); ++i) {
    ASSERT_EQ(both.samples[2 * i].ship, 0);
    ASSERT_EQ(both.samples[2 * i].from_ice.surge, alone.samples[i].from_ice.surge) << i;
    ASSERT_EQ(both.samples[2 * i].position_in_world, alone.samples[i].position_in_world) << i;
    ASSERT_EQ(both.samples[2 * i].from_ice_largest.surge, alone.samples[i].from_ice_largest.surge) << i;
  }
  for (const int ship : {0, 1}) EXPECT_GT(largest(both, &HullSample::from_ice, ship), 0);
  EXPECT_TRUE(std::ranges::any_of(both.events, [](const Event& e) { return e.ship == 1; }));
}

}  // namespace
}  // namespace polynya::simulation
