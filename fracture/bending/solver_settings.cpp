#include "fracture/bending/solver_settings.hpp"

#include <algorithm>
#include <cmath>

#include "fracture/bending/internal/plate.hpp"

namespace polynya::fracture {

SolverSettings with_inner_radius(const SolverSettings& settings, double inner_radius) {
  const auto reach = [&](double inner) { return radial_coordinate(settings.outer_radius) - radial_coordinate(inner); };
  const double elements = settings.radial_elements * reach(inner_radius) / reach(settings.inner_radius);
  constexpr double kRounding = 1e-6;  // the same inner radius keeps the same elements
  SolverSettings changed = with_elements(settings, std::max(1, static_cast<int>(std::ceil(elements - kRounding))));
  changed.inner_radius = inner_radius;
  return changed;
}

SolverSettings with_elements(const SolverSettings& settings, int radial_elements) {
  SolverSettings changed = settings;
  changed.radial_elements = radial_elements;
  const double rings_per_element = static_cast<double>(settings.panel_rings) / settings.radial_elements;
  changed.panel_rings = std::max(1, static_cast<int>(std::lround(rings_per_element * radial_elements)));
  return changed;
}

}  // namespace polynya::fracture
