#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "geometry/shape/avx2_clone.hpp"

namespace polynya::dynamics {

/// The rows of one contact: speeds apart at both ends and along the line, by the velocities of its bodies
/// (x, y, rotation), a's and b's. A fourth lane, 0, makes each as long as a register.
struct JamRows {
  double of_a[3][4], of_b[3][4];
  int a, b;  ///< number of the body; −1 of bodies of prescribed motion
};

/// The impulses of one contact on b, on the straight branchs of its laws, and how they fall with the speeds.
struct JamLoad {
  double impulse[3];  ///< at both ends, apart; along the line [N s]
  double slope[3];    ///< of each with its own speed, ≥ 0 [N s per m/s]
  /// Of the one along the line with the speeds apart, by Coulomb's bound [N s per m/s].
  double slip_by_apart[2];
};

/// M + Σ Jᵀ S J of a jam's bodies and contacts, S the slopes: sparse, positive definite, and symmetric where
/// no bound follows the speeds. Factorized as L U, in blocks of the three unknowns of a
/// body, with pivots sought within them: the row of body i holds the blocks with those eliminated after it.
class JamMatrix {
 public:
  JamMatrix() = default;
  JamMatrix(int bodies, std::span<const JamRows> rows) { take(bodies, rows); }

  /// Finds which blocks there are, for all slopes, and the order of elimination. Of a jam whose contacts are between
  /// the same bodies as those of the last one it keeps both.
  void take(int bodies, std::span<const JamRows> rows);

  /// `mass`: 3 a body. Returns whether it succeeded; it fails where masses and slopes differ by more than
  /// doubles bear.
  bool factorize(const Eigen::VectorXd& mass, std::span<const JamRows> rows, std::span<const JamLoad> loads);
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  /// Each row has a fourth lane, 0, that makes it as long as a register.
  struct alignas(32) Block {
    double at[3][4];
  };
  struct Own {
    Block block;
    int row[3];  ///< of the block, in the order in which they are eliminated
  };
  /// The blocks of two bodies, (earlier, later) and (later, earlier) in the order of elimination; the second one
  /// transposed: what is done to both goes along their rows.
  struct Pair {
    Block upper, lower;
  };
  /// Where the blocks of a contact are added: the bodies' own ones, and their pair; −1 where there is none.
  struct Places {
    int a, b, pair;
  };

  bool is_of(int bodies, std::span<const JamRows> rows) const;
  void order_bodies(std::span<const JamRows> rows);
  void find_pairs(std::span<const JamRows> rows);
  void find_targets();
  int pair_of(int earlier, int later) const;
  void add_up(const Eigen::VectorXd& mass, std::span<const JamRows> rows, std::span<const JamLoad> loads);
  POLYNYA_AVX2_CLONE void eliminate(int body, const int* targets);
  POLYNYA_AVX2_CLONE void add(std::span<const JamRows> rows, std::span<const JamLoad> loads);

  std::vector<std::array<int, 2>> between_;  ///< the bodies of each contact
  std::vector<int> place_of_;                ///< of each body in the order of elimination
  std::vector<int> first_;                   ///< of each body's pairs with later ones, by place; one more at the end
  std::vector<Own> own_;                     ///< by place
  std::vector<int> later_;                   ///< of each pair: place of the one eliminated later
  std::vector<std::uint8_t> is_filled_;      ///< of each pair: not zero with the slopes at hand
  std::vector<Pair> pairs_;
  std::vector<int> targets_;  ///< the pair of each two bodies that have pairs with an earlier one
  std::vector<Places> places_;
};

}  // namespace polynya::dynamics
