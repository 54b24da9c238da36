#include "io/scene/scene_field_parts.hpp"
#include "simulation/limits.hpp"

namespace polynya::io {
namespace {

using fracture::CharacteristicLength;
using fracture::SplittingModel;
using simulation::BendingModelKind;
using simulation::ContactNormal;
using simulation::CuspFate;
using simulation::RecordedContacts;
using Draft = SceneDraft;
using Value = JsonValue;
using Kind = FieldKind;

simulation::GeographicOrigin& origin(Draft& d) {
  if (!d.scene.origin) d.scene.origin.emplace();
  return *d.scene.origin;
}

const Object kOrigin{{field("latitude_deg", Kind::kNumber, "°", from(-90, 90), "",
                            "of the scene's origin, WGS 84, north positive",
                            [](Draft& d, const Value& v) { origin(d).latitude = radians(v); }),
                      field("longitude_deg", Kind::kNumber, "°", from(-180, 180), "", "east positive",
                            [](Draft& d, const Value& v) { origin(d).longitude = radians(v); }),
                      field("heading_deg", Kind::kNumber, "°", from(-360, 360), "90",
                            "of the scene's x axis from true north, clockwise; 90: x is east, y north",
                            [](Draft& d, const Value& v) { origin(d).heading = radians(v); })}};

const Object kTime{{field("step_s", Kind::kNumber, "s", from(1e-5, 1), "0.005", "time step Δt",
                          [](Draft& d, const Value& v) { d.scene.time.step = v.number(); }),
                    field("until_s", Kind::kNumber, "s", above(0, 1e7), "550", "simulated time to run to",
                          [](Draft& d, const Value& v) { d.scene.time.until = v.number(); })}};

const Object kIce{
    {field("thickness_m", Kind::kNumber, "m", from(1e-3, 20), "0.5",
           "thickness h, of every floe without one of its own",
           [](Draft& d, const Value& v) { d.scene.ice.thickness = v.number(); }),
     field("density_kg_per_m3", Kind::kNumber, "kg/m³", from(100, 1100), "900",
           "density ρ_i, less than the water's",
           [](Draft& d, const Value& v) { d.scene.ice.density = v.number(); }),
     field("youngs_modulus_Pa", Kind::kNumber, "Pa", from(1e6, 1e12), "5.4e9", "Young's modulus E",
           [](Draft& d, const Value& v) { d.scene.ice.youngs_modulus = v.number(); }),
     field("poisson_ratio", Kind::kNumber, "", below(0, 0.5), "0.3",
           "Poisson's ratio ν (the paper gives none)",
           [](Draft& d, const Value& v) { d.scene.ice.poisson_ratio = v.number(); }),
     field("flexural_strength_Pa", Kind::kNumber, "Pa", from(1, 1e9), "0.8e6", "flexural strength σ_f",
           [](Draft& d, const Value& v) { d.scene.ice.flexural_strength = v.number(); }),
     field("compressive_strength_Pa", Kind::kNumber, "Pa", from(1, 1e10), "2.8e6", "compressive strength σ_c",
           [](Draft& d, const Value& v) { d.scene.ice.compressive_strength = v.number(); }),
     field("tensile_strength_Pa", Kind::kNumber, "Pa", from(1, 1e9), "0.8e6", "tensile strength σ_t",
           [](Draft& d, const Value& v) { d.scene.ice.tensile_strength = v.number(); }),
     field("fracture_toughness_Pa_sqrt_m", Kind::kNumber, "Pa √m", from(1, 1e9), "150e3",
           "fracture toughness K_IC, for splitting by lefm",
           [](Draft& d, const Value& v) { d.scene.ice.fracture_toughness = v.number(); }),
     field("friction", Kind::kNumber, "", from(0, 2), "0.2",
           "friction coefficient μ, hull on ice and ice on ice",
           [](Draft& d, const Value& v) { d.scene.ice.friction = v.number(); })}};

const Object kContact{
    {field("circle_radius_m", Kind::kNumber, "m", from(0.01, 100), "1", "radius of the contact circles",
           [](Draft& d, const Value& v) { d.scene.contact.circle_radius = v.number(); }),
     field(
         "normal", Kind::kChoice, "", {}, "\"boundary\"",
         "how a contact's normal is found: from the boundary pieces the touching circles stand for, or along "
         "the line "
         "between the circles' centres (the paper's rule)",
         [](Draft& d, const Value& v) {
           d.scene.contact.normal =
               v.text() == "boundary" ? ContactNormal::kBoundary : ContactNormal::kCircleCentres;
         },
         {"boundary", "circle-centres"}),
     field("law", Kind::kChoice, "", {}, "\"crush\"",
           "how bodies push each other apart: what crushing ice carries, or the paper's rigid impulses, Eq. "
           "(5)",
           [](Draft& d, const Value& v) {
             d.scene.contact.law =
                 v.text() == "crush" ? simulation::ContactLaw::kCrush : simulation::ContactLaw::kImpulse;
           },
           {"crush", "impulse"}),
     field("substeps", Kind::kInteger, "", from(1, 64), "1",
           "of law crush: parts of a step, solved one after the other",
           [](Draft& d, const Value& v) { d.scene.contact.substeps = static_cast<int>(v.number()); }),
     field("tolerance_m_per_s", Kind::kNumber, "m/s", from(1e-9, 0.1), "1e-4",
           "of law crush: largest violation of the law that is left",
           [](Draft& d, const Value& v) { d.scene.contact.tolerance = v.number(); }),
     field("start", Kind::kChoice, "", {}, "\"last-step\"",
           "of law crush: the impulses that the solver starts from, those of the step before or none; the "
           "solution does not depend on it",
           [](Draft& d, const Value& v) { d.scene.contact.is_warm_started = v.text() == "last-step"; },
           {"last-step", "zero"}),
     field("restitution", Kind::kNumber, "", from(0, 1), "0.1", "ε of Eq. (5)",
           [](Draft& d, const Value& v) { d.scene.contact.restitution = v.number(); }),
     field("contact_time_s", Kind::kNumber, "s", from(1e-4, 100), "0.5",
           "τ_c, which turns an impulse j into the paper's peak force j/τ_c (by "
           "splitting.model michel it decides splits, and it is reported; the motion does not depend on it "
           "otherwise)",
           [](Draft& d, const Value& v) { d.scene.contact.contact_time = v.number(); }),
     field("separation_time_s", Kind::kNumber, "s", from(1e-3, 1e4), "1",
           "time over which overlap that nothing presses together any more decays",
           [](Draft& d, const Value& v) { d.scene.contact.separation_time = v.number(); }),
     field("iterations", Kind::kInteger, "", from(1, 10000), "100",
           "most sweeps of the contact solver over bodies in touch, in a step or substep",
           [](Draft& d, const Value& v) { d.scene.contact.iterations = static_cast<int>(v.number()); })}};

const Object kBending{
    {field("model", Kind::kChoice, "", {}, "\"fsi-database\"",
           "what a wedge of ice bears before its cusp breaks off",
           [](Draft& d, const Value& v) {
             d.scene.fracture.bending = v.text() == "nevel"        ? BendingModelKind::kNevel
                                        : v.text() == "kashtelyan" ? BendingModelKind::kKashtelyan
                                                                   : BendingModelKind::kFsiDatabase;
           },
           {"fsi-database", "nevel", "kashtelyan"}),
     field("radial_cracks", Kind::kChoice, "", {}, "\"split\"",
           "of model fsi-database: whether the crack that opens below a wide wedge before its cusp breaks "
           "splits the wedge, or is ignored",
           [](Draft& d, const Value& v) {
             d.scene.fracture.radial_cracks =
                 v.text() == "split" ? fracture::RadialCracks::kSplitWedge : fracture::RadialCracks::kIgnored;
           },
           {"split", "ignored"}),
     field("deflection", Kind::kChoice, "", {}, "\"followed\"",
           "of contact law crush: whether ice that bends under a hull recedes from it, so "
           "that the hull comes farther before a cusp breaks, or only crushes until then",
           [](Draft& d, const Value& v) { d.scene.fracture.follows_deflection = v.text() == "followed"; },
           {"followed", "ignored"}),
     field("strength_spread", Kind::kNumber, "", from(0, 2), "0",
           "each bending event's flexural strength scatters by this (standard deviation / the floe's own, "
           "log-normal), by the place that the hull first touched and the seed; 0: not",
           [](Draft& d, const Value& v) { d.scene.fracture.bending_scatter = v.number(); })}};

const Object kSplitting{
    {field("model", Kind::kChoice, "", {}, "\"lefm\"",
           "what splits a floe: lefm, the true forces of ships, structures and floes that open a crack, by "
           "linear "
           "elastic fracture mechanics; michel, the paper's j/τ_c against Eq. (4), F_s = n L h σ_t; none, "
           "nothing",
           [](Draft& d, const Value& v) {
             d.scene.fracture.splitting = v.text() == "michel" ? SplittingModel::kMichel
                                          : v.text() == "none" ? SplittingModel::kNone
                                                               : SplittingModel::kLefm;
           },
           {"lefm", "michel", "none"}),
     field("shape_factor", Kind::kNumber, "", above(0, 100), "0.25", "n of Eq. (4)",
           [](Draft& d, const Value& v) { d.scene.fracture.splitting_shape_factor = v.number(); }),
     field(
         "least_piece_width_over_l", Kind::kNumber, "", from(0, 1000), "0.5",
         "a crack that leaves ice narrower than this on either side (area over the crack's length) does not "
         "run: it would pare the floe's edge; l = (D/ρ_w g)^¼",
         [](Draft& d, const Value& v) { d.scene.fracture.least_piece.width_over_l = v.number(); }),
     field("least_piece_area_over_l2", Kind::kNumber, "", from(0, 1e6), "0.5", "the same of its area, by l²",
           [](Draft& d, const Value& v) { d.scene.fracture.least_piece.area_over_l2 = v.number(); })}};

const Object kGoingUnder{
    {field("enabled", Kind::kBoolean, "", {}, "false",
           "whether floes tilt and go under; if not given, where a ship has a draught",
           [](Draft& d, const Value& v) { d.scene.fracture.going_under.is_enabled = v.boolean(); }),
     field("added_mass_factor", Kind::kNumber, "", from(0, 10), "1",
           "c_a, of the water's mass that tilts with a floe; 1: a disc's in heave",
           [](Draft& d, const Value& v) {
             d.scene.fracture.going_under.tilting.added_mass_factor = v.number();
           }),
     field("damping", Kind::kNumber, "", from(0, 10), "0.3", "ζ, of the tilting",
           [](Draft& d, const Value& v) { d.scene.fracture.going_under.tilting.damping = v.number(); }),
     field("edge_deflection_over_thickness", Kind::kNumber, "", above(0, 10), "0.9",
           "c_g: a floe goes under when its edge is pressed down by this times its thickness",
           [](Draft& d, const Value& v) {
             d.scene.fracture.going_under.tilting.edge_deflection = v.number();
           })}};

const Object kResurface{
    {field("enabled", Kind::kBoolean, "", {}, "false",
           "whether ice comes up behind the hull; if not given, where any goes under",
           [](Draft& d, const Value& v) { d.scene.fracture.resurface.is_enabled = v.boolean(); }),
     field("retry_s", Kind::kNumber, "s", above(0, 1e4), "1", "time between two tries where there is no room",
           [](Draft& d, const Value& v) { d.scene.fracture.resurface.retry = v.number(); }),
     field("give_up_s", Kind::kNumber, "s", from(0, 1e6), "120",
           "time without room after which a piece stays under the ice",
           [](Draft& d, const Value& v) { d.scene.fracture.resurface.give_up = v.number(); }),
     field("rim_loss", Kind::kNumber, "", below(0, 1), "0.05",
           "share of a piece's area that became brash, evenly off its rim",
           [](Draft& d, const Value& v) { d.scene.fracture.resurface.rim_loss = v.number(); }),
     field("scatter", Kind::kNumber, "", from(0, 1), "0.2",
           "by how much pieces come up beside their place, of √area, and turned, of a half turn (standard "
           "deviations); 0: in place",
           [](Draft& d, const Value& v) { d.scene.fracture.resurface.scatter = v.number(); })}};

const Object kFracture{
    {field("characteristic_length", Kind::kChoice, "", {}, "\"fourth_root\"",
           "how Eq. (7) is read: (D/ρ_w g)^¼, a length, or as the paper prints it, (D/ρ_w g)^½, whose unit "
           "is m² "
           "(the "
           "paper's story needs that number: docs/paper-comparison.md)",
           [](Draft& d, const Value& v) {
             d.scene.fracture.characteristic_length = v.text() == "fourth_root"
                                                          ? CharacteristicLength::kFourthRoot
                                                          : CharacteristicLength::kAsPrinted;
           },
           {"fourth_root", "as_printed"}),
     field("breakable_size_factor", Kind::kNumber, "", from(0, 1000), "1",
           "κ: floes with √area < κ l are pushed away, never broken",
           [](Draft& d, const Value& v) { d.scene.fracture.breakable_size_factor = v.number(); }),
     field("bending", Kind::kObject, "", {}, "{}", "failure by bending", nullptr, {}, "", &kBending),
     field("splitting", Kind::kObject, "", {}, "{}", "failure by splitting", nullptr, {}, "", &kSplitting),
     field("cusp_fate", Kind::kChoice, "", {}, "\"submerge\"",
           "what becomes of a broken cusp: it goes under the hull and comes up behind it (if not given, "
           "where a "
           "ship has a draught), it is gone (the paper), or it floats as a floe",
           [](Draft& d, const Value& v) {
             d.scene.fracture.cusp_fate = v.text() == "under_hull" ? CuspFate::kUnderHull
                                          : v.text() == "submerge" ? CuspFate::kSubmerge
                                                                   : CuspFate::kFloat;
           },
           {"under_hull", "submerge", "float"}),
     field("going_under", Kind::kObject, "", {}, "{}", "floes that a hull with a draught presses under",
           nullptr, {}, "", &kGoingUnder),
     field("resurface", Kind::kObject, "", {}, "{}", "ice that comes up behind a hull", nullptr, {}, "",
           &kResurface),
     field("cusp_sagitta_m", Kind::kNumber, "m", from(1e-4, 1), "0.02",
           "a cusp's polygon stays this close to its circle",
           [](Draft& d, const Value& v) { d.scene.fracture.cusp_sagitta = v.number(); }),
     field("smallest_floe_m2", Kind::kNumber, "m²", from(simulation::kLeastFloeArea, 1e6), "0.1",
           "smaller pieces leave the floe list and are counted as brash",
           [](Draft& d, const Value& v) { d.scene.fracture.smallest_floe_area = v.number(); })}};

const Object kRecord{
    {field("forces_interval_s", Kind::kNumber, "s", above(0, 1e6), "0.1", "between rows of forces.csv",
           [](Draft& d, const Value& v) { d.scene.record.forces_interval = v.number(); }),
     field("frames_interval_s", Kind::kNumber, "s", above(0, 1e6), "2", "between frames of frames.bin",
           [](Draft& d, const Value& v) { d.scene.record.frames_interval = v.number(); }),
     field("contacts", Kind::kChoice, "", {}, "\"ships\"",
           "which contacts contacts.csv has at every frame: those with ships and structures, those between "
           "floes "
           "too, none",
           [](Draft& d, const Value& v) {
             d.scene.record.contacts = v.text() == "ships" ? RecordedContacts::kShips
                                       : v.text() == "all" ? RecordedContacts::kAll
                                                           : RecordedContacts::kNone;
           },
           {"ships", "all", "none"})}};

}  // namespace

const Object& origin_object() {
  return kOrigin;
}
const Object& time_object() {
  return kTime;
}
const Object& ice_object() {
  return kIce;
}
const Object& contact_object() {
  return kContact;
}
const Object& fracture_object() {
  return kFracture;
}
const Object& record_object() {
  return kRecord;
}

}  // namespace polynya::io
