// Moorings: their oscillation compared with its exact solution, at any stiffness and step, and the account of the
// energy that they store.
#include "simulation/ship/mooring.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "simulation/world/default_tick.hpp"
#include "simulation/world/step.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using dynamics::Planar;
using geometry::Vector;

constexpr double kMass = 1e7;    // [kg]
constexpr double kMoment = 5e9;  // [kg m²]

/// Stiffness of a period [s] in all three directions, or damping of a share of the critical one.
Planar stiffness_of(double period) {
  const double omega = 2 * std::numbers::pi / period;
  return {kMass * omega * omega, kMass * omega * omega, kMoment * omega * omega};
}
Planar damping_of(double period, double share) {
  const double rate = 2 * share * 2 * std::numbers::pi / period;
  return {kMass * rate, kMass * rate, kMoment * rate};
}

/// Returns a ship alone, at rest over ground, displaced from its moored place by 1 m along, −2 m across and 0.1 rad in
/// heading.
constexpr Planar kOff{1, -2, 0.1};
constexpr double kMooredHeading = 0.4;

Build off_its_place(double step, const Planar& stiffness, const Planar& damping = {}, double break_load = 0) {
  Ship ship = icebreaker({60, 0}, ConstantThrust{0}, 0);
  ship.heading = kMooredHeading + kOff.yaw;
  const Vector off = rotate(geometry::Rotation::by(kMooredHeading), {kOff.surge, kOff.sway});
  ship.mooring = moored(ship.position_in_world - off, stiffness, damping, break_load, kMooredHeading);
  return Build().step(step).ship(ship);
}

Planar offset_of(const World& world) {
  const dynamics::Bodies& bodies = world.population.bodies;
  const Offset offset = offset_from(*world.setup.scene.ships[0].mooring,
                                    bodies.position[0] + drift_at(world.setup, world.clock.time()), bodies.angle[0]);
  return {offset.shift.x, offset.shift.y, offset.turn};
}

double energy_of(const World& world) {
  return kinetic_energy(world.population.bodies) +
         stored_in_moorings(world.setup, world.population, drift_at(world.setup, world.clock.time()));
}

/// The largest of the three, each as a share of its offset at the start.
double size_of(const Planar& offset) {
  return std::max(
      {std::abs(offset.surge / kOff.surge), std::abs(offset.sway / kOff.sway), std::abs(offset.yaw / kOff.yaw)});
}

TEST(Mooring, KeepsItsEnergyAndItsAmplitudeOverTenPeriodsAtTheDefaultTick) {
  constexpr double kPeriod = 20;
  Scene scene = off_its_place(0.1, stiffness_of(kPeriod));
  scene.time.step = default_tick(scene);
  World world(scene);
  const double energy = energy_of(world);
  EXPECT_NEAR(energy, 0.5 * (stiffness_of(kPeriod).surge * 5 + stiffness_of(kPeriod).yaw * 0.01), 1e-9 * energy);
  double last_of = 0;
  while (world.clock.time() < 10 * kPeriod) {
    step(world);
    ASSERT_NEAR(energy_of(world) / energy, 1, 1e-10) << world.clock.time();
    if (world.clock.time() > 9 * kPeriod) last_of = std::max(last_of, std::abs(offset_of(world).sway / kOff.sway));
  }
  EXPECT_NEAR(last_of, 1, 0.001);
}

/// The largest error after a time, as a share of the offset at the start, against
/// x = e^(−γt) (cos ω't + γ/ω' sin ω't) x₀, γ = ζω, ω' = √(1 − ζ²) ω.
double error_after(double time, double period, double share, double step_length) {
  const double omega = 2 * std::numbers::pi / period, gamma = share * omega,
               root = std::sqrt(1 - share * share) * omega;
  World world(off_its_place(step_length, stiffness_of(period), damping_of(period, share)));
  while (world.clock.time() < time - 1e-9) step(world);
  const double exact = std::exp(-gamma * time) * (std::cos(root * time) + gamma / root * std::sin(root * time));
  return size_of(offset_of(world) - exact * kOff);
}

TEST(Mooring, IsOfSecondOrderInTime) {
  for (const double share : {0.0, 0.05, 0.7}) {
    double before = error_after(33, 20, share, 1);
    for (const double length : {0.5, 0.25, 0.125}) {
      const double now = error_after(33, 20, share, length);
      EXPECT_NEAR(before / now, 4, 0.25) << share << ' ' << length;
      before = now;
    }
  }
}

TEST(Mooring, TheSameOverGroundInAnyDrift) {
  const auto after = [](Vector drift) {
    Build scene = off_its_place(0.1, stiffness_of(20), damping_of(20, 0.05)).drift(drift);
    World world(scene);
    while (world.clock.time() < 33) step(world);
    return offset_of(world);
  };
  EXPECT_NEAR(size_of(after({}) - after({0.5, -0.2})), 0, 1e-9);
}

