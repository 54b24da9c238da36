// `polynya import` as a user calls it.
#include <cstdlib>

#include "program.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "geometry/exact/measures.hpp"
#include "io/scene/scene_file.hpp"
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
  // A second import has nothing left to repair.
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
    EXPECT_HAS(done({"import", name, "--out", "floes.geojson"}).err, name + ": WGS 84, projected about 78.20",
               "the floes' middle");
    EXPECT_NEAR(area_of(scene()->scene), area, 0.1) << name;
  }
  // A system without a code is converted; a file without a system is not in degrees.
  ASSERT_TRUE(convert("-t_srs '+proj=laea +lat_0=78 +lon_0=15 +datum=WGS84' own.shp mapped.geojson"));
  EXPECT_HAS(done("import own.shp --origin 78.2,15.6 --out floes.geojson").err, "3 floes read, 1 trimmed; 3 written");
  write("broken.shp", read("mapped.shp").substr(0, 60));
  EXPECT_HAS(expect_code(5, call("import broken.shp --out floes.geojson")).err, "broken.shp: GDAL could not read it: ");
}

/// The polygons of a shapefile, a GeoPackage with curves, GML, KML, FlatGeobuf, CSV and a zipped shapefile: holes,
/// several polygons of a feature, third coordinates, a surface with arcs, an empty geometry, and no coordinate system.
TEST_F(Import, EveryFormatOfGdalGivesTheSameFloes) {
  write("drawn.csv",
        "name,thickness_m,WKT\n"
        "a,0.5,\"POLYGON Z((0 0 1,40 0 2,40 20 3,0 20 1,0 0 1))\"\n"
        "b,0.7,\"MULTIPOLYGON(((100 0,120 0,120 20,100 20,100 0),(105 5,105 15,115 15,115 5,105 5)),((130 0,140 0,140 "
        "9,130 0)))\"\n"
        "c,0.8,\"POLYGON EMPTY\"\n"
        "d,,\"MULTISURFACE(((200 0,220 0,220 20,200 20,200 0)),CURVEPOLYGON(CIRCULARSTRING(300 0,310 10,320 0,310 "
        "-10,300 0)))\"\n");
  constexpr double kFlat = 800 + 300 + 45 + 400, kDisc = 314.159;
  const auto area_of_file = [&](const std::string& file, const Words& more = {}) {
    const Outcome imported = call(Words{"import", file, "--out", "floes.geojson"} + more);
    EXPECT_TRUE(imported.code == 0 || imported.code == 4) << file << imported.err;
    const auto floes = scene();
    return floes ? area_of(floes->scene) : -1;
  };
  // An arc of a circle is read as 90 straight edges.
  EXPECT_NEAR(area_of_file("drawn.csv"), kFlat + kDisc, 0.3);
  EXPECT_HAS(call("import drawn.csv --out floes.geojson").err, "property \"thickness_m\" of 4 floes is text, \"0.5\"",
             "refused: ");
  for (const char* words : {"curves.gpkg drawn.csv -nln ice -a_srs EPSG:3413", "drawn.gml drawn.csv -a_srs EPSG:3413",
                            "flat.shp drawn.csv -nlt MULTIPOLYGON -lco ENCODING=UTF-8",
                            "flat.fgb drawn.csv -nlt MULTIPOLYGON -dim XY -lco SPATIAL_INDEX=NO",
                            "flat.sqlite drawn.csv -nlt MULTIPOLYGON -f SQLite"}) {
    ASSERT_TRUE(convert(words)) << words;
    const std::string file = std::string(words).substr(0, std::string(words).find(' '));
    EXPECT_NEAR(area_of_file(file), kFlat + kDisc, 0.3) << file;
  }
  std::filesystem::create_directory(folder / "shapes");
  ASSERT_TRUE(convert("shapes/flat.shp drawn.csv -nlt MULTIPOLYGON"));
  EXPECT_NEAR(area_of_file("shapes"), kFlat + kDisc, 0.3) << "a folder of shapefiles";
  // Files in degrees: KML, whose coordinates are always degrees, in an archive, and a GeoPackage. GDAL projects arcs
  // wrongly, so arcs are converted to lines first.
  ASSERT_TRUE(convert("linear.gpkg drawn.csv -nlt CONVERT_TO_LINEAR"));
  const std::string to_degrees = " linear.gpkg -s_srs '+proj=aeqd +lat_0=78 +lon_0=15 +datum=WGS84' -t_srs EPSG:4326";
  for (const std::string file : {"degrees.kml", "degrees.kmz", "degrees.gpkg"}) {
    ASSERT_TRUE(convert(file + to_degrees + (file == "degrees.kmz" ? " -f LIBKML" : ""))) << file;
    EXPECT_NEAR(area_of_file(file, "--origin 78,15"), kFlat + kDisc, 0.3) << file;
  }
}

