#include "fracture/splitting.hpp"

#include <algorithm>
#include <numbers>
#include <optional>
#include <span>

#include "simulation/ice/crack.hpp"
#include "simulation/ice/split_instant.hpp"
#include "simulation/ship/hull_contact_load.hpp"
#include "simulation/ship/pressing.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;
using geometry::Vector;

/// A crack that a body may open in a floe, with its opening force and capacity. Its share is the opening force divided
/// by the capacity [-]; the crack runs from 1 on.
struct CrackCandidate {
  CrackMouth mouth;
  /// Place at which the crack begins: the edge of the ice that the body has not crushed, in the water frame [m].
  geometry::Point begins_at;
  geometry::CrackPath path_in_body;
  fracture::FailureCriteria criteria;
  double share() const { return criteria.opening_force / criteria.opening_capacity; }
};

using geometry::CrackPath;
using geometry::Point;

/// A straight crack from a mouth, in the floe's body frame.
struct StraightCrack {
  Point from;               ///< the mouth, or the place ahead of it where the body ends [m]
  Vector direction;         ///< unit vector
  Point first_ice;          ///< first point of ice on the crack [m]
  double to_first_ice = 0;  ///< distance of that point from the mouth [m]
  CrackPath path;
};

/// Returns the straight crack from a mouth. A crack begins where the body that opens it ends, at ice that is not
/// crushed. Returns nullopt if there is no ice in its direction, if the path would begin behind that body, or if the
/// crack would lead into the body again farther on.
std::optional<StraightCrack> straight_crack(const dynamics::Bodies& bodies, BodyIndex floe, const CrackMouth& mouth) {
  const Vector direction = mouth.direction;
  const BodyIndex by = other_of(*mouth.contact, floe);
  const geometry::Boundary& boundary = *bodies.boundary[floe];
  const geometry::Pose pose = dynamics::water_from_body(bodies, floe);
  const geometry::Pose pose_of_by = dynamics::water_from_body(bodies, by);
  StraightCrack crack{inverse_transform(pose, mouth.point), rotate_back(pose.rotation, direction), {}, 0, {}};
  const auto find_path = [&] {
    crack.path = crack_path(boundary, crack.from, crack.direction, kCrackMargin, geometry::CrackReach::kFirstEdge);
    const double on = dot(crack.path.start - crack.from, crack.direction) + kCrackMargin;
    crack.first_ice = crack.from + std::max(0.0, on) * crack.direction;
    return crack.path.length_in_ice > 0;
  };
  if (!find_path()) return std::nullopt;
  const geometry::Passage in_body = passage_through(*bodies.boundary[by], inverse_transform(pose_of_by, mouth.point),
                                                    rotate_back(pose_of_by.rotation, direction));
  const Point from_mouth = crack.from;
  const auto along = [&](Point p) { return dot(p - from_mouth, crack.direction); };
  if (along(crack.first_ice) < in_body.ahead) {
    crack.from = from_mouth + in_body.ahead * crack.direction;
    if (!find_path()) return std::nullopt;
    const bool cuts_behind = along(crack.path.start) < in_body.behind - 2 * kCrackMargin;
    if (cuts_behind) return std::nullopt;
  }
  crack.to_first_ice = along(crack.first_ice);
  if (in_body.again < along(crack.path.end) - 2 * kCrackMargin) return std::nullopt;
  return crack;
}

/// Returns the length and width of the stretch of ice with the largest capacity, for a crack that crosses holes. Each
/// stretch is assumed to be at least `least_width` wide [m].
fracture::FailureCriteria hardest_stretch(const dynamics::Bodies& bodies, BodyIndex floe, const fracture::Ice& ice,
                                          const StraightCrack& crack, double least_width) {
  fracture::FailureCriteria hardest;
  double most = 0;
  for (const CrackPath& ligament :
       ligaments_of(*bodies.boundary[floe], crack.from, crack.direction, kCrackMargin, crack.path)) {
    fracture::FailureCriteria own;
    measure_crack(bodies, floe, ligament, own);
    own.crack_width = std::max(own.crack_width, least_width);
    const double force = fracture::lefm_splitting_force(ice, own.crack_length, own.crack_width);
    if (force < most) continue;
    most = force;
    hardest = own;
  }
  return hardest;
}

