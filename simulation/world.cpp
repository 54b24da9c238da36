#include "simulation/world.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "fracture/bending/fsi_database_model.hpp"
#include "fracture/bending/kashtelyan.hpp"
#include "fracture/bending/nevel.hpp"
#include "geometry/exact/measures.hpp"

namespace polynya::simulation {
namespace {

using geometry::Point;
using geometry::Vector;

std::unique_ptr<fracture::BendingModel> make_bending_model(BendingModelKind kind) {
  switch (kind) {
    case BendingModelKind::kNevel:
      return std::make_unique<fracture::NevelModel>();
    case BendingModelKind::kKashtelyan:
      return std::make_unique<fracture::KashtelyanModel>();
    case BendingModelKind::kFsiDatabase:
      return std::make_unique<fracture::FsiDatabaseModel>();
  }
  return nullptr;  // no other kind
}

/// Cells about as large as the typical floe and its margin, so that most floes are in one to four of them
/// [m].
double grid_cell(const Scene& scene) {
  std::vector<double> sizes;
  for (const FloeSpec& floe : scene.floes) {
    const geometry::Box box = bounding_box(floe.polygon_in_world.outer);
    sizes.push_back(std::max(box.high.x - box.low.x, box.high.y - box.low.y));
  }
  if (sizes.empty()) return 20;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(5.0, 1.5 * *middle);
}

void add_ship(World& world, const ShipSpec& ship) {
  const BodyIndex index = add_body(world.bodies, new_body_of(world, ship));
  world.pairs.add(world.bodies, index);
}

/// The scene's ships and floes.
void populate(World& world);

}  // namespace

dynamics::ShearCurrent current_of(const ShearSettings& shear) {
  return {{std::cos(shear.direction), std::sin(shear.direction)}, shear.rate, shear.origin};
}

dynamics::NewBody new_body_of(const World& world, const ShipSpec& ship) {
  dynamics::NewBody body;
  body.position = ship.position_in_world;
  body.angle = ship.heading;
  const Vector ahead{std::cos(ship.heading), std::sin(ship.heading)};
  double speed = ship.speed;
  if (const auto* held = std::get_if<ConstantSpeed>(&ship.propulsion)) {
    speed = held->speed;
    body.is_prescribed = true;
  }
  if (std::holds_alternative<FixedInPlace>(ship.propulsion)) {
    speed = 0;
    body.is_prescribed = true;
  }
  body.velocity = speed * ahead - world.scene.water.drift;
  body.mass = ship.mass;
  body.moment = ship.moment_of_inertia;
  body.boundary = std::make_shared<geometry::Boundary>(geometry::make_outline({ship.hull.waterline, {}}));
  return body;
}

dynamics::NewBody new_body_of(const World& world, const geometry::Polygon& polygon_in_body,
                              const geometry::Measures& measures) {
  const fracture::Ice& ice = world.scene.ice;
  dynamics::NewBody body;
  body.mass = ice.density * ice.thickness * measures.area;
  body.moment = ice.density * ice.thickness * measures.second_moment;
  body.centroid = measures.centroid;
  body.thickness = ice.thickness;
  body.boundary = std::make_shared<geometry::Boundary>(geometry::make_outline(polygon_in_body));
  return body;
}

World::World(Scene scene_of_run, Shortcuts shortcuts_of_run, Population population)
    : scene(std::move(scene_of_run)),
      shortcuts(shortcuts_of_run),
      bending(make_bending_model(scene.fracture.bending)),
      breakable_size(scene.fracture.breakable_size_factor *
                     breakable_length(scene.ice, scene.water.water, scene.fracture.characteristic_length)),
      pairs({scene.contact.circle_radius, scene.contact.normal == ContactNormal::kCircleCentres,
             shortcuts.culls},
            grid_cell(scene)),
      loads(scene.ships.size()) {
  solver_settings.restitution = scene.contact.restitution;
  solver_settings.max_iterations = scene.contact.iterations;
  separation_settings.time = scene.contact.separation_time;
  steps_per_sample = std::max<std::int64_t>(1, std::llround(scene.record.forces_interval / scene.time.step));
  current = current_of(scene.water.shear);
  if (population == Population::kScene) populate(*this);
}

namespace {

void populate(World& world) {
  const Scene& scene = world.scene;
  const dynamics::ShearCurrent& current = world.current;
  for (const ShipSpec& ship : scene.ships) add_ship(world, ship);
  for (const FloeSpec& spec : scene.floes) {
    NewFloe floe;
    floe.shape.polygon = spec.polygon_in_world;
    const geometry::Measures measures = geometry::measure(spec.polygon_in_world);
    const Point centroid = measures.centroid;
    floe.angular_velocity = spec.angular_velocity;
    floe.velocity = spec.velocity;
    if (!current.is_still()) {  // at rest in a sheared current is to go and turn with it
      floe.velocity += current.velocity_at(centroid);
      floe.angular_velocity += current.angular_velocity();
    }
    floe.velocity -= cross(floe.angular_velocity, centroid - Point{});
    const FloeId id = add_floe(world, floe, measures);
    world.ledger.initial_ice_area += world.floes[id].area;
  }
  world.counts.floes_initial = static_cast<std::int64_t>(world.floes.size());
  // Only now: a body that wakes looks for its neighbours once, so they all have to be there.
  for (BodyIndex ship = 0; ship < world.ship_count(); ++ship) wake(world, ship);
  for (std::size_t i = 0; i < scene.floes.size(); ++i) {
    const FloeSpec& spec = scene.floes[i];
    const BodyIndex body = world.body_of(static_cast<FloeId>(i));
    const bool is_moving = spec.velocity != Vector{} || spec.angular_velocity != 0;
    if (is_moving || !world.is_current_still_at(body) || !world.shortcuts.sleeps) wake(world, body);
  }
  open_accounts(world);
}

}  // namespace

FloeId add_floe(World& world, const NewFloe& floe, const geometry::Measures& measures) {
  const auto id = static_cast<FloeId>(world.floes.size());
  dynamics::NewBody body = new_body_of(world, floe.shape.polygon, measures);
  body.position = transform(floe.water_from_body, body.centroid);
  body.angle = floe.angle;
  // v + ω × r, with r from the frame's origin to this floe's own centre of mass.
  body.velocity = floe.velocity + cross(floe.angular_velocity, body.position - floe.water_from_body.position);
  body.angular_velocity = floe.angular_velocity;
  world.floes.push_back({floe.parent, world.time(), floe.generation, measures.area, floe.shape});
  const BodyIndex index = add_body(world.bodies, body);
  assert(world.floe_of(index) == id);
  world.pairs.add(world.bodies, index);
  world.journal.births.push_back(
      {{id, floe.parent, world.time(), floe.generation, measures.area, body.mass, body.centroid},
       floe.shape.polygon});
  return id;
}

bool World::is_current_still_at(BodyIndex body) const {
  if (current.is_still()) return true;
  const double rim = std::abs(current.angular_velocity()) * bodies.bounding_radius[body];
  return length(current.velocity_at(bodies.position[body])) + rim < kRestSpeed;
}

void retire_floe(World& world, FloeId floe) {
  const BodyIndex body = world.body_of(floe);
  world.pairs.remove(body);
  world.bodies.is_alive[body] = 0;
  if (world.bodies.is_awake[body]) {
    world.bodies.is_awake[body] = 0;
    world.awake.erase(std::find(world.awake.begin(), world.awake.end(), body));
  }
  world.bodies.boundary[body].reset();
  world.bodies.drag[body].reset();
  world.journal.deaths.push_back({floe, std::move(world.floes[floe].shape.polygon)});
  world.floes[floe].shape = {};
}

void give_drag(World& world, BodyIndex body) {
  if (world.is_ship(body) || world.bodies.drag[body] != nullptr) return;
  world.bodies.drag[body] = std::make_shared<dynamics::DragShape>(
      dynamics::make_drag_shape(world.floes[world.floe_of(body)].shape.polygon, world.bodies.centroid[body]));
}

void wake(World& world, BodyIndex body) {
  if (world.bodies.is_awake[body]) return;
  world.bodies.is_awake[body] = 1;
  give_drag(world, body);  // water holds back what moves
  world.awake.insert(std::lower_bound(world.awake.begin(), world.awake.end(), body), body);
  world.pairs.wake(world.bodies, body);
}

}  // namespace polynya::simulation
