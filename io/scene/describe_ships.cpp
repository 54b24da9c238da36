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
     of("wedge bow", required(member("entrance_angle_deg", "°", from(1, 89), "of each bow flank from the centreline",
                                     &ShipInput::form, &WedgeBow::entrance_angle))),
     of("outline",
        required(member("waterline_m", "m", from(-1000, 1000),
                        "the waterline in the ship's frame: origin at the centre of gravity, x forward, y to "
                        "port",
                        &ShipInput::form, &HullOutline::waterline))),
     of("outline", member("angles_from_vertical_deg", "°", below(0, 89),
                          "the hull's inclination from the vertical at each vertex of the waterline; empty: "
                          "from the stem angle",
                          &ShipInput::form, &HullOutline::angles_from_vertical)),
     member("stem_angle_deg", "°", from(1, 90), "φ, of the stem from the horizontal", &ShipInput::spec, &Ship::hull,
            &Hull::stem_angle),
     left_out(member("draught_m", "m", above(0, 1000),
                     "T: ice goes under the hull and comes up behind it; without it none does", &ShipInput::spec,
                     &Ship::hull, &Hull::draught)),
     left_out(member("block_coefficient", "", from(0.2, 1),
                     "C_B, displaced volume over length, beam and draught; if not given, by the mass", &ShipInput::spec,
                     &Ship::water, &HullWaterSettings::block_coefficient)),
     choice<bool>("submersion_speed_factor",
                  "how the load of ice under the hull grows with speed: by 1 + 9.4 v/√(gL), or not",
                  {{"lindqvist", true}, {"none", false}}, &ShipInput::spec, &Ship::hull, &Hull::has_speed_factor)}};

const Description<EngineInput> kEngine{
    {required(member("open_water_speed_m_per_s", "m/s", from(0.1, 30),
                     "v_ow, full ahead in open water: the net thrust is nil there", &EngineInput::engine,
                     &Engine::open_water_speed)),
     left_out(member("bollard_pull_kN", "kN", above(0, 1e5),
                     "T_B, at rest, full ahead, of all propellers; if not given, by power, diameter and number",
                     &EngineInput::engine, &Engine::bollard_pull)),
     left_out(member("power_MW", "MW", above(0, 1000), "installed, of all propellers", &EngineInput::engine,
                     &Engine::power)),
     left_out(member("propeller_diameter_m", "m", from(0.1, 50),
                     "of each; if not given, .65 of the draught, for the race on the rudder",
                     &EngineInput::propeller_diameter)),
     member("propellers", "", from(1, 3), "how many", &EngineInput::propellers),
     member(
         "nozzles", "", {},
         "true: ducted propellers, whose bollard pull by power is 1.4 times as much and whose race does not contract",
         &EngineInput::has_nozzles),
     member("astern_share", "", from(0, 1), "of the bollard pull, full astern", &EngineInput::engine,
            &Engine::astern_share),
     member("lever_rate_per_s", "1/s", above(0, 10), "of the thrust lever; 1 is full ahead", &EngineInput::engine,
            &Engine::lever_rate)}};

const Description<ShipInput> kPropulsion{
    {of("thrust", required(member("thrust_N", "N", from(-1e9, 1e9), "constant thrust along the heading",
                                  &ShipInput::propulsion, &ConstantThrust::thrust))),
     of("constant speed",
        required(member("constant_speed_m_per_s", "m/s", from(-20, 20),
                        "velocity over ground and heading are held; the forces reported are what it takes to "
                        "hold them",
                        &ShipInput::propulsion, &ConstantSpeed::speed))),
     of("engine", required(object("engine", kEngine, "propellers, and what drives them", &ShipInput::propulsion)))}};

