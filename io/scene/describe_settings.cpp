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
    {required(member("latitude_deg", "°", from(-90, 90), "of the scene's origin, WGS 84, north positive",
                     &GeographicOrigin::latitude)),
     required(member("longitude_deg", "°", from(-180, 180), "east positive", &GeographicOrigin::longitude)),
     member("heading_deg", "°", from(-360, 360),
            "of the scene's x axis from true north, clockwise; 90: x is east, y north", &GeographicOrigin::heading)}};

const Description<StepSettings> kTime{
    {chosen(member("step_s", "s", from(1e-5, 1),
                   "the tick: the longest time step Δt; if not given, 0.0005 to 0.1 s by speeds and thickness. By law "
                   "crush a tick is taken in up to 32 equal parts where ice breaks fast (docs/theory/steps.md)",
                   &StepSettings::step)),
     member("until_s", "s", above(0, 1e7), "simulated time to run to, rounded up to a whole tick",
            &StepSettings::until)}};

const Description<ShearSettings> kShear{
    {member("rate_per_s", "1/s", from(-1, 1),
            "how much faster the current runs along its direction, per metre to port of the origin",
            &ShearSettings::rate),
     member("direction_deg", "°", from(-360, 360), "of the current, from the x axis, counter-clockwise",
            &ShearSettings::direction),
     member("origin_m", "m", coordinate(),
            "a point where the water has the drift alone, at the start; it is carried along by the drift",
            &ShearSettings::origin)}};

const Description<dynamics::FlowRow> kFlowRow{
    {required(member("t_s", "s", from(-1e7, 1e7), "when; ascending", &dynamics::FlowRow::time)),
     required(member("speed_m_per_s", "m/s", from(0, 100), "", &dynamics::FlowRow::speed)),
     required(member("direction_deg", "°", from(-360, 360), "where it goes to, from the x axis, counter-clockwise",
                     &dynamics::FlowRow::direction))}};

const Description<dynamics::Tide> kTide{
    {member("period_s", "s", from(60, 1e7), "of the ellipse; that of the tide M2 if not given",
            &dynamics::Tide::period),
     required(member("major_m_per_s", "m/s", from(0, 10), "along the ellipse's axis", &dynamics::Tide::major)),
     member("minor_m_per_s", "m/s", from(-10, 10), "across it; negative: it turns clockwise", &dynamics::Tide::minor),
     member("direction_deg", "°", from(-360, 360), "of the axis, from the x axis, counter-clockwise",
            &dynamics::Tide::direction),
     member("phase_deg", "°", from(-360, 360), "at t = 0; 0: the velocity is along the axis", &dynamics::Tide::phase)}};

const Description<WaterSettings> kWater{
    {member("density_kg_per_m3", "kg/m³", from(500, 2000), "density ρ_w", &WaterSettings::water,
            &fracture::Water::density),
     member("drag_coefficient", "", from(0, 100), "C_D of Eq. (6)", &WaterSettings::drag_coefficient),
     choice<dynamics::DragArea>(
         "drag_area",
         "A of Eq. (6): thickness times the floe's width across its motion, or its area in plan (the reading "
         "under which the paper's voyages come out: docs/paper-comparison.md)",
         {{"edge", dynamics::DragArea::kEdge}, {"plan", dynamics::DragArea::kPlan}}, &WaterSettings::drag_area),
     member("skin_drag_coefficient", "", from(0, 1),
            "C_w, of a floe's area in plan, beside Eq. (6); if not given, 0.004 where a wind blows",
            &WaterSettings::skin_drag_coefficient),
     member("drift_m_per_s", "m/s", from(-10, 10), "velocity of the water, and of all ice with it",
            &WaterSettings::drift),
     list("drift_table", from(0, 1000),
          "the drift over time, in place of drift_m_per_s: as a vector linear between rows", kFlowRow,
          &WaterSettings::drift_rows),
     object("tide", kTide, "a tidal ellipse, on top of the drift", &WaterSettings::tide),
     object("shear", kShear, "a current that changes linearly across its direction, on top of the drift",
            &WaterSettings::shear)}};

