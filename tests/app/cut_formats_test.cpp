// What `polynya cut` keeps of a file beside its polygons, and which files it writes.
#include "program.hpp"
#include <gtest/gtest.h>

#include "io/text/json_parser.hpp"

namespace polynya::tests {
namespace {

constexpr auto kSquare = R"({"type":"Polygon","coordinates":[[[0,0],[10,0],[10,10],[0,10],[0,0]]]})";
constexpr auto kCrs = R"({"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::3413"}})";

std::string feature(const std::string& properties) {
  return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":)" + kSquare + "}";
}

class CutFormats : public testing::Test {
 protected:
  Outcome cut(const std::string& floes, Words words, const std::string& input = "") const {
    words.insert(words.begin(), {"cut", floes});
    return polynya(words,
                   {folder.path(), RLIM_INFINITY, input.empty() ? std::filesystem::path() : folder / input});
  }
  io::JsonValue json(const std::string& file) const {
    io::JsonDocument document = io::parse_json(read_file(folder / file));
    EXPECT_TRUE(document.faults.empty()) << read_file(folder / file);
    return std::move(document.root);
  }
  TemporaryFolder folder;
};

/// Pieces of which nothing is left are floes again, in every format: nothing, and no failure.
TEST_F(CutFormats, NothingLeftIsReadAgainAsNoFloes) {
  write_file(folder / "floes.geojson", feature(R"("name":"a")"));
  for (const std::string extension : {"wkt", "ndjson", "geojson"}) {
    const std::string nothing = "nothing." + extension;
    ASSERT_EQ(cut("floes.geojson", {"--disc", "5,5,30", "--out", nothing}).code, 0);
    for (const bool is_piped : {false, true}) {
      const Outcome again =
          cut(is_piped ? "-" : nothing, {"--crack", "0,0,30", "--out", "-", "--ledger", "l.json"},
              is_piped ? nothing : "");
      EXPECT_EQ(again.code, 0) << again.err;
      EXPECT_EQ(json("l.json").find("totals")->find("floes")->number(), 0);
      EXPECT_HAS(again.err, "no floes in it");
      EXPECT_EQ(again.out, read_file(folder / nothing)) << "and nothing again, in the same words";
    }
  }
}

TEST_F(CutFormats, EveryPieceHasItsParentsPropertiesAndTheFileItsCrs) {
  write_file(folder / "floes.geojson", std::string(R"({"type":"FeatureCollection","crs":)") + kCrs +
                                           R"(,"features":[)" + feature(R"("name":"north","area":7)") + "]}");
  ASSERT_EQ(cut("floes.geojson", {"--crack", "5,5,30", "--out", "pieces.geojson"}).code, 0);
  ASSERT_EQ(cut("pieces.geojson", {"--crack", "5,5,120", "--out", "smaller.geojson"}).code, 0);
  const io::JsonValue pieces = json("smaller.geojson");
  EXPECT_EQ(pieces.find("crs")->find("properties")->find("name")->text(), "urn:ogc:def:crs:EPSG::3413");
  ASSERT_EQ(pieces.find("features")->items().size(), 4U);
  for (const io::JsonValue& piece : pieces.find("features")->items()) {
    const io::JsonValue& properties = *piece.find("properties");
    EXPECT_EQ(properties.find("name")->text(), "north");
    EXPECT_EQ(properties.find("area")->number(), 7) << "the user's own, of the parent";
    EXPECT_NEAR(properties.find("area_m2")->number(), 25, 1e-12);
    EXPECT_EQ(properties.find("part")->text(), "outside");
  }
  ASSERT_EQ(cut("pieces.geojson", {"--crack", "5,5,120", "--out", "smaller.ndjson"}).code, 0);
  const std::string lines = read_file(folder / "smaller.ndjson");
  EXPECT_HAS(lines, kCrs);
  ASSERT_EQ(cut("smaller.ndjson", {"--disc", "5,5,1", "--out", "last.geojson"}).code, 0);
  EXPECT_EQ(json("last.geojson").find("crs")->find("type")->text(), "name");
}

TEST_F(CutFormats, WhatAFormatCannotKeepIsReported) {
  write_file(folder / "floes.geojson", std::string(R"({"type":"FeatureCollection","crs":)") + kCrs +
                                           R"(,"features":[)" + feature(R"("name":"north")") + "]}");
  const Outcome as_wkt = cut("floes.geojson", {"--crack", "5,5,30", "--out", "pieces.wkt"});
  EXPECT_EQ(as_wkt.code, 0);
  EXPECT_HAS(as_wkt.err, "WKT has no room for its crs");
  EXPECT_HAS(as_wkt.err, "WKT has no room for properties");
  write_file(folder / "floes.wkt", "SRID=3413;POLYGON ((0 0, 1 0, 0 1))");
  EXPECT_HAS(cut("floes.wkt", {"--disc", "0,0,0.1"}).err, "SRID is ignored");
  const std::string other =
      R"({"type":"Feature","crs":null,"properties":{},"geometry":)" + std::string(kSquare) + "}\n";
  write_file(folder / "floes.ndjson",
             R"({"crs":)" + std::string(kCrs) + "," + feature("").substr(1) + "\n" + other);
  EXPECT_HAS(cut("floes.ndjson", {"--disc", "0,0,1"}).err, "crs members differ");
}

TEST_F(CutFormats, LongitudeAndLatitudeAreNoMetres) {
  const std::string lonlat =
      R"({"type":"Polygon","coordinates":[[[15.6,78.2],[15.61,78.2],[15.61,78.21],[15.6,78.2]]]})";
  write_file(
      folder / "crs.geojson",
      R"({"crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:OGC:1.3:CRS84"}},)" + lonlat.substr(1));
  const Outcome refused = cut("crs.geojson", {"--disc", "15.6,78.2,0.01", "--out", "pieces.geojson"});
  EXPECT_EQ(refused.code, 4);
  EXPECT_HAS(refused.err, "longitude and latitude (urn:ogc:def:crs:OGC:1.3:CRS84)");
  EXPECT_FALSE(std::filesystem::exists(folder / "pieces.geojson"));
  write_file(folder / "bare.geojson", lonlat);
  const Outcome noted = cut("bare.geojson", {"--disc", "15.6,78.2,0.01"});
  EXPECT_EQ(noted.code, 0);
  EXPECT_HAS(noted.err, "look like longitude and latitude");
}

TEST_F(CutFormats, AnExtensionOfNoFormatIsRefusedBeforeAnythingIsDone) {
  write_file(folder / "floes.geojson", feature(""));
  for (const char* name : {"pieces.shp", "pieces.gpkg", "pieces.txt", "pieces.geojson.bak"}) {
    const Outcome outcome = cut("floes.geojson", {"--disc", "0,0,1", "--out", name, "--ledger", "l.json"});
    EXPECT_EQ(outcome.code, 2) << name;
    EXPECT_HAS(outcome.err, ".geojson", ".json", ".ndjson", ".jsonl", ".geojsonl", ".wkt");
    EXPECT_FALSE(std::filesystem::exists(folder / name));
    EXPECT_FALSE(std::filesystem::exists(folder / "l.json"));
  }
  EXPECT_EQ(cut("floes.geojson", {"--disc", "0,0,1", "--out", "PIECES.WKT"}).code, 0);
  EXPECT_BEGINS(read_file(folder / "PIECES.WKT"), "POLYGON");
  EXPECT_EQ(cut("floes.geojson", {"--disc", "0,0,1", "--out", "pieces"}).code, 0);
}

}  // namespace
}  // namespace polynya::tests
