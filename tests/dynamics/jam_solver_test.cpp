// Newton's method for jams: at the velocities found every contact obeys its law, in hard jams too.
#include "dynamics/contact/jam_solver.hpp"

#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "dynamics/contact/internal/jam_matrix.hpp"
#include "tests/dynamics/scenery.hpp"

namespace polynya::dynamics {
namespace {

using geometry::Vector;
using namespace scenery;

constexpr double kSlipSpeed = 0.02;  // [m/s]
constexpr double kNarrow = 5e-5;     // [m/s]

/// Floes of 10 m, side by side in columns and rows, between a moving wall and a fixed wall.
struct Pack {
  Bodies bodies;
  std::vector<SolverBody> solver_bodies;
  std::vector<Contact> contacts;
  std::vector<ContactConstraint> constraints;
  std::vector<EndLaws> laws;
};

void add_contact(Pack& pack, Random& random, BodyIndex a, BodyIndex b, geometry::Point middle, Vector normal,
                 double friction) {
  pack.contacts.push_back(contact_at(a, b, middle, normal, random.between(0.5, 8), friction));
  pack.constraints.push_back(make_constraint(pack.bodies, pack.contacts.back(), a, b, pack.solver_bodies));
  const double force = std::pow(10.0, random.between(4, 7));
  const CrushResponse end{.impulse_of_force = 0.01 * force,
                          .slope = 1e-4 * force * random.between(0, 20),
                          .gap_speed = random.below(3) == 0 ? random.between(0, 0.1) : 0,
                          .cap = random.below(8) == 0 ? 0.015 * force : std::numeric_limits<double>::infinity()};
  pack.laws.push_back({end, end});
}

Pack pack_of(Random& random, int columns, int rows, double friction) {
  Pack pack;
  const auto wall = [&](double x, double speed) {
    const BodyIndex i = add_floe(pack.bodies, rectangle(10, 10.0 * rows), {x, 5.0 * rows}, {speed, 0});
    pack.bodies.inverse_mass[i] = pack.bodies.inverse_moment[i] = 0;
  };
  wall(-5, 1);
  wall(10.0 * columns + 5, 0);
  const auto floe_at = [&](int column, int row) { return static_cast<BodyIndex>(2 + column * rows + row); };
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) {
      const Vector velocity{random.between(-0.2, 0.5), random.between(-0.2, 0.2)};
      add_floe(pack.bodies, rectangle(10, 10), {10.0 * column + 5, 10.0 * row + 5}, velocity,
               random.between(-0.02, 0.02));
    }
  }
  for (BodyIndex i = 0; i < pack.bodies.size(); ++i)
    pack.solver_bodies.push_back({pack.bodies.velocity[i], pack.bodies.angular_velocity[i], pack.bodies.inverse_mass[i],
                                  pack.bodies.inverse_moment[i]});
  for (int row = 0; row < rows; ++row) {
    const double y = 10.0 * row + 5;
    add_contact(pack, random, 0, floe_at(0, row), {0, y}, {1, 0}, friction);
    add_contact(pack, random, 1, floe_at(columns - 1, row), {10.0 * columns, y}, {-1, 0}, friction);
    for (int column = 0; column + 1 < columns; ++column)
      add_contact(pack, random, floe_at(column, row), floe_at(column + 1, row), {10.0 * column + 10, y}, {1, 0},
                  friction);
  }
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row + 1 < rows; ++row)
      add_contact(pack, random, floe_at(column, row), floe_at(column, row + 1), {10.0 * column + 5, 10.0 * row + 10},
                  {0, 1}, friction);
  }
  return pack;
}

/// Makes every floe, or every second floe, lighter by up to `most_decades` decades.
void lighten(Pack& pack, Random& random, double most_decades, bool every_second = false) {
  for (BodyIndex i = 2; i < pack.bodies.size(); ++i) {
    if (every_second && random.below(2) == 0) continue;
    const double lighter = std::pow(10.0, random.between(0, most_decades));
    pack.solver_bodies[i].inverse_mass = pack.bodies.inverse_mass[i] *= lighter;
    pack.solver_bodies[i].inverse_moment = pack.bodies.inverse_moment[i] *= lighter;
  }
  for (std::size_t k = 0; k < pack.contacts.size(); ++k) {
    const ContactConstraint& c = pack.constraints[k];
    pack.constraints[k] = make_constraint(pack.bodies, pack.contacts[k], c.a, c.b, pack.solver_bodies);
  }
}

