#include "simulation/ship/hull_contact_load.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "dynamics/contact/contact.hpp"
#include "dynamics/contact/restitution_law.hpp"
#include "fracture/bending/edge_deflection.hpp"
#include "fracture/characteristic_length.hpp"
#include "fracture/crushing.hpp"
#include "simulation/ice/ice_scatter.hpp"
#include "simulation/ship/waterline.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;
using geometry::Point;

/// Returns the angle θ_s of the hull from the vertical at a contact [rad]: from the waterline's normal and the stem
/// angle, or by interpolation in the hull's own table.
double hull_angle_at(const Hull& hull, const dynamics::Bodies& bodies, const dynamics::Contact& c) {
  const geometry::Pose pose = dynamics::water_from_body(bodies, c.a);
  if (hull.angles_from_vertical.empty()) {
    return fracture::hull_angle_from_vertical(rotate_back(pose.rotation, c.normal).x, hull.stem_angle);
  }
  const auto [edge, along, point] = nearest_place(hull.waterline, inverse_transform(pose, c.middle()));
  const std::vector<double>& angles = hull.angles_from_vertical;
  return (1 - along) * angles[edge] + along * angles[(edge + 1) % angles.size()];
}

/// Returns θ_s in the middle of a part of an edge of the waterline [rad]. `sine` is the forward component of the edge's
/// outward normal.
double hull_angle_on(const Hull& hull, const EdgePart& part, double sine) {
  if (hull.angles_from_vertical.empty()) return fracture::hull_angle_from_vertical(sine, hull.stem_angle);
  const double along = 0.5 * (part.from + part.to);
  const std::vector<double>& angles = hull.angles_from_vertical;
  return (1 - along) * angles[part.edge] + along * angles[(part.edge + 1) % angles.size()];
}

/// Returns the facets of the hull's side between the two ends of a contact line.
std::vector<fracture::HullFacet> facets_of(const Hull& hull, const dynamics::Bodies& bodies, const Contact& c) {
  const geometry::Pose pose = dynamics::water_from_body(bodies, c.a);
  const geometry::Vector normal = rotate_back(pose.rotation, c.normal);
  const bool is_in_order = dot(c.ends[1] - c.ends[0], perpendicular(c.normal)) > 0;
  const auto place_of = [&](int end) { return nearest_place(hull.waterline, inverse_transform(pose, c.ends[end])); };
  const auto parts = edges_between(hull.waterline, place_of(is_in_order ? 0 : 1), place_of(is_in_order ? 1 : 0));
  std::vector<fracture::HullFacet> facets;
  for (const EdgePart& part : parts) {
    const geometry::Ring& ring = hull.waterline;
    const geometry::Vector edge = ring[(part.edge + 1) % ring.size()] - ring[part.edge];
    const geometry::Vector out = -(1 / length(edge)) * perpendicular(edge);
    facets.push_back({(part.to - part.from) * length(edge),
                      {dot(out, normal), dot(out, perpendicular(normal))},
                      hull_angle_on(hull, part, out.x)});
  }
  return facets;
}

/// Returns the shares of the force of a contact, by the law of crushing ice, with each facet of a bent side taken by
/// itself. The side of a hull that pierces a floe is in several stretches of ice, so the shares of its contact line are
/// used.
fracture::CrushingShares shares_of(const Hull& hull, const dynamics::Bodies& bodies, const Contact& c,
                                   const HullContactLoad& load) {
  if (load.hull_angle > 0 && !c.record->is_pierced) {
    const std::vector<fracture::HullFacet> facets = facets_of(hull, bodies, c);
    const geometry::Vector hull_against_ice{c.approach_speed, -c.slip_speed};
    if (facets.size() > 1)
      return fracture::crushing_shares_around(facets, load.hull_angle, load.ice.friction, hull_against_ice);
  }
  return load.shares;
}

/// Length of ice edge from the contact over which the wedge is measured, in characteristic lengths [-]. The edge is
/// expected to break at about this distance. Longer: the wedge includes ice beyond the break. Shorter: it follows
/// details of the edge.
constexpr double kWedgeLengthOverL = 0.3;

