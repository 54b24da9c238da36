#include "simulation/ice/beams.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "fracture/beam.hpp"
#include "simulation/ice/crack.hpp"
#include "simulation/ship/pressing.hpp"
#include "simulation/ship/ship_contact_load.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;
using fracture::BeamSection;
using geometry::Point;
using geometry::Vector;

/// Sections between a beam's ends, beside those at its loads: the moment peaks at a load, or where no shear
/// is, and is flat there.
constexpr int kSections = 24;

/// A contact that presses a beam.
struct OnBeam {
  BodyIndex floe = 0;
  std::size_t contact = 0;
  double down = 0;  ///< that the hull presses it down with [N]
};

double normal_force_of(const Contact& c, double dt) {
  return c.is_broken ? c.breaking_force : c.steady_share / dt * c.total_normal_impulse();
}

bool may_break(const Setup& setup, const Population& population, BodyIndex body) {
  const dynamics::Bodies& bodies = population.bodies;
  if (population.is_hull(body) || bodies.inverse_mass[body] == 0) return false;
  if (!fracture::is_beam(bodies.area[body], bodies.moment[body] / bodies.mass[body])) return false;
  const IceLimits& limits = limits_of_body(setup, population, body);
  return limits.breaks_beams && floe_size(population, body) < limits.breakable_size;
}

/// By floe, and by contact within it.
std::vector<OnBeam> contacts_of_beams(const Setup& setup, const Population& population, const StepData& step) {
  std::vector<OnBeam> found;
  for (std::size_t i = 0; i < step.contacts.size(); ++i) {
    const Contact& c = step.contacts[i];
    const double force = normal_force_of(c, setup.step);
    if (!(force > 0)) continue;
    const double down = i < step.slopes.size() ? std::max(0.0, step.slopes[i].vertical_share) * force : 0;
    for (const BodyIndex body : {c.a, c.b})
      if (may_break(setup, population, body)) found.push_back({body, i, down});
  }
  std::ranges::stable_sort(found, {}, &OnBeam::floe);
  return found;
}

/// A floe with its loads.
struct Beam {
  BodyIndex floe = 0;
  geometry::Pose frame_from_body;  ///< origin at the centre of mass, x along its length
  fracture::PlaneMoments moments;
  std::vector<fracture::BeamLoad> loads;
  double elastic_share = 1;  ///< of the rigid beam's vertical moment
};

Beam beam_of(const Setup& setup, const Population& population, const std::vector<Contact>& contacts,
             std::span<const OnBeam> on) {
  const dynamics::Bodies& bodies = population.bodies;
  const BodyIndex floe = on.front().floe;
  const geometry::Polygon& polygon = population.floes[population.floe_of(floe)].shape.polygon;
  Beam beam{floe, {Point{} - (bodies.centroid[floe] - Point{}), {}}, {}, {}, 1};
  const double axis = fracture::long_axis(fracture::moments_of(polygon, beam.frame_from_body));
  const geometry::Rotation turn = geometry::Rotation::by(-axis);
  beam.frame_from_body = {Point{} + rotate(turn, beam.frame_from_body.position - Point{}), turn};
  beam.moments = fracture::moments_of(polygon, beam.frame_from_body);
  const geometry::Pose water_from_body = dynamics::water_from_body(bodies, floe);
  const auto in_frame = [&](Vector v) { return rotate(turn, rotate_back(water_from_body.rotation, v)); };
  for (const OnBeam& one : on) {
    const Contact& c = contacts[one.contact];
    const Point at = transform(beam.frame_from_body, inverse_transform(water_from_body, c.centre_of_pressure()));
    beam.loads.push_back({at, in_frame(force_on(c, floe, setup.step)), one.down});
  }
  const double length = std::sqrt(12 * beam.moments.xx / beam.moments.area);  // of a rectangle
  beam.elastic_share = fracture::elastic_share(ice_of_body(setup, population, floe), setup.scene.water.water, length);
  return beam;
}

/// A section of a beam with its stress.
struct LoadedSection {
  double stress = 0;          ///< [Pa]
  bool pulls_at_end = false;  ///< of the path, else at its start
  geometry::CrackPath path;   ///< in the floe's frame, along y
};

