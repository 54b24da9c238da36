#include "io/scene/describe.hpp"
#include "io/scene/scene_input.hpp"
#include "io/scene/ship_presets.hpp"

namespace polynya::io {
namespace {

using dynamics::Engine;
using namespace simulation;

const Description<ShipInput> kHull{
    {of("wedge bow", required(member("length_m", "m", from(0.1, 1000), "length of the waterline", &ShipInput::form,
                                     &WedgeBow::length))),
     of("wedge bow",
        required(member("beam_m", "m", from(0.1, 1000), "beam of the waterline", &ShipInput::form, &WedgeBow::beam))),
     of("wedge bow",
        required(member("entrance_angle_deg", "°", from(1, 89), "angle between each bow flank and the centreline",
                        &ShipInput::form, &WedgeBow::entrance_angle))),
     of("outline",
        required(member("waterline_m", "m", from(-1000, 1000),
                        "waterline in the ship's frame: origin at the centre of gravity, x forward, y to port",
                        &ShipInput::form, &HullOutline::waterline))),
     of("outline", member("angles_from_vertical_deg", "°", below(0, 89),
                          "inclination of the hull from the vertical at each vertex of the waterline; empty: computed "
                          "from the stem angle",
                          &ShipInput::form, &HullOutline::angles_from_vertical)),
     member("stem_angle_deg", "°", from(1, 90), "stem angle φ from the horizontal", &ShipInput::spec, &Ship::hull,
            &Hull::stem_angle),
     left_out(member("draught_m", "m", above(0, 1000),
                     "draught T; with a draught, ice goes under the hull and surfaces behind it", &ShipInput::spec,
                     &Ship::hull, &Hull::draught)),
     left_out(member("block_coefficient", "", from(0.2, 1),
                     "C_B, displaced volume / (length × beam × draught); if not given, computed from the mass",
                     &ShipInput::spec, &Ship::water, &HullWaterSettings::block_coefficient)),
     choice<bool>("submersion_speed_factor",
                  "whether the load of ice under the hull grows with speed, by the factor 1 + 9.4 v/√(gL); with "
                  "`fracture.bending.decks` `flood` only behind the bow",
                  {{"lindqvist", true}, {"none", false}}, &ShipInput::spec, &Ship::hull, &Hull::has_speed_factor)}};

const Description<EngineInput> kEngine{
    {required(member("open_water_speed_m_per_s", "m/s", from(0.1, 30),
                     "v_ow, speed full ahead in open water, at which the net thrust is 0", &EngineInput::engine,
                     &Engine::open_water_speed)),
     left_out(member(
         "bollard_pull_kN", "kN", above(0, 1e5),
         "T_B, thrust of all propellers at rest, full ahead; if not given, computed from power, diameter and number",
         &EngineInput::engine, &Engine::bollard_pull)),
     left_out(member("power_MW", "MW", above(0, 1000), "installed power of all propellers", &EngineInput::engine,
                     &Engine::power)),
     left_out(member("propeller_diameter_m", "m", from(0.1, 50),
                     "diameter of each propeller; if not given, 0.65 of the draught, for the race on the rudder",
                     &EngineInput::propeller_diameter)),
     member("propellers", "", from(1, 3), "number of propellers", &EngineInput::propellers),
     member("nozzles", "", {},
            "true: ducted propellers, which have 1.4 times the bollard pull for their power, and a race that does not "
            "contract",
            &EngineInput::has_nozzles),
     member("astern_share", "", from(0, 1), "thrust full astern as a fraction of the bollard pull",
            &EngineInput::engine, &Engine::astern_share),
     member("lever_rate_per_s", "1/s", above(0, 10), "largest rate of the thrust lever; a lever of 1 is full ahead",
            &EngineInput::engine, &Engine::lever_rate)}};

const Description<ShipInput> kPropulsion{
    {of("thrust", required(member("thrust_N", "N", from(-1e9, 1e9), "constant thrust along the heading",
                                  &ShipInput::propulsion, &ConstantThrust::thrust))),
     of("constant speed",
        required(member(
            "constant_speed_m_per_s", "m/s", from(-20, 20),
            "constant speed over ground at a constant heading; the reported forces are those needed to keep them",
            &ShipInput::propulsion, &ConstantSpeed::speed))),
     of("engine", required(object("engine", kEngine, "propellers and their drive", &ShipInput::propulsion)))}};

const Description<HullWaterSettings> kHullWater{
    {choice<bool>("model",
                  "forces of the water on the moving hull: added mass, damping of sway and yaw, and resistance, or "
                  "none; if not given, manoeuvring for a ship with an engine",
                  {{"manoeuvring", true}, {"none", false}}, &HullWaterSettings::acts),
     member("cross_flow_drag_coefficient", "", from(0, 5), "C_d, drag coefficient of the flow across the hull",
            &HullWaterSettings::cross_flow_drag),
     member("surge_added_mass_factor", "", from(0, 1), "added mass in surge as a fraction of the ship's mass",
            &HullWaterSettings::surge_added_mass),
     member("resistance_coefficient", "", from(0, 1),
            "C_T of the wetted surface, for a ship without an engine; the net thrust of an engine already includes the "
            "resistance",
            &HullWaterSettings::resistance_coefficient)}};

const Description<RudderSettings> kRudder{
    {left_out(member("area_m2", "m²", above(0, 1000),
                     "A_R, total area of all rudders; if not given, 0.018 × length × draught", &RudderSettings::area)),
     left_out(member("count", "", from(1, 3),
                     "number of rudders; if not given, one behind each propeller. A single rudder of a ship with two "
                     "propellers is between their races",
                     &RudderSettings::count)),
     member("aspect_ratio", "", from(0.1, 10), "Λ, height / chord of each rudder", &RudderSettings::aspect_ratio),
     member("rate_deg_per_s", "°/s", above(0, 360), "largest rate of the rudder angle", &RudderSettings::rate),
     member("max_deg", "°", from(0, 90), "largest rudder angle to either side", &RudderSettings::most)}};

const Description<AzimuthSettings> kAzimuth{
    {member("rate_deg_per_s", "°/s", above(0, 360), "rate at which the thrusters turn about the vertical",
            &AzimuthSettings::rate),
     member("max_deg", "°", from(0, 180), "largest angle of the thrusters to either side", &AzimuthSettings::most)}};

const Description<Steering> kSteering{
    {of("rudder",
        required(object<Steering>("rudder", kRudder, "rudders at the stern, each in the race of a propeller"))),
     of("azimuth", required(object<Steering>("azimuth", kAzimuth, "thrusters at the stern that turn all thrust")))}};

FieldOf<MooringInput> stiffness(std::string_view key, std::string_view unit, std::string_view meaning,
                                double MooringSettings::*place) {
  return member(key, unit, from(0, 1e15), meaning, &MooringInput::settings, place);
}

const Description<MooringInput> kMooring{
    {stiffness("surge_stiffness_N_per_m", "N/m", "stiffness along the moored heading",
               &MooringSettings::surge_stiffness),
     stiffness("sway_stiffness_N_per_m", "N/m", "stiffness across the moored heading",
               &MooringSettings::sway_stiffness),
     stiffness("yaw_stiffness_Nm_per_rad", "N m/rad", "stiffness against a rotation", &MooringSettings::yaw_stiffness),
     stiffness("surge_damping_N_s_per_m", "N s/m", "damping along the moored heading, over ground",
               &MooringSettings::surge_damping),
     stiffness("sway_damping_N_s_per_m", "N s/m", "damping across the moored heading", &MooringSettings::sway_damping),
     stiffness("yaw_damping_Nm_s_per_rad", "N m s/rad", "damping against a rotation", &MooringSettings::yaw_damping),
     left_out(member("break_load_N", "N", above(0, 1e12),
                     "horizontal force at which the mooring breaks permanently; if not given, it never breaks",
                     &MooringInput::settings, &MooringSettings::break_load)),
     member(
         "position_m", "m", coordinate(),
         "position of the centre of gravity without a pull of the mooring; if not given, the ship's initial position",
         &MooringInput::position),
     member("heading_deg", "°", from(-360, 360), "heading in that position; if not given, the ship's initial heading",
            &MooringInput::heading)}};

template <class Pilot>
FieldOf<Pilot> lever(double Pilot::*place) {
  return member("lever", "", from(-1, 1), "thrust lever; 1 is full ahead, −1 full astern", place);
}
template <class Pilot>
FieldOf<Pilot> steering_angle(double Pilot::*place) {
  return member("steering_deg", "°", from(-180, 180), "angle of rudder or thrusters, positive to port", place);
}
template <class Pilot>
FieldOf<Pilot> heading(double Pilot::*place) {
  return left_out(member("heading_deg", "°", from(-360, 360),
                         "heading to hold if the ship can be steered; if not given, its initial heading", place));
}

const Description<ConstantPilot> kConstant{
    {lever(&ConstantPilot::lever), steering_angle(&ConstantPilot::steering_angle)}};

const Description<SpeedPilot> kHoldSpeed{
    {required(member("speed_m_per_s", "m/s", from(-20, 20), "speed ahead through the water", &SpeedPilot::speed)),
     heading(&SpeedPilot::heading)}};

const Description<HeadingPilot> kHoldHeading{{heading(&HeadingPilot::heading), lever(&HeadingPilot::lever)}};

const Description<Waypoint> kWaypoint{
    {required(
         member("position_m", "m", coordinate(), "position of the waypoint over ground", &Waypoint::position_in_world)),
     required(
         member("speed_m_per_s", "m/s", above(0, 20), "speed through the water on the leg to it", &Waypoint::speed))}};

const Description<RoutePilot> kRoute{
    {required(list("waypoints", from(1, 1000), "waypoints in their order; the ship stops after the last one", kWaypoint,
                   &RoutePilot::waypoints)),
     member("look_ahead_lengths", "", above(0, 100),
            "distance ahead on the leg of the point to which the ship steers, in ship lengths",
            &RoutePilot::look_ahead),
     member("arrival_lengths", "", above(0, 100), "distance at which a waypoint counts as reached, in ship lengths",
            &RoutePilot::arrival)}};

const Description<TableRow> kRow{
    {required(member("t_s", "s", from(0, 1e7), "time of the row; ascending", &TableRow::time)),
     required(lever(&TableRow::lever)), steering_angle(&TableRow::steering_angle)}};

const Description<TablePilot> kTable{{required(list(
    "rows", from(1, 10000), "rows of lever and steering over time, linear between them", kRow, &TablePilot::rows))}};

const Description<RammingPilot> kRam{
    {heading(&RammingPilot::heading),
     member("lever_ahead", "", above(0, 1), "lever while the ship charges", &RammingPilot::lever_ahead),
     member("lever_astern", "", below(-1, 0), "lever while the ship backs", &RammingPilot::lever_astern),
     member("stuck_speed_m_per_s", "m/s", above(0, 20),
            "a ship slower than this over ground is stuck, ahead and astern, once the lever has reached its setting",
            &RammingPilot::stuck_speed),
     member("stuck_s", "s", above(0, 1e5), "time for which it must be that slow to count as stuck",
            &RammingPilot::stuck_time),
     left_out(member("back_m", "m", above(0, 1e5),
                     "distance that the ship backs before it charges; the lever is turned ahead in time to stop there "
                     "in open water; if not given, the ship's length",
                     &RammingPilot::back_distance))}};

const Description<FollowingPilot> kFollow{
    {required(as(FieldKind::kName, member("ship", "", {}, "name of the ship to follow", &FollowingPilot::ship))),
     required(member("distance_m", "m", above(0, 1e5), "distance from its stern to the stem of this ship",
                     &FollowingPilot::distance))}};

const Description<ManagingPilot> kManage{
    {required(as(FieldKind::kName,
                 member("body", "", {}, "name of the ship or structure to protect", &ManagingPilot::body))),
     required(choice<ManagementPattern>("pattern",
                                        "line of the ship: linear, back and forth across the drift; sector, along an "
                                        "arc around the body; circular; racetrack; or largest_floe, to the largest "
                                        "floe that will pass the body within half the width, then to the next",
                                        {{"linear", ManagementPattern::kLinear},
                                         {"sector", ManagementPattern::kSector},
                                         {"circular", ManagementPattern::kCircular},
                                         {"racetrack", ManagementPattern::kRacetrack},
                                         {"largest_floe", ManagementPattern::kLargestFloe}},
                                        &ManagingPilot::pattern)),
     required(member("distance_m", "m", above(0, 1e5), "distance of the pattern's middle upstream of the body",
                     &ManagingPilot::distance)),
     required(member("width_m", "m", above(0, 1e5), "width of the pattern across the drift; for a sector along its arc",
                     &ManagingPilot::width)),
     left_out(member("depth_m", "m", from(0, 1e5),
                     "depth of the pattern along the drift. With linear and sector the ship returns nearer to the body "
                     "by this distance; if not given, it returns on the same line. If not given, a racetrack has a "
                     "quarter of the width, and the others have the width",
                     &ManagingPilot::depth)),
     choice<bool>("frame",
                  "frame of the pattern: it stays at the body, or drifts with the ice from the start of each lap",
                  {{"body", false}, {"ice", true}}, &ManagingPilot::drifts_with_ice),
     left_out(member("speed_m_per_s", "m/s", above(0, 20), "speed along the pattern, in its frame; give this or lever",
                     &ManagingPilot::speed)),
     left_out(member("lever", "", above(0, 1), "thrust lever if no speed is given; full ahead if not given",
                     &ManagingPilot::lever)),
     member("phase", "", below(0, 1),
            "position on the pattern at the start, as a fraction of a lap; ships on the same pattern keep the "
            "differences of their phases",
            &ManagingPilot::phase),
     left_out(member("safety_radius_m", "m", above(0, 1e4),
                     "least distance of the ship's centre from the centres of the body and of other ships; if not "
                     "given, the sum of both lengths",
                     &ManagingPilot::safety_radius)),
     member("least_floe_m2", "m²", from(0, 1e9), "for largest_floe: least area of a floe that the ship approaches",
            &ManagingPilot::least_floe)}};

template <class Pilot>
FieldOf<PilotSettings> pilot(std::string_view key, std::string_view meaning, const Description<Pilot>& description) {
  return of(key, required(object<PilotSettings>(key, description, meaning)));
}

const Description<PilotSettings> kPilot{
    {pilot("constant", "keeps a lever and a steering angle", kConstant),
     pilot("hold_speed", "keeps a speed through the water", kHoldSpeed),
     pilot("hold_heading", "keeps a heading with a constant lever", kHoldHeading),
     pilot("route", "sails from waypoint to waypoint by line of sight", kRoute),
     pilot("table", "follows a table of lever and steering over time", kTable),
     pilot("ram", "rams: charges until the ship is stuck, backs, and charges again; counts rams and distance gained",
           kRam),
     pilot("follow", "follows another ship at a distance", kFollow),
     pilot("manage", "breaks the ice that drifts onto another ship or a structure", kManage)}};

/// The key "ship" with the name of a preset. Presets are filled in, and the key removed, before a scene is read. A name
/// that is still there is therefore unknown.
FieldOf<ShipInput> preset() {
  FieldOf<ShipInput> field{
      {.key = "ship",
       .kind = FieldKind::kChoice,
       .meaning = "name of a preset (`polynya ships`), whose particulars are used where none are given here",
       .presence = Presence::kLeftOut}};
  for (const ShipPreset& ship : ship_presets()) field.choices.push_back(ship.name);
  return field;
}

/// Marks a required object that a preset would provide.
FieldOf<ShipInput> or_preset(FieldOf<ShipInput> field) {
  field.instead = R"(; or "ship": a preset's name, as "reference" (polynya ships))";
  return required(std::move(field));
}

const Description<PanelSettings> kPanelSettings{
    {required(member("length_m", "m", from(0.1, 1000),
                     "length of a panel along the waterline, counted from the stem to both sides",
                     &PanelSettings::length)),
     member("bottom_m", "m", from(-100, 100), "height of the lower edge of the lowest row above the water",
            &PanelSettings::bottom),
     member("top_m", "m", from(-100, 100), "height of the upper edge of the highest row above the water",
            &PanelSettings::top),
     member("rows", "", from(1, 100), "number of rows of equal height between the two", &PanelSettings::rows)}};

const Description<WallPressure> kPressure{
    {required(member("line_load_N_per_m", "N/m", above(0, 1e8),
                     "line load q along the wall's normal; the wall advances until the ice resists with this load, and "
                     "recedes if more presses",
                     &WallPressure::line_load)),
     member("closing_speed_m_per_s", "m/s", above(0, 10),
            "speed at which the wall advances if nothing resists; its damping is q divided by this speed",
            &WallPressure::closing_speed),
     member("mass_kg_per_m", "kg/m", from(1e3, 1e9),
            "mass per length that moves with the wall; the default is that of a kilometre of ice of 0.5 m",
            &WallPressure::mass_per_length)}};

}  // namespace

const Description<ShipInput> kShipDescription{
    {preset(),
     as(FieldKind::kName, member("name", "", {}, "name in the outputs; # is replaced by its number", &ShipInput::name)),
     or_preset(object("hull", kHull, "waterline by main dimensions or point by point, and slope of the sides")),
     left_out(
         member("mass_kg", "kg", from(1, 1e12),
                "mass of the ship; if not given, computed from the displaced volume by draught and block coefficient",
                &ShipInput::spec, &Ship::mass)),
     left_out(member("moment_of_inertia_kg_m2", "kg m²", from(1e-3, 1e16),
                     "moment of inertia about the vertical through the centre of gravity; if not given, that of a "
                     "radius of gyration of a quarter of the length",
                     &ShipInput::spec, &Ship::moment_of_inertia)),
     member("position_m", "m", coordinate(), "initial position of the centre of gravity (amidships for a wedge bow)",
            &ShipInput::spec, &Ship::position_in_world),
     member("heading_deg", "°", from(-360, 360), "initial heading from the x axis, counter-clockwise", &ShipInput::spec,
            &Ship::heading),
     member("speed_m_per_s", "m/s", from(-20, 20),
            "initial speed over ground along the heading; for a ship at constant speed the default is that speed",
            &ShipInput::spec, &Ship::speed),
     member("sway_speed_m_per_s", "m/s", from(-20, 20), "initial speed over ground to port", &ShipInput::sway_speed),
     member("yaw_rate_deg_per_s", "°/s", from(-90, 90), "initial yaw rate, counter-clockwise", &ShipInput::yaw_rate),
     or_preset(object("propulsion", kPropulsion, "propulsion: constant thrust, constant speed or an engine")),
     object("water", kHullWater, "", &ShipInput::spec, &Ship::water),
     object("steering", kSteering, "rudders, or thrusters that turn; needs an engine", &ShipInput::steering),
     object("pilot", kPilot, "sets lever and steering; if not given, the lever is full ahead and the rudder amidships",
            &ShipInput::pilot),
     object("mooring", kMooring, "springs and dampers that hold the ship in its place", &ShipInput::mooring),
     object("panels", kPanelSettings, "panels of the hull; panels.csv records their ice loads", &ShipInput::spec,
            &Ship::panels)}};

const Description<StructureInput> kStructureDescription{
    {as(FieldKind::kName,
        member("name", "", {}, "name in the outputs; # is replaced by its number", &StructureInput::name)),
     of("cylinder", required(member("radius_m", "m", from(0.1, 1000), "radius of a cylinder or cone at the waterline",
                                    &StructureInput::form, &Cylinder::radius))),
     of("outline", required(member("waterline_m", "m", from(-1000, 1000), "waterline in the structure's frame",
                                   &StructureInput::form, &HullOutline::waterline))),
     member("position_m", "m", coordinate(), "position of the frame's origin; moments are about it",
            &StructureInput::spec, &Structure::position_in_world),
     member("heading_deg", "°", from(-360, 360),
            "heading of the frame from the x axis, counter-clockwise; forces are in that frame", &StructureInput::spec,
            &Structure::heading),
     member("wall_angle_deg", "°", below(0, 89),
            "inclination of the sides from the vertical, all around; 0 only crushes the ice, larger angles press it "
            "down as a hull does",
            &StructureInput::slope),
     object("panels", kPanelSettings, "panels of the sides; panels.csv records their ice loads", &StructureInput::spec,
            &Structure::panels)}};

const Description<WallInput> kWallDescription{
    {as(FieldKind::kName, member("name", "", {}, "name in the outputs; # is replaced by its number", &WallInput::name)),
     required(member("from_m", "m", coordinate(),
                     "start of the wall's face, which leads from here to to_m with the ice on its left",
                     &WallInput::from)),
     required(member("to_m", "m", coordinate(), "end of the face", &WallInput::to)),
     member("depth_m", "m", from(0.5, 1000), "depth of the wall's body behind the face", &WallInput::depth),
     member("velocity_m_per_s", "m/s", from(-20, 20),
            "constant velocity over ground, whatever pushes the wall; if not given, the wall does not move",
            &WallInput::velocity),
     object("pressure", kPressure, "moves the wall along its normal instead, by a load on the ice",
            &WallInput::pressure)}};

}  // namespace polynya::io
