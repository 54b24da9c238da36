#include "simulation/field/size_law.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/field/portable_math.hpp"

namespace polynya::simulation {
namespace {

constexpr double kFarthestDeviation = 3;
constexpr double kBeyondFarthest = 1.349898031630095e-03;  ///< P(Z > 3)
constexpr double kLogUniform = 1e-9;                       ///< exponents nearer to 0 than this

double below(const EqualSizes& law, double size) {
  return size < law.size ? 0 : 1;
}
double at(const EqualSizes& law, double) {
  return law.size;
}

double sigma_of(const LognormalSizes& law) {
  return std::sqrt(portable_logarithm(1 + law.spread * law.spread));
}
double below(const LognormalSizes& law, double size) {
  if (law.spread == 0) return size < law.mean ? 0 : 1;
  if (size <= 0) return 0;
  const double sigma = sigma_of(law);
  const double z = (std::log(size / law.mean) + 0.5 * sigma * sigma) / sigma;
  const double p = 0.5 * std::erfc(-z / std::numbers::sqrt2);
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
    return std::log(size / law.least) / std::log(law.largest / law.least);
  const double share = std::pow(size / law.least, -law.exponent);
  return (1 - share) / (1 - std::pow(law.largest / law.least, -law.exponent));
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
    return std::abs(power) < kLogUniform ? portable_logarithm(ratio)
                                         : (portable_power(ratio, power) - 1) / power;
  };
  return law.least * law.least * integral(2 - law.exponent) / integral(-law.exponent);
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
    const double size =
        size_at(law, (static_cast<double>(i) + random.uniform()) / static_cast<double>(count));
    areas[i] = size * size;
  }
  return areas;
}

}  // namespace polynya::simulation
