#include "simulation/world/population.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "elementary/elementary.hpp"

namespace polynya::simulation {
namespace {

using geometry::Point;
using geometry::Vector;

/// Moment of inertia of walls that press, which must not turn [kg m²]. It is so large that impulses turn a wall only by
/// rounding, and finite because the solver of jams divides by its inverse (jam_solver.cpp).
constexpr double kNeverTurns = 1e30;

/// Returns the cell size of the broad phase's grid [m]: 1.5 times the median of the longer sides of the floes' bounding
/// boxes, at least 5 m, and 20 m without floes. Most floes with their margins then lie in one to four cells. Results do
/// not depend on it.
double grid_cell(std::span<const FloeSpec> floes) {
  std::vector<double> sizes;
  for (const FloeSpec& floe : floes) {
    const geometry::Box box = bounding_box(floe.polygon_in_world.outer);
    sizes.push_back(std::max(box.high.x - box.low.x, box.high.y - box.low.y));
  }
  if (sizes.empty()) return 20;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(5.0, 1.5 * *middle);
}

/// Returns the data of a floe of the scene at the start, by its centre of mass in the scene's coordinates [m]. The
/// polygon is moved out of `spec`.
NewFloe new_floe_of(FloeSpec& spec, Point centroid, const Setup& setup) {
  NewFloe floe;
  floe.shape.polygon = std::move(spec.polygon_in_world);
  floe.own_ice = spec.own_ice;
  floe.angular_velocity = spec.angular_velocity;
  floe.velocity = spec.velocity;
  floe.is_fast = spec.is_fast;
  if (spec.is_fast) {
    floe.velocity -= setup.scene.water.drift_at(0);
    return floe;
  }
  if (!setup.current.is_still()) {  // scene velocities are relative to the sheared current and its rotation
    floe.velocity += setup.current.velocity_at(centroid);
    floe.angular_velocity += setup.current.angular_velocity();
  }
  floe.velocity -= cross(floe.angular_velocity, centroid - Point{});
  return floe;
}

}  // namespace

Population::Population(const Setup& setup, std::span<const FloeSpec> floes_at_start)
    : hull_count(static_cast<int>(simulation::hull_count(setup.scene))),
      drag_area(setup.scene.water.drag_area),
      has_skin_drag(setup.scene.water.skin_drag_coefficient > 0),
      water_velocity(setup.scene.water.drift_at(0)),
      pairs(setup.contact_rule, grid_cell(floes_at_start)) {}

void add_scene(const Setup& setup, std::vector<FloeSpec>& floes, Population& population, Journal& journal) {
  for (BodyIndex hull = 0; hull < population.hull_count; ++hull) {
    add_body(population.bodies, new_body_of(setup.scene, hull));
    population.pairs.add(population.bodies, hull);
  }
  reserve(population.bodies, population.bodies.position.size() + floes.size());
  population.pairs.reserve(population.bodies.position.size() + floes.size());
  population.floes.reserve(floes.size());
  journal.births.reserve(floes.size());
  for (FloeSpec& spec : floes) {
    const geometry::Measures measures = geometry::measure(spec.polygon_in_world);
    NewFloe floe = new_floe_of(spec, measures.centroid, setup);
    floe.measures = measures;
    add_floe(setup, instant_at(setup, 0), std::move(floe), population, journal);
  }
  // Bodies are woken only after all have been added, because a waking body looks up its neighbours once.
  for (BodyIndex hull = 0; hull < population.hull_count; ++hull) wake(hull, population);
  for (std::size_t i = 0; i < floes.size(); ++i) {
    const FloeSpec& spec = floes[i];
    const BodyIndex body = population.body_of(static_cast<FloeId>(i));
    const bool is_moving = spec.is_fast ? population.bodies.velocity[body] != Vector{}
                                        : spec.velocity != Vector{} || spec.angular_velocity != 0;
    if (is_moving || spec.has_crushed_overlaps || !stays_at_rest(body, setup, population.bodies) ||
        !setup.shortcuts.sleeps)
      wake(body, population);
  }
  // The ice of such overlaps is gone, so they must not press the bodies apart.
  for (std::size_t i = 0; i < floes.size(); ++i) {
    if (floes[i].has_crushed_overlaps) population.pairs.note_paid(population.body_of(static_cast<FloeId>(i)));
  }
}

FloeId add_floe(const Setup& setup, const Instant& now, NewFloe floe, Population& population, Journal& journal) {
  const geometry::Measures& measures = floe.measures;
  const FloeId id = population.floe_count();
  dynamics::NewBody body = new_body_of(floe.shape.polygon, measures, ice_of(setup.scene, floe.own_ice), floe.is_fast);
  body.position = transform(floe.water_from_body, body.centroid);
  body.angle = floe.angle;
  // The velocity is v + ω × r, where r points from the frame's origin to the floe's own centre of mass.
  body.velocity = floe.velocity + cross(floe.angular_velocity, body.position - floe.water_from_body.position);
  body.angular_velocity = floe.angular_velocity;
  journal.births.push_back(
      {{id, floe.parent, now.time, floe.generation, measures.area, body.mass, body.centroid, floe.own_ice},
       floe.shape.polygon});
  population.floes.push_back({.parent = floe.parent,
                              .born = now.time,
                              .generation = floe.generation,
                              .own_ice = floe.own_ice,
                              .area = measures.area,
                              .shape = std::move(floe.shape)});
  const BodyIndex index = add_body(population.bodies, body);
  assert(population.floe_of(index) == id);
  population.pairs.add(population.bodies, index);
  return id;
}

void leave_contacts(FloeId floe, Population& population) {
  const BodyIndex body = population.body_of(floe);
  population.pairs.remove(body);
  std::erase_if(population.tilted, [&](const TiltedFloe& tilted) { return tilted.floe == floe; });
  if (!population.bodies.is_awake[body]) return;
  population.bodies.is_awake[body] = 0;
  erase_from(population.awake, body);
}

void retire_floe(FloeId floe, Population& population, Journal& journal) {
  dynamics::Bodies& bodies = population.bodies;
  const BodyIndex body = population.body_of(floe);
  leave_contacts(floe, population);
  bodies.is_alive[body] = 0;
  bodies.boundary[body].reset();
  bodies.drag[body].reset();
  population.floes[floe].is_under = false;
  journal.deaths.push_back({floe, std::move(population.floes[floe].shape.polygon)});
  population.floes[floe].shape = {};
}

void insert_into(std::vector<BodyIndex>& ascending, BodyIndex body) {
  ascending.insert(std::ranges::lower_bound(ascending, body), body);
}
void erase_from(std::vector<BodyIndex>& ascending, BodyIndex body) {
  // std::ranges::equal_range is avoided because the clang version of the fuzzers does not compile its subrange.
  const auto [first, last] = std::equal_range(ascending.begin(), ascending.end(), body);
  ascending.erase(first, last);
}

void wake(BodyIndex body, Population& population) {
  if (population.bodies.is_awake[body]) return;
  population.bodies.is_awake[body] = 1;
  add_drag(body, population);
  insert_into(population.awake, body);
  population.pairs.wake(population.bodies, body);
}

void add_drag(BodyIndex body, Population& population) {
  if (population.is_hull(body) || population.bodies.drag[body] != nullptr) return;
  if (population.bodies.inverse_mass[body] == 0) {  // the water does not move fast ice
    static const auto none = std::make_shared<const dynamics::DragShape>(dynamics::DragShape{.same_width = 0});
    population.bodies.drag[body] = none;
    return;
  }
  population.bodies.drag[body] = std::make_shared<dynamics::DragShape>(
      dynamics::make_drag_shape(population.floes[population.floe_of(body)].shape.polygon,
                                population.bodies.centroid[body], population.drag_area, population.has_skin_drag));
}

bool stays_at_rest(BodyIndex body, const Setup& setup, const dynamics::Bodies& bodies) {
  if (setup.scene.wind.blows() && bodies.inverse_mass[body] != 0) return false;
  const dynamics::ShearCurrent& current = setup.current;
  if (current.is_still()) return true;
  const double rim = std::abs(current.angular_velocity()) * bodies.bounding_radius[body];
  return length(current.velocity_at(bodies.position[body])) + rim < kRestSpeed;
}

namespace {

/// Returns the body of a hull that moves along its heading with a prescribed speed over ground [m/s], where the water
/// frame has the velocity `water_drift` over ground [m/s].
dynamics::NewBody held_body(const PlacedHull& hull, BodyKind kind, double speed, Vector water_drift) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  return {.position = hull.position_in_world,
          .angle = hull.heading,
          .velocity = speed * Vector{elementary::cos(hull.heading), elementary::sin(hull.heading)} - water_drift,
          .mass = kInfinite,
          .moment = kInfinite,
          .is_prescribed = true,
          .kind = kind,
          .centroid = {},
          .boundary = std::make_shared<geometry::Boundary>(geometry::make_outline({hull.hull.waterline, {}})),
          .drag = nullptr};
}

dynamics::NewBody body_of(const Ship& ship, Vector water_drift) {
  const auto* prescribed = std::get_if<ConstantSpeed>(&ship.propulsion);
  dynamics::NewBody body = held_body(ship, BodyKind::kShip, prescribed ? prescribed->speed : ship.speed, water_drift);
  if (ship.sway_speed != 0)
    body.velocity += ship.sway_speed * Vector{-elementary::sin(ship.heading), elementary::cos(ship.heading)};
  body.angular_velocity = ship.yaw_rate;
  body.is_prescribed = prescribed != nullptr;
  body.mass = ship.mass;
  body.moment = ship.moment_of_inertia;
  return body;
}

dynamics::NewBody body_of(const Structure& structure, Vector water_drift) {
  return held_body(structure, BodyKind::kStructure, 0, water_drift);
}

dynamics::NewBody body_of(const Wall& wall, Vector water_drift) {
  dynamics::NewBody body = held_body(wall, BodyKind::kWall, 0, water_drift);
  body.velocity += wall.velocity;
  if (!wall.pressure) return body;
  body.is_prescribed = false;
  body.mass = wall.pressure->mass_per_length * wall.length;
  body.moment = kNeverTurns;
  return body;
}

}  // namespace

dynamics::NewBody new_body_of(const Scene& scene, std::size_t hull) {
  return visit_hull(scene, hull, [&](const auto& of_a_kind) { return body_of(of_a_kind, scene.water.drift_at(0)); });
}

dynamics::NewBody new_body_of(const geometry::Polygon& polygon_in_body, const geometry::Measures& measures,
                              const fracture::Ice& ice, bool is_fast) {
  dynamics::NewBody body;
  body.is_prescribed = is_fast;
  body.mass = ice.density * ice.thickness * measures.area;
  body.moment = ice.density * ice.thickness * measures.second_moment;
  body.centroid = measures.centroid;
  body.thickness = ice.thickness;
  body.boundary = std::make_shared<geometry::Boundary>(geometry::make_outline(polygon_in_body));
  return body;
}

}  // namespace polynya::simulation
