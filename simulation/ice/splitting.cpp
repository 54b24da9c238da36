#include "fracture/splitting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "simulation/ice/crack_candidate.hpp"
#include "simulation/ice/split_instant.hpp"
#include "simulation/ship/pressing.hpp"
#include "simulation/ship/ship_contact_load.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;
using geometry::Vector;

/// Cracks are tried along a contact's normal and this many directions to either side of it, 15° apart.
constexpr int kDirectionsASide = 5;
constexpr double kBetweenDirections = std::numbers::pi / 12;  // [rad]

/// The crack that is nearest to running.
std::optional<CrackCandidate> first_to_run(const Setup& setup, const Population& population, BodyIndex floe,
                                           const PressedFloe& pressed, double least_share) {
  std::optional<CrackCandidate> best;
  for (const Mouth& mouth : pressed.mouths) {
    if (mouth.contact->record->was_refused) continue;
    for (int k = 0; k <= 2 * kDirectionsASide; ++k) {  // 0, 15°, −15°, 30°, …
      const int from_normal = (k + 1) / 2;
      const double turn = from_normal * (k % 2 == 0 ? -kBetweenDirections : kBetweenDirections);
      const Vector direction = rotate(geometry::Rotation::by(turn), mouth.direction);
      const double share = best ? std::max(least_share, best->share()) : least_share;
      auto candidate = crack_candidate(setup, population, floe, pressed, mouth, direction, share);
      if (candidate && (!best || candidate->share() > best->share())) best = candidate;
    }
  }
  return best;
}

/// The split of a floe by one other body, where their contacts open a crack.
std::optional<PendingFracture> split_of(const Setup& setup, const Population& population,
                                        std::span<const Contact> contacts, BodyIndex floe, PressedFloe& pressed) {
  const IceLimits& limits = limits_of_body(setup, population, floe);
  const double size = floe_size(population, floe);
  if (size < limits.breakable_size) return std::nullopt;
  press(setup, population.bodies, contacts, floe, pressed);
  if (pressed.most < limits.least_splitting_force) return std::nullopt;
  find_mouths(floe, pressed);
  const auto crack = first_to_run(setup, population, floe, pressed, 1);
  if (!crack) return std::nullopt;
  const Contact& c = *crack->mouth.contact;
  const BodyIndex by = other_of(c, floe);
  PendingFracture split;
  split.failure = fracture::Failure::kSplit;
  split.criteria = crack->criteria;
  split.record = c.record;
  split.ship = population.hull_or_none(by);
  split.by_floe = population.floe_or_none(by);
  split.floe = population.floe_of(floe);
  split.point_in_water = crack->begins_at;
  split.normal = into_floe(c, floe);
  split.penetration = c.depth;
  split.crack_in_body = crack->path_in_body;
  split.criteria.floe_size = size;
  split.criteria.breakable_size = limits.breakable_size;
  split.criteria.contact_force = length(force_on(c, floe, setup.step));
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
  criteria.contact_force = length(force_on(*c, c->b, setup.step));
  PressedFloe pressed;
  press(setup, bodies, contacts_beside(contacts, *c), c->b, pressed);
  if (setup.scene.fracture.splitting == fracture::SplittingModel::kLefm) {
    find_mouths(c->b, pressed);
    const auto crack = first_to_run(setup, population, c->b, pressed, 0);
    if (!crack) return;
    criteria.crack_length = crack->criteria.crack_length;
    criteria.crack_width = crack->criteria.crack_width;
    std::ranges::copy(crack->criteria.flank_forces, criteria.flank_forces);
    criteria.opening_force = crack->criteria.opening_force;
    criteria.opening_capacity = crack->criteria.opening_capacity;
  } else if (criteria.crack_length > 0) {
    if (pending.failure == fracture::Failure::kBend)  // only now: most bends that are pending do not come about
      measure_crack_and_sides(setup, population, c->b, pending.crack_in_body, criteria);
    const fracture::Opening opening = fracture::opening_of(pressed.pushes, c->middle(), c->normal);
    enter_opening(opening, ice, criteria);
  }
  criteria.fracture_toughness = ice.fracture_toughness;
}

}  // namespace

void find_splits(const Setup& setup, const Population& population, const std::vector<Contact>& all,
                 std::vector<PendingFracture>& splits) {
  splits.clear();
  if (setup.scene.fracture.splitting != fracture::SplittingModel::kLefm) return;
  PressedFloe pressed;  // its memory serves all pairs
  for (std::size_t i = 0; i < all.size();) {
    const std::span<const Contact> contacts = contacts_beside(all, all[i]);
    i += contacts.size();
    const double bound = opening_bound(setup, contacts);
    for (const BodyIndex body : {contacts.front().a, contacts.front().b}) {
      if (population.is_hull(body)) continue;
      if (bound < limits_of_body(setup, population, body).least_splitting_force) continue;
      if (auto split = split_of(setup, population, contacts, body, pressed)) splits.push_back(*split);
    }
  }
}

void enter_splits(const Setup& setup, const Population& population, StepData& step) {
  for (PendingFracture& pending : step.fractures) enter_true_forces(setup, population, step.contacts, pending);
  // Before the bends: a bend stops the force at V_b, so what splits at it has split before.
  step.fractures.insert(step.fractures.begin(), step.splits.begin(), step.splits.end());
}

}  // namespace polynya::simulation
