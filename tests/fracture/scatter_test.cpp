// Laws by which ice scatters, against their closed forms.
#include "fracture/scatter.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace polynya::fracture {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const std::vector<ScatterLaw> kLaws{
    {ScatterKind::kUniform, 0, 0, 0.3, 0.7},       {ScatterKind::kNormal, 0.5, 0.2, 0.2, 0.8},
    {ScatterKind::kNormal, 0.5, 0.2, 0.45, 0.8},   {ScatterKind::kLogNormal, 0.5, 0.3, 0, kInfinity},
    {ScatterKind::kLogNormal, 8e5, 0.3, 6e5, 1e6},
};

/// The mean of f over the law, by its quantiles.
template <class Function>
double expected(const ScatterLaw& law, Function f) {
  constexpr int kCount = 200'000;
  double sum = 0;
  for (int i = 0; i < kCount; ++i) sum += f(quantile(law, (i + 0.5) / kCount)) / kCount;
  return sum;
}

TEST(Scatter, ShareAndQuantileAreEachOthersInverse) {
  for (const ScatterLaw& law : kLaws) {
    double last = 0;
    for (const double share : {1e-9, 0.01, 0.2, 0.5, 0.77, 0.999}) {
      const double x = quantile(law, share);
      EXPECT_NEAR(cumulative(law, x), share, 1e-12);
      EXPECT_GE(x, law.least);
      EXPECT_LE(x, law.most);
      EXPECT_GT(x, last);
      last = x;
    }
    EXPECT_EQ(cumulative(law, law.least), 0);
    EXPECT_EQ(cumulative(law, law.most), 1);
  }
}

TEST(Scatter, MeanAndSpreadAreThoseOfTheClosedForms) {
  const auto identity = [](double x) { return x; };
  const auto square = [](double x) { return x * x; };
  const ScatterLaw log_normal{ScatterKind::kLogNormal, 0.5, 0.3, 0, kInfinity};
  EXPECT_NEAR(expected(log_normal, identity), 0.5, 1e-5);
  EXPECT_NEAR(expected(log_normal, square), 0.25 * (1 + 0.09), 1e-4);
  EXPECT_NEAR(quantile(log_normal, 0.5), 0.5 / std::sqrt(1.09), 1e-12) << "its median";
  // A normal law cut off at both sides: μ + σ (φ(a) − φ(b)) / (Φ(b) − Φ(a)).
  const ScatterLaw normal{ScatterKind::kNormal, 0.5, 0.2, 0.45, 0.8};
  const auto density = [](double z) { return std::exp(-z * z / 2) / std::sqrt(2 * std::acos(-1.0)); };
  const auto share = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2)); };
  const double a = (0.45 - 0.5) / 0.1, b = (0.8 - 0.5) / 0.1;
  EXPECT_NEAR(share_within_bounds(normal), share(b) - share(a), 1e-12);
  EXPECT_NEAR(expected(normal, identity), 0.5 + 0.1 * (density(a) - density(b)) / (share(b) - share(a)), 1e-6);
  EXPECT_NEAR(expected({ScatterKind::kUniform, 0, 0, 0.3, 0.7}, square), (0.343 - 0.027) / 3 / 0.4, 1e-9);
}

TEST(Scatter, WithoutSpreadTheMeanIsDrawnToTheBit) {
  for (const ScatterKind kind : {ScatterKind::kConstant, ScatterKind::kNormal, ScatterKind::kLogNormal}) {
    const ScatterLaw law{kind, 0.7123, 0, 0, kInfinity};
    for (const double share : {1e-12, 0.3, 0.999}) EXPECT_EQ(quantile(law, share), 0.7123);
    EXPECT_EQ(share_within_bounds(law), 1);
  }
  EXPECT_EQ(share_within_bounds({ScatterKind::kConstant, 2, 0, 3, 4}), 0) << "nothing can be drawn";
}

/// The distance of n draws from their own law is below 1.63/√n in 99 of 100 cases. Their distance from another law is
/// the distance between the laws.
TEST(Scatter, TheDistanceIsSmallForItsOwnLawAlone) {
  std::mt19937_64 dice(4);
  constexpr int kCount = 5000;
  for (const ScatterLaw& law : kLaws) {
    std::vector<double> drawn;
    for (int i = 0; i < kCount; ++i)
      drawn.push_back(quantile(law, (static_cast<double>(dice() >> 12) + 0.5) * 0x1p-52));
    const ScatterMeasures measures = measure(law, drawn);
    EXPECT_EQ(measures.count, kCount);
    EXPECT_LT(measures.distance, 1.63 / std::sqrt(kCount));
    EXPECT_GT(measures.distance, 1e-4) << "draws, not a list of quantiles";
    const ScatterLaw other{ScatterKind::kUniform, 0, 0, measures.least, measures.most * 1.5};
    EXPECT_GT(measure(other, drawn).distance, 0.15);
  }
}

TEST(Scatter, ASpreadWhoseSquareIsNoNumberIsNone) {
  for (const ScatterKind kind : {ScatterKind::kNormal, ScatterKind::kLogNormal}) {
    const ScatterLaw law{kind, 1, kind == ScatterKind::kNormal ? 0 : 5.6e-257};
    EXPECT_EQ(quantile(law, 0.3), 1);
    EXPECT_EQ(share_within_bounds(law), 1);
  }
}

}  // namespace
}  // namespace polynya::fracture
