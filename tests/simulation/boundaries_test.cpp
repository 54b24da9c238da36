// What moves ice from outside, wind and skin drag, and what bounds it, walls.
#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/contact/crush_law.hpp"
#include "simulation/state/state.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Point;
using geometry::Vector;

constexpr double kClosed = 1e-11;  ///< share of the turnover; what rounding leaves

void expect_closed(const Simulation& simulation) {
  const Audit audit = simulation.audit();
  EXPECT_LT(std::abs(audit.energy_imbalance), kClosed * audit.turnover);
  EXPECT_LT(length(audit.momentum_imbalance), kClosed * audit.momentum_turnover);
}

/// Ice that neither breaks nor slips.
Scene unbreakable() {
  Scene scene;
  scene.time.step = 0.01;
  scene.fracture.breakable_size_factor = 1e9;
  scene.fracture.splitting = fracture::SplittingModel::kMichel;
  scene.fracture.splitting_shape_factor = 100;
  return scene;
}

double mean_surge(const Story& story, int ship, double from) {
  double sum = 0;
  int count = 0;
  for (const ShipSample& sample : story.samples) {
    if (sample.ship != ship || sample.time < from) continue;
    sum += sample.from_ice.surge;
    ++count;
  }
  return sum / count;
}

// Wind and skin drag

TEST(Wind, MovesAFloeAtTheSpeedOfTheClosedForm) {
  for (const double form : {0.0, 0.5}) {
    Scene scene;
    scene.time.step = 0.5;
    scene.wind.velocity = {6, 8};
    scene.water.skin_drag_coefficient = 0.004;
    scene.water.drag_coefficient = form;
    scene.floes = {floe(rectangle(-15, -15, 15, 15))};
    Simulation simulation(scene);
    run(simulation, 6000);
    const Vector velocity = simulation.floe_states().front().velocity;
    const double across = 30 * (0.6 + 0.8);  // of the square, across the wind
    const double water = 0.5 * 1000 * (0.004 * 900 + form * 0.5 * across);
    const double speed = std::sqrt(0.5 * 1.3 * 0.002 * 100 * 900 / water);
    EXPECT_NEAR(length(velocity) / speed, 1, 2e-3);
    EXPECT_NEAR(velocity.y / velocity.x, 8.0 / 6, 1e-9) << "it goes where the wind goes";
    if (form == 0) {
      EXPECT_NEAR(length(velocity) / 10, 0.025, 0.005) << "2 to 3 % of the wind";
    }
    expect_closed(simulation);
    EXPECT_GT(simulation.audit().sums.boundaries.wind, 0);
  }
}

TEST(Wind, CarriesIceOffInADriftAndLeavesFastIce) {
  Scene scene;
  scene.time.step = 0.1;
  scene.wind.velocity = {0, 10};
  scene.water.skin_drag_coefficient = 0.004;
  scene.water.drift = {0.3, 0};
  scene.water.drag_coefficient = 0;
  scene.floes = {floe(rectangle(0, 0, 30, 30)), floe(rectangle(-100, 0, -70, 30))};
  scene.floes[1].is_fast = true;
  Simulation simulation(scene);
  run(simulation, 3000);
  const auto states = simulation.floe_states();
  EXPECT_NEAR(states[0].velocity.x, 0.3, 1e-9);
  EXPECT_NEAR(states[0].velocity.y, 0.25, 0.02);
  EXPECT_EQ(length(states[1].velocity), 0);
  expect_closed(simulation);
}

TEST(SkinDrag, SlowsAndStopsASpinAsTheClosedFormSays) {
  Scene scene;
  scene.time.step = 0.1;
  scene.water.drag_coefficient = 0;
  scene.water.skin_drag_coefficient = 0.005;
  geometry::Polygon disc;
  for (int i = 0; i < 256; ++i) {
    const geometry::Rotation r = geometry::Rotation::by(2 * std::numbers::pi * i / 256);
    disc.outer.push_back(Point{} + 20 * Vector{r.cosine, r.sine});
  }
  scene.floes = {floe(disc, {0.5, 0}, 0.05)};
  Simulation simulation(scene);
  run(simulation, 200);
  const FloeState state = simulation.floe_states().front();
  // dv/dt = −k v², k = ½ C ρ_w / (ρ_i h); dω/dt = −½ C ρ_w ∫r³ dA ω² / (½ m R²), ∫r³ dA = ⅖ π R⁵.
  const double k = 0.5 * 0.005 * 1000 / (900 * 0.5);
  EXPECT_NEAR(state.velocity.x * (1 + k * 0.5 * 200) / 0.5, 1, 1e-6);
  EXPECT_NEAR(state.angular_velocity * (1 + 0.8 * k * 20 * 0.05 * 200) / 0.05, 1, 1e-4);
  expect_closed(simulation);
}

