#include "simulation/ship/pressing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "simulation/ship/hull_contact_load.hpp"

namespace polynya::simulation {

using dynamics::Contact;
using fracture::Push;
using geometry::Point;
using geometry::Vector;

namespace {

/// Shortest face of a corner, and least distance of its tip from the contact line [m]. Smaller ones are rounding errors
/// and do not count as corners.
constexpr double kLeastFace = 1e-9;

/// Returns true if a face of a body belongs to the stern of a ship: its normal is within 60° of straight aft.
bool is_aft(const dynamics::Bodies& bodies, BodyIndex by, Vector normal) {
  return bodies.kind[by] == dynamics::BodyKind::kShip && dot(normal, rotate(bodies.rotation[by], {1, 0})) < -0.5;
}

/// Returns a face of a corner, from an end of the contact line to the tip, with its normal into the floe and the speeds
/// of the other body along it and away from it.
fracture::Face face_of(const dynamics::Bodies& bodies, const Contact& c, BodyIndex floe, Point end, Point tip) {
  const BodyIndex by = other_of(c, floe);
  const Point middle = midpoint(end, tip);
  Vector normal = perpendicular(tip - end) / distance(end, tip);
  if (dot(normal, into_floe(c, floe)) < 0) normal = -normal;
  const Vector relative =
      velocity_at(bodies, by, middle - bodies.position[by]) - velocity_at(bodies, floe, middle - bodies.position[floe]);
  const double leaving = is_aft(bodies, by, normal) ? -dot(relative, normal) : 0;
  return {middle, normal, dot(relative, perpendicular(normal)), leaving};
}

/// Returns the two pushes of a contact at which a corner of the other body is inside the floe; nullopt if there is no
/// such corner.
std::optional<std::array<Push, 2>> corner_pushes(const dynamics::Bodies& bodies, const Contact& c, BodyIndex floe,
                                                 Vector force, double friction) {
  const Point tip = floe == c.b ? c.tip_of_a : c.tip_of_b;
  if (dot(tip - c.ends[0], into_floe(c, floe)) < kLeastFace) return std::nullopt;
  if (std::min(distance(tip, c.ends[0]), distance(tip, c.ends[1])) < kLeastFace) return std::nullopt;
  return fracture::wedge_pushes(
      force, {face_of(bodies, c, floe, c.ends[0], tip), face_of(bodies, c, floe, c.ends[1], tip)}, friction);
}

/// Adds the place of a crack between two contacts: the middle of the line between them, in the direction across it to
/// which they push.
void add_mouth_between(const PressedContact& p, const PressedContact& q, std::vector<CrackMouth>& mouths) {
  const Point at_p = p.contact->centre_of_pressure();
  const Point at_q = q.contact->centre_of_pressure();
  const Vector between = at_q - at_p;
  if (length(between) < kLeastFace) return;
  Vector direction = perpendicular(between) / length(between);
  if (dot(direction, p.force + q.force) < 0) direction = -direction;
  const Contact* harder = squared_length(p.force) < squared_length(q.force) ? q.contact : p.contact;
  mouths.push_back({midpoint(at_p, at_q), direction, harder});
}

}  // namespace

Vector force_on(const Contact& c, BodyIndex floe, double dt) {
  Vector force = (c.step_share / dt) * c.impulse_on_b();
  if (c.is_broken) {
    const double total = c.total_normal_impulse();
    const double slip = total > 0 ? c.slip_impulse / total : 0;
    force = c.breaking_force * (c.normal + slip * perpendicular(c.normal));
  }
  return floe == c.b ? force : -force;
}

double opening_bound(const Setup& setup, const Step& step, std::span<const Contact> contacts) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kLeast = 1e-3;  // smallest sine for which the bound is not dominated by rounding [-]
  const double friction = setup.scene.ice.friction;
  double sum = 0;
  double half_sine = 0.5 * std::numbers::sqrt2, half_cosine = half_sine;  // of half of the angle of the sharpest corner
  for (const Contact& c : contacts) {
    const double slip = c.friction * c.friction;
    const double normal = normal_force_of(c, step.length);
    if (!(normal > 0)) continue;
    sum += normal * std::sqrt(1 + slip);
    for (const Point tip : {c.tip_of_a, c.tip_of_b}) {
      const Vector u = c.ends[0] - tip, v = c.ends[1] - tip;
      const double both = dot(u, v);
      if (!(both > 0)) continue;
      const double cosine = std::min(1.0, both / std::sqrt(squared_length(u) * squared_length(v)));
      half_sine = std::min(half_sine, std::sqrt(0.5 * (1 - cosine)));
      half_cosine = std::max(half_cosine, std::sqrt(0.5 * (1 + cosine)));
    }
  }
  const double sine = half_sine - friction * half_cosine;
  if (sum == 0) return 0;
  return sine < kLeast ? kInfinity : 0.5 * std::sqrt(1 + friction * friction) / sine * sum;
}

void press(const Setup& setup, const Step& step, const dynamics::Bodies& bodies, std::span<const Contact> contacts,
           PressedFloe& pressed) {
  const BodyIndex floe = pressed.floe;
  pressed.contacts.clear();
  pressed.pushes.clear();
  for (const Contact& c : contacts) {
    if (c.total_normal_impulse() <= 0 && !c.is_broken) continue;
    const Vector force = force_on(c, floe, step.length);
    const auto pushes = corner_pushes(bodies, c, floe, force, setup.scene.ice.friction);
    if (pushes)
      pressed.pushes.insert(pressed.pushes.end(), pushes->begin(), pushes->end());
    else
      pressed.pushes.push_back({c.centre_of_pressure(), force});
    pressed.contacts.push_back({&c, force, pushes.has_value()});
  }
  pressed.most = 0;
  for (const Push& push : pressed.pushes) pressed.most += 0.5 * length(push.force);
}

PendingFracture split_by(const Setup& setup, const Step& step, const Population& population, const Contact& c,
                         BodyIndex floe) {
  const BodyIndex by = other_of(c, floe);
  PendingFracture split;
  split.failure = fracture::Failure::kSplit;
  split.record = c.record;
  split.ship = population.hull_or_none(by);
  split.by_floe = population.floe_or_none(by);
  split.floe = population.floe_of(floe);
  split.normal = into_floe(c, floe);
  split.penetration = c.depth;
  split.criteria.floe_size = floe_size(population, floe);
  split.criteria.breakable_size = limits_of_body(setup, population, floe).breakable_size;
  split.criteria.contact_force = length(force_on(c, floe, step.length));
  return split;
}

void find_mouths(PressedFloe& pressed) {
  const BodyIndex floe = pressed.floe;
  pressed.mouths.clear();
  const PressedContact* before = nullptr;
  for (const PressedContact& next : pressed.contacts) {
    const Contact& c = *next.contact;
    if (next.is_corner) pressed.mouths.push_back({floe == c.b ? c.tip_of_a : c.tip_of_b, into_floe(c, floe), &c});
    if (before) add_mouth_between(*before, next, pressed.mouths);
    before = &next;
  }
}

}  // namespace polynya::simulation