const Description<HullWaterSettings> kHullWater{
    {choice<bool>("model",
                  "what the water does to the moving hull: added mass, damping of sway and yaw, resistance; "
                  "or nothing; if not given, manoeuvring of a ship with an engine",
                  {{"manoeuvring", true}, {"none", false}}, &HullWaterSettings::acts),
     member("cross_flow_drag_coefficient", "", from(0, 5), "C_d of the flow across the hull",
            &HullWaterSettings::cross_flow_drag),
     member("surge_added_mass_factor", "", from(0, 1), "water that moves ahead with the ship, of its mass",
            &HullWaterSettings::surge_added_mass),
     member("resistance_coefficient", "", from(0, 1),
            "C_T of the wetted surface, of a ship without an engine: an engine's net thrust pays it",
            &HullWaterSettings::resistance_coefficient)}};

const Description<RudderSettings> kRudder{
    {left_out(member("area_m2", "m²", above(0, 1000),
                     "A_R, of all rudders together; if not given, .018 of length times draught",
                     &RudderSettings::area)),
     left_out(member("count", "", from(1, 3),
                     "number of rudders; if not given, one behind each propeller. A single rudder of a ship with two "
                     "propellers stands between their races",
                     &RudderSettings::count)),
     member("aspect_ratio", "", from(0.1, 10), "Λ, height over chord of each", &RudderSettings::aspect_ratio),
     member("rate_deg_per_s", "°/s", above(0, 360), "by which it is laid", &RudderSettings::rate),
     member("max_deg", "°", from(0, 90), "to either side", &RudderSettings::most)}};

const Description<AzimuthSettings> kAzimuth{
    {member("rate_deg_per_s", "°/s", above(0, 360), "by which the thrusters turn about the vertical",
            &AzimuthSettings::rate),
     member("max_deg", "°", from(0, 180), "to either side", &AzimuthSettings::most)}};

const Description<Steering> kSteering{
    {of("rudder", required(object<Steering>("rudder", kRudder, "at the stern, each in the race of a propeller"))),
     of("azimuth", required(object<Steering>("azimuth", kAzimuth, "thrusters at the stern that turn all thrust")))}};

FieldOf<MooringInput> stiffness(std::string_view key, std::string_view unit, std::string_view meaning,
                                double MooringSettings::*place) {
  return member(key, unit, from(0, 1e15), meaning, &MooringInput::settings, place);
}

const Description<MooringInput> kMooring{
    {stiffness("surge_stiffness_N_per_m", "N/m", "along the moored heading", &MooringSettings::surge_stiffness),
     stiffness("sway_stiffness_N_per_m", "N/m", "across it", &MooringSettings::sway_stiffness),
     stiffness("yaw_stiffness_Nm_per_rad", "N m/rad", "against a turn", &MooringSettings::yaw_stiffness),
     stiffness("surge_damping_N_s_per_m", "N s/m", "along the moored heading, over ground",
               &MooringSettings::surge_damping),
     stiffness("sway_damping_N_s_per_m", "N s/m", "across it", &MooringSettings::sway_damping),
     stiffness("yaw_damping_Nm_s_per_rad", "N m s/rad", "against a turn", &MooringSettings::yaw_damping),
     left_out(member("break_load_N", "N", above(0, 1e12),
                     "horizontal force at which it breaks for good; without it never", &MooringInput::settings,
                     &MooringSettings::break_load)),
     member("position_m", "m", coordinate(),
            "of the centre of gravity where nothing pulls; if not given, where the ship is at the start",
            &MooringInput::position),
     member("heading_deg", "°", from(-360, 360), "there; if not given, the ship's at the start",
            &MooringInput::heading)}};

template <class Pilot>
FieldOf<Pilot> lever(double Pilot::*place) {
  return member("lever", "", from(-1, 1), "of the thrust", place);
}
template <class Pilot>
FieldOf<Pilot> steering_angle(double Pilot::*place) {
  return member("steering_deg", "°", from(-180, 180), "of rudder or thrusters, to port", place);
}
template <class Pilot>
FieldOf<Pilot> heading(double Pilot::*place) {
  return left_out(member("heading_deg", "°", from(-360, 360),
                         "to hold where the ship can be steered; if not given, its own at the start", place));
}

