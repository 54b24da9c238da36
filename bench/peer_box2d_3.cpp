#include <chrono>
#include <cstdio>
#include <cstdlib>

#include <box2d/box2d.h>

#include "bench/peer.hpp"

namespace polynya::bench {
namespace {

b2Vec2 to_b2(geometry::Vector v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

void add_shape(b2BodyId body, const PeerBody& from, const PeerScene& scene) {
  b2ShapeDef def = b2DefaultShapeDef();
  def.material.friction = static_cast<float>(scene.friction);
  def.material.restitution = static_cast<float>(scene.restitution);
  def.updateBodyMass = false;
  if (from.radius > 0) {
    const b2Circle circle{{0, 0}, static_cast<float>(from.radius)};
    b2CreateCircleShape(body, &def, &circle);
  } else {
    for (const geometry::Ring& piece : convex_pieces(from.outline, B2_MAX_POLYGON_VERTICES)) {
      b2Vec2 corners[B2_MAX_POLYGON_VERTICES];
      int count = 0;
      for (const geometry::Point p : piece) corners[count++] = to_b2(p - geometry::Point{});
      const b2Hull hull = b2ComputeHull(corners, count);
      if (hull.count == 0) {
        std::fprintf(stderr, "bench: Box2D 3.2 cannot take the outline of a body\n");
        std::exit(1);
      }
      const b2Polygon polygon = b2MakePolygon(&hull, 0);
      b2CreatePolygonShape(body, &def, &polygon);
    }
  }
  if (from.is_prescribed) {
    b2Body_ApplyMassFromShapes(body);
  } else {
    b2Body_SetMassData(body, {static_cast<float>(from.mass), {0, 0}, static_cast<float>(from.moment)});
  }
}

}  // namespace

struct Box2d3World::Parts {
  PeerScene scene;
  b2WorldId world = b2_nullWorldId;
  std::vector<b2BodyId> bodies;
};

Box2d3World::Box2d3World(const PeerScene& scene) : parts_(std::make_unique<Parts>()) {
  parts_->scene = scene;
  b2WorldDef world = b2DefaultWorldDef();
  world.gravity = {0, 0};
  world.restitutionThreshold = 0;  // as Eq. (5)
  world.enableSleep = true;
  world.enableContinuous = false;
  world.workerCount = 1;
  parts_->world = b2CreateWorld(&world);
  for (const PeerBody& from : parts_->scene.bodies) {
    b2BodyDef def = b2DefaultBodyDef();
    def.type = from.is_prescribed ? b2_kinematicBody : b2_dynamicBody;
    def.position = to_b2(from.position - geometry::Point{});
    def.rotation = b2MakeRot(static_cast<float>(from.angle));
    def.linearVelocity = to_b2(from.velocity);
    def.angularVelocity = static_cast<float>(from.angular_velocity);
    def.sleepThreshold = 0.01F;
    def.isAwake = from.velocity != geometry::Vector{} || from.angular_velocity != 0 || from.thrust != 0;
    def.enableSleep = from.thrust == 0;
    const b2BodyId body = b2CreateBody(parts_->world, &def);
    add_shape(body, from, scene);
    parts_->bodies.push_back(body);
  }
}

Box2d3World::~Box2d3World() {
  b2DestroyWorld(parts_->world);
}

std::vector<geometry::Point> Box2d3World::places() const {
  std::vector<geometry::Point> places;
  for (const b2BodyId body : parts_->bodies) {
    const b2Vec2 p = b2Body_GetPosition(body);
    places.push_back({p.x, p.y});
  }
  return places;
}

StepReport Box2d3World::step(bool counts_contacts) {
  StepReport report;
  for (std::size_t i = 0; i < parts_->bodies.size(); ++i) {
    const b2BodyId body = parts_->bodies[i];
    const PeerBody& from = parts_->scene.bodies[i];
    if (from.is_prescribed || !b2Body_IsAwake(body)) continue;
    ++report.awake;
    const b2Vec2 v = b2Body_GetLinearVelocity(body);
    const b2Vec2 p = b2Body_GetPosition(body);
    const b2Rot q = b2Body_GetRotation(body);
    const geometry::Vector thrust = from.thrust * geometry::Vector{q.c, q.s};
    const geometry::Vector drag = drag_acceleration(from, parts_->scene.current, {p.x, p.y}, {v.x, v.y}, {q.c, q.s});
    b2Body_ApplyForceToCenter(body, to_b2(thrust + from.mass * drag), false);
    const double spin = drag_spin(from, parts_->scene.current, b2Body_GetAngularVelocity(body));
    b2Body_ApplyTorque(body, static_cast<float>(from.moment * spin), false);
  }
  const auto start = std::chrono::steady_clock::now();
  b2World_Step(parts_->world, static_cast<float>(parts_->scene.step), 4);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report.contacts = -1;
  if (!counts_contacts) return report;
  report.contacts = 0;
  for (const int count : b2World_GetCounters(parts_->world).colorCounts) report.contacts += count;
  return report;
}

}  // namespace polynya::bench
