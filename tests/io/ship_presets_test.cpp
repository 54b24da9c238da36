// Ships by name: their particulars fill what a scene does not give.
#include "io/scene/ship_presets.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/scene/scene_reader.hpp"

namespace polynya::io {
namespace {

SceneOutcome read(const std::string& ship) {
  return read_scene(fmt::format(R"({{"ships": [{{{}}}]}})", ship), "scene.json", ".");
}

TEST(ShipPresets, EachIsAShipWithASourceForEveryParticular) {
  ASSERT_GE(ship_presets().size(), 7u);
  for (const ShipPreset& preset : ship_presets()) {
    const bool has_engine = json_of(preset).find("propulsion") != nullptr;
    const auto scene = read(fmt::format(R"("ship": "{}"{})", preset.name,
                                        has_engine ? "" : R"(, "propulsion": {"thrust_N": 2e4})"));
    ASSERT_TRUE(scene.has_value()) << preset.name << ": " << to_string(scene.error().front());
    EXPECT_GT(scene->scene.ships[0].mass, 1e6) << preset.name;
    for (const Particular& particular : preset.particulars)
      EXPECT_FALSE(particular.source.empty()) << particular.path;
    const auto again = read_scene(scene->resolved_text, "scene.json", ".");
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(again->resolved_text, scene->resolved_text);
  }
}

TEST(ShipPresets, WhatASceneGivesStands) {
  const auto polaris = read(R"("ship": "polaris")");
  const auto deeper = read(R"("ship": "polaris", "hull": {"draught_m": 8.5}, "heading_deg": 30)");
  ASSERT_TRUE(polaris.has_value() && deeper.has_value());
  EXPECT_EQ(polaris->scene.ships[0].hull.draught, 8);
  EXPECT_EQ(deeper->scene.ships[0].hull.draught, 8.5);
  EXPECT_EQ(deeper->scene.ships[0].hull.waterline, polaris->scene.ships[0].hull.waterline);
  EXPECT_NEAR(polaris->scene.ships[0].mass, 10961e3, 5e3);
}

TEST(ShipPresets, AnotherKindOfPropulsionOrHullStandsInsteadOfThePresets) {
  const auto held =
      read(R"("ship": "oden", "propulsion": {"constant_speed_m_per_s": 2}, "steering": {"azimuth": {}})");
  ASSERT_FALSE(held.has_value()) << "thrusters without an engine";
  const auto free = read(R"("ship": "sawamura2017", "propulsion": {"constant_speed_m_per_s": 2},
      "hull": {"waterline_m": [[60, 0], [40, 10], [-60, 10], [-60, -10], [40, -10]]})");
  ASSERT_TRUE(free.has_value()) << to_string(free.error().front());
  EXPECT_EQ(free->scene.ships[0].hull.waterline.size(), 5u);
  EXPECT_TRUE(std::holds_alternative<simulation::ConstantSpeed>(free->scene.ships[0].propulsion));
}

TEST(ShipPresets, SteeringGivesWayWithTheEngine) {
  for (const char* drive : {R"("constant_speed_m_per_s": 2)", R"("thrust_N": 1e5)"}) {
    const auto ship = read(fmt::format(R"("ship": "reference", "propulsion": {{{}}})", drive));
    ASSERT_TRUE(ship.has_value()) << to_string(ship.error().front());
    EXPECT_TRUE(std::holds_alternative<simulation::NoSteering>(ship->scene.ships[0].steering));
  }
}

TEST(ShipPresets, AnUnknownOneIsRefusedWithTheNearest) {
  const auto wrong = read(R"("ship": "polarys")");
  ASSERT_FALSE(wrong.has_value());
  EXPECT_EQ(wrong.error().size(), 1u);
  EXPECT_EQ(wrong.error().front().path, "ships[0].ship");
  EXPECT_NE(to_string(wrong.error().front()).find("polaris"), std::string::npos);
}

}  // namespace
}  // namespace polynya::io