/// Returns the crack that turns to the free edge beside a straight one and runs instead of it, or nullopt if it does
/// not reach that edge.
std::optional<CrackPath> turning_crack(const geometry::Boundary& boundary, const StraightCrack& straight,
                                       const geometry::Arm& arm) {
  const fracture::TurningCrack& shape = fracture::kTurningCrack;
  const auto turn = geometry::Rotation::by(arm.is_left ? shape.turn : -shape.turn);
  const Point knee = straight.first_ice + shape.straight * arm.width * straight.direction;
  auto path =
      turned_path(boundary, straight.path, straight.first_ice, {knee, rotate(turn, straight.direction)}, kCrackMargin);
  if (path && path->length_in_ice > (shape.straight + shape.most_on) * arm.width) return std::nullopt;
  return path;
}

/// Returns true if a crack would leave a strip that is too narrow, so that it turns to the free edge.
bool leaves_strip(const CrackPath& path, const geometry::CrackSides& sides) {
  return fracture::leaves_strip(path.length_in_ice, sides.left, sides.right);
}

/// Turns a candidate to the free edge beside it. Returns false if no crack can run there.
bool turn_to_edge(const Setup& setup, const Population& population, BodyIndex floe, const StraightCrack& straight,
                  CrackCandidate& candidate) {
  const geometry::Boundary& boundary = *population.bodies.boundary[floe];
  const auto arm = arm_beside(boundary, straight.first_ice, straight.direction, fracture::kTurningCrack.peak);
  if (!arm) return false;
  const auto path = turning_crack(boundary, straight, *arm);
  if (!path) return false;
  candidate.path_in_body = *path;
  candidate.criteria.crack_length = path->length_in_ice;
  const geometry::CrackSides sides = measure_sides(setup, population, floe, *path, candidate.criteria);
  candidate.criteria.crack_width = 2 * arm->width;  // W is twice the width of the ice on the narrower side
  candidate.criteria.opening_capacity = fracture::turning_crack_force(ice_of_body(setup, population, floe), arm->width);
  return !leaves_strip(*path, sides);
}

/// Sets the opening force of a crack, and its capacity F_max for the length and width measured so far.
void enter_opening(const fracture::Opening& opening, const fracture::Ice& ice, fracture::FailureCriteria& criteria) {
  criteria.flank_forces[0] = opening.left;
  criteria.flank_forces[1] = opening.right;
  criteria.opening_force = opening.force();
  criteria.opening_capacity = fracture::lefm_splitting_force(ice, criteria.crack_length, criteria.crack_width);
}

