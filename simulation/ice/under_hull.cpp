#include "simulation/ice/under_hull.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/contact/near_boundaries.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "simulation/field/portable_math.hpp"
#include "simulation/world/limits.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {

// ---- ice goes under

namespace {

using geometry::Point;
using geometry::Pose;
using geometry::Vector;

/// Returns the net buoyancy of the part of a floe within the beam of the hull, δρ g h times its area [N].
double weight_under(const Setup& setup, const Population& population, FloeId floe, int ship) {
  const dynamics::Bodies& bodies = population.bodies;
  const BodyIndex body = population.body_of(floe);
  const Pose ship_from_floe = dynamics::a_from_b(bodies, ship, body);
  const double under_beam = geometry::area_in_band(transform(ship_from_floe, population.floes[floe].shape.polygon),
                                                   0.5 * setup.underwater[ship].form.beam);
  const fracture::Ice& ice = ice_of_floe(setup, population, floe);
  const double lighter = setup.scene.water.water.density - ice.density;
  return lighter * fracture::kGravity * ice.thickness * std::max(0.0, under_beam);
}

}  // namespace

Event submersion_event(const Instant& now, const Population& population, const FloeAtHull& at) {
  Submerge submerge;
  submerge.under_hull_area = population.floes[at.floe].area;
  submerge.floe = at.floe;
  const geometry::Point place = population.bodies.position[population.body_of(at.floe)] + now.drift;
  return {now.time, at.ship, place, submerge};
}

void go_under(const Setup& setup, const Instant& now, const FloeAtHull& at, Population& population,
              Accounts& accounts) {
  const auto [floe, ship, has_deck] = at;
  const BodyIndex body = population.body_of(floe);
  leave_contacts(floe, population);
  stop(population.bodies, body, accounts.audit.energy.submersion, accounts.audit);
  population.bodies.rim_speed[body] = 0;
  population.bodies.drag[body].reset();
  population.floes[floe].is_under = true;
  population.submerged.push_back({.floe = floe,
                                  .ship = ship,
                                  .path = 0,
                                  .weight = weight_under(setup, population, floe, ship),
                                  .next_try = now.time,
                                  .waited = 0,
                                  .had_deck = has_deck,
                                  .area = population.floes[floe].area});
  ++accounts.counts.went_under;
}

void apply_submersions(const Setup& setup, const Step& step, const StepData& data, Population& population,
                       Books books) {
  for (const PendingSubmersion& floe : data.submersions) {
    if (!population.is_floating(floe.floe)) continue;  // it broke in this step, or it is under another ship
    Event event = submersion_event(step.end, population, {floe.floe, floe.ship});
    event.point_in_world = floe.point_in_water + step.end.drift;
    auto& submerge = std::get<Submerge>(event.what);
    submerge.normal_in_world = floe.normal;
    submerge.penetration = floe.penetration;
    submerge.criterion = floe.criterion;
    go_under(setup, step.end, {floe.floe, floe.ship}, population, books.accounts);
    ++books.accounts.counts.tilted_under;
    books.journal.events.push_back(std::move(event));
  }
}

// ---- ice under a hull brakes its ship

