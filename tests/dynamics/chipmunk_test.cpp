// The same collisions in Chipmunk 7 (double precision), an independent implementation of sequential impulses.
//
// Two differences had to be removed. Chipmunk separates overlapping bodies by a bias velocity, which is switched off
// here. It uses Newton's restitution at each contact point, whereas Polynya uses Poisson's. The two agree without
// friction at a single point, for a plastic impact of any kind, and with friction if the contact slides throughout;
// these cases are compared. Contact points of Chipmunk lie on the two surfaces, those of Polynya on the line between
// them. The overlap is made so small that this difference is below the tolerance.
#include <algorithm>

#include <chipmunk/chipmunk.h>
#include <gtest/gtest.h>

#include "tests/dynamics/scenery.hpp"

namespace polynya::dynamics {
namespace {

using geometry::Point;
using geometry::Vector;
using namespace scenery;

static_assert(sizeof(cpFloat) == sizeof(double), "Chipmunk in double precision");

constexpr std::uint64_t kChipmunkSeed = 4242;
constexpr double kOverlap = 1e-8;    // [m]
constexpr double kAgreement = 1e-6;  // of the speeds, [m/s] and [m/s] at a metre's arm

struct Scene {
  geometry::Polygon boxes[2];
  NewBody bodies[2];
  double restitution = 0;
  double friction = 0;
};

struct Outcome {
  Vector velocity[2];
  double angular_velocity[2] = {0, 0};
};

Outcome with_chipmunk(const Scene& scene) {
  cpSpace* space = cpSpaceNew();
  cpSpaceSetIterations(space, 3000);
  cpSpaceSetCollisionBias(space, 1);
  cpSpaceSetCollisionSlop(space, 0);
  cpBody* bodies[2];
  cpShape* shapes[2];
  for (int i = 0; i < 2; ++i) {
    const NewBody& b = scene.bodies[i];
    bodies[i] = cpSpaceAddBody(space, cpBodyNew(b.mass, b.moment));
    cpBodySetPosition(bodies[i], cpv(b.position.x, b.position.y));
    cpBodySetAngle(bodies[i], b.angle);
    cpBodySetVelocity(bodies[i], cpv(b.velocity.x, b.velocity.y));
    cpBodySetAngularVelocity(bodies[i], b.angular_velocity);
    std::vector<cpVect> corners;
    for (const Point p : scene.boxes[i].outer) corners.push_back(cpv(p.x, p.y));
    shapes[i] =
        cpSpaceAddShape(space, cpPolyShapeNewRaw(bodies[i], static_cast<int>(corners.size()), corners.data(), 0));
    cpShapeSetElasticity(shapes[i], i == 0 ? scene.restitution : 1);  // Chipmunk multiplies the two
    cpShapeSetFriction(shapes[i], i == 0 ? scene.friction : 1);
  }
  cpSpaceStep(space, 1e-14);
  Outcome outcome;
  for (int i = 0; i < 2; ++i) {
    const cpVect v = cpBodyGetVelocity(bodies[i]);
    outcome.velocity[i] = {v.x, v.y};
    outcome.angular_velocity[i] = cpBodyGetAngularVelocity(bodies[i]);
    cpSpaceRemoveShape(space, shapes[i]);
    cpSpaceRemoveBody(space, bodies[i]);
    cpShapeFree(shapes[i]);
    cpBodyFree(bodies[i]);
  }
  cpSpaceFree(space);
  return outcome;
}

struct OurOutcome : Outcome {
  std::vector<Contact> contacts;
  Bodies bodies;
};

OurOutcome with_ours(const Scene& scene) {
  OurOutcome outcome;
  Bodies& bodies = outcome.bodies;
  for (const NewBody& body : scene.bodies) add_body(bodies, body);
  outcome.contacts = ContactFinder(bodies).contacts(bodies, 1e-14);
  for (Contact& c : outcome.contacts) {
    c.friction = scene.friction;
    c.record = nullptr;
  }
  ContactSolver().solve(bodies, outcome.contacts, RestitutionLaw{.restitution = scene.restitution}, {20000, 1e-13});
  for (BodyIndex i = 0; i < 2; ++i) {
    outcome.velocity[i] = bodies.velocity[i];
    outcome.angular_velocity[i] = bodies.angular_velocity[i];
  }
  return outcome;
}

double difference(const Outcome& ours, const Outcome& theirs) {
  double worst = 0;
  for (int i = 0; i < 2; ++i) {
    worst = std::max({worst, length(ours.velocity[i] - theirs.velocity[i]),
                      std::abs(ours.angular_velocity[i] - theirs.angular_velocity[i])});
  }
  return worst;
}

void set_body(Scene& scene, int i, double width, double height, Point position, double angle) {
  scene.boxes[i] = rectangle(width, height);
  scene.bodies[i] = floe_body(scene.boxes[i], position, angle);
}

/// The corner of the right box is just inside the middle part of the left box's right face. Everything is turned about
/// the origin.
Scene corner_on_face(Random& random) {
  Scene scene;
  const double width = random.between(4, 20), height = random.between(6, 20);
  set_body(scene, 0, width, height, {-0.5 * width, 0}, 0);
  const double w = random.between(2, 15), h = random.between(2, 15), tilt = random.between(0.3, 1.2);
  set_body(scene, 1, w, h, {}, tilt);
  // If the tilt is in (0, π/2), the corner (−w/2, +h/2) is the leftmost.
  const Vector to_corner = rotate(geometry::Rotation::by(tilt), Vector{-0.5 * w, 0.5 * h});
  const double along = random.between(-0.4, 0.4) * height;
  scene.bodies[1].position = Point{-kOverlap, along} - to_corner;
  for (NewBody& body : scene.bodies) {
    body.velocity = {random.between(-2, 2), random.between(-2, 2)};
    body.angular_velocity = random.between(-0.2, 0.2);
  }
  scene.bodies[1].velocity.x -= 3;
  const double angle = random.angle();
  const geometry::Rotation turn = geometry::Rotation::by(angle);
  for (NewBody& body : scene.bodies) {
    body.position = Point{} + rotate(turn, body.position - Point{});
    body.velocity = rotate(turn, body.velocity);
    body.angle += angle;
  }
  return scene;
}

/// Returns Polynya's outcome after checking that it agrees with Chipmunk's.
OurOutcome agreed(const Scene& scene) {
  OurOutcome ours = with_ours(scene);
  EXPECT_EQ(ours.contacts.size(), 1u);
  EXPECT_LT(difference(ours, with_chipmunk(scene)), kAgreement);
  return ours;
}

TEST(Chipmunk, CentralHitsFaceToFaceAgree) {
  for (const double restitution : {0.0, 0.1, 0.5, 1.0}) {
    for (const double friction : {0.0, 0.2}) {
      Scene scene;
      set_body(scene, 0, 10, 8, {-5, 0}, 0);
      set_body(scene, 1, 14, 8, {7 - kOverlap, 0}, 0);
      scene.bodies[0].velocity = {0.7, 0};
      scene.bodies[1].velocity = {-1.3, 0};
      scene.restitution = restitution;
      scene.friction = friction;
      const OurOutcome ours = agreed(scene);
      EXPECT_NEAR(ours.velocity[1].x - ours.velocity[0].x, 2 * restitution, 1e-9);
    }
  }
}

TEST(Chipmunk, PlasticHitsOffCentreFaceToFaceAgree) {
  Random random(kChipmunkSeed);
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    Scene scene;
    const double h0 = random.between(4, 20), h1 = random.between(4, 20);
    set_body(scene, 0, 10, h0, {-5, 0}, 0);
    set_body(scene, 1, random.between(3, 30), h1, {}, 0);
    const double width = 2 * scene.boxes[1].outer[1].x;
    scene.bodies[1].position = {0.5 * width - kOverlap, random.between(-0.45, 0.45) * (h0 + h1)};
    scene.bodies[1].velocity = {random.between(-3, -0.5), random.between(-1, 1)};
    scene.friction = i % 2 == 0 ? 0 : random.between(0.05, 0.8);
    agreed(scene);
  }
}

TEST(Chipmunk, CornersOnFacesAgreeWithoutFrictionAndPlasticOnesWithIt) {
  Random random(kChipmunkSeed);
  int hits = 0, sticking = 0;
  for (int i = 0; i < 2000 && !HasFailure(); ++i) {
    Scene scene = corner_on_face(random);
    (i % 2 == 0 ? scene.restitution : scene.friction) = random.between(0, 1);
    const Contact c = agreed(scene).contacts.at(0);
    hits += i % 2 == 0 && c.total_normal_impulse() > 0;
    sticking += i % 2 == 1 && std::abs(c.slip_impulse) < 0.999 * c.friction * c.total_normal_impulse();
  }
  EXPECT_GT(hits, 800);
  EXPECT_GT(sticking, 100);
  EXPECT_LT(sticking, 900);
}

TEST(Chipmunk, ElasticCornersOnFacesAgreeWithFrictionWhereTheySlide) {
  Random random(kChipmunkSeed);
  int compared = 0;
  for (int i = 0; i < 1000 && !HasFailure(); ++i) {
    Scene scene = corner_on_face(random);
    scene.restitution = random.between(0.05, 1);
    scene.friction = random.between(0.02, 0.3);
    const OurOutcome ours = with_ours(scene);
    const Contact& c = ours.contacts.at(0);
    const bool is_at_cone =
        std::abs(c.slip_impulse) > (1 - 1e-9) * c.friction * c.total_normal_impulse() && c.total_normal_impulse() > 0;
    if (!is_at_cone || c.slip_speed * slip_speed(ours.bodies, c) <= 0) continue;
    ++compared;
    EXPECT_LT(difference(ours, with_chipmunk(scene)), kAgreement) << i;
  }
  EXPECT_GT(compared, 300);
}

}  // namespace
}  // namespace polynya::dynamics
