// Ships that manage ice: where their patterns lead, that they follow them, and a drift that changes.
#include <algorithm>
#include <cmath>
#include <tuple>

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
constexpr double kFar = 1500;        ///< distance of a pattern from the body [m]
constexpr double kWide = 800;        ///< across the drift [m]
constexpr double kPatternSpeed = 4;  ///< along the pattern [m/s]

using Form = ManagementPattern;

ManagingPilot managing(Form pattern, double depth = 0) {
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
  const Vector at =
      pilot.pattern == Form::kLargestFloe ? Vector{pilot.distance, 0} : line.at(pilot.phase * line.lap()) - Point{};
  const Vector ahead = line.direction(line.leg_at(pilot.phase * line.lap()));
  const auto over_ground = [&](Vector v) { return v.x * upstream + v.y * perpendicular(upstream); };
  Ship ship = in_water(icebreaker({}, kEngine, kPatternSpeed));
  ship.position_in_world = Point{} + over_ground(at);
  const Vector course = over_ground(ahead);
  ship.heading = std::atan2(course.y, course.x);
  ship.steering = RudderSettings{13};
  ship.pilot = pilot;
  return ship;
}

Build managed(const std::vector<ManagingPilot>& pilots, Vector drift) {
  Build scene = Build().step(0.1).drift(drift).recorded_every(1);
  for (const ManagingPilot& pilot : pilots) scene.ship(manager(pilot, static_cast<int>(pilots.size()), drift));
  return scene.pile({}, 20);
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
  for (const auto& [pattern, depth, lap] : {std::tuple{Form::kLinear, 0.0, 2 * kWide},
                                            {Form::kLinear, 100.0, 2 * kWide + 200},
                                            {Form::kCircular, kWide, 0.5 * kTwoPi * kWide},
                                            {Form::kRacetrack, 200.0, 2 * (kWide - 200) + 0.5 * kTwoPi * 200},
                                            {Form::kSector, 0.0, 2 * kWide},
                                            {Form::kSector, 100.0, 2 * kWide + 200}})  // out at the far arc's radius
    EXPECT_NEAR(line_of(managing(pattern, depth)).lap() / lap, 1, pattern == Form::kLinear ? 1e-12 : 0.002) << depth;
}

TEST(Pattern, TheirBoxesAreWidthByDepthAboutTheMiddle) {
  for (const auto& [pattern, depth] :
       {std::pair{Form::kLinear, 100.0}, {Form::kCircular, 500.0}, {Form::kRacetrack, 300.0}}) {
    const geometry::Box box = bounding_box(line_of(managing(pattern, depth)).corners);
    EXPECT_NEAR(box.low.x, kFar - 0.5 * depth, 1e-9);
    EXPECT_NEAR(box.high.x, kFar + 0.5 * depth, 1e-9);
    EXPECT_NEAR(box.low.y, -0.5 * kWide, 1e-9);
    EXPECT_NEAR(box.high.y, 0.5 * kWide, 1e-9);
  }
  for (const Point corner : line_of(managing(Form::kSector)).corners) EXPECT_NEAR(length(corner - Point{}), kFar, 1e-9);
}

TEST(Pattern, ALapGoesRoundOnceAndPlacesAreInOrder) {
  const PatternLine line = line_of(managing(Form::kRacetrack, 200));
  for (int i = 0; i < 200; ++i) {
    const double place = line.lap() * i / 200;
    EXPECT_NEAR(off_line(line, line.at(place)), 0, 1e-9);
    EXPECT_NEAR(distance(line.at(place), line.at(std::fmod(place + 1, line.lap()))), 1, 0.05);
  }
}

