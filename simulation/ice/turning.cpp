#include "simulation/ice/turning.hpp"

#include <algorithm>

#include "fracture/beam.hpp"
#include "fracture/turning_cusp.hpp"
#include "geometry/exact/predicates.hpp"

namespace polynya::simulation {
namespace {

using geometry::Point;
using geometry::Vector;

/// Returns a piece as a plate that rotates about its far edge: the line across the unit vector `ahead` through the
/// point of the piece that is farthest in that direction. `ahead` is in the frame of the piece.
fracture::TurningCusp turning(const geometry::Polygon& piece, Vector ahead) {
  const auto along = [&](Point p) { return dot(p - Point{}, ahead); };
  const auto ends = std::ranges::minmax_element(piece.outer, {}, along);
  const Point near = *ends.min;
  const Point far = *ends.max;
  const geometry::Rotation ahead_from_body{ahead.x, -ahead.y};
  const fracture::PlaneMoments moments =
      fracture::moments_of(piece, {Point{} - rotate(ahead_from_body, far - Point{}), ahead_from_body});
  return {moments.area, along(far) - along(near), moments.xx};
}

/// Returns the direction in which the hull pushes a cusp, in the body frame of the floe that bends: the contact's
/// normal.
Vector ahead_of(const Population& population, const PendingFracture& bend) {
  return rotate_back(population.bodies.rotation[population.body_of(bend.floe)], bend.normal);
}

/// An impulse on a hull, and its arm from the hull's centre of mass, both in the water frame.
struct HullImpulse {
  BodyIndex ship = 0;
  Vector arm;      ///< vector from the hull's centre of mass to the point of the impulse [m]
  Vector impulse;  ///< impulse on the hull [N s]
};

/// Applies an impulse to a hull that presses ice down, and adds it to the loads of the hull and to the accounts. A hull
/// of prescribed motion keeps its velocity; the impulse is only recorded.
void brake(const HullImpulse& given, dynamics::Bodies& bodies, HullBooks books) {
  const auto [ship, arm, impulse] = given;
  const double turned = cross(arm, impulse);
  const Vector in_ship = rotate_back(bodies.rotation[ship], impulse);
  books.loads.submerged.impulse += {in_ship.x, in_ship.y, turned};
  if (bodies.inverse_mass[ship] == 0) return;
  books.audit.energy.submersion -= push(bodies, ship, impulse, turned);
  books.audit.momentum.water += impulse;
  books.audit.impulses += length(impulse);
}

/// Returns the change of the speed of a point of a ship along a direction due to an impulse at that point [m/s]. `arm`
/// leads from the ship's centre of mass to the point.
double speed_by(const dynamics::Bodies& bodies, BodyIndex ship, Vector arm, Vector direction, Vector impulse) {
  return dot(direction,
             bodies.inverse_mass[ship] * impulse + cross(bodies.inverse_moment[ship] * cross(arm, impulse), arm));
}

/// Returns the floe under a hull that covers a point of the water, or kNoFloe. Of several floes it returns the one that
/// went under last.
FloeId submerged_below(const Population& population, Point p) {
  const dynamics::Bodies& bodies = population.bodies;
  const auto found =
      std::find_if(population.submerged.rbegin(), population.submerged.rend(), [&](const SubmergedPiece& piece) {
        const BodyIndex body = population.body_of(piece.floe);
        return distance(bodies.position[body], p) <= bodies.bounding_radius[body] &&
               contains(population.floes[piece.floe].shape.polygon,
                        inverse_transform(dynamics::water_from_body(bodies, body), p));
      });
  return found == population.submerged.rend() ? kNoFloe : found->floe;
}

/// Distance outside the edge of a cusp at which its neighbour is looked for, as a fraction of the cusp's radius [-].
/// Smaller values find no neighbour behind gaps from rounding. Larger values may miss narrow neighbours.
constexpr double kBeside = 0.01;

/// Returns the neighbour of the edge of a cusp from a to b: the ice sheet for an edge on the cusp's circle, and for the
/// others an older cusp or open water. The outline of the cusp is counter-clockwise in its floe's body frame. The x
/// axis of the result's frame is the direction in which the hull pushes the cusp (ahead_of).
fracture::DeckEdge deck_edge(const Setup& setup, const Population& population, const PendingFracture& bend, Point a,
                             Point b) {
  const Vector ahead = ahead_of(population, bend);
  const Point middle = a + 0.5 * (b - a);
  const double rounding = 1e-9 * bend.cusp_radius;
  const double arc = bend.cusp_radius - setup.scene.fracture.cusp_sagitta - rounding;
  if (distance(middle, bend.first_touch_in_body) >= arc) return {fracture::Beside::kSheet};
  const Vector out = -(kBeside * bend.cusp_radius / distance(a, b)) * perpendicular(b - a);
  const geometry::Pose pose = dynamics::water_from_body(population.bodies, population.body_of(bend.floe));
  const FloeId older = submerged_below(population, transform(pose, middle + out));
  if (older == kNoFloe) return {fracture::Beside::kWater};
  const geometry::Pose of_older = dynamics::water_from_body(population.bodies, population.body_of(older));
  const auto along = [&](Point p) { return dot(inverse_transform(pose, transform(of_older, p)) - Point{}, ahead); };
  const auto ends = std::ranges::minmax_element(population.floes[older].shape.polygon.outer, {}, along);
  return {fracture::Beside::kOlderCusp, along(*ends.max), along(*ends.max) - along(*ends.min)};
}

/// Returns the deck of a cusp that breaks off, from its outline in the body frame of its floe.
fracture::Deck deck_of(const Setup& setup, const Population& population, const PendingFracture& bend,
                       const geometry::Ring& piece) {
  const Vector ahead = ahead_of(population, bend);
  const geometry::Rotation ahead_from_body{ahead.x, -ahead.y};
  std::vector<Point> outline;
  std::vector<fracture::DeckEdge> edges;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    outline.push_back(Point{} + rotate(ahead_from_body, piece[i] - Point{}));
    edges.push_back(deck_edge(setup, population, bend, piece[i], piece[i + 1 < piece.size() ? i + 1 : 0]));
  }
  return fracture::deck_of(ice_of_floe(setup, population, bend.floe), setup.scene.water.water,
                           bend.driven_edge.hull_angle, outline, edges);
}

/// Turns a cusp further by the displacement of its hull in the step, and applies the force of the missing water to the
/// hull: its part along the normal pushes the hull ahead, and its part down on the edge brakes the hull.
void press(const Setup& setup, const Step& step, PressedDeck& pressed, dynamics::Bodies& bodies, HullBooks books) {
  const BodyIndex ship = pressed.ship;
  const Vector arm = rotate(bodies.rotation[ship], pressed.arm_in_ship);
  const Vector normal = rotate(bodies.rotation[ship], pressed.normal_in_ship);
  const Vector horizontal = rotate(bodies.rotation[ship], pressed.horizontal_in_ship);
  const Vector through_water =
      dynamics::velocity_at(bodies, ship, arm) - setup.current.velocity_at(bodies.position[ship]);
  const double speed = std::max(0.0, dot(normal, through_water));
  const fracture::HullAdvance advance{dot(normal, horizontal), speed * step.length, step.length};
  const fracture::DeckForces forces =
      fracture::turn_deck(pressed.deck, setup.scene.water.water, advance, pressed.state);
  if (speed == 0) return;
  const Vector impulse = step.length * (forces.ahead * normal - forces.down * horizontal);
  const double slowed = -speed_by(bodies, ship, arm, normal, impulse);  // it stops a ship and never reverses it
  brake({ship, arm, slowed > speed ? (speed / slowed) * impulse : impulse}, bodies, books);
}

/// Gives the edge of a cusp as much of its remaining impulse as the largest force allows in a step, and brakes the hull
/// by it.
void press(const Step& step, AcceleratingCusp& cusp, dynamics::Bodies& bodies, HullBooks books) {
  const geometry::Rotation of_ship = bodies.rotation[cusp.ship];
  const Vector arm = rotate(of_ship, cusp.arm_in_ship);
  const double given = std::min(cusp.impulse_left, cusp.largest_force * step.length);
  cusp.impulse_left -= given;
  cusp.distance_left -= step.length * std::max(0.0, dot(rotate(of_ship, cusp.normal_in_ship),
                                                        dynamics::velocity_at(bodies, cusp.ship, arm)));
  brake({cusp.ship, arm, -given * rotate(of_ship, cusp.horizontal_in_ship)}, bodies, books);
}

/// Returns true if the edge has reached the hull's speed, or if the hull has passed the cusp.
bool is_finished(const AcceleratingCusp& cusp) {
  return cusp.impulse_left <= 0 || cusp.distance_left <= 0;
}

}  // namespace

