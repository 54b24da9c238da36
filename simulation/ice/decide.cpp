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

/// Whether a force could grow in the step beyond what the ice bears along a line [N].
bool could_exceed(const Step& step, double line_bears, const Contact& c) {
  constexpr double kUnforeseen = 1;  // by how much other bodies may make the two close faster in the step [m/s]
  const double closing = std::max(0.0, c.approach_speed) + kUnforeseen;
  return c.crushing_force + c.crushing_stiffness * step.length * closing > line_bears;
}

/// Enters the most that the ice of a contact bears where its force could grow to that in the step: an overlap that is
/// found when it is shallow may grow to many times its depth, and its measures do not tell how wide it will be. It
/// bears as much as along the line that the contact comes to have, where that is known, or the longest one that its two
/// bodies can have. What the ice bears on its way there, where a narrow line closes a wide overlap, is no growth.
/// `line_load` is the force per metre of contact line [N/m].
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

/// Enters the impulse that a contact has missed which is found for the first time. It has pressed while its bodies came
/// to overlap so far: with F ∝ ξ^n, n = k ξ / F, it has given F ξ / ((1 + n) v).
void enter_missed_impulse(const Step& step, Contact& c) {
  if (!c.is_new || c.crushing_force <= 0 || c.approach_speed <= 0) return;
  const double exponent = c.crushing_stiffness * c.depth / c.crushing_force;
  c.missed_impulse = std::min(step.length, c.depth / c.approach_speed) * c.crushing_force / (1 + exponent);
}

/// By the paper's rule: the crack that would start at the contact, along the hull's normal through all ice
/// ahead, and the force that it takes.
void find_crack(const Setup& setup, const dynamics::Bodies& bodies, const HullContactLoad& load,
                PendingFracture& pending) {
  const Contact& c = load.contact;
  pending.crack_in_body = crack_through(bodies, c.b, c.middle(), c.normal, geometry::CrackReach::kFarSide);
  const double length = pending.crack_in_body.length_in_ice;
  pending.criteria.crack_length = length;
  pending.criteria.splitting_force =
      fracture::michel_splitting_force(load.ice, length, setup.scene.fracture.splitting_shape_factor);
}

/// V_b and the cusp, by the law of crushing ice where the load comes to V_b: within the step or, of a contact that is
/// found late, before it. V ∝ ξ^n by its slope and V_b ∝ ξ^e by its value at one more depth, where V would come to the
/// V_b of the depth at hand; R is that of this depth.
fracture::BendingCapacity capacity_where_it_breaks(const Setup& setup, const Step& step, const HullContactLoad& load) {
  constexpr double kLeastExponent = 0.5;     // of n and n - e: below it V and V_b need not meet anywhere near
  constexpr double kLeastDepthShare = 0.25;  // of the depth: farther back the powers do not hold
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
  // V has passed V_b already: the ice has broken, however far the powers hold.
  if (ratio < 1) there.vertical_force = std::min(there.vertical_force, load.vertical_force);
  return there;
}

/// Enters V_b and the cusp, and whether the model holds for the load.
void enter_capacity(const HullContactLoad& load, fracture::BendingCapacity capacity, PendingFracture& pending) {
  pending.criteria.bending_capacity = capacity.vertical_force;
  pending.criteria.flexural_strength = load.ice.flexural_strength;
  pending.cusp_radius = capacity.cusp_radius;
  pending.is_in_range = capacity.is_in_range;
}

/// By the law of crushing ice: V_b, the cusp, and V_b as V, since the solver finds whether the load reaches it. Where
/// thrust keeps every section closed it never does.
void measure_bending_by_crushing(const Setup& setup, const Step& step, const HullContactLoad& load,
                                 PendingFracture& pending) {
  const fracture::BendingCapacity capacity = capacity_where_it_breaks(setup, step, load);
  enter_capacity(load, capacity, pending);
  const double most = pending.criteria.bending_capacity;
  pending.criteria.vertical_force = std::isfinite(most) ? most : 0;
}

/// By the law of impulses: V_b, the cusp, and V. The contact crushes with all of F_n only where the bodies' inertia can
/// press that hard within the step.
void measure_bending_by_collision(const Setup& setup, const Step& step, const HullContactLoad& load,
                                  PendingFracture& pending) {
  const fracture::BendingCapacity capacity = setup.bending->capacity(bending_load(setup, load));
  enter_capacity(load, capacity, pending);
  const double crushing_impulse = load.shares.horizontal * load.normal_force * step.length;
  const double pressed = crushing_impulse > 0 ? std::min(1.0, load.impulse / crushing_impulse) : 0;
  pending.criteria.vertical_force = pressed * load.shares.vertical * load.normal_force;
}

