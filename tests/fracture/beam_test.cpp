// Floes as beams, compared with closed forms.
#include "fracture/beam.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/shapes.hpp"

namespace polynya::fracture {
namespace {

using shapes::rectangle;

constexpr double kLength = 24;  // [m]
constexpr double kWidth = 3;    // [m]
constexpr double kForce = 1e5;  // [N]

SectionLoad load_at(double x, const std::vector<BeamLoad>& loads) {
  const geometry::Polygon beam = rectangle(kLength, kWidth);
  return section_load(loads, moments_of(beam, {}), moments_up_to(beam, {}, x), {x, 0, kWidth});
}

/// The greatest moment in plan over all sections.
double most_moment(const std::vector<BeamLoad>& loads) {
  double most = 0;
  for (int k = 1; k < 960; ++k) most = std::fmax(most, std::abs(load_at(kLength * (k / 960.0 - 0.5), loads).moment));
  return most;
}

TEST(Beam, MomentsOfARegionAreThoseOfItsIntegrals) {
  const PlaneMoments whole = moments_of(rectangle(kLength, kWidth), {{5, 0}, {}});
  EXPECT_DOUBLE_EQ(whole.area, 72);
  EXPECT_NEAR(whole.x, 5 * 72, 1e-9);
  EXPECT_NEAR(whole.xx, 72 * (25 + kLength * kLength / 12), 1e-9);
  EXPECT_NEAR(whole.yy, 72 * kWidth * kWidth / 12, 1e-9);
  EXPECT_NEAR(whole.xy, 0, 1e-9);
  // A U, whose part before a section that cuts both arms is in two pieces, and a hole.
  geometry::Polygon u{{{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}}, {}};
  const geometry::Pose quarter_turn{{0, 0}, geometry::Rotation::by(-0.5 * std::numbers::pi)};  // its y along x
  const PlaneMoments low = moments_up_to(u, quarter_turn, 2);
  EXPECT_NEAR(low.area, 4 + 2, 1e-12);
  EXPECT_NEAR(low.x, 4 * 0.5 + 2 * 1.5, 1e-12);
  EXPECT_NEAR(low.y, -6 * 2, 1e-12);
  const geometry::Polygon holed{rectangle(4, 4).outer, {shapes::reversed(rectangle(2, 2).outer)}};
  EXPECT_NEAR(moments_up_to(holed, {}, 0).area, 6, 1e-12);
  EXPECT_NEAR(moments_of(holed, {}).xx, (256.0 - 16) / 12, 1e-12);
}

TEST(Beam, IsAsSlenderAsARectangleOfFourToOne) {
  const auto is_slender = [](double length, double width) {
    return is_beam(length * width, (length * length + width * width) / 12);
  };
  EXPECT_TRUE(is_slender(24, 3));
  EXPECT_TRUE(is_slender(12.001, 3));
  EXPECT_FALSE(is_slender(11.999, 3));
  EXPECT_FALSE(is_slender(4, 3));
  const PlaneMoments turned = moments_of(rectangle(kLength, kWidth), {{0, 0}, geometry::Rotation::by(0.3)});
  EXPECT_NEAR(long_axis(turned), 0.3, 1e-12);
}

/// A free beam has the moment ⅛ F Λ if it is pressed at its middle. Pressed at its end it has 4/27 F Λ, a third of its
/// length from there.
TEST(Beam, ThatIsFreeBendsAgainstItsInertia) {
  const SectionLoad middle = load_at(0, {{{0, 1.5}, {0, -kForce}, 0}});
  EXPECT_NEAR(middle.moment, -kForce * kLength / 8, 1e-6) << "it pulls on the side away from the force";
  EXPECT_NEAR(middle.tension, 0, 1e-6);
  EXPECT_NEAR(most_moment({{{0, 1.5}, {0, -kForce}, 0}}), kForce * kLength / 8, 1e-6);
  // The closed form is for a slender beam. Here the moment of inertia includes the width, a share of 1/64.
  const double at_third = std::abs(load_at(kLength / 6, {{{kLength / 2, 0}, {0, kForce}, 0}}).moment);
  EXPECT_NEAR(at_third / (kForce * kLength * 4 / 27), 1, 0.02);
  EXPECT_NEAR(most_moment({{{kLength / 2, 0}, {0, kForce}, 0}}) / at_third, 1, 0.005);
}

TEST(Beam, OnTwoSupportsBendsByAQuarter) {
  const std::vector<BeamLoad> pressed{
      {{0, 1.5}, {0, -kForce}, 0}, {{-12, -1.5}, {0, kForce / 2}, 0}, {{12, -1.5}, {0, kForce / 2}, 0}};
  EXPECT_NEAR(most_moment(pressed), kForce * kLength / 4, 1e-6);
  const Ice ice{.thickness = 1.6};
  const double breaking = 4 * ice.flexural_strength * ice.thickness * kWidth * kWidth / 6 / kLength;
  const SectionLoad load{0, breaking * kLength / 4, 0};
  EXPECT_NEAR(section_stress(ice, kWidth, load) / ice.flexural_strength, 1, 1e-12);
}

/// The elastic stress at a corner of a rectangular section: by N over h w, by M about the upright axis, 6 M/(h w²), by
/// M_v about the level one, 6 M_v/(w h²).
TEST(Beam, StressOfASectionIsThatOfEachLoadByItsOwnModulus) {
  const Ice ice{.thickness = 0.8};
  const double h = ice.thickness, w = kWidth;
  EXPECT_DOUBLE_EQ(section_stress(ice, w, {kForce, 0, 0}), kForce / (h * w));
  EXPECT_DOUBLE_EQ(section_stress(ice, w, {0, -kForce, 0}), 6 * kForce / (h * w * w));
  EXPECT_DOUBLE_EQ(section_stress(ice, w, {0, 0, -kForce}), 6 * kForce / (w * h * h));
  EXPECT_DOUBLE_EQ(section_stress(ice, w, {-kForce, kForce, kForce}),
                   -kForce / (h * w) + 6 * kForce / (h * w * w) + 6 * kForce / (w * h * h));
}

TEST(Beam, ThatIsPushedAtItsEndIsPressedAlongIt) {
  const SectionLoad load = load_at(0, {{{-12, 0}, {kForce, 0}, 0}});
  EXPECT_NEAR(load.tension, -kForce / 2, 1e-6);
  EXPECT_NEAR(load.moment, 0, 1e-6);
  EXPECT_NEAR(load_at(0, {{{-12, 0}, {-kForce, 0}, 0}}).tension, kForce / 2, 1e-6) << "pulled";
  // A force off the beam's axis also bends it: the moment is F e at the pushed end and zero at the other end.
  EXPECT_NEAR(load_at(-11.999, {{{-12, 1}, {kForce, 0}, 0}}).moment, -kForce, 0.01 * kForce);
}

TEST(Beam, ThatIsPressedDownIsLiftedByTheWater) {
  EXPECT_NEAR(load_at(0, {{{0, 1.5}, {}, kForce}}).vertical_moment, -kForce * kLength / 8, 1e-6);
  // At its end: rigid, heave and pitch; 4/27 V Λ again, since the lift is linear too.
  EXPECT_NEAR(std::abs(load_at(kLength / 6, {{{kLength / 2, 0}, {}, kForce}}).vertical_moment),
              kForce * kLength * 4 / 27, 1e-6);
}

/// Hetényi's free beam pressed at its middle: V Λ/8 if short, V/(4 β) if long.
TEST(Beam, OnWaterIsRigidIfShortAndEndlessIfLong) {
  const Ice ice{.thickness = 1.6};
  const double beta = std::pow(1000 * 9.81 / (4 * ice.youngs_modulus * std::pow(1.6, 3) / 12), 0.25);
  EXPECT_NEAR(elastic_share(ice, {}, 1), 1, 1e-4);
  EXPECT_NEAR(elastic_share(ice, {}, 0.01 / beta * 1.001), elastic_share(ice, {}, 0.01 / beta * 0.999), 1e-9);
  EXPECT_NEAR(elastic_share(ice, {}, 24), 0.998, 0.005);
  EXPECT_NEAR(elastic_share(ice, {}, 40 / beta) * 40 / 8, 1.0 / 4, 1e-9);
}

TEST(Beam, NoSectionHasMoreThanTheBound) {
  const Ice ice{.thickness = 1.6};
  for (int k = 0; k <= 24; ++k) {
    const double x = k - 12.0;
    const double angle = 0.7 * k;
    for (const double force : {0.0, kForce}) {  // without a force in plan, what presses down is alone
      const BeamLoad load{{x, 1.5}, {force * std::cos(angle), force * std::sin(angle)}, 0.5 * kForce};
      const double most = most_section_stress(ice, kWidth, kLength, force, load.down);
      for (int s = -11; s <= 11; ++s)
        EXPECT_LT(section_stress(ice, kWidth, load_at(s, {load})), most) << x << ' ' << angle << ' ' << s;
    }
  }
}

}  // namespace
}  // namespace polynya::fracture
