// Contact that behaves as ice: closed forms, one answer, and a load in level ice that the step does not make.
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

/// A 15 m floe of half a metre that meets a vertical wall at 1 m/s, with its corner or with a face of 2 m.
Scene floe_against_wall(const geometry::Polygon& floe_polygon, double step) {
  Scene scene = without_drag();
  scene.time.step = step;
  scene.contact = {};
  scene.ships = {barge({0, 0}, ConstantSpeed{0}, 0)};
  scene.floes = {floe(floe_polygon, {-1, 0})};
  return scene;
}

geometry::Polygon square_on_its_corner(double x) {
  const double d = 15 / std::numbers::sqrt2;
  return {{{x, 0}, {x + d, -d}, {x + 2 * d, 0}, {x + d, d}}, {}};
}

/// The same area, with a nose that ends in a face of 2 m.
geometry::Polygon with_flat_nose(double x) {
  return {{{x, -1},
           {x + 2, -1},
           {x + 2, -7.5},
           {x + 16.73, -7.5},
           {x + 16.73, 7.5},
           {x + 2, 7.5},
           {x + 2, 1},
           {x, 1}},
          {}};
}

struct Stop {
  double depth = 0;       ///< [m]
  double time = 0;        ///< from first contact to rest [s]
  double peak_force = 0;  ///< [N]
  double mass = 0;        ///< [kg]
};

/// `gap`: before the floe touches [m].
Stop stop_of(const Scene& scene, double gap) {
  Simulation simulation(scene);
  Stop stop;
  stop.mass = simulation.floe_states()[0].mass;
  const double start = simulation.floe_states()[0].world_from_body.position.x;
  while (simulation.floe_states()[0].velocity.x < -1e-2 && simulation.time() < 2) {
    simulation.step();
    for (const ContactState& state : simulation.contact_states())
      EXPECT_EQ(state.is_crushing, length(state.force) > 0);
    for (const dynamics::Contact& c : simulation.world().step.contacts)
      stop.peak_force =
          std::max(stop.peak_force, c.steady_share * c.total_normal_impulse() / scene.time.step);
  }
  stop.depth = start - simulation.floe_states()[0].world_from_body.position.x - gap;
  stop.time = simulation.time() - gap;  // at 1 m/s
  return stop;
}

/// A right corner: F = σ_c h dS/dξ = 2 σ_c h ξ, S = ξ², so it stops as half a swing of a spring:
/// depth v √(m/2σ_c h), time π/2 √(m/2σ_c h), peak v √(2σ_c h m).
TEST(CrushLaw, ACornerStopsAsTheClosedFormSays) {
  for (const double gap : {0.0001, 0.0021, 0.0034}) {
    const Stop stop = stop_of(floe_against_wall(square_on_its_corner(gap), 0.005), gap);
    const double k = 2 * 2.8e6 * 0.5;
    EXPECT_NEAR(stop.depth / std::sqrt(stop.mass / k), 1, 0.02) << gap;
    EXPECT_NEAR(stop.time / (0.5 * std::numbers::pi * std::sqrt(stop.mass / k)), 1, 0.03) << gap;
    EXPECT_NEAR(stop.peak_force / std::sqrt(stop.mass * k), 1, 0.02) << gap;
  }
}

/// A face of 2 m presses with a constant force of σ_c h · 2 m.
TEST(CrushLaw, AFlatFaceStopsUnderAConstantForce) {
  for (const double gap : {0.0001, 0.0021, 0.0034}) {
    const Stop stop = stop_of(floe_against_wall(with_flat_nose(gap), 0.005), gap);
    const double force = 2.8e6 * 0.5 * 2;
    EXPECT_NEAR(stop.peak_force / force, 1, 0.02) << gap;
    EXPECT_NEAR(stop.depth / (0.5 * stop.mass / force), 1, 0.15) << gap << ": seven steps in all";
    EXPECT_NEAR(stop.time / (stop.mass / force), 1, 0.15) << gap;
  }
}

