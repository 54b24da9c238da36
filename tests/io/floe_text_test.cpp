#include "io/text/floe_text.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "expect_text.hpp"
#include <fmt/format.h>

#include "geometry/cut/cut.hpp"
#include "io/text/cut.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;

const Ring kSquare{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
const std::string kSquareText = R"({"type":"Polygon","coordinates":[[[0,0],[4,0],[4,4],[0,4],[0,0]]]})";

FloeText floes_of(const std::string& text) {
  auto floes = read_floe_text(text);
  EXPECT_TRUE(floes.has_value()) << (floes ? "" : floes.error()) << "\n" << text;
  return floes ? *std::move(floes) : FloeText{};
}

/// The doubles are of every kind: random bits, and values that printers often get wrong.
std::vector<double> hard_doubles() {
  std::vector<double> values{
      0.1,   1.0 / 3, 5e-324, 2.2250738585072014e-308, 1e23, 9007199254740993.0, 1e-6, 123456.789e-300,
      1e300, -0.7,    1e21,   std::nextafter(1.0, 2)};
  std::mt19937_64 dice(20240917);
  while (values.size() < 3000) {
    const std::uint64_t bits = dice();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) values.push_back(value);
  }
  return values;
}

TEST(FloeText, EveryFormatReadsBackToTheSameDoubles) {
  const std::vector<double> values = hard_doubles();
  Polygon polygon;
  for (std::size_t i = 0; i + 1 < values.size(); i += 2)
    (i < 2000                ? polygon.outer
     : polygon.holes.empty() ? polygon.holes.emplace_back()
                             : polygon.holes.back())
        .push_back({values[i], values[i + 1]});
  CutReport report;
  report.floes.emplace_back().pieces.push_back({1, geometry::Part::kOutside, 1, polygon});
  for (const FloeFormat format : {FloeFormat::kGeojson, FloeFormat::kNdjson, FloeFormat::kWkt}) {
    const FloeText floes = floes_of(to_floe_text(report, format));
    ASSERT_EQ(floes.entries.size(), 1U);
    Polygon back = floes.entries.front().polygon;
    ASSERT_EQ(back.outer.front(), back.outer.back()) << "rings are written closed";
    back.outer.pop_back();
    back.holes.front().pop_back();
    EXPECT_EQ(back, polygon);
  }
}

TEST(FloeText, TheFormatIsToldByContent) {
  const std::string collection = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"floe_id":7},"geometry":)" +
                                 kSquareText + "}\n]}\n";
  for (const std::string& text :
       {kSquareText, kSquareText + "\n", "\xEF\xBB\xBF \n" + kSquareText, collection, "// a note\n" + kSquareText})
    EXPECT_EQ(floes_of(text).format, FloeFormat::kGeojson) << text;
  for (const std::string& text :
       {kSquareText + "\n" + kSquareText, "\n" + kSquareText + "\r\n\r\n" + kSquareText + "\r\n",
        "\x1E" + kSquareText + "\n\x1E" + kSquareText + "\n"}) {
    const FloeText floes = floes_of(text);
    EXPECT_EQ(floes.format, FloeFormat::kNdjson) << text;
    EXPECT_EQ(floes.entries.size(), 2U);
  }
  for (const std::string text :
       {"POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0))", "polygon((0 0,4 0,4 4,0 4))",
        "# a note\nSRID=4326;Polygon Z ((0 0 9, 4 0 9, 4 4 9, 0 4 9, 0 0 9));\n",
        "POLYGONZM((0 0 1 2,4 0 1 2,4 4 1 2,0 4 1 2))", "MULTIPOLYGON(((0 0,4 0,4 4,0 4,0 0)))",
        "GEOMETRYCOLLECTION(POLYGON((0 0,4 0,4 4,0 4,0 0)),MULTIPOLYGON EMPTY)",
        "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), EMPTY)",
        "MULTIPOLYGON (EMPTY, ((0 0, 4 0, 4 4, 0 4, 0 0), EMPTY), empty)"}) {
    const FloeText floes = floes_of(text);
    EXPECT_EQ(floes.format, FloeFormat::kWkt) << text;
    ASSERT_EQ(floes.entries.size(), 1U) << text;
    EXPECT_EQ(geometry::normalised(floes.entries.front().polygon), (Polygon{kSquare, {}})) << text;
  }
  EXPECT_EQ(floes_of(collection).entries.front().floe_id, 7);
}

