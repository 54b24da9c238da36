#include <algorithm>
#include <cmath>

#include "dynamics/chunks.hpp"
#include "elementary/elementary.hpp"
#include "fracture/splitting.hpp"
#include "simulation/ice/crack.hpp"
#include "simulation/ice/prescribed.hpp"
#include "simulation/ship/hull_contact_load.hpp"
#include "simulation/ship/pressing.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;
using geometry::Vector;

/// Returns true if the force of a contact could grow in the step beyond the force that the ice carries along a line,
/// `line_bears` [N].
bool could_exceed(const Step& step, double line_bears, const Contact& c) {
  // Increase of the closing speed by other bodies in the step that is allowed for [m/s].
  constexpr double kUnforeseen = 1;
  const double closing = std::max(0.0, c.approach_speed) + kUnforeseen;
  return c.crushing_force + c.crushing_stiffness * step.length * closing > line_bears;
}

/// Limits the force of a contact to the largest force that its ice can carry, if the force could grow to it in the
/// step. An overlap that is found when it is shallow may become many times as deep in the step, and its measures do not
/// show how wide it will be. If the contact line at the end of the step is known, the limit is the force along it, but
/// at least the present force, which may be larger where a narrow line closes a wide overlap. Otherwise the limit is
/// the force along the longest line that the two bodies can have. `line_load` is the force per metre of contact line
/// [N/m].
void limit_growth(const Step& step, const dynamics::Bodies& bodies, double line_load, Contact& c) {
  if (c.width_ahead > 0) {
    const double borne_now = c.paid_depth > c.depth ? 0 : c.crushing_force;
    c.most_force = std::max(line_load * c.width_ahead, borne_now);
    return;
  }
  const BodyIndex smaller = bodies.bounding_radius[c.a] < bodies.bounding_radius[c.b] ? c.a : c.b;
  const double least_extent = bodies.area[smaller] / (2 * bodies.bounding_radius[smaller]);
  if (could_exceed(step, line_load * least_extent, c)) c.most_force = line_load * longest_line(bodies, c);
}

/// Sets the impulse that a contact has missed before it was found. The contact pressed while its bodies came to the
/// present overlap. With F ∝ ξ^n, n = k ξ / F, the missed impulse is F ξ / ((1 + n) v), limited to the length of a
/// step.
void enter_missed_impulse(const Step& step, Contact& c) {
  if (!c.is_new || c.crushing_force <= 0 || c.approach_speed <= 0) return;
  const double exponent = c.crushing_stiffness * c.depth / c.crushing_force;
  c.missed_impulse = std::min(step.length, c.depth / c.approach_speed) * c.crushing_force / (1 + exponent);
}

/// Sets the crack of the paper's rule, which runs from the contact along the hull's normal through all ice ahead, and
/// its splitting force.
void find_crack(const Setup& setup, const dynamics::Bodies& bodies, const HullContactLoad& load,
                PendingFracture& pending) {
  const Contact& c = load.contact;
  pending.crack_in_body = crack_through(bodies, c.b, c.middle(), c.normal, geometry::CrackReach::kFarSide);
  const double length = pending.crack_in_body.length_in_ice;
  pending.criteria.crack_length = length;
  pending.criteria.splitting_force =
      fracture::michel_splitting_force(load.ice, length, setup.scene.fracture.splitting_shape_factor);
}