TEST(CrushLaw, TheErrorOfACornersStopHalvesWithTheStep) {
  const auto error = [](double step) {
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
      const double gap = 1e-4 + step * i / 8;
      const Stop stop = stop_of(floe_against_wall(square_on_its_corner(gap), step), gap);
      sum += std::abs(stop.peak_force / std::sqrt(stop.mass * 2 * 2.8e6 * 0.5) - 1);
    }
    return sum / 8;
  };
  const double coarse = error(0.01);
  const double fine = error(0.0025);
  EXPECT_LT(fine, 0.4 * coarse);
}

/// Without drag, with contacts that crush.
Scene crushing_floes(std::vector<FloeSpec> floes, double friction) {
  Scene scene = without_drag();
  scene.contact = {};
  scene.ice.friction = friction;
  scene.floes = std::move(floes);
  return scene;
}

/// Nothing springs back: what the first brings, all share, and the rest of its energy has crushed ice.
TEST(CrushLaw, ALineOfFloesGoesOnTogether) {
  std::vector<FloeSpec> line = {floe(rectangle(0, 0, 10, 10), {1, 0})};
  for (int i = 1; i < 5; ++i) line.push_back(floe(rectangle(10.2 * i, 0, 10.2 * i + 10, 10)));
  Simulation simulation(crushing_floes(line, 0.2));
  const double mass = simulation.floe_states()[0].mass;
  while (simulation.time() < 40) simulation.step();
  double momentum = 0;
  for (const FloeState& state : simulation.floe_states()) {
    EXPECT_NEAR(state.velocity.x, 0.2, 2e-3);
    EXPECT_NEAR(state.angular_velocity, 0, 1e-6);
    momentum += mass * state.velocity.x;
  }
  EXPECT_NEAR(momentum / mass, 1, 1e-12);
  EXPECT_NEAR(simulation.audit().sums.energy.crushing / (0.5 * mass * (1 - 0.2)), 1, 2e-3);
  EXPECT_TRUE(simulation.audit().is_closed());
}

/// A floe that meets a wall obliquely slides along it: as long as it slides, Coulomb's friction takes μ times
/// what the wall takes of its speed across.
TEST(CrushLaw, FrictionOnAPlaneIsCoulombs) {
  for (const double friction : {0.05, 0.2, 0.4}) {
    Scene scene = crushing_floes({floe(rectangle(0.01, -3, 10.01, 3), {-1, 0.5})}, friction);
    scene.ships = {barge({0, 0}, ConstantSpeed{0}, 0)};
    scene.ships[0].hull.waterline = rectangle(-60, -40, 60, 40).outer;
    Simulation simulation(scene);
    while (simulation.time() < 0.1) simulation.step();
    const FloeState state = simulation.floe_states()[0];
    EXPECT_NEAR(state.velocity.x, 0, 0.01) << friction;
    EXPECT_NEAR(state.velocity.y, 0.5 - friction, 0.02) << friction;
  }
}

/// The reference ship presses 15 m floes into a basin without a way out.
TEST(CrushLaw, AJamIsSolvedAndItsContactsCreateNoEnergy) {
  Scene scene;
  scene.time.step = 0.01;
  scene.ships = {icebreaker({-1, 0}, ConstantSpeed{1})};
  const auto wall = [&](double x0, double y0, double x1, double y1) {
    Structure& wall = scene.structures.emplace_back(standing(barge({60, 0}, ConstantSpeed{0})));
    wall.name = "wall";
    wall.hull.waterline = rectangle(x0, y0, x1, y1).outer;
  };
  wall(100, -60, 110, 60);
  wall(-1, 60, 110, 70);
  wall(-1, -70, 110, -60);
  for (int column = 0; column < 6; ++column) {
    for (int row = 0; row < 7; ++row) {
      const double x = 1 + 16.3 * column, y = -57.5 + 16.4 * row + (column % 2);
      scene.floes.push_back(floe(rectangle(x, y, x + 15, y + 15)));
    }
  }
  Simulation simulation(scene);
  run(simulation, 60);
  const Counts& counts = simulation.world().accounts.counts;
  EXPECT_LT(static_cast<double>(counts.unconverged_steps), 0.02 * static_cast<double>(simulation.steps()));
  EXPECT_LT(counts.energy_created, 1e-6 * simulation.audit().turnover);
  EXPECT_GT(counts.peak_contacts, 60);
  EXPECT_TRUE(simulation.audit().is_closed());
}