/// Returns the mobility of a body with its own mass, also of a body of prescribed motion, as Eq. (5) requires.
dynamics::Mobility true_mobility(const dynamics::Bodies& bodies, BodyIndex i, Point at) {
  return {1 / bodies.mass[i], 1 / bodies.moment[i], at - bodies.position[i]};
}

/// Returns the impulse j of Eq. (5) for a contact [N s].
double eq5_impulse(const Setup& setup, const dynamics::Bodies& bodies, const Contact& c) {
  const double mass = dynamics::effective_mass(true_mobility(bodies, c.a, c.middle()),
                                               true_mobility(bodies, c.b, c.middle()), c.normal);
  return dynamics::collision_impulse(c.approach_speed, setup.scene.contact.restitution, mass);
}

/// Returns the half-angles of the ice wedge at a contact.
geometry::WedgeAngles wedge_at(const Setup& setup, const dynamics::Bodies& bodies, const HullContactLoad& load) {
  const Contact& c = load.contact;
  const geometry::Pose water_from_floe = dynamics::water_from_body(bodies, c.b);
  const double l = fracture::characteristic_length(load.ice, setup.scene.water.water);
  return geometry::wedge_angles(bodies.boundary[c.b]->edges,
                                {c.tip_edge_of_b, inverse_transform(water_from_floe, c.tip_of_b)},
                                rotate_back(water_from_floe.rotation, c.normal), kWedgeLengthOverL * l);
}

/// Returns the outline of the ice edge on circles about a contact. Openings are at least twice kSmallestHalfAngle.
fracture::EdgeOpenings openings_at(const Setup& setup, const dynamics::Bodies& bodies, const HullContactLoad& load) {
  const Contact& c = load.contact;
  const geometry::Pose water_from_floe = dynamics::water_from_body(bodies, c.b);
  const Point tip = inverse_transform(water_from_floe, c.tip_of_b);
  const geometry::Vector inward = rotate_back(water_from_floe.rotation, c.normal);
  const double l = fracture::characteristic_length(load.ice, setup.scene.water.water);
  std::array<double, fracture::kSectionCount> radii = fracture::kSectionRadii;
  for (double& radius : radii) radius *= l;
  fracture::EdgeOpenings openings;
  geometry::wedge_angles(bodies.boundary[c.b]->edges, {c.tip_edge_of_b, tip}, inward, radii, openings);
  for (auto& [front, back] : openings) {
    const double narrow = std::max(0.0, fracture::kSmallestHalfAngle - 0.5 * (front + back));
    front += narrow;
    back += narrow;
  }
  return openings;
}

/// Returns the place of the overlap's centroid on the way from its point farthest inside the hull (0) to its far end
/// (1) [-]. In plan the overlap is taken as two triangles on the contact line, the one of the ice's corner and the one
/// of the hull's; the place is (m + d) / 3d, where m is the distance of the line from the first point, and d the depth.
double place_of_load(const Contact& c) {
  if (!(c.depth > 0)) return 2.0 / 3;
  return (1 + std::clamp(dot(c.middle() - c.tip_of_b, c.normal) / c.depth, 0.0, 1.0)) / 3;
}

/// Sets the forces of a load by the law of crushing ice, at the depth of the overlap or at the paid depth, whichever is
/// larger. `can_bend` is true if the floe is large enough to break.
void press(const Setup& setup, bool can_bend, HullContactLoad& load) {
  const Contact& c = load.contact;
  const double deepest = std::max(c.depth, c.paid_depth);
  const bool recedes = can_bend && setup.scene.fracture.follows_deflection && load.shares.vertical > 0;
  const double recession = recedes ? fracture::recession_per_area(bending_load(setup, load), deepest) : 0;
  const fracture::RecedingCrush pressed =
      fracture::crushed_receding({c.width, c.depth, c.area}, deepest, load.ice.thickness, load.hull_angle, recession);
  load.normal_force = fracture::crushing_force(load.ice, pressed.crushed.area);
  load.stiffness = fracture::crushing_force(load.ice, pressed.crushed.slope);
  load.penetration = pressed.penetration;
  load.crushed_share = pressed.share;
  load.vertical_force = load.shares.vertical * load.normal_force;
  if (deepest > 0) load.mean_speed *= pressed.penetration / deepest;
}

}  // namespace

