// The keys of ice under hulls: what follows from a draught, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/scene/scene_reader.hpp"

namespace polynya::io {
namespace {

using simulation::CuspFate;

SceneOutcome read(const std::string& hull, const std::string& fracture) {
  const std::string text = fmt::format(
      R"({{"fracture": {{{}}}, "ships": [{{"hull": {{"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27{}}},
          "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9, "propulsion": {{"thrust_N": 2e4}}}}]}})",
      fracture, hull);
  return read_scene(text, "scene.json", ".");
}

TEST(UnderHullScene, AFateFollowsFromADraughtUnlessTheSceneStatesIt) {
  const auto with = read(R"(, "draught_m": 6)", "");
  ASSERT_TRUE(with.has_value());
  EXPECT_EQ(with->scene.fracture.cusp_fate, CuspFate::kUnderHull);
  EXPECT_TRUE(with->scene.fracture.going_under.is_enabled);
  EXPECT_TRUE(with->scene.fracture.resurface.is_enabled);
  EXPECT_EQ(with->scene.ships[0].hull.draught, 6);

  const auto without = read("", "");
  ASSERT_TRUE(without.has_value());
  EXPECT_EQ(without->scene.fracture.cusp_fate, CuspFate::kSubmerge);
  EXPECT_FALSE(without->scene.fracture.going_under.is_enabled);
  EXPECT_FALSE(without->scene.fracture.resurface.is_enabled);

  const auto stated =
      read(R"(, "draught_m": 6)", R"("cusp_fate": "submerge", "going_under": {"enabled": false})");
  ASSERT_TRUE(stated.has_value());
  EXPECT_EQ(stated->scene.fracture.cusp_fate, CuspFate::kSubmerge);
  EXPECT_FALSE(stated->scene.fracture.resurface.is_enabled) << "nothing goes under";
  const auto again = read_scene(stated->resolved_text, "scene.json", ".");
  ASSERT_TRUE(again.has_value()) << "what is filled in is a scene too";
  EXPECT_EQ(again->resolved_text, stated->resolved_text);
}

TEST(UnderHullScene, WhatCannotBeIsRefusedAtItsPlace) {
  struct Case {
    std::string hull, fracture, path, found;
  };
  const std::string draught = R"(, "draught_m": 6)";
  for (const Case& c : {
           Case{R"(, "draught_m": -1)", "", "ships[0].hull.draught_m", "-1"},
           Case{R"(, "draught_m": 0)", "", "ships[0].hull.draught_m", "0"},
           Case{R"(, "draught_m": 121)", "", "ships[0].hull.draught_m", "121"},
           Case{"", R"("cusp_fate": "under_hull")", "fracture.cusp_fate", "under_hull without a hull"},
           Case{"", R"("going_under": {"enabled": true})", "fracture.going_under.enabled", "true without"},
           Case{"", R"("resurface": {"enabled": true})", "fracture.resurface.enabled", "no ice goes under"},
           Case{draught,
                R"("cusp_fate": "float", "going_under": {"enabled": false}, "resurface": {"enabled": true})",
                "fracture.resurface.enabled", "no ice goes under"},
           Case{draught, R"("resurface": {"rim_loss": 1})", "fracture.resurface.rim_loss", "1"},
           Case{draught, R"("going_under": {"enabled": "yes"})", "fracture.going_under.enabled", "\"yes\""},
           Case{R"(, "submersion_speed_factor": "riska")", "", "ships[0].hull.submersion_speed_factor",
                "riska"},
       }) {
    const auto outcome = read(c.hull, c.fracture);
    ASSERT_FALSE(outcome.has_value()) << c.hull << c.fracture;
    ASSERT_EQ(outcome.error().size(), 1U) << c.hull << c.fracture;
    EXPECT_EQ(outcome.error()[0].path, c.path);
    EXPECT_NE(outcome.error()[0].found.find(c.found), std::string::npos) << outcome.error()[0].found;
  }
}

}  // namespace
}  // namespace polynya::io
