// Fields by a size law in scenes: what they read as, and what is refused with what would do.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/scene/scene_reader.hpp"

namespace polynya::io {
namespace {

SceneOutcome read(const std::string& field) {
  return read_scene(fmt::format(R"({{"floes": [{{"field": {{{}}}}}]}})", field), "scene.json", ".");
}

const std::string kSquare = R"("corner_m": [0, 0], "extent_m": 300, )";

TEST(FieldScene, HasTheLawAndItsStatistics) {
  const auto loaded =
      read(kSquare + R"("concentration": 0.9, "sizes": {"exponent": 1.87, "least_m": 10, "largest_m": 60})");
  ASSERT_TRUE(loaded.has_value());
  ASSERT_EQ(loaded->fields.size(), 1u);
  const auto& outcome = loaded->fields[0].outcome;
  EXPECT_EQ(outcome.count, static_cast<int>(loaded->scene.floes.size()));
  EXPECT_NEAR(outcome.concentration(), 0.9, 1e-6);
  ASSERT_TRUE(outcome.statistics.has_value());
  EXPECT_LT(outcome.statistics->distance_to_law, 0.03);
  // What is resolved reads back to the same scene.
  const auto again = read_scene(loaded->resolved_text, "scene.json", ".");
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->resolved_text, loaded->resolved_text);
  ASSERT_EQ(again->scene.floes.size(), loaded->scene.floes.size());
  EXPECT_EQ(again->scene.floes.back().polygon_in_world, loaded->scene.floes.back().polygon_in_world);
}

TEST(FieldScene, AFieldOfOneSizeKeepsItsDefaultsInTheResolvedScene) {
  const auto loaded = read(kSquare + R"("concentration": 0.5, "floe_size_m": 15)");
  ASSERT_TRUE(loaded.has_value());
  EXPECT_NE(loaded->resolved_text.find("\"size_spread\": 0.25"), std::string::npos);
  EXPECT_NE(loaded->resolved_text.find("\"most_corners\": 8"), std::string::npos);
  EXPECT_EQ(loaded->resolved_text.find("packing"), std::string::npos);
}

TEST(FieldScene, AChannelIsFilledAlongItsBends) {
  const auto loaded =
      read(R"("centreline_m": [[0, 0], [60, 0], [100, 40]], "width_m": 12, "concentration": 0.8,
                              "gap_m": 0.01, "sizes": {"exponent": 0, "least_m": 0.5, "largest_m": 2})");
  ASSERT_TRUE(loaded.has_value());
  const auto& outcome = loaded->fields[0].outcome;
  EXPECT_NEAR(outcome.region_area, 12 * (60 + 40 * std::sqrt(2.0)), 1e-6)
      << "mitres add on one side what they take on the other";
  EXPECT_NEAR(outcome.concentration(), 0.8, 1e-6);
  EXPECT_GT(outcome.count, 700);
  EXPECT_LT(outcome.statistics->distance_to_law, 0.01);
}

TEST(FieldScene, WhatCannotBeIsRefusedWithItsPlaceAndWhatWouldDo) {
  struct Case {
    std::string field;
    std::string path;
    std::string found_or_allowed;
  };
  const std::string power =
      R"("concentration": 0.9, "sizes": {"exponent": 1.87, "least_m": 10, "largest_m": )";
  const std::string equal = R"("sizes": {"size_m": 15}, )";
  for (const auto& [field, path, words] : {
           Case{kSquare + power + "5}", ".sizes.least_m", "less than 5"},
           Case{kSquare + power + "4000}", ".sizes.largest_m", "at most 300, or a wider region"},
           Case{kSquare + equal + R"("concentration": 0.98, "gap_m": 0.5)", ".concentration",
                "or a gap_m of at most"},
           Case{kSquare + equal + R"("concentration": 0.98, "most_corners": 4)", ".concentration",
                "or most_corners above 4"},
           Case{kSquare + equal + R"("concentration": 0.8, "packing": 0.5)", ".packing", "at least 0.8"},
           Case{kSquare + equal + R"("concentration": 0.8, "least_corners": 20)", ".least_corners",
                "at most 16"},
           Case{kSquare + equal + R"("concentration": 0.8, "orientation_deg": 20)", ".orientation_deg",
                "without aspect"},
           Case{kSquare + equal + R"("concentration": 0.8, "size_spread": 0.1)", ".size_spread",
                "mean_m and spread"},
           Case{kSquare + equal + R"("concentration": 0.8, "floe_size_m": 10)", ".sizes",
                "beside floe_size_m"},
           Case{kSquare + R"("concentration": 0.8)", "", "neither sizes nor floe_size_m"},
           Case{kSquare + R"("concentration": 0.8, "floe_size_m": 10, "aspect": 2)", ".aspect",
                "sizes instead"},
           Case{kSquare + R"("concentration": 0.005, "sizes": {"size_m": 100})", "", "less than one floe"},
           Case{kSquare + equal +
                    R"("concentration": 0.8, "keep_clear_m": [[[-9, -9], [400, -9], [400, 400], [-9, 400]]])",
                "", "all of the region is kept clear"},
           Case{R"("centreline_m": [[0, 0], [60, 0], [0, 9]], "width_m": 12, "concentration": 0.8, )" + equal,
                ".centreline_m", "too sharp"},
           Case{R"("centreline_m": [[0, 0], [0, 0]], "width_m": 12, "concentration": 0.8, )" + equal,
                ".centreline_m", "a second time"},
           Case{R"("centreline_m": [[0, 0], [900, 0]], "width_m": 12, "concentration": 0.8, )" + equal,
                ".sizes", "12 m across"},
       }) {
    std::string text = field;
    if (text.ends_with(", ")) text.resize(text.size() - 2);
    const auto refused = read(text);
    ASSERT_FALSE(refused.has_value()) << text;
    const Problem& problem = refused.error().front();
    EXPECT_EQ(problem.path, "floes[0].field" + path) << to_string(problem);
    EXPECT_NE((problem.found + " " + problem.allowed).find(words), std::string::npos) << to_string(problem);
    EXPECT_GT(problem.line, 0) << to_string(problem);
  }
}

}  // namespace
}  // namespace polynya::io
