#include "simulation/ice/beams.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>

#include "fracture/beam.hpp"
#include "simulation/ice/crack.hpp"
#include "simulation/ship/hull_contact_load.hpp"
#include "simulation/ship/pressing.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;
using geometry::Point;
using geometry::Vector;

/// Number of intervals between the sections at equal distances along a beam. Sections at the loads are added. The
/// bending moment has its peaks at a load or where the shear force is 0; there it changes slowly, so few sections are
/// enough. More sections cost time.
constexpr int kSections = 24;

/// Lower bound of the largest stress at the equally spaced sections, as a fraction of the largest stress at any section
/// [-]. If even this fraction of the flexural strength is not reached there, the sections at the loads are not
/// examined. Larger values would miss breaks at loads.
constexpr double kShareBetween = 0.5;

/// A contact that presses a beam.
struct OnBeam {
  BodyIndex floe = 0;
  std::size_t contact = 0;
  double down = 0;  ///< force with which a hull presses the floe down [N]
};

/// Returns true if a body is a free slender floe that is too small to bend or split and may break as a beam.
bool may_break(const Setup& setup, const Population& population, BodyIndex body) {
  const dynamics::Bodies& bodies = population.bodies;
  if (population.is_hull(body) || bodies.inverse_mass[body] == 0) return false;
  if (!fracture::is_beam(bodies.area[body], bodies.moment[body] / bodies.mass[body])) return false;
  const IceLimits& limits = limits_of_body(setup, population, body);
  return limits.breaks_beams && floe_size(population, body) < limits.breakable_size;
}

/// Returns the contacts that press slender floes, ordered by floe, then by contact.
std::vector<OnBeam> contacts_of_beams(const Setup& setup, const Step& step, const Population& population,
                                      const StepData& data) {
  std::vector<OnBeam> found;
  for (std::size_t i = 0; i < data.contacts.size(); ++i) {
    const Contact& c = data.contacts[i];
    const double force = normal_force_of(c, step.length);
    if (!(force > 0)) continue;
    const double down = i < data.slopes.size() ? std::max(0.0, data.slopes[i].vertical_share) * force : 0;
    for (const BodyIndex body : {c.a, c.b})
      if (may_break(setup, population, body)) found.push_back({body, i, down});
  }
  std::ranges::stable_sort(found, {}, &OnBeam::floe);
  return found;
}

/// Returns the section at x along a beam. Returns nullopt if the beam is too narrow there, not in one piece, or would
/// lose a piece that is too small to be a floe.
std::optional<BeamPart> part_at(const Setup& setup, const Population& population, BodyIndex floe, const BeamShape& beam,
                                double x) {
  const dynamics::Bodies& bodies = population.bodies;
  const double outside = 2 * bodies.bounding_radius[floe];
  const Vector along = rotate_back(beam.frame_from_body.rotation, {0, 1});
  const Point from = inverse_transform(beam.frame_from_body, {x, -outside});
  const auto crossings = crossings_of_line(*bodies.boundary[floe], from, along);
  if (crossings.size() != 2) return std::nullopt;
  const auto [near, first_edge] = crossings[0];
  const auto [far, last_edge] = crossings[1];
  const double width = far - near;
  if (width < fracture::kLeastSection * beam.moments.area / outside) return std::nullopt;
  BeamPart part;
  part.section = {x, 0.5 * (near + far) - outside, width};
  part.before =
      fracture::moments_up_to(population.floes[population.floe_of(floe)].shape.polygon, beam.frame_from_body, x);
  const double least = setup.scene.fracture.smallest_floe_area;
  if (std::min(part.before.area, beam.moments.area - part.before.area) < least) return std::nullopt;
  part.path = {
      from + (near - kCrackMargin) * along, from + (far + kCrackMargin) * along, width, first_edge, last_edge, 1};
  return part;
}

/// Returns a floe as a beam.
BeamShape shape_of(const Setup& setup, const Population& population, BodyIndex floe) {
  const dynamics::Bodies& bodies = population.bodies;
  const geometry::Polygon& polygon = population.floes[population.floe_of(floe)].shape.polygon;
  BeamShape beam;
  const Vector to_centre = Point{} - bodies.centroid[floe];
  const double axis = fracture::long_axis(fracture::moments_of(polygon, {Point{} + to_centre, {}}));
  const geometry::Rotation turn = geometry::Rotation::by(-axis);
  beam.frame_from_body = {Point{} + rotate(turn, to_centre), turn};
  beam.moments = fracture::moments_of(polygon, beam.frame_from_body);
  beam.length = std::sqrt(12 * beam.moments.xx / beam.moments.area);
  beam.elastic_share =
      fracture::elastic_share(ice_of_body(setup, population, floe), setup.scene.water.water, beam.length);
  const double reach = bodies.bounding_radius[floe];
  beam.least_width = reach;
  for (int k = 1; k < kSections; ++k) {
    const auto part = part_at(setup, population, floe, beam, reach * (2.0 * k / kSections - 1));
    if (!part) continue;
    beam.least_width = std::min(beam.least_width, part->section.width);
    beam.parts.push_back(*part);
  }
  return beam;
}

/// Returns the beam of a floe, which is computed at the first call. The beams of floes that broke are removed each time
/// the number of beams reaches a power of 2.
const BeamShape& shape_among(const Setup& setup, const Population& population, BodyIndex floe,
                             std::unordered_map<FloeId, BeamShape>& shapes) {
  const FloeId id = population.floe_of(floe);
  const auto known = shapes.find(id);
  if (known != shapes.end()) return known->second;
  if (std::has_single_bit(shapes.size()))
    std::erase_if(shapes, [&](const auto& one) { return !population.is_alive(one.first); });
  return shapes.emplace(id, shape_of(setup, population, floe)).first->second;
}

