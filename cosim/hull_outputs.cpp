#include "cosim/hull_outputs.hpp"

#include <array>

#include "elementary/elementary.hpp"

namespace polynya::cosim {
namespace {

using simulation::HullSample;

/// Velocity over ground in the ship's axes [m/s].
geometry::Vector in_ship(const HullSample& s) {
  return rotate_back(geometry::Rotation::by(s.heading), s.velocity_in_world);
}

template <dynamics::Planar HullSample::*Load>
double surge(const HullOutputs& o) {
  return (o.sample.*Load).surge;
}
template <dynamics::Planar HullSample::*Load>
double sway(const HullOutputs& o) {
  return (o.sample.*Load).sway;
}
template <dynamics::Planar HullSample::*Load>
double yaw(const HullOutputs& o) {
  return (o.sample.*Load).yaw;
}

constexpr bool kCount = true, kOfShips = true;

constexpr HullOutput kOutputs[] = {
    {"x_m", "m", "position of the centre of gravity, world frame", false, kOfShips,
     [](const HullOutputs& o) { return o.sample.position_in_world.x; }},
    {"y_m", "m", "position of the centre of gravity, world frame", false, kOfShips,
     [](const HullOutputs& o) { return o.sample.position_in_world.y; }},
    {"heading_rad", "rad", "heading from the x axis, counter-clockwise, full turns included", false, kOfShips,
     [](const HullOutputs& o) { return o.sample.heading; }},
    {"vx_m_per_s", "m/s", "velocity over ground, world frame", false, kOfShips,
     [](const HullOutputs& o) { return o.sample.velocity_in_world.x; }},
    {"vy_m_per_s", "m/s", "velocity over ground, world frame", false, kOfShips,
     [](const HullOutputs& o) { return o.sample.velocity_in_world.y; }},
    {"yaw_rate_rad_per_s", "rad/s", "yaw rate, counter-clockwise", false, kOfShips,
     [](const HullOutputs& o) { return o.sample.yaw_rate; }},
    {"surge_m_per_s", "m/s", "speed over ground ahead", false, kOfShips,
     [](const HullOutputs& o) { return in_ship(o.sample).x; }},
    {"sway_m_per_s", "m/s", "speed over ground to port", false, kOfShips,
     [](const HullOutputs& o) { return in_ship(o.sample).y; }},
    {"ice.surge_N", "N", "force of the ice around the hull, ahead", false, false, surge<&HullSample::from_ice>},
    {"ice.sway_N", "N", "force of the ice around the hull, to port", false, false, sway<&HullSample::from_ice>},
    {"ice.yaw_Nm", "N.m", "moment of the ice around the hull", false, false, yaw<&HullSample::from_ice>},
    {"ice_friction.surge_N", "N", "part of ice.surge_N that friction causes", false, kOfShips,
     surge<&HullSample::friction_of_ice>},
    {"ice_friction.sway_N", "N", "part of ice.sway_N that friction causes", false, kOfShips,
     sway<&HullSample::friction_of_ice>},
    {"ice_friction.yaw_Nm", "N.m", "part of ice.yaw_Nm that friction causes", false, kOfShips,
     yaw<&HullSample::friction_of_ice>},
    {"submerged_ice.surge_N", "N", "force of ice under the hull and of cusps that it presses down, ahead", false, false,
     surge<&HullSample::from_submerged>},
    {"submerged_ice.sway_N", "N", "force of ice under the hull and of cusps that it presses down, to port", false,
     false, sway<&HullSample::from_submerged>},
    {"submerged_ice.yaw_Nm", "N.m", "moment of ice under the hull and of cusps that it presses down", false, false,
     yaw<&HullSample::from_submerged>},
    {"hulls.surge_N", "N", "force of contacts with other hulls, ahead", false, false, surge<&HullSample::from_ships>},
    {"hulls.sway_N", "N", "force of contacts with other hulls, to port", false, false, sway<&HullSample::from_ships>},
    {"hulls.yaw_Nm", "N.m", "moment of contacts with other hulls", false, false, yaw<&HullSample::from_ships>},
    {"water.surge_N", "N", "force of the water on the hull, with its inertia, ahead", false, kOfShips,
     surge<&HullSample::from_water>},
    {"water.sway_N", "N", "force of the water on the hull, with its inertia, to port", false, kOfShips,
     sway<&HullSample::from_water>},
    {"water.yaw_Nm", "N.m", "moment of the water on the hull, with its inertia", false, kOfShips,
     yaw<&HullSample::from_water>},
    {"engine.surge_N", "N", "force of the propellers or thrusters, ahead", false, kOfShips,
     surge<&HullSample::from_engine>},
    {"engine.sway_N", "N", "force of the propellers or thrusters, to port", false, kOfShips,
     sway<&HullSample::from_engine>},
    {"engine.yaw_Nm", "N.m", "moment of the propellers or thrusters", false, kOfShips, yaw<&HullSample::from_engine>},
    {"rudder.surge_N", "N", "force of the rudders, ahead", false, kOfShips, surge<&HullSample::from_rudder>},
    {"rudder.sway_N", "N", "force of the rudders, to port", false, kOfShips, sway<&HullSample::from_rudder>},
    {"rudder.yaw_Nm", "N.m", "moment of the rudders", false, kOfShips, yaw<&HullSample::from_rudder>},
    {"mooring.surge_N", "N", "force of the mooring, ahead", false, kOfShips, surge<&HullSample::from_mooring>},
    {"mooring.sway_N", "N", "force of the mooring, to port", false, kOfShips, sway<&HullSample::from_mooring>},
    {"mooring.yaw_Nm", "N.m", "moment of the mooring", false, kOfShips, yaw<&HullSample::from_mooring>},
    {"largest_ice_force_N", "N", "largest horizontal force of the ice around the hull in one time step", false, false,
     [](const HullOutputs& o) {
       return elementary::hypot(o.sample.from_ice_largest.surge, o.sample.from_ice_largest.sway);
     }},
    {"largest_contact_N", "N", "largest force of one contact with ice, at the ends of ticks", false, false,
     [](const HullOutputs& o) { return o.largest_contact; }},
    {"contacts", "", "number of contacts with ice at the end", kCount, false,
     [](const HullOutputs& o) { return static_cast<double>(o.sample.contacts); }},
    {"cover_ahead", "", "share of the water ahead that ice covers: a length far, a beam wide", false, kOfShips,
     [](const HullOutputs& o) { return o.cover_ahead; }},
    {"lever", "", "thrust lever, -1 to 1", false, kOfShips, [](const HullOutputs& o) { return o.sample.lever; }},
    {"steering_angle_rad", "rad", "angle of rudder or thrusters, to port", false, kOfShips,
     [](const HullOutputs& o) { return o.sample.steering_angle; }},
};

}  // namespace

std::span<const HullOutput> hull_outputs() {
  return kOutputs;
}

}  // namespace polynya::cosim
