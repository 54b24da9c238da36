// Walls and wind in scenes: what they read as, and what is refused.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/scene/scene_reader.hpp"

namespace polynya::io {
namespace {

SceneOutcome read(const std::string& keys) {
  const std::string text =
      fmt::format(R"({{{}, "floes": [{{"rectangle": {{"corner_m": [0, 0], "size_m": 10}}}}]}})", keys);
  return read_scene(text, "scene.json", ".");
}

/// The one problem of a scene.
Problem problem_of(const std::string& keys) {
  const auto outcome = read(keys);
  if (outcome) {
    ADD_FAILURE() << keys << " is accepted";
    return {};
  }
  EXPECT_EQ(outcome.error().size(), 1u);
  return outcome.error().front();
}

std::string wall(const std::string& more) {
  return R"("walls": [{"from_m": [-50, -1], "to_m": [50, -1])" + more + "}]";
}

TEST(WallScene, ReadsWallsWithTheIceToTheirLeft) {
  const auto loaded =
      read(R"("walls": [{"from_m": [-50, -1], "to_m": [50, -1], "velocity_m_per_s": [0.1, 0.2]},
    {"name": "north", "from_m": [50, 20], "to_m": [-50, 20], "depth_m": 3, "pressure": {"line_load_N_per_m": 5e4}}])");
  ASSERT_TRUE(loaded.has_value());
  ASSERT_EQ(loaded->scene.walls.size(), 2u);
  EXPECT_TRUE(loaded->hints.empty());
  const simulation::Wall& south = loaded->scene.walls[0];
  EXPECT_EQ(south.name, "wall-1");
  EXPECT_EQ(south.position_in_world, (geometry::Point{0, -1}));
  EXPECT_NEAR(std::sin(south.heading), 1, 1e-15) << "its face looks along +y";
  EXPECT_EQ(south.velocity, (geometry::Vector{0.1, 0.2}));
  EXPECT_FALSE(south.pressure);
  const simulation::Wall& north = loaded->scene.walls[1];
  EXPECT_EQ(north.name, "north");
  EXPECT_NEAR(std::sin(north.heading), -1, 1e-15);
  ASSERT_TRUE(north.pressure);
  EXPECT_EQ(north.load(), 5e6);
  EXPECT_EQ(north.pressure->mass_per_length, 4.5e5);
  const auto box = bounding_box(north.hull.waterline);
  EXPECT_EQ(box.low.x, -3);
  EXPECT_EQ(box.high.x, 0);
}

TEST(WallScene, WhatCannotBeIsRefusedAtItsPlace) {
  const std::string load = R"("pressure": {"line_load_N_per_m": 5e4})";
  EXPECT_EQ(problem_of(wall(R"(, "velocity_m_per_s": [0, 1], )" + load)).path, "walls[0].velocity_m_per_s");
  EXPECT_EQ(problem_of(R"("contact": {"law": "impulse"}, )" + wall(", " + load)).path, "walls[0].pressure");
  const Problem strong = problem_of(wall(R"(, "pressure": {"line_load_N_per_m": 2e6})"));
  EXPECT_EQ(strong.path, "walls[0].pressure.line_load_N_per_m");
  EXPECT_NE(strong.allowed.find("1.4e+06"), std::string::npos) << strong.allowed;
  const Problem light = problem_of(wall(R"(, "pressure": {"line_load_N_per_m": 1e5, "mass_kg_per_m": 4e3})"));
  EXPECT_EQ(light.path, "walls[0].pressure.mass_kg_per_m");
  EXPECT_NE(light.allowed.find("at least 5000"), std::string::npos) << light.allowed;
  const Problem point = problem_of(R"("walls": [{"from_m": [50, 50], "to_m": [50, 50.01]}])");
  EXPECT_EQ(point.path, "walls[0].to_m");
  const Problem ice = problem_of(R"("walls": [{"from_m": [-50, 2], "to_m": [50, 2]}])");
  EXPECT_EQ(ice.path, "floes[0]");
  EXPECT_NE(ice.found.find("an overlap with walls[0], 20 m² shared"), std::string::npos) << ice.found;
  EXPECT_EQ(ice.allowed, "floes in front of the wall");
  const Problem pier = problem_of(
      R"("ships": [{"hull": {"length_m": 100, "beam_m": 20, "entrance_angle_deg": 27}, "mass_kg": 5e6,
      "moment_of_inertia_kg_m2": 1e9, "position_m": [0, 100], "propulsion": {"thrust_N": 1}}],
      "walls": [{"from_m": [-90, 95], "to_m": [90, 95]}])");
  EXPECT_EQ(pier.path, "walls[0]");
  EXPECT_NE(pier.found.find("an overlap with ships[0]"), std::string::npos) << pier.found;
  EXPECT_NE(pier.allowed.find("clear of it"), std::string::npos) << pier.allowed;
}

TEST(WallScene, WallsMayCrossAndOneThatTurnsItsBackIsPointedOut) {
  const auto basin =
      read(R"("walls": [{"from_m": [-50, -1], "to_m": [50, -1]}, {"from_m": [-1, 50], "to_m": [-1, -50]}])");
  ASSERT_TRUE(basin.has_value());
  EXPECT_TRUE(basin->hints.empty());
  const auto back = read(R"("walls": [{"from_m": [50, -1], "to_m": [-50, -1], "depth_m": 0.5}])");
  ASSERT_TRUE(back.has_value());
  ASSERT_EQ(back->hints.size(), 1u);
  EXPECT_EQ(back->hints.front().path, "walls[0].to_m");
  EXPECT_NE(back->hints.front().sentence.find("exchange"), std::string::npos);
}

TEST(WindScene, HasSkinDragOfItsOwnUnlessGiven) {
  EXPECT_EQ(read(R"("wind": {"drag_coefficient": 0.003})")->scene.water.skin_drag_coefficient, 0);
  EXPECT_EQ(read(R"("wind": {"velocity_m_per_s": [0, 10]})")->scene.water.skin_drag_coefficient, 0.004);
  const auto own =
      read(R"("wind": {"velocity_m_per_s": [0, 10]}, "water": {"skin_drag_coefficient": 0.005})");
  EXPECT_EQ(own->scene.water.skin_drag_coefficient, 0.005);
  const auto none = read(R"("wind": {"velocity_m_per_s": [0, 10]}, "water": {"skin_drag_coefficient": 0})");
  ASSERT_EQ(none->hints.size(), 1u);
  EXPECT_EQ(none->hints.front().path, "water.skin_drag_coefficient");
  const auto again = read_scene(own->resolved_text, "again.json", ".");
  EXPECT_EQ(again->hash, own->hash);
}

}  // namespace
}  // namespace polynya::io