/// The energy never grows for any stiffness, with periods of two steps and of much less than a step.
TEST(Mooring, OfAnyStiffnessNeitherGainsEnergyNorLeavesItsBounds) {
  for (const double period : {4.0, 1.0, 0.1, 1e-3, 1e-6}) {
    World world(off_its_place(0.5, stiffness_of(period)));
    const double energy = energy_of(world);
    for (int i = 0; i < 3000; ++i) {
      step(world);
      ASSERT_NEAR(energy_of(world) / energy, 1, 1e-8) << period << ' ' << i;
      ASSERT_LT(size_of(offset_of(world)), 1 + 1e-6);
    }
  }
}

/// This is the same test with water around the hull and with a damper. Both take energy for any stiffness.
TEST(Mooring, OfAnyStiffnessLosesEnergyToWaterAndDampers) {
  for (const double period : {20.0, 4.0, 0.5, 1e-3}) {
    for (const double share : {0.0, 0.3}) {
      Scene scene = off_its_place(0.5, stiffness_of(period), damping_of(period, share));
      scene.ships[0] = scenes::in_water(scene.ships[0]);
      World world(scene);
      const double energy = energy_of(world);
      for (int i = 0; i < 3000; ++i) {
        step(world);
        ASSERT_LT(energy_of(world), energy * (1 + 1e-9)) << period << ' ' << share << ' ' << i;
      }
      // If the period is much shorter than a step, a damped oscillation fades in about ωΔt/(2ζ) steps.
      const double left = share == 0 ? 0.9999 : period < 0.1 ? 0.8 : 0.01;
      EXPECT_LT(energy_of(world), left * energy) << period << ' ' << share;
    }
  }
}

/// A damper that stops a ship in much less than a step stops it without sending it back.
TEST(Mooring, AStiffDamperStopsAndDoesNotReverse) {
  for (const double factor : {1.0, 3.0, 1e3, 1e9}) {
    Ship ship = icebreaker({60, 0}, ConstantThrust{0}, 2);
    ship.mooring = moored(ship.position_in_world, {}, factor / 0.5 * Planar{kMass, kMass, kMoment});
    World world(Build().step(0.5).ship(ship));
    step(world);
    const double speed = world.population.bodies.velocity[0].x;
    EXPECT_GE(speed, -1e-9) << factor;
    EXPECT_NEAR(speed, factor < 2 ? 2 / 3.0 : 0, 1e-9) << factor;
    for (int i = 0; i < 20; ++i) step(world);
    EXPECT_NEAR(world.population.bodies.velocity[0].x, 0, 1e-6) << factor;
  }
}

/// A steady force holds the ship where the spring's force has the same size. Between two steps the velocity is −½Δt
/// F/m.
TEST(Mooring, AShipUnderAConstantForceStandsWhereTheSpringHasIt) {
  Ship ship = icebreaker({60, 0}, ConstantThrust{1e6}, 0);
  ship.mooring = moored(ship.position_in_world, stiffness_of(20), damping_of(20, 1));
  const Trial done = run(Build().step(0.1).ship(ship), 300);
  EXPECT_NEAR(offset_of(done.simulation.world()).surge, 1e6 / stiffness_of(20).surge, 1e-9);
  EXPECT_NEAR(done.simulation.world().population.bodies.velocity[0].x, -0.5 * 0.1 * 1e6 / kMass, 1e-9);
  expect_closed(done.simulation);
}

// ---- accounts

/// Checks that the energy stored in moorings equals the energy at the start plus the energy that entered minus the
/// energy that left.
void expect_stored_is_accounted(const Simulation& simulation) {
  const Audit audit = simulation.audit();
  const MooringFlows& m = audit.sums.moorings;
  const double turnover = m.initial + m.taken_up + m.given_back;
  EXPECT_NEAR(audit.stored_energy, m.initial + m.taken_up - m.given_back + m.separation - m.breaking, 1e-10 * turnover);
}

/// A ship in water that is moored away from its place, in ice that drifts onto it.
Build in_drifting_ice(Laws laws) {
  Ship ship = scenes::in_water(icebreaker({60, 0}, ConstantThrust{0}, 0));
  ship.mooring = moored(ship.position_in_world - Vector{2, 1}, {1e6, 1e6, 5e9}, {2e5, 2e5, 1e9}, 0, 0.1);
  Build scene = Build(laws).step(0.05).drift({-0.5, 0.1}).ship(ship).floe(rectangle(61, -50, 160, 60));
  for (int i = 0; i < 8; ++i) scene.floe(rectangle(-60 + 12 * i, -25, -50 + 12 * i, -14), {0, 0.3});
  return scene;
}

