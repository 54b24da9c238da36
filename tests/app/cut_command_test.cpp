// `polynya cut`: the ledger and the pieces of every tool, the inputs that are refused, and the properties of a file's
// format that are kept.
#include <cmath>
#include <random>

#include "program.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "io/run/event_records.hpp"
#include "io/text/floe_text.hpp"
#include "simulation/world/step.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::tests {
namespace {

using geometry::Polygon;
using nlohmann::json;

std::string polygon_json(const std::string& rings) {
  return R"({"type":"Polygon","coordinates":[)" + rings + "]}";
}
std::string feature(const std::string& rings, const std::string& properties = "") {
  return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":)" + polygon_json(rings) + "}";
}
std::string collection(const std::vector<std::string>& features, const std::string& members = "") {
  return fmt::format("{{\"type\":\"FeatureCollection\",{}\"features\":[\n{}\n]}}\n", members,
                     fmt::join(features, ",\n"));
}

const std::string kSquare = "[[0,0],[10,0],[10,10],[0,10],[0,0]]";
const std::string kFarSquare = "[[100,0],[110,0],[110,10],[100,10],[100,0]]";
const std::string kCrs = R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::3413"}},)";

/// A folder with floes.geojson of two squares, in which commands run.
class CutCommand : public InFolder {
 protected:
  Outcome cut(const Words& words, const std::string& floes = "floes.geojson") const {
    return call(Words{"cut", floes} + words);
  }
  json read_json(const std::string& name) const { return json::parse(read(name)); }
  static std::vector<Polygon> polygons_of(const std::string& text) {
    const auto floes = io::read_floe_text(text);
    EXPECT_TRUE(floes.has_value()) << text;
    std::vector<Polygon> polygons;
    for (const io::FloeEntry& entry : floes->entries) polygons.push_back(geometry::normalised(entry.polygon));
    return polygons;
  }
  static double area_of(const std::string& text) {
    double area = 0;
    for (const Polygon& polygon : polygons_of(text)) {
      EXPECT_FALSE(geometry::find_defect(polygon).has_value());
      area += geometry::measure(polygon).area;
    }
    return area;
  }
  /// Returns the ledger of an outcome after checking that all its sums balance.
  static json ledger_of(const Outcome& outcome, int code = 0) {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    json ledger = json::parse(outcome.out);
    std::vector<json> all{ledger["totals"]};
    double pieces = 0;
    for (const json& one : ledger["floes"]) {
      all.push_back(one);
      pieces += one["pieces"].get<double>();
      EXPECT_EQ(one["parts"].size(), one["pieces"]);
    }
    for (const json& one : all) {
      const double area = one["area_m2"];
      EXPECT_NEAR(one["area_of_pieces_m2"].get<double>() + one["removed_m2"].get<double>() -
                      one["rounding_defect_m2"].get<double>(),
                  area, 1e-12 * (1 + area));
      EXPECT_EQ(one["exact_defect_m2"], "0");
    }
    EXPECT_EQ(ledger["totals"]["pieces"], pieces);
    EXPECT_EQ(ledger["totals"]["floes"], ledger["floes"].size());
    return ledger;
  }
  void SetUp() override { write("floes.geojson", collection({feature(kSquare), feature(kFarSquare)})); }
  void write_three() const {
    write("floes.geojson", collection({feature(kSquare), feature(kFarSquare), feature("[[0,50],[1,50],[0,51]]")}));
  }
};

TEST_F(CutCommand, ADiscLeavesTheOutsideAndAccountsForTheRest) {
  json ledger = ledger_of(cut("--disc 0,0,5 --out pieces.geojson"));
  EXPECT_EQ(ledger["totals"]["area_m2"], 200);
  // A quarter of the inscribed regular 36-gon.
  EXPECT_NEAR(ledger["totals"]["removed_m2"], 0.5 * 36 * 25 * std::sin(M_PI / 18) / 4, 1e-12);
  EXPECT_EQ(ledger["tools"][0]["vertices"], 36);
  json pieces = read_json("pieces.geojson")["features"];
  ASSERT_EQ(pieces.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const json expected{{"floe_id", 2 + i},
                        {"parent_id", i},
                        {"part", "outside"},
                        {"area_m2", ledger["floes"][i]["area_of_pieces_m2"]}};
    EXPECT_EQ(pieces[i]["properties"], expected);
  }
  EXPECT_EQ(ledger["floes"][1]["removed_m2"], 0) << "the disc misses it: it stays whole";
  EXPECT_EQ(ledger["totals"]["area_of_pieces_m2"], area_of(read("pieces.geojson")));
}

TEST_F(CutCommand, KeepSaysWhichSideStays) {
  std::map<std::string, double> kept;
  for (const std::string keep : {"outside", "inside", "both"}) {
    kept[keep] = ledger_of(cut("--disc 5,5,3 --out pieces.geojson --keep " + keep))["totals"]["area_of_pieces_m2"];
    for (const json& piece : read_json("pieces.geojson")["features"])
      EXPECT_TRUE(keep == "both" || piece["properties"]["part"] == keep);
  }
  EXPECT_NEAR(kept["outside"] + kept["inside"], 200, 1e-12);
  EXPECT_EQ(kept["both"], 200);
  EXPECT_LT(kept["inside"], M_PI * 9);
}

TEST_F(CutCommand, AToolOfSeveralPolygonsWithHolesIsTakenTogether) {
  write("floes.wkt", "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))");
  // A frame of area 16 − 4, and a square that overlaps its corner: 4 − 1 more.
  write("tool.wkt", "MULTIPOLYGON (((1 1, 5 1, 5 5, 1 5), (2 2, 4 2, 4 4, 2 4)), ((4 4, 6 4, 6 6, 4 6)))");
  json ledger = ledger_of(cut("--polygon tool.wkt --keep both --out pieces.geojson", "floes.wkt"));
  std::map<std::string, double> area;
  for (const json& part : ledger["floes"][0]["parts"]) area[part["part"]] += part["area_m2"].get<double>();
  EXPECT_EQ(area, (std::map<std::string, double>{{"inside", 15}, {"outside", 85}}));
  EXPECT_EQ(ledger["totals"]["pieces"], 3);
  EXPECT_EQ(read_json("pieces.geojson")["features"].size(), 3U) << "by its extension";
}

TEST_F(CutCommand, ACrackGoesThroughEveryFloeAndKeepsEverything) {
  write_three();
  json ledger = ledger_of(cut("--crack 0,5,0 --keep inside"));
  EXPECT_EQ(ledger["totals"]["pieces"], 5);
  EXPECT_EQ(ledger["totals"]["removed_m2"], 0);
  for (const json& part : ledger["floes"][0]["parts"]) EXPECT_EQ(part["area_m2"], 50);
}

/// A crack through vertices along an axis or a diagonal passes through them to the last bit, from any point on it.
TEST_F(CutCommand, ACrackAlongADiagonalHitsTheCorners) {
  write("floes.wkt", "POLYGON ((-1 -1, 1 -1, 1 1, -1 1))");
  for (const auto& [crack, vertices] : {std::pair{"0.1,0.1,45", 3},
                                        {"7.3,7.3,-135", 3},
                                        {"0.3,-0.3,135", 3},
                                        {"-0.7,0.7,-45", 3},
                                        {"3,0,180", 4},
                                        {"0,0.1,-90", 4},
                                        {"0,9,450", 4}}) {
    const auto pieces = polygons_of(cut(Words("--out - --crack") + crack, "floes.wkt").out);
    ASSERT_EQ(pieces.size(), 2U) << crack;
    for (const Polygon& piece : pieces) {
      EXPECT_EQ(piece.outer.size(), static_cast<std::size_t>(vertices)) << crack;
      EXPECT_EQ(geometry::measure(piece).area, 2) << crack;
    }
  }
}

TEST_F(CutCommand, ALineSeparatesWhereItCrossesAndSaysHowMuchDangles) {
  write_three();
  const Outcome outcome = cut("--line -1,5,103,5");
  json ledger = ledger_of(outcome);
  EXPECT_EQ(ledger["totals"]["pieces"], 4);
  EXPECT_EQ(ledger["totals"]["dangling_length_m"], 3);
  EXPECT_EQ(ledger["floes"][0]["dangling_length_m"], 0);
  EXPECT_EQ(ledger["floes"][1]["dangling_length_m"], 3);
  EXPECT_HAS(outcome.err, "separates nothing over 3 m");
}

TEST_F(CutCommand, OpsApplyInOrderToAllPieces) {
  write("floes.geojson", collection({feature(kSquare)}));
  write("cuts.json", R"([{"crack": [5, 5, 0]}, {"crack": [5, 5, 90]},
    {"polygon": {"type": "Polygon", "coordinates": [[[4,4],[6,4],[6,6],[4,6],[4,4]]]}, "keep": "both"},
    {"disc": [0, 0, 1]}])");
  json ledger = ledger_of(cut("--ops cuts.json"));
  EXPECT_EQ(ledger["totals"]["pieces"], 8);
  EXPECT_NEAR(ledger["totals"]["removed_m2"], 0.5 * 36 * std::sin(M_PI / 18) / 4, 1e-12);
  write("inside.json", R"([{"crack": [5, 5, 0]}, {"disc": [5, 10, 2], "keep": "inside"}])");
  EXPECT_EQ(ledger_of(cut("--ops inside.json"))["totals"]["pieces"], 1)
      << "the lower half is missed by the disc, so nothing of it is inside";
}

