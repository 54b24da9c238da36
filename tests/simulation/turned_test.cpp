// Scenes that are turned as a whole. The results must not depend on the axes.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

constexpr double kTurns[] = {10 * kDegree, 30 * kDegree, 45 * kDegree, 71 * kDegree, 90 * kDegree, 127 * kDegree};

geometry::Polygon turned(const geometry::Polygon& polygon, double turn) {
  return transform(geometry::Pose{{}, geometry::Rotation::by(turn)}, polygon);
}

Ship turned(Ship ship, double turn) {
  ship.position_in_world = transform(geometry::Pose{{}, geometry::Rotation::by(turn)}, ship.position_in_world);
  ship.heading += turn;
  return ship;
}

/// The reference ship at 1 m/s into a plate whose edge lies askew by `slant`, all turned.
Scene into_level_ice(double turn, double slant = 0.02) {
  const geometry::Polygon plate{{{-75 * slant, -75}, {300, -75}, {300, 75}, {75 * slant, 75}}, {}};
  return Build()
      .without_splits()
      .step(0.025)
      .ship(turned(icebreaker({-4, 0}, ConstantSpeed{1}), turn))
      .floe(fast(turned(plate, turn)));
}

/// Until rounding errors have grown, every cusp has the same time, place, load and shape.
TEST(TurnedScene, BreaksTheSameCusps) {
  constexpr double kUntil = 14;  // [s]
  const std::vector<Event> straight = run(into_level_ice(0), kUntil).story.bends();
  ASSERT_GT(straight.size(), 4u);
  for (const double turn : kTurns) {
    SCOPED_TRACE(testing::Message() << turn / kDegree << " deg");
    const std::vector<Event> found = run(into_level_ice(turn), kUntil).story.bends();
    ASSERT_EQ(found.size(), straight.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Bend &one = std::get<Bend>(straight[i].what), &other = std::get<Bend>(found[i].what);
      EXPECT_NEAR(found[i].time, straight[i].time, 1e-9);
      EXPECT_NEAR(other.criterion.bending_capacity / one.criterion.bending_capacity, 1, 1e-6) << i;
      EXPECT_NEAR(other.cusp_radius / one.cusp_radius, 1, 1e-6) << i;
      EXPECT_NEAR(other.submerged_area / one.submerged_area, 1, 1e-6) << i << ": the cusp's polygon turns with it";
      const geometry::Vector normal = rotate_back(geometry::Rotation::by(turn), other.normal_in_world);
      EXPECT_NEAR(length(normal - one.normal_in_world), 0, 1e-6) << i;
    }
  }
}

/// Loads of a run are one draw of many, whose order after the first cusps is another at each turn: their mean is not.
/// No turn makes loads that the bending model does not hold for.
TEST(TurnedScene, HasTheSameMeanLoad) {
  struct Loads {
    double sum = 0, squares = 0;
    int count = 0;
    double mean() const { return sum / count; }
    double error() const { return std::sqrt((squares / count - mean() * mean()) / (count - 1)); }
  };
  Loads straight, askew;
  for (int i = 0; i < 18; ++i) {
    for (const bool is_turned : {false, true}) {
      const double turn = is_turned ? kTurns[i % 6] : 0;
      const Trial done = run(into_level_ice(turn, 0.002 * (i - 9.5)), 60);
      EXPECT_LE(done.simulation.counts().database_out_of_range, 2) << turn;
      const double load = -mean(done.story, &HullSample::from_ice, 0, 25);
      Loads& loads = is_turned ? askew : straight;
      loads.sum += load, loads.squares += load * load, ++loads.count;
    }
  }
  const double error = std::hypot(straight.error(), askew.error());
  EXPECT_LT(error, 0.03 * straight.mean()) << "else it says nothing";
  EXPECT_NEAR(askew.mean(), straight.mean(), 3 * error);
}

}  // namespace
}  // namespace polynya::simulation