/// Returns the largest deviation of the impulses and velocities of a pack from the law, as a speed [m/s].
double largest_miss(const Pack& pack) {
  double largest = 0;
  for (std::size_t k = 0; k < pack.constraints.size(); ++k) {
    const ContactConstraint& c = pack.constraints[k];
    const ConstraintSpeeds speeds = speeds_at(c, pack.solver_bodies);
    for (std::size_t end = 0; end < 2; ++end) {
      const CrushResponse& law = pack.laws[k][end];
      const double missed = std::abs(c.normal_impulse[end] - crush_impulse(law, -speeds.apart[end]));
      largest = std::max(largest, missed / (1 / c.inverse_mass_at[end] + creep_slope(law)));
    }
  }
  return largest;
}

bool solve(Pack& pack, double slip_speed) {
  return solve_jam(pack.constraints, pack.laws, pack.solver_bodies, slip_speed);
}

TEST(JamSolver, EveryContactObeysItsLawInOnePass) {
  Random random(kSeed);
  for (const int size : {1, 3, 8, 15}) {
    Pack pack = pack_of(random, size, size, 0);
    ASSERT_TRUE(solve(pack, kSlipSpeed)) << size;
    EXPECT_LT(largest_miss(pack), 1e-8) << size;
  }
}

TEST(JamSolver, FrictionIsCoulombs) {
  Random random(kSeed);
  for (int trial = 0; trial < 10; ++trial) {
    Pack pack = pack_of(random, 5, 4, 0.2);
    ASSERT_TRUE(solve(pack, kSlipSpeed));
    EXPECT_LT(largest_miss(pack), 0.05 * kSlipSpeed);  // the bounds of friction are found to half of it
    int stuck = 0, sliding = 0;
    double largest = 0;  // [N s]
    for (const ContactConstraint& c : pack.constraints) largest = std::max(largest, c.normal_impulse[0]);
    for (const ContactConstraint& c : pack.constraints) {
      const double slip = speeds_at(c, pack.solver_bodies).slip;
      const double most = c.friction * (c.normal_impulse[0] + c.normal_impulse[1]);
      EXPECT_LE(std::abs(c.slip_impulse), 1.05 * most + 1e-3 * largest);
      if (most < 0.01 * largest) continue;
      EXPECT_LE(slip * c.slip_impulse, 1e-9) << "it opposes the slip";
      if (std::abs(slip) < kSlipSpeed) {
        ++stuck;
      } else {
        ++sliding;
        EXPECT_NEAR(std::abs(c.slip_impulse) / most, 1, 0.05);
      }
    }
    EXPECT_GT(stuck, 0);
    EXPECT_GT(sliding, 0);
  }
}

/// The kink of friction is as narrow as in the solver of whole steps, and the start is far from the solution. A solver
/// that chooses branches by the speeds alone solves few of these jams, and one whose friction bounds are updated only
/// after each step solves 17.
TEST(JamSolver, SolvesJamsWithFrictionOfANarrowKink) {
  Random random(kSeed);
  for (int trial = 0; trial < 20; ++trial) {
    Pack pack = pack_of(random, 12, 12, 0.2);
    ASSERT_TRUE(solve(pack, kNarrow)) << trial;
    EXPECT_LT(largest_miss(pack), kNarrow);
  }
}

