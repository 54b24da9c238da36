// What a valid scene is hinted at: with its place, its severity and its numbers, and never refused.
#include "scene_text.hpp"

namespace polynya::io {
namespace {

using namespace tests;

struct Change {
  const char* from;
  std::string to;
};

// Nothing to remark. One line each, so that a hint's line is its ship's.
std::string scene_with(const std::vector<Change>& changes) {
  std::string text =
      R"({"time": {"until_s": 100}, "ice": {"thickness_m": 0.5}, "water": {"drift_m_per_s": [0.1, 0]},
"ships": [
{"name": "first", "hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27}, "mass_kg": 1e7, )"
      R"("moment_of_inertia_kg_m2": 5e9, "position_m": [-100, 0], "heading_deg": 0, )"
      R"("propulsion": {"constant_speed_m_per_s": 2}},
{"name": "second", "hull": {"length_m": 60, "beam_m": 12, "entrance_angle_deg": 27}, "mass_kg": 1e6, )"
      R"("moment_of_inertia_kg_m2": 3e8, "position_m": [-100, 100], "heading_deg": 10, "speed_m_per_s": 1, )"
      R"("propulsion": {"thrust_N": 1e4}}],
"structures": [{"name": "pier", "radius_m": 5, "position_m": [50, -200]}],
"floes": [{"rectangle": {"corner_m": [80, -50], "size_m": [200, 200]}}]})";
  for (const Change& change : changes) {
    const std::size_t at = text.find(change.from);
    EXPECT_NE(at, std::string::npos) << change.from;
    text.replace(at, std::string(change.from).size(), change.to);
  }
  return text;
}

const Change kTurned{"\"heading_deg\": 0", "\"heading_deg\": 180"};

std::vector<Problem> hints_of(const std::vector<Change>& changes) {
  return load(scene_with(changes)).hints;
}

TEST(SceneHints, HaveAPlaceASeverityAndNumbers) {
  const auto warning = Severity::kWarning, hint = Severity::kHint;
  struct Expected {
    std::vector<Change> changes;
    Severity severity;
    int line;
    std::string path;
    std::vector<std::string> words;
  };
  const std::string step = "100, \"step_s\": ";
  const Change thrust{"\"thrust_N\": 1e4", "\"thrust_N\": 2e5"}, thin{"\"thickness_m\": 0.5", "\"thickness_m\": 0.001"};
  const Change thick{"\"thickness_m\": 0.5", "\"thickness_m\": 9"};
  const Expected trials[] = {
      {{{"1e4}", "1e4}, \"mooring\": {}"}},
       warning,
       4,
       "ships[1].mooring",
       {"holds nothing", "surge_stiffness_N_per_m"}},
      {{{"\"mass_kg\": 1e7", "\"mass_kg\": 1e4"}},
       warning,
       3,
       "ships[0].mass_kg",
       {"1e+04 kg", "120 × 24 m", "3.5e+06 to 4.1e+07 kg", "3 to 16 m", "0.4 to 0.9"}},
      {{{"\"mass_kg\": 1e6", "\"mass_kg\": 1e8"}}, warning, 4, "ships[1].mass_kg", {"1e+08 kg"}},
      {{kTurned}, warning, 3, "ships[0].heading_deg", {"away from all ice", "120 m behind"}},
      {{{"1e4}", "-1e4}"}, {"\"speed_m_per_s\": 1,", "\"speed_m_per_s\": 0,"}},
       warning,
       4,
       "ships[1].heading_deg",
       {"away from all ice"}},
      {{{"[50, -200]", "[50, 2]"}}, warning, 3, "ships[0].propulsion", {"meets pier", "after 42.7", "without a force"}},
      {{{R"({"rectangle": {"corner_m": [80, -50], "size_m": [200, 200]}})", ""}}, hint, 6, "floes", {"no ice"}},
      {{thick}, hint, 1, "ice.thickness_m", {"9 m", "4 m"}},
      {{thin, {"100}", step + "1e-5}"}}, hint, 1, "ice.thickness_m", {"0.001 m", "0.01 m"}},
      {{{"100}", step + "0.06, \"levels\": 0}"}},
       warning,
       1,
       "time.step_s",
       {"at 2 m/s", "0.12 m in a step", "0.15 of the ice's thickness of 0.5 m", "give 0.0375 s or less"}},
      {{{"100}", step + "0.025, \"levels\": 0}"}, {"\"thickness_m\": 0.5", "\"thickness_m\": 1"}},
       warning,
       1,
       "time.step_s",
       {"0.05 m in a step", "0.0375 m² over the ice's thickness of 1 m", "give 0.0187 s or less"}},
      {{{"100}", step + R"(0.02, "levels": 0}, "contact": {"circle_radius_m": 0.1})"}},
       warning,
       1,
       "time.step_s",
       {"0.04 m in a step", "0.25 of contact.circle_radius_m 0.1", "give 0.0125 s or less"}},
      {{{"100}", step + "0.06}"}, {"\"thickness_m\": 0.5", "\"thickness_m\": 0.01"}},
       warning,
       1,
       "time.step_s",
       {"at 2 m/s", "0.0037 m in a step", "0.15 of the ice's thickness of 0.01 m", "give 0.024 s or less"}},
      {{{"\"constant_speed_m_per_s\": 2", "\"constant_speed_m_per_s\": 18"}, {"100}", step + "0.002}"}},
       hint,
       3,
       "ships[0].propulsion",
       {"18 m/s (35 kn)", "12 m/s"}},
      {{thrust}, hint, 4, "ships[1].propulsion", {"21 m/s by 100 s"}},
      {{{"[0.1, 0]", "[0, 6]"}}, hint, 1, "water.drift_m_per_s", {"6 m/s", "3 m/s"}},
  };
  for (const Expected& trial : trials) {
    const std::vector<Problem> hints = hints_of(trial.changes);
    ASSERT_EQ(hints.size(), 1U) << trial.path;
    const std::string text = to_string(hints[0]);
    EXPECT_BEGINS(text, fmt::format("scene.json:{}:", trial.line));
    EXPECT_HAS(text, fmt::format(": {}: {}: ", name_of(trial.severity), trial.path));
    EXPECT_GT(hints[0].column, 0);
    for (const std::string& words : trial.words) EXPECT_HAS(text, words);
  }
}

/// Where a hint could be wrong there is none: the ice drifts after the ship, or moves by itself; the
/// structure stands beside the course, or after its end.
TEST(SceneHints, AreSilentWhereTheSceneMayMeanIt) {
  for (const std::vector<Change>& changes :
       std::initializer_list<std::vector<Change>>{{},
                                                  {{"[0.1, 0]", "[-2.5, 0]"}, kTurned},
                                                  {{"200]}}]", "200]}, \"velocity_m_per_s\": [-1, 0]}]"}, kTurned},
                                                  {{"[50, -200]", "[50, -18]"}},
                                                  {{"[50, -200]", "[200, 0]"}, {"[80, -50]", "[300, -50]"}}})
    EXPECT_EQ(in_words(hints_of(changes)), "");
}

}  // namespace
}  // namespace polynya::io
