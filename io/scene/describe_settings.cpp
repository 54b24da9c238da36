#include "io/scene/describe.hpp"
#include "io/scene/scene_input.hpp"
#include "simulation/world/limits.hpp"

namespace polynya::io {
namespace {

using fracture::CharacteristicLength;
using fracture::EdgeOutline;
using fracture::Ice;
using fracture::RadialCracks;
using fracture::SplittingModel;
using namespace simulation;

const Description<GeographicOrigin> kOrigin{
    {required(member("latitude_deg", "°", from(-90, 90), "latitude of the scene's origin on WGS 84, north positive",
                     &GeographicOrigin::latitude)),
     required(member("longitude_deg", "°", from(-180, 180), "longitude of the scene's origin, east positive",
                     &GeographicOrigin::longitude)),
     member("heading_deg", "°", from(-360, 360),
            "heading of the scene's x axis from true north, clockwise; 90: x is east, y north",
            &GeographicOrigin::heading)}};

const Description<StepSettings> kTime{
    {chosen(member("step_s", "s", from(1e-5, 1),
                   "the tick, which is the longest time step Δt; if not given, it is chosen from 0.0005 to 0.1 s by "
                   "speeds and thickness. With law crush a tick is divided into up to 32 equal parts when ice breaks "
                   "fast (docs/theory/steps.md)",
                   &StepSettings::step)),
     member("until_s", "s", above(0, 1e7), "simulated time at which the run ends, rounded up to a whole tick",
            &StepSettings::until)}};

const Description<ShearSettings> kShear{
    {member("rate_per_s", "1/s", from(-1, 1),
            "increase of the current's speed along its direction per metre to port of the origin",
            &ShearSettings::rate),
     member("direction_deg", "°", from(-360, 360), "direction of the current from the x axis, counter-clockwise",
            &ShearSettings::direction),
     member("origin_m", "m", coordinate(),
            "initial position of a point at which the water has only the drift; it moves with the drift",
            &ShearSettings::origin)}};

const Description<dynamics::FlowRow> kFlowRow{
    {required(member("t_s", "s", from(-1e7, 1e7), "time of the row; ascending", &dynamics::FlowRow::time)),
     required(member("speed_m_per_s", "m/s", from(0, 100), "speed", &dynamics::FlowRow::speed)),
     required(member("direction_deg", "°", from(-360, 360),
                     "direction in which it flows, from the x axis, counter-clockwise",
                     &dynamics::FlowRow::direction))}};

const Description<dynamics::Tide> kTide{
    {member("period_s", "s", from(60, 1e7), "period of the tide; that of the tide M2 if not given",
            &dynamics::Tide::period),
     required(
         member("major_m_per_s", "m/s", from(0, 10), "amplitude along the ellipse's axis", &dynamics::Tide::major)),
     member("minor_m_per_s", "m/s", from(-10, 10), "amplitude across the axis; negative: the velocity turns clockwise",
            &dynamics::Tide::minor),
     member("direction_deg", "°", from(-360, 360), "direction of the ellipse's axis from the x axis, counter-clockwise",
            &dynamics::Tide::direction),
     member("phase_deg", "°", from(-360, 360), "phase at t = 0; with 0 the velocity is along the axis",
            &dynamics::Tide::phase)}};

const Description<WaterSettings> kWater{
    {member("density_kg_per_m3", "kg/m³", from(500, 2000), "density ρ_w", &WaterSettings::water,
            &fracture::Water::density),
     member("drag_coefficient", "", from(0, 100), "drag coefficient C_D of Eq. (6)", &WaterSettings::drag_coefficient),
     choice<dynamics::DragArea>("drag_area",
                                "area A of Eq. (6): thickness times the floe's width across its motion, or its area in "
                                "plan (the reading that reproduces the paper's voyages: docs/paper-comparison.md)",
                                {{"edge", dynamics::DragArea::kEdge}, {"plan", dynamics::DragArea::kPlan}},
                                &WaterSettings::drag_area),
     member("skin_drag_coefficient", "", from(0, 1),
            "coefficient C_w of the friction on a floe's area in plan, in addition to Eq. (6); if not given, 0.004 if "
            "there is wind",
            &WaterSettings::skin_drag_coefficient),
     member("drift_m_per_s", "m/s", from(-10, 10), "velocity of the water, with which free ice drifts",
            &WaterSettings::drift),
     list("drift_table", from(0, 1000), "drift over time, instead of drift_m_per_s; the vector is linear between rows",
          kFlowRow, &WaterSettings::drift_rows),
     object("tide", kTide, "tidal current as an ellipse, in addition to the drift", &WaterSettings::tide),
     object("shear", kShear, "current that changes linearly across its direction, in addition to the drift",
            &WaterSettings::shear)}};

const Description<dynamics::Wind> kWind{
    {member("velocity_m_per_s", "m/s", from(-100, 100),
            "U_10, velocity of the wind over ground 10 m above the ice, in the direction in which it blows; it pushes "
            "each floe that is not fast by ½ ρ_a C_a |U_10| U_10 on its area in plan",
            &dynamics::Wind::velocity),
     list("table", from(0, 1000), "wind over time, instead of velocity_m_per_s, in the form of water.drift_table",
          kFlowRow, &dynamics::Wind::rows),
     member("drag_coefficient", "", from(0, 1), "drag coefficient C_a of the ice", &dynamics::Wind::drag_coefficient),
     member("air_density_kg_per_m3", "kg/m³", from(0, 10), "density ρ_a of the air", &dynamics::Wind::density)}};

const Description<ContactSettings> kContact{
    {member("circle_radius_m", "m", from(0.01, 100), "radius of the contact circles", &ContactSettings::circle_radius),
     choice<ContactNormal>("normal",
                           "how the normal of a contact is computed: from the boundaries where the bodies overlap, or "
                           "along the line between the centres of the touching circles (the paper's rule)",
                           {{"boundary", ContactNormal::kBoundary}, {"circle-centres", ContactNormal::kCircleCentres}},
                           &ContactSettings::normal),
     choice<ContactLaw>("law",
                        "contact law: forces that crushing ice can carry, or the paper's rigid impulses, Eq. (5)",
                        {{"crush", ContactLaw::kCrush}, {"impulse", ContactLaw::kImpulse}}, &ContactSettings::law),
     member("substeps", "", from(1, 64),
            "with law crush: number of parts of a time step that the solver treats one after the other",
            &ContactSettings::substeps),
     member("tolerance_m_per_s", "m/s", from(1e-9, 0.1), "with law crush: largest remaining violation of the law",
            &ContactSettings::tolerance),
     choice<bool>("start",
                  "with law crush: impulses from which the solver starts, those of the previous step or none; the "
                  "solution does not depend on it",
                  {{"last-step", true}, {"zero", false}}, &ContactSettings::is_warm_started),
     member("restitution", "", from(0, 1), "restitution ε of Eq. (5)", &ContactSettings::restitution),
     member("contact_time_s", "s", from(1e-4, 100),
            "contact time τ_c, which converts an impulse j to the paper's peak force j/τ_c. This force is reported, "
            "and with splitting.model michel it decides splits; otherwise the motion does not depend on it",
            &ContactSettings::contact_time),
     member("separation_time_s", "s", from(1e-3, 1e4),
            "time in which an overlap that is no longer pressed together decays", &ContactSettings::separation_time),
     member("iterations", "", from(1, 10000),
            "largest number of sweeps of the contact solver over touching bodies per step or substep",
            &ContactSettings::iterations)}};

const Description<FractureSettings> kBending{
    {choice<BendingModelKind>("model", "model of the load at which a cusp breaks off a wedge of ice",
                              {{"fsi-database", BendingModelKind::kFsiDatabase},
                               {"nevel", BendingModelKind::kNevel},
                               {"kashtelyan", BendingModelKind::kKashtelyan}},
                              &FractureSettings::bending),
     choice<RadialCracks>(
         "radial_cracks",
         "with model fsi-database: whether the crack that opens below a wide edge before its cusp breaks runs through, "
         "so that a wedge splits and sections have the strength of cracked ones, or is ignored",
         {{"split", RadialCracks::kSplitWedge}, {"ignored", RadialCracks::kIgnored}}, &FractureSettings::radial_cracks),
     choice<EdgeOutline>("outline",
                         "with model fsi-database and contact law crush: whether the edge breaks at the weakest "
                         "section of its true outline, or as the wedge that fits it over 0.3 l",
                         {{"sections", EdgeOutline::kSections}, {"wedge", EdgeOutline::kWedge}},
                         &FractureSettings::outline),
     choice<bool>("deflection",
                  "with contact law crush: whether ice that bends under a hull recedes from it, so that the hull "
                  "advances farther before a cusp breaks, or only crushes until then",
                  {{"followed", true}, {"ignored", false}}, &FractureSettings::follows_deflection),
     choice<bool>("decks",
                  "with contact law crush and cusp_fate under_hull: whether water floods the deck of a cusp that a "
                  "hull presses down through the gap that opens as the cusp turns, and the hull carries the weight of "
                  "the missing water, or the deck is wet at once",
                  {{"flood", true}, {"wet", false}}, &FractureSettings::floods_decks),
     member("strength_spread", "", from(0, 2),
            "scatter of the flexural strength between bending events, log-normal (standard deviation / strength of the "
            "floe). It is drawn from the place that the hull touched first and the seed; 0: no scatter",
            &FractureSettings::bending_scatter)}};

const Description<FractureSettings> kSplitting{
    {choice<SplittingModel>(
         "model",
         "what splits a floe: lefm, true forces of ships, structures and floes that open a crack, by linear elastic "
         "fracture mechanics; michel, the paper's j/τ_c compared with Eq. (4), F_s = n L h σ_t; none, no splits",
         {{"lefm", SplittingModel::kLefm}, {"michel", SplittingModel::kMichel}, {"none", SplittingModel::kNone}},
         &FractureSettings::splitting),
     member("shape_factor", "", above(0, 100), "shape factor n of Eq. (4)", &FractureSettings::splitting_shape_factor),
     member("least_piece_width_over_l", "", from(0, 1000),
            "a crack that leaves ice narrower than this on either side (area / length of the crack) does not run, "
            "because it would only cut off the floe's edge; in units of l = (D/ρ_w g)^¼",
            &FractureSettings::least_piece, &fracture::LeastPiece::width_over_l),
     member("least_piece_area_over_l2", "", from(0, 1e6), "the same limit for the area of the ice, in units of l²",
            &FractureSettings::least_piece, &fracture::LeastPiece::area_over_l2)}};

using fracture::TiltSettings;
const Description<GoingUnderSettings> kGoingUnder{
    {member("enabled", "", {}, "whether floes tilt and go under hulls; if not given, true if a ship has a draught",
            &GoingUnderSettings::is_enabled),
     member("added_mass_factor", "", from(0, 10),
            "factor c_a of the added mass of a tilting floe; 1: that of a disc in heave", &GoingUnderSettings::tilting,
            &TiltSettings::added_mass_factor),
     member("damping", "", from(0, 10), "damping ratio ζ of the tilting", &GoingUnderSettings::tilting,
            &TiltSettings::damping),
     member("edge_deflection_over_thickness", "", above(0, 10),
            "c_g: a floe goes under when its edge is pressed down by c_g times its thickness",
            &GoingUnderSettings::tilting, &TiltSettings::edge_deflection)}};

const Description<ResurfaceSettings> kResurface{
    {member("enabled", "", {}, "whether ice surfaces behind the hull; if not given, true if any goes under",
            &ResurfaceSettings::is_enabled),
     member("retry_s", "s", above(0, 1e4), "time between two attempts to surface if there is no room",
            &ResurfaceSettings::retry),
     member("give_up_s", "s", from(0, 1e6), "time without room after which a piece stays under the ice",
            &ResurfaceSettings::give_up),
     member("rim_loss", "", below(0, 1), "fraction of a piece's area that became brash, removed evenly from its rim",
            &ResurfaceSettings::rim_loss),
     member("scatter", "", from(0, 1),
            "scatter of the position of surfacing pieces as a fraction of √area, and of their angle as a fraction of a "
            "half turn (standard deviations); 0: no scatter",
            &ResurfaceSettings::scatter)}};

const Description<FractureSettings> kFracture{
    {choice<CharacteristicLength>(
         "characteristic_length",
         "reading of Eq. (7): (D/ρ_w g)^¼, which is a length, or as the paper prints it, (D/ρ_w g)^½, whose unit is m² "
         "(the paper's results need that number: docs/paper-comparison.md)",
         {{"fourth_root", CharacteristicLength::kFourthRoot}, {"as_printed", CharacteristicLength::kAsPrinted}},
         &FractureSettings::characteristic_length),
     member("breakable_size_factor", "", from(0, 1000),
            "κ: floes with √area < κ l are pushed away whole; unless κ l > l, slender ones break across",
            &FractureSettings::breakable_size_factor),
     object("bending", kBending, "settings of failure by bending"),
     object("splitting", kSplitting, "settings of failure by splitting"),
     choice<CuspFate>(
         "cusp_fate",
         "fate of a broken cusp: it goes under the hull and surfaces behind it (the default if a ship has a draught), "
         "it is removed (the paper), or it floats as a floe",
         {{"under_hull", CuspFate::kUnderHull}, {"submerge", CuspFate::kSubmerge}, {"float", CuspFate::kFloat}},
         &FractureSettings::cusp_fate),
     object("going_under", kGoingUnder, "settings of floes that a hull with a draught presses under",
            &FractureSettings::going_under),
     object("resurface", kResurface, "settings of ice that surfaces behind a hull", &FractureSettings::resurface),
     member("cusp_sagitta_m", "m", from(1e-4, 1), "largest distance between the circle of a cusp and its polygon",
            &FractureSettings::cusp_sagitta),
     member("smallest_floe_m2", "m²", from(kLeastFloeArea, 1e6),
            "pieces with less area are removed and counted as brash", &FractureSettings::smallest_floe_area)}};

const Description<RecordSettings> kRecord{
    {member("forces_interval_s", "s", above(0, 1e6), "time between rows of forces.csv",
            &RecordSettings::forces_interval),
     member("frames_interval_s", "s", above(0, 1e6), "time between frames of frames.bin",
            &RecordSettings::frames_interval),
     choice<RecordedContacts>(
         "contacts",
         "contacts that contacts.csv has at every frame: those with ships and structures, also those between floes, or "
         "none; with none it has no peaks either",
         {{"ships", RecordedContacts::kShips}, {"all", RecordedContacts::kAll}, {"none", RecordedContacts::kNone}},
         &RecordSettings::contacts),
     member("least_peak_N", "N", from(0, 1e12),
            "smallest peak of a contact's force that contacts.csv has; summary.json counts smaller ones",
            &RecordSettings::least_peak),
     member("peak_response_s", "s", from(0, 10),
            "time constant of the gauge that smooths a contact's force before its peaks are found; 0: no gauge, the "
            "force of each step",
            &RecordSettings::peak_response)}};

}  // namespace

const Description<Ice> kIceDescription{
    {member("thickness_m", "m", from(1e-3, 20), "thickness h of every floe that does not have its own",
            &Ice::thickness),
     member("density_kg_per_m3", "kg/m³", from(100, 1100), "density ρ_i, less than the water's", &Ice::density),
     member("youngs_modulus_Pa", "Pa", from(1e6, 1e12), "Young's modulus E", &Ice::youngs_modulus),
     member("poisson_ratio", "", below(0, 0.5), "Poisson's ratio ν (the paper gives none)", &Ice::poisson_ratio),
     member("flexural_strength_Pa", "Pa", from(1, 1e9), "flexural strength σ_f", &Ice::flexural_strength),
     member("compressive_strength_Pa", "Pa", from(1, 1e10), "compressive strength σ_c", &Ice::compressive_strength),
     member("tensile_strength_Pa", "Pa", from(1, 1e9), "tensile strength σ_t", &Ice::tensile_strength),
     member("fracture_toughness_Pa_sqrt_m", "Pa √m", from(1, 1e9), "fracture toughness K_IC, for splitting by lefm",
            &Ice::fracture_toughness),
     member("friction", "", from(0, 2), "friction coefficient μ, hull on ice and ice on ice", &Ice::friction)}};

const Description<SceneInput> kSceneDescription{
    {as(FieldKind::kName,
        member("name", "", {}, "name of the scene and of its run folder; if not given, the name of the scene file",
               &SceneInput::name)),
     member("description", "", {}, "description for people", &SceneInput::description),
     member("seed", "", from(0, kLargestSeed),
            "seed of all random draws: floe fields, ice properties, places at which ice surfaces", &SceneInput::scene,
            &Scene::seed),
     object("origin", kOrigin,
            "place of the scene on the Earth; floe files in degrees, or in a system that they name, are projected "
            "about it, and `polynya export --geojson` converts back",
            &SceneInput::scene, &Scene::origin),
     object("time", kTime, "", &SceneInput::scene, &Scene::time),
     object("water", kWater, "", &SceneInput::scene, &Scene::water),
     object("wind", kWind, "", &SceneInput::scene, &Scene::wind),
     object("ice", kIceDescription, "", &SceneInput::scene, &Scene::ice),
     object("contact", kContact, "", &SceneInput::scene, &Scene::contact),
     object("fracture", kFracture, "", &SceneInput::scene, &Scene::fracture),
     object("record", kRecord, "", &SceneInput::scene, &Scene::record),
     list_of<SceneInput>("ships", 100, "the ships", kShipDescription),
     list_of<SceneInput>("structures", 100, "structures in the ice, which do not move", kStructureDescription),
     list_of<SceneInput>("walls", 100, "straight boundaries, which ice cannot pass and which may press on it",
                         kWallDescription),
     list_of<SceneInput>("floes", kLargestCount, "the ice, in groups", kFloesDescription)}};

}  // namespace polynya::io