/// Returns the bending capacity V_b and the cusp radius R of a contact, by the law of crushing ice. They are those at
/// the depth at which the load reaches V_b: a depth that is reached later in the step, or that was passed before the
/// contact was found. The vertical force is extrapolated by V ∝ ξ^n, with n from its slope. V_b is extrapolated by V_b
/// ∝ ξ^e, with e from its value at one other depth: the depth at which V would reach the V_b of the present depth. R is
/// the one of that depth.
fracture::BendingCapacity capacity_where_it_breaks(const Setup& setup, const Step& step, const HullContactLoad& load) {
  // Smallest n and n − e [-]. Below it V and V_b may be equal only far from the present depth, or nowhere.
  constexpr double kLeastExponent = 0.5;
  // Smallest depth as a fraction of the present one [-]. Farther back the power laws do not hold.
  constexpr double kLeastDepthShare = 0.25;
  fracture::BendingLoad bending = bending_load(setup, load);
  const fracture::BendingCapacity here = setup.bending->capacity(bending);
  if (load.vertical_force <= 0 || !std::isfinite(here.vertical_force)) return here;
  const double n = load.stiffness * load.contact.depth / load.normal_force;
  if (n < kLeastExponent) return here;
  const double ratio = here.vertical_force / load.vertical_force;
  const double share = std::max(kLeastDepthShare, elementary::pow(ratio, 1 / n));
  if (share == 1 || share > 1 + load.contact.approach_speed * step.length / load.contact.depth) return here;
  bending.penetration *= share;
  bending.vertical_force = here.vertical_force;
  fracture::BendingCapacity there = setup.bending->capacity(bending);
  if (!std::isfinite(there.vertical_force)) return here;
  const double e = elementary::log(there.vertical_force / here.vertical_force) / elementary::log(share);
  if (n - e >= kLeastExponent) there.vertical_force = here.vertical_force * elementary::pow(ratio, e / (n - e));
  // V has already exceeded V_b, so the ice has broken at no more than V.
  if (ratio < 1) there.vertical_force = std::min(there.vertical_force, load.vertical_force);
  return there;
}

/// Sets V_b, the flexural strength and the cusp radius, and whether the load is in the range of the bending model's
/// data.
void enter_capacity(const HullContactLoad& load, fracture::BendingCapacity capacity, PendingFracture& pending) {
  pending.criteria.bending_capacity = capacity.vertical_force;
  pending.criteria.flexural_strength = load.ice.flexural_strength;
  pending.cusp_radius = capacity.cusp_radius;
  pending.is_in_range = capacity.is_in_range;
}

/// Law of crushing ice: sets V_b and the cusp. V is set to V_b, because the solver finds whether the load reaches it
/// (drop_unreached_bends). If the thrust keeps every section closed, V_b is infinite and V is set to 0: the ice does
/// not bend.
void measure_bending_by_crushing(const Setup& setup, const Step& step, const HullContactLoad& load,
                                 PendingFracture& pending) {
  const fracture::BendingCapacity capacity = capacity_where_it_breaks(setup, step, load);
  enter_capacity(load, capacity, pending);
  const double most = pending.criteria.bending_capacity;
  pending.criteria.vertical_force = std::isfinite(most) ? most : 0;
}

/// Law of impulses: sets V_b, the cusp, and V. The contact presses with the full crushing force F_n only if the inertia
/// of the bodies can do so within the step; otherwise V is reduced in proportion to the impulse.
void measure_bending_by_collision(const Setup& setup, const Step& step, const HullContactLoad& load,
                                  PendingFracture& pending) {
  const fracture::BendingCapacity capacity = setup.bending->capacity(bending_load(setup, load));
  enter_capacity(load, capacity, pending);
  const double crushing_impulse = load.shares.horizontal * load.normal_force * step.length;
  const double pressed = crushing_impulse > 0 ? std::min(1.0, load.impulse / crushing_impulse) : 0;
  pending.criteria.vertical_force = pressed * load.shares.vertical * load.normal_force;
}

/// Returns how a hull moves the edge of the cusp that it breaks off, by the law of crushing ice. The hull slides the
/// edge down at v_n/tan θ_s. The part of the hull's displacement that did not crush ice has already moved the edge. It
/// is not called for vertical walls, which press no ice down.
DrivenEdge driven_edge_of(const HullContactLoad& load) {
  const Contact& c = load.contact;
  DrivenEdge edge;
  edge.speed_per_approach = load.crushed_share / elementary::tan(load.hull_angle);
  edge.speed = edge.speed_per_approach * c.approach_speed;
  edge.hull_angle = load.hull_angle;
  const double slip = c.slip_speed > 0 ? -1 : c.slip_speed < 0 ? 1 : 0;
  edge.horizontal = (load.shares.horizontal / load.shares.vertical) * c.normal +
                    (slip * load.shares.tangential / load.shares.vertical) * perpendicular(c.normal);
  return edge;
}

