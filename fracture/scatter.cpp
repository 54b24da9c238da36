#include "fracture/scatter.hpp"

#include <algorithm>
#include <cmath>

#include "elementary/elementary.hpp"
#include "elementary/normal.hpp"

namespace polynya::fracture {
namespace {

/// The largest double below 1, used because the quantile of 1 is infinite.
constexpr double kAlmostOne = 1 - 0x1p-53;

/// Mean and deviation of a normal law; for log-normal laws those are of the logarithm.
struct Gauss {
  double mean = 0;
  double deviation = 0;
};

Gauss gauss_of(const ScatterLaw& law) {
  if (law.kind == ScatterKind::kNormal) return {law.mean, law.spread * law.mean};
  const double variance = elementary::log1p(law.spread * law.spread);
  return {elementary::log(law.mean) - 0.5 * variance, std::sqrt(variance)};
}

bool is_single_value(const ScatterLaw& law) {
  if (law.kind == ScatterKind::kUniform) return law.least == law.most;
  return law.kind == ScatterKind::kConstant || gauss_of(law).deviation == 0;  // also if its square underflows
}

double single_value(const ScatterLaw& law) {
  return law.kind == ScatterKind::kUniform ? law.least : law.mean;
}

/// Returns the cumulative fraction of a law without bounds.
double unbounded_share(const ScatterLaw& law, double x) {
  const bool is_log = law.kind == ScatterKind::kLogNormal;
  if (is_log && x <= 0) return 0;
  if (std::isinf(x)) return x > 0 ? 1 : 0;
  const Gauss gauss = gauss_of(law);
  return elementary::normal_share(((is_log ? elementary::log(x) : x) - gauss.mean) / gauss.deviation);
}

}  // namespace

double share_within_bounds(const ScatterLaw& law) {
  if (law.least > law.most) return 0;
  if (is_single_value(law)) return single_value(law) >= law.least && single_value(law) <= law.most ? 1 : 0;
  if (law.kind == ScatterKind::kUniform) return 1;
  return unbounded_share(law, law.most) - unbounded_share(law, law.least);
}

double cumulative(const ScatterLaw& law, double x) {
  if (is_single_value(law)) return x >= single_value(law) ? 1 : 0;
  if (x <= law.least) return 0;
  if (x >= law.most) return 1;
  if (law.kind == ScatterKind::kUniform) return (x - law.least) / (law.most - law.least);
  return (unbounded_share(law, x) - unbounded_share(law, law.least)) / share_within_bounds(law);
}

double quantile(const ScatterLaw& law, double share) {
  if (is_single_value(law)) return single_value(law);
  if (law.kind == ScatterKind::kUniform)
    return std::clamp(law.least + share * (law.most - law.least), law.least, law.most);
  const Gauss gauss = gauss_of(law);
  const double unbounded = unbounded_share(law, law.least) + share * share_within_bounds(law);
  if (!(unbounded > 0)) return law.least;
  const double x = gauss.mean + gauss.deviation * elementary::normal_quantile(std::min(unbounded, kAlmostOne));
  return std::clamp(law.kind == ScatterKind::kLogNormal ? elementary::exp(x) : x, law.least, law.most);
}

ScatterMeasures measure(const ScatterLaw& law, std::vector<double> drawn) {
  ScatterMeasures measures;
  measures.count = drawn.size();
  if (drawn.empty()) return measures;
  std::ranges::sort(drawn);
  const auto count = static_cast<double>(drawn.size());
  measures.least = drawn.front();
  measures.most = drawn.back();
  for (const double x : drawn) measures.mean += x / count;
  double variance = 0;
  for (const double x : drawn) variance += (x - measures.mean) * (x - measures.mean) / count;
  measures.spread = std::sqrt(variance) / measures.mean;
  if (is_single_value(law)) {
    const auto others = std::ranges::count_if(drawn, [&](double x) { return x != single_value(law); });
    measures.distance = static_cast<double>(others) / count;
    return measures;
  }
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double share = cumulative(law, drawn[i]);
    const auto below = static_cast<double>(i);
    measures.distance = std::max({measures.distance, share - below / count, (below + 1) / count - share});
  }
  return measures;
}

}  // namespace polynya::fracture
