// A contact that crushes carries no more than its ice can, and gives restitution back over as many steps as
// it needs; overlap is taken away without speed.
#include <algorithm>

#include <gtest/gtest.h>

#include "dynamics/contact/broad_phase.hpp"
#include "tests/dynamics/scenery.hpp"

namespace polynya::dynamics {
namespace {

using geometry::Point;
using geometry::Vector;
using namespace scenery;

constexpr std::uint64_t kSeed = 7;

Bodies two_floes(double gap_speed, double offset) {
  Bodies bodies;
  add_body(bodies, floe_body(rectangle(12, 10), {-6, 0}));
  NewBody right = floe_body(rectangle(20, 16), {10, offset});
  right.velocity = {-gap_speed, 0};
  add_body(bodies, right);
  return bodies;
}

TEST(CrushLimit, IsNeverExceededAtEitherEnd) {
  Random random(kSeed);
  ContactSolver solver;
  for (int i = 0; i < 5000; ++i) {
    Bodies bodies = two_floes(random.between(0.01, 4), random.between(-8, 8));
    bodies.angular_velocity[0] = random.between(-0.3, 0.3);
    std::vector<Contact> contacts{
        contact_at(0, 1, {0, random.between(-4, 4)}, {1, 0}, random.between(0, 2), 0.3)};
    contacts[0].crushing_force = std::pow(10.0, random.between(-2, 6));
    PersistentContact record;
    record.restitution.owed_impulse = random.between(0, 1e5);
    contacts[0].record = &record;
    const RestitutionLaw law{.restitution = random.between(0, 1)};
    solver.solve(bodies, contacts, law, {});
    ASSERT_LE(contacts[0].total_normal_impulse(), contacts[0].crushing_force * (1 + 1e-15));
    ASSERT_LE(std::max(contacts[0].normal_impulse[0], contacts[0].normal_impulse[1]),
              contacts[0].crushing_force / 2);
    ASSERT_GE(record.restitution.owed_impulse, -1e-9) << "but for rounding";
  }
}

TEST(CrushLimit, HoldsTogetherWithOthers) {
  Bodies bodies = two_floes(2, 0);
  NewBody third = floe_body(rectangle(10, 10), {25, 0});
  third.velocity = {-5, 0};
  add_body(bodies, third);
  std::vector<Contact> contacts{contact_at(0, 1, {0, 0}, {1, 0}, 8), contact_at(1, 2, {20, 0}, {1, 0}, 10)};
  contacts[0].crushing_force = 1e4;
  contacts[1].crushing_force = 2e4;
  const Vector p = momentum(bodies);
  ContactSolver().solve(bodies, contacts, RestitutionLaw{}, {});
  EXPECT_LE(contacts[0].total_normal_impulse(), 1e4);
  EXPECT_LE(contacts[1].total_normal_impulse(), 2e4);
  EXPECT_NEAR(momentum(bodies).x / p.x, 1, 1e-13);
}

TEST(CrushLimit, ALimitedCollisionEndsAsEq5SaysOverManySteps) {
  // Poisson: the contact gives back ε times what compressed it, however many steps both take.
  for (const double restitution : {0.0, 0.1, 0.5, 1.0}) {
    for (const double offset : {0.0, 5.0}) {
      for (const double steps_of_compression : {0.3, 3.7, 40.2}) {
        Bodies bodies = two_floes(1, offset);
        const double energy = kinetic_energy(bodies);
        PersistentContact record;
        Contact contact = contact_at(0, 1, {0, 0}, {1, 0});
        contact.record = &record;
        const double before = parting_speed(bodies, contact, {0, 0});
        const double mass = 1 / (bodies.inverse_mass[0] + bodies.inverse_mass[1] +
                                 offset * offset * bodies.inverse_moment[1]);
        contact.crushing_force = mass / steps_of_compression;
        const RestitutionLaw law{.restitution = restitution};
        double last_energy = energy;
        double total = 0;
        for (int step = 0; step < 100; ++step) {
          std::vector<Contact> contacts{contact};
          ContactSolver().solve(bodies, contacts, law, {});
          total += contacts[0].total_normal_impulse();
          ASSERT_LE(kinetic_energy(bodies), energy * (1 + 1e-12));
          last_energy = kinetic_energy(bodies);
        }
        EXPECT_NEAR(parting_speed(bodies, contact, {0, 0}), -restitution * before, 1e-10)
            << "offset " << offset << ", " << steps_of_compression;
        EXPECT_NEAR(total / ((1 + restitution) * mass), 1, 1e-10);
        EXPECT_NEAR(record.restitution.owed_impulse / mass, 0, 1e-10);
        if (restitution == 1) {
          EXPECT_NEAR(last_energy / energy, 1, 1e-10);
        }
      }
    }
  }
}

TEST(Separation, GivesNoSpeedMovesNoCentreOfMassAndDecaysAsItSays) {
  Bodies bodies = two_floes(0, 0);
  bodies.position[1].x -= 0.2;  // an overlap of 0.2 m, face to face
  BroadPhase finder({}, 20);
  for (const BodyIndex i : all_of(bodies)) finder.add(bodies, i);
  for (const BodyIndex i : all_of(bodies)) finder.wake(bodies, i);
  SeparationSettings settings;
  settings.time = 0.5;
  const double dt = 0.01;
  const double centre = bodies.mass[0] * bodies.position[0].x + bodies.mass[1] * bodies.position[1].x;
  std::vector<Contact> contacts;
  for (int step = 0; step < 300; ++step) {
    finder.update(bodies, all_of(bodies));
    finder.find_contacts(bodies, dt, contacts);
    if (contacts.empty()) break;
    ASSERT_EQ(contacts.size(), 1u);
    const double predicted = (0.2 - settings.slop) * std::pow(1 - dt / settings.time, step) + settings.slop;
    ASSERT_NEAR(contacts[0].depth, predicted, 1e-9) << step;
    separate(bodies, contacts, settings, dt);
    ASSERT_EQ(kinetic_energy(bodies), 0);
  }
  EXPECT_NEAR(contacts[0].depth, settings.slop, 0.2 * std::exp(-5.5));
  EXPECT_NEAR(bodies.mass[0] * bodies.position[0].x + bodies.mass[1] * bodies.position[1].x, centre, 1e-6);
  EXPECT_NEAR(bodies.position[0].y, 0, 1e-12);
}

TEST(Separation, LeavesWhatCrushingMadeAndNeverMovesABodyOfPrescribedMotion) {
  Bodies bodies = two_floes(0, 0);
  bodies.position[1].x -= 0.2;
  PersistentContact record;
  record.crushed_depth = 0.15;
  std::vector<Contact> contacts{contact_at(0, 1, {-0.1, 0}, {1, 0}, 10)};
  contacts[0].depth = 0.2;
  contacts[0].record = &record;
  SeparationSettings settings;
  Bodies moved = bodies;
  EXPECT_EQ(separate(moved, contacts, settings, settings.time), 1);
  const double opened =
      moved.position[1].x - moved.position[0].x - (bodies.position[1].x - bodies.position[0].x);
  EXPECT_NEAR(opened, 0.05, 1e-12);

  record.crushed_depth = 0.2;
  moved = bodies;
  EXPECT_EQ(separate(moved, contacts, settings, settings.time), 0);
  EXPECT_EQ(moved.position[1].x, bodies.position[1].x);

  record.crushed_depth = 0;
  moved = bodies;
  moved.inverse_mass[0] = moved.inverse_moment[0] = 0;
  separate(moved, contacts, settings, settings.time);
  EXPECT_EQ(moved.position[0].x, bodies.position[0].x);
  EXPECT_NEAR(moved.position[1].x - bodies.position[1].x, 0.2 - settings.slop * 0, 2 * settings.slop);
}

TEST(Separation, CountsInWhatABodyHasTravelled) {
  // `travel` bounds every point's displacement: what the pair finder culls by.
  Bodies bodies = two_floes(0, 3);
  bodies.position[1].x -= 0.3;
  std::vector<Contact> contacts{contact_at(0, 1, {-0.1, 4}, {1, 0}, 2)};
  contacts[0].depth = 0.3;
  const Bodies before = bodies;
  separate(bodies, contacts, {}, 0.5);
  for (const BodyIndex i : all_of(bodies)) {
    for (const Point p : bodies.boundary[i]->edges.vertices) {
      const double way =
          distance(transform(water_from_body(before, i), p), transform(water_from_body(bodies, i), p));
      EXPECT_LE(way, bodies.travel[i] - before.travel[i] + 1e-15);
      EXPECT_GT(way, 0);
    }
  }
}

}  // namespace
}  // namespace polynya::dynamics
