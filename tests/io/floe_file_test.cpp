// Floe files of scenes whose coordinates are no metres, or whose floes are those of a run.
#include <algorithm>

#include "temporary_folder.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "geometry/exact/measures.hpp"
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
  for (const char* part : {"floes.geojson:1:1: ", "longitude and latitude", "2e-05 m²",
                           R"("origin": {"latitude_deg": 78.203, "longitude_deg": 15.616} in the scene)"})
    EXPECT_NE(found.find(part), std::string::npos) << part << "\n" << found;
  for (const std::string& large : {collection({square(-150, 71, 3), square(-140, 71, 3)}),  // 60 000 km²
                                   collection({square(-65, -70, 0.5)}), collection({square(12, 1, 0.5)})})
    EXPECT_NE(problems(large).find("longitude and latitude"), std::string::npos) << large;
}

TEST_F(FloeFile, ACrsDecidesWhereThereIsOne) {
  for (const char* name : {"urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326", "urn:ogc:def:crs:EPSG::4269",
                           "http://www.opengis.net/def/crs/OGC/1.3/CRS84", "WGS 84"}) {
    const std::string found = problems(collection({square(0, 0, 8)}, crs(name)));
    EXPECT_NE(found.find("longitude and latitude ("), std::string::npos) << name << found;
    EXPECT_NE(found.find("no origin"), std::string::npos) << name << found;
    EXPECT_EQ(lines_in(found), 1U) << found;
  }
  for (const char* name : {"urn:ogc:def:crs:EPSG::3413", "EPSG:32633"})
    EXPECT_EQ(problems(collection({square(15, 78, 0.2)}, crs(name))), "") << name;
  for (const std::string name : {"EPSG:99999", "+proj=nonsense", "metres of the ice tank"}) {
    const std::string found = problems(collection({square(15, 78, 0.2)}, crs(name)));
    EXPECT_NE(found.find("PROJ knows no coordinate system \"" + name + "\", allowed: EPSG:n"),
              std::string::npos)
        << found;
  }
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
       {"found [1104312.5, -512345.25], and as far in 1 more", "-1e+06 to 1e+06", R"("shift": true)"})
    EXPECT_NE(found.find(part), std::string::npos) << part << "\n" << found;
  EXPECT_NE(problems(collection({square(0, 0, 5), square(9, 0, 5), square(1.2e6, 0, 800)}))
                .find("floes[0].file (its floe 2): found [1200000, 0], allowed"),
            std::string::npos);
  EXPECT_NE(problems(collection({R"({"type":"Polygon","coordinates":[[[0,0],[null,0],[1,1],[0,0]]]})"}))
                .find("found null, allowed: a coordinate [m]"),
            std::string::npos);
}

/// A run's floes overlap where they are in contact, by the ice that was crushed there. The overlaps of any
/// other file are problems, and the same ice twice is.
TEST_F(FloeFile, TheFloesOfARunMayOverlapAsItLeftThem) {
  const auto features = [](double side, bool are_of_a_run) {
    std::vector<std::string> all;
    for (int i = 0; i < 6; ++i) {
      const std::string properties =
          fmt::format(R"("floe_id":{},"parent_id":null,"born_s":0,"vx_m_per_s":0.25,"vy_m_per_s":0,)"
                      R"("angular_velocity_deg_per_s":3,"fast_ice":{})",
                      10 + i, i == 0);
      all.push_back(square(100.0 * i, 0, side, are_of_a_run ? properties : ""));
    }
    return all;
  };
  EXPECT_EQ(problems(collection(features(100.01, true), R"("t_s":120.5,)")), "");
  EXPECT_EQ(lines_in(problems(collection(features(100.01, false)))), 5U);
  EXPECT_NE(problems(collection(features(2000, true), R"("t_s":120.5,)")).find("an overlap with"),
            std::string::npos)
      << "nearly all of a floe is not what was crushed";

  write_file(folder / "floes.geojson", collection(features(100.01, true), R"("t_s":120.5,)"));
  const auto scene = read_scene(R"({"water": {"drift_m_per_s": [0.05, -0.25]},
    "floes": [{"file": "floes.geojson", "velocity_m_per_s": [9, 9]}]})",
                                "scene.json", folder.path());
  ASSERT_TRUE(scene) << to_string(scene.error().front());
  const simulation::FloeSpec& fast = scene->scene.floes[0];
  const simulation::FloeSpec& free = scene->scene.floes[1];
  EXPECT_TRUE(fast.is_fast && !free.is_fast && free.has_crushed_overlaps);
  EXPECT_EQ(fast.velocity, (geometry::Vector{0.25, 0})) << "over ground";
  EXPECT_EQ(free.velocity, (geometry::Vector{0.2, 0.25})) << "relative to the water";
  EXPECT_EQ(fast.angular_velocity, 0);
  EXPECT_NEAR(free.angular_velocity, 0.0523598775598, 1e-12);
  EXPECT_EQ(free.source_floe, 11);
  const auto again = read_scene(scene->resolved_text, "scene.json", folder.path());
  ASSERT_TRUE(again);
  EXPECT_EQ(again->hash, scene->hash);
  EXPECT_TRUE(again->scene == scene->scene);
}

