#include "fracture/bending/edge_deflection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "elementary/elementary.hpp"
#include "fracture/characteristic_length.hpp"
#include "geometry/shape/angle.hpp"

namespace polynya::fracture {
namespace {

constexpr std::array<double, 8> kAngles = {20, 30, 40, 60, 90, 120, 150, 180};  // 2α [°]
/// Durations of the columns [t0]; the last column is for a wedge at rest.
constexpr std::array<double, 15> kDurations = {0.02, 0.04, 0.08, 0.15, 0.25, 0.4, 0.6, 0.9,
                                               1.3,  1.8,  2.4,  3.2,  4.2,  6,   12};
// Rows by angle; tests/fracture/bending/edge_deflection_test.cpp computes the values from the modes.
constexpr double kCompliance[kAngles.size()][kDurations.size()] = {
    {0.15667, 0.30679, 0.59054, 1.0521, 1.6578, 2.4725, 3.4051, 4.5028, 5.4769, 6.0947, 6.3157, 6.3339, 6.3911, 6.4079,
     6.4381},
    {0.098445, 0.19074, 0.36303, 0.64057, 1.0027, 1.4904, 2.0553, 2.7419, 3.3963, 3.8757, 4.1105, 4.193, 4.1936, 4.2142,
     4.2498},
    {0.069972, 0.13454, 0.25409, 0.4455, 0.69447, 1.0301, 1.4218, 1.9073, 2.3891, 2.7712, 2.9931, 3.0998, 3.0956,
     3.1131, 3.1456},
    {0.042327, 0.080547, 0.15061, 0.26199, 0.40636, 0.60128, 0.83087, 1.1218, 1.4239, 1.685, 1.8653, 1.9763, 1.9889,
     2.0035, 2.0253},
    {0.024689, 0.046544, 0.08629, 0.14914, 0.23039, 0.34026, 0.47058, 0.63849, 0.81863, 0.98407, 1.112, 1.2038, 1.2302,
     1.2452, 1.2575},
    {0.016209, 0.030373, 0.056013, 0.096433, 0.14862, 0.21924, 0.3033, 0.41257, 0.53179, 0.64474, 0.73709, 0.80838,
     0.83636, 0.85181, 0.85975},
    {0.011296, 0.021064, 0.038688, 0.066408, 0.10216, 0.15056, 0.20831, 0.28379, 0.36705, 0.4475, 0.51553, 0.57051,
     0.59625, 0.61101, 0.61694},
    {0.0081893, 0.0152, 0.027813, 0.047613, 0.073128, 0.10767, 0.14896, 0.20314, 0.26342, 0.32254, 0.37374, 0.41669,
     0.43931, 0.45296, 0.45811}};

/// The place of x among ascending points: the interval, and the fraction of it by logarithms, limited to the ends.
struct Place {
  std::size_t first = 0;
  double share = 0;
};
template <std::size_t N>
Place place_of(double x, const std::array<double, N>& points) {
  if (!(x > points.front())) return {0, 0};
  if (x >= points.back()) return {N - 2, 1};
  const auto next = std::ranges::upper_bound(points, x);
  const auto i = static_cast<std::size_t>(next - points.begin()) - 1;
  return {i, elementary::log(x / points[i]) / elementary::log(points[i + 1] / points[i])};
}

double geometric_mean(double a, double b, double share) {
  return a * elementary::pow(b / a, share);
}

}  // namespace

double tip_compliance(double opening_angle, double duration) {
  if (duration <= 0) return 0;
  const Place angle = place_of(opening_angle / geometry::kRadiansPerDegree, kAngles);
  const Place time = place_of(duration, kDurations);
  const auto at_angle = [&](std::size_t i) {
    return geometric_mean(kCompliance[i][time.first], kCompliance[i][time.first + 1], time.share);
  };
  const double compliance = geometric_mean(at_angle(angle.first), at_angle(angle.first + 1), angle.share);
  // The compliance before the first time of the table is proportional to the time, as it is at that time.
  return compliance * std::min(1.0, duration / kDurations.front());
}

double recession_per_area(const BendingLoad& load, double travel) {
  if (load.vertical_to_crushing <= 0) return 0;
  const double l = characteristic_length(load.ice, load.water);
  const double duration = load.mean_approach_speed > 0 ? travel / load.mean_approach_speed / std::sqrt(l / kGravity)
                                                       : std::numeric_limits<double>::infinity();
  const double opening_angle =
      load.opening_angle > 0 ? load.opening_angle : load.front_half_angle + load.back_half_angle;
  const double compliance = tip_compliance(opening_angle, duration) / (load.water.density * kGravity * l * l);
  return elementary::tan(load.hull_angle) * compliance * load.ice.compressive_strength * load.vertical_to_crushing;
}

}  // namespace polynya::fracture
