// Eq. (5) of [Sawamura2017], corrected. The tests cover restitution, momentum and energy for single random contacts and
// for several contacts together, the force of a contact that crushes, and overlap that is removed without adding speed.
#include <gtest/gtest.h>

#include "dynamics/contact/contact_tracker.hpp"
#include "dynamics/contact/restitution_law.hpp"
#include "tests/dynamics/scenery.hpp"

namespace polynya::dynamics {
namespace {

using geometry::Point;
using geometry::Vector;
using namespace scenery;

constexpr int kTrials = 20000;

NewBody random_body(Random& random) {
  NewBody body = floe_body(rectangle(2, 2), {random.between(-20, 20), random.between(-20, 20)}, random.angle());
  body.velocity = {random.between(-3, 3), random.between(-3, 3)};
  body.angular_velocity = random.between(-0.5, 0.5);
  body.mass = std::pow(10.0, random.between(3, 7));
  body.moment = body.mass * std::pow(10.0, random.between(0, 3));
  return body;
}

struct Trial {
  Bodies bodies;
  std::vector<Contact> contacts;
};

/// Two random bodies and one contact between them, approaching.
Trial random_trial(Random& random) {
  for (;;) {
    Trial trial;
    for (int i = 0; i < 2; ++i) add_body(trial.bodies, random_body(random));
    const double angle = random.angle();
    const Point middle{random.between(-20, 20), random.between(-20, 20)};
    trial.contacts = {contact_at(0, 1, middle, {std::cos(angle), std::sin(angle)})};
    if (parting_speed(trial.bodies, trial.contacts[0]) < -1e-3) return trial;
  }
}

/// Two plates that meet at a point of their boundaries: a rectangle's reaches at most √3 gyration radii from
/// its centre.
Trial random_plates(Random& random, double width, double friction) {
  for (;;) {
    Trial trial;
    const double angle = random.angle();
    for (const double side : {std::numbers::pi, 0.0}) {
      NewBody body = random_body(random);
      const double gyration = std::pow(10.0, random.between(0, 1.5));
      const double away = gyration * random.between(0.3, std::sqrt(3.0));
      const double towards = angle + side + random.between(-1.2, 1.2);
      body.position = {away * std::cos(towards), away * std::sin(towards)};
      body.moment = body.mass * gyration * gyration;
      add_body(trial.bodies, body);
    }
    trial.contacts = {contact_at(0, 1, {0, 0}, {std::cos(angle), std::sin(angle)}, width, friction)};
    if (parting_speed(trial.bodies, trial.contacts[0]) < -1e-3) return trial;
  }
}

/// Checks that momentum is conserved and no energy is gained between construction and check().
class Conserved {
 public:
  explicit Conserved(const Bodies& bodies)
      : momentum_(momentum(bodies)), turn_(angular_momentum(bodies)), energy_(kinetic_energy(bodies)) {
    for (BodyIndex i = 0; i < bodies.size(); ++i) scale_ += bodies.mass[i] * length(bodies.velocity[i]);
  }
  void check(const Bodies& bodies, double tolerance) const {
    EXPECT_LT(length(momentum(bodies) - momentum_), tolerance * scale_);
    EXPECT_LT(std::abs(angular_momentum(bodies) - turn_), 10 * tolerance * (30 * scale_ + 1e-12 * energy_));
    EXPECT_LE(kinetic_energy(bodies), energy_ * (1 + tolerance));
  }

