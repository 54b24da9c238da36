#include "io/import/floe_properties.hpp"
#include "io/scene/describe.hpp"
#include "io/scene/scene_input.hpp"

namespace polynya::io {
namespace {

using namespace simulation;
using geometry::Polygon;

const Description<SizeLaw> kSizes{
    {of("equal",
        required(member<SizeLaw>("size_m", "m", from(0.1, 1e4), "size √area of every floe", &EqualSizes::size))),
     of("log-normal",
        required(member<SizeLaw>("mean_m", "m", from(0.1, 1e4),
                                 "mean √area of log-normal sizes, cut off at 3 standard deviations of the logarithm",
                                 &LognormalSizes::mean))),
     of("log-normal", required(member<SizeLaw>("spread", "", from(0, 1), "standard deviation / mean of the sizes",
                                               &LognormalSizes::spread))),
     of("power law", required(member<SizeLaw>("exponent", "", from(-3, 6),
                                              "exponent a: the number of floes with √area > d is proportional to d^−a; "
                                              "with −1 sizes are uniformly distributed",
                                              &PowerLawSizes::exponent))),
     of("power law",
        required(member<SizeLaw>("least_m", "m", from(0.1, 1e4), "smallest √area", &PowerLawSizes::least))),
     of("power law",
        required(member<SizeLaw>("largest_m", "m", from(0.1, 1e4), "largest √area", &PowerLawSizes::largest)))}};

const Description<FieldInput> kField{
    {of("rectangle", required(member("corner_m", "m", coordinate(), "corner of the region with the smallest x and y",
                                     &FieldInput::region, &FieldRectangle::corner))),
     of("rectangle",
        required(as(FieldKind::kNumberOrVector, member("extent_m", "m", from(0.1, 1e6), "sides of the region",
                                                       &FieldInput::region, &FieldRectangle::extent)))),
     of("outline",
        required(
            member("outline_m", "m", coordinate(),
                   "outline of the region, point by point; with floe_size_m, floes that would cross it are left out",
                   &FieldInput::region, &FieldOutline::ring))),
     of("channel", required(as(FieldKind::kLine, member("centreline_m", "m", coordinate(),
                                                        "centreline of the region, a channel, point by point",
                                                        &FieldInput::region, &FieldChannel::centreline)))),
     of("channel", required(member("width_m", "m", from(0.1, 1e5), "width of the channel", &FieldInput::region,
                                   &FieldChannel::width))),
     object("sizes", kSizes, "law of the floes' sizes; give this or floe_size_m", &FieldInput::field, &FloeField::law),
     member("floe_size_m", "m", from(0.1, 1e4), "mean of the floes' √area", &FieldInput::floe_size),
     member("size_spread", "", from(0, 0.5),
            "with floe_size_m: standard deviation / mean of the floes' √area, 0.25 if not given; sizes are log-normal, "
            "cut off at 2.5 standard deviations",
            &FieldInput::size_spread),
     required(member(
         "concentration", "", above(0, 0.99),
         "fraction of the region that ice covers; with sizes, of the region without the parts that are kept clear",
         &FieldInput::field, &FloeField::concentration)),
     member("gap_m", "m", from(1e-6, 1000),
            "least distance between floes, and between floes and parts that are kept clear", &FieldInput::field,
            &FloeField::gap),
     member("most_corners", "", from(3, 32),
            "largest number of corners of a floe; floes are convex; if not given, 8 with floe_size_m and 16 with sizes",
            &FieldInput::most_corners),
     member("least_corners", "", from(3, 32),
            "with sizes: smallest number of corners of a floe; its sharpest corners are cut off until it has as many; "
            "3 if not given",
            &FieldInput::least_corners),
     member("aspect", "", from(1, 5),
            "with sizes: mean length / width of the floes; if not given, that of random cells, about 1.3",
            &FieldInput::aspect),
     member("orientation_deg", "°", from(-360, 360),
            "with aspect: direction of the floes' length from the x axis, counter-clockwise; if not given, random",
            &FieldInput::orientation),
     member("packing", "", above(0, 0.99),
            "with sizes: concentration between the openings, which floes of the same sizes would fill; if not given, "
            "0.75, but between the concentration and twice the concentration",
            &FieldInput::packing),
     member("keep_clear_m", "m", coordinate(),
            "regions into which no floe may extend; ships, structures and walls are always kept clear",
            &FieldInput::keep_clear),
     member("seed", "", from(0, kLargestSeed),
            "seed of the field, to which the scene's seed is added; another seed gives another field",
            &FieldInput::field, &FloeField::seed)}};

const Description<ChannelInput> kChannel{
    {required(as(FieldKind::kLine, member("centreline_m", "m", coordinate(), "middle of the channel, point by point",
                                          &ChannelInput::brash, &FieldInput::region, &FieldChannel::centreline))),
     required(member("width_m", "m", from(0.1, 1e5), "of the channel", &ChannelInput::brash, &FieldInput::region,
                     &FieldChannel::width)),
     required(member("thickness_m", "m", from(0.001, 20), "of the brash in the middle, H_M, with its pores",
                     &ChannelInput::thickness)),
     member("side_thickness_m", "m", from(0.001, 20),
            "of the brash at the sides, with its pores; linear in between; that in the middle if not given",
            &ChannelInput::side_thickness),
     member("porosity", "", below(0, 0.9), "share of the brash's volume that is not ice", &ChannelInput::porosity),
     member("cover", "", above(0, 0.98),
            "share of the channel that the pieces cover; they are thickness · (1 − porosity) / cover thick; "
            "1 − porosity if not given, but at most 0.9",
            &ChannelInput::cover),
     object("sizes", kSizes, "law of the pieces' sizes, √area; must be given but with consolidated_thickness_m",
            &ChannelInput::brash, &FieldInput::field, &FloeField::law),
     member("gap_m", "m", from(1e-6, 1000), "least distance between pieces", &ChannelInput::brash, &FieldInput::field,
            &FloeField::gap),
     member("consolidated_thickness_m", "m", from(0.001, 20),
            "of a frozen layer on the brash: one plate of fast ice in place of the pieces, with the buoyancy of both",
            &ChannelInput::consolidated_thickness),
     member("fast_ice_thickness_m", "m", from(0.001, 20),
            "of the fast ice on both sides; the scene's ice.thickness_m if not given",
            &ChannelInput::fast_ice_thickness),
     member("fast_ice_width_m", "m", from(0, 1e5), "of the fast ice on each side; 0: none",
            &ChannelInput::fast_ice_width),
     member("keep_clear_m", "m", coordinate(),
            "regions no piece may reach into; ships, structures and walls are kept clear without being asked for",
            &ChannelInput::brash, &FieldInput::keep_clear),
     member("seed", "", from(0, kLargestSeed), "another one gives other pieces; the scene's seed is added",
            &ChannelInput::brash, &FieldInput::field, &FloeField::seed)}};

const Description<LatticeInput> kLattice{
    {member("origin_m", "m", coordinate(), "corner of the lattice's area with the smallest x and y",
            &LatticeInput::origin),
     required(member("columns", "", from(1, kLargestCount), "number of floes along x", &LatticeInput::columns)),
     required(member("rows", "", from(1, kLargestCount), "number of floes along y", &LatticeInput::rows)),
     required(as(FieldKind::kNumberOrVector,
                 member("pitch_m", "m", from(0.01, 1e5),
                        "distance between the centres of neighbouring floes; each floe is in the middle of its cell",
                        &LatticeInput::pitch))),
     required(as(FieldKind::kNumberOrVector,
                 member("size_m", "m", from(0.01, 1e5), "sides of a floe, at most the pitch", &LatticeInput::size)))}};

const Description<RectangleInput> kRectangle{
    {required(member("corner_m", "m", coordinate(), "corner with the smallest x and y before the rotation",
                     &RectangleInput::corner)),
     required(as(FieldKind::kNumberOrVector,
                 member("size_m", "m", from(0.01, 1e5), "sides of the rectangle", &RectangleInput::size))),
     member("angle_deg", "°", from(-360, 360), "rotation about that corner, counter-clockwise",
            &RectangleInput::angle)}};

const Description<Polygon> kPolygon{
    {required(
         member("outer_m", "m", coordinate(), "outer boundary, in either direction, open or closed", &Polygon::outer)),
     member("holes_m", "m", coordinate(), "boundaries of the holes", &Polygon::holes)}};

using Repair = std::optional<geometry::FillRule>;
const Description<FileImport> kImport{
    {member("from", "", {}, "coordinate system of the file, if the file states none: EPSG:4326", &FileImport::settings,
            &ImportSettings::plane, &PlaneSettings::source),
     member("crs", "", {}, "projected system whose plane is that of the scene, for scenes without an origin: EPSG:3413",
            &FileImport::settings, &ImportSettings::plane, &PlaneSettings::target),
     member("shift", "", {}, "move the middle of the box around all floes to (0, 0), by whole metres",
            &FileImport::settings, &ImportSettings::plane, &PlaneSettings::is_shifted),
     member("join_m", "m", from(0, 1e3),
            "join polygons of one feature, and polygons on both sides of longitude 180, whose boundaries are within "
            "this distance of each other, and close narrower slits; 0: none",
            &FileImport::settings, &ImportSettings::join),
     choice<Repair>(
         "repair", "treatment of outlines that are not valid: refuse the floe, or repair it by a fill rule",
         {{"refuse", Repair{}}, {"even-odd", geometry::FillRule::kEvenOdd}, {"non-zero", geometry::FillRule::kNonZero}},
         &FileImport::settings, &ImportSettings::repair),
     member("simplify_m", "m", from(0, 1e4), "leave out vertices within this distance of the remaining outline",
            &FileImport::settings, &ImportSettings::simplify),
     member("min_area_m2", "m²", from(0, 1e12), "drop floes with less area", &FileImport::settings,
            &ImportSettings::least_area),
     member("gap_m", "m", from(0, 1000), "least distance between floes; the smaller of two floes is trimmed to it",
            &FileImport::settings, &ImportSettings::gap),
     member("tolerance_m", "m", from(0, 1e5),
            "add points to edges that are not straight in the plane until they are within this distance of their true "
            "course; 0: none",
            &FileImport::settings, &ImportSettings::plane, &PlaneSettings::tolerance),
     member("layer", "", {}, "layer to read, if the file has several", &FileImport::selection, &Selection::layer),
     member("where", "", {},
            "read only features whose properties satisfy this condition, as in ogr2ogr: POLY_TYPE = 'I'",
            &FileImport::selection, &Selection::where),
     member("properties", "", {},
            "names of properties in the file, with factors for units or values for codes: thickness_m=CM*0.01, "
            "floe_id=FID, thickness_m=SA[91:0.95 93:1.6]",
            &FileImport::properties),
     member("nodata", "", from(-1e300, 1e300), "numbers that mean no value in a property: [-9, -9999]",
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
    {choice<ScatterKind>("law",
                         "kind of distribution: constant; uniform between least and most; normal or log_normal, cut "
                         "off at least and most",
                         {{"constant", ScatterKind::kConstant},
                          {"uniform", ScatterKind::kUniform},
                          {"normal", ScatterKind::kNormal},
                          {"log_normal", ScatterKind::kLogNormal}},
                         &LawInput::kind),
     member("mean", "", {}, "mean of the law before it is cut off; if not given, the value of the scene",
            &LawInput::mean),
     member("spread", "", from(0, 2),
            "standard deviation / mean of the law before it is cut off; required for normal and log_normal",
            &LawInput::spread),
     member("least", "", {},
            "smallest value; if not given, 3 standard deviations below the mean (normal), or the smallest allowed "
            "value; required for uniform",
            &LawInput::least),
     member("most", "", {}, "largest value; defaults as for least", &LawInput::most)}};

const Description<IceInput> kFloeIceDescription{
    {property(0, "thickness h"), property(1, "density ρ_i, less than the water's"),
     property(2, "flexural strength σ_f"),
     property(3, "compressive strength σ_c; between two floes the weaker ice crushes"),
     property(4, "tensile strength σ_t"), property(5, "fracture toughness K_IC"),
     member("seed", "", from(0, kLargestSeed),
            "seed of the draws, to which the scene's seed is added; another seed draws other values",
            &IceInput::seed)}};

const Description<FloeGroup> kFloesDescription{
    {form("lattice", kLattice, "rows and columns of equal rectangles"), form("rectangle", kRectangle, "one rectangle"),
     form("polygon", kPolygon, "one polygon, with holes"),
     form("field", kField, "random convex floes at a concentration"),
     form("channel", kChannel, "a channel of brash ice between fast ice"),
     of("file", required(member("file", "", {},
                                "floe file in the scene's folder or below it: GeoJSON in metres, in longitude and "
                                "latitude or with "
                                "a crs; any format that GDAL's ogr2ogr reads; a run's final.geojson (docs/import.md)",
                                &FloeGroup::form, &FileInput::name))),
     of("file", object("import", kImport, "repair, simplify and trim the file's floes as `polynya import` does",
                       &FloeGroup::form, &FileInput::import)),
     member("fast_ice", "", {},
            "fast ice: it keeps its velocity, which is then over ground, whatever pushes it; the largest of its pieces "
            "remains fast",
            &FloeGroup::is_fast),
     member("velocity_m_per_s", "m/s", from(-20, 20),
            "initial velocity of the centre of mass, relative to the water there", &FloeGroup::velocity),
     member("angular_velocity_deg_per_s", "°/s", from(-360, 360),
            "initial angular velocity, counter-clockwise; the rotation by a sheared current is added",
            &FloeGroup::angular_velocity),
     object("ice", kFloeIceDescription,
            "ice properties that differ from those of the scene, given or drawn for each floe; pieces inherit those of "
            "their floe",
            &FloeGroup::ice),
     member("crushed_overlaps", "", {},
            "true for floes as a run left them, which may overlap ships and each other by the ice that was crushed "
            "there; the default for a run's floe file",
            &FloeGroup::has_crushed_overlaps),
     member("source_floe_id", "", from(0, kLargestSeed),
            "floe_id of the floe in its file; it is written in addition to its own", &FloeGroup::source_floe),
     member("under_hull_of", "", {}, "name of the ship under whose hull the floe is at the start, as a run left it",
            &FloeGroup::under_hull_of),
     member("under_hull_path_m", "m", from(-1000, 1e5),
            "distance that this ship has moved over the floe since it went under; 0 if not given",
            &FloeGroup::under_hull_path)}};

}  // namespace polynya::io