TEST(MooringAccounts, CloseInDriftingIceByBothLaws) {
  for (const Laws laws : kBothLaws) {
    const Trial done = run(in_drifting_ice(laws), 60);
    EXPECT_FALSE(done.story.bends().empty());
    expect_closed(done.simulation);
    expect_stored_is_accounted(done.simulation);
    const MooringFlows& m = done.simulation.audit().sums.moorings;
    EXPECT_NEAR(m.initial, 0.5 * (1e6 * 5 + 5e9 * 0.01), 1e-3);
    EXPECT_GT(m.taken_up, 1e5);
    EXPECT_GT(m.given_back, 1e5);
    EXPECT_GT(m.damping, 1e3);
    EXPECT_NE(m.ground, 0) << "the anchors move through the water's frame";
    EXPECT_EQ(m.breaking, 0);
    EXPECT_EQ(m.separation != 0, laws == Laws::kPaper) << "only the law of impulses pushes apart";
  }
}

TEST(MooringAccounts, AMooringThatBreaksLosesWhatItStored) {
  Scene scene = in_drifting_ice(Laws::kDefault);
  scene.ships[0].mooring->position_in_world = scene.ships[0].position_in_world;
  scene.ships[0].mooring->break_load = 4e5;
  const Trial done = run(scene, 60);
  const Event event = only(done.story.of_kind<MooringBreak>());
  const Vector off = std::get<MooringBreak>(event.what).offset_in_moored_place;
  const Audit audit = done.simulation.audit();
  const double by_place = 0.5 * 1e6 * squared_length(off);
  EXPECT_GE(audit.sums.moorings.breaking, by_place * (1 - 1e-9));
  EXPECT_LT(audit.sums.moorings.breaking, by_place + 0.5 * 5e9 * 0.2 * 0.2) << "and what its turn stored";
  EXPECT_EQ(audit.stored_energy, 0);
  expect_closed(done.simulation);
  expect_stored_is_accounted(done.simulation);
}

/// The force that breaks the mooring is the sum of spring and damper, each in the axes of the moored heading.
TEST(Mooring, BreaksByItsSpringAndItsDamper) {
  Ship ship = icebreaker({60, 0}, ConstantThrust{0}, 2);
  const auto heading = geometry::Rotation::by(kMooredHeading);
  ship.mooring =
      moored(ship.position_in_world - rotate(heading, {1, 2}), {1e5, 2e5, 0}, {1e5, 3e5, 0}, 1e5, kMooredHeading);
  const Trial done = run(Build().step(0.01).ship(ship), 0.02);
  const Vector v = rotate_back(heading, {2, 0});
  const double force = std::hypot(1e5 * 1 + 1e5 * v.x, 2e5 * 2 + 3e5 * v.y);
  const MooringBreak broken = std::get<MooringBreak>(only(done.story.of_kind<MooringBreak>()).what);
  EXPECT_NEAR(broken.force / force, 1, 0.02);
}

TEST(MooringAccounts, GoOnFromASavedState) {
  const Scene scene = in_drifting_ice(Laws::kDefault);
  const Trial resumed = expect_resumes(scene, 20, 30);
  const Trial whole = run(scene, 30);
  const Audit a = resumed.simulation.audit(), b = whole.simulation.audit();
  EXPECT_EQ(a.turnover, b.turnover);
  EXPECT_EQ(a.momentum_turnover, b.momentum_turnover);
  EXPECT_EQ(a.sums.moorings.taken_up, b.sums.moorings.taken_up);
  EXPECT_EQ(a.sums.moorings.damping, b.sums.moorings.damping);
  expect_closed(resumed.simulation);
}

/// Energies of MJ go back and forth and add up to nothing. The imbalance is compared with the energy that was
/// exchanged, not with the rest.
TEST(MooringAccounts, AShipThatIsAloneForTenMinutesRaisesNoAlarm) {
  for (const double share : {0.0, 0.02}) {
    Simulation simulation(off_its_place(0.1, stiffness_of(20), damping_of(20, share)));
    while (simulation.time() < 600) {
      skip(simulation);
      ASSERT_TRUE(simulation.audit().is_closed()) << simulation.time();
    }
    const Audit audit = simulation.audit();
    EXPECT_GT(audit.turnover, share > 0 ? 2 * audit.sums.moorings.initial : 30 * audit.sums.moorings.initial);
    expect_closed(simulation);
  }
}

TEST(MooringAccounts, AShipThatIsMovedByNothingRaisesTheAlarm) {
  Simulation simulation(off_its_place(0.1, stiffness_of(20)));
  skip(simulation, 100);
  ASSERT_TRUE(simulation.audit().is_closed());
  const_cast<World&>(simulation.world()).population.bodies.position[0].x += 1e-3;
  EXPECT_FALSE(simulation.audit().is_closed());
}

}  // namespace
}  // namespace polynya::simulation
