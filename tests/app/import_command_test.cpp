// `polynya import` as a user calls it.
#include <cstdlib>

#include "program.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "geometry/exact/measures.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::tests {
namespace {

class Import : public InFolder {
 protected:
  Outcome import(const std::string& text, const Words& more = {}) const {
    write("mapped.geojson", text);
    return call(Words("import mapped.geojson --out floes.geojson") + more);
  }
  /// Has a program of Debian's gdal-bin been installed?
  static bool has_gdal() { return std::system("ogr2ogr --version >/dev/null 2>&1") == 0; }
  bool convert(const std::string& words) const {
    return std::system(("cd '" + folder.path().string() + "' && ogr2ogr " + words + " 2>/dev/null").c_str()) == 0;
  }
  /// The floes that a scene reads from the file that was written.
  io::SceneOutcome scene() const {
    return io::read_scene(R"({"floes": [{"file": "floes.geojson"}]})", "scene.json", folder.path());
  }
};

std::string square(double x, double y, double side, const std::string& properties = "") {
  return fmt::format(R"({{"type":"Feature","properties":{{{}}},"geometry":{{"type":"Polygon","coordinates":)"
                     R"([[[{},{}],[{},{}],[{},{}],[{},{}],[{},{}]]]}}}})",
                     properties, x, y, x + side, y, x + side, y + side, x, y + side, x, y);
}
std::string collection_of(const std::string& features, const std::string& members = "") {
  return R"({"type":"FeatureCollection",)" + members + R"("features":[)" + features + "]}\n";
}
double area_of(const simulation::Scene& scene) {
  double sum = 0;
  for (const simulation::FloeSpec& floe : scene.floes) sum += geometry::measure(floe.polygon_in_world).area;
  return sum;
}

const std::string kSvalbard = collection_of(square(15.60, 78.2000, 0.002, R"("floe_id":7,"thickness_m":0.8)") + ",\n" +
                                            square(15.61, 78.2010, 0.002, R"("floe_id":9,"sensor":"S1A")") + ",\n" +
                                            square(15.6019, 78.2001, 0.001, R"("floe_id":8)"));

TEST_F(Import, DegreesBecomeAFloeFileThatAScenesReads) {
  const Outcome imported = expect_code(0, import(kSvalbard, "--origin 78.2,15.6"));
  EXPECT_HAS(imported.err, "feature 2, polygon 0: trimmed", "to feature 0", "3 floes read, 1 trimmed; 3 written",
             "projected about 78.2, 15.6", " m2 written");
  const std::string floes = read("floes.geojson");
  EXPECT_HAS(floes, R"("floe_id":7)", R"("thickness_m":0.8)", R"("sensor":"S1A")", R"("origin":{"latitude_deg":78.2)");
  const io::JsonDocument report = io::parse_json(imported.out);
  EXPECT_TRUE(report.faults.empty()) << imported.out;
  EXPECT_EQ(report.root.find("floes")->find("trimmed")->number(), 1);
  EXPECT_EQ(checked(scene())->scene.floes.size(), 3U);
  // Again: nothing is left to do.
  EXPECT_HAS(import(floes).err, "3 floes read; 3 written");
}

TEST_F(Import, RefusedFloesAreNamedAndTheOthersWritten) {
  const std::string bow = R"({"type":"Polygon","coordinates":[[[60,0],[64,3],[64,0],[60,3],[60,0]]]})";
  const std::string text = "{\"type\":\"FeatureCollection\",\"features\":[\n" + square(0, 0, 10) + ",\n" +
                           R"({"type":"Feature","geometry":)" + bow + "},\n" +
                           square(100, 0, 10, R"("thickness_m":-2)") + ",\n" +
                           R"({"type":"Feature","geometry":{"type":"Point","coordinates":[1,2]}}]})";
  const Outcome refused = expect_code(4, import(text));
  EXPECT_HAS(refused.err, "mapped.geojson:3: feature 1, polygon 0: refused: self-crossing at (62, 1.5)",
             "mapped.geojson:4: feature 2, polygon 0: refused: property thickness_m: found -2, allowed: a "
             "number from 0.001 to 20 [m]",
             "mapped.geojson:5: feature 3, polygon 0: refused: not-a-polygon", "3 refused; 1 written",
             "--repair non-zero");
  EXPECT_HAS(import(text, "--repair even-odd").err, "1 repaired, 2 refused; 3 written");
  std::filesystem::remove(folder / "floes.geojson");
  EXPECT_HAS(expect_code(4, import(collection_of(square(0, 0, 10, R"("thickness_m":-1)")))).err,
             "every floe was refused; only the report was written");
  EXPECT_FALSE(std::filesystem::exists(folder / "floes.geojson"));
}

TEST_F(Import, WhatCannotBeReadIsRefusedInOneSentence) {
  for (const auto& [text, more, code, part] : std::vector<std::tuple<std::string, Words, int, std::string>>{
           {kSvalbard, {}, 4, "--origin 78.201,15.605 projects them"},
           {kSvalbard, "--origin north", 2, "not LATITUDE,LONGITUDE"},
           {kSvalbard, "--origin 78.2,15.6 --crs EPSG:3413", 2, "either about a place"},
           {kSvalbard, "--crs EPSG:3413", 4, "--shift moves the floes"},
           {kSvalbard, "--crs EPSG:99999", 4, "PROJ knows no coordinate system \"EPSG:99999\", allowed: EPSG:n"},
           {kSvalbard, "--origin 78.2,15.6 --property thicknes_m=H", 2, "did you mean thickness_m?"},
           {"{\"type\":", {}, 5, "mapped.geojson:1"},
           {"hello", {}, 5, "neither GeoJSON"}}) {
    EXPECT_HAS(expect_code(code, import(text, more)).err, part);
    EXPECT_FALSE(std::filesystem::exists(folder / "floes.geojson")) << part;
  }
  EXPECT_HAS(expect_code(5, call("import nowhere.shp --out floes.geojson")).err, "nowhere.shp: ");
}

TEST_F(Import, AFileWithoutFloesGivesOneWithoutFloes) {
  for (const char* text : {"", "\n", R"({"type":"FeatureCollection","features":[]})"}) {
    EXPECT_HAS(expect_code(0, import(text)).err, "no floes in it", "0 floes read; 0 written");
  }
}

TEST_F(Import, ShapefilesGeoPackagesAndFlatGeobufsAreReadByGdal) {
  if (!has_gdal()) GTEST_SKIP() << "gdal-bin is not installed";
  import(kSvalbard, "--crs EPSG:3413 --shift");
  const auto expected = checked(scene());
  for (const std::string name : {"mapped.shp", "mapped.gpkg", "mapped.fgb"}) {
    ASSERT_TRUE(convert("-t_srs EPSG:3413 " + name + " mapped.geojson")) << name;
    EXPECT_HAS(done({"import", name, "--shift", "--out", "floes.geojson"}).err,
               name + ": WGS 84 / NSIDC Sea Ice Polar Stereographic North", "3 written");
    EXPECT_NEAR(area_of(checked(scene())->scene), area_of(expected->scene), 1e-3) << name;
  }
  ASSERT_EQ(import(kSvalbard, "--origin 78.201,15.606").code, 0);
  const double area = area_of(scene()->scene);
  for (const std::string name : {"degrees.shp", "degrees.gpkg", "degrees.fgb"}) {
    ASSERT_TRUE(convert(name + " mapped.geojson")) << name;
    EXPECT_HAS(done({"import", name, "--out", "floes.geojson"}).err, name + ": WGS 84 (CRS84), projected about 78.20",
               "the floes' middle");
    EXPECT_NEAR(area_of(scene()->scene), area, 0.1) << name;
  }
  // A system without a code is converted; a file without a system is not in degrees.
  ASSERT_TRUE(convert("-t_srs '+proj=laea +lat_0=78 +lon_0=15 +datum=WGS84' own.shp mapped.geojson"));
  EXPECT_HAS(done("import own.shp --origin 78.2,15.6 --out floes.geojson").err, "3 floes read, 1 trimmed; 3 written");
  write("broken.shp", read("mapped.shp").substr(0, 60));
  EXPECT_HAS(expect_code(5, call("import broken.shp --out floes.geojson")).err,
             "broken.shp: ogr2ogr could not read it: ");
}

TEST_F(Import, WithoutOgr2ogrAMessageNamesThePackage) {
  write("mapped.gpkg", std::string("SQLite format 3\0 and more", 25));
  const Outcome outcome = polynya("import mapped.gpkg --out floes.geojson",
                                  {.folder = folder.path(), .arrange_streams = [] { setenv("PATH", "/nowhere", 1); }});
  EXPECT_HAS(expect_code(5, outcome).err, "mapped.gpkg: a GeoPackage is read by GDAL's ogr2ogr, which is not there",
             "apt-get install gdal-bin");
}

}  // namespace
}  // namespace polynya::tests
