#include "geometry/internal/ring_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace polynya::geometry {

RingArea ring_area(const Ring& ring) {
  if (ring.size() < 3) return {};
  const Point origin = ring.front();
  // Four sums side by side, each with the exact error of its additions (Knuth's two-sum, which needs no branch).
  constexpr std::size_t kLanes = 4;
  std::array<double, kLanes> sum{};
  std::array<double, kLanes> lost{};
  std::array<double, kLanes> magnitude{};
  std::array<double, kLanes> length{};
  const auto add = [&](std::size_t lane, Vector u, Vector v) {
    const double left = u.x * v.y;
    const double right = u.y * v.x;
    const double term = left - right;
    const double next = sum[lane] + term;
    const double virtual_term = next - sum[lane];
    lost[lane] += (sum[lane] - (next - virtual_term)) + (term - virtual_term);
    sum[lane] = next;
    magnitude[lane] += std::abs(left) + std::abs(right);
    length[lane] += std::abs(v.x - u.x) + std::abs(v.y - u.y);
  };
  const std::size_t n = ring.size();
  std::size_t i = 0;
  for (; i + kLanes < n; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) add(lane, ring[i + lane] - origin, ring[i + lane + 1] - origin);
  }
  for (; i + 1 < n; ++i) add(0, ring[i] - origin, ring[i + 1] - origin);
  // The closing edge ends in the origin itself: its term is zero.
  const double twice = ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((lost[0] + lost[1]) + (lost[2] + lost[3]));
  const double magnitudes = (magnitude[0] + magnitude[1]) + (magnitude[2] + magnitude[3]);
  const double perimeter = length[0] + length[1] + length[2] + length[3] + std::abs(ring.back().x - origin.x) +
                           std::abs(ring.back().y - origin.y);
  const Box box = bounding_box(ring);
  const double largest = std::max({std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
  const double step = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  // Each term errs by at most 4ε of its magnitude, the compensated sums by next to nothing.
  constexpr double kUnderflow = 1e-280;
  return {twice / 2, 8 * std::numeric_limits<double>::epsilon() * magnitudes + kUnderflow, perimeter * step};
}

}  // namespace polynya::geometry