 private:
  Vector momentum_;
  double turn_, energy_;
  double scale_ = 0;
};

/// Returns the mobility of one body of a trial. The arm may belong to the same body or to the other body.
Mobility mobility(const Trial& t, BodyIndex body, BodyIndex arm_of) {
  return {t.bodies.inverse_mass[body], t.bodies.inverse_moment[body],
          t.contacts[0].middle() - t.bodies.position[arm_of]};
}

TEST(RandomContacts, RestitutionIsExactAndMomentumKept) {
  Random random(kSeed);
  for (int i = 0; i < kTrials && !HasFailure(); ++i) {
    Trial t = random_trial(random);
    Contact& c = t.contacts[0];
    const RestitutionLaw law{.restitution = random.between(0, 1)};
    const double before = parting_speed(t.bodies, c);
    const Conserved conserved(t.bodies);
    const double mass = effective_mass(mobility(t, 0, 0), mobility(t, 1, 1), c.normal);
    const double predicted = collision_impulse(-before, law.restitution, mass);
    ASSERT_TRUE(ContactSolver().solve(t.bodies, t.contacts, law, {}).is_converged());
    EXPECT_NEAR(c.total_normal_impulse() / predicted, 1, 1e-9) << "trial " << i;
    EXPECT_NEAR(parting_speed(t.bodies, c) / before, -law.restitution, 1e-10);
    conserved.check(t.bodies, 1e-13);
  }
}

/// The printed equation crosses the arms: body i with the arm of k. This project deviates from it.
TEST(RandomContacts, TheEq5AsPrintedGainsEnergyWhereOursDoesNot) {
  Random random(kSeed);
  int gains = 0;
  for (int i = 0; i < 2000; ++i) {
    Trial t = random_trial(random);
    const Contact& c = t.contacts[0];
    const double crossed = effective_mass(mobility(t, 0, 1), mobility(t, 1, 0), c.normal);
    const double j = collision_impulse(-parting_speed(t.bodies, c), 0.1, crossed);
    const double energy = kinetic_energy(t.bodies);
    for (const BodyIndex b : {0, 1}) {
      const Mobility own = mobility(t, b, b);
      const double given = b == 0 ? -j : j;
      t.bodies.velocity[b] += given * own.inverse_mass * c.normal;
      t.bodies.angular_velocity[b] += given * own.inverse_moment * cross(own.arm, c.normal);
    }
    gains += kinetic_energy(t.bodies) > energy * (1 + 1e-12);
  }
  EXPECT_GT(gains, 400) << "of 2000";
}

/// Momentum is conserved and no energy is gained. Friction stops the slip, or acts against it at the limit of its cone.
TEST(RandomContacts, WithFrictionKeepToItsCone) {
  Random random(kSeed);
  int sticking = 0, slipping = 0;
  for (int i = 0; i < kTrials && !HasFailure(); ++i) {
    const bool is_plastic_point = i % 4 == 0;  // which converges, so that its slip is known
    Trial t = random_plates(random, i % 2 == 0 ? 0 : random.between(0, 5), random.between(0, 1));
    const Conserved conserved(t.bodies);
    const RestitutionLaw law{.restitution = is_plastic_point ? 0 : random.between(0, 1)};
    const SolverSettings settings = is_plastic_point ? SolverSettings{500, 1e-11} : SolverSettings{200};
    const SolverResult result = ContactSolver().solve(t.bodies, t.contacts, law, settings);
    const Contact& c = t.contacts[0];
    const double most = c.friction * c.total_normal_impulse();
    for (const double impulse : c.normal_impulse) EXPECT_GE(impulse, 0);
    EXPECT_LT(std::abs(c.slip_impulse) - most, 1e-6);
    conserved.check(t.bodies, 1e-12);
    if (!is_plastic_point) continue;
    ASSERT_TRUE(result.is_converged());
    const double slip = slip_speed(t.bodies, c);
    ++(std::abs(slip) < 1e-8 ? sticking : slipping);
    if (std::abs(slip) < 1e-8) continue;
    EXPECT_NEAR(std::abs(c.slip_impulse) / most, 1, 1e-6) << i;
    EXPECT_LT(c.slip_impulse * slip, 0) << i;
  }
  EXPECT_GT(sticking, 500);
  EXPECT_GT(slipping, 500);
}

/// A ship of prescribed speed, a floe ahead of it, and a plate of 220 times the floe's mass ahead of the floe, all
/// touching.
struct Pinch {
  Bodies bodies;
  std::vector<Contact> contacts;
  PersistentContact records[2];