/// A cut with `must_cut` is refused if it leaves a floe, or one of its pieces, unchanged. The other floes are cut.
TEST_F(CutCommand, ACutThatMustCutRefusesWhatItLeavesWhole) {
  const std::string disc = R"([{"disc": [0, 0, 1], "keep": "both")";
  write("may.json", disc + "}]");
  write("must.json", disc + R"(, "must_cut": true}])");
  write("must-each.json", disc + R"(}, {"crack": [5, 5, 0], "must_cut": true}])");
  EXPECT_EQ(cut("--ops may.json").code, 0);
  const Outcome outcome = cut("--ops must.json");
  json ledger = ledger_of(outcome, 4);
  EXPECT_EQ(ledger["totals"]["pieces"], 3);
  EXPECT_EQ(ledger["totals"]["rejected"], 1);
  EXPECT_TRUE(ledger["floes"][0]["rejected"].is_null());
  EXPECT_EQ(ledger["floes"][1]["rejected"]["reason"], "misses");
  EXPECT_HAS(outcome.err, "feature 1, polygon 0: misses: cut 0: ", "2 floes -> 3 pieces");
  json each = ledger_of(cut("--ops must-each.json"), 4)["floes"][0];
  EXPECT_EQ(each["rejected"]["reason"], "misses") << "the piece in the disc";
  EXPECT_EQ(each["pieces"], 3);
}

