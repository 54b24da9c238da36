#include <algorithm>

#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using geometry::Vector;

/// Returns all hulls in the form in which pilots see them, at the start of the step.
std::vector<SeenHull> seen_hulls(const Setup& setup, const Step& step, const Population& population) {
  const dynamics::Bodies& bodies = population.bodies;
  std::vector<SeenHull> seen;
  for (std::size_t i = 0; i < hull_count(setup.scene); ++i) {
    const geometry::Box box = bounding_box(hull_of(setup.scene, i).hull.waterline);
    seen.push_back({.position_in_world = bodies.position[i] + step.begin.drift,
                    .heading = bodies.angle[i],
                    .velocity = bodies.velocity[i] + population.water_velocity,
                    .length = box.high.x - box.low.x,
                    .stern = box.low.x,
                    .stem = box.high.x,
                    .is_wall = kind_of_hull(setup.scene, i) == BodyKind::kWall,
                    .is_fixed = is_grounded(kind_of_hull(setup.scene, i))});
    if (i >= population.helms.size()) continue;
    seen.back().lap_share = population.helms[i].memory.pattern.lap_share;
    seen.back().target_floe = population.helms[i].memory.pattern.target;
  }
  return seen;
}

/// Returns all floating floes in the form in which pilots see them, at the start of the step.
std::vector<SeenFloe> seen_floes(const Step& step, const Population& population) {
  std::vector<SeenFloe> seen;
  const Vector drift = step.begin.drift;
  for (FloeId id = 0; id < population.floe_count(); ++id)
    if (population.is_floating(id))
      seen.push_back({id, population.bodies.position[population.body_of(id)] + drift, population.floes[id].area});
  return seen;
}

/// Returns the yaw acceleration per angle of rudder or thrusters near amidships, at the present thrust and speed
/// [1/s²].
double steering_gain(const Sailing& sailing, const PilotView& view, double moment) {
  constexpr double kAngle = 0.05;  // angle at which the force is evaluated on both sides [rad]
  const double thrust = dynamics::propeller_thrust(*sailing.engine, view.lever, view.through_water.surge);
  const auto yaw_at = [&](double angle) {
    return sailing.rudder ? dynamics::rudder_force(*sailing.rudder, angle, {view.through_water.surge, 0, 0}, thrust,
                                                   sailing.hull.density)
                                .yaw
                          : dynamics::turned_thrust(thrust, angle, sailing.stern).yaw;
  };
  if (!sailing.rudder && !sailing.has_azimuth) return 0;
  const double inertia = moment + sailing.hull.added_mass.rows[2].yaw;
  return (yaw_at(kAngle) - yaw_at(-kAngle)) / (2 * kAngle * inertia);
}

/// Returns the data that the pilot of ship i receives in the step.
PilotView view_of(const Setup& setup, const Step& step, const Population& population, std::span<const SeenHull> hulls,
                  BodyIndex i) {
  const dynamics::Bodies& bodies = population.bodies;
  const Sailing& sailing = setup.sailing[i];
  const Helm& helm = population.helms[i];
  const Vector through_water =
      rotate_back(bodies.rotation[i], bodies.velocity[i] - setup.current.velocity_at(bodies.position[i]));
  const Vector over_ground = rotate_back(bodies.rotation[i], hulls[i].velocity);
  PilotView view;
  view.time = step.begin.time;
  view.step = step.length;
  view.ship = i;
  view.hulls = hulls;
  view.through_water = {through_water.x, through_water.y, bodies.angular_velocity[i]};
  view.speed_over_ground = over_ground.x;
  view.lever = helm.lever;
  view.steering_angle = helm.steering_angle;
  view.steering_most = sailing.steering_most;
  view.ice_force = helm.ice_force;
  view.ice_drift = free_drift(setup.scene, step.begin.time);
  view.floes = [&step, &population] { return seen_floes(step, population); };
  view.engine = *sailing.engine;
  view.mass = bodies.mass[i] + sailing.hull.added_mass.rows[0].surge;
  view.steering_gain = steering_gain(sailing, view, bodies.moment[i]);
  return view;
}

/// Returns a command with its values limited to the stops.
Command limited(Command command, const Sailing& sailing) {
  const auto within = [](double value, double most) {
    // a value that is not a number becomes 0: amidships, or stop
    return value == value ? std::clamp(value, -most, most) : 0;
  };
  return {within(command.lever, 1), within(command.steering_angle, sailing.steering_most)};
}

/// Returns the command of a ship's pilot: of the one from outside if there is one, and of the scene's otherwise.
Command commanded(const Setup& setup, const PilotView& view, const std::vector<ExternalPilot>& external, Helm& helm) {
  const auto i = static_cast<std::size_t>(view.ship);
  const bool is_external = i < external.size() && external[i];
  return limited(is_external ? external[i](view) : command_of(setup.scene.ships[i].pilot, view, helm.memory),
                 setup.sailing[i]);
}

}  // namespace

void initialize_helms(const Setup& setup, const Step& step, Population& population) {
  population.helms.resize(setup.scene.ships.size());
  const std::vector<SeenHull> hulls = seen_hulls(setup, step, population);
  for (BodyIndex i = 0; i < std::ssize(population.helms); ++i) {
    if (!setup.sailing[i].engine) continue;
    Helm& helm = population.helms[i];
    helm.memory = memory_at_start(view_of(setup, step, population, hulls, i));
    PilotMemory untouched = helm.memory;
    const Command first =
        limited(command_of(setup.scene.ships[i].pilot, view_of(setup, step, population, hulls, i), untouched),
                setup.sailing[i]);
    helm.lever = first.lever;
    helm.steering_angle = first.steering_angle;
  }
}

void steer(const Setup& setup, const Step& step, const std::vector<ExternalPilot>& external, Population& population) {
  if (std::ranges::none_of(setup.sailing, [](const Sailing& s) { return s.engine.has_value(); })) return;
  const std::vector<SeenHull> hulls = seen_hulls(setup, step, population);
  for (BodyIndex i = 0; i < std::ssize(population.helms); ++i) {
    const Sailing& sailing = setup.sailing[i];
    if (!sailing.engine) continue;
    Helm& helm = population.helms[i];
    const PilotView view = view_of(setup, step, population, hulls, i);
    const Command command = commanded(setup, view, external, helm);
    helm.lever = dynamics::approach(helm.lever, command.lever, sailing.engine->lever_rate, step.length);
    helm.steering_angle =
        dynamics::approach(helm.steering_angle, command.steering_angle, sailing.steering_rate, step.length);
  }
}

}  // namespace polynya::simulation