/// Returns the crack from a mouth along its direction, or nullopt if it cannot run: it would leave a sliver, or its
/// opening force is less than `least_share` of its capacity F_max. A crack that would leave a strip turns to the free
/// edge beside it. A crack that crosses holes must break each stretch of ice separately, so the stretch with the
/// largest capacity decides.
std::optional<CrackCandidate> crack_candidate(const Setup& setup, const Population& population,
                                              const PressedFloe& pressed, const CrackMouth& mouth, double least_share) {
  const BodyIndex floe = pressed.floe;
  const Vector direction = mouth.direction;
  const dynamics::Bodies& bodies = population.bodies;
  const fracture::Opening opening = fracture::opening_of(pressed.pushes, mouth.point, direction);
  const fracture::Ice& ice = ice_of_body(setup, population, floe);
  const double least_force = limits_of_body(setup, population, floe).least_splitting_force;
  if (opening.force() <= 0 || opening.force() < least_share * least_force) return std::nullopt;
  const auto straight = straight_crack(bodies, floe, mouth);
  if (!straight) return std::nullopt;
  CrackCandidate candidate;
  candidate.mouth = mouth;
  candidate.begins_at = mouth.point + straight->to_first_ice * direction;
  candidate.path_in_body = straight->path;
  fracture::FailureCriteria& criteria = candidate.criteria;
  const bool crosses_holes = straight->path.stretches > 1;
  const auto enter_hardest = [&](double least_width) {
    const fracture::FailureCriteria hardest = hardest_stretch(bodies, floe, ice, *straight, least_width);
    criteria.crack_length = hardest.crack_length;
    criteria.crack_width = hardest.crack_width;
  };
  if (crosses_holes)
    enter_hardest(0);
  else
    measure_crack(bodies, floe, straight->path, criteria);
  enter_opening(opening, ice, criteria);
  criteria.fracture_toughness = ice.fracture_toughness;
  if (!(candidate.share() >= least_share)) return std::nullopt;
  const geometry::CrackSides sides = measure_sides(setup, population, floe, straight->path, criteria);
  if (std::min(sides.left, sides.right) <= 0) return std::nullopt;
  if (leaves_strip(straight->path, sides)) {
    if (!turn_to_edge(setup, population, floe, *straight, candidate)) return std::nullopt;
  } else {
    if (crosses_holes) enter_hardest(mean_width_beside(straight->path, sides));
    criteria.opening_capacity = fracture::lefm_splitting_force(ice, criteria.crack_length, criteria.crack_width);
  }
  if (criteria.leaves_sliver || !(candidate.share() >= least_share)) return std::nullopt;
  return candidate;
}

/// Number of directions on either side of a mouth's own direction in which cracks are tried. With more directions the
/// weakest crack is found more closely; the time grows in proportion.
constexpr int kDirectionsASide = 5;
/// Angle between these directions, 15° [rad], so that cracks are tried up to 75° to either side.
constexpr double kBetweenDirections = std::numbers::pi / 12;

/// Copies the measures and forces of a crack.
void enter_crack(const fracture::FailureCriteria& crack, fracture::FailureCriteria& criteria) {
  criteria.crack_length = crack.crack_length;
  criteria.crack_width = crack.crack_width;
  std::ranges::copy(crack.flank_forces, criteria.flank_forces);
  criteria.opening_force = crack.opening_force;
  criteria.opening_capacity = crack.opening_capacity;
  criteria.fracture_toughness = crack.fracture_toughness;
}

/// Returns the candidate with the largest opening force over capacity, or nullopt if none reaches `least_share`.
std::optional<CrackCandidate> first_to_run(const Setup& setup, const Population& population, const PressedFloe& pressed,
                                           double least_share) {
  std::optional<CrackCandidate> best;
  for (const CrackMouth& mouth : pressed.mouths) {
    if (mouth.contact->record->was_refused) continue;
    for (int k = 0; k <= 2 * kDirectionsASide; ++k) {  // 0, 15°, −15°, 30°, …
      const int from_normal = (k + 1) / 2;
      const double turn = from_normal * (k % 2 == 0 ? -kBetweenDirections : kBetweenDirections);
      const CrackMouth turned{mouth.point, rotate(geometry::Rotation::by(turn), mouth.direction), mouth.contact};
      const double share = best ? std::max(least_share, best->share()) : least_share;
      auto candidate = crack_candidate(setup, population, pressed, turned, share);
      if (candidate && (!best || candidate->share() > best->share())) best = candidate;
    }
  }
  return best;
}

