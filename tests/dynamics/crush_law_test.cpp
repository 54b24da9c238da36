// The law of crushing ice, at one contact and where many press on each other.
#include "dynamics/contact/crush_law.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/dynamics/scenery.hpp"

namespace polynya::dynamics {
namespace {

using geometry::Vector;
using namespace scenery;

CrushResponse random_response(Random& random) {
  CrushResponse r;
  r.impulse_of_force = std::pow(10.0, random.between(-2, 5));
  r.slope = random.below(4) == 0 ? 0 : std::pow(10.0, random.between(-2, 6));
  r.gap_speed = random.below(2) == 0 ? 0 : random.between(0, 1);
  r.cap = random.below(3) == 0 ? r.impulse_of_force * random.between(0.1, 3) : std::numeric_limits<double>::infinity();
  return r;
}

TEST(CrushLaw, NeverFallsNorJumpsAndCarriesNothingWhereBodiesPart) {
  Random random(kSeed);
  for (int i = 0; i < 2000; ++i) {
    const CrushResponse r = random_response(random);
    EXPECT_EQ(crush_impulse(r, r.gap_speed), 0);
    EXPECT_EQ(crush_impulse(r, r.gap_speed - random.between(0, 5)), 0);
    const double u = r.gap_speed + std::pow(10.0, random.between(-6, 1));
    const double step = 1e-9 * u;
    const double here = crush_impulse(r, u);
    const double there = crush_impulse(r, u + step);
    EXPECT_GE(there, here * (1 - 1e-12));
    EXPECT_LE(there - here, creep_slope(r) * step * (1 + 1e-3) + 1e-9 * here);
    EXPECT_LE(here, r.cap);
  }
}

TEST(CrushLaw, BothEndsObeyItTogether) {
  Random random(kSeed);
  for (int i = 0; i < 20000; ++i) {
    const std::array<CrushResponse, 2> ends{random_response(random), random_response(random)};
    EndsMobility k;
    k.at[0] = std::pow(10.0, random.between(-7, -2));
    k.at[1] = k.at[0] * std::pow(10.0, random.between(-2, 2));
    k.between = std::sqrt(k.at[0] * k.at[1]) * random.between(-1, 1);
    const std::array<double, 2> free{random.between(-1, 3), random.between(-1, 3)};
    const auto any_branch = [&] { return static_cast<CrushBranch>(random.below(4)); };
    ActiveBranches branches{{any_branch(), any_branch()}};  // wherever it starts from
    const auto p = crush_impulses(ends, {kinks_of(ends[0]), kinks_of(ends[1])}, k, free, branches);
    const std::array<double, 2> u{free[0] - k.at[0] * p[0] - k.between * p[1],
                                  free[1] - k.between * p[0] - k.at[1] * p[1]};
    for (std::size_t end = 0; end < 2; ++end) {
      // The error of the impulse is expressed as the velocity change that it causes at its own end.
      const double missed =
          std::abs(p[end] - crush_impulse(ends[end], u[end])) / (1 / k.at[end] + creep_slope(ends[end]));
      EXPECT_LT(missed, 1e-9) << "case " << i << " end " << end;
    }
  }
}

/// A row of floes pressed together between two walls that close, and the impulses to start from.
struct Jam {
  Bodies bodies;
  std::vector<Contact> contacts;
  std::vector<PersistentContact> records;
};

Jam jam_of(Random& random, int floes) {
  Jam jam;
  const auto wall = [&](double x, double speed) {
    const BodyIndex i = add_floe(jam.bodies, rectangle(10, 40), {x, 0}, {speed, 0});
    jam.bodies.inverse_mass[i] = jam.bodies.inverse_moment[i] = 0;
  };
  wall(-5, random.between(0, 1));
  wall(10.0 * floes + 5, -random.between(0, 1));
  for (int i = 0; i < floes; ++i) {
    NewBody body = floe_body(rectangle(10, random.between(5, 20)), {10.0 * i + 5, random.between(-2, 2)});
    body.velocity = {random.between(-1, 1), random.between(-0.2, 0.2)};
    body.angular_velocity = random.between(-0.05, 0.05);
    add_body(jam.bodies, body);
  }
  for (int i = 0; i <= floes; ++i) {
    const BodyIndex left = i == 0 ? 0 : i + 1, right = i == floes ? 1 : i + 2;
    const double normal = left < right ? 1 : -1;
    Contact c = contact_at(std::min(left, right), std::max(left, right), {10.0 * i, random.between(-2, 2)}, {normal, 0},
                           random.between(0.5, 4));
    c.depth = c.paid_depth = random.between(0.001, 0.1);
    c.crushing_force = std::pow(10.0, random.between(3, 6.5));
    c.crushing_stiffness = c.crushing_force / c.depth * random.between(0, 2);
    jam.contacts.push_back(c);
  }
  return jam;
}

/// Gives the contacts of a jam records, which belong to the caller while the jam stays where it is.
void keep_records(Jam& jam) {
  jam.records.assign(jam.contacts.size(), {});
  for (std::size_t i = 0; i < jam.contacts.size(); ++i) jam.contacts[i].record = &jam.records[i];
}

TEST(ContactSolver, FindsOneAnswerWhateverItStartsFrom) {
  Random random(kSeed);
  for (int trial = 0; trial < 50; ++trial) {
    const Jam jam = jam_of(random, 2 + random.below(12));
    std::vector<Bodies> ends;
    double size_of_start = 0;
    for (int start = 0; start < 3; ++start) {
      Jam now = jam;
      keep_records(now);
      for (Contact& c : now.contacts) {
        c.paid_depth = 0.5 * c.depth;
        for (double& impulse : c.record->last_impulse)
          size_of_start += impulse = start == 0 ? 0 : random.between(0, 0.02) * c.crushing_force;
      }
      const SolverResult result =
          ContactSolver().solve(now.bodies, now.contacts, CrushLaw{.step = 0.01}, {20000, 1e-10});
      EXPECT_TRUE(result.is_converged()) << result.residual;
      ends.push_back(now.bodies);
    }
    ASSERT_GT(size_of_start, 0);
    for (BodyIndex i = 0; i < jam.bodies.size(); ++i) {
      for (const Bodies& end : ends) {
        EXPECT_LT(length(end.velocity[i] - ends[0].velocity[i]), 1e-6) << trial;
        EXPECT_NEAR(end.angular_velocity[i], ends[0].angular_velocity[i], 1e-6);
      }
    }
  }
}

class ByBothLaws : public ::testing::TestWithParam<ResponseLaw> {};

INSTANTIATE_TEST_SUITE_P(ContactSolver, ByBothLaws,
                         ::testing::Values(CrushLaw{.step = 0.01, .substeps = 4}, CrushLaw{.step = 0.01},
                                           RestitutionLaw{.restitution = 0, .step = 0.01},
                                           RestitutionLaw{.restitution = 0.5, .step = 0.01}));

TEST_P(ByBothLaws, MomentumIsKeptAndNoEnergyMade) {
  Random random(kSeed);
  for (int trial = 0; trial < 200; ++trial) {
    Jam jam = jam_of(random, 2 + random.below(6));
    jam.contacts.front().crushing_force = jam.contacts.back().crushing_force = 0;  // the walls let go
    jam.contacts.front().crushing_stiffness = jam.contacts.back().crushing_stiffness = 0;
    keep_records(jam);
    for (Contact& c : jam.contacts) c.friction = 0.2;
    const Vector p = momentum(jam.bodies);
    const double l = angular_momentum(jam.bodies);
    const double energy = kinetic_energy(jam.bodies);
    ContactSolver().solve(jam.bodies, jam.contacts, GetParam(), {100, 1e-6});
    EXPECT_LT(length(momentum(jam.bodies) - p), 1e-9 * (length(p) + 1e5));
    EXPECT_NEAR(angular_momentum(jam.bodies), l, 1e-9 * (std::abs(l) + 1e6));
    EXPECT_LE(kinetic_energy(jam.bodies), energy * (1 + 1e-12));
    double work = 0;
    for (const Contact& c : jam.contacts) work += c.normal_work + c.slip_work;
    EXPECT_NEAR(kinetic_energy(jam.bodies) - energy, work, 1e-9 * energy) << "the work entered is all";
  }
}

/// Two floes side by side, one of which moves, and their contact.
struct Pair {
  Bodies bodies;
  PersistentContact record;
  std::vector<Contact> contacts{contact_at(0, 1, {1, 0}, {1, 0}, 2, 0.5)};

