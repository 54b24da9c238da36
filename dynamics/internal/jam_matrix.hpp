#pragma once

#include <span>
#include <vector>

#include <Eigen/SparseCholesky>

namespace polynya::dynamics {

/// The rows of one contact: speeds apart at both ends and along the line, by the velocities of its bodies
/// (x, y, rotation), a's and b's.
struct JamRows {
  double of_a[3][3], of_b[3][3];
  int a, b;  ///< first unknown; −1 of bodies of prescribed motion
};

/// The impulses of one contact on b, on the straight pieces of its laws, and how they grow with the speeds.
struct JamLoad {
  double impulse[3];  ///< at both ends, apart; along the line [N s]
  double slope[3];    ///< ≥ 0 [N s per m/s]
};

/// M + Σ Jᵀ slope J of a jam's bodies and contacts: sparse, symmetric, positive definite. Which of its
/// elements there are, and the order of unknowns in which it is factorized, is found once, for all slopes.
class JamMatrix {
 public:
  JamMatrix(const Eigen::VectorXd& mass, std::span<const JamRows> rows);

  /// Returns whether it succeeded; it fails where masses and slopes differ by more than doubles bear.
  bool factorize(const Eigen::VectorXd& mass, std::span<const JamRows> rows, std::span<const JamLoad> loads);
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order_;  ///< by which few elements fill in
  Matrix upper_;             ///< its upper triangle, in that order
  std::vector<int> places_;  ///< of what factorize() adds up, in its order
  Eigen::SimplicialLLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<int>> cholesky_;
};

}  // namespace polynya::dynamics
