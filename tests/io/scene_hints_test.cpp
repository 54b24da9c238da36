// What a valid scene is hinted at: with its place, its severity and its numbers, and never refused.
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/scene/scene_reader.hpp"

namespace polynya::io {
namespace {

struct Change {
  const char* from;
  std::string to;
};

// Nothing to remark. One line each, so that a hint's line is its ship's.
std::string scene_with(const std::vector<Change>& changes) {
  std::string text =
      R"({"time": {"until_s": 100}, "ice": {"thickness_m": 0.5}, "water": {"drift_m_per_s": [0.1, 0]},
"ships": [
{"name": "first", "hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27}, "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9, "position_m": [-100, 0], "heading_deg": 0, "propulsion": {"constant_speed_m_per_s": 2}},
{"name": "second", "hull": {"length_m": 60, "beam_m": 12, "entrance_angle_deg": 27}, "mass_kg": 1e6, "moment_of_inertia_kg_m2": 3e8, "position_m": [-100, 100], "heading_deg": 10, "speed_m_per_s": 1, "propulsion": {"thrust_N": 1e4}}],
"structures": [{"name": "pier", "radius_m": 5, "position_m": [50, -200]}],
"floes": [{"rectangle": {"corner_m": [80, -50], "size_m": [200, 200]}}]})";
  for (const Change& change : changes) {
    const std::size_t at = text.find(change.from);
    EXPECT_NE(at, std::string::npos) << change.from;
    text.replace(at, std::string(change.from).size(), change.to);
  }
  return text;
}

std::vector<Problem> hints_of(const std::string& text) {
  auto scene = read_scene(text, "scene.json", ".");
  EXPECT_TRUE(scene.has_value()) << to_string(scene.error().front());
  return scene ? scene->hints : std::vector<Problem>{};
}

TEST(SceneHints, APlausibleSceneHasNone) {
  EXPECT_TRUE(hints_of(scene_with({})).empty()) << to_string(hints_of(scene_with({})).front());
}

TEST(SceneHints, ShippedScenesHaveNone) {
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(POLYNYA_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() != ".json") continue;
    const auto scene = read_scene_file(entry.path());
    ASSERT_TRUE(scene.has_value()) << entry.path();
    EXPECT_TRUE(scene->hints.empty()) << to_string(scene->hints.front());
  }
}