/// The section at x; none where the beam is narrow there, not in one piece, or leaves a piece that is none.
std::optional<LoadedSection> section_at(const Setup& setup, const Population& population, const Beam& beam, double x) {
  const dynamics::Bodies& bodies = population.bodies;
  const double outside = 2 * bodies.bounding_radius[beam.floe];
  const Vector along = rotate_back(beam.frame_from_body.rotation, {0, 1});
  const Point from = inverse_transform(beam.frame_from_body, {x, -outside});
  const auto crossings = crossings_of_line(*bodies.boundary[beam.floe], from, along);
  if (crossings.size() != 2) return std::nullopt;
  const double near = crossings[0].at, far = crossings[1].at;
  const double width = far - near;
  const double mean_width = 0.5 * beam.moments.area / bodies.bounding_radius[beam.floe];
  if (width < fracture::kLeastSection * mean_width) return std::nullopt;
  const geometry::Polygon& polygon = population.floes[population.floe_of(beam.floe)].shape.polygon;
  const fracture::PlaneMoments before = fracture::moments_up_to(polygon, beam.frame_from_body, x);
  const double least = setup.scene.fracture.smallest_floe_area;
  if (std::min(before.area, beam.moments.area - before.area) < least) return std::nullopt;
  const BeamSection section{x, 0.5 * (near + far) - outside, width};
  fracture::SectionLoad load = fracture::section_load(beam.loads, beam.moments, before, section);
  load.vertical_moment *= beam.elastic_share;
  LoadedSection found;
  found.path = {from + (near - kCrackMargin) * along,
                from + (far + kCrackMargin) * along,
                width,
                crossings[0].edge,
                crossings[1].edge,
                1};
  found.stress = fracture::section_stress(ice_of_body(setup, population, beam.floe), width, load);
  found.pulls_at_end = load.moment > 0;
  return found;
}

/// The section that has the greatest stress.
std::optional<LoadedSection> worst_section(const Setup& setup, const Population& population, const Beam& beam) {
  std::optional<LoadedSection> worst;
  const auto consider = [&](double x) {
    const auto section = section_at(setup, population, beam, x);
    if (section && (!worst || section->stress > worst->stress)) worst = section;
  };
  for (const fracture::BeamLoad& load : beam.loads) consider(load.at.x);
  const double reach = population.bodies.bounding_radius[beam.floe];
  for (int k = 1; k < kSections; ++k) consider(reach * (2.0 * k / kSections - 1));
  return worst;
}

PendingFracture break_of(const Setup& setup, const Population& population, const Contact& c, const Beam& beam,
                         const LoadedSection& section) {
  const BodyIndex by = other_of(c, beam.floe);
  const geometry::Pose water_from_body = dynamics::water_from_body(population.bodies, beam.floe);
  PendingFracture split;
  split.failure = fracture::Failure::kSplit;
  split.record = c.record;
  split.ship = population.is_hull(by) ? by : -1;
  split.by_floe = population.is_hull(by) ? kNoFloe : population.floe_of(by);
  split.floe = population.floe_of(beam.floe);
  split.point_in_water = transform(water_from_body, section.pulls_at_end ? section.path.end : section.path.start);
  split.normal = into_floe(c, beam.floe);
  split.penetration = c.depth;
  split.crack_in_body = section.path;
  fracture::FailureCriteria& criteria = split.criteria;
  criteria.floe_size = floe_size(population, beam.floe);
  criteria.breakable_size = limits_of_body(setup, population, beam.floe).breakable_size;
  criteria.contact_force = length(force_on(c, beam.floe, setup.step));
  criteria.crack_length = section.path.length_in_ice;
  criteria.section_stress = section.stress;
  criteria.flexural_strength = ice_of_body(setup, population, beam.floe).flexural_strength;
  return split;
}

/// The break of one beam, by what presses it most.
std::optional<PendingFracture> break_of_beam(const Setup& setup, const Population& population,
                                             const std::vector<Contact>& contacts, std::span<const OnBeam> on) {
  const BodyIndex floe = on.front().floe;
  const fracture::Ice& ice = ice_of_body(setup, population, floe);
  const Contact* strongest = nullptr;
  double sum = 0, down = 0, most = 0;
  for (const OnBeam& one : on) {
    const double force = length(force_on(contacts[one.contact], floe, setup.step));
    sum += force;
    down += one.down;
    if (force > most) strongest = &contacts[one.contact];
    most = std::max(most, force);
  }
  const double longest = 2 * population.bodies.bounding_radius[floe];
  const double area = population.bodies.area[floe];
  if (fracture::most_section_stress(ice, area, longest, sum, down) < ice.flexural_strength) return std::nullopt;
  if (strongest == nullptr || strongest->record->was_refused) return std::nullopt;
  const Beam beam = beam_of(setup, population, contacts, on);
  const auto section = worst_section(setup, population, beam);
  if (!section || section->stress < ice.flexural_strength) return std::nullopt;
  return break_of(setup, population, *strongest, beam, *section);
}

}  // namespace

void find_broken_beams(const Setup& setup, const Population& population, const StepData& step,
                       std::vector<PendingFracture>& splits) {
  const std::vector<OnBeam> all = contacts_of_beams(setup, population, step);
  for (std::size_t first = 0; first < all.size();) {
    std::size_t end = first + 1;
    while (end < all.size() && all[end].floe == all[first].floe) ++end;
    const auto split = break_of_beam(setup, population, step.contacts, std::span(all).subspan(first, end - first));
    if (split) splits.push_back(*split);
    first = end;
  }
}

}  // namespace polynya::simulation