/// By the law of crushing ice. The hull slides the edge down at v_n/tan θ_s; what did not crush of its way the edge has
/// gone already. A wall that is as good as vertical presses down no ice (shares).
EdgePush push_of(const HullContactLoad& load) {
  const Contact& c = load.contact;
  EdgePush push;
  push.speed_per_approach = load.crushed_share / elementary::tan(load.hull_angle);
  push.speed = push.speed_per_approach * c.approach_speed;
  push.hull_angle = load.hull_angle;
  const double slip = c.slip_speed > 0 ? -1 : c.slip_speed < 0 ? 1 : 0;
  push.horizontal = (load.shares.horizontal / load.shares.vertical) * c.normal +
                    (slip * load.shares.tangential / load.shares.vertical) * perpendicular(c.normal);
  return push;
}

/// Whether and how the ice of a contact breaks. `measure_bending(pending)` enters V, V_b and the cusp.
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
  if (is_michel) {  // by true forces it is decided after the solver
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

fracture::Ice crushed_between(const Setup& setup, const Population& population, const Contact& c) {
  return fracture::crushed_between(ice_of_body(setup, population, c.a), ice_of_body(setup, population, c.b));
}

/// Floe against floe by the law of crushing ice: vertical walls, F_n at the depth of the overlap or the paid depth.
void crush_between_floes(const Setup& setup, const Step& step, const Population& population, Contact& c) {
  const fracture::Ice ice = crushed_between(setup, population, c);
  const fracture::CrushedArea crushed =
      fracture::crushed_overlap_at({c.width, c.depth, c.area}, std::max(c.depth, c.paid_depth), ice.thickness, 0);
  c.crushing_force = fracture::crushing_force(ice, crushed.area);
  c.crushing_stiffness = fracture::crushing_force(ice, crushed.slope);
  enter_missed_impulse(step, c);
  limit_growth(step, population.bodies, ice.compressive_strength * ice.thickness, c);
}

/// Enters what both laws take of a ship's contact with ice: the collision force j/τ_c, friction, and the hull's slope.
void enter_hull_contact(const Setup& setup, const Population& population, const HullContactLoad& load, Contact& c,
                        StepData& data) {
  const double collision_force = load.impulse / setup.scene.contact.contact_time;
  data.loads[c.a].collision += planar_of(population.bodies, c.a, c.middle(), -collision_force * c.normal);
  const double horizontal = load.shares.horizontal;
  c.friction = load.shares.tangential / horizontal;
  const double tangent = elementary::tan(load.hull_angle);
  // An inclined hull crushes the edge from its top corner down.
  const double height = tangent > 0 ? std::min(load.ice.thickness, load.penetration / tangent) : load.ice.thickness;
  const double deepest = std::max(c.depth, c.paid_depth);
  const double penetration_share = deepest > 0 ? std::min(1.0, load.penetration / deepest) : 1;
  data.slopes.back() = {load.shares.vertical / horizontal, tangent, load.crushed_share, penetration_share, height};
}

bool breaks(const PendingFracture& pending, const Contact& c) {
  const bool fails = pending.failure == fracture::Failure::kBend || pending.failure == fracture::Failure::kSplit;
  return fails && !c.record->was_refused;
}

/// A ship's contact with ice by the law of crushing ice: also at which force the ice bends.
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
    pending.push = push_of(load);
    pending.cusp_axis_in_body = rotate_back(population.bodies.rotation[c.b], c.normal);
    pending.passes_to_pieces = true;
    break_at(c, pending.criteria.bending_capacity * horizontal / load.shares.vertical);
  }
  data.fractures.push_back(pending);
}

/// A ship's contact with ice by the law of impulses: also whether the ice breaks.
void collide_with_hull(const Setup& setup, const Step& step, const Population& population, Contact& c, StepData& data) {
  const HullContactLoad load = collision_load_of(setup, population, c);
  enter_hull_contact(setup, population, load, c, data);
  c.crushing_force = load.shares.horizontal * load.normal_force;
  const auto measure = [&](PendingFracture& pending) { measure_bending_by_collision(setup, step, load, pending); };
  const PendingFracture pending = evaluate(setup, population, load, measure);
  if (breaks(pending, c)) data.fractures.push_back(pending);
}

/// Calls between_floes(c) for all contacts of two floes, side by side, and at_hull(c) for those of a hull and a floe,
/// in their order.
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
  for (Contact& c : data.contacts) {  // by (a, b): those of hulls come first
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

void drop_unbroken(StepData& data) {
  std::erase_if(data.fractures, [&](const PendingFracture& pending) {
    if (pending.failure != fracture::Failure::kBend) return false;
    return std::ranges::none_of(data.contacts,
                                [&](const Contact& c) { return c.record == pending.record && c.is_broken; });
  });
}

}  // namespace polynya::simulation
