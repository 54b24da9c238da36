#include "dynamics/contact/crush_law.hpp"

#include <cmath>

namespace polynya::dynamics {
namespace {

constexpr int kMostTries = 8;  ///< of Newton's; it seldom needs three

/// The two ends of one contact line and what slows them.
class EndPair {
 public:
  EndPair(const std::array<CrushResponse, 2>& ends, const EndsMobility& mobility,
          const std::array<double, 2>& closing_speed)
      : ends_(ends),
        creep_{creep_slope(ends[0]), creep_slope(ends[1])},
        mobility_(mobility),
        free_(closing_speed) {}

  std::array<double, 2> speeds(const std::array<double, 2>& impulse) const {
    return {free_[0] - mobility_.at[0] * impulse[0] - mobility_.between * impulse[1],
            free_[1] - mobility_.between * impulse[0] - mobility_.at[1] * impulse[1]};
  }
  /// The pieces nearest to impulses and the speeds that they leave.
  CrushPieces pieces_near(const std::array<double, 2>& impulse) const {
    const auto speed = speeds(impulse);
    return {{piece_near(ends_[0], speed[0], impulse[0], mobility_.at[0]),
             piece_near(ends_[1], speed[1], impulse[1], mobility_.at[1])}};
  }
  std::array<double, 2> solve_on(const CrushPieces& pieces) const {
    const CrushBranch p = branch_of(ends_[0], creep_[0], pieces.of[0]);
    const CrushBranch q = branch_of(ends_[1], creep_[1], pieces.of[1]);
    const double right_0 = p.at_rest + p.slope * (free_[0] - ends_[0].gap_speed);
    const double right_1 = q.at_rest + q.slope * (free_[1] - ends_[1].gap_speed);
    const double m00 = 1 + p.slope * mobility_.at[0];
    const double m11 = 1 + q.slope * mobility_.at[1];
    const double m01 = p.slope * mobility_.between;
    const double m10 = q.slope * mobility_.between;
    const double determinant = m00 * m11 - m01 * m10;  // ≥ 1: K is positive semidefinite
    return {(m11 * right_0 - m01 * right_1) / determinant, (m00 * right_1 - m10 * right_0) / determinant};
  }
  /// By how much impulses miss the law [N s].
  double violation(const std::array<double, 2>& impulse) const {
    const auto u = speeds(impulse);
    return std::max(std::abs(impulse[0] - crush_impulse(ends_[0], u[0])),
                    std::abs(impulse[1] - crush_impulse(ends_[1], u[1])));
  }
  std::array<double, 2> best_of_all() const {
    std::array<double, 2> best{};
    double least = violation(best);
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        const auto impulse = solve_on({{static_cast<CrushPiece>(i), static_cast<CrushPiece>(j)}});
        if (const double missed = violation(impulse); missed < least) {
          least = missed;
          best = impulse;
        }
      }
    }
    return best;
  }

 private:
  const std::array<CrushResponse, 2>& ends_;
  double creep_[2];
  const EndsMobility& mobility_;
  std::array<double, 2> free_;
};

}  // namespace

std::array<double, 2> crush_impulses(const std::array<CrushResponse, 2>& ends, const EndsMobility& mobility,
                                     const std::array<double, 2>& closing_speed, CrushPieces& pieces) {
  if (closing_speed[0] <= ends[0].gap_speed && closing_speed[1] <= ends[1].gap_speed) {
    pieces = {};
    return {0, 0};
  }
  const EndPair pair(ends, mobility, closing_speed);
  if (pieces == CrushPieces{}) pieces = pair.pieces_near({0, 0});
  for (std::size_t end = 0; end < 2; ++end) {
    const bool never_breaks = std::isinf(ends[end].cap);
    if (pieces.of[end] == CrushPiece::kBroken && never_breaks) pieces.of[end] = CrushPiece::kCrushing;
  }
  for (int i = 0; i < kMostTries; ++i) {
    const auto impulse = pair.solve_on(pieces);
    const CrushPieces next = pair.pieces_near(impulse);
    if (next == pieces)
      return {std::clamp(impulse[0], 0.0, ends[0].cap), std::clamp(impulse[1], 0.0, ends[1].cap)};
    pieces = next;
  }
  const auto impulse = pair.best_of_all();
  return {std::clamp(impulse[0], 0.0, ends[0].cap), std::clamp(impulse[1], 0.0, ends[1].cap)};
}

}  // namespace polynya::dynamics
