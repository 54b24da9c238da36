#include "simulation/ship/pilot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elementary/elementary.hpp"

namespace polynya::simulation {
namespace {

using geometry::Point;
using geometry::Vector;

constexpr double kSpeedTime = 20;  ///< Time constant of closing an error of speed [s]. Shorter: the lever moves more.
/// Steering angle per error of heading [-]. Larger: faster turns, and the steering reaches its stops more often.
constexpr double kHeadingGain = 3;
/// Damping of the heading control, as a fraction of critical damping [-]. Smaller values overshoot.
constexpr double kHeadingDamping = 0.7;
/// Smallest yaw acceleration per angle at which the steering is used [1/s²]. Below it the ship hardly moves, and the
/// steering has no effect.
constexpr double kLeastGain = 1e-6;
/// Smallest speed ahead over ground at which the course over ground is used [m/s]. At lower speeds and astern its
/// direction says nothing about the current.
constexpr double kLeastWay = 0.3;
/// Time constant with which the drift angle is smoothed [s]. Shorter: the heading follows single floes.
constexpr double kDriftTime = 60;
/// Length of the ship over the radius of its turn above which it counts as turning [-]. Its drift angle is then not due
/// to the current. Larger values mix the drift angles of turns into that of the current.
constexpr double kTurning = 0.1;
/// Time constant of closing an error of the distance to a leader [s]. Shorter: the speed follows the error more closely
/// and may overshoot.
constexpr double kGapTime = 60;

/// Returns the lever that gives a thrust [N] at rest; thrust is proportional to the power 2/3 of the lever.
double lever_for(const dynamics::Engine& engine, double thrust) {
  const double most = thrust < 0 ? engine.astern_share * engine.bollard_pull : engine.bollard_pull;
  if (most <= 0) return 0;
  return std::copysign(std::min(1.0, elementary::pow(std::abs(thrust) / most, 1.5)), thrust);
}

}  // namespace

double wrapped(double angle) {
  return std::remainder(angle, 2 * std::numbers::pi);
}
Vector unit(double angle) {
  return {elementary::cos(angle), elementary::sin(angle)};
}
double angle_of(Vector v) {
  return elementary::atan2(v.y, v.x);
}

double lever_to_hold(double speed, const PilotView& view, PilotMemory& memory) {
  const dynamics::Engine& engine = view.engine;
  const double open_water = -dynamics::net_thrust(engine, 0, speed);
  const double error = speed - view.through_water.surge;
  const double thrust = open_water + view.mass * (error / kSpeedTime + memory.speed_integral);
  const double lever = lever_for(engine, thrust);
  const double growth = error / (4 * kSpeedTime * kSpeedTime) * view.step;
  if (std::abs(lever) < 1 || lever * growth < 0) memory.speed_integral += growth;
  return lever;
}

double steering_to_hold(double heading, const PilotView& view) {
  if (view.steering_most == 0 || std::abs(view.steering_gain) < kLeastGain) return 0;
  const double error = wrapped(heading - view.own().heading);
  const double damping = 2 * kHeadingDamping * std::sqrt(kHeadingGain / std::abs(view.steering_gain));
  const double angle = kHeadingGain * error - damping * view.through_water.yaw;
  return std::copysign(1.0, view.steering_gain) * angle;
}

namespace {

/// Returns a heading of the scene, or the heading at the start if the scene gives none (kAsAtStart).
double chosen(double heading, const PilotMemory& memory) {
  return std::isfinite(heading) ? heading : memory.heading;
}

Command steer(const ConstantPilot& pilot, const PilotView&, PilotMemory&) {
  return {pilot.lever, pilot.steering_angle};
}

Command steer(const SpeedPilot& pilot, const PilotView& view, PilotMemory& memory) {
  return {lever_to_hold(pilot.speed, view, memory), steering_to_hold(chosen(pilot.heading, memory), view)};
}

Command steer(const HeadingPilot& pilot, const PilotView& view, PilotMemory& memory) {
  return {pilot.lever, steering_to_hold(chosen(pilot.heading, memory), view)};
}

/// Selects the next waypoint when the ship has reached or passed one.
void go_on(const RoutePilot& pilot, const PilotView& view, PilotMemory& memory) {
  const auto count = static_cast<std::int32_t>(pilot.waypoints.size());
  while (memory.waypoint < count) {
    const Point to = pilot.waypoints[static_cast<std::size_t>(memory.waypoint)].position_in_world;
    const Vector left = to - view.own().position_in_world;
    const bool is_passed = dot(left, to - memory.from) <= 0;
    if (length(left) > pilot.arrival * view.own().length && !is_passed) return;
    memory.from = to;
    ++memory.waypoint;
  }
}

/// Returns the smoothed angle from the ship's heading to its course over ground, positive to port [rad]. It is not
/// updated in a turn, whose own drift angle is not due to the current.
double drift_angle(const PilotView& view, PilotMemory& memory) {
  const SeenHull& own = view.own();
  const bool is_turning = std::abs(view.through_water.yaw) * own.length > kTurning * view.speed_over_ground;
  if (view.speed_over_ground > kLeastWay && !is_turning) {
    const double angle = wrapped(angle_of(own.velocity) - own.heading);
    memory.drift_angle += std::min(1.0, view.step / kDriftTime) * (angle - memory.drift_angle);
  }
  return memory.drift_angle;
}

/// Steers by line of sight [Fossen2011]: the course over ground leads to the point of the leg that is `ahead` metres
/// farther along it.
Command steer(const RoutePilot& pilot, const PilotView& view, PilotMemory& memory) {
  const Point leg_from = memory.from;
  go_on(pilot, view, memory);
  // The ship stops on its course after the last waypoint.
  if (memory.waypoint >= static_cast<std::int32_t>(pilot.waypoints.size())) {
    const double course = angle_of(memory.from - leg_from);
    if (memory.from != leg_from) memory.heading = course;
    return {lever_to_hold(0, view, memory), steering_to_hold(memory.heading, view)};
  }
  const Waypoint& to = pilot.waypoints[static_cast<std::size_t>(memory.waypoint)];
  const double course = angle_of(to.position_in_world - memory.from);
  const double ahead = pilot.look_ahead * view.own().length;
  const double offset = cross(unit(course), view.own().position_in_world - memory.from);
  memory.heading = course;
  const double wanted = course - elementary::atan2(offset, ahead) - drift_angle(view, memory);
  return {lever_to_hold(to.speed, view, memory), steering_to_hold(wanted, view)};
}

Command steer(const TablePilot& pilot, const PilotView& view, PilotMemory&) {
  const auto after = std::ranges::upper_bound(pilot.rows, view.time, {}, &TableRow::time);
  if (after == pilot.rows.begin()) return {after->lever, after->steering_angle};
  const TableRow& from = *(after - 1);
  if (after == pilot.rows.end()) return {from.lever, from.steering_angle};
  const double share = (view.time - from.time) / (after->time - from.time);
  return {from.lever + share * (after->lever - from.lever),
          from.steering_angle + share * (after->steering_angle - from.steering_angle)};
}

Command steer(const RammingPilot& pilot, const PilotView& view, PilotMemory& memory) {
  return ram(pilot, chosen(pilot.heading, memory), view, memory);
}

/// Steers to the leader's stern. The ordered speed through the water is the leader's speed over ground, corrected by
/// the error of the distance. In a current c from ahead the distance therefore settles at c · kGapTime above the
/// ordered one, and in a current from astern below it.
Command steer(const FollowingPilot& pilot, const PilotView& view, PilotMemory& memory) {
  const SeenHull& own = view.own();
  const SeenHull& leader = view.hulls[static_cast<std::size_t>(pilot.leader)];
  const Vector ahead = unit(own.heading);
  const Point stern = leader.position_in_world + leader.stern * unit(leader.heading);
  const Point stem = own.position_in_world + own.stem * ahead;
  const Vector way = stern - stem;
  const double gap = length(way);
  const double wanted = dot(leader.velocity, ahead) + (gap - pilot.distance) / kGapTime;
  return {lever_to_hold(std::max(0.0, wanted), view, memory), steering_to_hold(angle_of(way), view)};
}

}  // namespace

PilotMemory memory_at_start(const PilotView& view) {
  PilotMemory memory;
  memory.heading = view.own().heading;
  memory.from = view.own().position_in_world;
  memory.slow_since = view.time;
  memory.pattern.next_choice = view.time;
  return memory;
}

Command command_of(const PilotSettings& pilot, const PilotView& view, PilotMemory& memory) {
  return std::visit([&](const auto& settings) { return steer(settings, view, memory); }, pilot);
}

}  // namespace polynya::simulation
