// Restitution over several steps with the impulse law. Bodies turn while their contact presses, so that restitution
// does other work than compression took. No collision may gain energy.
#include <algorithm>

#include <gtest/gtest.h>

#include "dynamics/contact/restitution_law.hpp"
#include "tests/dynamics/scenery.hpp"

namespace polynya::dynamics {
namespace {

using namespace scenery;

/// Force that crushing ice carries for each metre of a contact line [N/m].
constexpr double kLineStrength = 2.8e6 * 0.5;

/// Bodies that collide, step by step as in a simulation; nothing but their contacts changes their velocities.
class Collisions {
 public:
  Collisions(Bodies bodies, RestitutionLaw law, double friction, int iterations = 30)
      : bodies_(std::move(bodies)), finder_(bodies_), law_(law), friction_(friction), settings_{iterations} {}

  void step() {
    std::vector<Contact>& contacts = finder_.contacts(bodies_, law_.step);
    for (Contact& c : contacts) {
      c.friction = friction_;
      c.crushing_force = kLineStrength * c.width;
    }
    solver_.solve(bodies_, contacts, law_, settings_);
    stored_ = 0;
    for (Contact& c : contacts) {
      has_met_ = true;
      stored_ += c.record->stored_energy;
      if (c.is_at_limit && c.approach_speed > 0) c.record->crushed_depth = c.depth;
    }
    separate(bodies_, contacts, {}, law_.step);
    integrate(bodies_, all_of(bodies_), law_.step, 1);
  }
  bool has_met() const { return has_met_; }
  double kinetic() const { return kinetic_energy(bodies_); }  ///< [J]
  double stored() const { return stored_; }                   ///< energy stored by all contacts [J]

 private:
  Bodies bodies_;
  ContactFinder finder_;
  ContactSolver solver_;
  RestitutionLaw law_;
  double friction_;
  SolverSettings settings_;
  bool has_met_ = false;
  double stored_ = 0;
};

NewBody random_floe(Random& random, geometry::Point place) {
  NewBody floe = floe_body(rectangle(random.between(3, 12), random.between(3, 12)), place, random.angle());
  floe.angular_velocity = random.between(-0.5, 0.5);
  return floe;
}

/// Returns a floe that approaches another one, both spinning.
Bodies two_random_floes(Random& random) {
  Bodies bodies;
  NewBody coming = random_floe(random, {-13, 0});
  coming.velocity = {random.between(0.5, 5), 0};
  add_body(bodies, coming);
  add_body(bodies, random_floe(random, {0, random.between(-6, 6)}));
  return bodies;
}

/// Poisson's restitution holds for each end of a contact line: the end that was compressed more gives more back.
TEST(Restitution, EachEndGivesBackAShareOfItsOwnCompression) {
  const RestitutionLaw law{.restitution = 0.5};
  RestitutionLaw::State state{.record = nullptr, .crushing_impulse = 1e9, .stored_energy = 1e9};
  ContactConstraint constraint{};
  constraint.a = 0, constraint.b = 1;
  constraint.normal = {1, 0};
  constraint.inverse_mass_at[0] = constraint.inverse_mass_at[1] = 0.01;
  constraint.limit = 1e9;
  constraint.normal_impulse[0] = 30, constraint.normal_impulse[1] = 10;
  std::vector<SolverBody> bodies(2, {{}, 0, 0.005, 0});
  double stored = 1e9;
  EXPECT_TRUE(restore(law, true, stored, state, constraint, bodies));
  EXPECT_DOUBLE_EQ(constraint.normal_impulse[0], 45);
  EXPECT_DOUBLE_EQ(constraint.normal_impulse[1], 15);
  EXPECT_DOUBLE_EQ(bodies[1].velocity.x - bodies[0].velocity.x, 0.01 * 20);
}

TEST(Restitution, NoTwoFloesGainEnergyInACollision) {
  Random random(kSeed);
  int met = 0;
  for (const double restitution : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    for (int trial = 0; trial < 120; ++trial) {
      const RestitutionLaw law{.restitution = restitution, .step = trial % 2 == 0 ? 0.05 : 0.01};
      Collisions collision(two_random_floes(random), law, trial % 3 == 0 ? 0.3 : 0);
      const double before = collision.kinetic();
      for (double time = 0; time < 8; time += law.step) {
        collision.step();
        ASSERT_LE(collision.kinetic() + collision.stored(), before * (1 + 1e-12))
            << "restitution " << restitution << ", collision " << trial << ", " << time << " s";
      }
      met += collision.has_met();
    }
  }
  EXPECT_GT(met, 400) << "of 600 should collide";
}

/// Floes collide from all sides, so that contacts transmit the pressure of others.
TEST(Restitution, NoGroupOfFloesGainsEnergy) {
  Random random(kSeed);
  for (int trial = 0; trial < 40; ++trial) {
    Bodies bodies;
    for (int k = 0; k < 9; ++k) {
      NewBody floe = random_floe(random, {15.0 * (k % 3 - 1), 15.0 * (k / 3 - 1)});
      floe.velocity = -0.1 * (floe.position - geometry::Point{});
      add_body(bodies, floe);
    }
    Collisions group(bodies, {.restitution = random.between(0, 1), .step = 0.05}, 0, 3000);
    double before = group.kinetic();
    for (int step = 0; step < 200; ++step) {
      group.step();
      const double now = group.kinetic() + group.stored();
      ASSERT_LE(now, before * (1 + 1e-9)) << "group " << trial << ", step " << step;
      before = now;
    }
    EXPECT_TRUE(group.has_met()) << trial;
  }
}

/// The bound on energy changes nothing for bodies that do not turn: they part with the speed of Eq. (5).
TEST(Restitution, GivesBackAllThatCompressionTookWhereBodiesDoNotTurn) {
  for (const double restitution : {0.3, 1.0}) {
    Bodies bodies;
    add_floe(bodies, rectangle(10, 10), {-10.2, 0}, {2, 0});
    add_floe(bodies, rectangle(20, 10), {5, 0});
    const double before = kinetic_energy(bodies);
    const double relative = 2, reduced = bodies.mass[0] * bodies.mass[1] / (bodies.mass[0] + bodies.mass[1]);
    Collisions collision(bodies, {.restitution = restitution, .step = 0.005}, 0);
    for (int step = 0; step < 800; ++step) collision.step();
    const double lost = 0.5 * reduced * relative * relative * (1 - restitution * restitution);
    EXPECT_NEAR((before - collision.kinetic()) / before, lost / before, 1e-5) << restitution;
  }
}

}  // namespace
}  // namespace polynya::dynamics
