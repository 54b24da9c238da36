#include "io/scene/scene_field_parts.hpp"

namespace polynya::io {
namespace {

using simulation::ConstantPilot;
using simulation::FollowingPilot;
using simulation::HeadingPilot;
using simulation::RammingPilot;
using simulation::RoutePilot;
using simulation::SpeedPilot;
using simulation::TablePilot;
using Draft = SceneDraft;
using Value = JsonValue;
using Kind = FieldKind;

/// The pilot of the ship being read, of that kind.
template <class Pilot>
Pilot& pilot(Draft& d) {
  simulation::PilotSettings& settings = d.ship().pilot;
  if (!std::holds_alternative<Pilot>(settings)) settings = Pilot{};
  return std::get<Pilot>(settings);
}

Range lever_range() {
  return from(-1, 1);
}
Range speed_range() {
  return from(-20, 20);
}
Field heading(void (*set)(Draft&, const Value&)) {
  return field("heading_deg", Kind::kNumber, "°", from(-360, 360), kLeftOut,
               "to hold where the ship can be steered; if not given, its own at the start", set);
}

const Object kConstant{
    {field("lever", Kind::kNumber, "", lever_range(), "1", "of the thrust",
           [](Draft& d, const Value& v) { pilot<ConstantPilot>(d).lever = v.number(); }),
     field("steering_deg", Kind::kNumber, "°", from(-180, 180), "0", "of rudder or thrusters, to port",
           [](Draft& d, const Value& v) { pilot<ConstantPilot>(d).steering_angle = radians(v); })}};

const Object kHoldSpeed{
    {field("speed_m_per_s", Kind::kNumber, "m/s", speed_range(), "", "ahead through the water",
           [](Draft& d, const Value& v) { pilot<SpeedPilot>(d).speed = v.number(); }),
     heading([](Draft& d, const Value& v) { pilot<SpeedPilot>(d).heading = radians(v); })}};

const Object kHoldHeading{
    {heading([](Draft& d, const Value& v) { pilot<HeadingPilot>(d).heading = radians(v); }),
     field("lever", Kind::kNumber, "", lever_range(), "1", "of the thrust",
           [](Draft& d, const Value& v) { pilot<HeadingPilot>(d).lever = v.number(); })}};

simulation::Waypoint& waypoint(Draft& d) {
  return pilot<RoutePilot>(d).waypoints.back();
}
const Object kWaypoint{
    {field("position_m", Kind::kVector, "m", coordinate(), "", "over ground",
           [](Draft& d, const Value& v) { waypoint(d).position_in_world = point_of(v); }),
     field("speed_m_per_s", Kind::kNumber, "m/s", above(0, 20), "", "on the leg to it, through the water",
           [](Draft& d, const Value& v) { waypoint(d).speed = v.number(); })},
    {},
    [](Draft& d) { pilot<RoutePilot>(d).waypoints.emplace_back(); }};

const Object kRoute{{field("waypoints", Kind::kList, "", {1, 1000}, "",
                           "in their order; the ship stops after the last", nullptr, {}, "", &kWaypoint),
                     field("look_ahead_lengths", Kind::kNumber, "", above(0, 100), "2.5",
                           "how far ahead on the leg it steers to, of its length",
                           [](Draft& d, const Value& v) { pilot<RoutePilot>(d).look_ahead = v.number(); }),
                     field("arrival_lengths", Kind::kNumber, "", above(0, 100), "1",
                           "a waypoint is reached this near to it, of the ship's length",
                           [](Draft& d, const Value& v) { pilot<RoutePilot>(d).arrival = v.number(); })}};

simulation::TableRow& row(Draft& d) {
  return pilot<TablePilot>(d).rows.back();
}
const Object kRow{
    {field("t_s", Kind::kNumber, "s", from(0, 1e7), "", "when; ascending",
           [](Draft& d, const Value& v) { row(d).time = v.number(); }),
     field("lever", Kind::kNumber, "", lever_range(), "", "of the thrust",
           [](Draft& d, const Value& v) { row(d).lever = v.number(); }),
     field("steering_deg", Kind::kNumber, "°", from(-180, 180), "0", "of rudder or thrusters, to port",
           [](Draft& d, const Value& v) { row(d).steering_angle = radians(v); })},
    {},
    [](Draft& d) { pilot<TablePilot>(d).rows.emplace_back(); }};

const Object kTable{
    {field("rows", Kind::kList, "", {1, 10000}, "", "linear between them", nullptr, {}, "", &kRow)}};

const Object kRam{
    {heading([](Draft& d, const Value& v) { pilot<RammingPilot>(d).heading = radians(v); }),
     field("lever_ahead", Kind::kNumber, "", above(0, 1), "1", "when it charges",
           [](Draft& d, const Value& v) { pilot<RammingPilot>(d).lever_ahead = v.number(); }),
     field("lever_astern", Kind::kNumber, "", below(-1, 0), "-1", "when it backs",
           [](Draft& d, const Value& v) { pilot<RammingPilot>(d).lever_astern = v.number(); }),
     field("stuck_speed_m_per_s", Kind::kNumber, "m/s", above(0, 20), "0.1", "slower over ground is stuck",
           [](Draft& d, const Value& v) { pilot<RammingPilot>(d).stuck_speed = v.number(); }),
     field("stuck_s", Kind::kNumber, "s", above(0, 1e5), "10", "for so long",
           [](Draft& d, const Value& v) { pilot<RammingPilot>(d).stuck_time = v.number(); }),
     field("back_m", Kind::kNumber, "m", above(0, 1e5), kLeftOut,
           "how far it backs; if not given, its own length",
           [](Draft& d, const Value& v) { pilot<RammingPilot>(d).back_distance = v.number(); })}};

const Object kFollow{
    {field("ship", Kind::kName, "", {}, "", "its name",
           [](Draft& d, const Value& v) { pilot<FollowingPilot>(d).ship = v.text(); }),
     field("distance_m", Kind::kNumber, "m", above(0, 1e5), "", "from its stern to the stem",
           [](Draft& d, const Value& v) { pilot<FollowingPilot>(d).distance = v.number(); })}};

Field kind(std::string_view key, std::string_view meaning, const Object& object) {
  return field(key, Kind::kObject, "", {}, "", meaning, nullptr, {}, key, &object);
}

const Object kPilot{
    {kind("constant", "lever and rudder stay where they are", kConstant),
     kind("hold_speed", "a speed through the water", kHoldSpeed),
     kind("hold_heading", "a heading at a lever", kHoldHeading),
     kind("route", "from waypoint to waypoint by line of sight", kRoute),
     kind("table", "lever and rudder by the clock", kTable),
     kind("ram", "ahead until it is stuck, back, and ahead again; counts rams and metres gained", kRam),
     kind("follow", "another ship at a distance", kFollow)},
    {"constant", "hold_speed", "hold_heading", "route", "table", "ram", "follow"}};

}  // namespace

const Object& pilot_object() {
  return kPilot;
}

}  // namespace polynya::io
