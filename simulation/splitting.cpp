#include "fracture/splitting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "fracture/opening.hpp"
#include "simulation/crack.hpp"
#include "simulation/ship_contact_load.hpp"
#include "simulation/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;
using fracture::Push;
using geometry::Point;
using geometry::Vector;

/// Cracks are tried along a contact's normal and this many directions to either side of it, 15° apart.
constexpr int kDirectionsASide = 5;
constexpr double kBetweenDirections = std::numbers::pi / 12;  // [rad]

/// Faces shorter than this, and tips nearer to the contact line, are none [m].
constexpr double kLeastFace = 1e-9;

/// Where a crack may start.
struct Mouth {
  Point point;       ///< [m]
  Vector direction;  ///< unit, into the ice
  const Contact* contact = nullptr;
};

/// What one body does to a floe at all of their contacts, by the forces of the step.
struct Pressing {
  std::vector<Push> pushes;
  std::vector<Mouth> mouths;
  double most = 0;  ///< that they can open a crack with [N]
};

/// A crack that a body may open in a floe.
struct Candidate {
  Mouth mouth;
  geometry::CrackPath path_in_body;
  fracture::FailureCriteria criteria;
  double share() const { return criteria.opening_force / criteria.opening_capacity; }
};

BodyIndex other_of(const Contact& c, BodyIndex floe) {
  return floe == c.b ? c.a : c.b;
}

Vector into_floe(const Contact& c, BodyIndex floe) {
  return floe == c.b ? c.normal : -c.normal;
}

/// The force of a contact in the step; where its ice broke within the step, that at which it did.
Vector force_on(const Contact& c, BodyIndex floe, double dt) {
  Vector force = (c.steady_share / dt) * c.impulse_on_b();
  if (c.is_broken) {
    const double total = c.total_normal_impulse();
    const double slip = total > 0 ? c.slip_impulse / total : 0;
    force = c.breaking_force * (c.normal + slip * perpendicular(c.normal));
  }
  return floe == c.b ? force : -force;
}

fracture::Face face_of(const dynamics::Bodies& bodies, const Contact& c, BodyIndex floe, Point end,
                       Point tip) {
  const BodyIndex by = other_of(c, floe);
  const Point middle = midpoint(end, tip);
  Vector normal = perpendicular(tip - end) / distance(end, tip);
  if (dot(normal, into_floe(c, floe)) < 0) normal = -normal;
  const Vector relative = velocity_at(bodies, by, middle - bodies.position[by]) -
                          velocity_at(bodies, floe, middle - bodies.position[floe]);
  return {middle, normal, dot(relative, perpendicular(normal))};
}

/// The pushes of a contact where the other body's corner is in the floe.
std::optional<std::array<Push, 2>> corner_pushes(const dynamics::Bodies& bodies, const Contact& c,
                                                 BodyIndex floe, Vector force, double friction) {
  const Point tip = floe == c.b ? c.tip_of_a : c.tip_of_b;
  if (dot(tip - c.ends[0], into_floe(c, floe)) < kLeastFace) return std::nullopt;
  if (std::min(distance(tip, c.ends[0]), distance(tip, c.ends[1])) < kLeastFace) return std::nullopt;
  return fracture::wedge_pushes(
      force, {face_of(bodies, c, floe, c.ends[0], tip), face_of(bodies, c, floe, c.ends[1], tip)}, friction);
}

/// A crack between two contacts starts on the way between them, across it, to where they push.
void add_mouth_between(const Contact& p, const Contact& q, BodyIndex floe, double dt,
                       std::vector<Mouth>& mouths) {
  const Vector force_p = force_on(p, floe, dt);
  const Vector force_q = force_on(q, floe, dt);
  const Vector between = q.centre_of_pressure() - p.centre_of_pressure();
  if (length(between) < kLeastFace) return;
  Vector direction = perpendicular(between) / length(between);
  if (dot(direction, force_p + force_q) < 0) direction = -direction;
  const Contact& harder = squared_length(force_p) < squared_length(force_q) ? q : p;
  mouths.push_back({midpoint(p.centre_of_pressure(), q.centre_of_pressure()), direction, &harder});
}