/// Covers every defect that tests/geometry/validity_peer_test.cpp cannot express as text, and some that it can.
TEST_F(CutCommand, DefectsAreRefusedByNameAndTheGoodAreCut) {
  const std::vector<std::pair<std::string, std::string>> all{
      {feature(""), "too-few-points"},
      {feature("[[0,0],[1,0],[0,0],[1,0]]"), "too-few-points"},
      {feature("[[0,0],[4,4],[4,0],[0,4]]"), "self-crossing"},
      {feature("[[0,0],[NaN,0],[4,4]]"), "not-finite"},
      {feature("[[0,0],[1e999,0],[4,4]]"), "not-finite"},
      {feature("[[0,0],[4,0],[4,4]],[[10,10],[11,10],[10,11]]"), "hole-outside"},
      {R"({"type":"Feature","properties":{},"geometry":null})", "no-geometry"},
      {R"({"type":"LineString","coordinates":[[0,0],[1,1]]})", "not-a-polygon"},
      {polygon_json("[[0,0],[1,0],5]"), "malformed"}};
  std::vector<std::string> features{feature(kSquare)};
  for (const auto& [text, reason] : all) features.push_back(text);
  features.push_back(feature(kFarSquare));
  write("floes.geojson", collection(features));
  const Outcome outcome = cut("--crack 0,5,0 --out pieces.geojson");
  json ledger = ledger_of(outcome, 4);
  EXPECT_EQ(ledger["totals"]["area_m2"], 200);
  EXPECT_EQ(ledger["totals"]["rejected"], all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(ledger["floes"][i + 1]["rejected"]["reason"], all[i].second);
    EXPECT_EQ(ledger["floes"][i + 1]["feature"], i + 1);
    EXPECT_HAS(outcome.err, fmt::format("floes.geojson:{}: feature {}, polygon 0: {}", i + 3, i + 1, all[i].second));
  }
  EXPECT_FALSE(ledger["floes"][3]["rejected"]["vertices"].empty());
  EXPECT_EQ(polygons_of(read("pieces.geojson")).size(), 4U);
  write("floes.wkt", "POLYGON ((0 0, 1 1, 1 0, 0 1))\n");
  EXPECT_HAS(cut("--crack 5,5,33", "floes.wkt").err, "1 refused; nothing was cut");
  expect_refusals(
      {{"cut floes.geojson --polygon floes.wkt", 4, "floes.wkt: feature 0, polygon 0: self-crossing at (0.5, 0.5)"}},
      {folder.path()});
}

