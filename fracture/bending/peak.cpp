#include "fracture/bending/peak.hpp"

#include <algorithm>
#include <cassert>

namespace polynya::fracture {

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

}  // namespace polynya::fracture
