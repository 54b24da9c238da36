// Contact that behaves as ice: closed forms, one answer, and a load in level ice that the step does not make.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using shapes::diamond;

/// A 15 m floe of half a metre that meets a vertical wall at 1 m/s, with its corner or with a face of 2 m.
Scene floe_against_wall(const geometry::Polygon& polygon, double step) {
  return Build().without_drag().step(step).ship(barge({0, 0}, ConstantSpeed{0}, 0)).floe(polygon, {-1, 0});
}

geometry::Polygon square_on_its_corner(double x) {
  return shapes::diamond({x, 0}, 15 / std::numbers::sqrt2);
}

/// The same area, with a nose that ends in a face of 2 m.
geometry::Polygon with_flat_nose(double x) {
  const geometry::Point low[] = {{x, -1}, {x + 2, -1}, {x + 2, -7.5}, {x + 16.73, -7.5}};
  const geometry::Point high[] = {{x + 16.73, 7.5}, {x + 2, 7.5}, {x + 2, 1}, {x, 1}};
  return {{low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]}, {}};
}

struct Stop {
  double depth = 0;       ///< [m]
  double time = 0;        ///< time from first contact to rest [s]
  double peak_force = 0;  ///< [N]
  double mass = 0;        ///< [kg]
};

/// `gap` is the distance of the floe before it touches [m].
Stop stop_of(const Scene& scene, double gap) {
  Simulation simulation(scene);
  Stop stop;
  stop.mass = simulation.floe_states()[0].mass;
  const double start = simulation.floe_states()[0].world_from_body.position.x;
  while (simulation.floe_states()[0].velocity.x < -1e-2 && simulation.time() < 2) {
    simulation.step();
    for (const ContactState& state : simulation.contact_states()) EXPECT_EQ(state.is_crushing, length(state.force) > 0);
    stop.peak_force = std::max(stop.peak_force, largest_contact_force(simulation));
  }
  stop.depth = start - simulation.floe_states()[0].world_from_body.position.x - gap;
  stop.time = simulation.time() - gap;  // at 1 m/s
  return stop;
}

/// 2 σ_c h: stiffness of a right corner [N/m]; for a face of 2 m, its force [N].
constexpr double kStiffness = 2 * 2.8e6 * 0.5;

/// For a right corner F = σ_c h dS/dξ = 2 σ_c h ξ and S = ξ². It stops like half a swing of a spring: depth v √(m/2σ_c
/// h), time π/2 √(m/2σ_c h), peak v √(2σ_c h m). A face of 2 m presses with a constant force.
TEST(CrushLaw, ACornerAndAFlatFaceStopAsTheirClosedFormsSay) {
  for (const double gap : {0.0001, 0.0021, 0.0034}) {
    const Stop corner = stop_of(floe_against_wall(square_on_its_corner(gap), 0.005), gap);
    const double swing = std::sqrt(corner.mass / kStiffness);
    EXPECT_NEAR(corner.depth / swing, 1, 0.02) << gap;
    EXPECT_NEAR(corner.time / (0.5 * std::numbers::pi * swing), 1, 0.03) << gap;
    EXPECT_NEAR(corner.peak_force / (kStiffness * swing), 1, 0.02) << gap;
    const Stop face = stop_of(floe_against_wall(with_flat_nose(gap), 0.005), gap);
    EXPECT_NEAR(face.peak_force / kStiffness, 1, 0.02) << gap;
    EXPECT_NEAR(face.depth / (0.5 * face.mass / kStiffness), 1, 0.15) << gap << ": seven steps in all";
    EXPECT_NEAR(face.time / (face.mass / kStiffness), 1, 0.15) << gap;
  }
}

TEST(CrushLaw, TheErrorOfACornersStopHalvesWithTheStep) {
  const auto error = [](double step) {
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
      const double gap = 1e-4 + step * i / 8;
      const Stop stop = stop_of(floe_against_wall(square_on_its_corner(gap), step), gap);
      sum += std::abs(stop.peak_force / std::sqrt(stop.mass * kStiffness) - 1);
    }
    return sum / 8;
  };
  EXPECT_LT(error(0.0025), 0.4 * error(0.01));
}

