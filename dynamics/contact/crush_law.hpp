#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace polynya::dynamics {

/// The law of a contact in which ice crushes (docs/theory.md, "Contact"): what crushing takes while the two
/// close, nothing while they part or rest.
///
/// Over a time τ in which the bodies close by u⁺ (their closing speed once all impulses have acted), a
/// contact first closes the gap g to the deepest overlap that was loaded before. What is left, x = u⁺ − g/τ,
/// crushes new ice: the force there is F, growing by k x τ, so that the impulse is
///
///   λ(x) = 0                       x ≤ 0
///          (τF/u_c + ½ k τ²) x     0 < x ≤ u_c
///          τF + ½ k τ² x           u_c < x
///
/// but never more than the impulse at which the ice breaks. The creep branch up to u_c makes λ continuous; it
/// never falls. So with K positive semidefinite the impulses of all contacts of a step, λ = λ(û − K λ), are
/// unique (docs/theory.md): the solution of a strictly monotone problem, whatever the start.
/// Own law; crushing force by Eq. (2) of [Sawamura2017].
struct CrushResponse {
  double impulse_of_force = 0;  ///< τF of this end of the contact line, ≥ 0 [N s]
  double slope = 0;             ///< ½ k τ², ≥ 0 [N s per m/s]
  double gap_speed = 0;         ///< g/τ, ≥ 0 [m/s]
  double cap = 0;               ///< most impulse, ≥ 0 [N s]
};

/// u_c: below it ice creeps instead of crushing with its full strength. Regularises the law; results are
/// alike from 1 to 20 mm/s.
inline constexpr double kCreepSpeed = 5e-3;  // [m/s]

/// A straight piece of the law: λ = at_rest + slope · (u − g/τ).
struct CrushBranch {
  double at_rest = 0;  ///< [N s]
  double slope = 0;    ///< [N s per m/s]
};
enum class CrushPiece : std::uint8_t { kApart, kCreeping, kCrushing, kBroken };

inline double creep_slope(const CrushResponse& r) {
  return r.impulse_of_force / kCreepSpeed + r.slope;
}

/// `creep` is creep_slope(r), for those that ask often.
inline CrushPiece piece_at(const CrushResponse& r, double creep, double closing_speed) {
  const double x = closing_speed - r.gap_speed;
  if (x <= 0) return CrushPiece::kApart;
  const double crept = creep * x;
  const double crushed = r.impulse_of_force + r.slope * x;
  if (std::min(crept, crushed) >= r.cap) return CrushPiece::kBroken;
  return crept < crushed ? CrushPiece::kCreeping : CrushPiece::kCrushing;
}

inline CrushPiece piece_at(const CrushResponse& r, double closing_speed) {
  return piece_at(r, creep_slope(r), closing_speed);
}

/// The piece whose point (closing speed, impulse) is nearest one that need not obey the law, along
/// (1, −1/inverse_mass), the line on which impulses change the speed of a mass. Far steadier than the piece
/// at the speed alone, which jumps across the steep one that creeps. `inverse_mass`: > 0 [1/kg].
inline CrushPiece piece_near(const CrushResponse& r, double closing_speed, double impulse,
                             double inverse_mass) {
  const double place = closing_speed - r.gap_speed + inverse_mass * impulse;
  if (place <= 0) return CrushPiece::kApart;
  const double creep = creep_slope(r);
  const double crept = std::min(creep * kCreepSpeed, r.cap);  // the most that creeping gives
  const double creeping_to = creep > 0 ? crept / creep : 0;
  if (place <= creeping_to + inverse_mass * crept) return CrushPiece::kCreeping;
  if (crept == r.cap) return CrushPiece::kBroken;
  if (r.slope == 0) return CrushPiece::kCrushing;
  const double crushing_to = (r.cap - r.impulse_of_force) / r.slope;
  return place <= crushing_to + inverse_mass * r.cap ? CrushPiece::kCrushing : CrushPiece::kBroken;
}

inline CrushBranch branch_of(const CrushResponse& r, double creep, CrushPiece piece) {
  switch (piece) {
    case CrushPiece::kApart:
      return {0, 0};
    case CrushPiece::kCreeping:
      return {0, creep};
    case CrushPiece::kCrushing:
      return {r.impulse_of_force, r.slope};
    case CrushPiece::kBroken:
      return {r.cap, 0};
  }
  return {};
}

inline CrushBranch branch_of(const CrushResponse& r, CrushPiece piece) {
  return branch_of(r, creep_slope(r), piece);
}

/// λ of one end [N s].
inline double crush_impulse(const CrushResponse& r, double closing_speed) {
  const double creep = creep_slope(r);
  const CrushBranch branch = branch_of(r, creep, piece_at(r, creep, closing_speed));
  return branch.at_rest + branch.slope * (closing_speed - r.gap_speed);
}

/// The pieces that the two ends of a contact line are on.
struct CrushPieces {
  CrushPiece of[2] = {CrushPiece::kApart, CrushPiece::kApart};
  friend bool operator==(const CrushPieces&, const CrushPieces&) = default;
};

/// How the impulses at the two ends of a contact line slow their closing: u = û − K λ, K symmetric, positive
/// semidefinite [1/kg].
struct EndsMobility {
  double at[2];
  double between;
};

/// The impulses of both ends that obey the law together: λ_i = λ_i(û_i − (K λ)_i), û the closing speeds
/// without them [m/s]. On each pair of pieces this is a 2 × 2 system, (I + diag(β) K) λ = α + β (û − g/τ);
/// the pieces follow from its solution, as in Newton's method, and where that goes round in circles, all
/// pairs are tried. Starts from `pieces`, or from those of û where both are apart, and leaves there those of
/// the solution: the next one is likely on the same.
std::array<double, 2> crush_impulses(const std::array<CrushResponse, 2>& ends, const EndsMobility& mobility,
                                     const std::array<double, 2>& closing_speed, CrushPieces& pieces);

}  // namespace polynya::dynamics