TEST_F(CutCommand, WhatOgcAllowsIsCut) {
  // The floes have a clockwise open ring, a repeated point and a straight vertex, a hole at a vertex of the shell, and
  // holes that touch.
  write("floes.geojson",
        collection({feature("[[0,0],[0,10],[10,10],[10,0]]"), feature("[[0,0],[5,0],[5,0],[10,0],[10,10],[0,10]]"),
                    feature(kSquare + ",[[0,0],[6,2],[2,6]]"),
                    feature(kSquare + ",[[2,2],[4,2],[4,4],[2,4]],[[4,4],[6,4],[6,6],[4,6]]")}));
  EXPECT_EQ(ledger_of(cut("--crack 0,3,7 --out pieces.wkt"))["totals"]["area_m2"], 100 + 100 + 84 + 92);
  EXPECT_NEAR(area_of(read("pieces.wkt")), 376, 1e-11);
}

TEST_F(CutCommand, RepairIsOnRequestAndSaysWhatItChanged) {
  // The floes are a bow-tie and a pentagram, around whose middle the ring winds twice.
  write("floes.geojson", collection({feature("[[0,0],[4,4],[4,0],[0,4]]"), feature("[[0,3],[8,3],[2,8],[4,0],[6,8]]"),
                                     feature(kFarSquare)}));
  EXPECT_EQ(cut("--crack 0,100,0").code, 4);
  std::vector<double> star_area;
  for (const char* rule : {"even-odd", "non-zero"}) {
    const Outcome outcome = cut(Words("--crack 0,100,0 --repair") + rule);
    json ledger = ledger_of(outcome);
    EXPECT_EQ(ledger["totals"]["repaired"], 2);
    json repair = ledger["floes"][0]["repair"];
    EXPECT_EQ(repair["area_drawn_m2"], 0);
    EXPECT_EQ(repair["area_changed_m2"], 8);
    EXPECT_EQ(repair["shapes"], 2);
    EXPECT_EQ(ledger["floes"][0]["area_m2"], 8);
    EXPECT_FALSE(ledger["floes"][2].contains("repair"));
    star_area.push_back(ledger["floes"][1]["area_m2"]);
    EXPECT_HAS(outcome.err, "repaired");
  }
  EXPECT_LT(star_area[0], star_area[1]) << "even-odd leaves the middle open";
  write("floes.geojson", collection({feature("[[0,0],[NaN,0],[4,4]]"), feature("[[0,0],[1,0],[2,0]]")}));
  json hopeless = ledger_of(cut("--crack 0,100,0 --repair non-zero"), 4)["floes"];
  EXPECT_EQ(hopeless[0]["rejected"]["reason"], "not-finite");
  EXPECT_EQ(hopeless[1]["rejected"]["reason"], "zero-area");
}