const Description<dynamics::Wind> kWind{
    {member("velocity_m_per_s", "m/s", from(-100, 100),
            "U_10: where it blows to, 10 m above the ice, over ground; it pushes every floe that is not fast "
            "by ½ ρ_a C_a |U_10| U_10 on its area in plan",
            &dynamics::Wind::velocity),
     list("table", from(0, 1000), "the wind over time, in place of velocity_m_per_s; as water.drift_table", kFlowRow,
          &dynamics::Wind::rows),
     member("drag_coefficient", "", from(0, 1), "C_a", &dynamics::Wind::drag_coefficient),
     member("air_density_kg_per_m3", "kg/m³", from(0, 10), "ρ_a", &dynamics::Wind::density)}};

const Description<ContactSettings> kContact{
    {member("circle_radius_m", "m", from(0.01, 100), "radius of the contact circles", &ContactSettings::circle_radius),
     choice<ContactNormal>(
         "normal",
         "how a contact's normal is found: from the boundary pieces the touching circles stand for, or along "
         "the line between the circles' centres (the paper's rule)",
         {{"boundary", ContactNormal::kBoundary}, {"circle-centres", ContactNormal::kCircleCentres}},
         &ContactSettings::normal),
     choice<ContactLaw>("law",
                        "how bodies push each other apart: what crushing ice carries, or the paper's rigid "
                        "impulses, Eq. (5)",
                        {{"crush", ContactLaw::kCrush}, {"impulse", ContactLaw::kImpulse}}, &ContactSettings::law),
     member("substeps", "", from(1, 64), "of law crush: parts of a step, solved one after the other",
            &ContactSettings::substeps),
     member("tolerance_m_per_s", "m/s", from(1e-9, 0.1), "of law crush: largest violation of the law that is left",
            &ContactSettings::tolerance),
     choice<bool>("start",
                  "of law crush: the impulses that the solver starts from, those of the step before or none; "
                  "the solution does not depend on it",
                  {{"last-step", true}, {"zero", false}}, &ContactSettings::is_warm_started),
     member("restitution", "", from(0, 1), "ε of Eq. (5)", &ContactSettings::restitution),
     member("contact_time_s", "s", from(1e-4, 100),
            "τ_c, which turns an impulse j into the paper's peak force j/τ_c (by "
            "splitting.model michel it decides splits, and it is reported; the motion does not depend on it "
            "otherwise)",
            &ContactSettings::contact_time),
     member("separation_time_s", "s", from(1e-3, 1e4),
            "time over which overlap that nothing presses together any more decays", &ContactSettings::separation_time),
     member("iterations", "", from(1, 10000),
            "most sweeps of the contact solver over bodies in touch, in a step or substep",
            &ContactSettings::iterations)}};

const Description<FractureSettings> kBending{
    {choice<BendingModelKind>("model", "what a wedge of ice bears before its cusp breaks off",
                              {{"fsi-database", BendingModelKind::kFsiDatabase},
                               {"nevel", BendingModelKind::kNevel},
                               {"kashtelyan", BendingModelKind::kKashtelyan}},
                              &FractureSettings::bending),
     choice<RadialCracks>(
         "radial_cracks",
         "of model fsi-database: whether the crack that opens below a wide edge before its cusp breaks runs "
         "through, so that a wedge splits and sections hold as cracked ones, or is ignored",
         {{"split", RadialCracks::kSplitWedge}, {"ignored", RadialCracks::kIgnored}}, &FractureSettings::radial_cracks),
     choice<EdgeOutline>(
         "outline",
         "of model fsi-database and contact law crush: whether the edge breaks at the weakest section of its true "
         "outline, or as the wedge that it makes over 0.3 l",
         {{"sections", EdgeOutline::kSections}, {"wedge", EdgeOutline::kWedge}}, &FractureSettings::outline),
     choice<bool>("deflection",
                  "of contact law crush: whether ice that bends under a hull recedes from it, so "
                  "that the hull comes farther before a cusp breaks, or only crushes until then",
                  {{"followed", true}, {"ignored", false}}, &FractureSettings::follows_deflection),
     choice<bool>(
         "decks",
         "of contact law crush and cusp_fate under_hull: whether water reaches the deck of a cusp that a hull "
         "presses down through what opens as it turns, and the hull bears what is missing, or is there at once",
         {{"flood", true}, {"wet", false}}, &FractureSettings::floods_decks),
     member("strength_spread", "", from(0, 2),
            "each bending event's flexural strength scatters by this (standard deviation / the floe's own, "
            "log-normal), by the place that the hull first touched and the seed; 0: not",
            &FractureSettings::bending_scatter)}};

