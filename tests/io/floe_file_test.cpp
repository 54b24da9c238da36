// Floe files of scenes whose coordinates are no metres, or whose floes are those of a run.
#include <algorithm>

#include "temporary_folder.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "io/scene/scene_reader.hpp"

namespace polynya::io {
namespace {

using tests::TemporaryFolder;
using tests::write_file;

class FloeFile : public testing::Test {
 protected:
  /// What is wrong with a scene of that floe file, a line each.
  std::string problems(const std::string& geojson) const {
    write_file(folder / "floes.geojson", geojson);
    const auto outcome = read_scene(R"({"floes": [{"file": "floes.geojson"}]})", "scene.json", folder.path());
    std::string text;
    if (outcome) return text;
    for (const Problem& problem : outcome.error()) text += to_string(problem) + "\n";
    return text;
  }
  TemporaryFolder folder;
};

/// A square floe; its side in the units of its corner.
std::string square(double x, double y, double side, const std::string& properties = "") {
  return fmt::format(R"({{"type":"Feature","properties":{{{}}},"geometry":{{"type":"Polygon","coordinates":)"
                     R"([[[{},{}],[{},{}],[{},{}],[{},{}],[{},{}]]]}}}})",
                     properties, x, y, x + side, y, x + side, y + side, x, y + side, x, y);
}
std::string collection(const std::vector<std::string>& features, const std::string& members = "") {
  return fmt::format(R"({{"type":"FeatureCollection",{}"features":[{}]}})", members,
                     fmt::join(features, ","));
}
std::string crs(const std::string& name) {
  return R"("crs":{"type":"name","properties":{"name":")" + name + R"("}},)";
}
std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

TEST_F(FloeFile, LongitudeAndLatitudeAreRefusedOnceWithWhatToDo) {
  const std::string degrees = collection({square(15.61, 78.201, 0.002), square(15.62, 78.203, 0.004)});
  const std::string found = problems(degrees);
  EXPECT_EQ(lines_in(found), 1U) << found;
  for (const char* part :
       {"floes.geojson:1:1: ", "longitude and latitude", "2e-05 m²", "+lat_0=78.2 +lon_0=15.617", "ogr2ogr"})
    EXPECT_NE(found.find(part), std::string::npos) << part << "\n" << found;
  for (const std::string& large : {collection({square(-150, 71, 3), square(-140, 71, 3)}),  // 60 000 km²
                                   collection({square(-65, -70, 0.5)}), collection({square(12, 1, 0.5)})})
    EXPECT_NE(problems(large).find("longitude and latitude"), std::string::npos) << large;
}

TEST_F(FloeFile, ACrsDecidesWhereThereIsOne) {
  for (const char* name : {"urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326", "urn:ogc:def:crs:EPSG::4269",
                           "http://www.opengis.net/def/crs/OGC/1.3/CRS84", "WGS 84"}) {
    const std::string found = problems(collection({square(0, 0, 800)}, crs(name)));
    EXPECT_NE(found.find(fmt::format("crs: longitude and latitude ({})", name)), std::string::npos) << found;
    EXPECT_EQ(lines_in(found), 1U) << found;
  }
  for (const char* name : {"urn:ogc:def:crs:EPSG::3413", "EPSG:32633", "metres of the ice tank"})
    EXPECT_EQ(problems(collection({square(15, 78, 0.2)}, crs(name))), "") << name;
  EXPECT_NE(problems(R"({"crs":{"type":"EPSG","properties":{"code":4326}},)" + square(0, 0, 9).substr(1)),
            "");
}

/// Small scenes in metres stay what they are: a tank, floes near the origin, what Polynya wrote itself.
TEST_F(FloeFile, SmallScenesInMetresAreNotTakenForDegrees) {
  for (const std::string& metres :
       {collection({square(0, 0, 10)}), collection({square(1, 1, 1), square(3, 1, 0.5)}),
        collection({square(-170, -80, 20), square(100, 50, 30)}), collection({square(10, 45, 11)}),
        collection({square(-0.2, -0.2, 0.4, R"("floe_id":1,"area_m2":0.16000000000000003)")}),
        collection({square(200, 500, 0.1)}), collection({square(0, -95, 0.2)})})
    EXPECT_EQ(problems(metres), "") << metres;
}

TEST_F(FloeFile, CoordinatesTooFarAwayAreNamedOnce) {
  const std::string found =
      problems(collection({square(0, 0, 5), square(1104312.5, -512345.25, 800), square(1.2e6, 0, 800)}));
  EXPECT_EQ(lines_in(found), 1U) << found;
  for (const char* part :
       {"found [1104312.5, -512345.25], and as far in 1 more", "-1000000 to 1000000", "ogr2ogr"})
    EXPECT_NE(found.find(part), std::string::npos) << part << "\n" << found;
  EXPECT_NE(problems(collection({R"({"type":"Polygon","coordinates":[[[0,0],[null,0],[1,1],[0,0]]]})"}))
                .find("found null, allowed: a coordinate [m]"),
            std::string::npos);
}

/// A run's floes overlap where they are in contact: one problem, not one a pair. The overlaps of any other
/// file stay problems of their own, and a run's floes that do not overlap are floes like others.
TEST_F(FloeFile, TheFloesOfARunAreRefusedInOneSentence) {
  const auto features = [](double side, bool are_of_a_run) {
    std::vector<std::string> all;
    for (int i = 0; i < 6; ++i) {
      const std::string properties = fmt::format(R"("floe_id":{},"parent_id":null,"born_s":0)", i);
      all.push_back(square(100.0 * i, 0, side, are_of_a_run ? properties : ""));
    }
    return all;
  };
  const std::string found = problems(collection(features(100.01, true), R"("t_s":120.5,)"));
  EXPECT_EQ(lines_in(found), 1U) << found;
  for (const char* part :
       {"the floes of a run at 120.5 s, of which 5 pairs overlap, by at most 1 m²", "polynya resume"})
    EXPECT_NE(found.find(part), std::string::npos) << found;
  EXPECT_EQ(problems(collection(features(99.9, true), R"("t_s":120.5,)")), "");
  EXPECT_EQ(lines_in(problems(collection(features(100.01, false)))), 5U);
}

}  // namespace
}  // namespace polynya::io
