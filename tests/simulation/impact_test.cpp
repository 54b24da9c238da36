// Bodies that meet ice at any gap, down to none. No step presses with more than the strength of the ice, and the
// largest loads equal those of closed forms.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Polygon;

constexpr double kFaceLineLoad = 2.8e6 * 0.5;  // σ_c h of the default ice [N/m]
constexpr double kAllowed =
    2e-3;  // a line is foreseen to a thousandth, and is longer by 1/cos where faces are askew [-]

/// How a body meets ice.
struct Approach {
  double speed = 0;  ///< [m/s]
  double gap = 0;    ///< distance to the ice at the start [m]
  double step = 0;   ///< [s]
  double tilt = 0;   ///< angle between the faces that meet [rad]

  friend std::ostream& operator<<(std::ostream& out, const Approach& a) {
    return out << a.speed << " m/s, gap " << a.gap << " m, step " << a.step << " s, tilt " << a.tilt << " rad";
  }
};

/// A body that meets ice head on, and the largest force that the ice can transmit.
struct Impact {
  Scene scene;
  double mass = 0;                         ///< mass of the moving body [kg]
  std::function<double(double)> force_at;  ///< the force of crushing by the depth [N by m]
  double most = 0;                         ///< largest force at any depth [N]
};

/// The greatest force of an impact by its closed form: at the depth where ½ m v² = ∫ F dξ.
double closed_form(const Impact& impact, double speed) {
  constexpr double kSlice = 1e-5;  // [m]
  double left = 0.5 * impact.mass * speed * speed;
  double depth = 0;
  for (; left > 0; depth += kSlice) left -= kSlice * impact.force_at(depth + 0.5 * kSlice);
  return impact.force_at(depth);
}

/// The greatest loads of steps [N].
struct Largest {
  double contact = 0;   ///< along the normal of one contact
  double recorded = 0;  ///< largest load on the hull in rows of forces, and in their means
};

Largest largest_of(const Impact& impact, const Approach& a) {
  Largest most;
  const Trial done = run(impact.scene, a.gap / a.speed + 2, [&](const Simulation& simulation) {
    for (const dynamics::Contact& c : simulation.world().data.contacts)
      most.contact =
          std::max(most.contact, c.step_share * c.total_normal_impulse() / simulation.world().last_step.length);
  });
  EXPECT_FALSE(done.simulation.numerical_failure().has_value());
  for (const HullSample& sample : done.story.samples)
    most.recorded = std::max({most.recorded, std::abs(sample.from_ice_largest.surge), std::abs(sample.from_ice.surge)});
  return most;
}

// ---- what meets what

Build bare(const Approach& a) {
  return Build().without_drag().without_splits().unbreakable().step(a.step).recorded_each_step();
}

std::function<double(double)> flat(double width) {
  return [width](double) { return kFaceLineLoad * width; };
}

/// A flat face and a circle of a radius: the chord at the depth.
std::function<double(double)> chord(double radius) {
  return [radius](double depth) {
    const double inside = std::min(depth, radius);
    return kFaceLineLoad * 2 * std::sqrt(inside * (2 * radius - inside));
  };
}

/// About the middle of the face of a body that is to touch x = 0 from the left, after a gap.
geometry::Pose coming(const Approach& a, double width) {
  return {{-a.gap - 0.5 * width * std::sin(std::abs(a.tilt)), 0}, geometry::Rotation::by(a.tilt)};
}

/// A free floe of a length behind its face.
FloeSpec floe_with_face(const Approach& a, double length, double width) {
  return scenes::floe(transform(coming(a, width), rectangle(-length, -width / 2, 0, width / 2)), {a.speed, 0});
}
double mass_of(double length, double width) {
  return 900 * 0.5 * length * width;
}

const Polygon kPlate = rectangle(0, -150, 600, 150);

/// Returns a ship that moves astern into the ice, with a stern of 24 m.
Impact stern_onto_edge(const Approach& a) {
  Ship ship = icebreaker({}, ConstantThrust{0}, -a.speed);
  const geometry::Pose pose = coming(a, 24);
  ship.position_in_world = transform(pose, {-60, 0});
  ship.heading = std::numbers::pi + a.tilt;
  return {bare(a).ship(ship).floe(fast(kPlate)), 1e7, flat(24), 24 * kFaceLineLoad};
}

Ship coming_barge(const Approach& a) {
  Ship ship = barge({}, ConstantThrust{0}, a.speed);
  ship.position_in_world = transform(coming(a, 24), {-60, 0});
  ship.heading = a.tilt;
  return ship;
}

Impact box_onto_edge(const Approach& a) {
  return {bare(a).ship(coming_barge(a)).floe(fast(kPlate)), 1e7, flat(24), 24 * kFaceLineLoad};
}

Impact floe_onto_box(const Approach& a) {
  return {bare(a).structure(rectangle(0, -10, 20, 10).outer).floe(floe_with_face(a, 200, 150)), mass_of(200, 150),
          flat(20), 20 * kFaceLineLoad};
}

Impact floe_onto_edge(const Approach& a) {
  return {bare(a).floe(fast(kPlate)).floe(floe_with_face(a, 2000, 20)), mass_of(2000, 20), flat(20),
          20 * kFaceLineLoad};
}

