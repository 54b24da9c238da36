#include "fracture/bending/edge_sections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "elementary/elementary.hpp"

#include "fracture/bending/sinking_edge.hpp"
#include "geometry/shape/angle.hpp"

namespace polynya::fracture {
namespace {

constexpr double kTableStep = 0.2;  // step of ρ
/// Moments by ρ; tests/fracture/bending/edge_sections_test.cpp computes them from the beam.
constexpr std::array<double, 21> kOfForce = {0,       0.19732, 0.38034, 0.53928, 0.66840, 0.76522, 0.82976,
                                             0.86381, 0.87042, 0.85342, 0.81699, 0.76542, 0.70284, 0.63311,
                                             0.55964, 0.48538, 0.41281, 0.34389, 0.28012, 0.22254, 0.17185};
constexpr std::array<double, 21> kOfMoment = {1,       0.99803, 0.98673, 0.96184, 0.92239, 0.86941,  0.80508,
                                              0.73216, 0.65361, 0.57231, 0.49088, 0.41160, 0.33631,  0.26647,
                                              0.20311, 0.14688, 0.09812, 0.05688, 0.02300, -0.00386, -0.02419};

/// 1 − w(ρ)/w(0) under a force on the tip, by ρ.
constexpr std::array<double, 21> kDrop = {0,       0.16033, 0.30268, 0.42768, 0.53628, 0.62963, 0.70901,
                                          0.77576, 0.83124, 0.87678, 0.91365, 0.94305, 0.96609, 0.98377,
                                          0.99699, 1.00656, 1.01316, 1.01740, 1.01978, 1.02073, 1.02061};

/// Stress at the rims of cracked sections over the mean bending stress under V [-], from elements of edges of runs
/// (docs/theory/bow.md). kRimOfForce is for l = 15 h, an opening of 2 rad, and next sections in the same direction; the
/// growth factors are for length, opening [1/rad], and the change of the middle's direction over kTurnReach circles
/// [1/rad]. kRimOfLever and kRimOfThrust are the same ratios for the thrust's lever, most of which does not reach the
/// rims, and for the thrust itself.
constexpr double kRimOfForce = 0.87, kGrowthWithLength = 0.18, kGrowthWithOpening = -0.04, kGrowthWithTurn = 0.19;
constexpr double kRimOfLever = 0.31, kRimOfThrust = 0.93;
constexpr std::size_t kTurnReach = 2;
constexpr double kWeibull = 6;  ///< Weibull exponent m of ice whose strength scatters by 0.2

double interpolated(const std::array<double, 21>& table, double at) {
  const double x = std::clamp(at / kTableStep, 0.0, static_cast<double>(table.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(x), table.size() - 2);
  return std::lerp(table[i], table[i + 1], x - static_cast<double>(i));
}

/// Returns the root V > 0 of growth V² + pull V = capacity, for a section that the sinking thrust opens in proportion
/// to V.
double bearing(double pull, double growth, double capacity) {
  if (growth <= 0) return pull > 0 ? capacity / pull : std::numeric_limits<double>::infinity();
  return 2 * capacity / (pull + std::sqrt(pull * pull + 4 * growth * capacity));
}

using SectionStresses = std::array<double, kSectionCount>;  ///< σ h² / V

/// The largest stress of the sections and its place among them, by the parabola through it and its neighbours.
struct Vertex {
  double place = 0, value = 0;
};
Vertex greatest_of(const SectionStresses& stresses) {
  const auto most = static_cast<std::size_t>(std::ranges::max_element(stresses) - stresses.begin());
  const Vertex at{static_cast<double>(most), stresses[most]};
  if (most == 0 || most + 1 == kSectionCount) return at;
  const double before = stresses[most - 1], after = stresses[most + 1];
  const double curvature = 2 * at.value - before - after;
  if (!(curvature > 0)) return at;
  const double shift = std::clamp(0.5 * (after - before) / curvature, -0.5, 0.5);
  return {at.place + shift, at.value + 0.5 * shift * (after - before) - 0.5 * shift * shift * curvature};
}

/// Returns the mean place of the break, in ln r, if the strength of each section scatters independently. By the weakest
/// link, a section is that place with a probability proportional to σ^m [Weibull].
double expected_place(const SectionStresses& stresses) {
  double sum = 0, moment = 0;
  for (std::size_t i = 0; i < kSectionCount; ++i) {
    const double cube = stresses[i] * stresses[i] * stresses[i];
    sum += cube * cube;
    moment += static_cast<double>(i) * cube * cube;
  }
  return sum > 0 ? moment / sum : greatest_of(stresses).place;
}

/// Returns the angle that the ice takes on a circle; the section is r times that wide.
double opening_of(const geometry::WedgeAngles& wedge) {
  return wedge.front + wedge.back;
}

/// Returns the direction of a section's middle from the normal, towards the front.
double middle_of(const geometry::WedgeAngles& wedge) {
  return 0.5 * (wedge.front - wedge.back);
}

/// Returns the widest opening in the range where the bottom fibre is under tension across the section.
double widest_near(const EdgeOpenings& openings) {
  constexpr double kReach = 0.5;  // of l
  double widest = 0;
  for (std::size_t i = 0; i < kSectionCount && kSectionRadii[i] <= kReach; ++i) {
    widest = std::max(widest, opening_of(openings[i]));
  }
  return widest;
}

/// Returns 1 if a radial crack opens below before the edge breaks, 0 if not. Values between avoid that an edge that
/// widens a little carries much less.
double crack_share(double widest) {
  constexpr double kWhole = 90 * geometry::kRadiansPerDegree, kCracked = 105 * geometry::kRadiansPerDegree;
  return std::clamp((widest - kWhole) / (kCracked - kWhole), 0.0, 1.0);
}

/// Returns V / (σ_f h²) at which the halves of an edge crack radially too. Such parts break at once; in a notch they
/// carry more until the third crack. From elements of edges wider than 150°. The thrust, which closes sections, does
/// not matter.
double held_until_next_cracks(double widest) {
  constexpr double kSecondCracks = 0.585;
  return kSecondCracks * (1 + std::max(0.0, widest - 180 * geometry::kRadiansPerDegree));
}

SectionStresses stresses_of_whole(const EdgeOpenings& openings, const EdgePush& push, double sinking) {
  SectionStresses stresses{};
  for (std::size_t i = 0; i < kSectionCount; ++i) {
    const double r = kSectionRadii[i] * push.length;
    const double place = r / push.effective_length;
    const double held = moment_of_moment(place);
    const double moment =
        push.effective_length * moment_of_force(place) - (push.distance + push.thrust * push.lever) * held;
    const double growth = 6 * push.thrust * sinking * interpolated(kDrop, place) * std::max(0.0, held);
    stresses[i] = 1 / bearing(6 * moment - push.thrust, growth,
                              hold_of_whole(opening_of(openings[i])) * opening_of(openings[i]) * r);
  }
  return stresses;
}

/// Returns the stress at the rims of section i over the mean bending stress under V. Arguments are limited to the range
/// of the elements.
double rim_of_force(const EdgeOpenings& openings, double length, std::size_t i) {
  constexpr double kWidest = 180 * geometry::kRadiansPerDegree, kMostTurn = 1;
  const double turn = middle_of(openings[std::min(i + kTurnReach, kSectionCount - 1)]) - middle_of(openings[i]);
  return kRimOfForce + kGrowthWithLength * (std::clamp(length, 10.0, 21.2) / 15 - 1) +
         kGrowthWithOpening * (std::min(opening_of(openings[i]), kWidest) - 2) +
         kGrowthWithTurn * std::min(std::abs(turn), kMostTurn);
}

/// Returns the stresses at the rims of all sections. A section closer to the crushed facet than kGap h belongs to the
/// region where the load enters the ice; of a section across that limit only the part of ln r beyond it counts.
SectionStresses stresses_of_rims(const EdgeOpenings& openings, const EdgePush& push, double sinking) {
  constexpr double kGap = 1;
  const double least = push.facet + kGap;
  const double half_step = std::sqrt(kSectionStep);
  SectionStresses stresses{};
  for (std::size_t i = 0; i < kSectionCount; ++i) {
    const double r = kSectionRadii[i] * push.length;
    if (r * half_step <= least) continue;
    const double place = r / push.effective_length;
    const double held = moment_of_moment(place);
    const double force = rim_of_force(openings, push.length, i) *
                         (push.effective_length * moment_of_force(place) - push.distance * held);
    const double lever = kRimOfLever * push.thrust * push.lever * held;
    const double growth = 6 * kRimOfLever * push.thrust * sinking * interpolated(kDrop, place) * std::max(0.0, held);
    const double bears = bearing(6 * (force - lever) - kRimOfThrust * push.thrust, growth, opening_of(openings[i]) * r);
    const double share = std::min(1.0, elementary::log(r * half_step / least) / elementary::log(kSectionStep));
    stresses[i] = elementary::pow(share, 1 / kWeibull) / bears;
  }
  return stresses;
}

}  // namespace

double moment_of_force(double distance) {
  return interpolated(kOfForce, distance);
}

double moment_of_moment(double distance) {
  return interpolated(kOfMoment, distance);
}

double hold_of_whole(double opening) {
  constexpr double kBeam = 45 * geometry::kRadiansPerDegree;  ///< narrower wedges bend as beams
  constexpr double kGrowth = 0.18;                            ///< per radian
  return 1 + kGrowth * std::max(0.0, opening - kBeam);
}

SectionBreak weakest_section(const EdgeOpenings& openings, const EdgePush& push) {
  return weakest_section_of_sinking(openings, push, 0);
}

SectionBreak weakest_section_of_sinking(const EdgeOpenings& openings, const EdgePush& push, double sinking,
                                        bool has_radial_cracks) {
  const double widest = widest_near(openings);
  const double cracked = has_radial_cracks ? crack_share(widest) : 0;
  // For V = σ_f h²: the section with the largest stress breaks.
  SectionStresses whole{}, rims{}, both{};
  if (cracked < 1) whole = stresses_of_whole(openings, push, sinking);
  if (cracked > 0) rims = stresses_of_rims(openings, push, sinking);
  for (std::size_t i = 0; i < kSectionCount; ++i) both[i] = std::lerp(whole[i], rims[i], cracked);
  const Vertex at = greatest_of(both);
  const double place = cracked > 0 ? std::lerp(greatest_of(whole).place, expected_place(rims), cracked) : at.place;
  return {1 / std::max(at.value, cracked / held_until_next_cracks(widest)),
          kSectionRadii[0] * elementary::pow(kSectionStep, place) * push.length};
}

}  // namespace polynya::fracture
