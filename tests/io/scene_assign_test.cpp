// Values in place of the scene's own, by their paths (polynya run --set, polynya validate --cases).
#include <gtest/gtest.h>

#include "io/scene/scene_reader.hpp"

namespace polynya::io {
namespace {

constexpr auto kScene = R"({
  "time": {"until_s": 10},
  "ice": {"thickness_m": 0.5},
  "floes": [{"rectangle": {"corner_m": [0, 0], "size_m": 10}}]
})";

SceneOutcome with(const std::vector<std::string>& words) {
  SceneOverrides overrides;
  for (const std::string& each : words) overrides.assignments.push_back(parse_assignment(each).value());
  return read_scene(kScene, "scene.json", ".", overrides);
}

std::string first_problem(const std::vector<std::string>& words) {
  const auto outcome = with(words);
  return outcome ? "none" : to_string(outcome.error().front());
}

TEST(SceneAssign, PutsValuesOfEveryKindWhereTheirPathsLead) {
  const auto outcome =
      with({"ice.thickness_m=0.7", "floes[0].rectangle.corner_m[1]=5", "water.drift_m_per_s=[1,2]",
            "name=of-no-quotes", "fracture.bending.radial_cracks=\"ignored\"", "seed=7"});
  ASSERT_TRUE(outcome) << to_string(outcome.error().front());
  EXPECT_EQ(outcome->scene.ice.thickness, 0.7);
  EXPECT_EQ(outcome->scene.floes.at(0).polygon_in_world.outer.front().y, 5);
  EXPECT_EQ(outcome->scene.water.drift.y, 2);
  EXPECT_EQ(outcome->scene.name, "of-no-quotes");
  EXPECT_EQ(outcome->scene.seed, 7U);
}

/// Setting a key is as writing it into the scene.
TEST(SceneAssign, GivesTheSceneThatSaysTheSame) {
  std::string written = kScene;
  written.replace(written.find("0.5"), 3, "0.8");
  const auto same = read_scene(written, "scene.json", ".");
  const auto set = with({"ice.thickness_m=0.8"});
  ASSERT_TRUE(same && set);
  EXPECT_EQ(set->resolved_text, same->resolved_text);
  EXPECT_EQ(set->hash, same->hash);
}

TEST(SceneAssign, NamesTheOptionAndTheKeyOfWhatIsWrong) {
  EXPECT_EQ(first_problem({"ice.thickness_m=-1"}),
            "--set ice.thickness_m=-1: ice.thickness_m: found -1, allowed: a number ≥ 0.001, ≤ 20 [m]");
  EXPECT_NE(first_problem({"ice.thicknes_m=1"})
                .find("--set ice.thicknes_m=1: ice.thicknes_m: found an unknown key"),
            std::string::npos);
  EXPECT_NE(first_problem({"ice.thicknes_m=1"}).find("did you mean \"thickness_m\"?"), std::string::npos);
  EXPECT_EQ(first_problem({"floes[1].rectangle.size_m=3"}),
            "--set floes[1].rectangle.size_m=3: floes[1]: found a list of 1, allowed: an index from 0 to 0");
  EXPECT_EQ(first_problem({"ships[0].mass_kg=3"}),
            "--set ships[0].mass_kg=3: ships: found nothing, allowed: a list that the scene has");
  EXPECT_EQ(first_problem({"ice.thickness_m.x=3"}),
            "--set ice.thickness_m.x=3: ice.thickness_m: found 0.5, allowed: an object, to have \"x\"");
  for (const char* no_path : {"a..b=1", "a[=1", "a[x]=1", "[0]=1", "a]=1"})
    EXPECT_NE(first_problem({no_path}), "none") << no_path;
  EXPECT_FALSE(parse_assignment("no-value"));
  EXPECT_FALSE(parse_assignment("=3"));
}

/// Of two options, the problem of the second is the second's; what the scene itself has stays the scene's.
TEST(SceneAssign, KeepsThePlacesOfSceneAndOptionsApart) {
  SceneOverrides overrides;
  for (const char* words : {"seed=1", "ice.friction=nine"})
    overrides.assignments.push_back(parse_assignment(words).value());
  const auto outcome = read_scene("{\n  \"ice\": {\"thickness_m\": -1}\n}", "scene.json", ".", overrides);
  ASSERT_FALSE(outcome);
  ASSERT_EQ(outcome.error().size(), 2U);
  EXPECT_EQ(to_string(outcome.error()[0]).find("scene.json:2:26: ice.thickness_m"), 0U);
  EXPECT_EQ(to_string(outcome.error()[1]).find("--set ice.friction=nine: ice.friction"), 0U);
}

TEST(SceneAssign, CasesHaveLineAndColumn) {
  SceneOverrides overrides;
  overrides.assignments = parse_case(R"({"seed": 2, "ice.thickness_m": -1})", "cases.ndjson", 17).value();
  const auto outcome = read_scene(kScene, "scene.json", ".", overrides);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(to_string(outcome.error().front()).find("cases.ndjson:17:32: ice.thickness_m: found -1"), 0U);
  EXPECT_EQ(to_string(parse_case("[1]", "cases.ndjson", 3).error()),
            "cases.ndjson:3:1: found a list of 1, allowed: an object of paths and values");
  EXPECT_FALSE(parse_case("{\"a\": }", "cases.ndjson", 3));
}

}  // namespace
}  // namespace polynya::io
