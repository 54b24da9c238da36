#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/contact/boundary.hpp"
#include "geometry/exact/validity.hpp"
#include "simulation/field/portable_math.hpp"
#include "simulation/world/limits.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using geometry::Point;
using geometry::Pose;
using geometry::Vector;

constexpr int kPlaces = 8;  ///< tried at a time, each scattered less; the last one is where it went under

/// Where a piece may come up.
struct Place {
  Pose water_from_body;
  double angle = 0;  ///< [rad]
};

/// A polygon without its rim, about a point.
geometry::Polygon shrunk(geometry::Polygon polygon, Point about, double rim_loss) {
  const double scale = std::sqrt(1 - rim_loss);
  const auto shrink = [&](geometry::Ring& ring) {
    for (Point& p : ring) p = about + scale * (p - about);
  };
  shrink(polygon.outer);
  for (geometry::Ring& hole : polygon.holes) shrink(hole);
  return polygon;
}

/// The piece's place in the water, scattered at random.
Place scattered(const dynamics::Bodies& bodies, BodyIndex body, double size, double scatter, Random& random) {
  const Vector shift = scatter * size * Vector{random.normal(), random.normal()};
  const double turn = scatter * std::numbers::pi * random.normal();
  if (scatter == 0) return {dynamics::water_from_body(bodies, body), bodies.angle[body]};
  const double angle = bodies.angle[body] + turn;
  const geometry::Rotation rotation = geometry::Rotation::by(angle);
  const Point centre = bodies.position[body] + shift;
  return {{centre - rotate(rotation, bodies.centroid[body] - Point{}), rotation}, angle};
}

bool is_clear_of(const Population& population, BodyIndex other, const geometry::Boundary& piece,
                 const Pose& water_from_piece) {
  const Pose water_from_other = dynamics::water_from_body(population.bodies, other);
  return is_clear(*population.bodies.boundary[other], piece, relative_pose(water_from_other, water_from_piece));
}

bool is_under_hull(const Population& population, const geometry::Boundary& piece, const Pose& water_from_piece) {
  for (BodyIndex hull = 0; hull < population.hull_count; ++hull)
    if (!is_clear_of(population, hull, piece, water_from_piece)) return true;
  return false;
}

/// Whether no body is where a piece would come up.
bool has_room(const Population& population, const geometry::Boundary& piece, const Pose& water_from_piece) {
  geometry::Ring ring;
  for (const Point p : piece.edges.vertices) ring.push_back(transform(water_from_piece, p));
  bool has_room = true;
  population.pairs.for_bodies_near(bounding_box(ring), [&](BodyIndex other) {
    has_room = has_room && is_clear_of(population, other, piece, water_from_piece);
  });
  return has_room;
}

/// Whether a piece would come up where another is that has not come up yet: that one keeps its room.
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

/// A kind of event with what decided it.
template <class Kind>
Event event_of(const Setup& setup, const Clock& clock, const Population& population, const SubmergedPiece& submerged,
               Kind kind) {
  kind.floe = submerged.floe;
  kind.criterion = {submerged.path, setup.underwater[submerged.ship].path.sliding, submerged.waited,
                    setup.scene.fracture.resurface.give_up};
  const BodyIndex body = population.body_of(submerged.floe);
  return {clock.time(), submerged.ship, population.bodies.position[body] + clock.drift(), std::move(kind)};
}

/// One submerged piece's attempts to come up.
class Resurfacing {
 public:
  Resurfacing(const Setup& setup, const Clock& clock, Population& population, Accounts& accounts, Journal& journal)
      : setup_(setup),
        settings_(setup.scene.fracture.resurface),
        clock_(clock),
        population_(population),
        accounts_(accounts),
        journal_(journal) {}

  /// Returns whether it is submerged no more.
  bool ends(SubmergedPiece& submerged) {
    const bool is_ahead = submerged.path < 0;  // the ship backed off it
    if (submerged.path < setup_.underwater[submerged.ship].path.sliding && !is_ahead) return false;
    if (clock_.time() < submerged.next_try) return false;
    if (!settings_.is_enabled && !is_ahead) return stay_under(submerged);
    submerged.next_try = clock_.time() + settings_.retry;
    return try_to_come_up(submerged);
  }