TEST_F(Import, TextsOfOtherKindsAreReadByGdalToo) {
  write("ewkt.wkt", "SRID=3413;POLYGON ((0 0, 30 0, 30 30, 0 30, 0 0))");
  EXPECT_HAS(done("import ewkt.wkt --origin 90,0 --out floes.geojson").err, "NSIDC Sea Ice Polar Stereographic North");
  write("topology.json", R"({"type":"Topology","objects":{"ice":{"type":"GeometryCollection","geometries":[)"
                         R"({"type":"Polygon","arcs":[[0]]}]}},)"
                         R"("arcs":[[[0,0],[30,0],[30,30],[0,30],[0,0]]]})");
  EXPECT_HAS(done("import topology.json --out floes.geojson").err, "1 floe read; 1 written");
  write("table.csv", "a,b\n1,2\n");
  EXPECT_HAS(expect_code(5, call("import table.csv --out floes.geojson")).err, "it has no layer with polygons",
             "table (None, 1 feature)");
}

TEST_F(Import, LayersAreListedAndNamed) {
  write("mapped.geojson", collection_of(square(0, 0, 10) + "," + square(20, 0, 10)));
  write("water.geojson", collection_of(square(50, 0, 30)));
  write("track.geojson",
        R"({"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[0,0],[9,9]]}})");
  ASSERT_TRUE(convert("two.gpkg mapped.geojson -nln ice -a_srs EPSG:3413"));
  ASSERT_TRUE(convert("-append two.gpkg track.geojson -nln track -a_srs EPSG:3413"));
  EXPECT_HAS(done("import two.gpkg --out floes.geojson").err, "the layer \"ice\" was taken; its layers: ice (",
             "track (");
  ASSERT_TRUE(convert("-append two.gpkg water.geojson -nln \"open water\" -a_srs EPSG:3413"));
  const std::string layers =
      "ice (Polygon, 2 features), track (Line String, 1 feature), open water (Polygon, 1 feature)";
  EXPECT_HAS(expect_code(5, call("import two.gpkg --out floes.geojson")).err,
             "it has several layers: " + layers + "; --layer NAME chooses one");
  EXPECT_HAS(done(Words("import two.gpkg --out floes.geojson --layer") + Words{"open water"}).err, "1 floe read");
  EXPECT_HAS(expect_code(5, call("import two.gpkg --out floes.geojson --layer Ice")).err,
             "it has no layer \"Ice\", did you mean \"ice\"?; its layers: " + layers);
  EXPECT_HAS(expect_code(2, call("import mapped.geojson --out floes.geojson --layer ice")).err, "have no layers");
}

/// An ice chart as national services publish it (SIGRID-3): codes are texts, and -9 and "99" mean missing values.
std::string chart() {
  const auto polygon = [](double x, const std::string& type, const std::string& stage, const std::string& area) {
    return square(x, 78, 0.02, fmt::format(R"("POLY_TYPE":"{}","CT":"92","SA":{},"AREA":{})", type, stage, area));
  };
  return collection_of(polygon(15.00, "I", R"("93")", "1.5") + ",\n" + polygon(15.02, "I", R"("87")", "-9999") + ",\n" +
                       polygon(15.04, "I", R"("99")", "2") + ",\n" + polygon(15.06, "I", R"("-9")", "2") + ",\n" +
                       polygon(15.08, "W", R"("-9")", "3") + ",\n" + polygon(15.10, "L", "null", "4"));
}

