#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

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

/// Of each body three unknowns or what goes with them (x, y, rotation), and a lane of 0.
using JamVector = std::vector<std::array<double, 4>>;

/// Adds the speeds of contacts that velocities of their bodies make: those of prescribed motion have 0, one element
/// more than there are bodies.
POLYNYA_AVX2_CLONE void add_speeds(std::span<const JamRows> rows, std::span<const std::array<double, 4>> velocities,
                                   std::span<std::array<double, 3>> speeds);
/// Takes what the contacts' impulses give from the bodies' momenta, those of prescribed motion together at the end.
POLYNYA_AVX2_CLONE void subtract_impulses(std::span<const JamRows> rows, std::span<const JamLoad> loads,
                                          std::span<std::array<double, 4>> momenta);

/// M + Σ Jᵀ S J of a jam's bodies and contacts, S the slopes: sparse, positive definite, and symmetric where
/// no bound follows the speeds. Factorized as L U, in blocks of the three unknowns of a
/// body, with pivots sought within them: the row of body i holds the blocks with those eliminated after it.
/// A step of Newton's method changes few slopes: bodies none of whose contacts, and none of those eliminated before
/// them that they are filled by, have other slopes than at the last factorization keep their rows.
/// A row takes from those of earlier bodies that fill it, which are below it in the elimination tree: branches of the
/// tree are worked on side by side, then what is left, the trunk. Each row takes them in their order, by any number of
/// threads.
class JamMatrix {
 public:
  JamMatrix() = default;
  JamMatrix(int bodies, std::span<const JamRows> rows) { take(bodies, rows); }

  /// Finds which blocks there are, for all slopes, and the order of elimination. Of a jam whose contacts are between
  /// the same bodies as those of the last one it keeps both. All rows of the next factorization are new.
  void take(int bodies, std::span<const JamRows> rows);

  /// `mass`: of the bodies, the same since they were taken, as the rows. Returns whether it succeeded; it fails where
  /// masses and slopes differ by more than doubles bear.
  bool factorize(const JamVector& mass, std::span<const JamRows> rows, std::span<const JamLoad> loads, int threads = 1);
  /// Solves in place; an element beyond those of the bodies stays.
  void solve(JamVector& x, int threads = 1) const;

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
  /// What a contact adds to them, found again where its slopes change.
  struct OfContact {
    Block of_a, of_b;
    Pair pair;
  };

  /// A body eliminated before another one, and their pair.
  struct Earlier {
    int body, pair;
  };
  /// What of a load is in the matrix.
  struct Slopes {
    double own[3], slip_by_apart[2];
    friend bool operator==(const Slopes&, const Slopes&) = default;
  };

  bool is_of(int bodies, std::span<const JamRows> rows) const;
  void order_bodies(std::span<const JamRows> rows);
  void find_pairs(std::span<const JamRows> rows);
  void find_targets();
  void find_contacts();
  void find_branches();
  template <class Work>
  void for_branches(int threads, Work work) const;
  std::span<const int> trunk() const;
  int pair_of(int earlier, int later) const;
  void mark_changed(std::span<const JamRows> rows, std::span<const JamLoad> loads);
  POLYNYA_AVX2_CLONE static void find_blocks(const Places& place, const JamRows& rows, const JamLoad& load,
                                             OfContact& found);
  POLYNYA_AVX2_CLONE void add_up(int body, const double* mass);
  POLYNYA_AVX2_CLONE void take_earlier(int body);
  POLYNYA_AVX2_CLONE bool factorize_row(int body);
  bool factorize_rows(std::span<const int> places, const JamVector& mass);
  POLYNYA_AVX2_CLONE void solve_lower_rows(std::span<const int> places, JamVector& x) const;
  POLYNYA_AVX2_CLONE void solve_upper_rows(std::span<const int> places, JamVector& x) const;

  std::vector<std::array<int, 2>> between_;  ///< the bodies of each contact
  std::vector<int> place_of_;                ///< of each body in the order of elimination
  std::vector<int> body_at_;                 ///< each place
  std::vector<std::vector<int>> later_of_;   ///< of each place, while its pairs are found
  std::vector<int> first_;                   ///< of each body's pairs with later ones, by place; one more at the end
  std::vector<Own> own_;                     ///< by place
  std::vector<int> later_;                   ///< of each pair: place of the one eliminated later
  std::vector<std::uint8_t> is_filled_;      ///< of each pair: not zero with the slopes at hand
  std::vector<Pair> pairs_;
  std::vector<int> targets_;        ///< the pair of each two bodies that have pairs with an earlier one
  std::vector<int> first_target_;   ///< of each pair's with those after it
  std::vector<int> first_earlier_;  ///< of each body, by place; one more at the end
  std::vector<Earlier> earlier_;
  std::vector<int> first_contact_;  ///< of each body, by place; one more at the end
  std::vector<int> contacts_;
  std::vector<Places> places_;
  std::vector<OfContact> of_contact_;
  std::vector<int> by_branch_;                ///< places, branch by branch and then the trunk's, each ascending
  std::vector<std::size_t> first_of_branch_;  ///< in these; one more at the end, of the trunk
  mutable JamVector ordered_;                 ///< by place
  std::vector<Slopes> slopes_;                ///< of the last factorization
  std::vector<std::uint8_t> is_changed_;      ///< of each body, by place: its row since the last factorization
};

}  // namespace polynya::dynamics
