#include <cmath>

#include "expect_text.hpp"

#include "io/text/cut.hpp"

namespace polynya::io {
namespace {

TEST(CutOps, AListIsReadInOrder) {
  const auto ops = tests::checked(read_cut_ops(R"json([
    {"disc": [1, 2, 3]}, // comments are allowed
    {"disc": [1, 2, 3], "sagitta_m": 0.5, "keep": "both"},
    {"crack": [0, 1, 30]},
    {"line": [0, 1, 2, 3], "must_cut": true},
    {"line": [[0, 1], [2, 3], [4, 0]]},
    {"polygon": {"type": "MultiPolygon", "coordinates": [[[[0,0],[0,4],[4,4],[4,0]], [[1,1],[1,2],[2,1]]],
        [[[9,0],[10,0],[9,1]]]]},
     "keep": "inside"},
    {"polygon": "POLYGON ((0 0, 0 1, 1 0, 0 0))"}])json",
                                               {Keep::kOutside, 0.1}));
  ASSERT_EQ(ops->size(), 7U);
  EXPECT_EQ(std::get<DiscTool>((*ops)[0].tool).sagitta, 0.1);
  EXPECT_EQ(std::get<DiscTool>((*ops)[1].tool).sagitta, 0.5);
  EXPECT_EQ((*ops)[1].keep, Keep::kBoth);
  EXPECT_EQ((*ops)[2].keep, Keep::kOutside);
  EXPECT_FALSE((*ops)[2].must_cut);
  EXPECT_TRUE((*ops)[3].must_cut);
  EXPECT_EQ(std::get<CrackTool>((*ops)[2].tool).angle_deg, 30);
  EXPECT_EQ(std::get<LineTool>((*ops)[3].tool).path, (std::vector<geometry::Point>{{0, 1}, {2, 3}}));
  EXPECT_EQ(std::get<LineTool>((*ops)[4].tool).path.size(), 3U);
  const auto& polygons = std::get<PolygonTool>((*ops)[5].tool).polygons;
  ASSERT_EQ(polygons.size(), 2U);
  EXPECT_EQ(polygons[0].outer.size(), 4U);
  EXPECT_EQ(polygons[0].holes.size(), 1U);
  EXPECT_EQ((*ops)[5].keep, Keep::kInside);
}

TEST(CutOps, WhatIsWrongIsToldWithItsNumber) {
  using Kind = ToolError::Kind;
  for (const auto& [text, words, kind] : std::initializer_list<std::tuple<std::string, std::string, Kind>>{
           {"{}", "a list", Kind::kMalformed},
           {"[]", "empty", Kind::kMalformed},
           {R"([{"disc": [1,2,3]}, 5])", "[1]: expected an object", Kind::kMalformed},
           {R"([{"disc": [1,2]}])", "[0]: disc: expected [x, y, radius]", Kind::kMalformed},
           {R"([{"disc": [1,2,0]}])", "[0]: disc: the radius is not > 0", Kind::kMalformed},
           {R"([{"disc": [1,2,NaN]}])", "[0]: disc: expected", Kind::kMalformed},
           {R"([{"disk": [1,2,3]}])", R"(did you mean "disc")", Kind::kMalformed},
           {R"([{"disc": [1,2,3], "crack": [1,2,3]}])", R"("disc" and "crack" in one)", Kind::kMalformed},
           {R"([{"disc": [1,2,3], "keep": "all"}])", "keep: expected", Kind::kMalformed},
           {R"([{"disc": [1,2,3], "sagitta_m": 0}])", "sagitta_m: expected", Kind::kMalformed},
           {R"([{"disc": [1,2,3], "must_cut": 1}])", "must_cut: expected", Kind::kMalformed},
           {R"([{"keep": "both"}])", "expected an object with one of", Kind::kMalformed},
           {R"([{"line": [1,2,1,2]}])", "the line's ends are one point", Kind::kMalformed},
           {R"([{"line": [1,2,3]}])", "[0]: line: expected", Kind::kMalformed},
           {R"([{"disc": [1,2,3]},])", "1:19: a comma too many", Kind::kMalformed},
           {R"([{"disc": [1e300,0,1]}])", "not-finite", Kind::kInvalidPolygon},
           {R"json([{"polygon": "POLYGON((0 0,2 2,2 0,0 2))"}])json", "self-crossing at (1, 1)", Kind::kInvalidPolygon},
           {R"([{"polygon": {"type": "Point", "coordinates": [0,0]}}])", "not-a-polygon", Kind::kInvalidPolygon},
           {R"([{"polygon": {"type": "MultiPolygon", "coordinates": []}}])", "no polygon", Kind::kMalformed}}) {
    const auto ops = read_cut_ops(text, {});
    ASSERT_FALSE(ops.has_value()) << text;
    EXPECT_HAS(ops.error().words, words) << text;
    EXPECT_EQ(ops.error().kind, kind) << text << "\n" << ops.error().words;
  }
}

TEST(CutOps, NumbersBetweenCommasAreReadToTheLastBit) {
  const auto numbers = tests::checked(read_numbers("-0.1, 1e-6,3.3333333333333335", 3, 3));
  EXPECT_EQ(*numbers, (std::vector<double>{-0.1, 1e-6, 3.3333333333333335}));
  for (const char* text : {"", "1,2", "1,2,3,4", "1,2,", "1;2;3", "1,2,x", "1,2,nan", "1,2,inf", "1,2,1e999", "1 2 3"})
    EXPECT_FALSE(read_numbers(text, 3, 3).has_value()) << text;
}

TEST(CutOps, DiscsKeepTheirSagitta) {
  for (const double radius : {1e-6, 1e-3, 0.5, 5.0, 30.0, 1000.0}) {
    const auto op = tests::checked(op_of_numbers("disc", {3, -2, radius}, 0));
    const auto* disc = std::get_if<DiscTool>(&op->tool);
    ASSERT_NE(disc, nullptr);
    const geometry::Ring& ring = disc->polygon.outer;
    EXPECT_GE(ring.size(), 36U);
    EXPECT_LE(disc->sagitta, 0.02);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const geometry::Point middle = midpoint(ring[i], ring[(i + 1) % ring.size()]);
      EXPECT_NEAR(distance(ring[i], disc->centre), radius, 1e-9 * radius + 1e-15);
      EXPECT_LE(radius - distance(middle, disc->centre), disc->sagitta * (1 + 1e-6) + 1e-15);
    }
  }
}

}  // namespace
}  // namespace polynya::io