/// There is no rebound: all floes share the momentum of the first one, and the rest of its energy has crushed ice.
TEST(CrushLaw, ALineOfFloesGoesOnTogether) {
  Build scene = Build().without_drag().grid({0, 0}, 5, 1, 10, 10.2);
  scene.floes[0].velocity = {1, 0};
  const Trial done = run(scene, 40);
  const double mass = 900 * 0.5 * 100;
  double momentum = 0;
  for (const FloeState& state : done.simulation.floe_states()) {
    EXPECT_NEAR(state.velocity.x, 0.2, 5e-3);  // overlap that is not paid is pushed apart by some mm/s
    EXPECT_NEAR(state.angular_velocity, 0, 1e-6);
    momentum += mass * state.velocity.x;
  }
  EXPECT_NEAR(momentum / mass, 1, 1e-12);
  EXPECT_NEAR(done.simulation.audit().sums.energy.crushing / (0.5 * mass * (1 - 0.2)), 1, 2e-3);
  expect_closed(done.simulation);
}

/// A floe that meets a wall obliquely slides along it. While it slides, Coulomb's friction takes μ times the change of
/// its speed normal to the wall.
TEST(CrushLaw, FrictionOnAPlaneIsCoulombs) {
  for (const double friction : {0.05, 0.2, 0.4}) {
    Scene scene = Build()
                      .without_drag()
                      .structure(rectangle(-120, -40, 0, 40).outer)
                      .floe(rectangle(0.01, -3, 10.01, 3), {-1, 0.5});
    scene.ice.friction = friction;
    const FloeState state = run(scene, 0.1).simulation.floe_states()[0];
    // The floe comes to rest except for its initial overlap, which is at most the displacement of one step and is
    // pushed apart.
    EXPECT_GE(state.velocity.x, -0.01) << friction;
    EXPECT_LE(state.velocity.x, 0.1) << friction;
    EXPECT_NEAR(state.velocity.y, 0.5 - friction * (1 + state.velocity.x), 0.02) << friction;
  }
}

/// The reference ship presses 15 m floes into a closed basin.
TEST(CrushLaw, AJamIsSolvedAndItsContactsCreateNoEnergy) {
  Build scene = Build().step(0.01).ship(icebreaker({-1, 0}, ConstantSpeed{1}));
  for (const auto& wall : {rectangle(100, -60, 110, 60), rectangle(-1, 60, 110, 70), rectangle(-1, -70, 110, -60)})
    scene.structure(wall.outer);
  for (int column = 0; column < 6; ++column) scene.grid({1 + 16.3 * column, -57.5 + (column % 2)}, 1, 7, 15, 16.4);
  const Trial done = run(scene, 60);
  const Counts counts = done.simulation.counts();
  EXPECT_LT(static_cast<double>(counts.unconverged_steps), 0.02 * static_cast<double>(counts.steps));
  EXPECT_LT(counts.energy_created, 1e-6 * done.simulation.audit().turnover);
  EXPECT_GT(counts.peak_contacts, 60);
  expect_closed(done.simulation);
}

/// 1.5 m of ice, whose tips press on both sides of the parallel midbody: rigid impulses keep each other alive
/// there through the solver's start. By the wedges of edges: by their sections this run is another after a last bit.
TEST(CrushLaw, ASqueezeAlongTheMidbodyHasOneAnswer) {
  const auto surge_of = [](const ContactSettings& settings) {
    Scene scene = Build().ship(icebreaker({-2, 0}, ConstantSpeed{0.25}, 0.25)).floe(rectangle(0, -2000, 4000, 2000));
    scene.ice.thickness = 1.5;
    scene.fracture.outline = fracture::EdgeOutline::kWedge;
    scene.contact = settings;
    return run(scene, 300).story;
  };
  std::vector<ContactSettings> others(3);
  others[0].substeps = 8;
  others[1].tolerance = 1e-6;
  others[2].is_warm_started = false;
  const Story first = surge_of({});
  const double mean_of_first = mean(first, &HullSample::from_ice);
  EXPECT_LT(mean_of_first, -5e4);
  EXPECT_GT(mean_of_first, -5e5);
  for (const ContactSettings& settings : others) {
    const Story surge = surge_of(settings);
    EXPECT_NEAR(mean(surge, &HullSample::from_ice) / mean_of_first, 1, 0.01);
    EXPECT_NEAR(largest(surge, &HullSample::from_ice) / largest(first, &HullSample::from_ice), 1, 0.01);
  }
}