/// Brash between floes: half of the bodies are up to a hundred times lighter, and the start is far from the solution.
/// If all contacts may leave their branches at once, each end by itself, the contacts of light bodies alternate for
/// ever, and only 6 of these 40 jams are solved. If the solver does not reach the solution, either everything is as
/// before to the bit, or the result is kept because it is better. In that case velocities and impulses are consistent.
TEST(JamSolver, SolvesJamsOfFloesAndBrashOrKeepsWhatItCameToWhereThatIsBetter) {
  Random random(kSeed);
  int solved = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Pack pack = pack_of(random, 8, 8, 0.2);
    lighten(pack, random, 2, true);
    Pack found = pack, came_to = pack;
    if (solve(found, kNarrow)) {
      ++solved;
      EXPECT_LT(largest_miss(found), kNarrow);
      continue;
    }
    JamMemory memory;
    constexpr double kAny = std::numeric_limits<double>::max();
    EXPECT_FALSE(solve_jam(came_to.constraints, came_to.laws, came_to.solver_bodies, kNarrow, kAny, memory));
    double carried = 0;
    for (ContactConstraint& c : came_to.constraints) {
      carried += c.normal_impulse[0] + c.normal_impulse[1];
      apply_impulses(c, -c.normal_impulse[0], -c.normal_impulse[1], -c.slip_impulse, came_to.solver_bodies);
    }
    EXPECT_GT(carried, 0);
    for (std::size_t i = 0; i < pack.solver_bodies.size(); ++i) {
      EXPECT_EQ(found.solver_bodies[i].velocity.x, pack.solver_bodies[i].velocity.x);
      EXPECT_NEAR(came_to.solver_bodies[i].velocity.x, pack.solver_bodies[i].velocity.x, 1e-8);
    }
  }
  EXPECT_GE(solved, 24);
  EXPECT_LT(solved, 40);
}

/// Initial impulses are not part of the problem: the solution does not depend on them.
TEST(JamSolver, StartsFromAnyImpulses) {
  Random random(kSeed);
  Pack pack = pack_of(random, 6, 6, 0), from_nothing = pack;
  ASSERT_TRUE(solve(from_nothing, kSlipSpeed));
  for (ContactConstraint& c : pack.constraints) {
    c.normal_impulse[0] = 1e4;
    apply_impulses(c, 1e4, 0, 0, pack.solver_bodies);
  }
  ASSERT_TRUE(solve(pack, kSlipSpeed));
  for (std::size_t i = 0; i < pack.solver_bodies.size(); ++i)
    EXPECT_LT(length(pack.solver_bodies[i].velocity - from_nothing.solver_bodies[i].velocity), 1e-9);
}

/// Memory of other jams, between other bodies or the same bodies, does not change a bit of the result.
TEST(JamSolver, FindsTheSameWithTheMemoryOfOtherJams) {
  JamMemory memory;
  for (const int columns : {6, 4, 4, 6}) {
    Random random(kSeed);
    Pack with_memory = pack_of(random, columns, 6, 0.2);
    Pack alone = with_memory;
    ASSERT_TRUE(solve_jam(with_memory.constraints, with_memory.laws, with_memory.solver_bodies, kSlipSpeed, 0, memory));
    ASSERT_TRUE(solve(alone, kSlipSpeed));
    for (std::size_t i = 0; i < alone.solver_bodies.size(); ++i) {
      EXPECT_EQ(with_memory.solver_bodies[i].velocity.x, alone.solver_bodies[i].velocity.x);
      EXPECT_EQ(with_memory.solver_bodies[i].angular_velocity, alone.solver_bodies[i].angular_velocity);
    }
  }
}

/// Lets the pack's contacts overlap and crush, for the whole solver; returns their records.
std::vector<PersistentContact> press(Pack& pack) {
  std::vector<PersistentContact> records(pack.contacts.size());
  for (std::size_t i = 0; i < pack.contacts.size(); ++i) {
    pack.contacts[i].record = &records[i];
    pack.contacts[i].depth = pack.contacts[i].paid_depth = 0.05;
    pack.contacts[i].crushing_force = 200 * pack.laws[i][0].impulse_of_force;
    pack.contacts[i].crushing_stiffness = pack.contacts[i].crushing_force;
  }
  return records;
}

/// Returns the residual of the whole solver. The pack stays as it is except for its records.
double residual_of(Pack pack, int sweeps, double tolerance) {
  return ContactSolver().solve(pack.bodies, pack.contacts, CrushLaw{.step = 0.01}, {sweeps, tolerance}).residual;
}

/// Sweeps do not solve this pack, but the solver of whole steps reaches its tolerance.
TEST(JamSolver, SolvesWhatSweepsDoNot) {
  Random random(kSeed);
  Pack pack = pack_of(random, 20, 8, 0);
  std::vector<PersistentContact> records = press(pack);
  EXPECT_GT(residual_of(pack, 10, 1e-6), 1e-5) << "before the first pass of Newton's method";
  for (PersistentContact& record : records) record = {};
  EXPECT_LE(residual_of(pack, 60, 1e-6), 1e-6);
}

