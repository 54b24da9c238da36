#pragma once

#include <initializer_list>

#include <gtest/gtest.h>

namespace polynya::fracture {

/// How the width of a floating beam grows from its free tip: b(x) = b (a beam) or b(x) = b0 x (a narrow
/// wedge).
enum class BeamShape { kUniform, kWedge };

/// What a tip load does to a semi-infinite floating beam or narrow wedge. Lengths in l = (E h³ / 12 ρ_w g)^¼.
struct BeamResponse {
  double tip_deflection = 0;  ///< w(0), in P / (ρ_w g b l) for a beam, P / (ρ_w g b0 l²) for a wedge [-]
  double peak_curvature = 0;  ///< max of M / (EI/b or EI/b0 x): M_max / (P l) for a beam, σ b0 h² / 6P for a wedge
  double peak_distance = 0;   ///< distance of that maximum from the tip, in l [-]
};

/// Solves (b w'')'' + b w = q on [0, 12 l] with a free tip by cubic Hermite elements; the static equation of
/// a beam of width b(x) on water [Hetenyi1946]. The load P is uniform pressure over the tip, 0 < x <
/// patch_length; a patch_length of 0 is a point load (beams only). patch_length a / l [-], elements ≥ 8. The
/// discretisation error falls as elements⁻⁴ while round-off grows as the shortest element⁻⁴: 100 elements are
/// best, and patches below about 0.01 l need a wider arithmetic.
BeamResponse solve_floating_beam(BeamShape shape, double patch_length, int elements);

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
