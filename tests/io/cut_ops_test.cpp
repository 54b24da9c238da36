#include "io/text/cut_ops.hpp"

#include <cmath>

#include "expect_text.hpp"

#include "io/text/cut_report.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::io {
namespace {

TEST(CutOps, AListIsReadInOrder) {
  const auto ops = read_cut_ops(R"json([
    {"disc": [1, 2, 3]}, // comments are allowed
    {"disc": [1, 2, 3], "sagitta_m": 0.5, "keep": "both"},
    {"crack": [0, 1, 30]},
    {"line": [0, 1, 2, 3], "must_cut": true},
    {"line": [[0, 1], [2, 3], [4, 0]]},
    {"polygon": {"type": "MultiPolygon", "coordinates": [[[[0,0],[0,4],[4,4],[4,0]], [[1,1],[1,2],[2,1]]], [[[9,0],[10,0],[9,1]]]]},
     "keep": "inside"},
    {"polygon": "POLYGON ((0 0, 0 1, 1 0, 0 0))"}])json",
                                {Keep::kOutside, 0.1});
  ASSERT_TRUE(ops.has_value()) << ops.error().words;
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
  struct Wrong {
    const char* text;
    const char* words;
    Kind kind = Kind::kMalformed;
  };
  const Wrong all[] = {
      {"{}", "a list"},
      {"[]", "empty"},
      {R"([{"disc": [1,2,3]}, 5])", "[1]: expected an object"},
      {R"([{"disc": [1,2]}])", "[0]: disc: expected [x, y, radius]"},
      {R"([{"disc": [1,2,0]}])", "[0]: disc: the radius is not > 0"},
      {R"([{"disc": [1,2,NaN]}])", "[0]: disc: expected"},
      {R"([{"disk": [1,2,3]}])", R"(did you mean "disc")"},
      {R"([{"disc": [1,2,3], "crack": [1,2,3]}])", R"("disc" and "crack" in one)"},
      {R"([{"disc": [1,2,3], "keep": "all"}])", "keep: expected"},
      {R"([{"disc": [1,2,3], "sagitta_m": 0}])", "sagitta_m: expected"},
      {R"([{"disc": [1,2,3], "must_cut": 1}])", "must_cut: expected"},
      {R"([{"keep": "both"}])", "expected an object with one of"},
      {R"([{"line": [1,2,1,2]}])", "the line's ends are one point"},
      {R"([{"line": [1,2,3]}])", "[0]: line: expected"},
      {R"([{"disc": [1,2,3]},])", "1:19: a comma too many"},
      {R"([{"disc": [1e300,0,1]}])", "not-finite", Kind::kInvalidPolygon},
      {R"json([{"polygon": "POLYGON((0 0,2 2,2 0,0 2))"}])json", "self-crossing at (1, 1)",
       Kind::kInvalidPolygon},
      {R"([{"polygon": {"type": "Point", "coordinates": [0,0]}}])", "not-a-polygon", Kind::kInvalidPolygon},
      {R"([{"polygon": {"type": "MultiPolygon", "coordinates": []}}])", "no polygon"}};
  for (const Wrong& wrong : all) {
    const auto ops = read_cut_ops(wrong.text, {});
    ASSERT_FALSE(ops.has_value()) << wrong.text;
    EXPECT_HAS(ops.error().words, wrong.words) << wrong.text;
    EXPECT_EQ(ops.error().kind, wrong.kind) << wrong.text << "\n" << ops.error().words;
  }
}

TEST(CutOps, NumbersBetweenCommasAreReadToTheLastBit) {
  const auto numbers = read_numbers("-0.1, 1e-6,+3.3333333333333335", 3);
  ASSERT_TRUE(numbers.has_value()) << numbers.error();
  EXPECT_EQ(*numbers, (std::vector<double>{-0.1, 1e-6, 3.3333333333333335}));
  for (const char* text :
       {"", "1,2", "1,2,3,4", "1,2,", "1;2;3", "1,2,x", "1,2,nan", "1,2,inf", "1,2,1e999", "1 2 3"})
    EXPECT_FALSE(read_numbers(text, 3).has_value()) << text;
}

/// The disc's polygon lies inside the circle by no more than the sagitta, at every size.
TEST(CutOps, DiscsKeepTheirSagitta) {
  for (const double radius : {1e-6, 1e-3, 0.5, 5.0, 30.0, 1000.0}) {
    const auto disc = disc_tool({3, -2, radius}, 0);
    ASSERT_TRUE(disc.has_value()) << radius;
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

TEST(CutReport, TheLedgerHasItsKeysAndAddsUp) {
  CutReport report;
  report.ops.push_back({CrackTool{{0, 0}, 30}, Keep::kOutside});
  for (const double area : {10.0, 20.0}) {
    CutFloe& floe = report.floes.emplace_back();
    floe.area = area;
    floe.removed = 1;
    floe.area_of_pieces = area - 1;
    floe.pieces.push_back({5, geometry::Part::kInside, area - 1, {{{0, 0}, {1, 0}, {0, 1}}, {}}});
    floe.snap_rounded = area > 15 ? 1 : 0;
  }
  report.floes.emplace_back().rejected = Rejection{"not-finite", "", {{NAN, 1}}};
  const JsonDocument ledger = parse_json(to_ledger_json(report));
  ASSERT_TRUE(ledger.faults.empty()) << to_ledger_json(report);
  const JsonValue& floes = *ledger.root.find("floes");
  ASSERT_EQ(floes.items().size(), 3U);
  for (const JsonValue& floe : floes.items()) {
    for (const char* key : {"floe_id", "feature", "area_m2", "pieces", "area_of_pieces_m2", "removed_m2",
                            "exact_defect_m2", "rounding_defect_m2", "rejected", "dangling"})
      EXPECT_NE(floe.find(key), nullptr) << key;
  }
  EXPECT_TRUE(floes.items()[0].find("rejected")->is_null());
  EXPECT_EQ(floes.items()[2].find("rejected")->find("reason")->text(), "not-finite");
  const JsonValue& totals = *ledger.root.find("totals");
  EXPECT_EQ(totals.find("area_m2")->number(), 30);
  EXPECT_EQ(totals.find("pieces")->number(), 2);
  EXPECT_EQ(totals.find("area_of_pieces_m2")->number() + totals.find("removed_m2")->number(), 30);
  EXPECT_EQ(totals.find("exact_defect_m2")->text(), "0");
  EXPECT_EQ(totals.find("snap_rounded")->number(), 1);
  EXPECT_EQ(totals.find("rejected")->number(), 1);
}

}  // namespace
}  // namespace polynya::io
