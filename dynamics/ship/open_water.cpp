#include "dynamics/ship/open_water.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elementary/elementary.hpp"

namespace polynya::dynamics {
namespace {

constexpr double kGravitationalAcceleration = 9.81;  ///< [m/s²]
constexpr double kViscosity = 1.83e-6;               ///< of sea water at 0 °C [m²/s]
constexpr double kFullestHull = 0.85;                ///< largest prismatic coefficient of the regression [-]
constexpr double kFastest = 0.4;                     ///< largest Froude number of its formula for slow ships [-]
constexpr double kSlowest = 0.05;                    ///< Froude number at which the search for a speed begins [-]
constexpr double kDegrees = 180 / std::numbers::pi;

/// Coefficients of form that follow from the block coefficient.
struct Form {
  double midship = 0;     ///< C_M = 1/(1 + (1 − C_B)^3.5) [-]
  double waterplane = 0;  ///< C_WP = (1 + 2 C_B)/3 [-]
  double prismatic = 0;   ///< C_P = C_B/C_M [-]
  double volume = 0;      ///< displaced [m³]
  double run = 0;         ///< L_R, length of the run [m]
};

std::optional<Form> form_of(const MainDimensions& hull) {
  const double block = hull.block_coefficient;
  Form form;
  form.midship = 1 / (1 + elementary::pow(1 - block, 3.5));
  form.waterplane = (1 + 2 * block) / 3;
  form.prismatic = block / form.midship;
  form.volume = block * hull.length * hull.beam * hull.draught;
  form.run = hull.length * (1 - form.prismatic);
  if (form.prismatic > kFullestHull) return {};
  return form;
}

/// Returns the friction of the wetted surface with its form factor, and the correlation allowance [N].
double viscous_resistance(const MainDimensions& hull, const Form& form, double speed, double density) {
  const auto [length, beam, draught, block] = hull;
  const double factor = 0.93 + 0.487118 * elementary::pow(beam / length, 1.06806) *
                                   elementary::pow(draught / length, 0.46106) *
                                   elementary::pow(length / form.run, 0.121563) *
                                   elementary::pow(elementary::pow(length, 3) / form.volume, 0.36486) *
                                   elementary::pow(1 - form.prismatic, -0.604247);
  const double surface =
      length * (2 * draught + beam) * std::sqrt(form.midship) *
      (0.453 + 0.4425 * block - 0.2862 * form.midship - 0.003467 * beam / draught + 0.3696 * form.waterplane);
  const double friction = 0.075 / elementary::pow(elementary::log10(speed * length / kViscosity) - 2, 2);
  const double slender = std::min(draught / length, 0.04);
  const double allowance = 0.006 * elementary::pow(length + 100, -0.16) - 0.00205 +
                           0.003 * std::sqrt(length / 7.5) * elementary::pow(block, 4) * (0.04 - slender);
  return 0.5 * density * speed * speed * surface * (factor * friction + allowance);
}

double wave_resistance(const MainDimensions& hull, const Form& form, double entrance, double froude, double density) {
  const auto [length, beam, draught, block] = hull;
  const double width = beam / length > 0.25 ? 0.5 - 0.0625 * length / beam : beam / length;
  const double size = 2223105 * elementary::pow(width, 3.78613) * elementary::pow(draught / beam, 1.07961) *
                      elementary::pow(90 - kDegrees * entrance, -1.37565);
  const double p = form.prismatic;
  const double fullness = p < 0.8 ? 8.07981 * p - 13.8673 * p * p + 6.984388 * p * p * p : 1.73014 - 0.7067 * p;
  const double m1 = 0.0140407 * length / draught - 1.75254 * elementary::cbrt(form.volume) / length -
                    4.79323 * beam / length - fullness;
  const double slenderness = length / elementary::cbrt(form.volume);
  const double c15 = slenderness < 8 ? -1.69385 : std::min(0.0, -1.69385 + (slenderness - 8) / 2.36);
  const double m4 = 0.4 * c15 * elementary::exp(-0.034 * elementary::pow(froude, -3.29));
  const double length_of_waves = 1.446 * p - (length / beam < 12 ? 0.03 * length / beam : 0.36);
  return size * form.volume * density * kGravitationalAcceleration *
         elementary::exp(m1 * elementary::pow(froude, -0.9) +
                         m4 * elementary::cos(length_of_waves / (froude * froude)));
}

}  // namespace

std::optional<double> usual_entrance_angle(const MainDimensions& hull) {
  const auto form = form_of(hull);
  if (!form) return {};
  const auto [length, beam, draught, block] = hull;
  const double exponent = elementary::pow(length / beam, 0.80856) * elementary::pow(1 - form->waterplane, 0.30484) *
                          elementary::pow(1 - form->prismatic, 0.6367) * elementary::pow(form->run / beam, 0.34574) *
                          elementary::pow(100 * form->volume / elementary::pow(length, 3), 0.16302);
  return (1 + 89 * elementary::exp(-exponent)) / kDegrees;
}

double usual_block_coefficient(double length, double beam, double speed) {
  const double froude = speed / std::sqrt(kGravitationalAcceleration * length);
  return std::clamp(0.14 / froude * (length / beam + 20) / 26, 0.48, 0.85);
}

std::optional<double> open_water_resistance(const MainDimensions& hull, double entrance, double speed, double density) {
  const auto form = form_of(hull);
  const double froude = speed / std::sqrt(kGravitationalAcceleration * hull.length);
  if (!form || froude > kFastest) return {};
  return viscous_resistance(hull, *form, speed, density) + wave_resistance(hull, *form, entrance, froude, density);
}

std::optional<double> usual_open_water_speed(const MainDimensions& hull, double entrance, double power,
                                             double density) {
  const auto needed = [&](double speed) {
    return open_water_resistance(hull, entrance, speed, density).value_or(0) * speed / kPowerIntoResistance;
  };
  double slow = kSlowest * std::sqrt(kGravitationalAcceleration * hull.length),
         fast = kFastest * std::sqrt(kGravitationalAcceleration * hull.length);
  if (!form_of(hull) || needed(slow) > power || needed(fast) < power) return {};
  while (fast - slow > 1e-6) {
    const double middle = 0.5 * (slow + fast);
    (needed(middle) < power ? slow : fast) = middle;
  }
  return slow;
}

}  // namespace polynya::dynamics