const Description<ConstantPilot> kConstant{
    {lever(&ConstantPilot::lever), steering_angle(&ConstantPilot::steering_angle)}};

const Description<SpeedPilot> kHoldSpeed{
    {required(member("speed_m_per_s", "m/s", from(-20, 20), "ahead through the water", &SpeedPilot::speed)),
     heading(&SpeedPilot::heading)}};

const Description<HeadingPilot> kHoldHeading{{heading(&HeadingPilot::heading), lever(&HeadingPilot::lever)}};

const Description<Waypoint> kWaypoint{
    {required(member("position_m", "m", coordinate(), "over ground", &Waypoint::position_in_world)),
     required(member("speed_m_per_s", "m/s", above(0, 20), "on the leg to it, through the water", &Waypoint::speed))}};

const Description<RoutePilot> kRoute{
    {required(list("waypoints", from(1, 1000), "in their order; the ship stops after the last", kWaypoint,
                   &RoutePilot::waypoints)),
     member("look_ahead_lengths", "", above(0, 100), "how far ahead on the leg it steers to, of its length",
            &RoutePilot::look_ahead),
     member("arrival_lengths", "", above(0, 100), "a waypoint is reached this near to it, of the ship's length",
            &RoutePilot::arrival)}};

const Description<TableRow> kRow{{required(member("t_s", "s", from(0, 1e7), "when; ascending", &TableRow::time)),
                                  required(lever(&TableRow::lever)), steering_angle(&TableRow::steering_angle)}};

const Description<TablePilot> kTable{
    {required(list("rows", from(1, 10000), "linear between them", kRow, &TablePilot::rows))}};

const Description<RammingPilot> kRam{
    {heading(&RammingPilot::heading),
     member("lever_ahead", "", above(0, 1), "when it charges", &RammingPilot::lever_ahead),
     member("lever_astern", "", below(-1, 0), "when it backs", &RammingPilot::lever_astern),
     member("stuck_speed_m_per_s", "m/s", above(0, 20),
            "slower than this over ground, ahead and astern, with the lever where it was ordered, is stuck",
            &RammingPilot::stuck_speed),
     member("stuck_s", "s", above(0, 1e5), "for so long", &RammingPilot::stuck_time),
     left_out(member("back_m", "m", above(0, 1e5),
                     "how far it goes astern before it charges; the engine is turned ahead in time to stop there in "
                     "open water; if not given, its own length",
                     &RammingPilot::back_distance))}};

const Description<FollowingPilot> kFollow{
    {required(as(FieldKind::kName, member("ship", "", {}, "its name", &FollowingPilot::ship))),
     required(member("distance_m", "m", above(0, 1e5), "from its stern to the stem", &FollowingPilot::distance))}};