double pressed_mass(const Setup& setup, const Population& population, const PendingFracture& bend,
                    const geometry::CutResult& cut) {
  const fracture::Ice& ice = ice_of_floe(setup, population, bend.floe);
  const Vector ahead = ahead_of(population, bend);
  double mass = 0;
  for (const geometry::Piece& piece : cut.pieces) {
    if (piece.part != geometry::Part::kInside) continue;
    mass += fracture::edge_mass(ice, setup.scene.water.water, turning(piece.shape.polygon, ahead));
  }
  return mass;
}

void start_cusp(const Step& step, const PendingFracture& bend, double mass, Population& population, HullBooks books) {
  const DrivenEdge& edge = bend.driven_edge;
  const BodyIndex ship = bend.ship;
  if (edge.speed <= 0) return;
  dynamics::Bodies& bodies = population.bodies;
  const Vector arm = bend.point_in_water - bodies.position[ship];
  // The hull is slowed down by the impulse that it gives, because edge and hull then move on together.
  const double slowed = edge.speed_per_approach * speed_by(bodies, ship, arm, bend.normal, edge.horizontal);
  const double given = mass * edge.speed / (1 + mass * std::max(0.0, slowed));  // impulse down on the edge [N s]
  const geometry::Rotation of_ship = bodies.rotation[ship];
  AcceleratingCusp cusp{.ship = ship,
                        .arm_in_ship = rotate_back(of_ship, arm),
                        .normal_in_ship = rotate_back(of_ship, bend.normal),
                        .horizontal_in_ship = rotate_back(of_ship, edge.horizontal),
                        .impulse_left = given,
                        .largest_force = bend.criteria.bending_capacity,
                        .distance_left = bend.cusp_radius};
  press(step, cusp, bodies, books);
  if (!is_finished(cusp)) population.accelerating_cusps.push_back(cusp);
}

