#include <chrono>
#include <cmath>

#include <chipmunk/chipmunk_private.h>

#include "bench/peer.hpp"

namespace polynya::bench {
namespace {

cpVect to_cp(geometry::Vector v) {
  return cpv(v.x, v.y);
}

/// The data of a body that the velocity callback reads.
struct Tag {
  const PeerBody* body = nullptr;
  const dynamics::ShearCurrent* current = nullptr;
};

void push_and_brake(cpBody* body, cpVect, cpFloat, cpFloat dt) {
  const Tag& tag = *static_cast<const Tag*>(cpBodyGetUserData(body));
  const cpVect v = cpBodyGetVelocity(body);
  const cpVect p = cpBodyGetPosition(body);
  const cpVect r = cpBodyGetRotation(body);
  geometry::Vector a = drag_acceleration(*tag.body, *tag.current, {p.x, p.y}, {v.x, v.y}, {r.x, r.y});
  a += (tag.body->thrust / tag.body->mass) * geometry::Vector{r.x, r.y};
  cpBodyUpdateVelocity(body, to_cp(a), 1, dt);
  body->w += dt * drag_spin(*tag.body, *tag.current, body->w);  // a setter would wake the body
}

}  // namespace

struct ChipmunkWorld::Parts {
  PeerScene scene;
  std::vector<Tag> tags;
  std::vector<cpBody*> bodies;
  std::vector<cpShape*> shapes;
  int held = 0;
  cpSpace* space = cpSpaceNew();
};

ChipmunkWorld::ChipmunkWorld(const PeerScene& scene) : parts_(std::make_unique<Parts>()) {
  parts_->scene = scene;
  cpSpace* space = parts_->space;
  cpSpaceSetIterations(space, 10);
  cpSpaceSetSleepTimeThreshold(space, 0.5);
  cpSpaceSetIdleSpeedThreshold(space, 0.01);
  cpSpaceSetCollisionSlop(space, 0.005);
  parts_->tags.resize(parts_->scene.bodies.size());
  std::vector<cpBody*> still;
  for (std::size_t i = 0; i < parts_->scene.bodies.size(); ++i) {
    const PeerBody& from = parts_->scene.bodies[i];
    cpBody* body = cpSpaceAddBody(space, from.is_prescribed ? cpBodyNewKinematic() : cpBodyNew(from.mass, from.moment));
    parts_->tags[i] = {&from, &parts_->scene.current};
    cpBodySetUserData(body, &parts_->tags[i]);
    cpBodySetPosition(body, to_cp(from.position - geometry::Point{}));
    cpBodySetAngle(body, from.angle);
    cpBodySetVelocity(body, to_cp(from.velocity));
    cpBodySetAngularVelocity(body, from.angular_velocity);
    parts_->held += from.is_prescribed ? 1 : 0;
    if (!from.is_prescribed) cpBodySetVelocityUpdateFunc(body, push_and_brake);
    std::vector<cpVect> corners;
    for (const geometry::Point p : from.outline) corners.push_back(to_cp(p - geometry::Point{}));
    cpShape* shape = from.radius > 0 ? cpCircleShapeNew(body, from.radius, cpvzero)
                                     : cpPolyShapeNewRaw(body, static_cast<int>(corners.size()), corners.data(), 0);
    cpShapeSetFriction(shape, std::sqrt(scene.friction));  // Chipmunk multiplies the two
    cpShapeSetElasticity(shape, std::sqrt(scene.restitution));
    cpSpaceAddShape(space, shape);
    parts_->bodies.push_back(body);
    parts_->shapes.push_back(shape);
    const bool moves = from.velocity != geometry::Vector{} || from.angular_velocity != 0 || from.thrust != 0;
    if (!from.is_prescribed && !moves) still.push_back(body);
  }
  for (cpBody* body : still) cpBodySleep(body);
}

ChipmunkWorld::~ChipmunkWorld() {
  cpSpaceFree(parts_->space);
  for (cpShape* shape : parts_->shapes) cpShapeFree(shape);
  for (cpBody* body : parts_->bodies) cpBodyFree(body);
}

StepReport ChipmunkWorld::step(bool counts_contacts) {
  StepReport report;
  cpSpace* space = parts_->space;
  const auto start = std::chrono::steady_clock::now();
  cpSpaceStep(space, parts_->scene.step);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  // Its sleeping bodies are kept elsewhere, its held ones among the others.
  report.awake = space->dynamicBodies->num - parts_->held;
  report.contacts = counts_contacts ? space->arbiters->num : -1;
  return report;
}

}  // namespace polynya::bench