TEST(SceneHints, HaveAPlaceASeverityAndNumbers) {
  struct Expected {
    std::vector<Change> changes;
    Severity severity;
    int line;
    std::string path;
    std::vector<std::string> words;
  };
  const Expected trials[] = {
      {{{"\"thrust_N\": 1e4}", "\"thrust_N\": 1e4}, \"mooring\": {}"}},
       Severity::kWarning,
       4,
       "ships[1].mooring",
       {"holds nothing", "surge_stiffness_N_per_m"}},
      {{{"\"mass_kg\": 1e7", "\"mass_kg\": 1e4"}},
       Severity::kWarning,
       3,
       "ships[0].mass_kg",
       {"1e+04 kg", "120 × 24 m", "3.5e+06 to 4.1e+07 kg", "3 to 16 m", "0.4 to 0.9"}},
      {{{"\"mass_kg\": 1e6", "\"mass_kg\": 1e8"}}, Severity::kWarning, 4, "ships[1].mass_kg", {"1e+08 kg"}},
      {{{"\"heading_deg\": 0", "\"heading_deg\": 180"}},
       Severity::kWarning,
       3,
       "ships[0].heading_deg",
       {"away from all ice", "120 m behind"}},
      {{{"1e4}", "-1e4}"}, {"\"speed_m_per_s\": 1,", "\"speed_m_per_s\": 0,"}},
       Severity::kWarning,
       4,
       "ships[1].heading_deg",
       {"away from all ice"}},
      {{{"[50, -200]", "[50, 2]"}},
       Severity::kWarning,
       3,
       "ships[0].propulsion",
       {"meets pier", "after 42.7", "without a force"}},
      {{{R"({"rectangle": {"corner_m": [80, -50], "size_m": [200, 200]}})", ""}},
       Severity::kHint,
       6,
       "floes",
       {"no ice"}},
      {{{"\"thickness_m\": 0.5", "\"thickness_m\": 9"}},
       Severity::kHint,
       1,
       "ice.thickness_m",
       {"9 m", "4 m"}},
      {{{"\"thickness_m\": 0.5", "\"thickness_m\": 0.001"}, {"100}", "100, \"step_s\": 1e-5}"}},
       Severity::kHint,
       1,
       "ice.thickness_m",
       {"0.001 m", "0.01 m"}},
      {{{"100}", "100, \"step_s\": 0.03}"}},
       Severity::kWarning,
       1,
       "time.step_s",
       {"at 2 m/s", "0.06 m in a step", "0.1 of the ice's thickness of 0.5 m", "give 0.025 s or less"}},
      {{{"100}", R"(100, "step_s": 0.02}, "contact": {"circle_radius_m": 0.1})"}},
       Severity::kWarning,
       1,
       "time.step_s",
       {"0.04 m in a step", "0.25 of contact.circle_radius_m 0.1", "give 0.0125 s or less"}},
      {{{"\"constant_speed_m_per_s\": 2", "\"constant_speed_m_per_s\": 18"},
        {"100}", "100, \"step_s\": 0.002}"}},
       Severity::kHint,
       3,
       "ships[0].propulsion",
       {"18 m/s (35 kn)", "12 m/s"}},
      {{{"\"thrust_N\": 1e4", "\"thrust_N\": 2e5"}},
       Severity::kHint,
       4,
       "ships[1].propulsion",
       {"21 m/s by 100 s"}},
      {{{"[0.1, 0]", "[0, 6]"}}, Severity::kHint, 1, "water.drift_m_per_s", {"6 m/s", "3 m/s"}},
      {{{"200]}}]", "200]}, \"velocity_m_per_s\": [0, 8]}]"}}, Severity::kHint, 6, "floes[0]", {"8 m/s"}},
  };
  for (const Expected& trial : trials) {
    const std::vector<Problem> hints = hints_of(scene_with(trial.changes));
    ASSERT_EQ(hints.size(), 1U) << trial.path;
    EXPECT_EQ(hints[0].path, trial.path);
    EXPECT_EQ(hints[0].line, trial.line) << to_string(hints[0]);
    EXPECT_GT(hints[0].column, 0);
    EXPECT_EQ(hints[0].severity, trial.severity) << to_string(hints[0]);
    const std::string text = to_string(hints[0]);
    EXPECT_NE(text.find(trial.severity == Severity::kHint ? ": hint: " : ": warning: "), std::string::npos);
    for (const std::string& words : trial.words) EXPECT_NE(text.find(words), std::string::npos) << text;
  }
}

// Where a hint could be wrong there is none.
TEST(SceneHints, AreSilentWhereTheSceneMayMeanIt) {
  // The ice drifts after the ship, or moves by itself; the structure stands beside the course, or after its
  // end.
  EXPECT_TRUE(
      hints_of(scene_with({{"[0.1, 0]", "[-2.5, 0]"}, {"\"heading_deg\": 0", "\"heading_deg\": 180"}}))
          .empty());
  EXPECT_TRUE(hints_of(scene_with({{"200]}}]", "200]}, \"velocity_m_per_s\": [-1, 0]}]"},
                                   {"\"heading_deg\": 0", "\"heading_deg\": 180"}}))
                  .empty());
  EXPECT_TRUE(hints_of(scene_with({{"[50, -200]", "[50, -18]"}})).empty());
  EXPECT_TRUE(hints_of(scene_with({{"[50, -200]", "[200, 0]"}, {"[80, -50]", "[300, -50]"}})).empty());
}

}  // namespace
}  // namespace polynya::io