namespace {

/// The effect of the ice under a hull on its ship in a step.
struct Pull {
  BodyIndex ship = 0;
  double speed = 0;   ///< speed of the ship ahead through the water [m/s]
  double factor = 1;  ///< Lindqvist's factor of speed [-]
  double work = 0;    ///< work of the ship on the ice in the step [J]
  double moment = 0;  ///< sum of the work on each piece times its distance to port of the centre line [J m]
  double area = 0;    ///< area of ice under the hull [m²]
};

/// Returns the unit vector of a ship's heading in the water frame.
Vector heading_of(const dynamics::Bodies& bodies, BodyIndex ship) {
  return {bodies.rotation[ship].cosine, bodies.rotation[ship].sine};
}

/// Returns the distance of a piece to port of the ship's centre line, limited to the half-beam [m].
double distance_to_port(const Setup& setup, const dynamics::Bodies& bodies, const SubmergedPiece& piece,
                        BodyIndex body) {
  const double half_beam = 0.5 * setup.underwater[piece.ship].form.beam;
  const Vector from_ship = bodies.position[body] - bodies.position[piece.ship];
  return std::clamp(rotate_back(bodies.rotation[piece.ship], from_ship).y, -half_beam, half_beam);
}

/// Adds the work on one piece in a step of length dt [s], and its area. The work presses the piece down under the bow
/// and overcomes friction along the hull; both grow with speed by Lindqvist's factor.
void add_piece(const Setup& setup, double dt, const Population& population, const SubmergedPiece& piece, Pull& pull) {
  const dynamics::SubmersionPath& path = setup.underwater[piece.ship].path;
  if (piece.path >= std::max(path.bow, path.sliding)) return;  // behind the hull
  if (piece.path < path.sliding) pull.area += piece.area;
  if (pull.speed <= 0) return;
  const double to = piece.path + pull.speed * dt;
  const double friction = setup.scene.ice.friction;
  const double steady = path.risen_over(piece.path, to) + friction * path.slid_over(piece.path, to);
  // The force on a deck (PressedDeck) contains the growth with speed under the bow, so that only the growth of the
  // friction behind the bow is added here.
  const double growing = piece.had_deck ? friction * path.slid_behind_bow_over(piece.path, to) : steady;
  const double work = piece.weight * (steady + (pull.factor - 1) * growing);
  if (work == 0) return;
  pull.work += work;
  pull.moment += work * distance_to_port(setup, population.bodies, piece, population.body_of(piece.floe));
}

/// Returns the impulse against its heading with which the ice under a hull brakes a ship in a step of length dt [N s].
/// It stops a ship and never reverses it.
double impulse_of(double dt, const Pull& pull, const dynamics::Bodies& bodies) {
  const BodyIndex ship = pull.ship;
  if (pull.work == 0) return 0;
  const double impulse = pull.work / (pull.speed * dt) * dt;
  return bodies.inverse_mass[ship] != 0 ? std::min(impulse, bodies.mass[ship] * pull.speed) : impulse;
}

/// Applies the impulse to a ship, also its moment, and adds it to the loads and the accounts.
void apply(double impulse, const Pull& pull, dynamics::Bodies& bodies, HullLoads& loads_of_ship, AuditSums& audit) {
  const BodyIndex ship = pull.ship;
  SubmergedLoads& loads = loads_of_ship.submerged;
  loads.area = pull.area;
  if (pull.work == 0) return;
  const double angular = impulse * pull.moment / pull.work;
  loads.impulse += {-impulse, 0, angular};
  if (bodies.inverse_mass[ship] == 0) return;
  const Vector pushed = -impulse * heading_of(bodies, ship);
  audit.energy.submerged_ice -= push(bodies, ship, pushed, angular);
  audit.momentum.water += pushed;
  audit.impulses += impulse;
}

/// Returns the speed of a ship ahead through the water [m/s].
double speed_ahead(const Setup& setup, const dynamics::Bodies& bodies, BodyIndex ship) {
  const Vector through_water = bodies.velocity[ship] - setup.current.velocity_at(bodies.position[ship]);
  return dot(heading_of(bodies, ship), through_water);
}

/// The speed of a ship and the factor by which it multiplies the force of ice under its hull.
Pull pull_of(const Setup& setup, const dynamics::Bodies& bodies, BodyIndex ship) {
  Pull pull{.ship = ship, .speed = speed_ahead(setup, bodies, ship)};
  if (setup.scene.ships[ship].hull.has_speed_factor && pull.speed > 0)
    pull.factor = dynamics::submersion_speed_factor(pull.speed, setup.underwater[ship].form.length);
  return pull;
}

}  // namespace

