#include <chrono>
#include <cmath>

#include <box2d/box2d.h>

#include "bench/peer.hpp"

namespace polynya::bench {
namespace {

b2Vec2 to_b2(geometry::Vector v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

void add_shape(b2Body& body, const PeerBody& from, const PeerScene& scene) {
  b2FixtureDef fixture;
  fixture.friction = static_cast<float>(scene.friction);
  fixture.restitution = static_cast<float>(scene.restitution);
  fixture.restitutionThreshold = 0;  // as Eq. (5)
  if (from.radius > 0) {
    b2CircleShape circle;
    circle.m_radius = static_cast<float>(from.radius);
    fixture.shape = &circle;
    body.CreateFixture(&fixture);
  } else {
    for (const geometry::Ring& piece : convex_pieces(from.outline, b2_maxPolygonVertices)) {
      std::vector<b2Vec2> corners;
      for (const geometry::Point p : piece) corners.push_back(to_b2(p - geometry::Point{}));
      b2PolygonShape polygon;
      polygon.Set(corners.data(), static_cast<int>(corners.size()));
      fixture.shape = &polygon;
      body.CreateFixture(&fixture);
    }
  }
  b2MassData mass;
  mass.mass = static_cast<float>(from.mass);
  mass.center = {0, 0};
  mass.I = static_cast<float>(from.moment);
  if (!from.is_prescribed) body.SetMassData(&mass);
}

}  // namespace

struct Box2dWorld::Parts {
  PeerScene scene;
  b2World world{b2Vec2(0, 0)};
  std::vector<b2Body*> bodies;
};

Box2dWorld::Box2dWorld(const PeerScene& scene) : parts_(std::make_unique<Parts>()) {
  parts_->scene = scene;
  parts_->world.SetAllowSleeping(true);
  parts_->world.SetContinuousPhysics(false);
  for (const PeerBody& from : parts_->scene.bodies) {
    b2BodyDef def;
    def.type = from.is_prescribed ? b2_kinematicBody : b2_dynamicBody;
    def.position = to_b2(from.position - geometry::Point{});
    def.angle = static_cast<float>(from.angle);
    def.linearVelocity = to_b2(from.velocity);
    def.angularVelocity = static_cast<float>(from.angular_velocity);
    def.awake = from.velocity != geometry::Vector{} || from.angular_velocity != 0 || from.thrust != 0;
    def.allowSleep = from.thrust == 0;
    b2Body* body = parts_->world.CreateBody(&def);
    add_shape(*body, from, scene);
    parts_->bodies.push_back(body);
  }
}

Box2dWorld::~Box2dWorld() = default;

StepReport Box2dWorld::step(bool counts_contacts) {
  StepReport report;
  for (std::size_t i = 0; i < parts_->bodies.size(); ++i) {
    b2Body& body = *parts_->bodies[i];
    if (!body.IsAwake() || body.GetType() != b2_dynamicBody) continue;
    ++report.awake;
    const PeerBody& from = parts_->scene.bodies[i];
    const b2Vec2 v = body.GetLinearVelocity();
    const b2Vec2 p = body.GetPosition();
    const b2Rot q = body.GetTransform().q;
    if (from.thrust != 0) body.ApplyForceToCenter(static_cast<float>(from.thrust) * q.GetXAxis(), true);
    const geometry::Vector drag = drag_acceleration(from, parts_->scene.current, {p.x, p.y}, {v.x, v.y}, {q.c, q.s});
    body.ApplyForceToCenter(to_b2(from.mass * drag), false);
    const double spin = drag_spin(from, parts_->scene.current, body.GetAngularVelocity());
    body.ApplyTorque(static_cast<float>(from.moment * spin), false);
  }
  const auto start = std::chrono::steady_clock::now();
  parts_->world.Step(static_cast<float>(parts_->scene.step), 8, 3);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report.contacts = -1;
  if (!counts_contacts) return report;
  report.contacts = 0;
  for (const b2Contact* c = parts_->world.GetContactList(); c != nullptr; c = c->GetNext())
    report.contacts += c->IsTouching() ? 1 : 0;
  return report;
}

}  // namespace polynya::bench