  explicit Pair(Vector velocity) {
    add_floe(bodies, rectangle(2, 2), {0, 0});
    add_floe(bodies, rectangle(2, 2), {2, 0}, velocity);
    contacts[0].record = &record;
  }
};

TEST_P(ByBothLaws, BodiesThatPartAreLeftAlone) {
  Pair pair({0.5, 0.1});
  for (const double force : {1e5, std::numeric_limits<double>::infinity()}) {
    pair.contacts[0].crushing_force = force;
    ContactSolver().solve(pair.bodies, pair.contacts, GetParam(), {});
    EXPECT_EQ(pair.bodies.velocity[0], Vector{});
    EXPECT_EQ(pair.bodies.velocity[1], (Vector{0.5, 0.1}));
    EXPECT_EQ(pair.contacts[0].total_normal_impulse(), 0);
  }
}

/// An overlap of 1 mm becomes 20 mm deep in a step. The force extrapolated from the dimensions at 1 mm grows
/// twentyfold, but the ice of the bodies cannot transmit more than 30 kN.
TEST(CrushLaw, NoImpulseExceedsWhatTheLongestLineBears) {
  for (const double most : {3e4, std::numeric_limits<double>::infinity()}) {
    Pair pair({-2, 0});
    Contact& c = pair.contacts[0];
    c.depth = 1e-3, c.width = 2, c.area = 1e-3;
    c.crushing_force = 1e4;
    c.crushing_stiffness = 1e7;
    c.most_force = most;
    CrushLaw law;
    law.step = 0.01;
    ContactSolver().solve(pair.bodies, pair.contacts, law, {});
    EXPECT_FALSE(c.is_broken);
    if (std::isfinite(most))
      EXPECT_NEAR(c.total_normal_impulse(), law.step * most, 1e-9 * most);
    else
      EXPECT_GT(c.total_normal_impulse(), law.step * 4e4);
  }
}

/// A contact that does not crush ends the approach, with either law.
TEST_P(ByBothLaws, RigidBodiesStopEachOtherWhateverTheIceIs) {
  Pair pair({-1, 0});
  const auto* law = std::get_if<RestitutionLaw>(&GetParam());
  EXPECT_TRUE(ContactSolver().solve(pair.bodies, pair.contacts, GetParam(), {}).is_converged());
  EXPECT_NEAR(parting_speed(pair.bodies, pair.contacts[0]), law != nullptr ? law->restitution : 0, 1e-12);
  EXPECT_FALSE(pair.contacts[0].is_at_limit);
}

}  // namespace
}  // namespace polynya::dynamics