/// A ship that follows a line for ever sweeps a band as wide as its beam. The function returns the share of the
/// drifting ice within the pattern's width that the bands of all laps of a period cover.
double swept_share(const PatternLine& line, double drift, double speed, double band) {
  const double period = line.lap() / speed;
  constexpr int kPlaces = 500, kCells = 30;
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

TEST(Pattern, LeavesNoGapsWhileDriftTimesPeriodIsWithinTheBand) {
  // Passes of the line at a place y are at y/W and 1 − y/W of half periods.
  // A band of b leaves |gap − b| of both gaps, spacing (½ ± y/W).
  // Of the mean over y that is (1 − b/spacing)².
  for (const auto& [pattern, depth, drift, narrow, least, most] :
       {std::tuple{Form::kLinear, 0.0, 0.25, 0.5, 0.69, 0.81}, {Form::kCircular, kWide, 0.16, 0.2, 0.0, 0.95}}) {
    const PatternLine line = line_of(managing(pattern, depth));
    const double spacing = drift * line.lap() / kPatternSpeed;  // distance of two passes at an end of the line: 100 m
    EXPECT_EQ(swept_share(line, drift, kPatternSpeed, 1.05 * spacing), 1) << depth;
    const double share = swept_share(line, drift, kPatternSpeed, narrow * spacing);
    EXPECT_GE(share, least) << depth;
    EXPECT_LE(share, most) << depth;
  }
}

TEST(Pattern, ShipsOfTwoPhasesComeAsNearAsTheFormsAllow) {
  const PatternLine circle = line_of(managing(Form::kCircular, kWide));
  EXPECT_NEAR(least_distance(circle, 0.5), kWide, 5);
  EXPECT_NEAR(least_distance(circle, 0.25), kWide * std::sqrt(0.5), 5);
  EXPECT_NEAR(least_distance(line_of(managing(Form::kLinear)), 0.5), 0, 1e-6);
  EXPECT_NEAR(least_distance(line_of(managing(Form::kRacetrack, 200)), 0.5), 200, 1);
}

// ---- ships that follow them, in open water

struct Followed {
  double most_off = 0;  ///< the line, after the first quarter of a lap [m]
  double laps = 0;
  double nearest = 1e9;  ///< least distance of two ships [m]
  Vector reach;          ///< half extents about the pattern's middle [m]
};

/// Samples of ship 0 relative to the line of its pattern, over ground or in the ice. The drift is along −x, past (0,
/// 0).
Followed follow(const Scene& scene, double until) {
  const Story story = run(scene, until).story;
  const auto& pilot = std::get<ManagingPilot>(scene.ships[0].pilot);
  const PatternLine line = line_of(pilot);
  const Vector drift = pilot.drifts_with_ice ? scene.water.drift : Vector{};
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
      found.most_off = std::max(found.most_off, off_line(line, s.position_in_world - s.time * drift));
  }
  found.laps = std::abs(turned) / kTwoPi;
  return found;
}

TEST(Managing, GoesRoundACircleOverGroundInItsPeriodARacetrackAndAlongALine) {
  const ManagingPilot pilot = managing(Form::kCircular, kWide);
  const Followed circle = follow(managed({pilot}, {-0.5, 0}), 2 * line_of(pilot).lap() / kPatternSpeed);
  EXPECT_NEAR(circle.laps, 2, 0.1);
  EXPECT_LT(circle.most_off, 45);
  EXPECT_LT(follow(managed({managing(Form::kRacetrack, 500)}, {-0.4, 0}), 900).most_off, 90);
  const Followed line = follow(managed({managing(Form::kLinear)}, {-0.4, 0}), 1200);
  // A turn about takes the ship beyond the end by its tactical diameter at most, 3.8 lengths
  // (TurningCirclesAreThoseOfShips).
  EXPECT_GT(line.reach.y, 0.5 * kWide - 90);
  EXPECT_LT(line.reach.y, 0.5 * kWide + 450);
  EXPECT_LT(line.reach.x, 450);
}

TEST(Managing, APatternInTheIceIsRoundThere) {
  ManagingPilot pilot = managing(Form::kCircular, kWide);
  pilot.drifts_with_ice = true;
  const Followed found = follow(managed({pilot}, {-0.5, 0}), 0.9 * line_of(pilot).lap() / kPatternSpeed);
  EXPECT_GT(found.most_off, 0);
  EXPECT_LT(found.most_off, 40);
}

TEST(Managing, TwoShipsShareAPatternWithoutMeeting) {
  ManagingPilot first = managing(Form::kRacetrack, 500), second = first;
  first.safety_radius = second.safety_radius = 240;
  second.phase = 0.5;
  first.partners = {{1, 0.5}};
  second.partners = {{0, 0}};
  const Followed found = follow(managed({first, second}, {-0.4, 0}), 1500);
  EXPECT_GT(found.nearest, 400);
  // The same holds if the second vessel starts a quarter of a lap behind its phase.
  Build late = managed({first, second}, {-0.4, 0});
  ManagingPilot behind = second;
  behind.phase = 0.25;
  late.ships[1].position_in_world = manager(behind, 2, {-0.4, 0}).position_in_world;
  late.ships[1].heading = manager(behind, 2, {-0.4, 0}).heading;
  EXPECT_GT(follow(late, 1500).nearest, 240);
}