  Pinch() {
    add_held(bodies, rectangle(120, 24), {-60, 0}, {1, 0});
    add_floe(bodies, rectangle(10, 10), {5, 0});
    add_floe(bodies, rectangle(200, 110), {110, 0});
    contacts = {contact_at(0, 1, {0, 0}, {1, 0}, 10), contact_at(1, 2, {10, 0}, {1, 0}, 10)};
    for (std::size_t i = 0; i < 2; ++i) contacts[i].record = &records[i];
  }
};

TEST(ContactsTogether, AFloePinchedBetweenAPrescribedShipAndAHeavyPlateFeelsBoth) {
  Pinch pinch;
  ContactSolver().solve(pinch.bodies, pinch.contacts, RestitutionLaw{.restitution = 0}, {20000});
  // The impact is plastic: both floes move on with the ship, and each contact carries the force that accelerates the
  // bodies beyond it.
  const Bodies& bodies = pinch.bodies;
  EXPECT_EQ(bodies.velocity[0], (Vector{1, 0}));
  EXPECT_NEAR(bodies.velocity[1].x, 1, 1e-3);
  EXPECT_NEAR(bodies.velocity[2].x, 1, 1e-3);
  const double plate = bodies.mass[2] * bodies.velocity[2].x;
  EXPECT_NEAR(pinch.contacts[1].total_normal_impulse() / plate, 1, 1e-10);
  EXPECT_NEAR(pinch.contacts[0].total_normal_impulse() / (plate + bodies.mass[1] * bodies.velocity[1].x), 1, 1e-10);
}

/// The pile-up is solved by many calls of thirty iterations, with and without the impulses that contacts keep from one
/// call to the next.
TEST(ContactsTogether, APinchedPlateComesToTheShipsSpeedFromBelow) {
  for (const double restitution : {0.0, 0.1}) {
    for (const bool has_records : {false, true}) {
      Pinch pinch;
      if (!has_records)
        for (Contact& c : pinch.contacts) c.record = nullptr;
      const double owed = has_records ? restitution : 0;
      ContactSolver solver;
      for (int step = 0; step < (has_records ? 1000 : 200); ++step) {
        solver.solve(pinch.bodies, pinch.contacts, RestitutionLaw{.restitution = restitution}, {});
        ASSERT_LE(pinch.bodies.velocity[2].x, 1 + 1.001 * owed + 2e-3) << step;
        ASSERT_LE(pinch.bodies.velocity[1].x, 1 + 2 * owed + 2e-3) << step;
      }
      EXPECT_GT(pinch.bodies.velocity[2].x, 0.99);
      EXPECT_NEAR(pinch.bodies.velocity[2].y, 0, 1e-12);
    }
  }
}

/// A row of six equal floes that touch, hit by one at its left end.
Trial cradle() {
  Trial row;
  for (BodyIndex i = 0; i < 6; ++i) add_floe(row.bodies, rectangle(10, 10), {10.0 * i, 0}, {i == 0 ? 2.0 : 0.0, 0});
  for (BodyIndex i = 0; i < 5; ++i) row.contacts.push_back(contact_at(i, i + 1, {10.0 * i + 5, 0}, {1, 0}, 10));
  return row;
}

TEST(ContactsTogether, ARowOfTouchingFloesKeepsItsMomentumAndGainsNoEnergy) {
  for (const double restitution : {0.0, 0.1, 0.5, 1.0}) {
    for (const int iterations : {30, 3000}) {
      Trial row = cradle();
      const Conserved conserved(row.bodies);
      double energy = kinetic_energy(row.bodies);
      for (int step = 0; step < 20; ++step) {
        std::vector<Contact> contacts = row.contacts;
        ContactSolver().solve(row.bodies, contacts, RestitutionLaw{.restitution = restitution}, {iterations});
        const double now = kinetic_energy(row.bodies);
        EXPECT_LE(now, energy * (1 + 1e-12)) << "restitution " << restitution << ", step " << step;
        energy = now;
      }
      conserved.check(row.bodies, 1e-12);
      if (iterations < 3000) continue;  // after thirty sweeps the two ends of a line may still differ
      for (const double spin : row.bodies.angular_velocity) EXPECT_NEAR(spin, 0, 1e-7);
    }
  }
}

TEST(ContactsTogether, APlasticRowMovesOnAsOne) {
  Trial row = cradle();
  const RestitutionLaw law{.restitution = 0};
  ASSERT_TRUE(ContactSolver().solve(row.bodies, row.contacts, law, {5000, 1e-12}).is_converged());
  for (const Vector velocity : row.bodies.velocity) EXPECT_NEAR(velocity.x, 2.0 / 6, 1e-9);
}

// ---- a contact that crushes

Bodies two_floes(double gap_speed, double offset) {
  Bodies bodies;
  add_floe(bodies, rectangle(12, 10), {-6, 0});
  add_floe(bodies, rectangle(20, 16), {10, offset}, {-gap_speed, 0});
  return bodies;
}

TEST(CrushLimit, IsNeverExceededAtEitherEnd) {
  Random random(kSeed);
  for (int i = 0; i < 5000; ++i) {
    Bodies bodies = two_floes(random.between(0.01, 4), random.between(-8, 8));
    bodies.angular_velocity[0] = random.between(-0.3, 0.3);
    std::vector<Contact> contacts{contact_at(0, 1, {0, random.between(-4, 4)}, {1, 0}, random.between(0, 2), 0.3)};
    Contact& c = contacts[0];
    c.crushing_force = std::pow(10.0, random.between(-2, 6));
    PersistentContact record;
    record.restitution.owed_impulse = random.between(0, 1e5);
    c.record = &record;
    ContactSolver().solve(bodies, contacts, RestitutionLaw{.restitution = random.between(0, 1)}, {});
    ASSERT_LE(c.total_normal_impulse(), c.crushing_force * (1 + 1e-15));
    ASSERT_LE(std::max(c.normal_impulse[0], c.normal_impulse[1]), c.crushing_force / 2);
    ASSERT_GE(record.restitution.owed_impulse, -1e-9) << "but for rounding";
  }
}

TEST(CrushLimit, HoldsTogetherWithOthers) {
  Bodies bodies = two_floes(2, 0);
  add_floe(bodies, rectangle(10, 10), {25, 0}, {-5, 0});
  std::vector<Contact> contacts{contact_at(0, 1, {0, 0}, {1, 0}, 8), contact_at(1, 2, {20, 0}, {1, 0}, 10)};
  contacts[0].crushing_force = 1e4;
  contacts[1].crushing_force = 2e4;
  const Conserved conserved(bodies);
  ContactSolver().solve(bodies, contacts, RestitutionLaw{}, {});
  for (const Contact& c : contacts) EXPECT_LE(c.total_normal_impulse(), c.crushing_force);
  conserved.check(bodies, 1e-13);
}

TEST(CrushLimit, ALimitedCollisionEndsAsEq5SaysOverManySteps) {
  // Poisson's hypothesis: the contact gives back ε times the impulse of compression, however many steps both take.
  for (const double restitution : {0.0, 0.1, 0.5, 1.0}) {
    for (const double offset : {0.0, 5.0}) {
      for (const double steps_of_compression : {0.3, 3.7, 40.2}) {
        Bodies bodies = two_floes(1, offset);
        const double energy = kinetic_energy(bodies);
        PersistentContact record;
        Contact contact = contact_at(0, 1, {0, 0}, {1, 0});
        contact.record = &record;
        const double before = parting_speed(bodies, contact);
        const double mass =
            1 / (bodies.inverse_mass[0] + bodies.inverse_mass[1] + offset * offset * bodies.inverse_moment[1]);
        contact.crushing_force = mass / steps_of_compression;
        double total = 0;
        for (int step = 0; step < 100; ++step) {
          std::vector<Contact> contacts{contact};
          ContactSolver().solve(bodies, contacts, RestitutionLaw{.restitution = restitution}, {});
          total += contacts[0].total_normal_impulse();
          ASSERT_LE(kinetic_energy(bodies), energy * (1 + 1e-12));
        }
        EXPECT_NEAR(parting_speed(bodies, contact), -restitution * before, 1e-10)
            << "offset " << offset << ", " << steps_of_compression;
        EXPECT_NEAR(total / ((1 + restitution) * mass), 1, 1e-10);
        EXPECT_NEAR(record.restitution.owed_impulse / mass, 0, 1e-10);
        EXPECT_GT(kinetic_energy(bodies) / energy, restitution == 1 ? 1 - 1e-10 : 0);
      }
    }
  }
}

/// Returns two bodies at rest, face to face.
Bodies overlapping(double depth, double offset) {
  Bodies bodies = two_floes(0, offset);
  bodies.position[1].x -= depth;
  return bodies;
}

TEST(Separation, GivesNoSpeedMovesNoCentreOfMassAndDecaysAsItSays) {
  Bodies bodies = overlapping(0.2, 0);
  ContactFinder finder(bodies);
  SeparationSettings settings;
  settings.time = 0.5;
  const double dt = 0.01;
  const auto centre = [&] { return bodies.mass[0] * bodies.position[0].x + bodies.mass[1] * bodies.position[1].x; };
  const double before = centre();
  double depth = 0;
  for (int step = 0; step < 300; ++step) {
    std::vector<Contact>& contacts = finder.contacts(bodies, dt);
    if (contacts.empty()) break;
    depth = only(contacts).depth;
    const double predicted = (0.2 - settings.slop) * std::pow(1 - dt / settings.time, step) + settings.slop;
    ASSERT_NEAR(depth, predicted, 1e-9) << step;
    separate(bodies, contacts, settings, dt);
    ASSERT_EQ(kinetic_energy(bodies), 0);
  }
  EXPECT_NEAR(depth, settings.slop, 0.2 * std::exp(-5.5));
  EXPECT_NEAR(centre(), before, 1e-6);
  EXPECT_NEAR(bodies.position[0].y, 0, 1e-12);
}

TEST(Separation, LeavesWhatCrushingMadeAndNeverMovesABodyOfPrescribedMotion) {
  const Bodies bodies = overlapping(0.2, 0);
  PersistentContact record;
  std::vector<Contact> contacts{contact_at(0, 1, {-0.1, 0}, {1, 0}, 10)};
  contacts[0].depth = 0.2;
  contacts[0].record = &record;
  const SeparationSettings settings;
  for (const double crushed : {0.15, 0.2}) {
    record.crushed_depth = crushed;
    Bodies moved = bodies;
    EXPECT_EQ(separate(moved, contacts, settings, settings.time), crushed < 0.2 ? 1 : 0);
    EXPECT_NEAR(moved.position[1].x - moved.position[0].x - (bodies.position[1].x - bodies.position[0].x),
                0.2 - crushed, 1e-12);
  }
  record.crushed_depth = 0;
  Bodies moved = bodies;
  moved.inverse_mass[0] = moved.inverse_moment[0] = 0;
  separate(moved, contacts, settings, settings.time);
  EXPECT_EQ(moved.position[0].x, bodies.position[0].x);
  EXPECT_NEAR(moved.position[1].x - bodies.position[1].x, 0.2, 2 * settings.slop);
}

TEST(Separation, CountsInWhatABodyHasTravelled) {
  // `travel` bounds the displacement of every point. The pair finder culls pairs by it.
  Bodies bodies = overlapping(0.3, 3);
  std::vector<Contact> contacts{contact_at(0, 1, {-0.1, 4}, {1, 0}, 2)};
  contacts[0].depth = 0.3;
  const Bodies before = bodies;
  separate(bodies, contacts, {}, 0.5);
  for (const BodyIndex i : all_of(bodies)) {
    for (const Point p : bodies.boundary[i]->edges.vertices) {
      const double way = distance(transform(water_from_body(before, i), p), transform(water_from_body(bodies, i), p));
      EXPECT_LE(way, bodies.travel[i] - before.travel[i] + 1e-15);
      EXPECT_GT(way, 0);
    }
  }
}

/// Two contacts of the bodies of a pair, at two places of b's face, with the given areas.
std::vector<Contact> two_contacts(double first, double second) {
  std::vector<Contact> contacts(2);
  for (std::size_t i = 0; i < 2; ++i) {
    Contact& c = contacts[i];
    c.a = 0, c.b = 1;
    c.normal = {1, 0};
    const double y = i == 0 ? -20 : 20;
    c.ends[0] = {0, y - 0.5}, c.ends[1] = {0, y + 0.5};
    c.tip_of_b = {0, y};
    c.width = 1, c.depth = c.area = i == 0 ? first : second;
  }
  return contacts;
}

/// Each contact takes the share of its area of the inherited paid overlap. This holds wherever the contact is, also if
/// a part of the overlap no longer has a contact.
TEST(Tracker, ContactsOfFragmentsTakeTheShareThatWasPaid) {
  const Bodies bodies = two_floes(0, 3);
  for (const double second : {0.4, 0.2}) {
    std::vector<PersistentContact> records(1), scratch;
    records[0].is_inherited = true;
    records[0].area = 0.5;
    records[0].paid_area = 0.3;
    records[0].booked.crushed = 0.2;
    std::vector<PartedContact> parted;
    std::vector<Contact> contacts = two_contacts(0.1, second);
    const std::vector<geometry::ContactManifold> manifolds(2);
    ContactTracker(0, 1, records, scratch, parted, 1, 0.01).update(contacts, manifolds, bodies);
    ASSERT_EQ(records.size(), 2U);
    EXPECT_NEAR(records[0].paid_area, 0.06, 1e-12);
    EXPECT_NEAR(records[1].paid_area, 0.6 * second, 1e-12);
    EXPECT_NEAR(records[0].booked.crushed, 0.04, 1e-12);
    EXPECT_NEAR(records[1].booked.crushed, 0.4 * second, 1e-12);
  }
}

/// The overlap of a broken floe existed before, although none of it was paid. It is pushed apart, and no impulse was
/// missed.
TEST(Tracker, ContactsOfFragmentsAreNotNewWhereTheirFloeOverlapped) {
  const Bodies bodies = two_floes(0, 3);
  for (const double area_before : {0.0, 0.5}) {
    std::vector<PersistentContact> records(1), scratch;
    records[0].is_inherited = true;
    records[0].area = area_before;
    std::vector<PartedContact> parted;
    std::vector<Contact> contacts = two_contacts(0.1, 0.4);
    const std::vector<geometry::ContactManifold> manifolds(2);
    ContactTracker(0, 1, records, scratch, parted, 1, 0.01).update(contacts, manifolds, bodies);
    for (const Contact& c : contacts) EXPECT_EQ(c.is_new, area_before == 0) << area_before;
  }
}

TEST(Tracker, EndsWhatWasCrushedWhereEdgesMeetWithoutAnOverlap) {
  const Bodies bodies = two_floes(0, 3);
  std::vector<PersistentContact> records(1), scratch;
  records[0].paid_area = records[0].crushed.area = 0.2;
  std::vector<PartedContact> parted;
  ContactTracker(0, 1, records, scratch, parted, 1, 0.01).update({}, {}, bodies);
  EXPECT_TRUE(records.empty());
  EXPECT_EQ(std::pair(only(parted).a, parted[0].b), std::pair(BodyIndex{0}, BodyIndex{1}));
  EXPECT_EQ(parted[0].crushed.area, 0.2);
}

}  // namespace
}  // namespace polynya::dynamics
