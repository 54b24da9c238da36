// Ships that manage ice: where their patterns lead, that they follow them, and a drift that changes.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/ship/pattern.hpp"
#include "simulation/world/step.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Point;
using geometry::Vector;

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr double kFar = 1500;        ///< of a pattern from the body [m]
constexpr double kWide = 800;        ///< across the drift [m]
constexpr double kPatternSpeed = 4;  ///< along the pattern [m/s]

ManagingPilot managing(ManagementPattern pattern, double depth = 0) {
  ManagingPilot pilot;
  pilot.pattern = pattern;
  pilot.distance = kFar;
  pilot.width = kWide;
  pilot.depth = depth;
  pilot.speed = kPatternSpeed;
  return pilot;
}

/// An icebreaker that can be steered, at a place of the pattern of a body at (0, 0), which is hull `body`.
Ship manager(ManagingPilot pilot, int body, Vector drift) {
  const PatternLine line = line_of(pilot);
  pilot.body_index = body;
  const Vector upstream = -drift / length(drift);
  const Vector at = pilot.pattern == ManagementPattern::kLargestFloe ? Vector{pilot.distance, 0}
                                                                     : line.at(pilot.phase * line.lap()) - Point{};
  const Vector ahead = line.direction(line.leg_at(pilot.phase * line.lap()));
  const auto over_ground = [&](Vector v) { return v.x * upstream + v.y * perpendicular(upstream); };
  Ship ship = icebreaker({}, Engine{.bollard_pull = 1e6, .open_water_speed = 8, .power = 12e6, .propeller_area = 25},
                         kPatternSpeed);
  ship.position_in_world = Point{} + over_ground(at);
  const Vector course = over_ground(ahead);
  ship.heading = std::atan2(course.y, course.x);
  ship.hull.draught = 6;
  ship.water.acts = true;
  ship.water.block_coefficient = 0.579;
  ship.steering = RudderSettings{13};
  ship.pilot = pilot;
  return ship;
}

Build managed(const std::vector<ManagingPilot>& pilots, Vector drift) {
  Build scene = Build().step(0.1).drift(drift);
  for (const ManagingPilot& pilot : pilots) scene.ship(manager(pilot, static_cast<int>(pilots.size()), drift));
  scene.pile({}, 20);
  scene.record.forces_interval = 1;
  return scene;
}

/// The distance of a place from a closed line [m].
double off_line(const PatternLine& line, Point place) {
  double least = 1e9;
  for (std::size_t i = 0; i < line.corners.size(); ++i)
    least = std::min(least, distance_to_segment(place, line.corners[i], line.corners[line.next(i)]));
  return least;
}

// ---- where patterns lead

TEST(Pattern, LapsAreAsLongAsTheirForms) {
  const auto lap = [](ManagementPattern pattern, double depth) { return line_of(managing(pattern, depth)).lap(); };
  using P = ManagementPattern;
  EXPECT_NEAR(lap(P::kLinear, 0), 2 * kWide, 1e-9);
  EXPECT_NEAR(lap(P::kLinear, 100), 2 * kWide + 200, 1e-9);
  EXPECT_NEAR(lap(P::kCircular, kWide) / (0.5 * kTwoPi * kWide), 1, 0.002);
  EXPECT_NEAR(lap(P::kRacetrack, 200) / (2 * (kWide - 200) + 0.5 * kTwoPi * 200), 1, 0.002);
  EXPECT_NEAR(lap(P::kSector, 0) / (2 * kWide), 1, 0.002);
  // Out at the radius of the far arc, back at the near one.
  EXPECT_NEAR(lap(P::kSector, 100) / (2 * kWide + 200), 1, 0.002);
}

TEST(Pattern, TheirBoxesAreWidthByDepthAboutTheMiddle) {
  using P = ManagementPattern;
  for (const auto& [pattern, depth] : {std::pair{P::kLinear, 100.0}, {P::kCircular, 500.0}, {P::kRacetrack, 300.0}}) {
    const geometry::Box box = bounding_box(line_of(managing(pattern, depth)).corners);
    EXPECT_NEAR(box.low.x, kFar - 0.5 * depth, 1e-9);
    EXPECT_NEAR(box.high.x, kFar + 0.5 * depth, 1e-9);
    EXPECT_NEAR(box.low.y, -0.5 * kWide, 1e-9);
    EXPECT_NEAR(box.high.y, 0.5 * kWide, 1e-9);
  }
  for (const Point corner : line_of(managing(P::kSector)).corners) EXPECT_NEAR(length(corner - Point{}), kFar, 1e-9);
}

