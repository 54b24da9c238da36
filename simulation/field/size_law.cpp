#include "simulation/field/size_law.hpp"

#include <algorithm>
#include <cmath>

#include "elementary/elementary.hpp"
#include "simulation/field/convex.hpp"

namespace polynya::simulation {
namespace {

/// Largest deviation of the logarithm of a size, in standard deviations [-]. The next constant belongs to it. Larger: a
/// few floes are so large that a field has no space for them.
constexpr double kFarthestDeviation = 3;
/// Probability P(Z > 3) that a normal variable is beyond that deviation [-].
constexpr double kBeyondFarthest = 1.349898031630095e-03;
constexpr double kLogUniform = 1e-9;  ///< exponents nearer to 0 than this are treated as 0 [-]

double below(const EqualSizes& law, double size) {
  return size < law.size ? 0 : 1;
}
double at(const EqualSizes& law, double) {
  return law.size;
}

/// Returns the standard deviation of the logarithm of the size [-].
double sigma_of(const LognormalSizes& law) {
  return std::sqrt(portable_logarithm(1 + law.spread * law.spread));
}
double below(const LognormalSizes& law, double size) {
  if (law.spread == 0) return size < law.mean ? 0 : 1;
  if (size <= 0) return 0;
  const double sigma = sigma_of(law);
  const double z = (elementary::log(size / law.mean) + 0.5 * sigma * sigma) / sigma;
  const double p = 0.5 * elementary::erfc(-z / std::numbers::sqrt2);
  return std::clamp((p - kBeyondFarthest) / (1 - 2 * kBeyondFarthest), 0.0, 1.0);
}
double at(const LognormalSizes& law, double u) {
  const double sigma = sigma_of(law);
  const double p = kBeyondFarthest + u * (1 - 2 * kBeyondFarthest);
  const double z = std::clamp(portable_normal_quantile(p), -kFarthestDeviation, kFarthestDeviation);
  return law.mean * portable_exponential(sigma * z - 0.5 * sigma * sigma);
}

double below(const PowerLawSizes& law, double size) {
  if (size <= law.least) return 0;
  if (size >= law.largest) return 1;
  if (std::abs(law.exponent) < kLogUniform)
    return elementary::log(size / law.least) / elementary::log(law.largest / law.least);
  const double share = elementary::pow(size / law.least, -law.exponent);
  return (1 - share) / (1 - elementary::pow(law.largest / law.least, -law.exponent));
}
double at(const PowerLawSizes& law, double u) {
  const double ratio = law.largest / law.least;
  if (std::abs(law.exponent) < kLogUniform) return law.least * portable_power(ratio, u);
  const double share = 1 - u * (1 - portable_power(ratio, -law.exponent));
  return law.least * portable_power(share, -1 / law.exponent);
}

double area_of(const EqualSizes& law) {
  return law.size * law.size;
}
double area_of(const LognormalSizes& law) {
  // Number of intervals of the sum; another number changes the number of floes, and so every field of a seed.
  constexpr int kParts = 4096;
  double sum = 0;
  for (int i = 0; i < kParts; ++i) {
    const double size = at(law, (i + 0.5) / kParts);
    sum += size * size / kParts;
  }
  return sum;
}
double area_of(const PowerLawSizes& law) {
  // ∫ d² dP with dP ∝ d^(−a−1): [d^(2−a)] / (2 − a) over [d^(−a)] / (−a), in units of the least size.
  const double ratio = law.largest / law.least;
  const auto integral = [&](double power) {
    return std::abs(power) < kLogUniform ? portable_logarithm(ratio) : (portable_power(ratio, power) - 1) / power;
  };
  return law.least * law.least * integral(2 - law.exponent) / integral(-law.exponent);
}

/// Returns the mean of ln(d / least) of a power law, where `range` is ln(largest / least) [-].
double mean_logarithm(double exponent, double range) {
  const double x = exponent * range;
  if (std::abs(x) < 1e-5) return range * (0.5 - x / 12);
  return 1 / exponent - range / elementary::expm1(x);
}

/// Returns the log-normal law that fits sizes [m] with maximum likelihood.
LognormalSizes likeliest_lognormal(const std::vector<double>& sizes) {
  const auto count = static_cast<double>(sizes.size());
  double mean = 0;
  for (const double size : sizes) mean += elementary::log(size) / count;
  double variance = 0;
  for (const double size : sizes) variance += (elementary::log(size) - mean) * (elementary::log(size) - mean) / count;
  return {elementary::exp(mean + 0.5 * variance), std::sqrt(elementary::expm1(variance))};
}

}  // namespace

double size_at(const SizeLaw& law, double u) {
  return std::visit([u](const auto& kind) { return at(kind, u); }, law);
}

double share_below(const SizeLaw& law, double size) {
  return std::visit([size](const auto& kind) { return below(kind, size); }, law);
}

double mean_area(const SizeLaw& law) {
  return std::visit([](const auto& kind) { return area_of(kind); }, law);
}

std::vector<double> draw_areas(const SizeLaw& law, std::size_t count, Random& random) {
  std::vector<double> areas(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double size = size_at(law, (static_cast<double>(i) + random.uniform()) / static_cast<double>(count));
    areas[i] = size * size;
  }
  return areas;
}

double kolmogorov_smirnov(const SizeLaw& law, const std::vector<double>& sizes) {
  const auto count = static_cast<double>(sizes.size());
  double most = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double share = share_below(law, sizes[i]);
    most = std::max({most, share - static_cast<double>(i) / count, static_cast<double>(i + 1) / count - share});
  }
  return most;
}

double likeliest_exponent(const PowerLawSizes& law, const std::vector<double>& sizes) {
  const double range = elementary::log(law.largest / law.least);
  double mean = 0;
  for (const double size : sizes)
    mean += std::clamp(elementary::log(size / law.least), 0.0, range) / static_cast<double>(sizes.size());
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