TEST(FloeText, WhatStandsInATextIsNumberedAndPlaced) {
  const FloeText floes = floes_of(R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "geometry": {"type": "MultiPolygon", "coordinates": [
      [[[0,0],[1,0],[0,1]]],
      [[[5,0],[6,0],[5,1]]]]}},
    {"type": "Feature", "geometry": null},
    {"type": "Feature", "geometry": {"type": "GeometryCollection", "geometries": [
      {"type": "Point", "coordinates": [0, 0]},
      {"type": "Polygon", "coordinates": [[[7,0],[8,0],[7,1]]]}]}},
    {"type": "Polygon", "coordinates": [[[7,0],[8,0,3],[7,1]], 5]},
    {"type": "Polygon", "coordinates": []},
    7]})");
  using Expected = std::tuple<std::size_t, std::size_t, std::size_t, std::string>;  // feature, member, line, refusal
  const std::vector<Expected> expected{
      {0, 0, 3, ""}, {0, 1, 4, ""},          {1, 0, 5, "no-geometry"}, {2, 0, 7, "not-a-polygon"},
      {2, 1, 8, ""}, {3, 0, 9, "malformed"}, {4, 0, 10, ""},           {5, 0, 11, "malformed"}};
  std::vector<Expected> found;
  for (const FloeEntry& entry : floes.entries)
    found.emplace_back(entry.feature, entry.member, entry.line, entry.refusal);
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(floes.has_more_coordinates);
}

TEST(FloeText, ABadLineOfWktLeavesTheOthers) {
  const FloeText wkt = floes_of("POLYGON((0 0,1 0,0 1))\nPOLYGON((0 0,1 x\nPOINT(1 2)\nPOLYGON((0 0,2 0,0 2))");
  ASSERT_EQ(wkt.entries.size(), 4U);
  EXPECT_EQ(wkt.entries[1].refusal, "syntax");
  EXPECT_EQ(wkt.entries[1].detail, "found 'x', expected a number");
  EXPECT_EQ(wkt.entries[2].refusal, "not-a-polygon");
  EXPECT_TRUE(wkt.entries[3].refusal.empty());
  EXPECT_EQ(wkt.entries[3].line, 4U);
}

TEST(FloeText, ABadLineOfNdjsonIsRefusedWhereverItStands) {
  for (const auto& [bad, reason] : {std::pair{"garbage", "syntax"},
                                    {"null", "malformed"},
                                    {"[]", "malformed"},
                                    {"42", "malformed"},
                                    {"\"text\"", "malformed"},
                                    {"{\"type\": oops}", "syntax"},
                                    {"{\"type\": \"Polygon\", \"coordinates\": [[[0,0],[4,", "syntax"},
                                    {"{\"type\": \"Poly", "syntax"},
                                    {"POLYGON ((0 0, 1 0, 0 1))", "syntax"}}) {
    for (std::size_t at = 0; at < 4; ++at) {
      std::string text;
      for (std::size_t i = 0; i < 4; ++i) text += (i == at ? std::string(bad) : kSquareText) + "\n";
      const FloeText floes = floes_of(text);
      EXPECT_EQ(floes.format, FloeFormat::kNdjson) << text;
      ASSERT_EQ(floes.entries.size(), 4U) << text;
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(floes.entries[i].refusal, i == at ? reason : "") << text;
        EXPECT_EQ(floes.entries[i].line, i + 1) << text;
        EXPECT_EQ(floes.entries[i].feature, i) << text;
      }
    }
  }
}

TEST(FloeText, CommentsAndBlankLinesOfNdjsonArePassedOver) {
  const FloeText floes =
      floes_of("# from survey 7\n\n" + kSquareText + "\n// the second\n  # and\n" + kSquareText + "\n");
  EXPECT_EQ(floes.format, FloeFormat::kNdjson);
  ASSERT_EQ(floes.entries.size(), 2U);
  EXPECT_EQ(floes.entries[0].line, 3U);
  EXPECT_EQ(floes.entries[1].line, 6U);
  EXPECT_EQ(floes_of("# one\n" + kSquareText).entries.size(), 1U);
  const FloeText wkt =
      floes_of("// two\nPOLYGON ((0 0, 1 0, // a corner\n 0 1)) # the end\n// and\nPOLYGON ((5 0, 6 0, 5 1))\n#");
  ASSERT_EQ(wkt.entries.size(), 2U);
  EXPECT_TRUE(wkt.entries[0].refusal.empty() && wkt.entries[1].refusal.empty());
}