/// Mean load on the reference ship at 1 m/s through 100 m of level ice, over four places to begin at, of which each is
/// within a tenth of it [N].
double mean_load_in_level_ice(double step, int substeps) {
  double sum = 0;
  for (const double offset : {0.0, 1.1, 2.7, 4.4}) {
    Scene scene = Build()
                      .step(step)
                      .without_splits()
                      .ship(icebreaker({-1, offset}, ConstantSpeed{1}))
                      .floe(rectangle(0, -100, 300, 100));
    scene.contact.substeps = substeps;
    sum -= mean(run(scene, 120).story, &HullSample::from_ice, 0, 20.05);  // the bow breaks its way in first
  }
  return sum / 4;
}

TEST(CrushLaw, TheLoadInLevelIceIsNotTheSteps) {
  // docs/validation.md, "Contact, step and radius", has finer ones.
  const double fine = mean_load_in_level_ice(0.005, 1);
  EXPECT_NEAR(mean_load_in_level_ice(0.02, 1) / fine, 1, 0.10);
  EXPECT_NEAR(mean_load_in_level_ice(0.02, 4) / fine, 1, 0.05);
  EXPECT_GT(fine, 2e4);
}

// ---- collisions that crush by the impulse law, step by step: how long they take, and that they converge

constexpr double kApproachSpeed = 0.5;

/// A floe's corner runs into a fixed ship, along the normal of its flat bow.
Scene corner_into_bow(double hull_angle, double speed, double density, double step) {
  Ship bow = barge({0, 0}, ConstantSpeed{0}, 0);
  set_hull_angle(bow, hull_angle);
  Scene scene = Build(Laws::kPaper)
                    .unbreakable()
                    .without_drag()
                    .step(step)
                    .restitution(0)
                    .ship(bow)
                    .floe(diamond({0.01 * speed, 0}, 7), {-speed, 0});
  scene.ice.density = density;
  return scene;
}

/// Returns the time from the first contact to the end of the approach [s].
double time_of_compression(const Scene& scene) {
  Simulation simulation(scene);
  double start = -1;
  for (int step = 0; step < 200000; ++step) {
    simulation.step();
    if (start < 0 && !simulation.world().data.contacts.empty()) start = simulation.time();
    if (start >= 0 && simulation.floe_states()[0].velocity.x >= -1e-9) return simulation.time() - start;
  }
  return -1;
}

TEST(CrushingCollision, TakesMassToTheThirdOverSpeedToTheThirdAtAnInclinedHull) {
  // The time of compression is proportional to (m / k v)^⅓ if F = k ξ².
  const auto time = [](double speed, double density) {
    return time_of_compression(corner_into_bow(60 * kDegree, speed, density, 5e-4));
  };
  EXPECT_NEAR(std::log(time(kApproachSpeed, 7200) / time(kApproachSpeed, 900)) / std::log(8), 1.0 / 3, 0.01);
  EXPECT_NEAR(std::log(time(2 * kApproachSpeed, 900) / time(kApproachSpeed / 4, 900)) / std::log(8), -1.0 / 3, 0.01);
}

/// Two floes that meet corner to corner, a little off their centres, after `gap` [m].
Scene corner_to_corner(double step, double restitution, double gap) {
  return Build(Laws::kPaper)
      .without_drag()
      .step(step)
      .restitution(restitution)
      .floe(diamond({-14 - gap, 0.05}, 7))
      .floe(diamond({0, 0}, 10), {-1, 0.1});
}

std::vector<double> final_velocities(const Scene& scene) {
  std::vector<double> all;
  for (const FloeState& state : run(scene, 1).simulation.floe_states())
    all.insert(all.end(), {state.velocity.x, state.velocity.y, 7 * state.angular_velocity});
  return all;
}