TEST(Pattern, ALapGoesRoundOnceAndPlacesAreInOrder) {
  const PatternLine line = line_of(managing(ManagementPattern::kRacetrack, 200));
  for (int i = 0; i < 200; ++i) {
    const double place = line.lap() * i / 200;
    EXPECT_NEAR(off_line(line, line.at(place)), 0, 1e-9);
    EXPECT_NEAR(distance(line.at(place), line.at(std::fmod(place + 1, line.lap()))), 1, 0.05);
  }
}

/// A ship that goes along a line for ever sweeps a band of its breadth. The share of the ice within the
/// pattern's width, as it drifts past, that the band of laps of a period covers.
double swept_share(const PatternLine& line, double drift, double speed, double band) {
  const double period = line.lap() / speed;
  constexpr int kPlaces = 1000, kCells = 40;
  // The whole pattern passes over the ice that is looked at.
  const geometry::Box box = bounding_box(line.corners);
  const int laps = 6 + static_cast<int>((box.high.x - box.low.x) / (drift * period));
  int swept = 0, all = 0;
  for (int i = 0; i < kCells; ++i) {
    for (int k = 0; k < kCells; ++k) {
      // Ice that passes the middle of the pattern during the laps in the middle.
      const double y = kWide * ((k + 0.5) / kCells - 0.5);
      const double lag = period * (0.5 * laps + (i + 0.5) / kCells);
      bool is_swept = false;
      for (int step = 0; step < laps * kPlaces && !is_swept; ++step) {
        const double t = period * step / kPlaces;
        const Point ship = line.at(std::fmod(speed * t, line.lap()));
        is_swept = std::abs(ship.x - (kFar - drift * (t - lag))) <= 0.5 * band && std::abs(ship.y - y) <= 0.5 * band;
      }
      swept += is_swept;
      ++all;
    }
  }
  return static_cast<double>(swept) / all;
}

TEST(Pattern, TheLinearOneLeavesNoGapsWhileDriftTimesPeriodIsWithinTheBand) {
  const PatternLine line = line_of(managing(ManagementPattern::kLinear));
  const double period = line.lap() / kPatternSpeed;
  const double drift = 0.25;
  const double spacing = drift * period;  // of two passes at an end of the line: 100 m
  EXPECT_EQ(swept_share(line, drift, kPatternSpeed, 1.05 * spacing), 1);
  // Passes at a place y are at y/W and 1 − y/W of half periods: a band of b leaves |gap − b| of both gaps,
  // spacing (½ ± y/W). Of the mean over y that is (1 − b/spacing)².
  const double half = swept_share(line, drift, kPatternSpeed, 0.5 * spacing);
  EXPECT_NEAR(half, 0.75, 0.06);
}

TEST(Pattern, TheCircleLeavesNoGapsInItsMiddleWhileDriftTimesPeriodIsWithinTheBand) {
  const PatternLine line = line_of(managing(ManagementPattern::kCircular, kWide));
  const double drift = 0.16, spacing = drift * line.lap() / kPatternSpeed;
  EXPECT_EQ(swept_share(line, drift, kPatternSpeed, 1.05 * spacing), 1);
  EXPECT_LT(swept_share(line, drift, kPatternSpeed, 0.2 * spacing), 0.95);
}

TEST(Pattern, ShipsOfTwoPhasesComeAsNearAsTheFormsAllow) {
  EXPECT_NEAR(least_distance(line_of(managing(ManagementPattern::kCircular, kWide)), 0.5), kWide, 5);
  EXPECT_NEAR(least_distance(line_of(managing(ManagementPattern::kCircular, kWide)), 0.25), kWide * std::sqrt(0.5), 5);
  EXPECT_NEAR(least_distance(line_of(managing(ManagementPattern::kLinear)), 0.5), 0, 1e-6);
  EXPECT_NEAR(least_distance(line_of(managing(ManagementPattern::kRacetrack, 200)), 0.5), 200, 1);
}

// ---- ships that follow them, in open water

struct Followed {
  double most_off = 0;  ///< the line, after the first quarter of a lap [m]
  double laps = 0;
  double nearest = 1e9;  ///< of two ships [m]
  Vector reach;          ///< half extents about the pattern's middle [m]
};