/// Newton's solution ends the sweeps if no contact deviates from its law there. A further sweep adds up the deviations
/// of single contacts: by its residual four of these jams are not solved.
TEST(JamSolver, WhatNewtonsMethodSolvesIsNotSweptAgain) {
  Random random(kSeed);
  for (int trial = 0; trial < 42; ++trial) {
    Pack pack = pack_of(random, 5 + trial % 16, 15, 0.3);
    lighten(pack, random, 1);
    std::vector<PersistentContact> records = press(pack);
    EXPECT_LE(residual_of(pack, 25, 1e-4), 1e-4) << trial;
  }
}

/// A step that repeats itself starts where the previous one ended, friction included.
TEST(JamSolver, AJamThatStaysIsSolvedByOneSweep) {
  Random random(kSeed);
  Pack pack = pack_of(random, 8, 6, 0.2);
  std::vector<PersistentContact> records = press(pack);
  const auto residual = [&](int sweeps) { return residual_of(pack, sweeps, 1e-4); };
  EXPECT_GT(residual(1), 1e-2);
  for (PersistentContact& record : records) record = {};
  ASSERT_LE(residual(200), 1e-4);
  EXPECT_LE(residual(1), 2e-4);
  for (PersistentContact& record : records) record.last_slip_impulse = 0;
  EXPECT_GT(residual(1), 1e-2) << "without its friction";
}

// ---- the factorization of jams' matrices against a dense one

struct Problem {
  int bodies = 0;
  JamVector mass;  // mass by body, with one entry more for bodies of prescribed motion
  std::vector<JamRows> rows;
  std::vector<JamLoad> loads;
};

/// The unknowns of the bodies are one after the other.
template <class Unknowns>
auto& unknown(Unknowns& of_bodies, Eigen::Index i) {
  return of_bodies[static_cast<std::size_t>(i / 3)][static_cast<std::size_t>(i % 3)];
}

/// Contacts between randomly drawn bodies. Some bodies have prescribed motion, some pairs meet twice, and a third of
/// the contacts carries no load.
Problem problem_of(Random& random, int bodies, double friction) {
  Problem problem{.bodies = bodies, .mass = JamVector(static_cast<std::size_t>(bodies) + 1), .rows = {}, .loads = {}};
  for (int i = 0; i < 3 * bodies; ++i) unknown(problem.mass, i) = std::pow(10.0, random.between(0, 3));
  for (int k = 0; k < 2 * bodies; ++k) {
    JamRows rows{};
    rows.a = random.below(bodies + 1) - 1;
    do rows.b = random.below(bodies + 1) - 1;
    while (rows.b == rows.a);
    for (int row = 0; row < 3; ++row) {
      for (int i = 0; i < 3; ++i) {
        rows.of_a[row][i] = random.between(-1, 1);
        rows.of_b[row][i] = random.between(-1, 1);
      }
    }
    JamLoad load{};
    if (random.below(3) != 0) {
      for (double& slope : load.slope) slope = std::pow(10.0, random.between(-1, 4));
      for (int end = 0; end < 2; ++end) load.slip_by_apart[end] = friction * load.slope[end];
    }
    problem.rows.push_back(rows);
    problem.loads.push_back(load);
  }
  return problem;
}

Eigen::VectorXd flat(const JamVector& of_bodies) {
  Eigen::VectorXd all(3 * (static_cast<Eigen::Index>(of_bodies.size()) - 1));
  for (Eigen::Index i = 0; i < all.size(); ++i) all[i] = unknown(of_bodies, i);
  return all;
}

/// Returns a right-hand side with values from −1 to 2.
JamVector right_side(int bodies) {
  JamVector right(static_cast<std::size_t>(bodies) + 1);
  for (int i = 0; i < 3 * bodies; ++i) unknown(right, i) = -1 + 3.0 * i / (3 * bodies);
  return right;
}

Eigen::VectorXd solution_of(const JamMatrix& matrix, JamVector right) {
  matrix.solve(right);
  return flat(right);
}