/// Its walls lean: the facet grows to h / cos θ.
Impact floe_onto_leaning_box(const Approach& a) {
  constexpr double kLean = 10 * kDegree;
  const double most = 20 * kFaceLineLoad * (1 + 0.2 * std::tan(kLean));
  const auto force_at = [most](double depth) { return most * std::min(1.0, depth / (0.5 * std::tan(kLean))); };
  return {bare(a).structure(rectangle(0, -10, 20, 10).outer, {}, kLean).floe(floe_with_face(a, 200, 150)),
          mass_of(200, 150), force_at, most};
}

constexpr double kRound = 40;  // radius of round ice [m]
Polygon round_ice(double x) {
  return shapes::regular(800, kRound, {x, 0});
}

Impact box_onto_round_ice(const Approach& a) {
  return {bare(a).ship(coming_barge(a)).floe(fast(round_ice(kRound))), 1e7, chord(kRound), 24 * kFaceLineLoad};
}

Impact round_floe_onto_edge(const Approach& a) {
  return {bare(a).floe(fast(kPlate)).floe(round_ice(-a.gap - kRound), {a.speed, 0}),
          900 * 0.5 * std::numbers::pi * kRound * kRound, chord(kRound), 2 * kRound * kFaceLineLoad};
}

Impact floe_onto_pile(const Approach& a) {
  constexpr double kPile = 5;
  return {bare(a).structure(shapes::regular(400, kPile).outer, {kPile, 0}).floe(floe_with_face(a, 200, 150)),
          mass_of(200, 150), chord(kPile), 2 * kPile * kFaceLineLoad};
}

using Make = Impact (*)(const Approach&);
constexpr Make kFlat[] = {stern_onto_edge, box_onto_edge, floe_onto_box, floe_onto_edge};
constexpr Make kCurved[] = {floe_onto_leaning_box, box_onto_round_ice, round_floe_onto_edge, floe_onto_pile};

/// If faces meet obliquely, the sides of a notch press as well. Their friction is part of the load on the hull but not
/// of the load of a contact.
Largest expect_within_what_ice_bears(const Impact& impact, const Approach& a) {
  const Largest most = largest_of(impact, a);
  // If faces meet obliquely, the line of the contact is longer by a side of the notch, at most 0.2 % in 1000 trials.
  const double of_notch = a.tilt == 0 ? 0 : 0.003;
  EXPECT_LE(most.contact, (1 + kAllowed + of_notch) * impact.most);
  if (a.tilt == 0) {
    EXPECT_LE(most.recorded, (1 + kAllowed) * impact.most);
  }
  return most;
}

// ---- the trials

/// Round numbers, by which a body reaches the ice just at the end of a step.
std::vector<Approach> round_approaches() {
  std::vector<Approach> all;
  for (const double speed : {0.5, 1.0, 2.0}) {
    for (const double gap : {0.0, 1e-9, 0.001, 0.1, 0.5, 1.0, 2.0}) {
      for (const double step : {0.005, 0.02, 0.05}) all.push_back({speed, gap, step});
    }
  }
  return all;
}

TEST(Impact, OfFlatFacesIsTheirClosedFormAtRoundGaps) {
  for (const Make& make : kFlat) {
    for (const Approach& a : round_approaches()) {
      SCOPED_TRACE(testing::Message() << "scene " << &make - kFlat << ": " << a);
      const Impact impact = make(a);
      const Largest most = expect_within_what_ice_bears(impact, a);
      EXPECT_NEAR(most.contact / closed_form(impact, a.speed), 1, 0.02);
    }
  }
}

/// The greatest error of loads at round gaps.
double error_of_curved(Make make, double step) {
  double most = 0;
  for (Approach a : round_approaches()) {
    if (a.step != 0.005) continue;
    a.step = step;
    SCOPED_TRACE(testing::Message() << a);
    const Impact impact = make(a);
    const Largest largest = expect_within_what_ice_bears(impact, a);
    most = std::max(most, std::abs(largest.contact / closed_form(impact, a.speed) - 1));
  }
  return most;
}

TEST(Impact, OfCurvedEdgesIsTheirClosedFormWithAnErrorInProportionToTheStep) {
  for (const Make& make : kCurved) {
    SCOPED_TRACE(testing::Message() << "scene " << &make - kCurved);
    const double fine = error_of_curved(make, 0.005), coarse = error_of_curved(make, 0.02);
    EXPECT_LT(fine, 0.03);
    EXPECT_LT(coarse, 0.12);
  }
}

/// `ctest -L endurance` takes a thousand.
int approach_count() {
  const char* given = std::getenv("POLYNYA_IMPACTS");
  return given != nullptr ? std::atoi(given) : 100;
}

TEST(Impact, AtNoGapAndTiltIsAboveWhatTheIceBears) {
  std::mt19937_64 random(57);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  for (int i = 0; i < approach_count(); ++i) {
    Approach a;
    a.speed = between(0.3, 3);
    a.gap = i % 10 == 0 ? 0 : std::pow(10, between(-13, 0));
    a.step = std::pow(10, between(-2.7, -1.3));
    if (i % 2 == 0) a.tilt = (i % 4 == 0 ? 1 : -1) * std::pow(10, between(-10, -1.5));
    const Make make = i % 8 < 4 ? kFlat[i % 4] : kCurved[i % 4];
    SCOPED_TRACE(testing::Message() << i << ": " << a);
    const Impact impact = make(a);
    expect_within_what_ice_bears(impact, a);
  }
}

}  // namespace
}  // namespace polynya::simulation