void pull_of_submerged_ice(const Setup& setup, const Step& step, Population& population, std::vector<HullLoads>& loads,
                           AuditSums& audit) {
  dynamics::Bodies& bodies = population.bodies;
  const double dt = step.length;
  std::vector<Pull> pulls(setup.scene.ships.size());
  const auto ships = static_cast<BodyIndex>(pulls.size());
  for (BodyIndex ship = 0; ship < ships; ++ship) pulls[ship] = pull_of(setup, bodies, ship);
  for (const SubmergedPiece& piece : population.submerged) add_piece(setup, dt, population, piece, pulls[piece.ship]);
  for (BodyIndex ship = 0; ship < ships; ++ship) {
    apply(impulse_of(dt, pulls[ship], bodies), pulls[ship], bodies, loads[ship], audit);
    pulls[ship].speed = speed_ahead(setup, bodies, ship);
  }
  const bool is_still = setup.current.is_still();
  for (SubmergedPiece& piece : population.submerged) {
    piece.path += dt * pulls[piece.ship].speed;
    if (is_still) continue;
    const BodyIndex body = population.body_of(piece.floe);
    move_body(bodies, body, dt * setup.current.velocity_at(bodies.position[body]),
              dt * setup.current.angular_velocity());
  }
}

// ---- ice surfaces

namespace {

/// Number of places that are tried at each attempt to surface. Each place is scattered less than the one before; the
/// last one is where the piece is. More places let pieces surface sooner in dense ice and cost time.
constexpr int kPlaces = 8;

/// A place at which a piece may surface.
struct Place {
  Pose water_from_body;
  double angle = 0;  ///< angle of the body frame in the water frame [rad]
};

/// Returns a polygon without its rim: scaled about a point so that its area is reduced by the fraction `rim_loss`.
geometry::Polygon shrunk(geometry::Polygon polygon, Point about, double rim_loss) {
  const double scale = std::sqrt(1 - rim_loss);
  const auto shrink = [&](geometry::Ring& ring) {
    for (Point& p : ring) p = about + scale * (p - about);
  };
  shrink(polygon.outer);
  for (geometry::Ring& hole : polygon.holes) shrink(hole);
  return polygon;
}

/// Returns a random place near the piece's own. `size` is √area of the piece [m], and `scatter` is as in
/// ResurfaceSettings.
Place scattered(const dynamics::Bodies& bodies, BodyIndex body, double size, double scatter, Random& random) {
  const Vector shift = scatter * size * Vector{random.normal(), random.normal()};
  const double turn = scatter * std::numbers::pi * random.normal();
  if (scatter == 0) return {dynamics::water_from_body(bodies, body), bodies.angle[body]};
  const double angle = bodies.angle[body] + turn;
  const geometry::Rotation rotation = geometry::Rotation::by(angle);
  const Point centre = bodies.position[body] + shift;
  return {{centre - rotate(rotation, bodies.centroid[body] - Point{}), rotation}, angle};
}

/// Returns true if a piece at a place does not touch another body.
bool is_clear_of(const Population& population, BodyIndex other, const geometry::Boundary& piece,
                 const Pose& water_from_piece) {
  const Pose water_from_other = dynamics::water_from_body(population.bodies, other);
  return is_clear(*population.bodies.boundary[other], piece, relative_pose(water_from_other, water_from_piece));
}

/// Returns true if a piece at a place touches any hull or lies inside it.
bool is_under_hull(const Population& population, const geometry::Boundary& piece, const Pose& water_from_piece) {
  for (BodyIndex hull = 0; hull < population.hull_count; ++hull)
    if (!is_clear_of(population, hull, piece, water_from_piece)) return true;
  return false;
}

/// Returns true if a piece at a place touches no body.
bool has_room(const Population& population, const geometry::Boundary& piece, const Pose& water_from_piece) {
  geometry::Ring ring;
  for (const Point p : piece.edges.vertices) ring.push_back(transform(water_from_piece, p));
  bool has_room = true;
  population.pairs.for_bodies_near(bounding_box(ring), [&](BodyIndex other) {
    has_room = has_room && is_clear_of(population, other, piece, water_from_piece);
  });
  return has_room;
}

/// Returns true if a piece at a place would lie over another piece that has not surfaced yet, and would take the water
/// in which that piece surfaces. `centre` is the centre of mass of the piece at the place.
bool is_over_another(const Population& population, const SubmergedPiece& submerged, const geometry::Boundary& piece,
                     const Pose& water_from_piece, Point centre) {
  const dynamics::Bodies& bodies = population.bodies;
  const double radius = bodies.bounding_radius[population.body_of(submerged.floe)];
  return std::ranges::any_of(population.submerged, [&](const SubmergedPiece& other) {
    const BodyIndex body = population.body_of(other.floe);
    if (other.floe == submerged.floe || !population.floes[other.floe].is_under) return false;
    if (distance(bodies.position[body], centre) > radius + bodies.bounding_radius[body]) return false;
    return !is_clear_of(population, body, piece, water_from_piece);
  });
}

/// Returns the event of a piece that surfaces or stays under, with its criterion. `kind` has the members that differ
/// between the two.
template <class Kind>
Event event_of(const Setup& setup, const Instant& now, const Population& population, const SubmergedPiece& submerged,
               Kind kind) {
  kind.floe = submerged.floe;
  kind.criterion = {submerged.path, setup.underwater[submerged.ship].path.sliding, submerged.waited,
                    setup.scene.fracture.resurface.give_up};
  const BodyIndex body = population.body_of(submerged.floe);
  return {now.time, submerged.ship, population.bodies.position[body] + now.drift, std::move(kind)};
}

/// The attempts of submerged pieces to surface in one step.
class Resurfacing {
 public:
  Resurfacing(const Setup& setup, const Step& step, Population& population, Books books)
      : setup_(setup),
        settings_(setup.scene.fracture.resurface),
        now_(step.end),
        whole_ticks_(step.whole_ticks),
        population_(population),
        accounts_(books.accounts),
        journal_(books.journal) {}

