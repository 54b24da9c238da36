// Fast ice in scenes: what it reads as, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/scene/scene_reader.hpp"

namespace polynya::io {
namespace {

SceneOutcome read(const std::string& floe, const std::string& law) {
  const std::string text = fmt::format(
      R"({{"contact": {{"law": "{}"}}, "floes": [{{"rectangle": {{"corner_m": [0, 0], "size_m": 10}}, {}}}]}})",
      law, floe);
  return read_scene(text, "scene.json", ".");
}

TEST(FastIceScene, HoldsItsVelocityOverGround) {
  const auto moving = read(R"("fast_ice": true, "velocity_m_per_s": [0.1, -0.2])", "crush");
  ASSERT_TRUE(moving.has_value());
  ASSERT_EQ(moving->scene.floes.size(), 1u);
  EXPECT_TRUE(moving->scene.floes[0].is_fast);
  EXPECT_EQ(moving->scene.floes[0].velocity, (geometry::Vector{0.1, -0.2}));
  const auto free = read(R"("velocity_m_per_s": [0.1, -0.2])", "crush");
  ASSERT_TRUE(free.has_value());
  EXPECT_FALSE(free->scene.floes[0].is_fast);
}

TEST(FastIceScene, WhatItCannotDoIsRefusedAtItsPlace) {
  const auto turning = read(R"("fast_ice": true, "angular_velocity_deg_per_s": 3)", "crush");
  ASSERT_FALSE(turning.has_value());
  EXPECT_EQ(turning.error().front().path, "floes[0].angular_velocity_deg_per_s");
  EXPECT_NE(turning.error().front().allowed.find("does not turn"), std::string::npos);
  const auto rigid = read(R"("fast_ice": true)", "impulse");
  ASSERT_FALSE(rigid.has_value());
  EXPECT_EQ(rigid.error().front().path, "floes[0].fast_ice");
}

}  // namespace
}  // namespace polynya::io