/// Returns whether and how the ice of a contact breaks, by the paper's criteria. `measure_bending(pending)` sets V, V_b
/// and the cusp. Splits by the true forces are found after the solver (splitting.cpp).
template <class MeasureBending>
PendingFracture evaluate(const Setup& setup, const Population& population, const HullContactLoad& load,
                         MeasureBending measure_bending) {
  const Contact& c = load.contact;
  PendingFracture pending;
  if (c.approach_speed <= 0) return pending;
  fracture::FailureCriteria& criteria = pending.criteria;
  criteria.floe_size = floe_size(population, c.b);
  criteria.breakable_size = limits_of_body(setup, population, c.b).breakable_size;
  criteria.collision_force = load.impulse / setup.scene.contact.contact_time;
  if (criteria.floe_size < criteria.breakable_size) return pending;

  const bool is_michel = setup.scene.fracture.splitting == fracture::SplittingModel::kMichel;
  if (is_michel) {  // splits by the true forces are decided after the solver
    find_crack(setup, population.bodies, load, pending);
    if (criteria.crack_length > 0 && criteria.collision_force > criteria.splitting_force)
      measure_crack_and_sides(setup, population, c.b, pending.crack_in_body, criteria);
  }
  if (load.shares.vertical > 0) measure_bending(pending);
  pending.failure = fracture::decide(criteria);
  pending.ship = c.a;
  pending.floe = population.floe_of(c.b);
  pending.point_in_water = c.middle();
  pending.first_touch_in_body = c.record->first_touch_in_b;
  pending.normal = c.normal;
  pending.penetration = load.penetration;
  pending.record = c.record;
  return pending;
}

/// Returns the ice that crushes at a contact of two floes.
fracture::Ice crushed_between(const Setup& setup, const Population& population, const Contact& c) {
  return fracture::crushed_between(ice_of_body(setup, population, c.a), ice_of_body(setup, population, c.b));
}

/// Sets the crushing force and stiffness of a contact between two floes, by the law of crushing ice. Edges of floes are
/// vertical. The force is the one at the depth of the overlap or at the paid depth, whichever is larger.
void crush_between_floes(const Setup& setup, const Step& step, const Population& population, Contact& c) {
  const fracture::Ice ice = crushed_between(setup, population, c);
  const fracture::CrushedArea crushed =
      fracture::crushed_overlap_at({c.width, c.depth, c.area}, std::max(c.depth, c.paid_depth), ice.thickness, 0);
  c.crushing_force = fracture::crushing_force(ice, crushed.area);
  c.crushing_stiffness = fracture::crushing_force(ice, crushed.slope);
  enter_missed_impulse(step, c);
  limit_growth(step, population.bodies, ice.compressive_strength * ice.thickness, c);
}

/// Sets what both laws need of a contact between a hull and ice: the collision force j/τ_c, the friction, and the slope
/// of the hull (StepData::slopes).
void enter_hull_contact(const Setup& setup, const Population& population, const HullContactLoad& load, Contact& c,
                        StepData& data) {
  const double collision_force = load.impulse / setup.scene.contact.contact_time;
  data.loads[c.a].collision += planar_of(population.bodies, c.a, c.middle(), -collision_force * c.normal);
  const double horizontal = load.shares.horizontal;
  c.friction = load.shares.tangential / horizontal;
  const double tangent = elementary::tan(load.hull_angle);
  // An inclined hull crushes the edge from its upper corner down.
  const double height = tangent > 0 ? std::min(load.ice.thickness, load.penetration / tangent) : load.ice.thickness;
  const double deepest = std::max(c.depth, c.paid_depth);
  const double penetration_share = deepest > 0 ? std::min(1.0, load.penetration / deepest) : 1;
  data.slopes.back() = {load.shares.vertical / horizontal, tangent, load.crushed_share, penetration_share, height};
}

/// Returns true if the ice bends or splits, and geometry has not refused a fracture at this contact before.
bool breaks(const PendingFracture& pending, const Contact& c) {
  const bool fails = pending.failure == fracture::Failure::kBend || pending.failure == fracture::Failure::kSplit;
  return fails && !c.record->was_refused;
}

