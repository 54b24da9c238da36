#include "fracture/bending/peak.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include <Eigen/Dense>

namespace polynya::fracture {
namespace {

/// Returns the maximum of the weighted polynomial of fourth degree around `centre`, in t = ln(place / centre) /
/// ln(reach); nullopt if it lies outside of |t| ≤ 1, or if there are fewer than seven samples, two more than
/// coefficients. Newton's method finds it in a few iterations; 30 bound a search that does not converge.
std::optional<double> quartic_peak(std::span<const double> places, std::span<const double> values, double centre) {
  using Vector5 = Eigen::Matrix<double, 5, 1>;
  Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
  Vector5 right = Vector5::Zero();
  int samples = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double t = std::log(places[k] / centre) / std::log(kFlatPeakReach);
    if (std::abs(t) >= 1) continue;
    const double weight = (1 - t * t) * (1 - t * t);
    const Vector5 powers(1, t, t * t, t * t * t, t * t * t * t);
    normal += weight * powers * powers.transpose();
    right += weight * values[k] * powers;
    ++samples;
  }
  if (samples < 7) return std::nullopt;
  const Vector5 c = normal.ldlt().solve(right);
  const auto slope = [&](double t) { return c[1] + t * (2 * c[2] + t * (3 * c[3] + t * 4 * c[4])); };
  const auto curvature = [&](double t) { return 2 * c[2] + t * (6 * c[3] + t * 12 * c[4]); };
  double t = 0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    if (!(curvature(t) < 0) || std::abs(t) > 1) return std::nullopt;
    t -= slope(t) / curvature(t);
  }
  return std::abs(slope(t)) < 1e-9 * std::abs(c[2]) && std::abs(t) <= 1 ? std::optional(t) : std::nullopt;
}

}  // namespace

Peak find_peak(std::span<const double> places, std::span<const double> values) {
  assert(!values.empty() && places.size() == values.size());
  const auto k = static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
  if (k == 0 || k + 1 == values.size()) return {places[k], values[k]};
  // Newton's divided differences of the parabola through the three samples.
  const double first = (values[k] - values[k - 1]) / (places[k] - places[k - 1]);
  const double next = (values[k + 1] - values[k]) / (places[k + 1] - places[k]);
  const double second = (next - first) / (places[k + 1] - places[k - 1]);
  if (!(second < 0)) return {places[k], values[k]};
  const double place =
      std::clamp(0.5 * (places[k - 1] + places[k]) - first / (2 * second), places[k - 1], places[k + 1]);
  return {place, values[k] + (place - places[k]) * (first + second * (place - places[k - 1]))};
}

double find_flat_peak(std::span<const double> places, std::span<const double> values) {
  const double rough = find_peak(places, values).place;
  double centre = rough;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const std::optional<double> t = quartic_peak(places, values, centre);
    if (!t) return rough;
    centre *= std::pow(kFlatPeakReach, *t);
    if (std::abs(*t) < 1e-7) break;
  }
  return centre;
}

}  // namespace polynya::fracture