/// A plate of 600 × 400 m that drifts on a cylinder of 10 m.
Scene plate_on_cylinder() {
  Scene scene = unbreakable();
  scene.time.step = 0.02;
  scene.structures = {pile({0, 0}, 10)};
  scene.floes = {floe(rectangle(10.01, -200, 610.01, 200), {-0.1, 0})};
  return scene;
}

TEST(Wind, PressesAPlateOnAStructureThatOtherwiseStopsForGood) {
  Simulation still(plate_on_cylinder());
  EXPECT_NEAR(mean_surge(run(still, 60), 0, 40), 0, 1);
  Scene scene = plate_on_cylinder();
  scene.wind.velocity = {-20, 0};
  scene.water.skin_drag_coefficient = 0.004;
  Simulation windy(scene);
  const double by_wind = 0.5 * 1.3 * 0.002 * 400 * 240e3;
  EXPECT_NEAR(mean_surge(run(windy, 120), 0, 60) / -by_wind, 1, 0.02);
  expect_closed(windy);
  scene.wind.velocity = {};
  scene.water.drift = {-0.4, 0};  // which passes below the plate
  scene.floes[0].velocity = {};
  Simulation carried(scene);
  const double by_water = 0.5 * 1000 * 0.4 * 0.4 * (0.004 * 240e3 + 0.5 * 0.5 * 400);
  EXPECT_NEAR(mean_surge(run(carried, 120), 0, 80) / -by_water, 1, 0.02);
  expect_closed(carried);
}

/// Limit momentum on a cylinder of radius a: δ = (3 E_k / (4 p h √(2a)))^⅔, F = 2 p h √(2aδ).
TEST(LimitMomentum, OfAFloeOnACylinderIsThatOfTheClosedForm) {
  Scene scene = plate_on_cylinder();
  scene.time.step = 1e-3;
  scene.record.forces_interval = 1e-3;
  scene.water.drag_coefficient = 0;
  constexpr int kCorners = 2048;  // a facet's sagitta is 1e-5 m
  geometry::Ring& circle = scene.structures[0].hull.waterline;
  circle.clear();
  for (int i = 0; i < kCorners; ++i) {
    const geometry::Rotation r = geometry::Rotation::by(2 * std::numbers::pi * i / kCorners);
    circle.push_back(Point{} + 10 * Vector{r.cosine, r.sine});
  }
  scene.structures[0].hull.angles_from_vertical.assign(kCorners, 0.0);
  scene.floes = {floe(rectangle(10.001, -20, 50.001, 20), {-0.5, 0})};
  Simulation simulation(scene);
  const Story story = run(simulation, 0.5);
  double largest = 0;
  for (const ShipSample& sample : story.samples) largest = std::max(largest, -sample.from_ice.surge);
  EXPECT_NEAR(largest / 2.766e6, 1, 0.01);
  const double moved = -simulation.floe_states().front().world_from_body.position.x;
  std::printf("limit momentum: %.3f MN, %.4f m\n", largest / 1e6, moved - 0.001);
  EXPECT_NEAR((moved - 0.001) / 0.0488, 1, 0.02);
}

// Walls

Wall pressing(Point from, Point to, double line_load) {
  Wall wall = wall_between(from, to, 5);
  wall.pressure = WallPressure{line_load};
  return wall;
}

/// A block of ice of 40 × 20 m between a wall that stands and one that presses with 50 kN/m, turned by
/// `angle`.
Scene squeezed(double angle) {
  Scene scene = unbreakable();
  scene.contact.tolerance = 1e-6;
  const geometry::Pose pose{{7, -3}, geometry::Rotation::by(angle)};
  const auto at = [&](double x, double y) { return transform(pose, Point{x, y}); };
  scene.walls = {wall_between(at(-20, 0), at(20, 0), 5), pressing(at(20, 20.05), at(-20, 20.05), 5e4)};
  scene.floes = {floe({{at(-20, 0.01), at(20, 0.01), at(20, 20), at(-20, 20)}, {}})};
  return scene;
}

TEST(Wall, ThatPressesClosesUntilTheIceBearsItsLoad) {
  for (const double angle : {0.0, 30 * kDegree}) {
    Scene scene = squeezed(angle);
    if (angle > 0) scene.water.drift = {0.2, 0.1};
    Simulation simulation(scene);
    const Story story = run(simulation, 60);
    const double load = 5e4 * 40;
    const double creep = 2 * dynamics::kCreepSpeed * load / (2.8e6 * 0.5 * 40);  // of both faces
    EXPECT_NEAR(mean_surge(story, 1, 40) / -load, 1, 0.01);
    if (angle == 0) {
      EXPECT_NEAR(mean_surge(story, 0, 40) / -load, 1, 0.01) << "the ice passes it on";
    }
    const ShipState wall = simulation.ship_states()[1];
    EXPECT_LT(length(wall.velocity), 1.1 * creep) << "it came to rest";
    EXPECT_EQ(wall.angular_velocity, 0);
    expect_closed(simulation);
  }
}

