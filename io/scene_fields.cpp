#include "io/scene_fields.hpp"

#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/json_writer.hpp"

namespace polynya::io {
namespace {

using fracture::CharacteristicLength;
using fracture::SplittingModel;
using simulation::BendingModelKind;
using simulation::ConstantSpeed;
using simulation::ConstantThrust;
using simulation::ContactNormal;
using simulation::CuspFate;
using simulation::RecordedContacts;
using Draft = SceneDraft;
using Value = JsonValue;
using Kind = FieldKind;

constexpr double kLargestCoordinate = 1e6;  ///< [m]
constexpr double kLargestCount = 1e6;

Range above(double low, double high) {
  return {low, high, true, false};
}
Range from(double low, double high) {
  return {low, high, false, false};
}
Range below(double low, double high) {
  return {low, high, false, true};
}
Range coordinate() {
  return {-kLargestCoordinate, kLargestCoordinate, false, false};
}

double radians(const Value& v) {
  return v.number() * std::numbers::pi / 180;
}
geometry::Vector vector_of(const Value& v) {
  return {v.items()[0].number(), v.items()[1].number()};
}
geometry::Point point_of(const Value& v) {
  return {v.items()[0].number(), v.items()[1].number()};
}
geometry::Ring ring_of(const Value& v) {
  geometry::Ring ring;
  for (const Value& point : v.items()) ring.push_back(point_of(point));
  return ring;
}

simulation::GeographicOrigin& origin(Draft& d) {
  if (!d.scene.origin) d.scene.origin.emplace();
  return *d.scene.origin;
}

const Object kOrigin{
    {{"latitude_deg", Kind::kNumber, "°", from(-90, 90), "", "of the scene's origin, WGS 84, north positive",
      [](Draft& d, const Value& v) { origin(d).latitude = radians(v); }},
     {"longitude_deg", Kind::kNumber, "°", from(-180, 180), "", "east positive",
      [](Draft& d, const Value& v) { origin(d).longitude = radians(v); }},
     {"heading_deg", Kind::kNumber, "°", from(-360, 360), "90",
      "of the scene's x axis from true north, clockwise; 90: x is east, y north",
      [](Draft& d, const Value& v) { origin(d).heading = radians(v); }}}};

const Object kTime{{{"step_s", Kind::kNumber, "s", from(1e-5, 1), "0.005", "time step Δt",
                     [](Draft& d, const Value& v) { d.scene.time.step = v.number(); }},
                    {"until_s", Kind::kNumber, "s", above(0, 1e7), "550", "simulated time to run to",
                     [](Draft& d, const Value& v) { d.scene.time.until = v.number(); }}}};

const Object kShear{
    {{"rate_per_s", Kind::kNumber, "1/s", from(-1, 1), "0",
      "how much faster the current runs along its direction, per metre to port of the origin",
      [](Draft& d, const Value& v) { d.scene.water.shear.rate = v.number(); }},
     {"direction_deg", Kind::kNumber, "°", from(-360, 360), "0",
      "of the current, from the x axis, counter-clockwise",
      [](Draft& d, const Value& v) { d.scene.water.shear.direction = radians(v); }},
     {"origin_m", Kind::kVector, "m", coordinate(), "[0, 0]",
      "a point where the water has the drift alone, at the start; it is carried along by the drift",
      [](Draft& d, const Value& v) { d.scene.water.shear.origin = point_of(v); }}}};

const Object kWater{
    {{"density_kg_per_m3", Kind::kNumber, "kg/m³", from(500, 2000), "1000", "density ρ_w",
      [](Draft& d, const Value& v) { d.scene.water.water.density = v.number(); }},
     {"drag_coefficient", Kind::kNumber, "", from(0, 100), "0.5", "C_D of Eq. (6), on a floe's edge",
      [](Draft& d, const Value& v) { d.scene.water.drag_coefficient = v.number(); }},
     {"drift_m_per_s", Kind::kVector, "m/s", from(-10, 10), "[0, 0]",
      "velocity of the water, and of all ice with it",
      [](Draft& d, const Value& v) { d.scene.water.drift = vector_of(v); }},
     {"shear",
      Kind::kObject,
      "",
      {},
      "{}",
      "a current that changes linearly across its direction, on top of the drift",
      nullptr,
      {},
      "",
      &kShear}}};

const Object kIce{
    {{"thickness_m", Kind::kNumber, "m", above(0, 20), "0.5", "thickness h of every floe",
      [](Draft& d, const Value& v) { d.scene.ice.thickness = v.number(); }},
     {"density_kg_per_m3", Kind::kNumber, "kg/m³", from(100, 1100), "900",
      "density ρ_i, less than the water's",
      [](Draft& d, const Value& v) { d.scene.ice.density = v.number(); }},
     {"youngs_modulus_Pa", Kind::kNumber, "Pa", from(1e6, 1e12), "5.4e9", "Young's modulus E",
      [](Draft& d, const Value& v) { d.scene.ice.youngs_modulus = v.number(); }},
     {"poisson_ratio", Kind::kNumber, "", below(0, 0.5), "0.3", "Poisson's ratio ν (the paper gives none)",
      [](Draft& d, const Value& v) { d.scene.ice.poisson_ratio = v.number(); }},
     {"flexural_strength_Pa", Kind::kNumber, "Pa", from(1, 1e9), "0.8e6", "flexural strength σ_f",
      [](Draft& d, const Value& v) { d.scene.ice.flexural_strength = v.number(); }},
     {"compressive_strength_Pa", Kind::kNumber, "Pa", from(1, 1e10), "2.8e6", "compressive strength σ_c",
      [](Draft& d, const Value& v) { d.scene.ice.compressive_strength = v.number(); }},
     {"tensile_strength_Pa", Kind::kNumber, "Pa", from(1, 1e9), "0.8e6", "tensile strength σ_t",
      [](Draft& d, const Value& v) { d.scene.ice.tensile_strength = v.number(); }},
     {"fracture_toughness_Pa_sqrt_m", Kind::kNumber, "Pa √m", from(1, 1e9), "150e3",
      "fracture toughness K_IC, for splitting by lefm",
      [](Draft& d, const Value& v) { d.scene.ice.fracture_toughness = v.number(); }},
     {"friction", Kind::kNumber, "", from(0, 2), "0.2", "friction coefficient μ, hull on ice and ice on ice",
      [](Draft& d, const Value& v) { d.scene.ice.friction = v.number(); }}}};

const Object kContact{
    {{"circle_radius_m", Kind::kNumber, "m", from(0.01, 100), "1", "radius of the contact circles",
      [](Draft& d, const Value& v) { d.scene.contact.circle_radius = v.number(); }},
     {"normal",
      Kind::kChoice,
      "",
      {},
      "\"boundary\"",
      "how a contact's normal is found: from the boundary pieces the touching circles stand for, or along "
      "the line "
      "between the circles' centres (the paper's rule)",
      [](Draft& d, const Value& v) {
        d.scene.contact.normal =
            v.text() == "boundary" ? ContactNormal::kBoundary : ContactNormal::kCircleCentres;
      },
      {"boundary", "circle-centres"}},
     {"restitution", Kind::kNumber, "", from(0, 1), "0.1", "ε of Eq. (5)",
      [](Draft& d, const Value& v) { d.scene.contact.restitution = v.number(); }},
     {"contact_time_s", Kind::kNumber, "s", from(1e-4, 100), "0.5",
      "τ_c, which turns an impulse j into the paper's peak force j/τ_c (it decides splits and is reported; "
      "the motion "
      "does not depend on it otherwise)",
      [](Draft& d, const Value& v) { d.scene.contact.contact_time = v.number(); }},
     {"separation_time_s", Kind::kNumber, "s", from(1e-3, 1e4), "1",
      "time over which overlap that nothing presses together any more decays",
      [](Draft& d, const Value& v) { d.scene.contact.separation_time = v.number(); }},
     {"iterations", Kind::kInteger, "", from(1, 10000), "30", "most sweeps of the impulse solver in a step",
      [](Draft& d, const Value& v) { d.scene.contact.iterations = static_cast<int>(v.number()); }}}};

const Object kBending{{{"model",
                        Kind::kChoice,
                        "",
                        {},
                        "\"fsi-database\"",
                        "what a wedge of ice bears before its cusp breaks off",
                        [](Draft& d, const Value& v) {
                          d.scene.fracture.bending = v.text() == "nevel" ? BendingModelKind::kNevel
                                                     : v.text() == "kashtelyan"
                                                         ? BendingModelKind::kKashtelyan
                                                         : BendingModelKind::kFsiDatabase;
                        },
                        {"fsi-database", "nevel", "kashtelyan"}}}};

const Object kSplitting{
    {{"model",
      Kind::kChoice,
      "",
      {},
      "\"michel\"",
      "force that splits a floe: Eq. (4), F_s = n L h σ_t, or linear elastic fracture mechanics",
      [](Draft& d, const Value& v) {
        d.scene.fracture.splitting = v.text() == "michel" ? SplittingModel::kMichel : SplittingModel::kLefm;
      },
      {"michel", "lefm"}},
     {"shape_factor", Kind::kNumber, "", above(0, 100), "0.25", "n of Eq. (4)",
      [](Draft& d, const Value& v) { d.scene.fracture.splitting_shape_factor = v.number(); }}}};

const Object kFracture{
    {{"characteristic_length",
      Kind::kChoice,
      "",
      {},
      "\"fourth_root\"",
      "how Eq. (7) is read: (D/ρ_w g)^¼, a length, or as the paper prints it, (D/ρ_w g)^½, whose unit is m² "
      "(the "
      "paper's story needs that number: docs/paper-comparison.md)",
      [](Draft& d, const Value& v) {
        d.scene.fracture.characteristic_length =
            v.text() == "fourth_root" ? CharacteristicLength::kFourthRoot : CharacteristicLength::kAsPrinted;
      },
      {"fourth_root", "as_printed"}},
     {"breakable_size_factor", Kind::kNumber, "", from(0, 1000), "1",
      "κ: floes with √area < κ l are pushed away, never broken",
      [](Draft& d, const Value& v) { d.scene.fracture.breakable_size_factor = v.number(); }},
     {"bending", Kind::kObject, "", {}, "{}", "failure by bending", nullptr, {}, "", &kBending},
     {"splitting", Kind::kObject, "", {}, "{}", "failure by splitting", nullptr, {}, "", &kSplitting},
     {"cusp_fate",
      Kind::kChoice,
      "",
      {},
      "\"submerge\"",
      "what becomes of a broken cusp: it is gone under the hull (the paper), or it floats as a floe",
      [](Draft& d, const Value& v) {
        d.scene.fracture.cusp_fate = v.text() == "submerge" ? CuspFate::kSubmerge : CuspFate::kFloat;
      },
      {"submerge", "float"}},
     {"cusp_sagitta_m", Kind::kNumber, "m", from(1e-4, 1), "0.02",
      "a cusp's polygon stays this close to its circle",
      [](Draft& d, const Value& v) { d.scene.fracture.cusp_sagitta = v.number(); }},
     {"smallest_floe_m2", Kind::kNumber, "m²", from(1e-6, 1e6), "0.1",
      "smaller pieces leave the floe list and are counted as brash",
      [](Draft& d, const Value& v) { d.scene.fracture.smallest_floe_area = v.number(); }}}};

const Object kRecord{
    {{"forces_interval_s", Kind::kNumber, "s", above(0, 1e6), "0.1", "between rows of forces.csv",
      [](Draft& d, const Value& v) { d.scene.record.forces_interval = v.number(); }},
     {"frames_interval_s", Kind::kNumber, "s", above(0, 1e6), "2", "between frames of frames.bin",
      [](Draft& d, const Value& v) { d.scene.record.frames_interval = v.number(); }},
     {"contacts",
      Kind::kChoice,
      "",
      {},
      "\"ships\"",
      "which contacts contacts.csv tells at every frame: those with ships and structures, those between "
      "floes "
      "too, none",
      [](Draft& d, const Value& v) {
        d.scene.record.contacts = v.text() == "ships" ? RecordedContacts::kShips
                                  : v.text() == "all" ? RecordedContacts::kAll
                                                      : RecordedContacts::kNone;
      },
      {"ships", "all", "none"}}}};

const Object kHull{
    {{"length_m",
      Kind::kNumber,
      "m",
      from(0.1, 1000),
      "",
      "length of the waterline",
      [](Draft& d, const Value& v) { d.hull_length = v.number(); },
      {},
      "wedge bow"},
     {"beam_m",
      Kind::kNumber,
      "m",
      from(0.1, 1000),
      "",
      "beam of the waterline",
      [](Draft& d, const Value& v) { d.hull_beam = v.number(); },
      {},
      "wedge bow"},
     {"entrance_angle_deg",
      Kind::kNumber,
      "°",
      from(1, 89),
      "",
      "of each bow flank from the centreline",
      [](Draft& d, const Value& v) { d.hull_entrance_angle = radians(v); },
      {},
      "wedge bow"},
     {"waterline_m",
      Kind::kRing,
      "m",
      from(-1000, 1000),
      "",
      "the waterline in the ship's frame: origin at the centre of gravity, x forward, y to port",
      [](Draft& d, const Value& v) { d.ship().hull.waterline = ring_of(v); },
      {},
      "outline"},
     {"angles_from_vertical_deg",
      Kind::kNumbers,
      "°",
      below(0, 89),
      "[]",
      "the hull's inclination from the vertical at each vertex of the waterline; empty: from the stem angle",
      [](Draft& d, const Value& v) {
        for (const Value& angle : v.items()) d.ship().hull.angles_from_vertical.push_back(radians(angle));
      },
      {},
      "outline"},
     {"stem_angle_deg", Kind::kNumber, "°", from(1, 90), "30", "φ, of the stem from the horizontal",
      [](Draft& d, const Value& v) { d.ship().hull.stem_angle = radians(v); }}},
    {"wedge bow", "outline"}};

const Object kPropulsion{
    {{"thrust_N",
      Kind::kNumber,
      "N",
      from(-1e9, 1e9),
      "",
      "constant thrust along the heading",
      [](Draft& d, const Value& v) { d.ship().propulsion = ConstantThrust{v.number()}; },
      {},
      "thrust"},
     {"constant_speed_m_per_s",
      Kind::kNumber,
      "m/s",
      from(-20, 20),
      "",
      "velocity over ground and heading are held; the forces reported are what it takes to hold them",
      [](Draft& d, const Value& v) { d.ship().propulsion = ConstantSpeed{v.number()}; },
      {},
      "constant speed"}},
    {"thrust", "constant speed"}};

const Object kShip{
    {{"name",
      Kind::kName,
      "",
      {},
      "\"ship-#\"",
      "its name in the outputs; # is its number",
      [](Draft& d, const Value& v) { d.ship().name = v.text(); }},
     {"hull",
      Kind::kObject,
      "",
      {},
      "",
      "the waterline, by its main dimensions or point by point",
      nullptr,
      {},
      "",
      &kHull},
     {"mass_kg", Kind::kNumber, "kg", from(1, 1e12), "", "displacement",
      [](Draft& d, const Value& v) { d.ship().mass = v.number(); }},
     {"moment_of_inertia_kg_m2", Kind::kNumber, "kg m²", from(1e-3, 1e16), "",
      "about the vertical through the centre of gravity",
      [](Draft& d, const Value& v) { d.ship().moment_of_inertia = v.number(); }},
     {"position_m", Kind::kVector, "m", coordinate(), "[0, 0]",
      "of the centre of gravity at the start (amidships for a wedge bow)",
      [](Draft& d, const Value& v) { d.ship().position_in_world = point_of(v); }},
     {"heading_deg", Kind::kNumber, "°", from(-360, 360), "0", "from the x axis, counter-clockwise",
      [](Draft& d, const Value& v) { d.ship().heading = radians(v); }},
     {"speed_m_per_s", Kind::kNumber, "m/s", from(-20, 20), "0",
      "along the heading over ground at the start; of a ship at constant speed, that speed",
      [](Draft& d, const Value& v) { d.ship().speed = v.number(); }},
     {"propulsion",
      Kind::kObject,
      "",
      {},
      "",
      "constant thrust or constant speed",
      nullptr,
      {},
      "",
      &kPropulsion}},
    {},
    [](Draft& d) {
      d.scene.ships.emplace_back();
      d.hull_length = 0;
    }};

const Object kStructure{
    {{"name",
      Kind::kName,
      "",
      {},
      "\"structure-#\"",
      "its name in the outputs; # is its number",
      [](Draft& d, const Value& v) { d.ship().name = v.text(); }},
     {"radius_m",
      Kind::kNumber,
      "m",
      from(0.1, 1000),
      "",
      "of a cylinder or cone at the waterline",
      [](Draft& d, const Value& v) { d.structure_radius = v.number(); },
      {},
      "cylinder"},
     {"waterline_m",
      Kind::kRing,
      "m",
      from(-1000, 1000),
      "",
      "the waterline in the structure's frame",
      [](Draft& d, const Value& v) { d.ship().hull.waterline = ring_of(v); },
      {},
      "outline"},
     {"position_m", Kind::kVector, "m", coordinate(), "[0, 0]", "of its frame's origin; moments are about it",
      [](Draft& d, const Value& v) { d.ship().position_in_world = point_of(v); }},
     {"heading_deg", Kind::kNumber, "°", from(-360, 360), "0",
      "of its frame, from the x axis, counter-clockwise; forces are in that frame",
      [](Draft& d, const Value& v) { d.ship().heading = radians(v); }},
     {"wall_angle_deg", Kind::kNumber, "°", below(0, 89), "0",
      "inclination of its walls from the vertical, all around: 0 crushes the ice, more presses it down as a "
      "hull does",
      [](Draft& d, const Value& v) { d.structure_slope = radians(v); }}},
    {"cylinder", "outline"},
    [](Draft& d) {
      d.scene.ships.emplace_back();
      d.structure_radius = 0;
    }};

const Object kField{
    {{"corner_m",
      Kind::kVector,
      "m",
      coordinate(),
      "",
      "corner of its region with the least x and y",
      [](Draft& d, const Value& v) { d.group.origin = point_of(v); },
      {},
      "rectangle"},
     {"extent_m",
      Kind::kNumberOrVector,
      "m",
      from(0.1, 1e6),
      "",
      "sides of its region",
      [](Draft& d, const Value& v) { d.group.extent = vector_of(v); },
      {},
      "rectangle"},
     {"outline_m",
      Kind::kRing,
      "m",
      coordinate(),
      "",
      "its region point by point; floes that would cross it are left out",
      [](Draft& d, const Value& v) { d.group.field.region = ring_of(v); },
      {},
      "outline"},
     {"floe_size_m", Kind::kNumber, "m", from(0.1, 1e4), "", "mean of the floes' √area",
      [](Draft& d, const Value& v) {
        d.group.form = FloeGroup::Form::kField;
        d.group.field.floe_size = v.number();
      }},
     {"size_spread", Kind::kNumber, "", from(0, 0.5), "0.25",
      "standard deviation of the floes' √area / its mean; they are lognormal, cut off at 2.5 deviations",
      [](Draft& d, const Value& v) { d.group.field.size_spread = v.number(); }},
     {"concentration", Kind::kNumber, "", above(0, 0.99), "", "share of the region that ice covers",
      [](Draft& d, const Value& v) { d.group.field.concentration = v.number(); }},
     {"gap_m", Kind::kNumber, "m", from(1e-6, 1000), "0.05",
      "least distance between floes, and of floes from what is kept clear",
      [](Draft& d, const Value& v) { d.group.field.gap = v.number(); }},
     {"most_corners", Kind::kInteger, "", from(3, 32), "8", "of a floe; floes are convex",
      [](Draft& d, const Value& v) { d.group.field.most_corners = static_cast<int>(v.number()); }},
     {"keep_clear_m", Kind::kRings, "m", coordinate(), "[]",
      "regions no floe may reach into; ships and structures are kept clear without being asked for",
      [](Draft& d, const Value& v) {
        for (const Value& ring : v.items()) d.group.field.kept_clear.push_back({ring_of(ring), {}});
      }},
     {"seed", Kind::kInteger, "", from(0, 9007199254740991), "0",
      "another one gives another field; the scene's seed is added",
      [](Draft& d, const Value& v) { d.group.field.seed = static_cast<std::uint64_t>(v.number()); }}},
    {"rectangle", "outline"}};

const Object kLattice{
    {{"origin_m", Kind::kVector, "m", coordinate(), "[0, 0]",
      "corner of the lattice's area with the least x and y",
      [](Draft& d, const Value& v) {
        d.group.form = FloeGroup::Form::kLattice;
        d.group.origin = point_of(v);
      }},
     {"columns", Kind::kInteger, "", from(1, kLargestCount), "", "floes along x",
      [](Draft& d, const Value& v) { d.group.columns = static_cast<int>(v.number()); }},
     {"rows", Kind::kInteger, "", from(1, kLargestCount), "", "floes along y",
      [](Draft& d, const Value& v) { d.group.rows = static_cast<int>(v.number()); }},
     {"pitch_m", Kind::kNumberOrVector, "m", from(0.01, 1e5), "",
      "from one floe's centre to the next; each floe stands in the middle of its cell",
      [](Draft& d, const Value& v) { d.group.pitch = vector_of(v); }},
     {"size_m", Kind::kNumberOrVector, "m", from(0.01, 1e5), "", "sides of a floe, at most the pitch",
      [](Draft& d, const Value& v) { d.group.size = vector_of(v); }}}};

const Object kRectangle{
    {{"corner_m", Kind::kVector, "m", coordinate(), "", "corner with the least x and y before it is turned",
      [](Draft& d, const Value& v) {
        d.group.form = FloeGroup::Form::kRectangle;
        d.group.origin = point_of(v);
      }},
     {"size_m", Kind::kNumberOrVector, "m", from(0.01, 1e5), "", "sides",
      [](Draft& d, const Value& v) { d.group.size = vector_of(v); }},
     {"angle_deg", Kind::kNumber, "°", from(-360, 360), "0", "turned about that corner, counter-clockwise",
      [](Draft& d, const Value& v) { d.group.angle = radians(v); }}}};

const Object kPolygon{{{"outer_m", Kind::kRing, "m", coordinate(), "",
                        "outer boundary; it may run either way and may be closed",
                        [](Draft& d, const Value& v) {
                          d.group.form = FloeGroup::Form::kPolygon;
                          d.group.polygon.outer = ring_of(v);
                        }},
                       {"holes_m", Kind::kRings, "m", coordinate(), "[]", "boundaries of its holes",
                        [](Draft& d, const Value& v) {
                          for (const Value& hole : v.items()) d.group.polygon.holes.push_back(ring_of(hole));
                        }}}};

const Object kFloes{
    {{"lattice",
      Kind::kObject,
      "",
      {},
      "",
      "rows and columns of equal rectangles",
      nullptr,
      {},
      "lattice",
      &kLattice},
     {"rectangle", Kind::kObject, "", {}, "", "one rectangle", nullptr, {}, "rectangle", &kRectangle},
     {"polygon", Kind::kObject, "", {}, "", "one polygon, with holes", nullptr, {}, "polygon", &kPolygon},
     {"field",
      Kind::kObject,
      "",
      {},
      "",
      "random convex floes at a concentration",
      nullptr,
      {},
      "field",
      &kField},
     {"file",
      Kind::kText,
      "",
      {},
      "",
      "a GeoJSON file (Polygon, MultiPolygon, FeatureCollection; coordinates in metres) in the scene's "
      "folder or below",
      [](Draft& d, const Value& v) {
        d.group.form = FloeGroup::Form::kFile;
        d.group.file = v.text();
      },
      {},
      "file"},
     {"velocity_m_per_s", Kind::kVector, "m/s", from(-20, 20), "[0, 0]",
      "of the centre of mass relative to the water there, at the start",
      [](Draft& d, const Value& v) { d.group.velocity = vector_of(v); }},
     {"angular_velocity_deg_per_s", Kind::kNumber, "°/s", from(-360, 360), "0",
      "counter-clockwise, at the start; a shear's own turning comes on top",
      [](Draft& d, const Value& v) { d.group.angular_velocity = radians(v); }}},
    {"lattice", "rectangle", "polygon", "field", "file"},
    [](Draft& d) { d.group = {}; }};

const Object kScene{
    {{"name",
      Kind::kName,
      "",
      {},
      "\"scene\"",
      "names the run folder; if left out, the scene file's name",
      [](Draft& d, const Value& v) { d.scene.name = v.text(); }},
     {"description",
      Kind::kText,
      "",
      {},
      "\"\"",
      "for people",
      [](Draft& d, const Value& v) { d.description = v.text(); }},
     {"seed", Kind::kInteger, "", from(0, 9007199254740991), "1", "of whatever is random: the floe fields",
      [](Draft& d, const Value& v) { d.scene.seed = static_cast<std::uint64_t>(v.number()); }},
     {"origin",
      Kind::kObject,
      "",
      {},
      kLeftOut,
      "where the scene lies on the Earth, for `polynya export --geojson`; nothing else depends on it",
      nullptr,
      {},
      "",
      &kOrigin},
     {"time", Kind::kObject, "", {}, "{}", "", nullptr, {}, "", &kTime},
     {"water", Kind::kObject, "", {}, "{}", "", nullptr, {}, "", &kWater},
     {"ice", Kind::kObject, "", {}, "{}", "", nullptr, {}, "", &kIce},
     {"contact", Kind::kObject, "", {}, "{}", "", nullptr, {}, "", &kContact},
     {"fracture", Kind::kObject, "", {}, "{}", "", nullptr, {}, "", &kFracture},
     {"record", Kind::kObject, "", {}, "{}", "", nullptr, {}, "", &kRecord},
     {"ships", Kind::kList, "", from(0, 100), "[]", "the ships", nullptr, {}, "", &kShip},
     {"structures",
      Kind::kList,
      "",
      from(0, 100),
      "[]",
      "what stands in the ice and does not move",
      nullptr,
      {},
      "",
      &kStructure},
     {"floes",
      Kind::kList,
      "",
      from(0, kLargestCount),
      "[]",
      "the ice, in groups",
      nullptr,
      {},
      "",
      &kFloes}}};

std::string describe_range(const Field& field) {
  std::string text;
  const auto number = [](double value) {
    std::string digits;
    append_number(digits, value);
    return digits;
  };
  if (field.range.low > -std::numeric_limits<double>::infinity())
    text += (field.range.is_low_excluded ? " > " : " ≥ ") + number(field.range.low);
  if (field.range.high < std::numeric_limits<double>::infinity())
    text += (text.empty() ? "" : ",") + std::string(field.range.is_high_excluded ? " < " : " ≤ ") +
            number(field.range.high);
  if (!field.unit.empty()) text += fmt::format(" [{}]", field.unit);
  return text;
}

}  // namespace

const Object& scene_object() {
  return kScene;
}

std::string describe_allowed(const Field& field) {
  switch (field.kind) {
    case Kind::kText:
      return "text";
    case Kind::kName:
      return "1 to 100 letters, digits, spaces and . _ -, starting with a letter or digit";
    case Kind::kInteger:
      return "an integer" + describe_range(field);
    case Kind::kNumber:
      return "a number" + describe_range(field);
    case Kind::kChoice:
      return fmt::format("one of {}", fmt::join(field.choices, ", "));
    case Kind::kVector:
      return "[x, y], each" + describe_range(field);
    case Kind::kNumberOrVector:
      return "a number or [x, y], each" + describe_range(field);
    case Kind::kNumbers:
      return "a list of numbers, each" + describe_range(field);
    case Kind::kRing:
      return "a list of three or more [x, y], each" + describe_range(field);
    case Kind::kRings:
      return "a list of rings, each three or more [x, y], each" + describe_range(field);
    case Kind::kObject:
      return "an object";
    case Kind::kList:
      return "a list of objects, its length" + describe_range(field);
  }
  return "";
}

}  // namespace polynya::io