const Description<FractureSettings> kSplitting{
    {choice<SplittingModel>(
         "model",
         "what splits a floe: lefm, the true forces of ships, structures and floes that open a crack, by "
         "linear elastic fracture mechanics; michel, the paper's j/τ_c against Eq. (4), F_s = n L h σ_t; "
         "none, nothing",
         {{"lefm", SplittingModel::kLefm}, {"michel", SplittingModel::kMichel}, {"none", SplittingModel::kNone}},
         &FractureSettings::splitting),
     member("shape_factor", "", above(0, 100), "n of Eq. (4)", &FractureSettings::splitting_shape_factor),
     member("least_piece_width_over_l", "", from(0, 1000),
            "a crack that leaves ice narrower than this on either side (area over the crack's length) does "
            "not run: it would pare the floe's edge; l = (D/ρ_w g)^¼",
            &FractureSettings::least_piece, &fracture::LeastPiece::width_over_l),
     member("least_piece_area_over_l2", "", from(0, 1e6), "the same of its area, by l²", &FractureSettings::least_piece,
            &fracture::LeastPiece::area_over_l2)}};

using fracture::TiltSettings;
const Description<GoingUnderSettings> kGoingUnder{
    {member("enabled", "", {}, "whether floes tilt and go under; if not given, where a ship has a draught",
            &GoingUnderSettings::is_enabled),
     member("added_mass_factor", "", from(0, 10),
            "c_a, of the water's mass that tilts with a floe; 1: a disc's in heave", &GoingUnderSettings::tilting,
            &TiltSettings::added_mass_factor),
     member("damping", "", from(0, 10), "ζ, of the tilting", &GoingUnderSettings::tilting, &TiltSettings::damping),
     member("edge_deflection_over_thickness", "", above(0, 10),
            "c_g: a floe goes under when its edge is pressed down by this times its thickness",
            &GoingUnderSettings::tilting, &TiltSettings::edge_deflection)}};

const Description<ResurfaceSettings> kResurface{
    {member("enabled", "", {}, "whether ice comes up behind the hull; if not given, where any goes under",
            &ResurfaceSettings::is_enabled),
     member("retry_s", "s", above(0, 1e4), "time between two tries where there is no room", &ResurfaceSettings::retry),
     member("give_up_s", "s", from(0, 1e6), "time without room after which a piece stays under the ice",
            &ResurfaceSettings::give_up),
     member("rim_loss", "", below(0, 1), "share of a piece's area that became brash, evenly off its rim",
            &ResurfaceSettings::rim_loss),
     member("scatter", "", from(0, 1),
            "by how much pieces come up beside their place, of √area, and turned, of a half turn (standard "
            "deviations); 0: in place",
            &ResurfaceSettings::scatter)}};