 private:
  bool stay_under(const SubmergedPiece& submerged) {
    StayUnder stays;
    stays.under_ice_area = population_.floes[submerged.floe].area;
    Event event = event_of(setup_, clock_, population_, submerged, stays);
    accounts_.ledger.under_ice_area += stays.under_ice_area;
    accounts_.masses.under_ice_mass += population_.bodies.mass[population_.body_of(submerged.floe)];
    ++accounts_.counts.stayed_under;
    retire_floe(submerged.floe, population_, journal_);
    journal_.events.push_back(std::move(event));
    return true;
  }

  bool try_to_come_up(SubmergedPiece& submerged) {
    const BodyIndex body = population_.body_of(submerged.floe);
    const Floe& floe = population_.floes[submerged.floe];
    const geometry::Polygon polygon = shrunk(floe.shape.polygon, population_.bodies.centroid[body], settings_.rim_loss);
    const geometry::Boundary boundary = geometry::make_outline(polygon);
    const Pose in_place = dynamics::water_from_body(population_.bodies, body);
    if (is_under_hull(population_, boundary, in_place)) return false;  // not behind it yet
    Random random(setup_.scene.seed ^ (static_cast<std::uint64_t>(submerged.floe) << 32U) ^
                  static_cast<std::uint64_t>(clock_.steps));
    for (int i = 0; i < kPlaces; ++i) {
      const double share = 1 - static_cast<double>(i) / (kPlaces - 1);
      const Place place = scattered(population_.bodies, body, std::sqrt(floe.area), share * settings_.scatter, random);
      if (!has_room(population_, boundary, place.water_from_body)) continue;
      const Point centre = transform(place.water_from_body, population_.bodies.centroid[body]);
      if (share > 0 && is_over_another(population_, submerged, boundary, place.water_from_body, centre)) continue;
      come_up(submerged, polygon, place);
      return true;
    }
    if (submerged.waited >= settings_.give_up) return stay_under(submerged);
    submerged.waited += settings_.retry;
    return false;
  }

  void come_up(const SubmergedPiece& submerged, const geometry::Polygon& polygon, const Place& place) {
    Resurface up;
    const geometry::Measures measures = geometry::measure(polygon);
    const double area_before = population_.floes[submerged.floe].area;
    const bool is_floe = can_be_floe(measures) && measures.area >= setup_.scene.fracture.smallest_floe_area &&
                         !geometry::find_defect(polygon);
    up.brash_area = is_floe ? area_before - measures.area : area_before;
    if (is_floe) up.children.push_back(add_piece(submerged, polygon, measures, place));
    accounts_.counts.brash_pieces += is_floe ? 0 : 1;
    accounts_.ledger.brash_area += up.brash_area;
    accounts_.masses.brash_mass += mass_per_area(ice_of_floe(setup_, population_, submerged.floe)) * up.brash_area;
    Event event = event_of(setup_, clock_, population_, submerged, std::move(up));
    ++accounts_.counts.came_up;
    retire_floe(submerged.floe, population_, journal_);
    journal_.events.push_back(std::move(event));
  }

  /// Adds the floe, going with the water.
  FloeId add_piece(const SubmergedPiece& submerged, const geometry::Polygon& polygon,
                   const geometry::Measures& measures, const Place& place) {
    NewFloe piece;
    piece.shape = {polygon, true};
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
    const FloeId id = add_floe(setup_, clock_, piece, measures, population_, journal_);
    wake_and_enter(population_.body_of(id));
    return id;
  }

  /// Awake, it is paired with the bodies around it. A sheared current carries it along.
  void wake_and_enter(BodyIndex body) {
    wake(body, population_);
    AuditSums& audit = accounts_.audit;
    enter_motion(population_.bodies, body, audit.energy.current, audit.momentum.water, audit);
  }

  const Setup& setup_;
  const ResurfaceSettings& settings_;
  const Clock& clock_;
  Population& population_;
  Accounts& accounts_;
  Journal& journal_;
};

}  // namespace

void come_up(const Setup& setup, const Clock& clock, Population& population, Accounts& accounts, Journal& journal) {
  if (population.submerged.empty()) return;
  Resurfacing resurfacing(setup, clock, population, accounts, journal);
  std::vector<FloeId> ended;  // in the order of the submerged pieces
  for (SubmergedPiece& submerged : population.submerged) {
    if (resurfacing.ends(submerged)) ended.push_back(submerged.floe);
  }
  if (ended.empty()) return;
  auto next = ended.begin();
  std::erase_if(population.submerged, [&](const SubmergedPiece& submerged) {
    const bool has_ended = next != ended.end() && *next == submerged.floe;
    if (has_ended) ++next;
    return has_ended;
  });
}

}  // namespace polynya::simulation