TEST_F(FloeFile, ASceneWithAnOriginProjectsDegrees) {
  write_file(folder / "floes.geojson", collection({square(15.6, 78.2, 0.001), square(15.61, 78.2, 0.001)}));
  const auto scene = read_scene(R"({"origin": {"latitude_deg": 78.2, "longitude_deg": 15.6},
    "floes": [{"file": "floes.geojson"}]})",
                                "scene.json", folder.path());
  ASSERT_TRUE(scene) << to_string(scene.error().front());
  const auto& ring = scene->scene.floes[0].polygon_in_world.outer;
  EXPECT_NEAR(ring[1].x - ring[0].x, 22.8378, 1e-3);
  EXPECT_NEAR(ring[2].y - ring[1].y, 111.6468, 1e-3);
  EXPECT_EQ(scene->files.at(0).plane.system, "WGS 84 (CRS84)");
  const auto south = read_scene(R"({"origin": {"latitude_deg": -75, "longitude_deg": 15.6},
    "floes": [{"file": "floes.geojson"}]})",
                                "scene.json", folder.path());
  ASSERT_FALSE(south);
  EXPECT_NE(to_string(south.error().front()).find("in the other hemisphere"), std::string::npos);
}

/// One wrong number among degrees: its floe is named, and the others are not taken for metres.
TEST_F(FloeFile, AWrongLatitudeIsAProblemOfItsFloe) {
  const std::string wrong =
      R"({"type":"Polygon","coordinates":[[[15.61,78.2],[15.612,782],[15.612,78.202],[15.61,78.2]]]})";
  for (const char* entry :
       {R"({"file": "floes.geojson"})", R"({"file": "floes.geojson", "import": {"repair": "non-zero"}})"}) {
    for (const std::string& name : {std::string(), crs("EPSG:4326")}) {
      const std::string scene = fmt::format(
          R"({{"origin": {{"latitude_deg": 78.2, "longitude_deg": 15.6}}, "floes": [{}]}})", entry);
      write_file(folder / "floes.geojson", collection({square(15.6, 78.2, 0.001), wrong}, name));
      const auto refused = read_scene(scene, "scene.json", folder.path());
      ASSERT_FALSE(refused) << entry << name;
      ASSERT_EQ(refused.error().size(), 1U);
      const std::string found = to_string(refused.error().front());
      EXPECT_NE(found.find("(its floe 1): found [15.612, 782], allowed: [longitude, latitude]"),
                std::string::npos)
          << found;
      write_file(folder / "floes.geojson",
                 collection({square(15.6, 78.2, 0.001), square(375.61, 78.2, 0.001)}, name));
      const auto turned = read_scene(scene, "scene.json", folder.path());
      ASSERT_TRUE(turned) << to_string(turned.error().front());
      for (const simulation::FloeSpec& floe : turned->scene.floes)
        EXPECT_NEAR(geometry::measure(floe.polygon_in_world).area, 22.8378 * 111.6468, 2);
    }
  }
}