/// Returns the loads on a beam in its frame: a force in the plane and a force down at each contact.
std::vector<fracture::BeamLoad> loads_on(const Step& step, const dynamics::Bodies& bodies,
                                         const std::vector<Contact>& contacts, std::span<const OnBeam> on,
                                         const BeamShape& beam) {
  const BodyIndex floe = on.front().floe;
  const geometry::Pose water_from_body = dynamics::water_from_body(bodies, floe);
  const geometry::Rotation turn = beam.frame_from_body.rotation;
  std::vector<fracture::BeamLoad> loads;
  for (const OnBeam& one : on) {
    const Contact& c = contacts[one.contact];
    const Point at = transform(beam.frame_from_body, inverse_transform(water_from_body, c.centre_of_pressure()));
    const Vector force = force_on(c, floe, step.length);
    loads.push_back({at, rotate(turn, rotate_back(water_from_body.rotation, force)), one.down});
  }
  return loads;
}

/// A section of a beam with its stress.
struct LoadedSection {
  double stress = 0;          ///< largest tensile stress [Pa]
  bool pulls_at_end = false;  ///< true if tension is largest at the end of the path, false if at its start
  geometry::CrackPath path;   ///< crack along the section, in the floe's body frame
};

/// Replaces `worst` by a section if its stress is larger.
void consider(const fracture::Ice& ice, const BeamShape& beam, std::span<const fracture::BeamLoad> loads,
              const BeamPart& part, LoadedSection& worst) {
  fracture::SectionLoad load = fracture::section_load(loads, beam.moments, part.before, part.section);
  load.vertical_moment *= beam.elastic_share;
  const double stress = fracture::section_stress(ice, part.section.width, load);
  if (stress > worst.stress) worst = {stress, load.moment > 0, part.path};
}

/// Returns the break of a beam at a section. `split` has the members that follow from the strongest contact (split_by).
PendingFracture break_of(const Setup& setup, const Population& population, BodyIndex floe, const LoadedSection& section,
                         PendingFracture split) {
  const geometry::Pose water_from_body = dynamics::water_from_body(population.bodies, floe);
  split.point_in_water = transform(water_from_body, section.pulls_at_end ? section.path.end : section.path.start);
  split.crack_in_body = section.path;
  split.criteria.crack_length = section.path.length_in_ice;
  split.criteria.section_stress = section.stress;
  split.criteria.flexural_strength = ice_of_body(setup, population, floe).flexural_strength;
  return split;
}

/// The contact with the largest force on a beam, and the sums over all contacts.
struct BeamForces {
  const Contact* strongest = nullptr;
  double force = 0;  ///< sum of the magnitudes of the forces in the plane [N]
  double down = 0;   ///< sum of the forces down [N]
};

/// Returns the forces of all contacts on a beam. dt is the length of the step [s].
BeamForces forces_on_beam(const std::vector<Contact>& contacts, std::span<const OnBeam> on, double dt) {
  BeamForces sum;
  double most = 0;
  for (const OnBeam& one : on) {
    const double force = length(force_on(contacts[one.contact], one.floe, dt));
    sum.force += force;
    sum.down += one.down;
    if (force > most) sum.strongest = &contacts[one.contact];
    most = std::max(most, force);
  }
  return sum;
}

/// Returns the break of one floe across as a beam, or nullopt if its stress stays below its flexural strength. Upper
/// bounds of the stress are tested first, because the shape of the beam takes longer. The break is attributed to the
/// contact with the largest force.
std::optional<PendingFracture> break_of_beam(const Setup& setup, const Step& step, const Population& population,
                                             StepData& data, std::span<const OnBeam> on) {
  const dynamics::Bodies& bodies = population.bodies;
  const BodyIndex floe = on.front().floe;
  const fracture::Ice& ice = ice_of_body(setup, population, floe);
  const BeamForces pressing = forces_on_beam(data.contacts, on, step.length);
  const auto may_reach = [&](double least_width, double longest) {
    return fracture::most_section_stress(ice, least_width, longest, pressing.force, pressing.down) >=
           ice.flexural_strength;
  };
  const double across = 2 * bodies.bounding_radius[floe];
  if (!may_reach(fracture::kLeastSection * bodies.area[floe] / across, across)) return std::nullopt;
  if (pressing.strongest == nullptr || pressing.strongest->record->was_refused) return std::nullopt;
  const BeamShape& beam = shape_among(setup, population, floe, data.beam_shapes);
  if (beam.parts.empty() || !may_reach(beam.least_width, beam.length)) return std::nullopt;
  const std::vector<fracture::BeamLoad> loads = loads_on(step, bodies, data.contacts, on, beam);
  LoadedSection worst;
  for (const BeamPart& part : beam.parts) consider(ice, beam, loads, part, worst);
  if (worst.stress < kShareBetween * ice.flexural_strength) return std::nullopt;
  for (const fracture::BeamLoad& load : loads)
    if (const auto part = part_at(setup, population, floe, beam, load.at.x)) consider(ice, beam, loads, *part, worst);
  if (worst.stress < ice.flexural_strength) return std::nullopt;
  return break_of(setup, population, floe, worst, split_by(setup, step, population, *pressing.strongest, floe));
}

}  // namespace

void find_broken_beams(const Setup& setup, const Step& step, const Population& population, StepData& data) {
  const std::vector<OnBeam> all = contacts_of_beams(setup, step, population, data);
  for (std::size_t first = 0; first < all.size();) {
    std::size_t end = first + 1;
    while (end < all.size() && all[end].floe == all[first].floe) ++end;
    if (auto split = break_of_beam(setup, step, population, data, std::span(all).subspan(first, end - first)))
      data.splits.push_back(*split);
    first = end;
  }
}

}  // namespace polynya::simulation
