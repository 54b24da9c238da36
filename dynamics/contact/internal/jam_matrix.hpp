#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/shape/avx2_clone.hpp"

namespace polynya::dynamics {

/// The rows of one contact. Multiplied with the velocities (x, y, rotation) of its bodies a and b they give its
/// separating speeds at both ends and the speed along its line. A fourth lane, 0, makes each row as long as a register.
struct JamRows {
  double of_a[3][4], of_b[3][4];
  int a, b;  ///< numbers of the bodies; −1: prescribed motion
};

/// The impulses of one contact on b, on straight branches of its laws, and how fast they fall with the speeds.
struct JamLoad {
  double impulse[3];  ///< normal, at both ends; tangential [N s]
  double slope[3];    ///< decrease of each with its own speed, ≥ 0 [N s per m/s]
  /// Decrease of the tangential impulse with the separating speeds, by Coulomb's bound [N s per m/s].
  double slip_by_apart[2];
};

/// Three unknowns per body, or values that belong to them (x, y, rotation), and a lane that is 0.
using JamVector = std::vector<std::array<double, 4>>;

/// Adds to the speeds of contacts the changes that the bodies' velocities cause. `velocities` has one element more than
/// there are bodies, for prescribed motion; it is 0.
POLYNYA_AVX2_CLONE void add_speeds(std::span<const JamRows> rows, std::span<const std::array<double, 4>> velocities,
                                   std::span<std::array<double, 3>> speeds);
/// Subtracts the contacts' impulses from the momenta of the bodies. The last element sums up the bodies with prescribed
/// motion.
POLYNYA_AVX2_CLONE void subtract_impulses(std::span<const JamRows> rows, std::span<const JamLoad> loads,
                                          std::span<std::array<double, 4>> momenta);

/// The matrix M + Σ Jᵀ S J of the bodies and contacts of a jam, with the slopes S. It is sparse and positive definite,
/// and symmetric if no friction bound follows the speeds. It is factorized as L U, in blocks of the three unknowns of a
/// body, with pivoting inside the blocks. The row of body i holds the blocks with the bodies eliminated after it.
///
/// A Newton step changes few slopes. The row of a body is kept from the last factorization if no slope has changed at
/// its contacts, nor at the contacts of earlier bodies whose elimination fills its row.
///
/// A row depends on the rows of earlier bodies that fill it, which are below it in the elimination tree. Branches of
/// the tree are factorized in parallel, then the rest, the trunk. Each row takes their contributions in the same order
/// for any number of threads.
class JamMatrix {
 public:
  JamMatrix() = default;
  JamMatrix(int bodies, std::span<const JamRows> rows) { take(bodies, rows); }

  /// Finds the structure of the blocks, for all slopes, and the order of elimination. Both are kept if the contacts are
  /// between the same bodies as in the last jam. All rows are computed in the next factorization.
  void take(int bodies, std::span<const JamRows> rows);

  /// Factorizes the matrix. `mass` (of the bodies) and `rows` must not change between calls of take(). Returns true if
  /// it succeeds. It fails if masses and slopes differ by more than double precision can resolve.
  bool factorize(const JamVector& mass, std::span<const JamRows> rows, std::span<const JamLoad> loads, int threads = 1);
  /// Solves in place. An element after the bodies is not changed.
  void solve(JamVector& x, int threads = 1) const;

 private:
  /// A block; each row has a fourth lane, 0, that makes it as long as a register.
  struct alignas(32) Block {
    double at[3][4];
  };
  struct Own {
    Block block;
    int row[3];  ///< rows of the block in the order in which they are eliminated
  };
  /// The blocks of two bodies, (earlier, later) and (later, earlier) in the order of elimination. The second one is
  /// stored transposed, so that operations on both run along their rows.
  struct Pair {
    Block upper, lower;
  };
  /// The places to which a contact's blocks are added: its bodies' own blocks and their pair; −1: there is none.
  struct Places {
    int a, b, pair;
  };
  /// The blocks that a contact adds, computed again when its slopes change.
  struct OfContact {
    Block of_a, of_b;
    Pair pair;
  };

  /// A body that is eliminated before another one, and their pair.
  struct Earlier {
    int body, pair;
  };
  /// The slopes of a load that are in the matrix.
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
  std::vector<int> place_of_;                ///< place of each body in the order of elimination
  std::vector<int> body_at_;                 ///< body at each place
  std::vector<std::vector<int>> later_of_;   ///< later neighbours of each place, while pairs are found
  std::vector<int> first_;                   ///< first pair of each body with later ones, by place; one more at the end
  std::vector<Own> own_;                     ///< by place
  std::vector<int> later_;                   ///< of each pair: place of its later body
  std::vector<std::uint8_t> is_filled_;      ///< of each pair: not zero with the present slopes
  std::vector<Pair> pairs_;
  std::vector<int> targets_;        ///< for each two pairs of an earlier body: the pair of their later bodies
  std::vector<int> first_target_;   ///< first target of each pair
  std::vector<int> first_earlier_;  ///< first earlier body of each body, by place; one more at the end
  std::vector<Earlier> earlier_;
  std::vector<int> first_contact_;  ///< first contact of each body, by place; one more at the end
  std::vector<int> contacts_;
  std::vector<Places> places_;
  std::vector<OfContact> of_contact_;
  std::vector<int> by_branch_;  ///< places: branch by branch, then the trunk's, each ascending
  std::vector<std::size_t>
      first_of_branch_;                   ///< first place of each branch in these; one more at the end, for the trunk
  mutable JamVector ordered_;             ///< by place
  std::vector<Slopes> slopes_;            ///< slopes of the last factorization
  std::vector<std::uint8_t> is_changed_;  ///< of each body, by place: its row has changed since the last factorization
};

}  // namespace polynya::dynamics