/// `contacts` are all of the floe with one other body, around that.
Pressing press(const Setup& setup, const dynamics::Bodies& bodies, std::span<const Contact> contacts,
               BodyIndex floe) {
  const double dt = setup.scene.time.step;
  Pressing pressing;
  const Contact* before = nullptr;
  for (const Contact& c : contacts) {
    if (c.total_normal_impulse() <= 0 && !c.is_broken) continue;
    const Vector force = force_on(c, floe, dt);
    if (const auto pushes = corner_pushes(bodies, c, floe, force, setup.scene.ice.friction)) {
      pressing.pushes.insert(pressing.pushes.end(), pushes->begin(), pushes->end());
      const Point tip = floe == c.b ? c.tip_of_a : c.tip_of_b;
      pressing.mouths.push_back({tip, into_floe(c, floe), &c});
    } else {
      pressing.pushes.push_back({c.centre_of_pressure(), force});
    }
    if (before) add_mouth_between(*before, c, floe, dt, pressing.mouths);
    before = &c;
  }
  for (const Push& push : pressing.pushes) pressing.most += 0.5 * length(push.force);
  return pressing;
}

/// The crack from a mouth along a direction, where it can run: it does not pare, and it is no less than a
/// share of its way to F_max.
std::optional<Candidate> candidate_of(const Setup& setup, const Population& population, BodyIndex floe,
                                      const Pressing& pressing, const Mouth& mouth, Vector direction,
                                      double least_share) {
  const dynamics::Bodies& bodies = population.bodies;
  const fracture::Opening opening = fracture::opening_of(pressing.pushes, mouth.point, direction);
  const fracture::Ice& ice = ice_of_body(setup, population, floe);
  if (opening.force() <= 0 ||
      opening.force() < least_share * fracture::lefm_splitting_force(ice, ice.thickness, ice.thickness))
    return std::nullopt;
  Candidate candidate;
  candidate.mouth = mouth;
  fracture::FailureCriteria& criteria = candidate.criteria;
  candidate.path_in_body =
      crack_through(bodies, floe, mouth.point, direction, geometry::CrackReach::kFirstEdge);
  if (candidate.path_in_body.length_in_ice <= 0) return std::nullopt;
  measure_crack(bodies, floe, candidate.path_in_body, criteria);
  criteria.flank_forces[0] = opening.left;
  criteria.flank_forces[1] = opening.right;
  criteria.opening_force = opening.force();
  criteria.opening_capacity =
      fracture::lefm_splitting_force(ice, criteria.crack_length, criteria.crack_width);
  criteria.fracture_toughness = ice.fracture_toughness;
  if (!(candidate.share() >= least_share)) return std::nullopt;
  measure_sides(setup, population, floe, candidate.path_in_body, criteria);
  criteria.opening_capacity =
      fracture::lefm_splitting_force(ice, criteria.crack_length, criteria.crack_width);
  if (criteria.pares || !(candidate.share() >= least_share)) return std::nullopt;
  return candidate;
}

/// The crack that is nearest to running.
std::optional<Candidate> first_to_run(const Setup& setup, const Population& population, BodyIndex floe,
                                      const Pressing& pressing, double least_share) {
  std::optional<Candidate> best;
  for (const Mouth& mouth : pressing.mouths) {
    if (mouth.contact->record->was_refused) continue;
    for (int k = 0; k <= 2 * kDirectionsASide; ++k) {  // 0, 15°, −15°, 30°, …
      const double turn = ((k + 1) / 2) * (k % 2 == 0 ? -kBetweenDirections : kBetweenDirections);
      const Vector direction = rotate(geometry::Rotation::by(turn), mouth.direction);
      const double share = best ? std::max(least_share, best->share()) : least_share;
      auto candidate = candidate_of(setup, population, floe, pressing, mouth, direction, share);
      if (candidate && (!best || candidate->share() > best->share())) best = candidate;
    }
  }
  return best;
}

