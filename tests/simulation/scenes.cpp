#include "tests/simulation/scenes.hpp"

#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace polynya::simulation::scenes {
FloeSpec fast(const geometry::Polygon& polygon, geometry::Vector velocity) {
  FloeSpec spec = floe(polygon, velocity);
  spec.is_fast = true;
  return spec;
}

Ship icebreaker(geometry::Point stem, const Propulsion& propulsion, double speed) {
  Ship ship;
  ship.name = "icebreaker";
  ship.hull.waterline = wedge_bow_waterline(120, 24, 27 * kDegree);
  ship.hull.stem_angle = 30 * kDegree;
  ship.mass = 1e7;
  ship.moment_of_inertia = 5e9;
  ship.position_in_world = {stem.x - 60, stem.y};
  ship.speed = speed;
  ship.propulsion = propulsion;
  return ship;
}

Ship steep_icebreaker(geometry::Point stem, const Propulsion& propulsion, double speed) {
  Ship ship = icebreaker(stem, propulsion, speed);
  set_hull_angle(ship, 0);
  return ship;
}

Ship barge(geometry::Point middle_of_bow, const Propulsion& propulsion, double speed) {
  Ship ship = icebreaker(middle_of_bow, propulsion, speed);
  ship.name = "barge";
  ship.hull.waterline = rectangle(-60, -12, 60, 12).outer;
  set_hull_angle(ship, 0);
  return ship;
}

Ship with_draught(Ship ship) {
  ship.hull.draught = 6;
  return ship;
}

Ship in_water(Ship ship) {
  ship.water.acts = true;
  ship.water.block_coefficient = 0.579;
  return with_draught(ship);
}

void set_hull_angle(PlacedHull& ship, double angle) {
  ship.hull.angles_from_vertical.assign(ship.hull.waterline.size(), angle);
}

MooringSettings moored(geometry::Point at, const dynamics::Planar& stiffness, const dynamics::Planar& damping,
                       double break_load, double heading) {
  return {.position_in_world = at,
          .heading = heading,
          .surge_stiffness = stiffness.surge,
          .sway_stiffness = stiffness.sway,
          .yaw_stiffness = stiffness.yaw,
          .surge_damping = damping.surge,
          .sway_damping = damping.sway,
          .yaw_damping = damping.yaw,
          .break_load = break_load};
}

WallMotion pressing(double line_load) {
  return {{}, WallPressure{.line_load = line_load}};
}

WallMotion moving(geometry::Vector velocity) {
  return {velocity, {}};
}

Build::Build(Laws laws) {
  if (laws == Laws::kDefault) return;
  contact.law = ContactLaw::kImpulse;
  contact.iterations = 30;
  fracture.radial_cracks = fracture::RadialCracks::kIgnored;
  fracture.splitting = fracture::SplittingModel::kMichel;
}

Build& Build::structure(const geometry::Ring& waterline, geometry::Point at, double wall_angle) {
  Structure structure;
  structure.name = "structure";
  structure.hull.waterline = waterline;
  set_hull_angle(structure, wall_angle);
  structure.position_in_world = at;
  structures.push_back(structure);
  return *this;
}

Build& Build::wall(geometry::Point from, geometry::Point to, const WallMotion& motion) {
  walls.push_back(wall_between(from, to, 5));
  walls.back().velocity = motion.velocity;
  walls.back().pressure = motion.pressure;
  return *this;
}

Build& Build::under_hulls(bool come_up) {
  fracture.going_under.is_enabled = true;
  fracture.resurface.is_enabled = come_up;
  return cusps(CuspFate::kUnderHull);
}

Build& Build::grid(geometry::Point low, int columns, int rows, double side, double pitch) {
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < rows; ++row) floe(shapes::square({low.x + pitch * column, low.y + pitch * row}, side));
  return *this;
}

Build& Build::of(const fracture::Ice& its_own) {
  floes.back().own_ice = static_cast<std::int32_t>(own_ice.size());
  own_ice.push_back(its_own);
  return *this;
}

Build ship_in_pack(Laws laws) {
  Ship ship = icebreaker({0, 0}, ConstantThrust{2e6}, 2);
  ship.heading = 0.1;
  return Build(laws).drift({0.2, -0.1}).ship(ship).grid({2, -26}, 2, 5, 10, 10.5).floe(rectangle(26, -60, 86, 60));
}