TEST(Wall, ClosesAtItsSpeedWhereNothingBearsAndNeverSideways) {
  Scene scene = squeezed(0.3);
  scene.floes.clear();
  scene.floes = {floe(rectangle(500, 500, 510, 510))};
  scene.water.drift = {0.2, -0.3};
  Simulation simulation(scene);
  const Vector before = simulation.ship_states()[1].world_from_ship.position - Point{};
  run(simulation, 20);
  const ShipState wall = simulation.ship_states()[1];
  const Vector normal{std::cos(wall.heading), std::sin(wall.heading)};
  EXPECT_NEAR(dot(wall.velocity, normal), 0.1, 1e-6);
  EXPECT_NEAR(cross(wall.velocity, normal), 0, 1e-12);
  EXPECT_NEAR(cross(wall.world_from_ship.position - Point{} - before, normal), 0, 1e-9);
  expect_closed(simulation);
}

TEST(Wall, ThatMovesPushesIceAlongAndDoesNotMeetOtherWalls) {
  Scene scene = unbreakable();
  scene.walls = {wall_between({0, 10}, {0, -10}, 5), wall_between({4, -20}, {4, 20}, 5),
                 wall_between({-30, -9}, {30, -9}, 5)};
  scene.walls[0].velocity = {0.2, 0};
  scene.floes = {floe(rectangle(0.01, -8, 2, 8))};
  Simulation simulation(scene);
  const Story story = run(simulation, 2);
  EXPECT_NEAR(simulation.floe_states().front().velocity.x, 0.2, 1e-3);
  EXPECT_NEAR(simulation.ship_states()[0].world_from_ship.position.x, 0.4, 1e-9);
  EXPECT_TRUE(of_kind<ShipContact>(story).empty()) << "walls cross at their ends";
  expect_closed(simulation);
}

TEST(Wall, GoesOnFromASavedStateAsItWould) {
  Scene scene = squeezed(0.4);
  scene.wind.velocity = {5, 5};
  scene.water.skin_drag_coefficient = 0.004;
  Simulation whole(scene);
  run(whole, 5);
  auto resumed = Simulation::resumed(scene, whole.state());
  ASSERT_TRUE(resumed) << resumed.error();
  run(whole, 10);
  run(*resumed, 10);
  EXPECT_EQ(resumed->state_hash(), whole.state_hash());
  expect_closed(*resumed);
}

/// The reference ship at a crawl, ice of 10 m along both bow flanks and both sides, and a wall behind each,
/// parallel to the hull: R = q [B + 2 μ (L_bow + L_par)].
TEST(LinePressure, OnAShipsBowAndSidesIsThatOfTheClosedForm) {
  constexpr double kLoad = 5e4;
  constexpr double kWay = 10;  // from hull to wall
  Scene scene = unbreakable();
  scene.contact.tolerance = 1e-5;
  Ship ship = icebreaker({60, 0}, ConstantSpeed{0.005}, 0.005);
  ship.hull.angles_from_vertical.assign(ship.hull.waterline.size(), 0.0);
  scene.ships = {ship};
  const geometry::Ring hull = ship.hull.waterline;
  for (const auto& [i, k] : {std::pair{0, 1}, {1, 2}, {3, 4}, {4, 0}}) {
    const Vector along = (hull[k] - hull[i]) / distance(hull[i], hull[k]);
    const Vector out = -perpendicular(along);
    const auto beside = [&](Point p, double off) { return p + off * out; };
    scene.floes.push_back(
        floe({{beside(hull[i], 0.001), beside(hull[i], kWay), beside(hull[k], kWay), beside(hull[k], 0.001)},
              {}}));
    scene.walls.push_back(pressing(beside(hull[i], kWay + 0.001), beside(hull[k], kWay + 0.001), kLoad));
  }
  Simulation simulation(scene);
  const Story story = run(simulation, 60);
  const double expected = kLoad * (24 + 2 * scene.ice.friction * 120);
  std::printf("line pressure: %.3f MN, closed form %.3f MN\n", -mean_surge(story, 0, 30) / 1e6,
              expected / 1e6);
  EXPECT_NEAR(mean_surge(story, 0, 30) / -expected, 1, 0.03);
  expect_closed(simulation);
}

}  // namespace
}  // namespace polynya::simulation