/// Samples of ship 0 against the line of its pattern, where the drift goes along −x, past (0, 0).
Followed follow(const Scene& scene, double until) {
  const Story story = run(scene, until).story;
  const auto& pilot = std::get<ManagingPilot>(scene.ships[0].pilot);
  const PatternLine line = line_of(pilot);
  Followed found;
  double before = 0, turned = 0;
  for (const HullSample& s : story.samples) {
    for (const HullSample& other : story.samples)
      if (other.ship == 1 && s.ship == 0 && std::abs(other.time - s.time) < 1e-6)
        found.nearest = std::min(found.nearest, distance(s.position_in_world, other.position_in_world));
    if (s.ship != 0) continue;
    const Vector from_middle = s.position_in_world - Point{kFar, 0};
    const double angle = std::atan2(from_middle.y, from_middle.x);
    turned += std::remainder(angle - before, kTwoPi);
    before = angle;
    found.reach.x = std::max(found.reach.x, std::abs(from_middle.x));
    found.reach.y = std::max(found.reach.y, std::abs(from_middle.y));
    if (s.time > 0.25 * line.lap() / kPatternSpeed)
      found.most_off = std::max(found.most_off, off_line(line, s.position_in_world));
  }
  found.laps = std::abs(turned) / kTwoPi;
  return found;
}

TEST(Managing, GoesRoundACircleOverGroundInADriftInItsPeriod) {
  const ManagingPilot pilot = managing(ManagementPattern::kCircular, kWide);
  const double period = line_of(pilot).lap() / kPatternSpeed;
  const Followed found = follow(managed({pilot}, {-0.5, 0}), 2 * period);
  EXPECT_NEAR(found.laps, 2, 0.1);
  EXPECT_LT(found.most_off, 40);
}

TEST(Managing, GoesRoundARacetrackAndAlongALine) {
  const ManagingPilot track = managing(ManagementPattern::kRacetrack, 500);
  EXPECT_LT(follow(managed({track}, {-0.4, 0}), 900).most_off, 90);
  const Followed line = follow(managed({managing(ManagementPattern::kLinear)}, {-0.4, 0}), 1200);
  // A turn about takes the ship beyond the end by its tactical diameter at most, 3.8 lengths
  // (TurningCirclesAreThoseOfShips).
  EXPECT_GT(line.reach.y, 0.5 * kWide - 90);
  EXPECT_LT(line.reach.y, 0.5 * kWide + 450);
  EXPECT_LT(line.reach.x, 450);
}

TEST(Managing, APatternInTheIceIsRoundThere) {
  ManagingPilot pilot = managing(ManagementPattern::kCircular, kWide);
  pilot.drifts_with_ice = true;
  const double drift = 0.5, period = line_of(pilot).lap() / kPatternSpeed;
  const Story story = run(managed({pilot}, {-drift, 0}), 0.9 * period).story;
  const PatternLine line = line_of(pilot);
  for (const HullSample& s : story.samples) {
    if (s.ship == 0 && s.time > 0.25 * period) {
      ASSERT_LT(off_line(line, s.position_in_world + Vector{drift * s.time, 0}), 40) << s.time;
    }
  }
}

TEST(Managing, TwoShipsShareAPatternWithoutMeeting) {
  ManagingPilot first = managing(ManagementPattern::kRacetrack, 500), second = first;
  first.safety_radius = second.safety_radius = 240;
  second.phase = 0.5;
  first.partners = {{1, 0.5}};
  second.partners = {{0, 0}};
  const Followed found = follow(managed({first, second}, {-0.4, 0}), 1500);
  EXPECT_GT(found.nearest, 400);
  // Also where the second starts a quarter of a lap behind its phase.
  Build late = managed({first, second}, {-0.4, 0});
  ManagingPilot behind = second;
  behind.phase = 0.25;
  late.ships[1].position_in_world = manager(behind, 2, {-0.4, 0}).position_in_world;
  late.ships[1].heading = manager(behind, 2, {-0.4, 0}).heading;
  EXPECT_GT(follow(late, 1500).nearest, 240);
}

