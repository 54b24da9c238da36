#include "io/import/floe_properties.hpp"
#include "io/scene/describe.hpp"
#include "io/scene/scene_input.hpp"

namespace polynya::io {
namespace {

using namespace simulation;
using geometry::Polygon;

const Description<SizeLaw> kSizes{
    {of("equal", required(member<SizeLaw>("size_m", "m", from(0.1, 1e4), "√area of every floe", &EqualSizes::size))),
     of("log-normal",
        required(member<SizeLaw>("mean_m", "m", from(0.1, 1e4),
                                 "mean √area of log-normal sizes, cut off at 3 deviations of the logarithm",
                                 &LognormalSizes::mean))),
     of("log-normal", required(member<SizeLaw>("spread", "", from(0, 1), "their standard deviation / mean",
                                               &LognormalSizes::spread))),
     of("power law",
        required(member<SizeLaw>("exponent", "", from(-3, 6),
                                 "a of the number of floes larger than d, ∝ d^−a, d √area; −1 is even in d",
                                 &PowerLawSizes::exponent))),
     of("power law", required(member<SizeLaw>("least_m", "m", from(0.1, 1e4), "least √area", &PowerLawSizes::least))),
     of("power law",
        required(member<SizeLaw>("largest_m", "m", from(0.1, 1e4), "largest √area", &PowerLawSizes::largest)))}};

const Description<FieldInput> kField{
    {of("rectangle", required(member("corner_m", "m", coordinate(), "corner of its region with the least x and y",
                                     &FieldInput::region, &FieldRectangle::corner))),
     of("rectangle",
        required(as(FieldKind::kNumberOrVector, member("extent_m", "m", from(0.1, 1e6), "sides of its region",
                                                       &FieldInput::region, &FieldRectangle::extent)))),
     of("outline",
        required(member("outline_m", "m", coordinate(),
                        "its region point by point; with floe_size_m, floes that would cross it are left out",
                        &FieldInput::region, &FieldOutline::ring))),
     of("channel", required(as(FieldKind::kLine, member("centreline_m", "m", coordinate(),
                                                        "middle of its region, a channel, point by point",
                                                        &FieldInput::region, &FieldChannel::centreline)))),
     of("channel",
        required(member("width_m", "m", from(0.1, 1e5), "of the channel", &FieldInput::region, &FieldChannel::width))),
     object("sizes", kSizes, "law of the floes' sizes; this or floe_size_m", &FieldInput::field, &FloeField::law),
     member("floe_size_m", "m", from(0.1, 1e4), "mean of the floes' √area", &FieldInput::floe_size),
     member("size_spread", "", from(0, 0.5),
            "with floe_size_m: standard deviation of the floes' √area / its mean, 0.25 if not given; they are "
            "lognormal, cut off at 2.5 deviations",
            &FieldInput::size_spread),
     required(member("concentration", "", above(0, 0.99),
                     "share of the region that ice covers; with sizes, of the region less what is kept clear",
                     &FieldInput::field, &FloeField::concentration)),
     member("gap_m", "m", from(1e-6, 1000), "least distance between floes, and of floes from what is kept clear",
            &FieldInput::field, &FloeField::gap),
     member("most_corners", "", from(3, 32),
            "of a floe; floes are convex; 8 with floe_size_m and 16 with sizes if not given",
            &FieldInput::most_corners),
     member("least_corners", "", from(3, 32),
            "with sizes: of a floe, whose sharpest corners are cut off until it has as many; 3 if not given",
            &FieldInput::least_corners),
     member("aspect", "", from(1, 5),
            "with sizes: mean length / width of the floes; if not given, as the cells come, about 1.3",
            &FieldInput::aspect),
     member("orientation_deg", "°", from(-360, 360),
            "with aspect: of the floes' length, from the x axis, counter-clockwise; any if not given",
            &FieldInput::orientation),
     member("packing", "", above(0, 0.99),
            "with sizes: concentration between the holes, which floes of the same sizes would fill; if not "
            "given, 0.75, but no more than twice the concentration, nor less than that",
            &FieldInput::packing),
     member("keep_clear_m", "m", coordinate(),
            "regions no floe may reach into; ships, structures and walls are kept clear without being asked for",
            &FieldInput::keep_clear),
     member("seed", "", from(0, kLargestSeed), "another one gives another field; the scene's seed is added",
            &FieldInput::field, &FloeField::seed)}};

const Description<LatticeInput> kLattice{
    {member("origin_m", "m", coordinate(), "corner of the lattice's area with the least x and y",
            &LatticeInput::origin),
     required(member("columns", "", from(1, kLargestCount), "floes along x", &LatticeInput::columns)),
     required(member("rows", "", from(1, kLargestCount), "floes along y", &LatticeInput::rows)),
     required(as(FieldKind::kNumberOrVector,
                 member("pitch_m", "m", from(0.01, 1e5),
                        "from one floe's centre to the next; each floe stands in the middle of its cell",
                        &LatticeInput::pitch))),
     required(as(FieldKind::kNumberOrVector,
                 member("size_m", "m", from(0.01, 1e5), "sides of a floe, at most the pitch", &LatticeInput::size)))}};

const Description<RectangleInput> kRectangle{
    {required(member("corner_m", "m", coordinate(), "corner with the least x and y before it is turned",
                     &RectangleInput::corner)),
     required(as(FieldKind::kNumberOrVector, member("size_m", "m", from(0.01, 1e5), "sides", &RectangleInput::size))),
     member("angle_deg", "°", from(-360, 360), "turned about that corner, counter-clockwise", &RectangleInput::angle)}};

const Description<Polygon> kPolygon{
    {required(member("outer_m", "m", coordinate(), "outer boundary; it may run either way and may be closed",
                     &Polygon::outer)),
     member("holes_m", "m", coordinate(), "boundaries of its holes", &Polygon::holes)}};

using Repair = std::optional<geometry::FillRule>;
const Description<FileImport> kImport{
    {member("from", "", {}, "the file's coordinate system, where the file names none: EPSG:4326", &FileImport::settings,
            &ImportSettings::plane, &PlaneSettings::source),
     member("crs", "", {}, "the projected system whose plane is the scene's: EPSG:3413; of scenes without an origin",
            &FileImport::settings, &ImportSettings::plane, &PlaneSettings::target),
     member("shift", "", {}, "moves the middle of the floes' box to (0, 0), by whole metres", &FileImport::settings,
            &ImportSettings::plane, &PlaneSettings::is_shifted),
     member("join_m", "m", from(0, 1e3),
            "joins polygons of one feature, and those on both sides of longitude 180, whose boundaries run along each "
            "other within this distance, and closes slits that are narrower; 0: none",
            &FileImport::settings, &ImportSettings::join),
     choice<Repair>(
         "repair", "what becomes of outlines that are not valid: refused, or made of what a rule fills",
         {{"refuse", Repair{}}, {"even-odd", geometry::FillRule::kEvenOdd}, {"non-zero", geometry::FillRule::kNonZero}},
         &FileImport::settings, &ImportSettings::repair),
     member("simplify_m", "m", from(0, 1e4), "leaves out vertices, each at most so far from the outline that is left",
            &FileImport::settings, &ImportSettings::simplify),
     member("min_area_m2", "m²", from(0, 1e12), "drops smaller floes", &FileImport::settings,
            &ImportSettings::least_area),
     member("gap_m", "m", from(0, 1000), "least distance between floes: the smaller of two is trimmed to it",
            &FileImport::settings, &ImportSettings::gap),
     member("tolerance_m", "m", from(0, 1e5),
            "edges that are not straight in the plane get points until they are this near to it; 0: none",
            &FileImport::settings, &ImportSettings::plane, &PlaneSettings::tolerance),
     member("layer", "", {}, "the layer, of a file with several", &FileImport::selection, &Selection::layer),
     member("where", "", {},
            "takes only features whose properties meet this condition, as ogr2ogr does: POLY_TYPE = 'I'",
            &FileImport::selection, &Selection::where),
     member("properties", "", {},
            "the file's names for properties, with factors for units or values for codes: thickness_m=CM*0.01, "
            "floe_id=FID, thickness_m=SA[91:0.95 93:1.6]",
            &FileImport::properties),
     member("nodata", "", from(-1e300, 1e300), "numbers that stand for no value in a property: [-9, -9999]",
            &FileImport::no_data)}};

using fracture::ScatterKind;

/// A property that floe files also have, by its index there: a number, or a law from which it is drawn.
FieldOf<IceInput> property(std::size_t index, std::string_view meaning) {
  const FloeProperty& in_file = floe_ice_properties()[index];
  const auto given = [index](const void* record) -> const std::optional<NumberOrLaw>& {
    return static_cast<const IceInput*>(record)->properties[index];
  };
  const auto own = [index](void* record) -> std::optional<NumberOrLaw>& {
    return static_cast<IceInput*>(record)->properties[index];
  };
  return {{.key = in_file.key,
           .kind = FieldKind::kNumberOrLaw,
           .unit = in_file.unit,
           .range = from(in_file.low, in_file.high),
           .meaning = meaning,
           .presence = Presence::kLeftOut,
           .object = &kLawDescription,
           .set = [own](void* record, const JsonValue& json) { own(record) = json.number(); },
           .get = [given](const void* record) -> std::optional<JsonValue> {
             const auto* number = place::held<double>(given(record));
             return number ? std::optional(JsonValue{*number}) : std::nullopt;
           },
           .open = [own](void* record) -> void* { return place::held<LawInput>(own(record)); },
           .find = [given](const void* record, std::size_t) -> const void* {
             return place::held<LawInput>(given(record));
           }}};
}

template <class Form>
FieldOf<FloeGroup> form(std::string_view key, const Description<Form>& description, std::string_view meaning) {
  return of(key, required(object(key, description, meaning, &FloeGroup::form)));
}

}  // namespace

const Description<LawInput> kLawDescription{
    {choice<ScatterKind>("law", "constant; uniform between least and most; normal or log_normal, cut off at them",
                         {{"constant", ScatterKind::kConstant},
                          {"uniform", ScatterKind::kUniform},
                          {"normal", ScatterKind::kNormal},
                          {"log_normal", ScatterKind::kLogNormal}},
                         &LawInput::kind),
     member("mean", "", {}, "of the law before it is cut off; if not given, the scene's", &LawInput::mean),
     member("spread", "", from(0, 2), "standard deviation / mean, likewise; normal and log_normal need it",
            &LawInput::spread),
     member("least", "", {},
            "no floe has less; if not given, 3 deviations below the mean (normal), or the least allowed; "
            "uniform needs it",
            &LawInput::least),
     member("most", "", {}, "no floe has more; likewise", &LawInput::most)}};

const Description<IceInput> kFloeIceDescription{
    {property(0, "thickness h"), property(1, "density ρ_i, less than the water's"),
     property(2, "flexural strength σ_f"), property(3, "compressive strength σ_c; of two floes the weaker ice crushes"),
     property(4, "tensile strength σ_t"), property(5, "fracture toughness K_IC"),
     member("seed", "", from(0, kLargestSeed), "another one draws other floes' ice; the scene's seed is added",
            &IceInput::seed)}};

const Description<FloeGroup> kFloesDescription{
    {form("lattice", kLattice, "rows and columns of equal rectangles"), form("rectangle", kRectangle, "one rectangle"),
     form("polygon", kPolygon, "one polygon, with holes"),
     form("field", kField, "random convex floes at a concentration"),
     of("file", required(member("file", "", {},
                                "a floe file in the scene's folder or below: GeoJSON in metres, in longitude and "
                                "latitude or with "
                                "a crs; any format that GDAL's ogr2ogr reads; a run's final.geojson (docs/import.md)",
                                &FloeGroup::form, &FileInput::name))),
     of("file", object("import", kImport, "repairs, simplifies and trims the file's floes as `polynya import` does",
                       &FloeGroup::form, &FileInput::import)),
     member("fast_ice", "", {},
            "held whatever pushes it, at its velocity, which is then over ground; of its pieces, the largest "
            "stays fast",
            &FloeGroup::is_fast),
     member("velocity_m_per_s", "m/s", from(-20, 20), "of the centre of mass relative to the water there, at the start",
            &FloeGroup::velocity),
     member("angular_velocity_deg_per_s", "°/s", from(-360, 360),
            "counter-clockwise, at the start; a shear's own turning comes on top", &FloeGroup::angular_velocity),
     object("ice", kFloeIceDescription,
            "what of their ice is not the scene's: given, or drawn floe by floe; pieces have their floe's",
            &FloeGroup::ice),
     member("crushed_overlaps", "", {},
            "floes as a run left them: they may overlap ships and each other, by the ice that was crushed "
            "there; of a run's floe file without being asked for",
            &FloeGroup::has_crushed_overlaps),
     member("source_floe_id", "", from(0, kLargestSeed),
            "the floe_id that it has in the file it is from; written beside its own", &FloeGroup::source_floe),
     member("under_hull_of", "", {}, "the ship under whose hull it is at the start, as a run left it",
            &FloeGroup::under_hull_of),
     member("under_hull_path_m", "m", from(-1000, 1e5), "then how far that ship has come over it; 0 if not given",
            &FloeGroup::under_hull_path)}};

}  // namespace polynya::io