const Description<ManagingPilot> kManage{
    {required(
         as(FieldKind::kName, member("body", "", {}, "the ship or structure that is protected", &ManagingPilot::body))),
     required(choice<ManagementPattern>(
         "pattern",
         "linear: to and fro across the drift; sector: along an arc about the body; circular; racetrack; "
         "largest_floe: to the largest floe that will pass the body within half the width, then to the next",
         {{"linear", ManagementPattern::kLinear},
          {"sector", ManagementPattern::kSector},
          {"circular", ManagementPattern::kCircular},
          {"racetrack", ManagementPattern::kRacetrack},
          {"largest_floe", ManagementPattern::kLargestFloe}},
         &ManagingPilot::pattern)),
     required(member("distance_m", "m", above(0, 1e5), "of the pattern's middle, upstream of the body",
                     &ManagingPilot::distance)),
     required(member("width_m", "m", above(0, 1e5), "of the pattern across the drift; of a sector along its arc",
                     &ManagingPilot::width)),
     left_out(member("depth_m", "m", from(0, 1e5),
                     "of the pattern along the drift; linear and sector come back nearer to the body by it; if not "
                     "given, they come back on the same line, a racetrack has a quarter of the width, the others the "
                     "width",
                     &ManagingPilot::depth)),
     choice<bool>("frame",
                  "in which the pattern lies: it stays with the body, or drifts with the ice from the start of "
                  "each lap",
                  {{"body", false}, {"ice", true}}, &ManagingPilot::drifts_with_ice),
     left_out(member("speed_m_per_s", "m/s", above(0, 20), "along the pattern, in its frame; this or lever",
                     &ManagingPilot::speed)),
     left_out(member("lever", "", above(0, 1), "of the thrust where no speed is given; full if not given",
                     &ManagingPilot::lever)),
     member("phase", "", below(0, 1),
            "where on the pattern it begins, of a lap; ships that share a pattern keep theirs", &ManagingPilot::phase),
     left_out(member("safety_radius_m", "m", above(0, 1e4),
                     "least distance of its centre from those of the body and of other ships; if not given, the "
                     "sum of both lengths",
                     &ManagingPilot::safety_radius)),
     member("least_floe_m2", "m²", from(0, 1e9), "largest_floe: smaller ones are left alone",
            &ManagingPilot::least_floe)}};

template <class Pilot>
FieldOf<PilotSettings> pilot(std::string_view key, std::string_view meaning, const Description<Pilot>& description) {
  return of(key, required(object<PilotSettings>(key, description, meaning)));
}

const Description<PilotSettings> kPilot{
    {pilot("constant", "lever and rudder stay where they are", kConstant),
     pilot("hold_speed", "a speed through the water", kHoldSpeed),
     pilot("hold_heading", "a heading at a lever", kHoldHeading),
     pilot("route", "from waypoint to waypoint by line of sight", kRoute),
     pilot("table", "lever and rudder by the clock", kTable),
     pilot("ram", "ahead until it is stuck, back, and ahead again; counts rams and metres gained", kRam),
     pilot("follow", "another ship at a distance", kFollow),
     pilot("manage", "breaks the ice that drifts onto another ship or a structure", kManage)}};

