// The factorization of jams' matrices against a dense one.
#include "dynamics/contact/internal/jam_matrix.hpp"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/dynamics/scenery.hpp"

namespace polynya::dynamics {
namespace {

using namespace scenery;

constexpr std::uint64_t kSeed = 20170611;

struct Problem {
  int bodies = 0;
  Eigen::VectorXd mass;
  std::vector<JamRows> rows;
  std::vector<JamLoad> loads;
};

/// Contacts between bodies drawn at random, some of prescribed motion, some that meet twice; a third of the
/// contacts carries nothing.
Problem problem_of(Random& random, int bodies, double friction) {
  Problem problem{.bodies = bodies, .mass = Eigen::VectorXd(3 * bodies), .rows = {}, .loads = {}};
  for (int i = 0; i < 3 * bodies; ++i) problem.mass[i] = std::pow(10.0, random.between(0, 3));
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

Eigen::MatrixXd dense(const Problem& problem) {
  Eigen::MatrixXd matrix = problem.mass.asDiagonal();
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

TEST(JamMatrix, SolvesWhatADenseMatrixSolves) {
  Random random(kSeed);
  for (const double friction : {0.0, 0.3}) {
    for (const int bodies : {1, 2, 7, 40}) {
      Problem problem = problem_of(random, bodies, friction);
      JamMatrix matrix(bodies, problem.rows);
      for (int time = 0; time < 2; ++time) {  // the second with other slopes in the same places
        ASSERT_TRUE(matrix.factorize(problem.mass, problem.rows, problem.loads));
        const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(3 * Eigen::Index{bodies}, -1, 2);
        const Eigen::VectorXd expected = dense(problem).partialPivLu().solve(right);
        EXPECT_LT((matrix.solve(right) - expected).norm(), 1e-8 * expected.norm())
            << bodies << " bodies, friction " << friction << ", time " << time;
        std::rotate(problem.loads.begin(), problem.loads.begin() + 1, problem.loads.end());
      }
    }
  }
}

TEST(JamMatrix, RefusesWhatIsSingular) {
  Random random(kSeed);
  Problem problem = problem_of(random, 5, 0);
  problem.mass.setZero();
  for (JamLoad& load : problem.loads) load = {};
  EXPECT_FALSE(JamMatrix(5, problem.rows).factorize(problem.mass, problem.rows, problem.loads));
}

}  // namespace
}  // namespace polynya::dynamics