TEST(Managing, ShipsThatMeetHeadOnPassAtTheSafetyRadius) {
  ManagingPilot first = managing(ManagementPattern::kLinear), second = first;
  first.safety_radius = second.safety_radius = 250;
  second.phase = 0.5;
  EXPECT_GT(follow(managed({first, second}, {-0.3, 0}), 800).nearest, 200);
  first.safety_radius = second.safety_radius = 1;
  EXPECT_LT(follow(managed({first, second}, {-0.3, 0}), 800).nearest, 150);  // the radius is what parts them
}

TEST(Managing, GoesRoundTheBodyNotThroughIt) {
  // The drift turns about at once: the pattern is then on the other side of the body.
  ManagingPilot pilot = managing(ManagementPattern::kCircular, kWide);
  pilot.safety_radius = 300;
  Build scene = managed({pilot}, {-0.4, 0});
  scene.water.drift_rows = {{0, 0.4, std::numbers::pi}, {300, 0.4, std::numbers::pi}, {301, 0.4, 0}};
  scene.water.drift = {};
  double nearest = 1e9, last_x = 0;
  for (const HullSample& s : run(scene, 1500).story.samples) {
    if (s.ship != 0) continue;
    nearest = std::min(nearest, length(s.position_in_world - Point{}));
    last_x = s.position_in_world.x;
  }
  EXPECT_GT(nearest, 250);
  EXPECT_LT(last_x, -kFar + kWide);
}

TEST(Managing, GoesToTheLargestFloeThatWillPassAndOnToTheNext) {
  ManagingPilot pilot = managing(ManagementPattern::kLargestFloe, 1600);
  pilot.width = 400;
  pilot.least_floe = 100;
  Build scene = managed({pilot}, {-0.4, 0});
  scene.unbreakable().without_drag();
  scene.floe(rectangle(1000, 100, 1020, 120));    // 0
  scene.floe(rectangle(1900, -160, 1940, -120));  // 1: the largest that will pass
  scene.floe(rectangle(1500, 600, 1600, 700));    // 2: larger, and will pass too far off
  scene.floe(rectangle(1200, 0, 1205, 5));        // 3: too small
  Simulation simulation(scene);
  const auto target = [&] { return simulation.world().population.helms[0].memory.pattern.target; };
  std::vector<std::int64_t> targets;
  while (simulation.time() < 900) {
    simulation.step();
    if (targets.empty() || targets.back() != target()) targets.push_back(target());
  }
  std::erase(targets, kNoFloe);
  // What is left of the first is a floe of its own, and larger than the next.
  ASSERT_GE(targets.size(), 2U);
  EXPECT_EQ(targets[0], 1);
  EXPECT_EQ(std::ranges::count(targets, 0), 1) << testing::PrintToString(targets);
  EXPECT_EQ(std::ranges::count(targets, 2) + std::ranges::count(targets, 3), 0);
}

TEST(Managing, GoesOnFromItsState) {
  ManagingPilot pilot = managing(ManagementPattern::kCircular, kWide);
  pilot.drifts_with_ice = true;
  Build scene = managed({pilot}, {-0.3, 0});
  scene.water.tide = dynamics::Tide{1200, 0.2, 0.1, 1, 0.5};
  const Simulation again = expect_resumes(scene, 100, 200).simulation;
  EXPECT_GT(again.world().population.helms[0].memory.pattern.lap_share, 0.1);
}

// ---- a drift that changes

TEST(ChangingDrift, PathsAreIntegralsOfVelocities) {
  const std::vector<dynamics::FlowRow> rows{{-50, 0.4, 0.2}, {100, 0.8, 1.5}, {400, 0.1, 3}};
  const dynamics::Tide tide{600, 0.5, -0.2, 0.7, 1.1};
  Vector by_rows, by_tide;
  constexpr double kStep = 0.01;
  for (int i = 0; i < 60000; ++i) {
    by_rows += kStep * velocity_of(rows, (i + 0.5) * kStep);
    by_tide += kStep * tide.velocity((i + 0.5) * kStep);
    if (i % 5000 != 4999) continue;
    EXPECT_NEAR(length(by_rows - path_of(rows, (i + 1) * kStep)), 0, 1e-6);
    EXPECT_NEAR(length(by_tide - tide.path((i + 1) * kStep)), 0, 1e-6);
  }
  // An ellipse: its axes a quarter of a period apart, closed after one.
  const dynamics::Tide round{600, 0.5, 0.2, 0, 0};
  EXPECT_NEAR(round.velocity(0).x, 0.5, 1e-12);
  EXPECT_NEAR(round.velocity(150).y, 0.2, 1e-12);
  EXPECT_NEAR(length(round.path(600)), 0, 1e-9);
  EXPECT_NEAR(length(round.path(150) - Vector{0.5, 0.2} * (600 / kTwoPi)), 0, 1e-9);
}

