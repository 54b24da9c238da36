#include "fracture/bending/edge_sections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "elementary/elementary.hpp"

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

/// The rims of cracked sections, by elements of edges of runs (docs/theory/bow.md): what they have of the mean bending
/// stress under V, at 15 h and 2 rad, where the next sections have one direction; how that grows with length, opening,
/// and the change of the middle's direction over kTurnReach circles; and what they have of the mean stress by the
/// thrust's lever, most of which does not reach them, and by the thrust itself.
constexpr double kRimOfForce = 0.87, kGrowthWithLength = 0.18, kGrowthWithOpening = -0.04, kGrowthWithTurn = 0.19;
constexpr double kRimOfLever = 0.31, kRimOfThrust = 0.93;
constexpr std::size_t kTurnReach = 2;
constexpr double kWeibull = 6;  ///< m of ice whose strength scatters by .2

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

using SectionStresses = std::array<double, kSectionCount>;  ///< σ h² / V

/// The greatest of sections and its place among them, by the parabola through it and its neighbours.
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

/// Where the edge breaks on an average, in ln r, if the strength of each section scatters for itself: by the weakest
/// link that place is a section's with a probability in proportion to σ^m [Weibull].
double expected_place(const SectionStresses& stresses) {
  double sum = 0, moment = 0;
  for (std::size_t i = 0; i < kSectionCount; ++i) {
    const double cube = stresses[i] * stresses[i] * stresses[i];
    sum += cube * cube;
    moment += static_cast<double>(i) * cube * cube;
  }
  return sum > 0 ? moment / sum : greatest_of(stresses).place;
}

/// The angle that the ice takes on a circle: the section is r times that wide.
double opening_of(const geometry::WedgeAngles& wedge) {
  return wedge.front + wedge.back;
}

/// The direction of a section's middle from the normal, towards the front.
double middle_of(const geometry::WedgeAngles& wedge) {
  return 0.5 * (wedge.front - wedge.back);
}

/// The widest opening where the bottom fibre is pulled across.
double widest_near(const EdgeOpenings& openings) {
  constexpr double kReach = 0.5;  // of l
  double widest = 0;
  for (std::size_t i = 0; i < kSectionCount && kSectionRadii[i] <= kReach; ++i) {
    widest = std::max(widest, opening_of(openings[i]));
  }
  return widest;
}

/// Whether a radial crack opens below before the edge breaks: 0 no, 1 yes; between, so that an edge that widens a
/// little does not bear much less.
double crack_share(double widest) {
  constexpr double kWhole = 90 * geometry::kRadiansPerDegree, kCracked = 105 * geometry::kRadiansPerDegree;
  return std::clamp((widest - kWhole) / (kCracked - kWhole), 0.0, 1.0);
}

/// V / (σ_f h²) at which its halves crack radially too: such parts break at once, but in a notch, where they are too
/// many until the third cracks. By elements of edges wider than 150°; the thrust, which closes sections, does not
/// matter.
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

/// What the rims of section i have of the mean bending stress under V; held beyond what the elements had.
double rim_of_force(const EdgeOpenings& openings, double length, std::size_t i) {
  constexpr double kWidest = 180 * geometry::kRadiansPerDegree, kMostTurn = 1;
  const double turn = middle_of(openings[std::min(i + kTurnReach, kSectionCount - 1)]) - middle_of(openings[i]);
  return kRimOfForce + kGrowthWithLength * (std::clamp(length, 10.0, 21.2) / 15 - 1) +
         kGrowthWithOpening * (std::min(opening_of(openings[i]), kWidest) - 2) +
         kGrowthWithTurn * std::min(std::abs(turn), kMostTurn);
}

/// A section nearer to the crushed facet than kGap h is part of how the load gets into the ice; what lies farther of
/// its share of ln r counts.
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
  constexpr double kBeam = 45 * geometry::kRadiansPerDegree;  ///< narrower, a wedge bends as a beam
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
  // By V = σ_f h²: whichever section has most of it breaks.
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
