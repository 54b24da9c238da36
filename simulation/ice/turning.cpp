#include "simulation/ice/turning.hpp"

#include <algorithm>

#include "fracture/beam.hpp"
#include "fracture/turning_cusp.hpp"
#include "geometry/exact/predicates.hpp"

namespace polynya::simulation {
namespace {

using geometry::Point;
using geometry::Vector;

/// A piece that turns about the line across `ahead`, a unit vector, through the point of it that is farthest there.
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

Vector ahead_of(const Population& population, const PendingFracture& bend) {
  return rotate_back(population.bodies.rotation[population.body_of(bend.floe)], bend.normal);
}

/// An impulse on a hull, at an arm from its centre of mass.
struct HullImpulse {
  BodyIndex ship = 0;
  Vector arm;      ///< [m]
  Vector impulse;  ///< [N s]
};

/// Takes an impulse that goes into ice on its way under from the hull.
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

/// By how much a ship's speed along a direction at an arm from its centre grows by an impulse there [m/s].
double speed_by(const dynamics::Bodies& bodies, BodyIndex ship, Vector arm, Vector direction, Vector impulse) {
  return dot(direction,
             bodies.inverse_mass[ship] * impulse + cross(bodies.inverse_moment[ship] * cross(arm, impulse), arm));
}

/// Of a cusp or floe that went under, where a point of the water is over one, the last ones first; else none.
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

/// Of the piece's depth: how far from its edge that is looked for which is beside it [-].
constexpr double kBeside = 0.01;

/// The edge of a cusp from a to b, counter-clockwise in its floe's body frame, by what is beside it; x of its frame is
/// the direction in which the hull pushes the cusp (ahead_of).
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
  return fracture::deck_of(ice_of_floe(setup, population, bend.floe), setup.scene.water.water, bend.push.hull_angle,
                           outline, edges);
}

/// Presses a deck on over a step.
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

/// Gives a cusp's edge what it may take of its impulse in a step, and brakes the hull by it.
void press(const Step& step, StartedCusp& cusp, dynamics::Bodies& bodies, HullBooks books) {
  const geometry::Rotation of_ship = bodies.rotation[cusp.ship];
  const Vector arm = rotate(of_ship, cusp.arm_in_ship);
  const double given = std::min(cusp.left, cusp.most * step.length);
  cusp.left -= given;
  cusp.way -= step.length *
              std::max(0.0, dot(rotate(of_ship, cusp.normal_in_ship), dynamics::velocity_at(bodies, cusp.ship, arm)));
  brake({cusp.ship, arm, -given * rotate(of_ship, cusp.horizontal_in_ship)}, bodies, books);
}

bool is_started(const StartedCusp& cusp) {
  return cusp.left <= 0 || cusp.way <= 0;
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

void turn_cusp(const Step& step, const PendingFracture& bend, double mass, Population& population, HullBooks books) {
  const EdgePush& edge = bend.push;
  const BodyIndex ship = bend.ship;
  if (edge.speed <= 0) return;
  dynamics::Bodies& bodies = population.bodies;
  const Vector arm = bend.point_in_water - bodies.position[ship];
  // The hull slows down by what it gives: the two move on together.
  const double slowed = edge.speed_per_approach * speed_by(bodies, ship, arm, bend.normal, edge.horizontal);
  const double given = mass * edge.speed / (1 + mass * std::max(0.0, slowed));  // down on the edge
  const geometry::Rotation of_ship = bodies.rotation[ship];
  StartedCusp cusp{.ship = ship,
                   .arm_in_ship = rotate_back(of_ship, arm),
                   .normal_in_ship = rotate_back(of_ship, bend.normal),
                   .horizontal_in_ship = rotate_back(of_ship, edge.horizontal),
                   .left = given,
                   .most = bend.criteria.bending_capacity,
                   .way = bend.cusp_radius};
  press(step, cusp, bodies, books);
  if (!is_started(cusp)) population.started.push_back(cusp);
}

bool has_decks(const Setup& setup, const PendingFracture& bend) {
  return setup.has_flooding_decks && bend.push.speed > 0;
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
                        .horizontal_in_ship = rotate_back(of_ship, bend.push.horizontal),
                        .deck = deck_of(setup, population, bend, piece.shape.polygon.outer),
                        .state = {}};
    if (fracture::way_to_lie_along(pressed.deck) > 0) population.decks.push_back(pressed);
  }
}

void press_started(const Step& step, Population& population, std::vector<HullLoads>& loads, AuditSums& audit) {
  for (StartedCusp& cusp : population.started)
    press(step, cusp, population.bodies, {loads[static_cast<std::size_t>(cusp.ship)], audit});
  std::erase_if(population.started, is_started);
}

void press_decks(const Setup& setup, const Step& step, Population& population, std::vector<HullLoads>& loads,
                 AuditSums& audit) {
  for (PressedDeck& pressed : population.decks)
    press(setup, step, pressed, population.bodies, {loads[static_cast<std::size_t>(pressed.ship)], audit});
  std::erase_if(population.decks, [](const PressedDeck& p) { return p.state.way >= way_to_lie_along(p.deck); });
}

}  // namespace polynya::simulation
