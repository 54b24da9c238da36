#include <variant>

#include "io/scene/scene_field_parts.hpp"

namespace polynya::io {
namespace {

using Draft = SceneDraft;
using Value = JsonValue;
using Kind = FieldKind;

/// The law of that kind, with its defaults where the field had another.
template <class Law>
Law& law_of(Draft& d) {
  auto& law = d.group.field.law;
  if (!law || !std::holds_alternative<Law>(*law)) law = Law{};
  return std::get<Law>(*law);
}
using simulation::EqualSizes;
using simulation::LognormalSizes;
using simulation::PowerLawSizes;

const Object kSizes{
    {field(
         "size_m", Kind::kNumber, "m", from(0.1, 1e4), "", "√area of every floe",
         [](Draft& d, const Value& v) { law_of<EqualSizes>(d).size = v.number(); }, {}, "equal"),
     field(
         "mean_m", Kind::kNumber, "m", from(0.1, 1e4), "",
         "mean √area of log-normal sizes, cut off at 3 deviations of the logarithm",
         [](Draft& d, const Value& v) { law_of<LognormalSizes>(d).mean = v.number(); }, {}, "log-normal"),
     field(
         "spread", Kind::kNumber, "", from(0, 1), "", "their standard deviation / mean",
         [](Draft& d, const Value& v) { law_of<LognormalSizes>(d).spread = v.number(); }, {}, "log-normal"),
     field(
         "exponent", Kind::kNumber, "", from(-3, 6), "",
         "a of the number of floes larger than d, ∝ d^−a, d √area; −1 is even in d",
         [](Draft& d, const Value& v) { law_of<PowerLawSizes>(d).exponent = v.number(); }, {}, "power law"),
     field(
         "least_m", Kind::kNumber, "m", from(0.1, 1e4), "", "least √area",
         [](Draft& d, const Value& v) { law_of<PowerLawSizes>(d).least = v.number(); }, {}, "power law"),
     field(
         "largest_m", Kind::kNumber, "m", from(0.1, 1e4), "", "largest √area",
         [](Draft& d, const Value& v) { law_of<PowerLawSizes>(d).largest = v.number(); }, {}, "power law")},
    {"equal", "log-normal", "power law"}};

const Object kField{
    {field(
         "corner_m", Kind::kVector, "m", coordinate(), "", "corner of its region with the least x and y",
         [](Draft& d, const Value& v) { d.group.origin = point_of(v); }, {}, "rectangle"),
     field(
         "extent_m", Kind::kNumberOrVector, "m", from(0.1, 1e6), "", "sides of its region",
         [](Draft& d, const Value& v) { d.group.extent = vector_of(v); }, {}, "rectangle"),
     field(
         "outline_m", Kind::kRing, "m", coordinate(), "",
         "its region point by point; with floe_size_m, floes that would cross it are left out",
         [](Draft& d, const Value& v) { d.group.field.region = ring_of(v); }, {}, "outline"),
     field(
         "centreline_m", Kind::kLine, "m", coordinate(), "",
         "middle of its region, a channel, point by point",
         [](Draft& d, const Value& v) { d.group.centreline = ring_of(v); }, {}, "channel"),
     field(
         "width_m", Kind::kNumber, "m", from(0.1, 1e5), "", "of the channel",
         [](Draft& d, const Value& v) { d.group.width = v.number(); }, {}, "channel"),
     field("sizes", Kind::kObject, "", {}, kLeftOut, "law of the floes' sizes; this or floe_size_m", nullptr,
           {}, "", &kSizes),
     field("floe_size_m", Kind::kNumber, "m", from(0.1, 1e4), kLeftOut, "mean of the floes' √area",
           [](Draft& d, const Value& v) { d.group.field.floe_size = v.number(); }),
     field("size_spread", Kind::kNumber, "", from(0, 0.5), kLeftOut,
           "with floe_size_m: standard deviation of the floes' √area / its mean, 0.25 if not given; they are "
           "lognormal, cut off at 2.5 deviations",
           [](Draft& d, const Value& v) { d.group.field.size_spread = v.number(); }),
     field("concentration", Kind::kNumber, "", above(0, 0.99), "",
           "share of the region that ice covers; with sizes, of the region less what is kept clear",
           [](Draft& d, const Value& v) {
             d.group.form = FloeGroup::Form::kField;
             d.group.field.concentration = v.number();
           }),
     field("gap_m", Kind::kNumber, "m", from(1e-6, 1000), "0.05",
           "least distance between floes, and of floes from what is kept clear",
           [](Draft& d, const Value& v) { d.group.field.gap = v.number(); }),
     field("most_corners", Kind::kInteger, "", from(3, 32), kLeftOut,
           "of a floe; floes are convex; 8 with floe_size_m and 16 with sizes if not given",
           [](Draft& d, const Value& v) { d.group.field.most_corners = static_cast<int>(v.number()); }),
     field("least_corners", Kind::kInteger, "", from(3, 32), kLeftOut,
           "with sizes: of a floe, whose sharpest corners are cut off until it has as many; 3 if not given",
           [](Draft& d, const Value& v) { d.group.field.least_corners = static_cast<int>(v.number()); }),
     field("aspect", Kind::kNumber, "", from(1, 5), kLeftOut,
           "with sizes: mean length / width of the floes; if not given, as the cells come, about 1.3",
           [](Draft& d, const Value& v) { d.group.field.aspect = v.number(); }),
     field("orientation_deg", Kind::kNumber, "°", from(-360, 360), kLeftOut,
           "with aspect: of the floes' length, from the x axis, counter-clockwise; any if not given",
           [](Draft& d, const Value& v) { d.group.field.orientation = radians(v); }),
     field("packing", Kind::kNumber, "", above(0, 0.99), kLeftOut,
           "with sizes: concentration between the holes, which floes of the same sizes would fill; if not "
           "given, 0.75, but no more than twice the concentration, nor less than that",
           [](Draft& d, const Value& v) { d.group.field.packing = v.number(); }),
     field(
         "keep_clear_m", Kind::kRings, "m", coordinate(), "[]",
         "regions no floe may reach into; ships, structures and walls are kept clear without being asked for",
         [](Draft& d, const Value& v) {
           for (const Value& ring : v.items()) d.group.field.kept_clear.push_back({ring_of(ring), {}});
         }),
     field("seed", Kind::kInteger, "", from(0, 9007199254740991), "0",
           "another one gives another field; the scene's seed is added",
           [](Draft& d, const Value& v) { d.group.field.seed = static_cast<std::uint64_t>(v.number()); })},
    {"rectangle", "outline", "channel"}};

const Object kLattice{
    {field("origin_m", Kind::kVector, "m", coordinate(), "[0, 0]",
           "corner of the lattice's area with the least x and y",
           [](Draft& d, const Value& v) {
             d.group.form = FloeGroup::Form::kLattice;
             d.group.origin = point_of(v);
           }),
     field("columns", Kind::kInteger, "", from(1, kLargestCount), "", "floes along x",
           [](Draft& d, const Value& v) { d.group.columns = static_cast<int>(v.number()); }),
     field("rows", Kind::kInteger, "", from(1, kLargestCount), "", "floes along y",
           [](Draft& d, const Value& v) { d.group.rows = static_cast<int>(v.number()); }),
     field("pitch_m", Kind::kNumberOrVector, "m", from(0.01, 1e5), "",
           "from one floe's centre to the next; each floe stands in the middle of its cell",
           [](Draft& d, const Value& v) { d.group.pitch = vector_of(v); }),
     field("size_m", Kind::kNumberOrVector, "m", from(0.01, 1e5), "", "sides of a floe, at most the pitch",
           [](Draft& d, const Value& v) { d.group.size = vector_of(v); })}};

const Object kRectangle{{field("corner_m", Kind::kVector, "m", coordinate(), "",
                               "corner with the least x and y before it is turned",
                               [](Draft& d, const Value& v) {
                                 d.group.form = FloeGroup::Form::kRectangle;
                                 d.group.origin = point_of(v);
                               }),
                         field("size_m", Kind::kNumberOrVector, "m", from(0.01, 1e5), "", "sides",
                               [](Draft& d, const Value& v) { d.group.size = vector_of(v); }),
                         field("angle_deg", Kind::kNumber, "°", from(-360, 360), "0",
                               "turned about that corner, counter-clockwise",
                               [](Draft& d, const Value& v) { d.group.angle = radians(v); })}};

const Object kPolygon{{field("outer_m", Kind::kRing, "m", coordinate(), "",
                             "outer boundary; it may run either way and may be closed",
                             [](Draft& d, const Value& v) {
                               d.group.form = FloeGroup::Form::kPolygon;
                               d.group.polygon.outer = ring_of(v);
                             }),
                       field("holes_m", Kind::kRings, "m", coordinate(), "[]", "boundaries of its holes",
                             [](Draft& d, const Value& v) {
                               for (const Value& hole : v.items())
                                 d.group.polygon.holes.push_back(ring_of(hole));
                             })}};

/// Of ice's properties, by their numbers in floe_ice.hpp.
template <std::size_t kProperty>
void set_ice(Draft& d, const Value& v) {
  d.group.ice.properties[kProperty] = v;
}

const Object kLaw{{field("law", Kind::kChoice, "", {}, "\"log_normal\"",
                         "constant; uniform between least and most; normal or log_normal, cut off at them",
                         nullptr, {"constant", "uniform", "normal", "log_normal"}),
                   field("mean", Kind::kNumber, "", {}, kLeftOut,
                         "of the law before it is cut off; if not given, the scene's", nullptr),
                   field("spread", Kind::kNumber, "", from(0, 2), kLeftOut,
                         "standard deviation / mean, likewise; normal and log_normal need it", nullptr),
                   field("least", Kind::kNumber, "", {}, kLeftOut,
                         "no floe has less; if not given, 3 deviations below the mean (normal), or the least "
                         "allowed; uniform "
                         "needs it",
                         nullptr),
                   field("most", Kind::kNumber, "", {}, kLeftOut, "no floe has more; likewise", nullptr)}};

const Object kOwnIce{
    {field("thickness_m", Kind::kNumberOrLaw, "m", from(1e-3, 20), kLeftOut, "thickness h", set_ice<0>),
     field("density_kg_per_m3", Kind::kNumberOrLaw, "kg/m³", from(100, 1100), kLeftOut,
           "density ρ_i, less than the water's", set_ice<1>),
     field("flexural_strength_Pa", Kind::kNumberOrLaw, "Pa", from(1, 1e9), kLeftOut, "flexural strength σ_f",
           set_ice<2>),
     field("compressive_strength_Pa", Kind::kNumberOrLaw, "Pa", from(1, 1e10), kLeftOut,
           "compressive strength σ_c; of two floes the weaker ice crushes", set_ice<3>),
     field("tensile_strength_Pa", Kind::kNumberOrLaw, "Pa", from(1, 1e9), kLeftOut, "tensile strength σ_t",
           set_ice<4>),
     field("fracture_toughness_Pa_sqrt_m", Kind::kNumberOrLaw, "Pa √m", from(1, 1e9), kLeftOut,
           "fracture toughness K_IC", set_ice<5>),
     field("seed", Kind::kInteger, "", from(0, 9007199254740991), "0",
           "another one draws other floes' ice; the scene's seed is added",
           [](Draft& d, const Value& v) { d.group.ice.seed = static_cast<std::uint64_t>(v.number()); })}};

const Object kFloes{
    {field("lattice", Kind::kObject, "", {}, "", "rows and columns of equal rectangles", nullptr, {},
           "lattice", &kLattice),
     field("rectangle", Kind::kObject, "", {}, "", "one rectangle", nullptr, {}, "rectangle", &kRectangle),
     field("polygon", Kind::kObject, "", {}, "", "one polygon, with holes", nullptr, {}, "polygon",
           &kPolygon),
     field("field", Kind::kObject, "", {}, "", "random convex floes at a concentration", nullptr, {}, "field",
           &kField),
     field(
         "file", Kind::kText, "", {}, "",
         "a floe file in the scene's folder or below: GeoJSON in metres, in longitude and latitude or with a "
         "crs; shapefile, GeoPackage, FlatGeobuf; a run's final.geojson (docs/import.md)",
         [](Draft& d, const Value& v) {
           d.group.form = FloeGroup::Form::kFile;
           d.group.file = v.text();
         },
         {}, "file"),
     field("import", Kind::kObject, "", {}, kLeftOut,
           "repairs, simplifies and trims the file's floes as `polynya import` does", nullptr, {}, "file",
           &import_object()),
     field("fast_ice", Kind::kBoolean, "", {}, "false",
           "held whatever pushes it, at its velocity, which is then over ground; of its pieces, the largest "
           "stays "
           "fast",
           [](Draft& d, const Value& v) { d.group.is_fast = v.boolean(); }),
     field("velocity_m_per_s", Kind::kVector, "m/s", from(-20, 20), "[0, 0]",
           "of the centre of mass relative to the water there, at the start",
           [](Draft& d, const Value& v) { d.group.velocity = vector_of(v); }),
     field("angular_velocity_deg_per_s", Kind::kNumber, "°/s", from(-360, 360), "0",
           "counter-clockwise, at the start; a shear's own turning comes on top",
           [](Draft& d, const Value& v) { d.group.angular_velocity = radians(v); }),
     field("ice", Kind::kObject, "", {}, kLeftOut,
           "what of their ice is not the scene's: given, or drawn floe by floe; pieces have their floe's",
           nullptr, {}, "", &floe_ice_object()),
     field("crushed_overlaps", Kind::kBoolean, "", {}, kLeftOut,
           "floes as a run left them: they may overlap ships and each other, by the ice that was crushed "
           "there; of a run's floe file without being asked for",
           [](Draft& d, const Value& v) { d.group.has_crushed_overlaps = v.boolean(); }),
     field("source_floe_id", Kind::kInteger, "", from(0, 9007199254740991), kLeftOut,
           "the floe_id that it has in the file it is from; written beside its own",
           [](Draft& d, const Value& v) { d.group.source_floe = static_cast<std::int64_t>(v.number()); })},
    {"lattice", "rectangle", "polygon", "field", "file"},
    [](Draft& d) { d.group = {}; }};

}  // namespace

const Object& law_object() {
  return kLaw;
}
const Object& floe_ice_object() {
  return kOwnIce;
}
const Object& floes_object() {
  return kFloes;
}

}  // namespace polynya::io
