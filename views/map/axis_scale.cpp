#include "views/map/axis_scale.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::views {
namespace {

std::vector<double> log_ticks(double low, double high) {
  const double decades = std::log10(high / low);
  const std::vector<double> mantissas = decades > 3     ? std::vector{1.0}
                                        : decades > 0.9 ? std::vector{1.0, 2.0, 5.0}
                                                        : std::vector{1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0};
  std::vector<double> ticks;
  for (int power = static_cast<int>(std::floor(std::log10(low))); power <= std::log10(high); ++power) {
    for (const double mantissa : mantissas) {
      const double tick = mantissa * std::pow(10.0, power);
      if (tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9)) ticks.push_back(tick);
    }
  }
  return ticks;
}

/// The least of 1, 2, 5 × 10ⁿ that makes at most eight steps of the range.
double linear_step(double range) {
  const double decade = std::pow(10, std::floor(std::log10(range / 8)));
  for (const double mantissa : {1.0, 2.0, 5.0}) {
    if (range / (mantissa * decade) <= 8) return mantissa * decade;
  }
  return 10 * decade;
}

}  // namespace

bool AxisScale::takes(double value) const {
  return std::isfinite(value) && (!is_log || value > 0);
}

double AxisScale::share(double value) const {
  return is_log ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

AxisScale axis_scale(double low, double high, bool is_log, AxisFit fit) {
  const bool is_tight = fit == AxisFit::kTight;
  AxisScale scale;
  scale.is_log = is_log;
  if (is_log) {
    const double room = is_tight ? 1 : std::pow(high / low, 0.06) * 1.02;
    scale.low = low / room;
    scale.high = std::max(high * room, scale.low * 1.1);
    scale.ticks = log_ticks(scale.low, scale.high);
    return scale;
  }
  if (!is_tight && low > 0) low = 0;
  if (high <= low) high = low + std::max(1.0, std::abs(low));
  const double step = linear_step(high - low);
  scale.low = is_tight ? low : std::floor(low / step) * step;
  scale.high = is_tight ? high : std::ceil(high / step + 0.2) * step;
  for (auto i = std::llround(std::ceil(scale.low / step - 1e-9));
       static_cast<double>(i) * step <= scale.high * (1 + 1e-9); ++i)
    scale.ticks.push_back(static_cast<double>(i) * step);
  return scale;
}

}  // namespace polynya::views