TEST_F(CutCommand, FormatsGoInAndOutAndStdinIsRead) {
  const std::string triangle = "[[20,0],[30,0],[30,10]]";
  write("floes.wkt", "POLYGON ((0 0, 10 0, 10 10, 0 10))\nPOLYGON ((20 0, 30 0, 30 10))\n");
  write("floes.ndjson", feature(kSquare) + "\n" + feature(triangle) + "\n");
  write("floes.geojson", collection({feature(kSquare), feature(triangle)}));
  std::vector<std::vector<Polygon>> pieces;
  for (const char* name : {"floes.wkt", "floes.ndjson", "floes.geojson"}) {
    const Start piped{.folder = folder.path(), .input = folder / name};
    const Outcome outcome = polynya("cut - --crack 0,0,30 --ledger ledger.json", piped);
    ledger_of({outcome.code, read("ledger.json"), outcome.err});
    EXPECT_EQ(io::read_floe_text(outcome.out)->format, io::read_floe_text(read(name))->format) << name;
    pieces.push_back(polygons_of(outcome.out));
    EXPECT_EQ(pieces.back().size(), 3U);
    EXPECT_EQ(pieces.back(), pieces.front());
  }
  EXPECT_BEGINS(cut("--crack 0,0,30 --out -", "floes.wkt").out, "POLYGON ((");
}

TEST_F(CutCommand, LinksAndPipesAreWrittenThrough) {
  write("real.wkt", "");
  std::filesystem::create_symlink("real.wkt", folder / "link.wkt");
  done("cut floes.geojson --crack 5,5,33 --out link.wkt");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.wkt"));
  EXPECT_BEGINS(read("real.wkt"), "POLYGON");
  done("cut floes.geojson --crack 5,5,33 --out /proc/self/fd/1 --ledger l.json");
}

/// Pieces are floes again: ids go on and lead back, properties and crs stay.
TEST_F(CutCommand, PiecesAreFloesAgain) {
  write("floes.geojson",
        collection({feature(kSquare, R"("floe_id":12,"name":"north","area":7)"), feature(kFarSquare, R"("floe_id":3)")},
                   kCrs));
  done("cut floes.geojson --crack 5,5,30 --out first.geojson --ledger l.json");
  json first = read_json("first.geojson")["features"][0]["properties"];
  EXPECT_EQ(first["parent_id"], 12);
  EXPECT_EQ(first["floe_id"], 13);
  const json again = ledger_of(cut("--crack 5,5,120 --out second.geojson", "first.geojson"));
  EXPECT_EQ(again["floes"][0]["floe_id"], 13);
  EXPECT_EQ(again["totals"]["area_m2"], read_json("l.json")["totals"]["area_of_pieces_m2"]);
  json second = read_json("second.geojson");
  EXPECT_EQ(second["crs"]["properties"]["name"], "urn:ogc:def:crs:EPSG::3413");
  for (int i = 0; i < 4; ++i) {
    json properties = second["features"][i]["properties"];
    EXPECT_EQ(properties["name"], "north");
    EXPECT_EQ(properties["area"], 7) << "the user's own, of the parent";
    EXPECT_NEAR(properties["area_m2"], 25, 1e-12);
    EXPECT_EQ(properties["part"], "outside");
  }
  done("cut first.geojson --crack 5,5,120 --out second.ndjson");
  EXPECT_HAS(read("second.ndjson"), kCrs.substr(6, kCrs.size() - 7));
  done("cut second.ndjson --disc 5,5,1 --out last.geojson");
  EXPECT_EQ(read_json("last.geojson")["crs"]["type"], "name");
}

