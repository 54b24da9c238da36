#include "fracture/bending/edge_sections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "elementary/elementary.hpp"
#include "fracture/bending/sinking_edge.hpp"
#include "geometry/shape/angle.hpp"

namespace polynya::fracture {
namespace {

constexpr double kTableStep = 0.2;  // step of ρ in the tables below [-]
/// Bending moments at ρ = 0, 0.2, … 4 under a unit force and under a unit moment on the tip.
/// tests/fracture/bending/edge_sections_test.cpp computes them from the equation of the beam.
constexpr std::array<double, 21> kOfForce = {0,       0.19732, 0.38034, 0.53928, 0.66840, 0.76522, 0.82976,
                                             0.86381, 0.87042, 0.85342, 0.81699, 0.76542, 0.70284, 0.63311,
                                             0.55964, 0.48538, 0.41281, 0.34389, 0.28012, 0.22254, 0.17185};
constexpr std::array<double, 21> kOfMoment = {1,       0.99803, 0.98673, 0.96184, 0.92239, 0.86941,  0.80508,
                                              0.73216, 0.65361, 0.57231, 0.49088, 0.41160, 0.33631,  0.26647,
                                              0.20311, 0.14688, 0.09812, 0.05688, 0.02300, -0.00386, -0.02419};

/// Deflection of the tip relative to a section, 1 − w(ρ)/w(0), under a force on the tip, at the same ρ. It is the part
/// of the tip's sinking by which the thrust's lever above the section decreases.
constexpr std::array<double, 21> kRelativeSinking = {0,       0.16033, 0.30268, 0.42768, 0.53628, 0.62963, 0.70901,
                                                     0.77576, 0.83124, 0.87678, 0.91365, 0.94305, 0.96609, 0.98377,
                                                     0.99699, 1.00656, 1.01316, 1.01740, 1.01978, 1.02073, 1.02061};

/// Stress at the rims of cracked sections / mean bending stress [-]. All constants are from finite elements of 195
/// edges of runs (docs/theory/bow.md). kRimOfForce is the ratio under V for l = 15 h, an opening of 2 rad, and sections
/// in the same direction. The kGrowth constants are its growth with l/15h, with the opening [1/rad], and with the
/// change of direction of the section's middle over the next kTurnReach circles [1/rad]. kRimOfLever is the ratio for
/// the moment of the thrust, most of which does not reach the rims, and kRimOfThrust the one for the compression by the
/// thrust. Larger ratios of V make edges weaker; larger ratios of the thrust make them stronger.
constexpr double kRimOfForce = 0.87, kGrowthWithLength = 0.18, kGrowthWithOpening = -0.04, kGrowthWithTurn = 0.19;
constexpr double kRimOfLever = 0.31, kRimOfThrust = 0.93;
constexpr std::size_t kTurnReach = 2;
/// Exponent m of the Weibull distribution of ice whose strength scatters by 0.2 of its mean. It weights a section that
/// is partly within kGap of the facet. expected_place() computes σ^m for m = 6, so both must be changed together;
/// larger values then move the break of cracked edges towards the section with the largest stress.
constexpr double kWeibull = 6;

/// Returns a value of a table at ρ, by linear interpolation.
double interpolated(const std::array<double, 21>& table, double at) {
  const double x = std::clamp(at / kTableStep, 0.0, static_cast<double>(table.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(x), table.size() - 2);
  return std::lerp(table[i], table[i + 1], x - static_cast<double>(i));
}

/// Returns the force V at which a section breaks: the positive root of growth V² + pull V = capacity. `pull` is the
/// tension per force, and `growth` its increase per force because the sinking tip lowers the thrust.
double force_at_break(double pull, double growth, double capacity) {
  if (growth <= 0) return pull > 0 ? capacity / pull : std::numeric_limits<double>::infinity();
  return 2 * capacity / (pull + std::sqrt(pull * pull + 4 * growth * capacity));
}

using SectionStresses = std::array<double, kSectionCount>;  ///< σ h² / V

/// The largest stress, and its place as a (fractional) index of the sections. It is the vertex of the parabola through
/// the largest value and its two neighbours.
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

/// Returns the mean place of the break, as a (fractional) index of the sections, if the strength of each section
/// scatters independently. By the theory of the weakest link, a section breaks first with a probability proportional to
/// σ^m [Weibull].
double expected_place(const SectionStresses& stresses) {
  static_assert(kWeibull == 6);  // the weight σ^m is the square of a cube, which takes less time than a power
  double sum = 0, moment = 0;
  for (std::size_t i = 0; i < kSectionCount; ++i) {
    const double cube = stresses[i] * stresses[i] * stresses[i];
    sum += cube * cube;
    moment += static_cast<double>(i) * cube * cube;
  }
  return sum > 0 ? moment / sum : greatest_of(stresses).place;
}

/// Returns the angle of the ice on a circle; the width of the section is r times this angle [rad].
double opening_of(const geometry::WedgeAngles& wedge) {
  return wedge.front + wedge.back;
}

/// Returns the direction of the middle of a section from the normal, positive towards the front [rad].
double middle_of(const geometry::WedgeAngles& wedge) {
  return 0.5 * (wedge.front - wedge.back);
}

/// Returns the widest opening in the range in which the bottom of the ice is under tension across the sections, so that
/// a radial crack may open there [rad].
double widest_near(const EdgeOpenings& openings) {
  constexpr double kReach = 0.5;  // end of that range, as a fraction of l [-]; larger values find more edges cracked
  double widest = 0;
  for (std::size_t i = 0; i < kSectionCount && kSectionRadii[i] <= kReach; ++i) {
    widest = std::max(widest, opening_of(openings[i]));
  }
  return widest;
}

/// Returns 1 if a radial crack opens in the bottom of the ice before the edge breaks, 0 if not. Between the two angles
/// the result is interpolated, so that the force of an edge does not jump with its opening. Smaller angles make more
/// edges crack, which weakens them.
double crack_share(double widest) {
  constexpr double kWhole = 90 * geometry::kRadiansPerDegree, kCracked = 105 * geometry::kRadiansPerDegree;
  return std::clamp((widest - kWhole) / (kCracked - kWhole), 0.0, 1.0);
}

/// Returns the force V / (σ_f h²) at which each half of a cracked edge cracks radially too. The parts then break off at
/// once, so it limits the force of a cracked edge. In a notch, which is wider than 180°, the edge carries more until
/// the third crack. The thrust, which compresses the sections, has no influence.
double force_at_next_cracks(double widest) {
  /// Force at which the halves crack [-], from finite elements of edges wider than 150°. Larger: cracked edges may
  /// carry more.
  constexpr double kSecondCracks = 0.585;
  return kSecondCracks * (1 + std::max(0.0, widest - 180 * geometry::kRadiansPerDegree));
}

/// Returns the stresses of all sections of an edge without a radial crack. `sinking` is the deflection w(0)/h of the
/// tip per V/(σ_f h²) [-], as in weakest_section_of_sinking(); with 0 the tip does not sink.
SectionStresses stresses_of_whole(const EdgeOpenings& openings, const EdgeLoad& load, double sinking) {
  SectionStresses stresses{};
  for (std::size_t i = 0; i < kSectionCount; ++i) {
    const double r = kSectionRadii[i] * load.length;
    const double place = r / load.effective_length;
    const double lever_moment = moment_of_moment(place);
    const double moment =
        load.effective_length * moment_of_force(place) - (load.distance + load.thrust * load.lever) * lever_moment;
    const double growth =
        6 * load.thrust * sinking * interpolated(kRelativeSinking, place) * std::max(0.0, lever_moment);
    stresses[i] = 1 / force_at_break(6 * moment - load.thrust, growth,
                                     whole_edge_factor(opening_of(openings[i])) * opening_of(openings[i]) * r);
  }
  return stresses;
}

/// Returns the stress at the rims of section i / mean bending stress under V. Arguments are limited to the range of the
/// finite elements.
double rim_of_force(const EdgeOpenings& openings, double length, std::size_t i) {
  constexpr double kWidest = 180 * geometry::kRadiansPerDegree, kMostTurn = 1;
  const double turn = middle_of(openings[std::min(i + kTurnReach, kSectionCount - 1)]) - middle_of(openings[i]);
  return kRimOfForce + kGrowthWithLength * (std::clamp(length, 10.0, 21.2) / 15 - 1) +
         kGrowthWithOpening * (std::min(opening_of(openings[i]), kWidest) - 2) +
         kGrowthWithTurn * std::min(std::abs(turn), kMostTurn);
}

/// Returns the stresses at the rims of all sections of an edge with a radial crack. Sections closer to the crushed
/// facet than kGap h do not count, because the load spreads into the ice there. Of a section across that limit only the
/// part of ln r beyond it counts.
SectionStresses stresses_of_rims(const EdgeOpenings& openings, const EdgeLoad& load, double sinking) {
  /// Distance from the crushed facet within which sections do not count, in thicknesses [-]. Smaller values find high
  /// stresses at narrow sections near the load, where the formula does not hold.
  constexpr double kGap = 1;
  const double least = load.facet + kGap;
  const double half_step = std::sqrt(kSectionStep);
  SectionStresses stresses{};
  for (std::size_t i = 0; i < kSectionCount; ++i) {
    const double r = kSectionRadii[i] * load.length;
    if (r * half_step <= least) continue;
    const double place = r / load.effective_length;
    const double lever_moment = moment_of_moment(place);
    const double force = rim_of_force(openings, load.length, i) *
                         (load.effective_length * moment_of_force(place) - load.distance * lever_moment);
    const double lever = kRimOfLever * load.thrust * load.lever * lever_moment;
    const double growth =
        6 * kRimOfLever * load.thrust * sinking * interpolated(kRelativeSinking, place) * std::max(0.0, lever_moment);
    const double breaking_force =
        force_at_break(6 * (force - lever) - kRimOfThrust * load.thrust, growth, opening_of(openings[i]) * r);
    const double share = std::min(1.0, elementary::log(r * half_step / least) / elementary::log(kSectionStep));
    stresses[i] = elementary::pow(share, 1 / kWeibull) / breaking_force;
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

double whole_edge_factor(double opening) {
  /// Opening below which a wedge bends as a beam, without the factor [rad].
  constexpr double kBeam = 45 * geometry::kRadiansPerDegree;
  constexpr double kGrowth = 0.18;  ///< growth of the factor with the opening; larger: wide edges carry more [1/rad]
  return 1 + kGrowth * std::max(0.0, opening - kBeam);
}

SectionBreak weakest_section(const EdgeOpenings& openings, const EdgeLoad& load) {
  return weakest_section_of_sinking(openings, load, 0);
}

SectionBreak weakest_section_of_sinking(const EdgeOpenings& openings, const EdgeLoad& load, double sinking,
                                        bool has_radial_cracks) {
  const double widest = widest_near(openings);
  const double cracked = has_radial_cracks ? crack_share(widest) : 0;
  // Stresses are for V = σ_f h²; the section with the largest stress breaks first.
  SectionStresses whole{}, rims{}, both{};
  if (cracked < 1) whole = stresses_of_whole(openings, load, sinking);
  if (cracked > 0) rims = stresses_of_rims(openings, load, sinking);
  for (std::size_t i = 0; i < kSectionCount; ++i) both[i] = std::lerp(whole[i], rims[i], cracked);
  const Vertex at = greatest_of(both);
  const double place = cracked > 0 ? std::lerp(greatest_of(whole).place, expected_place(rims), cracked) : at.place;
  return {1 / std::max(at.value, cracked / force_at_next_cracks(widest)),
          kSectionRadii[0] * elementary::pow(kSectionStep, place) * load.length};
}

}  // namespace polynya::fracture
