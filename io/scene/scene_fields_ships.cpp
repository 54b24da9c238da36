#include "io/scene/scene_field_parts.hpp"
#include "io/scene/ship_presets.hpp"

namespace polynya::io {
namespace {

std::vector<std::string_view> preset_names() {
  std::vector<std::string_view> names;
  for (const ShipPreset& preset : ship_presets()) names.push_back(preset.name);
  return names;
}

using simulation::ConstantSpeed;
using simulation::ConstantThrust;
using Draft = SceneDraft;
using Value = JsonValue;
using Kind = FieldKind;

const Object kHull{
    {field(
         "length_m", Kind::kNumber, "m", from(0.1, 1000), "", "length of the waterline",
         [](Draft& d, const Value& v) { d.hull_length = v.number(); }, {}, "wedge bow"),
     field(
         "beam_m", Kind::kNumber, "m", from(0.1, 1000), "", "beam of the waterline",
         [](Draft& d, const Value& v) { d.hull_beam = v.number(); }, {}, "wedge bow"),
     field(
         "entrance_angle_deg", Kind::kNumber, "°", from(1, 89), "", "of each bow flank from the centreline",
         [](Draft& d, const Value& v) { d.hull_entrance_angle = radians(v); }, {}, "wedge bow"),
     field(
         "waterline_m", Kind::kRing, "m", from(-1000, 1000), "",
         "the waterline in the ship's frame: origin at the centre of gravity, x forward, y to port",
         [](Draft& d, const Value& v) { d.ship().hull.waterline = ring_of(v); }, {}, "outline"),
     field(
         "angles_from_vertical_deg", Kind::kNumbers, "°", below(0, 89), "[]",
         "the hull's inclination from the vertical at each vertex of the waterline; empty: from the stem "
         "angle",
         [](Draft& d, const Value& v) {
           for (const Value& angle : v.items()) d.ship().hull.angles_from_vertical.push_back(radians(angle));
         },
         {}, "outline"),
     field("stem_angle_deg", Kind::kNumber, "°", from(1, 90), "30", "φ, of the stem from the horizontal",
           [](Draft& d, const Value& v) { d.ship().hull.stem_angle = radians(v); }),
     field("draught_m", Kind::kNumber, "m", above(0, 1000), kLeftOut,
           "T: ice goes under the hull and comes up behind it; without it none does",
           [](Draft& d, const Value& v) { d.ship().hull.draught = v.number(); }),
     field("block_coefficient", Kind::kNumber, "", from(0.2, 1), kLeftOut,
           "C_B, displaced volume over length, beam and draught; if not given, by the mass",
           [](Draft& d, const Value& v) { d.ship().water.block_coefficient = v.number(); }),
     field("submersion_speed_factor", Kind::kChoice, "", {}, "\"lindqvist\"",
           "how the load of ice under the hull grows with speed: by 1 + 9.4 v/√(gL), or not",
           [](Draft& d, const Value& v) { d.ship().hull.has_speed_factor = v.text() == "lindqvist"; },
           {"lindqvist", "none"})},
    {"wedge bow", "outline"}};

const Object kPropulsion{
    {field(
         "thrust_N", Kind::kNumber, "N", from(-1e9, 1e9), "", "constant thrust along the heading",
         [](Draft& d, const Value& v) { d.ship().propulsion = ConstantThrust{v.number()}; }, {}, "thrust"),
     field(
         "constant_speed_m_per_s", Kind::kNumber, "m/s", from(-20, 20), "",
         "velocity over ground and heading are held; the forces reported are what it takes to hold them",
         [](Draft& d, const Value& v) { d.ship().propulsion = ConstantSpeed{v.number()}; }, {},
         "constant speed"),
     field("engine", Kind::kObject, "", {}, "", "propellers, and what drives them", nullptr, {}, "engine",
           &engine_object())},
    {"thrust", "constant speed", "engine"}};

const Object kShip{
    {field(
         "ship", Kind::kChoice, "", {}, kLeftOut,
         "a preset (`polynya ships`), whose particulars are filled in where none are given here",
         [](Draft&, const Value&) {}, preset_names()),
     field("name", Kind::kName, "", {}, "\"ship-#\"", "its name in the outputs; # is its number",
           [](Draft& d, const Value& v) { d.ship().name = v.text(); }),
     field("hull", Kind::kObject, "", {}, "", "the waterline, by its main dimensions or point by point",
           nullptr, {}, "", &kHull),
     field("mass_kg", Kind::kNumber, "kg", from(1, 1e12), kLeftOut,
           "displacement; if not given, of the water that draught and block coefficient displace",
           [](Draft& d, const Value& v) { d.ship().mass = v.number(); }),
     field("moment_of_inertia_kg_m2", Kind::kNumber, "kg m²", from(1e-3, 1e16), kLeftOut,
           "about the vertical through the centre of gravity; if not given, of a radius of gyration of a "
           "quarter of the length",
           [](Draft& d, const Value& v) { d.ship().moment_of_inertia = v.number(); }),
     field("position_m", Kind::kVector, "m", coordinate(), "[0, 0]",
           "of the centre of gravity at the start (amidships for a wedge bow)",
           [](Draft& d, const Value& v) { d.ship().position_in_world = point_of(v); }),
     field("heading_deg", Kind::kNumber, "°", from(-360, 360), "0", "from the x axis, counter-clockwise",
           [](Draft& d, const Value& v) { d.ship().heading = radians(v); }),
     field("speed_m_per_s", Kind::kNumber, "m/s", from(-20, 20), "0",
           "along the heading over ground at the start; of a ship at constant speed, that speed",
           [](Draft& d, const Value& v) { d.ship().speed = v.number(); }),
     field("sway_speed_m_per_s", Kind::kNumber, "m/s", from(-20, 20), kLeftOut,
           "to port over ground at the start",
           [](Draft& d, const Value& v) { d.ship().sway_speed = v.number(); }),
     field("yaw_rate_deg_per_s", Kind::kNumber, "°/s", from(-90, 90), kLeftOut,
           "counter-clockwise at the start",
           [](Draft& d, const Value& v) { d.ship().yaw_rate = radians(v); }),
     field("propulsion", Kind::kObject, "", {}, "", "constant thrust, constant speed or an engine", nullptr,
           {}, "", &kPropulsion),
     section("water", hull_water_object()),
     field("steering", Kind::kObject, "", {}, kLeftOut, "a rudder or thrusters that turn; needs an engine",
           nullptr, {}, "", &steering_object()),
     field("pilot", Kind::kObject, "", {}, kLeftOut,
           "works lever and steering; if not given, full ahead with the rudder amidships", nullptr, {}, "",
           &pilot_object()),
     field("mooring", Kind::kObject, "", {}, kLeftOut, "what holds the ship in its place", nullptr, {}, "",
           &mooring_object())},
    {},
    [](Draft& d) {
      d.scene.ships.emplace_back();
      d.hull_length = 0;
      d.drive = {};
    }};

const Object kStructure{
    {field("name", Kind::kName, "", {}, "\"structure-#\"", "its name in the outputs; # is its number",
           [](Draft& d, const Value& v) { d.ship().name = v.text(); }),
     field(
         "radius_m", Kind::kNumber, "m", from(0.1, 1000), "", "of a cylinder or cone at the waterline",
         [](Draft& d, const Value& v) { d.structure_radius = v.number(); }, {}, "cylinder"),
     field(
         "waterline_m", Kind::kRing, "m", from(-1000, 1000), "", "the waterline in the structure's frame",
         [](Draft& d, const Value& v) { d.ship().hull.waterline = ring_of(v); }, {}, "outline"),
     field("position_m", Kind::kVector, "m", coordinate(), "[0, 0]",
           "of its frame's origin; moments are about it",
           [](Draft& d, const Value& v) { d.ship().position_in_world = point_of(v); }),
     field("heading_deg", Kind::kNumber, "°", from(-360, 360), "0",
           "of its frame, from the x axis, counter-clockwise; forces are in that frame",
           [](Draft& d, const Value& v) { d.ship().heading = radians(v); }),
     field("wall_angle_deg", Kind::kNumber, "°", below(0, 89), "0",
           "inclination of its walls from the vertical, all around: 0 crushes the ice, more presses it down "
           "as a "
           "hull does",
           [](Draft& d, const Value& v) { d.structure_slope = radians(v); })},
    {"cylinder", "outline"},
    [](Draft& d) {
      d.scene.ships.emplace_back();
      d.structure_radius = 0;
    }};

}  // namespace

const Object& ship_object() {
  return kShip;
}
const Object& structure_object() {
  return kStructure;
}

}  // namespace polynya::io