/// The split of a floe by one other body, where their contacts open a crack.
std::optional<PendingFracture> split_of(const Setup& setup, const Population& population,
                                        std::span<const Contact> contacts, BodyIndex floe) {
  const dynamics::Bodies& bodies = population.bodies;
  const fracture::Ice& ice = ice_of_body(setup, population, floe);
  const double size = floe_size(population, floe);
  if (size < breakable_size(setup, ice)) return std::nullopt;
  const Pressing pressing = press(setup, bodies, contacts, floe);
  // No crack is shorter than the ice is thick.
  if (pressing.mouths.empty() ||
      pressing.most < fracture::lefm_splitting_force(ice, ice.thickness, ice.thickness))
    return std::nullopt;
  const auto crack = first_to_run(setup, population, floe, pressing, 1);
  if (!crack) return std::nullopt;
  const Contact& c = *crack->mouth.contact;
  const BodyIndex by = other_of(c, floe);
  PendingFracture split;
  split.failure = fracture::Failure::kSplit;
  split.criteria = crack->criteria;
  split.record = c.record;
  split.ship = population.is_ship(by) ? by : -1;
  split.by_floe = population.is_ship(by) ? kNoFloe : population.floe_of(by);
  split.floe = population.floe_of(floe);
  split.point_in_water = crack->mouth.point;
  split.normal = into_floe(c, floe);
  split.penetration = c.depth;
  split.crack_in_body = crack->path_in_body;
  split.criteria.floe_size = size;
  split.criteria.breakable_size = breakable_size(setup, ice);
  split.criteria.contact_force = length(force_on(c, floe, setup.scene.time.step));
  return split;
}

/// The contacts of the same two bodies as c, which is among them.
std::span<const Contact> contacts_beside(const std::vector<Contact>& contacts, const Contact& c) {
  const auto is_other = [&](const Contact& d) { return d.a != c.a || d.b != c.b; };
  const Contact* first = &c;
  const Contact* last = &c + 1;
  while (first != contacts.data() && !is_other(first[-1])) --first;
  while (last != contacts.data() + contacts.size() && !is_other(*last)) ++last;
  return {first, last};
}

/// Enters the forces that there were into a fracture that another rule decided.
void enter_true_forces(const Setup& setup, const Population& population, const std::vector<Contact>& contacts,
                       PendingFracture& pending) {
  const dynamics::Bodies& bodies = population.bodies;
  const auto c = std::ranges::find(contacts, pending.record, &Contact::record);
  if (c == contacts.end()) return;
  const fracture::Ice& ice = ice_of_body(setup, population, c->b);
  fracture::FailureCriteria& criteria = pending.criteria;
  criteria.contact_force = length(force_on(*c, c->b, setup.scene.time.step));
  const Pressing pressing = press(setup, bodies, contacts_beside(contacts, *c), c->b);
  if (setup.scene.fracture.splitting == fracture::SplittingModel::kLefm) {
    const auto crack = first_to_run(setup, population, c->b, pressing, 0);
    if (!crack) return;
    criteria.crack_length = crack->criteria.crack_length;
    criteria.crack_width = crack->criteria.crack_width;
    std::ranges::copy(crack->criteria.flank_forces, criteria.flank_forces);
    criteria.opening_force = crack->criteria.opening_force;
    criteria.opening_capacity = crack->criteria.opening_capacity;
  } else if (criteria.crack_length > 0) {
    if (pending.failure ==
        fracture::Failure::kBend)  // only now: most bends that are pending do not come about
      measure_crack_and_sides(setup, population, c->b, pending.crack_in_body, criteria);
    const fracture::Opening opening = fracture::opening_of(pressing.pushes, c->middle(), c->normal);
    criteria.flank_forces[0] = opening.left;
    criteria.flank_forces[1] = opening.right;
    criteria.opening_force = opening.force();
    criteria.opening_capacity =
        fracture::lefm_splitting_force(ice, criteria.crack_length, criteria.crack_width);
  }
  criteria.fracture_toughness = ice.fracture_toughness;
}

}  // namespace

void find_splits(const Setup& setup, const Population& population, StepData& step) {
  for (PendingFracture& pending : step.fractures)
    enter_true_forces(setup, population, step.contacts, pending);
  if (setup.scene.fracture.splitting != fracture::SplittingModel::kLefm) return;
  std::vector<PendingFracture> splits;
  for (std::size_t i = 0; i < step.contacts.size();) {
    const std::span<const Contact> contacts = contacts_beside(step.contacts, step.contacts[i]);
    i += contacts.size();
    for (const BodyIndex body : {contacts.front().a, contacts.front().b}) {
      if (population.is_ship(body)) continue;
      if (auto split = split_of(setup, population, contacts, body)) splits.push_back(std::move(*split));
    }
  }
  // Before the bends: a bend stops the force at V_b, so what splits at it has split before.
  step.fractures.insert(step.fractures.begin(), splits.begin(), splits.end());
}

}  // namespace polynya::simulation