Eigen::MatrixXd dense(const Problem& problem) {
  Eigen::MatrixXd matrix = flat(problem.mass).asDiagonal();
  for (std::size_t k = 0; k < problem.rows.size(); ++k) {
    const JamRows& rows = problem.rows[k];
    const JamLoad& load = problem.loads[k];
    Eigen::MatrixXd speeds = Eigen::MatrixXd::Zero(3, 3 * Eigen::Index{problem.bodies});
    for (int row = 0; row < 3; ++row) {
      for (int i = 0; i < 3; ++i) {
        if (rows.a >= 0) speeds(row, 3 * rows.a + i) = rows.of_a[row][i];
        if (rows.b >= 0) speeds(row, 3 * rows.b + i) = rows.of_b[row][i];
      }
    }
    Eigen::Matrix3d slopes = Eigen::Vector3d(load.slope[0], load.slope[1], load.slope[2]).asDiagonal();
    for (int end = 0; end < 2; ++end) slopes(2, end) = load.slip_by_apart[end];
    matrix += speeds.transpose() * slopes * speeds;
  }
  return matrix;
}

/// New or one for one jam after another, with other bodies or between others.
TEST(JamMatrix, SolvesWhatADenseMatrixSolves) {
  Random random(kSeed);
  JamMatrix of_all;
  for (const double friction : {0.0, 0.3}) {
    for (const int bodies : {1, 2, 7, 7, 40, 120, 7}) {
      Problem problem = problem_of(random, bodies, friction);
      JamMatrix of_one(bodies, problem.rows);
      of_all.take(bodies, problem.rows);
      for (int time = 0; time < 2; ++time) {  // the second with other slopes in the same places
        const JamVector right = right_side(bodies);
        const Eigen::VectorXd expected = dense(problem).partialPivLu().solve(flat(right));
        for (JamMatrix* matrix : {&of_one, &of_all}) {
          ASSERT_TRUE(matrix->factorize(problem.mass, problem.rows, problem.loads));
          EXPECT_LT((solution_of(*matrix, right) - expected).norm(), 1e-8 * expected.norm())
              << bodies << " bodies, friction " << friction << ", time " << time;
        }
        std::rotate(problem.loads.begin(), problem.loads.begin() + 1, problem.loads.end());
      }
    }
  }
}

/// Rows of bodies without a changed slope are kept. The factors equal the factors of a newly assembled matrix bit for
/// bit.
TEST(JamMatrix, KeepsRowsWithoutChangedSlopes) {
  Random random(kSeed);
  Problem problem = problem_of(random, 40, 0.3);
  JamMatrix matrix(40, problem.rows);
  ASSERT_TRUE(matrix.factorize(problem.mass, problem.rows, problem.loads));
  const JamVector right = right_side(40);
  for (int time = 0; time < 20; ++time) {
    JamLoad& changed = problem.loads[static_cast<std::size_t>(random.below(80))];
    changed = time % 3 == 0 ? JamLoad{} : problem.loads[static_cast<std::size_t>(random.below(80))];
    ASSERT_TRUE(matrix.factorize(problem.mass, problem.rows, problem.loads));
    JamMatrix other(40, problem.rows);
    ASSERT_TRUE(other.factorize(problem.mass, problem.rows, problem.loads));
    EXPECT_EQ(solution_of(matrix, right), solution_of(other, right)) << time;
  }
}

TEST(JamMatrix, IsTheSameOnAnyNumberOfThreads) {
  Random random(kSeed);
  const Problem problem = problem_of(random, 300, 0.3);
  std::vector<JamVector> found;
  for (const int threads : {1, 2, 3, 8}) {
    JamMatrix matrix(300, problem.rows);
    ASSERT_TRUE(matrix.factorize(problem.mass, problem.rows, problem.loads, threads));
    matrix.solve(found.emplace_back(right_side(300)), threads);
    EXPECT_EQ(found.back(), found.front()) << threads;
  }
}

TEST(JamMatrix, RefusesWhatIsSingular) {
  Random random(kSeed);
  Problem problem = problem_of(random, 5, 0);
  for (auto& of_body : problem.mass) of_body = {};
  for (JamLoad& load : problem.loads) load = {};
  EXPECT_FALSE(JamMatrix(5, problem.rows).factorize(problem.mass, problem.rows, problem.loads));
}

}  // namespace
}  // namespace polynya::dynamics
