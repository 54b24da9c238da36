#include "fracture/bending/edge_sections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fracture/bending/sinking_edge.hpp"
#include "geometry/shape/angle.hpp"

namespace polynya::fracture {
namespace {

constexpr double kTableStep = 0.2;  // of ρ
/// tests/fracture/bending/edge_sections_test.cpp computes these from the beam.
constexpr std::array<double, 21> kOfForce = {0,       0.19732, 0.38034, 0.53928, 0.66840, 0.76522, 0.82976,
                                             0.86381, 0.87042, 0.85342, 0.81699, 0.76542, 0.70284, 0.63311,
                                             0.55964, 0.48538, 0.41281, 0.34389, 0.28012, 0.22254, 0.17185};
constexpr std::array<double, 21> kOfMoment = {1,       0.99803, 0.98673, 0.96184, 0.92239, 0.86941,  0.80508,
                                              0.73216, 0.65361, 0.57231, 0.49088, 0.41160, 0.33631,  0.26647,
                                              0.20311, 0.14688, 0.09812, 0.05688, 0.02300, -0.00386, -0.02419};

/// 1 − w(ρ)/w(0) under a force on its tip.
constexpr std::array<double, 21> kDrop = {0,       0.16033, 0.30268, 0.42768, 0.53628, 0.62963, 0.70901,
                                          0.77576, 0.83124, 0.87678, 0.91365, 0.94305, 0.96609, 0.98377,
                                          0.99699, 1.00656, 1.01316, 1.01740, 1.01978, 1.02073, 1.02061};

double interpolated(const std::array<double, 21>& table, double at) {
  const double x = std::clamp(at / kTableStep, 0.0, static_cast<double>(table.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(x), table.size() - 2);
  return std::lerp(table[i], table[i + 1], x - static_cast<double>(i));
}

/// The root of growth V² + pull V = capacity, V > 0: a section that the sinking thrust opens in proportion to V.
double bearing(double pull, double growth, double capacity) {
  if (growth <= 0) return pull > 0 ? capacity / pull : std::numeric_limits<double>::infinity();
  return 2 * capacity / (pull + std::sqrt(pull * pull + 4 * growth * capacity));
}

/// The vertex of the parabola through three points at -1, 0, 1 of which the middle one is least.
struct Vertex {
  double place = 0, value = 0;
};
Vertex vertex_of(double before, double least, double after) {
  const double curvature = before - 2 * least + after;
  if (!(curvature > 0) || !std::isfinite(curvature)) return {0, least};
  const double place = std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5);
  return {place, least + 0.5 * place * (after - before) + 0.5 * place * place * curvature};
}

/// Whether a radial crack opens below before the edge breaks: 0 no, 1 yes; between, so that an edge that widens a
/// little does not bear much less.
double crack_share(const EdgeOpenings& openings) {
  constexpr double kWhole = 90 * geometry::kRadiansPerDegree, kCracked = 105 * geometry::kRadiansPerDegree;
  constexpr double kReach = 0.5;  // of l: where the bottom fibre is pulled across
  double widest = 0;
  for (std::size_t i = 0; i < kSectionCount && kSectionRadii[i] <= kReach; ++i) widest = std::max(widest, openings[i]);
  return std::clamp((widest - kWhole) / (kCracked - kWhole), 0.0, 1.0);
}

}  // namespace

double moment_of_force(double distance) {
  return interpolated(kOfForce, distance);
}

double moment_of_moment(double distance) {
  return interpolated(kOfMoment, distance);
}

double hold_of_whole(double opening) {
  constexpr double kBeam = 45 * geometry::kRadiansPerDegree;  ///< narrower, a wedge bends as a beam
  constexpr double kGrowth = 0.18;                            ///< per radian
  return 1 + kGrowth * std::max(0.0, opening - kBeam);
}

double hold_of_cracked(double opening) {
  constexpr double kNone = 117 * geometry::kRadiansPerDegree;  ///< where it bears what its sections do
  constexpr double kLeast = 90 * geometry::kRadiansPerDegree, kMost = 150 * geometry::kRadiansPerDegree;
  constexpr double kGrowth = 0.4;  ///< per radian
  return 1 + kGrowth * (std::clamp(opening, kLeast, kMost) - kNone);
}

SectionBreak weakest_section(const EdgeOpenings& openings, const EdgePush& push) {
  return weakest_section_of_sinking(openings, push, 0);
}

SectionBreak weakest_section_of_sinking(const EdgeOpenings& openings, const EdgePush& push, double sinking,
                                        bool has_radial_cracks) {
  const double cracked = has_radial_cracks ? crack_share(openings) : 0;
  std::array<double, kSectionCount> forces{};
  for (std::size_t i = 0; i < kSectionCount; ++i) {
    const double r = kSectionRadii[i] * push.length;
    const double place = r / push.effective_length;
    const double held = moment_of_moment(place);
    const double moment =
        push.effective_length * moment_of_force(place) - (push.distance + push.thrust * push.lever) * held;
    const double hold = std::lerp(hold_of_whole(openings[i]), hold_of_cracked(openings[i]), cracked);
    const double growth = 6 * push.thrust * sinking * interpolated(kDrop, place) * std::max(0.0, held);
    forces[i] = bearing(6 * moment - push.thrust, growth, hold * openings[i] * r);
  }
  const auto least = static_cast<std::size_t>(std::ranges::min_element(forces) - forces.begin());
  const bool is_inside = least > 0 && least + 1 < kSectionCount;
  const Vertex at =
      is_inside ? vertex_of(forces[least - 1], forces[least], forces[least + 1]) : Vertex{0, forces[least]};
  return {at.value, kSectionRadii[least] * std::pow(kSectionStep, at.place) * push.length};
}

}  // namespace polynya::fracture