TEST(ChangingDrift, FreeIceGoesWithTheWaterAndWhatStandsStays) {
  Build scene = Build().step(0.05);
  scene.water.tide = dynamics::Tide{120, 0.5, 0.2, 0.3, 0};
  scene.floe(rectangle(0, 0, 20, 20));
  scene.floe(fast(rectangle(0, 200, 20, 220)));
  scene.pile({-200, 0}, 10);
  const auto [simulation, story] = run(scene, 50);
  const Vector path = scene.water.drift_path(simulation.time());
  ASSERT_GT(length(path), 5);
  const auto floes = simulation.floe_states();
  const auto moved = [&](std::size_t i, Point from) { return transform(floes[i].world_from_body, Point{}) - from; };
  const auto start = Simulation(scene).floe_states();
  const auto at_start = [&](std::size_t i) { return transform(start[i].world_from_body, Point{}); };
  EXPECT_NEAR(length(moved(0, at_start(0)) - path), 0, 1e-9);
  EXPECT_NEAR(length(moved(1, at_start(1))), 0, 1e-9);
  EXPECT_NEAR(length(simulation.ship_states()[0].world_from_ship.position - Point{-200, 0}), 0, 1e-9);
  EXPECT_NEAR(length(floes[0].velocity - scene.water.drift_at(simulation.time())), 0, 0.01);
}

TEST(ChangingDrift, AMooredShipRidesAsTheSpringOfItsMooringHasIt) {
  // Slow against its own period, the ship lies where the mooring's pull is its resistance to the current, and what
  // would speed it up with the water around it.
  Ship ship = manager(managing(ManagementPattern::kCircular, kWide), 1, {-1, 0});
  ship.propulsion = ConstantThrust{0};
  ship.steering = NoSteering{};
  ship.pilot = ConstantPilot{};
  ship.position_in_world = {};
  ship.heading = 0;
  ship.speed = 0;
  ship.mooring = MooringSettings{.surge_stiffness = 2e5,
                                 .sway_stiffness = 2e5,
                                 .yaw_stiffness = 1e9,
                                 .surge_damping = 8e5,
                                 .sway_damping = 8e5,
                                 .yaw_damping = 1e9};
  Build scene = Build().step(0.1).ship(ship);
  scene.water.tide = dynamics::Tide{4000, 1.5, 0, std::numbers::pi, 0};
  scene.record.forces_interval = 1;
  const simulation::Setup setup(scene);
  const double inertia = ship.mass + setup.sailing[0].hull.added_mass.rows[0].surge;
  const double resistance = setup.sailing[0].hull.quadratic_resistance;
  for (const HullSample& s : run(scene, 1200).story.samples) {
    if (s.time < 200) continue;
    const double u = scene.water.drift_at(s.time).x;
    const double growth = (scene.water.drift_at(s.time + 1).x - scene.water.drift_at(s.time - 1).x) / 2;
    const double pull = resistance * std::abs(u) * u + inertia * growth;
    ASSERT_NEAR(s.position_in_world.x, pull / 2e5, 0.02 * resistance * 1.5 * 1.5 / 2e5) << s.time;
  }
}

TEST(ChangingDrift, AWindThatTurnsTakesTheIceAlong) {
  Build scene = Build().step(0.1).without_drag();
  scene.water.skin_drag_coefficient = 0.004;
  scene.wind.rows = {{0, 10, 0}, {2000, 10, 0}, {2001, 10, kTwoPi / 4}};
  scene.floe(rectangle(0, 0, 20, 20));
  Simulation simulation(scene);
  while (simulation.time() < 1990) simulation.step();
  EXPECT_NEAR(length(simulation.floe_states()[0].velocity - free_drift(scene, 1990)), 0, 0.01);
  EXPECT_GT(free_drift(scene, 1990).x, 0.2);
  while (simulation.time() < 8000) simulation.step();
  EXPECT_NEAR(length(simulation.floe_states()[0].velocity - free_drift(scene, 8000)), 0, 0.01);
  EXPECT_GT(free_drift(scene, 4000).y, 0.2);
}

}  // namespace
}  // namespace polynya::simulation