/// The key "ship" with the name of a preset. Presets are filled in, and the key removed, before a scene is read. A name
/// that is still there is therefore unknown.
FieldOf<ShipInput> preset() {
  FieldOf<ShipInput> field{
      {.key = "ship",
       .kind = FieldKind::kChoice,
       .meaning = "a preset (`polynya ships`), whose particulars are filled in where none are given here",
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
    {required(member("length_m", "m", from(0.1, 1000), "of a panel along the waterline, from the stem to both sides",
                     &PanelSettings::length)),
     member("bottom_m", "m", from(-100, 100), "of the lowest row, above the water", &PanelSettings::bottom),
     member("top_m", "m", from(-100, 100), "of the highest row, above the water", &PanelSettings::top),
     member("rows", "", from(1, 100), "of panels between the two, of one height", &PanelSettings::rows)}};

const Description<WallPressure> kPressure{
    {required(member("line_load_N_per_m", "N/m", above(0, 1e8),
                     "q, along the wall's normal: it closes until ice bears that, and gives way where more "
                     "presses",
                     &WallPressure::line_load)),
     member("closing_speed_m_per_s", "m/s", above(0, 10),
            "at which it closes where nothing bears; its damping is q over that speed", &WallPressure::closing_speed),
     member("mass_kg_per_m", "kg/m", from(1e3, 1e9),
            "of what moves with the wall; that of a kilometre of ice of half a metre",
            &WallPressure::mass_per_length)}};

}  // namespace

const Description<ShipInput> kShipDescription{
    {preset(),
     as(FieldKind::kName, member("name", "", {}, "its name in the outputs; # is its number", &ShipInput::name)),
     or_preset(object("hull", kHull, "the waterline, by its main dimensions or point by point")),
     left_out(member("mass_kg", "kg", from(1, 1e12),
                     "displacement; if not given, of the water that draught and block coefficient displace",
                     &ShipInput::spec, &Ship::mass)),
     left_out(member("moment_of_inertia_kg_m2", "kg m²", from(1e-3, 1e16),
                     "about the vertical through the centre of gravity; if not given, of a radius of gyration "
                     "of a quarter of the length",
                     &ShipInput::spec, &Ship::moment_of_inertia)),
     member("position_m", "m", coordinate(), "of the centre of gravity at the start (amidships for a wedge bow)",
            &ShipInput::spec, &Ship::position_in_world),
     member("heading_deg", "°", from(-360, 360), "from the x axis, counter-clockwise", &ShipInput::spec,
            &Ship::heading),
     member("speed_m_per_s", "m/s", from(-20, 20),
            "along the heading over ground at the start; of a ship at constant speed, that speed", &ShipInput::spec,
            &Ship::speed),
     member("sway_speed_m_per_s", "m/s", from(-20, 20), "to port over ground at the start", &ShipInput::sway_speed),
     member("yaw_rate_deg_per_s", "°/s", from(-90, 90), "counter-clockwise at the start", &ShipInput::yaw_rate),
     or_preset(object("propulsion", kPropulsion, "constant thrust, constant speed or an engine")),
     object("water", kHullWater, "", &ShipInput::spec, &Ship::water),
     object("steering", kSteering, "a rudder or thrusters that turn; needs an engine", &ShipInput::steering),
     object("pilot", kPilot, "works lever and steering; if not given, full ahead with the rudder amidships",
            &ShipInput::pilot),
     object("mooring", kMooring, "what holds the ship in its place", &ShipInput::mooring),
     object("panels", kPanelSettings, "of the hull, of which panels.csv has the loads of the ice", &ShipInput::spec,
            &Ship::panels)}};

const Description<StructureInput> kStructureDescription{
    {as(FieldKind::kName, member("name", "", {}, "its name in the outputs; # is its number", &StructureInput::name)),
     of("cylinder", required(member("radius_m", "m", from(0.1, 1000), "of a cylinder or cone at the waterline",
                                    &StructureInput::form, &Cylinder::radius))),
     of("outline", required(member("waterline_m", "m", from(-1000, 1000), "the waterline in the structure's frame",
                                   &StructureInput::form, &HullOutline::waterline))),
     member("position_m", "m", coordinate(), "of its frame's origin; moments are about it", &StructureInput::spec,
            &Structure::position_in_world),
     member("heading_deg", "°", from(-360, 360),
            "of its frame, from the x axis, counter-clockwise; forces are in that frame", &StructureInput::spec,
            &Structure::heading),
     member("wall_angle_deg", "°", below(0, 89),
            "inclination of its walls from the vertical, all around: 0 crushes the ice, more presses it down "
            "as a hull does",
            &StructureInput::slope),
     object("panels", kPanelSettings, "of its walls, of which panels.csv has the loads of the ice",
            &StructureInput::spec, &Structure::panels)}};

const Description<WallInput> kWallDescription{
    {as(FieldKind::kName, member("name", "", {}, "its name in the outputs; # is its number", &WallInput::name)),
     required(member("from_m", "m", coordinate(),
                     "an end of its face, which runs from here to to_m with the ice to its left", &WallInput::from)),
     required(member("to_m", "m", coordinate(), "the other end", &WallInput::to)),
     member("depth_m", "m", from(0.5, 1000), "of its body, behind the face", &WallInput::depth),
     member("velocity_m_per_s", "m/s", from(-20, 20), "over ground, held whatever pushes it; if not given, it stands",
            &WallInput::velocity),
     object("pressure", kPressure, "moves it along its normal instead, by a load that the ice is to bear",
            &WallInput::pressure)}};

}  // namespace polynya::io