bool has_decks(const Setup& setup, const PendingFracture& bend) {
  return setup.has_flooding_decks && bend.driven_edge.speed > 0;
}

void add_decks(const Setup& setup, const PendingFracture& bend, const geometry::CutResult& cut,
               Population& population) {
  const dynamics::Bodies& bodies = population.bodies;
  const geometry::Rotation of_ship = bodies.rotation[bend.ship];
  for (const geometry::Piece& piece : cut.pieces) {
    if (piece.part != geometry::Part::kInside) continue;
    PressedDeck pressed{.ship = bend.ship,
                        .arm_in_ship = rotate_back(of_ship, bend.point_in_water - bodies.position[bend.ship]),
                        .normal_in_ship = rotate_back(of_ship, bend.normal),
                        .horizontal_in_ship = rotate_back(of_ship, bend.driven_edge.horizontal),
                        .deck = deck_of(setup, population, bend, piece.shape.polygon.outer),
                        .state = {}};
    if (fracture::distance_to_lie_along(pressed.deck) > 0) population.decks.push_back(pressed);
  }
}

void accelerate_cusps(const Step& step, Population& population, std::vector<HullLoads>& loads, AuditSums& audit) {
  for (AcceleratingCusp& cusp : population.accelerating_cusps)
    press(step, cusp, population.bodies, {loads[static_cast<std::size_t>(cusp.ship)], audit});
  std::erase_if(population.accelerating_cusps, is_finished);
}

void press_decks(const Setup& setup, const Step& step, Population& population, std::vector<HullLoads>& loads,
                 AuditSums& audit) {
  for (PressedDeck& pressed : population.decks)
    press(setup, step, pressed, population.bodies, {loads[static_cast<std::size_t>(pressed.ship)], audit});
  std::erase_if(population.decks,
                [](const PressedDeck& p) { return p.state.displacement >= distance_to_lie_along(p.deck); });
}

}  // namespace polynya::simulation