double crushing_force(const fracture::Ice& ice, const Contact& c, double hull_angle) {
  return fracture::crushing_force(
      ice, fracture::crushed_overlap_area({c.width, c.depth, c.area}, ice.thickness, hull_angle));
}

double floe_size(const Population& population, BodyIndex body) {
  return std::sqrt(population.floes[population.floe_of(body)].area);
}

fracture::BendingLoad bending_load(const Setup& setup, const HullContactLoad& load) {
  const geometry::WedgeAngles& wedge = load.wedge;
  fracture::BendingLoad bending;
  bending.ice = load.ice;
  bending.water = setup.scene.water.water;
  bending.front_half_angle = std::clamp(wedge.front, fracture::kSmallestHalfAngle, fracture::kLargestHalfAngle);
  bending.back_half_angle = std::clamp(wedge.back, fracture::kSmallestHalfAngle, fracture::kLargestHalfAngle);
  if (load.opening_angle > 0) bending.opening_angle = load.opening_angle;
  bending.hull_angle = load.hull_angle;
  bending.mean_approach_speed = load.mean_speed;
  bending.penetration = load.penetration;
  bending.vertical_to_crushing = load.shares.vertical;
  bending.vertical_force = load.vertical_force;
  bending.openings = load.openings;
  bending.load_place = place_of_load(load.contact);
  if (load.openings && load.shares.vertical > 0) bending.thrust = load.shares.horizontal / load.shares.vertical;
  return bending;
}

namespace {

/// Returns the members of a load that both laws have in common. `can_break` is true if the floe is large enough to
/// break.
HullContactLoad common_load_of(const Setup& setup, const Population& population, const Contact& c, bool can_break) {
  const dynamics::Bodies& bodies = population.bodies;
  HullContactLoad load{.contact = c, .ice = ice_of_body(setup, population, c.b)};
  if (const double scatter = setup.scene.fracture.bending_scatter; scatter > 0)
    load.ice.flexural_strength *= strength_factor(setup.scene.seed, c.record->first_touch_in_b, scatter);
  load.impulse = eq5_impulse(setup, bodies, c);
  load.hull_angle = hull_angle_at(hull_of(setup.scene, c.a).hull, bodies, c);
  load.shares = fracture::crushing_shares(load.hull_angle, load.ice.friction, c.approach_speed, c.slip_speed);
  load.penetration = c.depth;
  load.mean_speed = c.record->age > 0 ? c.record->approach / c.record->age : c.approach_speed;
  if (can_break) load.wedge = wedge_at(setup, bodies, load);
  return load;
}

/// Returns true if the floe of a contact is large enough to break.
bool can_break(const Setup& setup, const Population& population, const Contact& c) {
  return floe_size(population, c.b) >= limits_of_body(setup, population, c.b).breakable_size;
}

}  // namespace

HullContactLoad crushing_load_of(const Setup& setup, const Population& population, const Contact& c) {
  const bool is_breakable = can_break(setup, population, c);
  HullContactLoad load = common_load_of(setup, population, c, is_breakable);
  load.shares = shares_of(hull_of(setup.scene, c.a).hull, population.bodies, c, load);
  load.opening_angle = std::max(load.wedge.front + load.wedge.back, 2 * fracture::kSmallestHalfAngle);
  if (is_breakable && setup.scene.fracture.outline == fracture::EdgeOutline::kSections)
    load.openings = openings_at(setup, population.bodies, load);
  press(setup, is_breakable, load);
  return load;
}

HullContactLoad collision_load_of(const Setup& setup, const Population& population, const Contact& c) {
  HullContactLoad load = common_load_of(setup, population, c, can_break(setup, population, c));
  load.normal_force = crushing_force(load.ice, c, load.hull_angle);
  return load;
}

}  // namespace polynya::simulation