  /// Lets a piece surface, stay under for good, or wait, if its ship has passed it or has backed off it.
  void go_on(SubmergedPiece& submerged) {
    const bool is_ahead = submerged.path < 0;  // the ship has backed off the piece
    if (submerged.path < setup_.underwater[submerged.ship].path.sliding && !is_ahead) return;
    if (now_.time < submerged.next_try) return;
    if (!settings_.is_enabled && !is_ahead) return stay_under(submerged);
    submerged.next_try = now_.time + settings_.retry;
    try_to_surface(submerged);
  }

 private:
  void stay_under(const SubmergedPiece& submerged) {
    StayUnder stays;
    stays.under_ice_area = population_.floes[submerged.floe].area;
    Event event = event_of(setup_, now_, population_, submerged, stays);
    accounts_.areas.under_ice += stays.under_ice_area;
    accounts_.masses.under_ice += population_.bodies.mass[population_.body_of(submerged.floe)];
    ++accounts_.counts.stayed_under;
    retire_floe(submerged.floe, population_, journal_);
    journal_.events.push_back(std::move(event));
  }

  void try_to_surface(SubmergedPiece& submerged) {
    const BodyIndex body = population_.body_of(submerged.floe);
    const Floe& floe = population_.floes[submerged.floe];
    const geometry::Polygon polygon = shrunk(floe.shape.polygon, population_.bodies.centroid[body], settings_.rim_loss);
    const geometry::Boundary boundary = geometry::make_outline(polygon);
    const Pose in_place = dynamics::water_from_body(population_.bodies, body);
    if (is_under_hull(population_, boundary, in_place)) return;  // the piece is still below a hull
    // The draws depend on nothing but the scene's seed, the floe and the tick, so a resumed run makes the same draws.
    Random random(setup_.scene.seed ^ (static_cast<std::uint64_t>(submerged.floe) << 32U) ^
                  static_cast<std::uint64_t>(whole_ticks_));
    for (int i = 0; i < kPlaces; ++i) {
      const double share = 1 - static_cast<double>(i) / (kPlaces - 1);
      const Place place = scattered(population_.bodies, body, std::sqrt(floe.area), share * settings_.scatter, random);
      if (!has_room(population_, boundary, place.water_from_body)) continue;
      const Point centre = transform(place.water_from_body, population_.bodies.centroid[body]);
      // At its own place, with share 0, a piece surfaces even if another one lies below it.
      if (share > 0 && is_over_another(population_, submerged, boundary, place.water_from_body, centre)) continue;
      return surface(submerged, polygon, place);
    }
    if (submerged.waited >= settings_.give_up) return stay_under(submerged);
    submerged.waited += settings_.retry;
  }