void listen(Simulation& simulation, Story& story) {
  Journal& journal = simulation.journal();
  const auto take = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  take(story.events, journal.events);
  take(story.births, journal.births);
  take(story.deaths, journal.deaths);
  take(story.samples, journal.samples);
  take(story.peaks, journal.peaks);
  take(story.panels, journal.panels);
  journal.clear();
}

Story run(Simulation& simulation, double until) {
  Story story;
  listen(simulation, story);
  while (simulation.time() < until - 1e-9 && !simulation.numerical_failure()) {
    simulation.step();
    listen(simulation, story);
  }
  return story;
}

Trial run(const Scene& scene, double until, Shortcuts shortcuts) {
  Trial run{Simulation(scene, shortcuts), {}};
  run.story = scenes::run(run.simulation, until);
  return run;
}

Trial run_until(const Scene& scene, double until, const std::function<bool(const Trial&)>& is_enough) {
  Trial trial{Simulation(scene), {}};
  while (trial.simulation.time() < until - 1e-9 && !trial.simulation.numerical_failure()) {
    trial.simulation.step();
    listen(trial.simulation, trial.story);
    if (is_enough(trial)) break;
  }
  return trial;
}

Trial run(const Scene& scene, double until, const std::function<void(const Simulation&)>& after_step) {
  return run_until(scene, until, [&](const Trial& trial) {
    after_step(trial.simulation);
    return false;
  });
}

Trial run_to_first_event(const Scene& scene, double until) {
  return run_until(scene, until, [](const Trial& trial) { return !trial.story.events.empty(); });
}

void skip(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) {
    simulation.step();
    simulation.journal().clear();
  }
}

Event first_bend(const Scene& scene, double until) {
  const auto has_bent = [](const Trial& trial) { return !trial.story.bends().empty(); };
  const std::vector<Event> bends = run_until(scene, until, has_bent).story.bends();
  EXPECT_FALSE(bends.empty()) << "nothing bent";
  return bends.empty() ? Event{} : bends.front();
}

double mean(const Story& story, dynamics::Planar HullSample::*load, int ship, double from,
            double dynamics::Planar::*direction) {
  double sum = 0;
  int count = 0;
  for (const HullSample& sample : story.samples) {
    if (sample.ship != ship || sample.time < from) continue;
    sum += (sample.*load).*direction;
    ++count;
  }
  return sum / count;
}

double largest(const Story& story, dynamics::Planar HullSample::*load, int ship) {
  double most = 0;
  for (const HullSample& sample : story.samples)
    if (sample.ship == ship) most = std::max(most, std::abs((sample.*load).surge));
  return most;
}

double largest_contact_force(const Simulation& simulation) {
  double most = 0;
  for (const dynamics::Contact& c : simulation.world().data.contacts)
    most = std::max(most, c.step_share * c.total_normal_impulse() / simulation.scene().time.step);
  return most;
}

double least_child(const Story& story, const Event& event) {
  double least = std::numeric_limits<double>::infinity();
  for (const Birth& birth : story.births)
    if (std::ranges::count(event.ice()->children, birth.floe) > 0) least = std::min(least, birth.area);
  return least;
}

void expect_closed(const Simulation& simulation) {
  constexpr double kClosed = 1e-11;  // share of the turnover: what rounding leaves
  const Audit audit = simulation.audit();
  EXPECT_LE(std::abs(audit.energy_imbalance), kClosed * audit.turnover);
  EXPECT_LE(length(audit.momentum_imbalance), kClosed * audit.momentum_turnover);
  EXPECT_TRUE(audit.is_closed());
  const IceLedger areas = simulation.area_ledger();
  EXPECT_LE(std::abs(areas.imbalance()), 1e-9 * areas.initial);
  const IceLedger masses = simulation.mass_ledger();
  EXPECT_LE(std::abs(masses.imbalance()), 1e-9 * masses.initial);
}

Simulation resumed(const Scene& scene, const Simulation& simulation) {
  auto again = Simulation::resumed(scene, simulation.state());
  EXPECT_TRUE(again.has_value()) << again.error();
  return std::move(*again);
}

Trial expect_resumes(const Scene& scene, double from, double until, int threads) {
  Simulation whole(scene);
  run(whole, from);
  Trial again{resumed(scene, whole), {}};
  EXPECT_EQ(again.simulation.state_hash(), whole.state_hash()) << "what is read back is what was written";
  again.simulation.set_threads(threads);
  run(whole, until);
  again.story = run(again.simulation, until);
  EXPECT_EQ(again.simulation.state_hash(), whole.state_hash());
  return again;
}

}  // namespace polynya::simulation::scenes