TEST(Managing, ShipsThatMeetHeadOnPassAtTheSafetyRadius) {
  ManagingPilot first = managing(Form::kLinear), second = first;
  first.safety_radius = second.safety_radius = 250;
  second.phase = 0.5;
  EXPECT_GT(follow(managed({first, second}, {-0.3, 0}), 800).nearest, 200);
  first.safety_radius = second.safety_radius = 1;
  EXPECT_LT(follow(managed({first, second}, {-0.3, 0}), 800).nearest, 150);  // the radius is what parts them
}

TEST(Managing, GoesRoundTheBodyNotThroughIt) {
  // The drift turns about at once: the pattern is then on the other side of the body.
  ManagingPilot pilot = managing(Form::kCircular, kWide);
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
  ManagingPilot pilot = managing(Form::kLargestFloe, 1600);
  pilot.width = 400;
  pilot.least_floe = 100;
  Simulation simulation(managed({pilot}, {-0.4, 0})
                            .unbreakable()
                            .without_drag()
                            .floe(rectangle(1000, 100, 1020, 120))    // 0
                            .floe(rectangle(1900, -160, 1940, -120))  // 1: the largest that will pass
                            .floe(rectangle(1500, 600, 1600, 700))    // 2: larger, and will pass too far off
                            .floe(rectangle(1200, 0, 1205, 5)));      // 3: too small
  const auto target = [&] { return simulation.world().population.helms[0].memory.pattern.target; };
  std::vector<std::int64_t> targets;
  while (simulation.time() < 900) {
    simulation.step();
    if (targets.empty() || targets.back() != target()) targets.push_back(target());
  }
  std::erase(targets, kNoFloe);
  // The rest of the first floe is a new floe and larger than the next one.
  ASSERT_GE(targets.size(), 2U);
  EXPECT_EQ(targets[0], 1);
  EXPECT_EQ(std::ranges::count(targets, 0), 1) << testing::PrintToString(targets);
  EXPECT_EQ(std::ranges::count(targets, 2) + std::ranges::count(targets, 3), 0);
}

TEST(Managing, GoesOnFromItsState) {
  ManagingPilot pilot = managing(Form::kCircular, kWide);
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
  // The tide is an ellipse: its axes are a quarter of a period apart, and it closes after one period.
  const dynamics::Tide round{600, 0.5, 0.2, 0, 0};
  EXPECT_NEAR(round.velocity(0).x, 0.5, 1e-12);
  EXPECT_NEAR(round.velocity(150).y, 0.2, 1e-12);
  EXPECT_NEAR(length(round.path(600)), 0, 1e-9);
  EXPECT_NEAR(length(round.path(150) - Vector{0.5, 0.2} * (600 / kTwoPi)), 0, 1e-9);
}

TEST(ChangingDrift, FreeIceGoesWithTheWaterAndWhatStandsStays) {
  Build scene =
      Build().step(0.05).floe(rectangle(0, 0, 20, 20)).floe(fast(rectangle(0, 200, 20, 220))).pile({-200, 0}, 10);
  scene.water.tide = dynamics::Tide{120, 0.5, 0.2, 0.3, 0};
  Simulation simulation(scene);
  const auto start = simulation.floe_states();
  run(simulation, 50);
  const Vector path = scene.water.drift_path(simulation.time());
  ASSERT_GT(length(path), 5);
  const auto floes = simulation.floe_states();
  const auto moved = [&](std::size_t i) {
    return floes[i].world_from_body.position - start[i].world_from_body.position;
  };
  EXPECT_NEAR(length(moved(0) - path), 0, 1e-9);
  EXPECT_NEAR(length(moved(1)), 0, 1e-9);
  EXPECT_NEAR(length(simulation.ship_states()[0].world_from_ship.position - Point{-200, 0}), 0, 1e-9);
  EXPECT_NEAR(length(floes[0].velocity - scene.water.drift_at(simulation.time())), 0, 0.01);
}

TEST(ChangingDrift, AMooredShipRidesAsTheSpringOfItsMooringHasIt) {
  // The tide is slow compared with the ship's own period. The ship is therefore where the pull of the mooring balances
  // the resistance to the current and the force that would accelerate the ship and the water around it.
  Ship ship = in_water(icebreaker({60, 0}, ConstantThrust{0}, 0));
  ship.mooring = moored({}, {2e5, 2e5, 1e9}, {8e5, 8e5, 1e9});
  Build scene = Build().step(0.1).ship(ship).recorded_every(1);
  scene.water.tide = dynamics::Tide{4000, 1.5, 0, std::numbers::pi, 0};
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
