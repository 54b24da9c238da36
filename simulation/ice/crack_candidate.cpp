#include "simulation/ice/crack_candidate.hpp"

#include <algorithm>

#include "fracture/splitting.hpp"

namespace polynya::simulation {
namespace {

using geometry::CrackPath;
using geometry::Point;
using geometry::Vector;

/// A straight crack from a mouth, in the floe's frame.
struct StraightCrack {
  Point from;               ///< the mouth, or where the body ends ahead of it [m]
  Vector direction;         ///< unit
  Point first_ice;          ///< [m]
  double to_first_ice = 0;  ///< from the mouth [m]
  CrackPath path;
};

/// A crack begins where the body that opens it ends, at ice that is not crushed, and does not lead into that
/// body. None where it would.
std::optional<StraightCrack> straight_crack(const dynamics::Bodies& bodies, BodyIndex floe, const Mouth& mouth,
                                            Vector direction) {
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

/// Of a crack through holes: enters the length and width of the stretch of ice that takes the greatest force;
/// `least_width` [m] is the width that each has at least.
void measure_hardest(const dynamics::Bodies& bodies, BodyIndex floe, const fracture::Ice& ice,
                     const StraightCrack& crack, double least_width, fracture::FailureCriteria& criteria) {
  double most = 0;
  for (const CrackPath& ligament :
       ligaments_of(*bodies.boundary[floe], crack.from, crack.direction, kCrackMargin, crack.path)) {
    fracture::FailureCriteria own;
    measure_crack(bodies, floe, ligament, own);
    own.crack_width = std::max(own.crack_width, least_width);
    const double force = fracture::lefm_splitting_force(ice, own.crack_length, own.crack_width);
    if (force < most) continue;
    most = force;
    criteria.crack_length = own.crack_length;
    criteria.crack_width = own.crack_width;
  }
}

/// The crack to the free edge beside a straight one, that runs in its place.
std::optional<CrackPath> turning_crack(const geometry::Boundary& boundary, const StraightCrack& straight,
                                       const geometry::Arm& arm) {
  const fracture::TurningCrack& shape = fracture::kTurningCrack;
  const auto turn = geometry::Rotation::by(arm.is_left ? shape.turn : -shape.turn);
  const Point knee = straight.first_ice + shape.straight * arm.width * straight.direction;
  auto path =
      turned_path(boundary, straight.path, straight.first_ice, knee, rotate(turn, straight.direction), kCrackMargin);
  if (path && path->length_in_ice > (shape.straight + shape.most_on) * arm.width) return std::nullopt;
  return path;
}

bool leaves_strip(const CrackPath& path, const geometry::CrackSides& sides) {
  return fracture::leaves_strip(path.length_in_ice, sides.left, sides.right);
}

/// Turns a candidate to the free edge beside it. Returns whether it can run there.
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
  candidate.criteria.crack_width = 2 * arm->width;
  candidate.criteria.opening_capacity = fracture::turning_crack_force(ice_of_body(setup, population, floe), arm->width);
  return !leaves_strip(*path, sides);
}

}  // namespace

void enter_opening(const fracture::Opening& opening, const fracture::Ice& ice, fracture::FailureCriteria& criteria) {
  criteria.flank_forces[0] = opening.left;
  criteria.flank_forces[1] = opening.right;
  criteria.opening_force = opening.force();
  criteria.opening_capacity = fracture::lefm_splitting_force(ice, criteria.crack_length, criteria.crack_width);
}

std::optional<CrackCandidate> crack_candidate(const Setup& setup, const Population& population, BodyIndex floe,
                                              const PressedFloe& pressed, const Mouth& mouth, Vector direction,
                                              double least_share) {
  const dynamics::Bodies& bodies = population.bodies;
  const fracture::Opening opening = fracture::opening_of(pressed.pushes, mouth.point, direction);
  const fracture::Ice& ice = ice_of_body(setup, population, floe);
  const double least_force = limits_of_body(setup, population, floe).least_splitting_force;
  if (opening.force() <= 0 || opening.force() < least_share * least_force) return std::nullopt;
  const auto straight = straight_crack(bodies, floe, mouth, direction);
  if (!straight) return std::nullopt;
  CrackCandidate candidate;
  candidate.mouth = mouth;
  candidate.begins_at = mouth.point + straight->to_first_ice * direction;
  candidate.path_in_body = straight->path;
  fracture::FailureCriteria& criteria = candidate.criteria;
  const bool crosses_holes = straight->path.stretches > 1;
  if (crosses_holes)
    measure_hardest(bodies, floe, ice, *straight, 0, criteria);
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
    if (crosses_holes)
      measure_hardest(bodies, floe, ice, *straight, mean_width_beside(straight->path, sides), criteria);
    criteria.opening_capacity = fracture::lefm_splitting_force(ice, criteria.crack_length, criteria.crack_width);
  }
  if (criteria.pares || !(candidate.share() >= least_share)) return std::nullopt;
  return candidate;
}

}  // namespace polynya::simulation