/// Returns the split of a floe by one other body, or nullopt if their contacts open no crack. `contacts` are all
/// contacts of the two bodies.
std::optional<PendingFracture> split_of(const Setup& setup, const Step& step, const Population& population,
                                        std::span<const Contact> contacts, PressedFloe& pressed) {
  const BodyIndex floe = pressed.floe;
  const IceLimits& limits = limits_of_body(setup, population, floe);
  if (floe_size(population, floe) < limits.breakable_size) return std::nullopt;
  press(setup, step, population.bodies, contacts, pressed);
  if (pressed.most < limits.least_splitting_force) return std::nullopt;
  find_mouths(pressed);
  const auto crack = first_to_run(setup, population, pressed, 1);
  if (!crack) return std::nullopt;
  PendingFracture split = split_by(setup, step, population, *crack->mouth.contact, floe);
  split.point_in_water = crack->begins_at;
  split.crack_in_body = crack->path_in_body;
  enter_crack(crack->criteria, split.criteria);
  return split;
}

/// Returns the contacts of the same two bodies as c, which is an element of `contacts`.
std::span<const Contact> contacts_beside(const std::vector<Contact>& contacts, const Contact& c) {
  const auto is_other = [&](const Contact& d) { return d.a != c.a || d.b != c.b; };
  const Contact* first = &c;
  const Contact* last = &c + 1;
  while (first != contacts.data() && !is_other(first[-1])) --first;
  while (last != contacts.data() + contacts.size() && !is_other(*last)) ++last;
  return {first, last};
}

/// Sets the true forces of the step in the criteria of a fracture that another rule decided, for the records.
void enter_true_forces(const Setup& setup, const Step& step, const Population& population,
                       const std::vector<Contact>& contacts, PendingFracture& pending) {
  const dynamics::Bodies& bodies = population.bodies;
  const auto c = std::ranges::find(contacts, pending.record, &Contact::record);
  if (c == contacts.end()) return;
  const fracture::Ice& ice = ice_of_body(setup, population, c->b);
  fracture::FailureCriteria& criteria = pending.criteria;
  criteria.contact_force = length(force_on(*c, c->b, step.length));
  PressedFloe pressed{.floe = c->b};
  press(setup, step, bodies, contacts_beside(contacts, *c), pressed);
  if (setup.scene.fracture.splitting == fracture::SplittingModel::kLefm) {
    find_mouths(pressed);
    const auto crack = first_to_run(setup, population, pressed, 0);
    if (!crack) return;
    enter_crack(crack->criteria, criteria);
  } else if (criteria.crack_length > 0) {
    // Measured only here, because most bends that were pending before the solver do not happen.
    if (pending.failure == fracture::Failure::kBend)
      measure_crack_and_sides(setup, population, c->b, pending.crack_in_body, criteria);
    const fracture::Opening opening = fracture::opening_of(pressed.pushes, c->middle(), c->normal);
    enter_opening(opening, ice, criteria);
  }
  criteria.fracture_toughness = ice.fracture_toughness;
}

}  // namespace

void find_splits(const Setup& setup, const Step& step, const Population& population, const std::vector<Contact>& all,
                 std::vector<PendingFracture>& splits) {
  splits.clear();
  if (setup.scene.fracture.splitting != fracture::SplittingModel::kLefm) return;
  PressedFloe pressed;  // declared here so that all pairs use the same memory
  for (std::size_t i = 0; i < all.size();) {
    const std::span<const Contact> contacts = contacts_beside(all, all[i]);
    i += contacts.size();
    const double bound = opening_bound(setup, step, contacts);
    for (const BodyIndex body : {contacts.front().a, contacts.front().b}) {
      if (population.is_hull(body)) continue;
      if (bound < limits_of_body(setup, population, body).least_splitting_force) continue;
      pressed.floe = body;
      if (auto split = split_of(setup, step, population, contacts, pressed)) splits.push_back(*split);
    }
  }
}

void enter_splits(const Setup& setup, const Step& step, const Population& population, StepData& data) {
  for (PendingFracture& pending : data.fractures) enter_true_forces(setup, step, population, data.contacts, pending);
  // Splits are inserted before the bends. A bend limits the force to V_b, so a floe that splits at that force has split
  // before it bends.
  data.fractures.insert(data.fractures.begin(), data.splits.begin(), data.splits.end());
}

}  // namespace polynya::simulation