TEST_F(CutCommand, NothingLeftIsReadAgainAsNoFloes) {
  write("floes.geojson", feature(kSquare));
  for (const std::string extension : {"wkt", "ndjson", "geojson"}) {
    const std::string nothing = "nothing." + extension;
    ASSERT_EQ(cut("--disc 5,5,30 --out " + nothing).code, 0);
    for (const bool is_piped : {false, true}) {
      const Start start{.folder = folder.path(), .input = is_piped ? folder / nothing : ""};
      const Outcome again = expect_code(
          0, polynya(Words{"cut", is_piped ? "-" : nothing} + "--crack 0,0,30 --out - --ledger l.json", start));
      EXPECT_EQ(read_json("l.json")["totals"]["floes"], 0);
      EXPECT_HAS(again.err, "no floes in it");
      EXPECT_EQ(again.out, read(nothing)) << "and nothing again, in the same words";
    }
  }
}

TEST_F(CutCommand, WhatAFormatCannotKeepIsReported) {
  write("floes.geojson", collection({feature(kSquare, R"("name":"north")")}, kCrs));
  EXPECT_HAS(cut("--crack 5,5,30 --out pieces.wkt").err, "WKT has no room for its crs",
             "WKT has no room for properties");
  write("floes.wkt", "SRID=3413;POLYGON ((0 0, 1 0, 0 1))");
  EXPECT_HAS(cut("--disc 0,0,0.1", "floes.wkt").err, "SRID is ignored");
  write("floes.ndjson", "{" + kCrs + feature(kSquare).substr(1) + "\n{\"crs\":null," + feature(kSquare).substr(1));
  EXPECT_HAS(cut("--disc 0,0,1", "floes.ndjson").err, "crs members differ");
}

TEST_F(CutCommand, LongitudeAndLatitudeAreNoMetres) {
  const std::string degrees = polygon_json("[[15.6,78.2],[15.61,78.2],[15.61,78.21],[15.6,78.2]]");
  write("crs.geojson",
        R"({"crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:OGC:1.3:CRS84"}},)" + degrees.substr(1));
  expect_refusals({{"cut crs.geojson --disc 15.6,78.2,0.01 --out pieces.geojson", 4,
                    "longitude and latitude (urn:ogc:def:crs:OGC:1.3:CRS84)"}},
                  {folder.path()});
  EXPECT_FALSE(std::filesystem::exists(folder / "pieces.geojson"));
  write("bare.geojson", degrees);
  EXPECT_HAS(expect_code(0, cut("--disc 15.6,78.2,0.01", "bare.geojson")).err, "look like longitude and latitude");
}

TEST_F(CutCommand, AnExtensionOfNoFormatIsRefusedBeforeAnythingIsDone) {
  for (const char* name : {"pieces.shp", "pieces.gpkg", "pieces.txt", "pieces.geojson.bak"}) {
    EXPECT_HAS(expect_code(2, cut(Words("--disc 0,0,1 --ledger l.json --out") + name)).err, ".geojson", ".json",
               ".ndjson", ".jsonl", ".geojsonl", ".wkt");
    EXPECT_FALSE(std::filesystem::exists(folder / name) || std::filesystem::exists(folder / "l.json"));
  }
  done("cut floes.geojson --disc 0,0,1 --out PIECES.WKT");
  EXPECT_BEGINS(read("PIECES.WKT"), "POLYGON");
  done("cut floes.geojson --disc 0,0,1 --out pieces");
}

// The line leaves a corner of 3e-33 m2, all of whose vertices round to (1.5, 1.5): no floe, but an item of the ledger.
TEST_F(CutCommand, SliversAreItemsOfTheLedger) {
  write("square.wkt", "POLYGON ((0 0, 1.5 0, 1.5 1.5, 0 1.5))\n");
  json totals = ledger_of(cut("--line 0,4,2.4,0 --out pieces.wkt --ledger -", "square.wkt"))["totals"];
  EXPECT_EQ(read("pieces.wkt"), "POLYGON ((1.5 1.5, 0 1.5, 0 0, 1.5 0, 1.5 1.5))\n");
  EXPECT_EQ(totals["slivers"], 1);
  EXPECT_GT(totals["area_slivers_m2"], 0);
  EXPECT_EQ(totals["area_slivers_m2"], totals["removed_m2"]);
}

