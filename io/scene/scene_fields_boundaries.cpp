#include "io/scene/scene_field_parts.hpp"

namespace polynya::io {
namespace {

using Draft = SceneDraft;
using Value = JsonValue;
using Kind = FieldKind;

const Object kShear{
    {field("rate_per_s", Kind::kNumber, "1/s", from(-1, 1), "0",
           "how much faster the current runs along its direction, per metre to port of the origin",
           [](Draft& d, const Value& v) { d.scene.water.shear.rate = v.number(); }),
     field("direction_deg", Kind::kNumber, "°", from(-360, 360), "0",
           "of the current, from the x axis, counter-clockwise",
           [](Draft& d, const Value& v) { d.scene.water.shear.direction = radians(v); }),
     field("origin_m", Kind::kVector, "m", coordinate(), "[0, 0]",
           "a point where the water has the drift alone, at the start; it is carried along by the drift",
           [](Draft& d, const Value& v) { d.scene.water.shear.origin = point_of(v); })}};

const Object kWater{
    {field("density_kg_per_m3", Kind::kNumber, "kg/m³", from(500, 2000), "1000", "density ρ_w",
           [](Draft& d, const Value& v) { d.scene.water.water.density = v.number(); }),
     field("drag_coefficient", Kind::kNumber, "", from(0, 100), "0.5", "C_D of Eq. (6)",
           [](Draft& d, const Value& v) { d.scene.water.drag_coefficient = v.number(); }),
     field(
         "drag_area", Kind::kChoice, "", {}, "\"edge\"",
         "A of Eq. (6): thickness times the floe's width across its motion, or its area in plan (the reading "
         "under which the paper's voyages come out: docs/paper-comparison.md)",
         [](Draft& d, const Value& v) {
           d.scene.water.drag_area =
               v.text() == "edge" ? dynamics::DragArea::kEdge : dynamics::DragArea::kPlan;
         },
         {"edge", "plan"}),
     field("skin_drag_coefficient", Kind::kNumber, "", from(0, 1), "0",
           "C_w, of a floe's area in plan, beside Eq. (6); if not given, 0.004 where a wind blows",
           [](Draft& d, const Value& v) { d.scene.water.skin_drag_coefficient = v.number(); }),
     field("drift_m_per_s", Kind::kVector, "m/s", from(-10, 10), "[0, 0]",
           "velocity of the water, and of all ice with it",
           [](Draft& d, const Value& v) { d.scene.water.drift = vector_of(v); }),
     field("shear", Kind::kObject, "", {}, "{}",
           "a current that changes linearly across its direction, on top of the drift", nullptr, {}, "",
           &kShear)}};

const Object kWind{
    {field("velocity_m_per_s", Kind::kVector, "m/s", from(-100, 100), "[0, 0]",
           "U_10: where it blows to, 10 m above the ice, over ground; it pushes every floe that is not fast "
           "by ½ ρ_a C_a |U_10| U_10 on its area in plan",
           [](Draft& d, const Value& v) { d.scene.wind.velocity = vector_of(v); }),
     field("drag_coefficient", Kind::kNumber, "", from(0, 1), "0.002", "C_a",
           [](Draft& d, const Value& v) { d.scene.wind.drag_coefficient = v.number(); }),
     field("air_density_kg_per_m3", Kind::kNumber, "kg/m³", from(0, 10), "1.3", "ρ_a",
           [](Draft& d, const Value& v) { d.scene.wind.density = v.number(); })}};

const Object kPressure{
    {field("line_load_N_per_m", Kind::kNumber, "N/m", above(0, 1e8), "",
           "q, along the wall's normal: it closes until ice bears that, and gives way where more presses",
           [](Draft& d, const Value& v) { d.wall.wall.line_load = v.number(); }),
     field("closing_speed_m_per_s", Kind::kNumber, "m/s", above(0, 10), "0.1",
           "at which it closes where nothing bears; its damping is q over that speed",
           [](Draft& d, const Value& v) { d.wall.wall.closing_speed = v.number(); }),
     field("mass_kg_per_m", Kind::kNumber, "kg/m", from(1e3, 1e9), "4.5e5",
           "of what moves with the wall; that of a kilometre of ice of half a metre",
           [](Draft& d, const Value& v) { d.wall.wall.mass_per_length = v.number(); })}};

const Object kWall{
    {field("name", Kind::kName, "", {}, "\"wall-#\"", "its name in the outputs; # is its number",
           [](Draft& d, const Value& v) { d.wall.name = v.text(); }),
     field("from_m", Kind::kVector, "m", coordinate(), "",
           "an end of its face, which runs from here to to_m with the ice to its left",
           [](Draft& d, const Value& v) { d.wall.from = point_of(v); }),
     field("to_m", Kind::kVector, "m", coordinate(), "", "the other end",
           [](Draft& d, const Value& v) { d.wall.to = point_of(v); }),
     field("depth_m", Kind::kNumber, "m", from(0.5, 1000), "10", "of its body, behind the face",
           [](Draft& d, const Value& v) { d.wall.depth = v.number(); }),
     field("velocity_m_per_s", Kind::kVector, "m/s", from(-20, 20), kLeftOut,
           "over ground, held whatever pushes it; if not given, it stands",
           [](Draft& d, const Value& v) { d.wall.wall.velocity = vector_of(v); }),
     field("pressure", Kind::kObject, "", {}, kLeftOut,
           "moves it along its normal instead, by a load that the ice is to bear", nullptr, {}, "",
           &kPressure)},
    {},
    [](Draft& d) { d.wall = {}; }};

}  // namespace

const Object& water_object() {
  return kWater;
}
const Object& wind_object() {
  return kWind;
}
const Object& wall_object() {
  return kWall;
}

}  // namespace polynya::io