TEST(FloeText, AFaultOfGeojsonIsNotTakenForNdjson) {
  const std::string begin = "{\"type\":\"GeometryCollection\",\"geometries\":[\n";
  for (const std::string& text :
       {begin + kSquareText + ",\n" + kSquareText + "\n" + kSquareText + "\n]}\n", begin + kSquareText,
        begin + kSquareText + ",\n" + kSquareText + ",\n]}\n", begin + kSquareText + ",\n" + kSquareText + "\n]\n"}) {
    EXPECT_HAS(tests::refused(read_floe_text(text)), "(read as GeoJSON)");
  }
}

TEST(FloeText, ATextWithoutContentHasNoFloes) {
  for (const char* text : {"", " \n\t\r\n", "# removed\n", "\xEF\xBB\xBF"})
    EXPECT_TRUE(floes_of(text).entries.empty()) << text;
  CutReport nothing;
  nothing.floes.emplace_back();
  for (const FloeFormat format : {FloeFormat::kGeojson, FloeFormat::kNdjson, FloeFormat::kWkt})
    EXPECT_TRUE(floes_of(to_floe_text(nothing, format)).entries.empty());
}

/// The properties of a feature are kept as they are written, without blanks and comments, and so is the crs.
TEST(FloeText, PropertiesAndCrsAreKeptAsWritten) {
  const FloeText floes = floes_of(R"({"type": "FeatureCollection",
    "crs": {"type": "name", "properties": {"name": "EPSG:3413"}}, "features": [
    {"type": "Feature", "properties": {"floe_id": 7, "name": "a  \"b\" // c", "thick_m": 0.70, // a note
      "id": 12345678901234567890, "mean": NaN, "huge": 1e999, "list": [1, /* two */ {"x": -Infinity}],
      "area_m2": 3, "part": "inside", "parent_id": 1}, "geometry": )" +
                                  kSquareText + R"(},
    {"type": "Feature", "properties": null, "geometry": )" +
                                  kSquareText + "}]}");
  ASSERT_EQ(floes.entries.size(), 2U);
  EXPECT_EQ(floes.crs, R"({"type":"name","properties":{"name":"EPSG:3413"}})");
  ASSERT_NE(floes.entries[0].properties, nullptr);
  EXPECT_EQ(*floes.entries[0].properties,
            R"("name":"a  \"b\" // c","thick_m":0.70,"id":12345678901234567890,"mean":null,"huge":null,)"
            R"("list":[1,{"x":null}])");
  EXPECT_EQ(floes.entries[1].properties, nullptr);
  EXPECT_TRUE(floes_of("SRID=3413;POLYGON ((0 0, 1 0, 0 1))").has_srid);
}

TEST(FloeText, NumbersThatAreNoneBecomeNan) {
  const FloeText floes = floes_of(R"({"note": "NaN 1e999 // \"", "type": "MultiPolygon", "coordinates": [
    [[[NaN,0],[4,-Infinity],[1e999,null]]], [[[0,0],[1e-999,0],[4,4]]]]})");
  ASSERT_EQ(floes.entries.size(), 2U);
  const Ring& ring = floes.entries[0].polygon.outer;
  EXPECT_TRUE(std::isnan(ring[0].x) && std::isnan(ring[1].y) && std::isnan(ring[2].x) && std::isnan(ring[2].y));
  EXPECT_EQ(ring[1].x, 4);
  EXPECT_EQ(floes.entries[1].polygon.outer[1], (Point{0, 0}));
  const Ring wkt = floes_of("POLYGON ((nan inf, 1e999 1e-999, -Infinity 3))").entries.front().polygon.outer;
  EXPECT_TRUE(std::isnan(wkt[0].x) && std::isinf(wkt[0].y) && std::isinf(wkt[1].x) && std::isinf(wkt[2].x));
  EXPECT_EQ(wkt[1].y, 0);
}