TEST_F(CutCommand, WhatCannotBeReadOrWrittenIsFive) {
  write("broken.geojson", "{\"type\": \"Polygon\",\n  \"coordinates\": [[[0,0],}");
  write("prose.txt", "42 is no floe");
  write("pieces.wkt", "as it was");
  expect_refusals({{"cut missing.geojson --disc 0,0,1", 5, "missing.geojson"},
                   {"cut prose.txt --disc 0,0,1", 5, "prose.txt"},
                   {"cut floes.geojson --polygon missing.geojson", 5, "missing.geojson"},
                   {"cut floes.geojson --disc 0,0,1 --out no/such/folder.geojson", 5, "no/such/folder.geojson"},
                   {"cut broken.geojson --disc 0,0,1", 5, "broken.geojson:2:"}},
                  {folder.path()});
  // A file size limit simulates a full disk. No incomplete file is left, and the previous file is not lost.
  EXPECT_HAS(expect_code(5, polynya("cut floes.geojson --disc 0,0,5 --out pieces.wkt", {folder.path(), 300})).err,
             "File too large");
  EXPECT_EQ(read("pieces.wkt"), "as it was");
}

// ---- cuts that the simulation's fractures are refused

using namespace simulation;

/// Returns a fracture that no contact would cause: its cusp misses the floe, or its crack ends inside the floe.
PendingFracture misplaced(fracture::Failure failure, dynamics::PersistentContact& record) {
  PendingFracture pending;
  pending.failure = failure;
  pending.first_touch_in_body = {50, 5};
  pending.point_in_water = {50, 5};
  pending.cusp_radius = 3;
  pending.crack_in_body.start = {-1, 5};
  pending.crack_in_body.end = {1.0 / 3, 5};
  pending.record = &record;
  return pending;
}

TEST(RejectedCut, IsAnInputOfPolynyaCutThatComesToTheSame) {
  const TemporaryFolder folder;
  Scene scene;
  scene.floes = {scenes::floe(scenes::rectangle(0, 0, 10, 10))};
  World world(scene);
  world.journal.clear();
  dynamics::PersistentContact record;
  world.data.fractures = {misplaced(fracture::Failure::kBend, record), misplaced(fracture::Failure::kSplit, record)};
  apply_fractures(world.setup, world.last_step, world.data, world.population, {world.accounts, world.journal});
  ASSERT_EQ(world.journal.events.size(), 2U);
  EXPECT_EQ(world.accounts.counts.rejected_cuts, 2);
  for (const Event& event : world.journal.events) {
    const auto& cut = std::get<RejectedCut>(event.what);
    ASSERT_TRUE(io::write_rejected_cut(folder.path(), event.time, cut).has_value());
    const std::string name = "rejected-cuts/00000" + std::to_string(cut.input.number);
    const Outcome again = polynya({"cut", name + ".geojson", "--ops", name + "-ops.json", "--out", "out.wkt"}, folder);
    SCOPED_TRACE(cut.reason + again.err + again.out);
    EXPECT_EQ(again.code, 4);
    const std::string kind = cut.reason.substr(0, cut.reason.find(':'));
    EXPECT_EQ(kind, cut.input.number == 1 ? "misses" : "does-not-separate");
    EXPECT_HAS(again.err, "feature 0, polygon 0: " + kind + ": ", "1 floe -> 1 piece", "1 refused; nothing was cut");
    EXPECT_EQ(json::parse(again.out)["floes"][0]["rejected"]["reason"], kind);
    if (cut.input.number == 2) {
      EXPECT_HAS(again.out, "\"dangling_length_m\"");
      EXPECT_HAS(again.out, R"({"line":[[-1,5],[0.3333333333333333,5]],"must_cut":true})") << "to the last bit";
      EXPECT_HAS(again.err, "separates nothing");
    }
  }
  auto one_too_many = std::get<RejectedCut>(world.journal.events[0].what);
  one_too_many.input.number = io::kMostRejectedCuts + 1;
  EXPECT_TRUE(io::write_rejected_cut(folder.path(), 0, one_too_many).has_value());
  EXPECT_FALSE(std::filesystem::exists(folder / "rejected-cuts/000101.geojson"));
}