TEST_F(FloeFile, PropertiesThatAreNearlyReadAreWarnedOf) {
  write_file(folder / "floes.geojson",
             collection({square(0, 0, 5, R"("thickness_cm":80)"), square(9, 0, 5, R"("thickness_m":0.4)")}));
  const auto scene = read_scene(R"({"floes": [{"file": "floes.geojson"}]})", "scene.json", folder.path());
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->files.at(0).with_thickness, 1U);
  std::string hints;
  for (const Problem& hint : scene->hints) hints += to_string(hint) + "\n";
  for (const char* part :
       {R"(warning: floes[0].file: property "thickness_cm" of 1 floe is not read; did you mean thickness_m?)",
        R"("import": {"properties": "thickness_m=thickness_cm*0.01"} reads it)",
        "reads it; 1 of 2 floes has a thickness of its own"})
    EXPECT_NE(hints.find(part), std::string::npos) << part << "\n" << hints;
  const auto named = read_scene(
      R"({"floes": [{"file": "floes.geojson", "import": {"properties": "thickness_m=thickness_cm*0.01"}}]})",
      "scene.json", folder.path());
  ASSERT_TRUE(named);
  EXPECT_EQ(named->scene.floes.size(), 2U);
}

/// An entry's import does what `polynya import` does, and its resolved scene gives the same floes.
TEST_F(FloeFile, AnImportRepairsTrimsAndReports) {
  const std::string bow = R"({"type":"Polygon","coordinates":[[[60,0],[64,3],[64,0],[60,3],[60,0]]]})";
  write_file(folder / "floes.geojson",
             collection({square(0, 0, 10), square(8, 0, 4, R"("THICK":80)"), bow, square(100, 0, 1)}));
  const auto scene = read_scene(R"({"floes": [{"file": "floes.geojson", "import":
    {"repair": "even-odd", "min_area_m2": 2, "properties": "thickness_m=THICK*0.01"}}]})",
                                "scene.json", folder.path());
  ASSERT_TRUE(scene) << to_string(scene.error().front());
  EXPECT_EQ(scene->scene.floes.size(), 4U);
  const ImportTotals& totals = scene->files.at(0).totals.value();
  EXPECT_EQ(totals.trimmed + totals.repaired + totals.dropped, 3U);
  EXPECT_EQ(totals.area_trimmed, 8);
  const auto again = read_scene(scene->resolved_text, "scene.json", folder.path());
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->scene == scene->scene);
  const auto refused =
      read_scene(R"({"floes": [{"file": "floes.geojson", "import": {}}]})", "scene.json", folder.path());
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.error().front()).find("self-crossing"), std::string::npos);
  EXPECT_NE(to_string(refused.error().front()).find(R"("repair": "non-zero")"), std::string::npos);
}

TEST_F(FloeFile, APlaneOfItsOwnIsRefusedBesideTheScenesOrigin) {
  write_file(folder / "floes.geojson", collection({square(0, 0, 10)}));
  const auto scene = read_scene(R"({"origin": {"latitude_deg": 75, "longitude_deg": 15.6},
    "floes": [{"file": "floes.geojson", "import": {"crs": "EPSG:3413"}}]})",
                                "scene.json", folder.path());
  ASSERT_FALSE(scene);
  const std::string found = to_string(scene.error().front());
  EXPECT_NE(found.find("import.crs in a scene that has an origin"), std::string::npos) << found;
}

TEST_F(FloeFile, PropertiesOfTheWrongTypeOrSignAreRefusedAtTheirPlace) {
  const std::string found = problems(
      collection({square(0, 0, 5, R"("thickness_m":-0.5)"), square(9, 0, 5, R"("vx_m_per_s":"fast")")}));
  EXPECT_NE(
      found.find("features[0].properties.thickness_m: found -0.5, allowed: a number from 0.001 to 20 [m]"),
      std::string::npos)
      << found;
  EXPECT_NE(found.find("features[1].properties.vx_m_per_s: found \"fast\""), std::string::npos) << found;
}

}  // namespace
}  // namespace polynya::io