  void surface(const SubmergedPiece& submerged, const geometry::Polygon& polygon, const Place& place) {
    Resurface up;
    const geometry::Measures measures = geometry::measure(polygon);
    const double area_before = population_.floes[submerged.floe].area;
    const bool is_floe = can_be_floe(measures) && measures.area >= setup_.scene.fracture.smallest_floe_area &&
                         !geometry::find_defect(polygon);
    up.brash_area = is_floe ? area_before - measures.area : area_before;
    if (is_floe) up.children.push_back(add_piece(submerged, polygon, measures, place));
    accounts_.counts.brash_pieces += is_floe ? 0 : 1;
    accounts_.areas.brash += up.brash_area;
    accounts_.masses.brash += mass_per_area(ice_of_floe(setup_, population_, submerged.floe)) * up.brash_area;
    Event event = event_of(setup_, now_, population_, submerged, std::move(up));
    ++accounts_.counts.came_up;
    retire_floe(submerged.floe, population_, journal_);
    journal_.events.push_back(std::move(event));
  }

  /// Adds the floe that surfaces. It moves with the water.
  FloeId add_piece(const SubmergedPiece& submerged, const geometry::Polygon& polygon,
                   const geometry::Measures& measures, const Place& place) {
    NewFloe piece;
    piece.shape = {polygon, true};
    piece.measures = measures;
    piece.own_ice = population_.floes[submerged.floe].own_ice;
    piece.parent = submerged.floe;
    piece.generation = population_.floes[submerged.floe].generation + 1;
    piece.water_from_body = place.water_from_body;
    piece.angle = place.angle;
    if (!setup_.current.is_still()) {
      const Point centre = transform(place.water_from_body, measures.centroid);
      piece.angular_velocity = setup_.current.angular_velocity();
      piece.velocity =
          setup_.current.velocity_at(centre) - cross(piece.angular_velocity, centre - place.water_from_body.position);
    }
    const FloeId id = add_floe(setup_, now_, piece, population_, journal_);
    wake_and_enter(population_.body_of(id));
    return id;
  }

  /// Wakes a floe that has surfaced, which pairs it with the bodies around it, and adds the energy and momentum that a
  /// sheared current gives it to the accounts.
  void wake_and_enter(BodyIndex body) {
    wake(body, population_);
    AuditSums& audit = accounts_.audit;
    enter_motion(population_.bodies, body, audit.energy.current, audit.momentum.water, audit);
  }

  const Setup& setup_;
  const ResurfaceSettings& settings_;
  const Instant& now_;
  std::int64_t whole_ticks_;
  Population& population_;
  Accounts& accounts_;
  Journal& journal_;
};

}  // namespace

void surface_ice(const Setup& setup, const Step& step, Population& population, Books books) {
  Resurfacing resurfacing(setup, step, population, books);
  for (SubmergedPiece& submerged : population.submerged) resurfacing.go_on(submerged);
  std::erase_if(population.submerged,
                [&](const SubmergedPiece& submerged) { return !population.floes[submerged.floe].is_under; });
}

}  // namespace polynya::simulation