TEST(FloeText, WhatCannotBeReadIsToldWithItsPlace) {
  for (const auto& [text, place] : {std::pair{"(1 2)", "1:1: neither"},
                                    {"garbage", "1:1: neither GeoJSON, nor NDJSON"},
                                    {"<kml>\n</kml>", "1:1: neither"},
                                    {"garbage\nmore of it\n", "1:1: neither"},
                                    {"{\"type\": \"Polygon\",\n \"coordinates\": [[[0 0]]]}", "2:22: "},
                                    {R"({"type": "Polygon")", "1:19: "}}) {
    EXPECT_BEGINS(tests::refused(read_floe_text(text)), place);
  }
  std::string deep(100'000, '[');
  EXPECT_FALSE(read_floe_text(deep).has_value());
  std::string nested;
  for (int i = 0; i < 100'000; ++i) nested += "GEOMETRYCOLLECTION(";
  EXPECT_EQ(floes_of(nested).entries.front().refusal, "syntax");
}

/// Whatever bytes the text has, reading ends and returns a result. The test uses every truncation and many corruptions
/// of valid texts.
TEST(FloeText, AnyDamageIsSurvived) {
  const std::vector<std::string> good{
      R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"floe_id":3},"geometry":)"
      R"({"type":"MultiPolygon","coordinates":[[[[0,0],[4,0],[4,4e0],[0,4],[0,0]],[[1,1],[1,2],[2,1]]]]}}]})",
      "SRID=3;MULTIPOLYGON Z (((0 0 1, 4 0 1, 4 4 1), (1 1 1, 1 2 1, 2 1 1)), EMPTY); "
      "GEOMETRYCOLLECTION(POINT(1 2))"};
  std::mt19937 dice(7);
  std::size_t readable = 0;
  for (const std::string& text : good) {
    for (std::size_t length = 0; length < text.size(); ++length)
      readable += read_floe_text(text.substr(0, length)) ? 1 : 0;
    for (int trial = 0; trial < 3000; ++trial) {
      std::string damaged = text;
      for (int i = 0; i < 3; ++i) damaged[dice() % damaged.size()] = "{}[](),:\"\\ \n/*#0-eNZ;\x1E\xFF\0"[dice() % 24];
      readable += read_floe_text(damaged) ? 1 : 0;
    }
  }
  EXPECT_GT(readable, 1000U);
}

// ---- lists of cuts

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
  const std::vector<CutOp>& op = *ops;
  EXPECT_EQ(std::get<DiscTool>(op[0].tool).sagitta, 0.1);
  EXPECT_EQ(std::get<DiscTool>(op[1].tool).sagitta, 0.5);
  EXPECT_EQ(op[1].keep, Keep::kBoth);
  EXPECT_EQ(op[2].keep, Keep::kOutside);
  EXPECT_TRUE(!op[2].must_cut && op[3].must_cut);
  EXPECT_EQ(std::get<CrackTool>(op[2].tool).angle_deg, 30);
  EXPECT_EQ(std::get<LineTool>(op[3].tool).path, (std::vector<geometry::Point>{{0, 1}, {2, 3}}));
  EXPECT_EQ(std::get<LineTool>(op[4].tool).path.size(), 3U);
  const auto& polygons = std::get<PolygonTool>(op[5].tool).polygons;
  ASSERT_EQ(polygons.size(), 2U);
  EXPECT_EQ(polygons[0].outer.size(), 4U);
  EXPECT_EQ(polygons[0].holes.size(), 1U);
  EXPECT_EQ(op[5].keep, Keep::kInside);
}

TEST(CutOps, WhatIsWrongIsToldWithItsNumber) {
  for (const std::vector<std::string>& row : tests::table_of("io/wrong_cuts.txt")) {
    const ToolError error = tests::refused(read_cut_ops(row[0], {}));
    EXPECT_HAS(error.words, row[1]) << row[0];
    const auto kind = row.size() > 2 ? ToolError::Kind::kInvalidPolygon : ToolError::Kind::kMalformed;
    EXPECT_EQ(error.kind, kind) << row[0] << "\n" << error.words;
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