/// A line that was computed to end on another line ends beside it because of rounding. It separates in any order of the
/// lines.
TEST_F(CutCommand, LinesThatEndOnEachOtherSeparateInAnyOrder) {
  std::mt19937 dice(3);
  std::uniform_real_distribution<double> draw(0.5, 9.5);
  for (const double scale : {1.0, 1e-3, 1e5}) {
    write("floes.geojson",
          fmt::format(R"({{"type":"Polygon","coordinates":[[[0,0],[{0},0],[{0},{0}],[0,{0}],[0,0]]]}})", 10 * scale));
    for (int trial = 0; trial < 60; ++trial) {
      const double left = draw(dice), right = draw(dice), at = draw(dice), top = draw(dice);
      const double x0 = -1, y0 = left - (right - left) / 10, x1 = 11, y1 = right + (right - left) / 10;
      const double share = (at - x0) / (x1 - x0);
      const std::string across =
          fmt::format(R"({{"line":[{},{},{},{}]}})", scale * x0, scale * y0, scale * x1, scale * y1);
      const std::string upon = fmt::format(R"({{"line":[{},{},{},{}]}})", scale * (x0 + share * (x1 - x0)),
                                           scale * (y0 + share * (y1 - y0)), scale * top, scale * 12);
      for (const std::string& ops : {across + "," + upon, upon + "," + across}) {
        write("ops.json", "[" + ops + "]");
        const json ledger = ledger_of(cut("--ops ops.json --out pieces.geojson"));
        EXPECT_EQ(ledger["totals"]["pieces"], 3) << ops;
        EXPECT_EQ(ledger["totals"]["dangling_length_m"], 0) << ops;
      }
      // One after the other, by two commands.
      write("one.json", "[" + across + "]");
      write("two.json", "[" + upon + "]");
      ledger_of(cut("--ops one.json --out first.geojson"));
      EXPECT_EQ(ledger_of(cut("--ops two.json --out pieces.geojson", "first.geojson"))["totals"]["pieces"], 3) << upon;
    }
  }
}

TEST_F(CutCommand, LinesTogetherSeparateWhatNoOneOfThemDoes) {
  // Three lines around a triangle, none of which reaches the edge of the floe.
  write("ops.json", R"([{"line":[2,2,8,2.5]},{"line":[7,2,5,8]},{"line":[5.5,8,2.5,1.5]}])");
  const json ledger = ledger_of(cut("--ops ops.json --out pieces.geojson"));
  EXPECT_EQ(ledger["floes"][0]["pieces"], 2);
  EXPECT_GT(ledger["totals"]["dangling_length_m"], 0.5);
  // A disc between them keeps them apart.
  write("ops.json",
        R"([{"line":[2,2,8,2.5]},{"disc":[50,50,1]},{"line":[7,2,5,8]},{"disc":[50,50,1]},{"line":[5.5,8,2.5,1.5]}])");
  EXPECT_EQ(ledger_of(cut("--ops ops.json --out pieces.geojson"))["floes"][0]["pieces"], 1);
}

TEST_F(CutCommand, ASnapContinuesEndsThatStopShort) {
  for (const auto& [snap, pieces] : {std::pair{"", 1}, {" --snap 0.1", 1}, {" --snap 0.3", 2}})
    EXPECT_EQ(ledger_of(cut(Words(std::string("--line 5,-1,5,9.8 --out pieces.geojson") + snap)))["floes"][0]["pieces"],
              pieces);
  write("ops.json", R"([{"line":[5,-1,5,9.8],"snap_m":0.3}])");
  EXPECT_EQ(ledger_of(cut("--ops ops.json --out pieces.geojson"))["floes"][0]["pieces"], 2);
}

}  // namespace
}  // namespace polynya::tests
