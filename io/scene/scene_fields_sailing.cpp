#include "io/scene/scene_field_parts.hpp"

namespace polynya::io {
namespace {

using simulation::AzimuthSettings;
using simulation::Engine;
using simulation::MooringSettings;
using simulation::RudderSettings;
using Draft = SceneDraft;
using Value = JsonValue;
using Kind = FieldKind;

/// The alternative that a variant holds, put there first where it holds another.
template <class Alternative, class Variant>
Alternative& held(Variant& variant) {
  if (!std::holds_alternative<Alternative>(variant)) variant = Alternative{};
  return std::get<Alternative>(variant);
}
Engine& engine(Draft& d) {
  return held<Engine>(d.ship().propulsion);
}
RudderSettings& rudder(Draft& d) {
  return held<RudderSettings>(d.ship().steering);
}
AzimuthSettings& azimuth(Draft& d) {
  return held<AzimuthSettings>(d.ship().steering);
}
MooringSettings& mooring(Draft& d) {
  return *d.ship().mooring;
}

const Object kHullWater{
    {field("model", Kind::kChoice, "", {}, "\"none\"",
           "what the water does to the moving hull: added mass, damping of sway and yaw, resistance; or "
           "nothing; if not given, manoeuvring of a ship with an engine",
           [](Draft& d, const Value& v) { d.ship().water.acts = v.text() == "manoeuvring"; },
           {"manoeuvring", "none"}),
     field("cross_flow_drag_coefficient", Kind::kNumber, "", from(0, 5), "0.8",
           "C_d of the flow across the hull",
           [](Draft& d, const Value& v) { d.ship().water.cross_flow_drag = v.number(); }),
     field("surge_added_mass_factor", Kind::kNumber, "", from(0, 1), "0.05",
           "water that moves ahead with the ship, of its mass",
           [](Draft& d, const Value& v) { d.ship().water.surge_added_mass = v.number(); }),
     field("resistance_coefficient", Kind::kNumber, "", from(0, 1), "0.004",
           "C_T of the wetted surface, of a ship without an engine: an engine's net thrust pays it",
           [](Draft& d, const Value& v) { d.ship().water.resistance_coefficient = v.number(); })}};

const Object kEngine{
    {field("open_water_speed_m_per_s", Kind::kNumber, "m/s", above(0, 30), "",
           "v_ow, full ahead in open water: the net thrust is nil there",
           [](Draft& d, const Value& v) { engine(d).open_water_speed = v.number(); }),
     field("bollard_pull_kN", Kind::kNumber, "kN", above(0, 1e5), kLeftOut,
           "T_B, at rest, full ahead, of all propellers; if not given, by power, diameter and number",
           [](Draft& d, const Value& v) { engine(d).bollard_pull = 1e3 * v.number(); }),
     field("power_MW", Kind::kNumber, "MW", above(0, 1000), kLeftOut, "installed, of all propellers",
           [](Draft& d, const Value& v) { d.drive.power = 1e6 * v.number(); }),
     field("propeller_diameter_m", Kind::kNumber, "m", above(0, 50), kLeftOut,
           "of each; if not given, .65 of the draught, for the race on the rudder",
           [](Draft& d, const Value& v) { d.drive.propeller_diameter = v.number(); }),
     field("propellers", Kind::kInteger, "", from(1, 3), "1", "how many",
           [](Draft& d, const Value& v) { d.drive.propellers = static_cast<int>(v.number()); }),
     field("nozzles", Kind::kBoolean, "", {}, kLeftOut,
           "true: ducted propellers, whose bollard pull by power is 1.4 times as much",
           [](Draft& d, const Value& v) { d.drive.has_nozzles = v.boolean(); }),
     field("astern_share", Kind::kNumber, "", from(0, 1), "0.65", "of the bollard pull, full astern",
           [](Draft& d, const Value& v) { engine(d).astern_share = v.number(); }),
     field("lever_rate_per_s", Kind::kNumber, "1/s", above(0, 10), "0.033",
           "of the thrust lever; 1 is full ahead",
           [](Draft& d, const Value& v) { engine(d).lever_rate = v.number(); })}};

const Object kRudder{{field("area_m2", Kind::kNumber, "m²", above(0, 1000), kLeftOut,
                            "A_R; if not given, .018 of length times draught",
                            [](Draft& d, const Value& v) { rudder(d).area = v.number(); }),
                      field("aspect_ratio", Kind::kNumber, "", from(0.1, 10), "1.5", "Λ, height over chord",
                            [](Draft& d, const Value& v) { rudder(d).aspect_ratio = v.number(); }),
                      field("rate_deg_per_s", Kind::kNumber, "°/s", above(0, 360), "3", "by which it is laid",
                            [](Draft& d, const Value& v) { rudder(d).rate = radians(v); }),
                      field("max_deg", Kind::kNumber, "°", from(0, 90), "35", "to either side",
                            [](Draft& d, const Value& v) { rudder(d).most = radians(v); })}};

const Object kAzimuth{{field("rate_deg_per_s", Kind::kNumber, "°/s", above(0, 360), "8",
                             "by which the thrusters turn about the vertical",
                             [](Draft& d, const Value& v) { azimuth(d).rate = radians(v); }),
                       field("max_deg", Kind::kNumber, "°", from(0, 180), "180", "to either side",
                             [](Draft& d, const Value& v) { azimuth(d).most = radians(v); })}};

const Object kSteering{
    {field("rudder", Kind::kObject, "", {}, "", "at the stern, in the race of the propellers", nullptr, {},
           "rudder", &kRudder),
     field("azimuth", Kind::kObject, "", {}, "", "thrusters at the stern that turn all thrust", nullptr, {},
           "azimuth", &kAzimuth)},
    {"rudder", "azimuth"}};

Field stiffness(std::string_view key, std::string_view unit, std::string_view meaning,
                void (*set)(Draft&, const Value&)) {
  return field(key, Kind::kNumber, unit, from(0, 1e15), "0", meaning, set);
}

const Object kMooring{
    {stiffness("surge_stiffness_N_per_m", "N/m", "along the moored heading",
               [](Draft& d, const Value& v) { d.ship().mooring.emplace().surge_stiffness = v.number(); }),
     stiffness("sway_stiffness_N_per_m", "N/m", "across it",
               [](Draft& d, const Value& v) { mooring(d).sway_stiffness = v.number(); }),
     stiffness("yaw_stiffness_Nm_per_rad", "N m/rad", "against a turn",
               [](Draft& d, const Value& v) { mooring(d).yaw_stiffness = v.number(); }),
     stiffness("surge_damping_N_s_per_m", "N s/m", "along the moored heading, over ground",
               [](Draft& d, const Value& v) { mooring(d).surge_damping = v.number(); }),
     stiffness("sway_damping_N_s_per_m", "N s/m", "across it",
               [](Draft& d, const Value& v) { mooring(d).sway_damping = v.number(); }),
     stiffness("yaw_damping_Nm_s_per_rad", "N m s/rad", "against a turn",
               [](Draft& d, const Value& v) { mooring(d).yaw_damping = v.number(); }),
     field("break_load_N", Kind::kNumber, "N", above(0, 1e12), kLeftOut,
           "horizontal force at which it breaks for good; without it never",
           [](Draft& d, const Value& v) { mooring(d).break_load = v.number(); }),
     field("position_m", Kind::kVector, "m", coordinate(), kLeftOut,
           "of the centre of gravity where nothing pulls; if not given, where the ship is at the start",
           [](Draft& d, const Value& v) { mooring(d).position_in_world = point_of(v); }),
     field("heading_deg", Kind::kNumber, "°", from(-360, 360), kLeftOut,
           "there; if not given, the ship's at the start",
           [](Draft& d, const Value& v) { mooring(d).heading = radians(v); })}};

}  // namespace

const Object& hull_water_object() {
  return kHullWater;
}
const Object& engine_object() {
  return kEngine;
}
const Object& steering_object() {
  return kSteering;
}
const Object& mooring_object() {
  return kMooring;
}

}  // namespace polynya::io
