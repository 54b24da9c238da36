#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "simulation/floe_field.hpp"

namespace polynya::simulation {

// What both kinds of field do with their cells: all floes grow or shrink alike until they cover what is asked
// for.

/// λ with Σ min(λ wanted, most) = total, by bisection [-]; `most` names the member [m²].
template <class Floe>
double common_factor(const std::vector<Floe>& floes, double Floe::*most, double total) {
  double low = 0;
  double high = 64;
  for (int i = 0; i < 60; ++i) {
    const double factor = 0.5 * (low + high);
    double sum = 0;
    for (const Floe& floe : floes) sum += std::min(factor * floe.wanted, floe.*most);
    (sum < total ? low : high) = factor;
  }
  return 0.5 * (low + high);
}

/// Enters the number of an outcome's floes and the mean and spread of their sizes, from their area and the
/// sum of √area [m].
inline void enter_sizes(double size_sum, FloeFieldOutcome& outcome) {
  outcome.count = static_cast<int>(outcome.floes.size());
  if (outcome.count == 0) return;
  const auto count = static_cast<double>(outcome.count);
  outcome.mean_size = size_sum / count;
  const double variance = outcome.floe_area / count - outcome.mean_size * outcome.mean_size;
  outcome.size_spread = std::sqrt(std::max(0.0, variance)) / outcome.mean_size;
}

}  // namespace polynya::simulation