TEST_F(Import, AnIceChartBecomesFloesByOneCommand) {
  write("chart.geojson", chart());
  ASSERT_TRUE(convert("chart.shp chart.geojson"));
  ASSERT_TRUE(convert("chart.gpkg chart.geojson"));
  for (const std::string file : {"chart.shp", "chart.gpkg", "chart.geojson"}) {
    const Outcome imported =
        done(Words{"import", file, "--where", "POLY_TYPE = 'I'", "--nodata", "-9,-9999", "--property",
                   "thickness_m=SA[87:0.5 91:0.95 93:1.6]", "--origin", "78,15", "--out", "floes.geojson"});
    EXPECT_HAS(imported.err, "4 of 6 features were taken, where POLY_TYPE = 'I'",
               "property \"SA\" of 1 floe is \"-9\", which stands for no value: no thickness_m was read",
               "property \"SA\" of 1 floe is a code that is not listed, \"99\": no thickness_m was read",
               "4 floes read; 4 written", "2 of 4 floes have a thickness");
    EXPECT_HAS(imported.out, "\"notes\":[\"4 of 6 features were taken");
    EXPECT_HAS(read("floes.geojson"), R"("thickness_m":1.6,"POLY_TYPE":"I","CT":"92","SA":"93")");
  }
  // The reported line of a selected feature is its line in the file.
  write("chart.geojson", chart() + "");
  EXPECT_HAS(
      expect_code(4, call({"import", "chart.geojson", "--where", "POLY_TYPE = 'I'", "--property", "thickness_m=AREA",
                           "--origin", "78,15", "--out", "floes.geojson"}))
          .err,
      "chart.geojson:2: feature 1, polygon 0: refused: property AREA: found -9999, allowed: a number from 0.001 to "
      "20 [m]; if that stands for no value: --nodata -9999");
  EXPECT_HAS(
      expect_code(5, call({"import", "chart.geojson", "--where", "POLYTYPE = 'I'", "--out", "floes.geojson"})).err,
      "chart.geojson: --where: ", "\"POLYTYPE\" not recognised");
  EXPECT_HAS(expect_code(5, call({"import", "chart.shp", "--where", "POLY_TYPE =", "--out", "floes.geojson"})).err,
             "chart.shp: GDAL could not read it: ");
}

TEST_F(Import, ASceneTakesOfAChartWhatItsEntrySelects) {
  write("chart.geojson", chart());
  const auto loaded = checked(io::read_scene(
      R"({"origin": {"latitude_deg": 78, "longitude_deg": 15}, "floes": [{"file": "chart.geojson", "import":
        {"where": "POLY_TYPE = 'I'", "nodata": [-9], "properties": "thickness_m=SA[87:0.5 93:1.6]"}}]})",
      "scene.json", folder.path()));
  EXPECT_EQ(loaded->scene.floes.size(), 4U);
  EXPECT_EQ(loaded->files.at(0).with_thickness, 2U);
  std::string hints;
  for (const io::Problem& hint : loaded->hints) hints += to_string(hint) + "\n";
  EXPECT_HAS(hints, "4 of 6 features were taken", "is a code that is not listed");
}

TEST_F(Import, NumbersThatAreTextsAreNumbers) {
  const auto floe = [&](const std::string& thickness) {
    return collection_of(square(0, 0, 10, "\"thickness_m\":" + thickness));
  };
  for (const char* number : {R"("0.8")", R"(" 0.8 ")", R"("8e-1")", R"("+.8")"}) {
    EXPECT_HAS(expect_code(0, import(floe(number))).err, "is text, ", "it was read as a number");
    EXPECT_HAS(read("floes.geojson"), R"("thickness_m":0.8)") << number;
  }
  EXPECT_HAS(expect_code(0, import(floe(R"("")"))).err, "has no thickness of its own");
  for (const char* number : {R"("0,8")", R"("0.8 m")", R"("inf")", R"("nan")", R"("0x1")", "true"})
    EXPECT_HAS(expect_code(4, import(floe(number))).err, "property thickness_m: found ");
}