/// Sets the forces of a contact between a hull and ice by the law of crushing ice, and the force at which the ice
/// bends. A fracture that may happen in the step is added to StepData::fractures.
void crush_at_hull(const Setup& setup, const Step& step, const Population& population, Contact& c, StepData& data) {
  HullContactLoad load = crushing_load_of(setup, population, c);
  press_prescribed(setup, step, population, load);
  close_prescribed_gap(step, population.bodies, c);
  enter_hull_contact(setup, population, load, c, data);
  const double horizontal = load.shares.horizontal;
  c.crushing_force = horizontal * load.normal_force;
  c.crushing_stiffness = horizontal * load.stiffness;
  enter_missed_impulse(step, c);
  limit_growth(
      step, population.bodies,
      load.ice.compressive_strength * load.ice.thickness * (1 + load.ice.friction * elementary::tan(load.hull_angle)),
      c);
  const auto measure = [&](PendingFracture& pending) { measure_bending_by_crushing(setup, step, load, pending); };
  PendingFracture pending = evaluate(setup, population, load, measure);
  if (!breaks(pending, c)) return;
  if (pending.failure == fracture::Failure::kBend) {
    pending.driven_edge = driven_edge_of(load);
    pending.cusp_axis_in_body = rotate_back(population.bodies.rotation[c.b], c.normal);
    pending.passes_to_pieces = true;
    break_at(c, pending.criteria.bending_capacity * horizontal / load.shares.vertical);
  }
  data.fractures.push_back(pending);
}

/// Sets the force limit of a contact between a hull and ice by the law of impulses. If the ice breaks, the fracture is
/// added to StepData::fractures.
void collide_with_hull(const Setup& setup, const Step& step, const Population& population, Contact& c, StepData& data) {
  const HullContactLoad load = collision_load_of(setup, population, c);
  enter_hull_contact(setup, population, load, c, data);
  c.crushing_force = load.shares.horizontal * load.normal_force;
  const auto measure = [&](PendingFracture& pending) { measure_bending_by_collision(setup, step, load, pending); };
  const PendingFracture pending = evaluate(setup, population, load, measure);
  if (breaks(pending, c)) data.fractures.push_back(pending);
}

/// Calls between_floes(c) for all contacts of two floes, in parallel, and then at_hull(c) for those of a hull and a
/// floe, one after the other in their order.
template <class BetweenFloes, class AtHull>
void decide(const Setup& setup, const Step& step, const Population& population, StepData& data,
            BetweenFloes between_floes, AtHull at_hull) {
  data.fractures.clear();
  data.slopes.clear();
  data.loads.assign(static_cast<std::size_t>(population.hull_count), {});
  dynamics::for_contacts(data.contacts, step.threads, [&](Contact& c, std::size_t) {
    c.friction = setup.scene.ice.friction;
    if (!population.is_hull(c.a)) between_floes(c);
  });
  for (Contact& c : data.contacts) {  // contacts are ordered by (a, b), so those of hulls come first
    if (!population.is_hull(c.a)) break;
    data.slopes.emplace_back();
    if (!population.is_hull(c.b)) at_hull(c);
  }
}

}  // namespace

void decide_by_crushing(const Setup& setup, const Step& step, const Population& population, StepData& data) {
  decide(
      setup, step, population, data, [&](Contact& c) { crush_between_floes(setup, step, population, c); },
      [&](Contact& c) { crush_at_hull(setup, step, population, c, data); });
}

void decide_by_collision(const Setup& setup, const Step& step, const Population& population, StepData& data) {
  const auto between_floes = [&](Contact& c) {
    c.crushing_force = crushing_force(crushed_between(setup, population, c), c, 0);
  };
  decide(setup, step, population, data, between_floes,
         [&](Contact& c) { collide_with_hull(setup, step, population, c, data); });
}

void drop_unreached_bends(StepData& data) {
  std::erase_if(data.fractures, [&](const PendingFracture& pending) {
    if (pending.failure != fracture::Failure::kBend) return false;
    return std::ranges::none_of(data.contacts,
                                [&](const Contact& c) { return c.record == pending.record && c.is_broken; });
  });
}

}  // namespace polynya::simulation
