#pragma once

#include <initializer_list>
#include <vector>

#include <gtest/gtest.h>

namespace polynya::fracture {

/// How the width of a floating beam grows from its free tip: b(x) = b (a beam) or b(x) = b0 x (a narrow
/// wedge).
enum class BeamShape { kUniform, kWedge };

/// On the tip, for unit widths: a unit force as uniform pressure over 0 < x < patch (of wedges), a force and a moment.
struct TipLoad {
  double patch = 0, force = 0, moment = 0;
};

inline constexpr double kBeamStep = 1e-3;

/// Response of a semi-infinite floating beam or narrow wedge to a tip load. Lengths are in l = (E h³ / 12 ρ_w g)^¼.
struct BeamResponse {
  double tip_deflection = 0;  ///< w(0), in P / (ρ_w g b l) for a beam, P / (ρ_w g b0 l²) for a wedge [-]
  double peak_curvature = 0;  ///< max of M / (EI/b or EI/b0 x): M_max / (P l) for a beam, σ b0 h² / 6P for a wedge
  double peak_distance = 0;   ///< distance of that maximum from the tip, in l [-]
  std::vector<double> moments = {};  ///< every kBeamStep from the tip on, in P l
};

/// Solves (b w'')'' + b w = q, the static equation of a beam of width b(x) on water [Hetenyi1946], by finite
/// differences of w and M = b w'' on [0, length], where both are taken as 0, with errors of second order in
/// kBeamStep / patch.
BeamResponse solve_floating_beam(BeamShape shape, const TipLoad& load, double length = 12);

/// An error falls at least by a factor from each refinement to the next, the first from 1. Gives the last.
template <class Refinement, class Error>
double expect_falls(std::initializer_list<Refinement> refinements, double factor, Error error_of) {
  double previous = 1;
  for (const Refinement refinement : refinements) {
    const double error = error_of(refinement);
    EXPECT_LT(error, factor * previous) << refinement;
    previous = error;
  }
  return previous;
}

}  // namespace polynya::fracture
