#pragma once

#include "fracture/materials.hpp"

namespace polynya::fracture {

enum class SplittingModel { kMichel, kLefm };

/// Force that splits a floe along a path of the given length [m], F_s = n L h σ_t [N].
/// Eq. (4) of [Sawamura2017] after [Michel1978]; n is the shape factor of the structure, 0.25 for a wedge.
inline double michel_splitting_force(const Ice& ice, double path_length, double shape_factor) {
  return shape_factor * path_length * ice.thickness * ice.tensile_strength;
}

/// Force that drives an edge crack across a floe, F = 0.209 h K_IC √L [N] (*recall*: linear elastic fracture
/// mechanics of an edge crack under mouth forces after [Bhat1988], K_IC 115–250 kPa √m; the coefficient could
/// not be looked up here).
inline double lefm_splitting_force(const Ice& ice, double path_length) {
  return 0.209 * ice.thickness * ice.fracture_toughness * std::sqrt(path_length);
}

inline double splitting_force(SplittingModel model, const Ice& ice, double path_length, double shape_factor) {
  return model == SplittingModel::kMichel ? michel_splitting_force(ice, path_length, shape_factor)
                                          : lefm_splitting_force(ice, path_length);
}

}  // namespace polynya::fracture
