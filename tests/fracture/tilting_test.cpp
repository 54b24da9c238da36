// A floe whose edge an inclined hull presses down: capacity, inertia, and the limit on the contact.
#include "fracture/tilting.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace polynya::fracture {
namespace {

constexpr double kArea = 225;  // of a floe of 15 m

Ice half_metre() {
  Ice ice;
  ice.thickness = 0.5;
  return ice;
}

TEST(Tilting, TheResistanceOfTheReferenceFloeIsAsDerivedByHand) {
  const TiltResistance resistance = tilt_resistance(half_metre(), {}, kArea, 1);
  EXPECT_NEAR(resistance.capacity / (1000 * 9.81 * 0.5 * kArea), 0.0487, 5e-5);
  EXPECT_NEAR(resistance.mass, 227e3, 1e3);
  EXPECT_NEAR(0.5 * std::numbers::pi / std::sqrt(resistance.stiffness / resistance.mass), 1.0, 0.02)
      << "a quarter period of 1 s";
}

TEST(Tilting, AStaticLoadPressesTheEdgeDownByItsShareOfTheStiffness) {
  const TiltResistance resistance = tilt_resistance(half_metre(), {}, kArea, 1);
  const double load = 0.5 * resistance.capacity;
  EdgeMotion edge;
  for (int i = 0; i < 40000; ++i) edge = tilted(resistance, edge, load, 0.3, 0.005);
  EXPECT_NEAR(edge.deflection, load / resistance.stiffness, 1e-9);
  EXPECT_NEAR(edge.rate, 0, 1e-9);
  for (int i = 0; i < 40000; ++i) edge = tilted(resistance, edge, 0, 0.3, 0.005);
  EXPECT_NEAR(edge.deflection, 0, 1e-9) << "and without it the floe floats as before";
}

TEST(Tilting, ALoadAboveTheCapacityPressesItDownWithoutEnd) {
  const TiltResistance resistance = tilt_resistance(half_metre(), {}, kArea, 1);
  EdgeMotion edge;
  for (int i = 0; i < 4000; ++i) edge = tilted(resistance, edge, 1.1 * resistance.capacity, 0.3, 0.005);
  EXPECT_GT(edge.deflection, 0.9 * 0.5);
}

TEST(Tilting, WithoutDampingItSwingsAsAnOscillatorDoes) {
  const TiltResistance resistance = tilt_resistance(half_metre(), {}, kArea, 1);
  const double frequency = std::sqrt(resistance.stiffness / resistance.mass);
  const double load = 0.2 * resistance.capacity;
  const double dt = 1e-4;
  EdgeMotion edge;
  for (int i = 1; i <= 10000; ++i) {
    edge = tilted(resistance, edge, load, 0, dt);
    const double expected = load / resistance.stiffness * (1 - std::cos(frequency * i * dt));
    ASSERT_NEAR(edge.deflection, expected, 1e-3 * load / resistance.stiffness) << i * dt;
  }
}

TEST(Tilting, TheMostAContactTransmitsMakesTheEdgeAsFastAsTheHullSlidesIt) {
  const TiltResistance resistance = tilt_resistance(half_metre(), {}, kArea, 1);
  const EdgeMotion edge{0.1, 0.05};
  const double most = most_vertical_force(resistance, edge, 0.4, 0.005);
  EXPECT_NEAR(tilted(resistance, edge, most, 0, 0.005).rate, 0.4, 1e-12);
  EXPECT_EQ(most_vertical_force(resistance, {0.1, 0.5}, 0.4, 0.005), resistance.at(0.1))
      << "an edge that is faster than the hull presses it down is held by its weight alone";
}

}  // namespace
}  // namespace polynya::fracture