const Description<FractureSettings> kFracture{
    {choice<CharacteristicLength>(
         "characteristic_length",
         "how Eq. (7) is read: (D/ρ_w g)^¼, a length, or as the paper prints it, (D/ρ_w g)^½, whose unit "
         "is m² (the paper's story needs that number: docs/paper-comparison.md)",
         {{"fourth_root", CharacteristicLength::kFourthRoot}, {"as_printed", CharacteristicLength::kAsPrinted}},
         &FractureSettings::characteristic_length),
     member("breakable_size_factor", "", from(0, 1000),
            "κ: floes with √area < κ l are pushed away; unless κ l > l, slender ones break across",
            &FractureSettings::breakable_size_factor),
     object("bending", kBending, "failure by bending"), object("splitting", kSplitting, "failure by splitting"),
     choice<CuspFate>(
         "cusp_fate",
         "what becomes of a broken cusp: it goes under the hull and comes up behind it (if not given, where "
         "a ship has a draught), it is gone (the paper), or it floats as a floe",
         {{"under_hull", CuspFate::kUnderHull}, {"submerge", CuspFate::kSubmerge}, {"float", CuspFate::kFloat}},
         &FractureSettings::cusp_fate),
     object("going_under", kGoingUnder, "floes that a hull with a draught presses under",
            &FractureSettings::going_under),
     object("resurface", kResurface, "ice that comes up behind a hull", &FractureSettings::resurface),
     member("cusp_sagitta_m", "m", from(1e-4, 1), "a cusp's polygon stays this close to its circle",
            &FractureSettings::cusp_sagitta),
     member("smallest_floe_m2", "m²", from(kLeastFloeArea, 1e6),
            "smaller pieces leave the floe list and are counted as brash", &FractureSettings::smallest_floe_area)}};

const Description<RecordSettings> kRecord{
    {member("forces_interval_s", "s", above(0, 1e6), "between rows of forces.csv", &RecordSettings::forces_interval),
     member("frames_interval_s", "s", above(0, 1e6), "between frames of frames.bin", &RecordSettings::frames_interval),
     choice<RecordedContacts>(
         "contacts",
         "which contacts contacts.csv has at every frame: those with ships and structures, those between "
         "floes too, none; with none no peaks either",
         {{"ships", RecordedContacts::kShips}, {"all", RecordedContacts::kAll}, {"none", RecordedContacts::kNone}},
         &RecordSettings::contacts),
     member("least_peak_N", "N", from(0, 1e12),
            "contacts.csv has a peak of a contact's force from this one on; summary.json counts those below it",
            &RecordSettings::least_peak),
     member("peak_response_s", "s", from(0, 10),
            "time constant of the gauge through which a contact's force is followed for its peaks; 0: each step's own",
            &RecordSettings::peak_response)}};

}  // namespace

const Description<Ice> kIceDescription{
    {member("thickness_m", "m", from(1e-3, 20), "thickness h, of every floe without one of its own", &Ice::thickness),
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
        member("name", "", {}, "names the run folder; if left out, the scene file's name", &SceneInput::name)),
     member("description", "", {}, "for people", &SceneInput::description),
     member("seed", "", from(0, kLargestSeed),
            "of whatever is random: floe fields, ice that scatters, where ice comes up", &SceneInput::scene,
            &Scene::seed),
     object("origin", kOrigin,
            "where the scene lies on the Earth: floe files in degrees, or of a system that they name, are "
            "projected about it, and `polynya export --geojson` goes back",
            &SceneInput::scene, &Scene::origin),
     object("time", kTime, "", &SceneInput::scene, &Scene::time),
     object("water", kWater, "", &SceneInput::scene, &Scene::water),
     object("wind", kWind, "", &SceneInput::scene, &Scene::wind),
     object("ice", kIceDescription, "", &SceneInput::scene, &Scene::ice),
     object("contact", kContact, "", &SceneInput::scene, &Scene::contact),
     object("fracture", kFracture, "", &SceneInput::scene, &Scene::fracture),
     object("record", kRecord, "", &SceneInput::scene, &Scene::record),
     list_of<SceneInput>("ships", 100, "the ships", kShipDescription),
     list_of<SceneInput>("structures", 100, "what stands in the ice and does not move", kStructureDescription),
     list_of<SceneInput>("walls", 100, "straight boundaries that ice cannot pass, and that may press on it",
                         kWallDescription),
     list_of<SceneInput>("floes", kLargestCount, "the ice, in groups", kFloesDescription)}};

}  // namespace polynya::io
