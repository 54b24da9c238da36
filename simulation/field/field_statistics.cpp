#include "simulation/field/field_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/field/convex.hpp"

namespace polynya::simulation {
namespace {

/// Mean of ln(d / least) of a power law over T = ln(largest / least).
double mean_logarithm(double exponent, double range) {
  const double x = exponent * range;
  if (std::abs(x) < 1e-5) return range * (0.5 - x / 12);
  return 1 / exponent - range / std::expm1(x);
}

LognormalSizes likeliest_lognormal(const std::vector<double>& sizes) {
  const auto count = static_cast<double>(sizes.size());
  double mean = 0;
  for (const double size : sizes) mean += std::log(size) / count;
  double variance = 0;
  for (const double size : sizes) variance += (std::log(size) - mean) * (std::log(size) - mean) / count;
  return {std::exp(mean + 0.5 * variance), std::sqrt(std::expm1(variance))};
}

}  // namespace

double kolmogorov_smirnov(const SizeLaw& law, const std::vector<double>& sizes) {
  const auto count = static_cast<double>(sizes.size());
  double most = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double share = share_below(law, sizes[i]);
    most =
        std::max({most, share - static_cast<double>(i) / count, static_cast<double>(i + 1) / count - share});
  }
  return most;
}

double likeliest_exponent(const PowerLawSizes& law, const std::vector<double>& sizes) {
  const double range = std::log(law.largest / law.least);
  double mean = 0;
  for (const double size : sizes)
    mean += std::clamp(std::log(size / law.least), 0.0, range) / static_cast<double>(sizes.size());
  double low = -50;
  double high = 50;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (mean_logarithm(middle, range) > mean ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

FieldStatistics statistics_of(const SizeLaw& law, const std::vector<geometry::Polygon>& floes) {
  FieldStatistics statistics;
  statistics.law = law;
  if (floes.empty()) return statistics;
  std::vector<double> sizes;
  sizes.reserve(floes.size());
  const auto count = static_cast<double>(floes.size());
  for (const geometry::Polygon& floe : floes) {
    sizes.push_back(std::sqrt(measure_convex(floe.outer).area));
    statistics.mean_aspect += aspect_of(floe.outer) / count;
    statistics.mean_corners += static_cast<double>(floe.outer.size()) / count;
  }
  std::ranges::sort(sizes);
  statistics.least_size = sizes.front();
  statistics.largest_size = sizes.back();
  const auto* lognormal = std::get_if<LognormalSizes>(&law);
  if (const auto* equal = std::get_if<EqualSizes>(&law); equal || (lognormal && lognormal->spread == 0)) {
    const double size = equal ? equal->size : lognormal->mean;
    statistics.distance_to_law = std::max(size - sizes.front(), sizes.back() - size) / size;
    return statistics;
  }
  statistics.distance_to_law = kolmogorov_smirnov(law, sizes);
  if (lognormal) {
    statistics.fitted = likeliest_lognormal(sizes);
  } else if (const auto* power = std::get_if<PowerLawSizes>(&law)) {
    statistics.fitted = PowerLawSizes{likeliest_exponent(*power, sizes), power->least, power->largest};
  }
  return statistics;
}

}  // namespace polynya::simulation