TEST(CrushingCollision, ConvergesAsTheStepShrinks) {
  // When the first touch falls within its step is chance: the worst over several gaps is what converges.
  for (const double restitution : {0.0, 0.1}) {
    std::vector<double> errors(5, 0);
    for (int k = 0; k < 8; ++k) {
      const double gap = 1e-3 * (1 + k);
      const std::vector<double> reference = final_velocities(corner_to_corner(2e-5, restitution, gap));
      double step = 16e-3;
      for (double& error : errors) {
        step /= 2;
        const std::vector<double> found = final_velocities(corner_to_corner(step, restitution, gap));
        for (std::size_t i = 0; i < found.size(); ++i) error = std::max(error, std::abs(found[i] - reference[i]));
      }
    }
    EXPECT_GT(std::log(errors.front() / errors.back()) / std::log(16), 0.8) << "its order";
  }
}

TEST(CrushingCollision, LevelIceDependsOnTheRadiusALittle) {
  // The overlap does not, but a contact keeps its record within a quarter of the radius (docs/theory/index.md).
  const auto resistance = [](double radius) {
    Scene scene = Build(Laws::kPaper).ship(icebreaker({-2, 0}, ConstantSpeed{1})).floe(rectangle(0, -75, 300, 75));
    scene.contact.circle_radius = radius;
    return -mean(run(scene, 130).story, &HullSample::from_ice, 0, 30.05);
  };
  const double fine = resistance(0.5), coarse = resistance(2);
  EXPECT_GT(fine, 1e4);
  EXPECT_NE(fine, coarse);
  EXPECT_NEAR(coarse / fine, 1, 0.15);
}

TEST(CrushingCollision, ByCircleCentresIsFeltLaterByAShareOfTheRadius) {
  // The paper's rule: the circle of a corner stays off its tip by a share of the radius. The first touch is therefore
  // late by that share, and approaches the touch of the boundary as the radius shrinks. The normals do not converge,
  // because a row of circles is equally bumpy at any radius.
  const auto depth_at_touch = [](double radius) {
    Scene scene = Build(Laws::kPaper)
                      .without_drag()
                      .step(1e-4)
                      .floe(rectangle(-20.003, -15, -0.003, 9))
                      .floe(diamond({0, 2.2}, 7), {-0.5, 0.05});
    scene.contact.circle_radius = radius;
    scene.contact.normal = ContactNormal::kCircleCentres;
    Simulation simulation(scene);
    while (simulation.world().data.contacts.empty() && simulation.time() < 20) simulation.step();
    return 0.5 * simulation.time() - 0.003;
  };
  std::vector<double> lags;
  for (const double radius : {2.0, 1.0, 0.5, 0.25, 0.125, 0.0625}) {
    lags.push_back(depth_at_touch(radius));
    EXPECT_GT(lags.back(), 0);
    EXPECT_LT(lags.back(), radius);
  }
  EXPECT_NEAR(std::log(lags.front() / lags.back()) / std::log(32), 1, 0.3) << "its order";
}

/// A corner of 90° that moves onto a wall has F = 2 σ_c h ξ. At the depth ξ it has given the impulse σ_c h ξ²/v,
/// wherever within a step it touches the wall.
TEST(CrushLaw, ACornerHasGivenTheImpulseOfItsDepthThoughItIsFoundLate) {
  const double speed = 0.5, step = 0.05, half = 60;
  for (const double share : {0.1, 0.5, 0.9}) {  // of the way of a step, at which the contact is found
    const double gap = (2 - share) * speed * step;
    const geometry::Polygon corner{{{-gap, 0}, {-gap - half, half}, {-gap - 2 * half, 0}, {-gap - half, -half}}, {}};
    Build scene = Build().step(step).without_drag().without_splits().unbreakable().floe(corner, {speed, 0});
    scene.structure({{0, -5}, {10, -5}, {10, 5}, {0, 5}});
    scene.ice.friction = 0;
    Simulation simulation(scene);
    const FloeState before = simulation.floe_states()[0];
    while (simulation.floe_states()[0].velocity.x == before.velocity.x && simulation.time() < 1) skip(simulation);
    const FloeState after = simulation.floe_states()[0];
    const double depth = after.world_from_body.position.x - before.world_from_body.position.x - gap;
    ASSERT_GT(depth, 0);
    const double expected = scene.ice.compressive_strength * scene.ice.thickness * depth * depth / speed;
    EXPECT_NEAR(before.mass * (before.velocity.x - after.velocity.x) / expected, 1, 0.01) << share;
  }
}

}  // namespace
}  // namespace polynya::simulation