/// 1.5 m of ice, whose tips press on both sides of the parallel midbody: rigid impulses keep each other alive
/// there through the solver's start.
TEST(CrushLaw, ASqueezeAlongTheMidbodyHasOneAnswer) {
  const auto surge_of = [](const ContactSettings& settings) {
    Scene scene;
    scene.ice.thickness = 1.5;
    scene.contact = settings;
    scene.ships = {icebreaker({-2, 0}, ConstantSpeed{0.25}, 0.25)};
    scene.floes = {floe(rectangle(0, -2000, 4000, 2000))};
    Simulation simulation(scene);
    std::vector<double> means;  // over 0.1 s [N]
    for (const ShipSample& sample : run(simulation, 300).samples) means.push_back(sample.from_ice.surge);
    return means;
  };
  std::vector<ContactSettings> others(3);
  others[0].substeps = 8;
  others[1].tolerance = 1e-6;
  others[2].is_warm_started = false;
  const std::vector<double> first = surge_of({});
  const double mean = std::accumulate(first.begin(), first.end(), 0.0) / static_cast<double>(first.size());
  const double peak = std::ranges::min(first);
  EXPECT_LT(mean, -5e4);
  EXPECT_GT(mean, -3e5);
  for (const ContactSettings& settings : others) {
    const std::vector<double> surge = surge_of(settings);
    ASSERT_EQ(surge.size(), first.size());
    EXPECT_NEAR(std::accumulate(surge.begin(), surge.end(), 0.0) / static_cast<double>(surge.size()) / mean,
                1, 0.01);
    EXPECT_NEAR(std::ranges::min(surge) / peak, 1, 0.01);
  }
}

/// Mean surge on the reference ship at 1 m/s through 120 m of level ice [N].
double mean_load_in_level_ice(double step, int substeps, double offset) {
  Scene scene;
  scene.time.step = step;
  scene.contact.law = ContactLaw::kCrush;
  scene.contact.substeps = substeps;
  scene.fracture.splitting = fracture::SplittingModel::kNone;  // it stands for ice without end
  scene.ships = {icebreaker({-1, offset}, ConstantSpeed{1})};
  scene.floes = {floe(rectangle(0, -100, 300, 100))};
  Simulation simulation(scene);
  double impulse = 0;
  while (simulation.time() < 120) {
    simulation.step();
    if (simulation.time() <= 20) continue;  // the bow breaks its way in first
    for (const dynamics::Contact& c : simulation.world().step.contacts) impulse += c.impulse_on_b().x;
    simulation.journal().clear();
  }
  return impulse / 100;
}

TEST(CrushLaw, TheLoadInLevelIceIsNotTheSteps) {
  const auto mean = [](double step, int substeps) {
    double sum = 0;
    for (const double offset : {0.0, 0.3, 0.7, 1.1}) sum += mean_load_in_level_ice(step, substeps, offset);
    return sum / 4;
  };
  const double fine = mean(0.0025, 1);
  EXPECT_NEAR(mean(0.005, 1) / fine, 1, 0.05);
  EXPECT_NEAR(mean(0.02, 1) / fine, 1, 0.10);
  EXPECT_NEAR(mean(0.005, 4) / fine, 1, 0.05);
  EXPECT_GT(fine, 2e4);
}

}  // namespace
}  // namespace polynya::simulation