/// An id that is not a unique integer is kept under another key, and one line of output reports this.
TEST_F(Import, IdsThatCannotBeKeptAreKeptUnderAnotherKey) {
  const auto floes = [&](const std::string& first, const std::string& second, const std::string& more = "") {
    return collection_of(square(0, 0, 10, first) + "," + square(20, 0, 10, second) + more);
  };
  struct Case {
    std::string text, why;
    std::vector<std::string> kept;
  };
  for (const Case& one : std::vector<Case>{
           {floes(R"("floe_id":"A1")", R"("floe_id":"A2")"),
            "2 are text (\"A1\")",
            {R"("source_id":"A1")", R"("source_id":"A2")"}},
           {floes(R"("floe_id":3.5)", R"("floe_id":7)"),
            "1 is no whole number from 0 on (3.5)",
            {R"("source_id":3.5)", R"("source_id":7)"}},
           {floes(R"("floe_id":-3)", R"("floe_id":7)"), "1 is no whole number from 0 on (-3)", {R"("source_id":-3)"}},
           {floes(R"("floe_id":7)", R"("floe_id":7)"), "1 is the number of an earlier floe (7)", {R"("source_id":7)"}},
           {floes(R"("floe_id":9007199254740993)", R"("floe_id":1)"),
            "1 is beyond 2^53 (9007199254740993)",
            {R"("source_id":9007199254740993)"}},
           {floes(R"("floe_id":7)", ""), "1 floe has none", {R"("source_id":7)"}},
           {floes(R"("floe_id":"A1","source_id":"B")", R"("floe_id":2)"),
            "1 is text",
            {R"("source_id_":"A1")", R"("source_id":"B")"}},
           {R"({"type":"Feature","id":"f.1",)" + square(0, 0, 10).substr(18),
            "1 is text (\"f.1\")",
            {R"("source_id":"f.1")"}}}) {
    for (const std::string& command : {std::string("import"), std::string("cut")}) {
      write("mapped.geojson", one.text);
      const Outcome outcome =
          done(command == "cut" ? Words("cut mapped.geojson --crack 5,5,30 --out floes.geojson --ledger l.json")
                                : Words("import mapped.geojson --out floes.geojson"));
      EXPECT_HAS(outcome.err, "note: mapped.geojson: floe_id: " + one.why, "floes are numbered");
      for (const std::string& kept : one.kept) EXPECT_HAS(read("floes.geojson"), kept) << command;
    }
  }
  for (const std::string& usable : {floes(R"("floe_id":7)", R"("floe_id":5)"), floes("", "")})
    EXPECT_LACKS(expect_code(0, import(usable)).err, "floe_id: ");
  write("floes.geojson", floes(R"("floe_id":"A1")", R"("floe_id":"A2")"));
  std::string hints;
  const auto loaded = checked(scene());
  for (const io::Problem& hint : loaded->hints) hints += to_string(hint);
  EXPECT_HAS(hints, "hint: floes[0].file: floe_id: 2 are text (\"A1\")");
  // The property may also have another name.
  EXPECT_HAS(expect_code(0, import(floes(R"("FID":"A1")", R"("FID":"A2")"), "--property floe_id=FID")).err,
             "read; 2 written");
  EXPECT_HAS(read("floes.geojson"), R"("FID":"A1")");
}

/// Polygons that were cut at longitude 180, parts of a feature that touch, and a slit to the pole.
TEST_F(Import, PartsThatWereCutAreJoinedWhereAsked) {
  const auto ring = [](std::vector<std::pair<double, double>> points) {
    std::string text;
    points.push_back(points.front());
    for (const auto& [x, y] : points) text += fmt::format("{}[{},{}]", text.empty() ? "" : ",", x, y);
    return "[[" + text + "]]";
  };
  // The western half has vertices on the seam that the eastern has not.
  const std::string west = ring({{179.99, 75}, {180, 75}, {180, 75.004}, {180, 75.01}, {179.99, 75.01}});
  const std::string east = ring({{-180, 75}, {-179.98, 75.002}, {-180, 75.01}});
  const auto feature = [](const std::string& type, const std::string& coordinates, const std::string& properties = "") {
    return fmt::format(R"({{"type":"Feature","properties":{{{}}},"geometry":{{"type":"{}","coordinates":{}}}}})",
                       properties, type, coordinates);
  };
  struct Case {
    std::string text;
    std::size_t floes;
  };
  const std::string two = feature("Polygon", west, R"("thickness_m":1)") + ",";
  for (const Case& one : std::vector<Case>{
           {feature("MultiPolygon", "[" + west + "," + east + "]"), 1},
           {two + feature("Polygon", east, R"("thickness_m":1)"), 1},
           {two + feature("Polygon", east, R"("thickness_m":2)"), 2},
           {feature("MultiPolygon", "[" + ring({{10, 75}, {10.01, 75}, {10.01, 75.01}, {10, 75.01}}) + "," +
                                        ring({{10.01, 75}, {10.02, 75}, {10.02, 75.01}, {10.01, 75.01}}) + "," +
                                        ring({{10.03, 75}, {10.04, 75}, {10.04, 75.01}}) + "]"),
            2}}) {
    const std::string text = collection_of(one.text);
    const std::string origin =
        one.text.find("[10.01,75]") != std::string::npos ? "--origin 75,10 " : "--origin 75,180 ";
    const Outcome apart = expect_code(0, import(text, Words(origin)));
    const double area = area_of(checked(scene())->scene);
    const Outcome together = expect_code(0, import(text, Words(origin + "--join 0.01")));
    const auto joined = checked(scene());
    EXPECT_EQ(joined->scene.floes.size(), one.floes) << together.err;
    EXPECT_NEAR(area_of(joined->scene), area, 10);
    if (one.floes == 1) {
      EXPECT_HAS(together.err, "1 joined to others", "joined with 1 polygon");
    }
    for (const simulation::FloeSpec& floe : joined->scene.floes) EXPECT_TRUE(floe.polygon_in_world.holes.empty());
  }
  // A disc about the pole with a slit of 1e-10 degrees.
  std::string disc;
  for (int lon = 0; lon < 360; lon += 20) disc += fmt::format("[{},89.99],", lon);
  const std::string slit =
      R"({"type":"Polygon","coordinates":[[)" + disc + "[359.9999,89.99],[359.9999,89.9999],[0,89.9999],[0,89.99]]]}";
  import(slit, "--origin 90,0");
  const std::size_t before = checked(scene())->scene.floes.at(0).polygon_in_world.outer.size();
  EXPECT_HAS(expect_code(0, import(slit, "--origin 90,0 --join 0.01")).err, "a slit in it was closed");
  EXPECT_LT(checked(scene())->scene.floes.at(0).polygon_in_world.outer.size(), before);
  // Neighbours that touch are other floes.
  EXPECT_HAS(import(collection_of(square(0, 0, 10) + "," + square(10, 0, 10)), "--join 0.01").err,
             "2 floes read; 2 written");
}

TEST_F(Import, WithoutOgr2ogrAMessageNamesThePackage) {
  write("mapped.gpkg", std::string("SQLite format 3\0 and more", 25));
  const Outcome outcome = polynya("import mapped.gpkg --out floes.geojson",
                                  {.folder = folder.path(), .arrange_streams = [] { setenv("PATH", "/nowhere", 1); }});
  EXPECT_HAS(expect_code(5, outcome).err, "mapped.gpkg: ", "ogr2ogr", "apt-get install gdal-bin");
}

}  // namespace
}  // namespace polynya::tests
