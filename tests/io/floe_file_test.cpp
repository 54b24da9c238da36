// Floe files of scenes whose coordinates are not in metres, or whose floes come from a run.
#include <algorithm>

#include "scene_text.hpp"
#include "temporary_folder.hpp"

#include "geometry/exact/measures.hpp"
#include "io/import/floe_properties.hpp"
#include "io/run/records.hpp"
#include "io/scene/scene_input.hpp"
#include "simulation/simulation.hpp"

namespace polynya::io {
namespace {

using namespace tests;

class FloeFile : public testing::Test {
 protected:
  /// Reads a scene with the given floe file, optionally with further members of the file's entry and of the scene.
  SceneOutcome read_file(const std::string& geojson, const std::string& entry = "",
                         const std::string& more = "") const {
    write_file(folder / "floes.geojson", geojson);
    return read_scene("{" + more + R"("floes": [{"file": "floes.geojson")" + entry + "}]}", "scene.json",
                      folder.path());
  }
  std::string problems(const std::string& geojson, const std::string& entry = "", const std::string& more = "") const {
    const auto outcome = read_file(geojson, entry, more);
    return outcome ? "" : in_words(outcome.error());
  }
  LoadedScene sound(const std::string& geojson, const std::string& entry = "", const std::string& more = "") const {
    return std::move(*checked(read_file(geojson, entry, more)));
  }
  TemporaryFolder folder;
};

const std::string kOrigin = R"("origin": {"latitude_deg": 78.2, "longitude_deg": 15.6}, )";

/// Returns a square floe. Its side is in the units of its corner.
std::string floe(double x, double y, double side, const std::string& properties = "") {
  return fmt::format(R"({{"type":"Feature","properties":{{{}}},"geometry":{{"type":"Polygon","coordinates":)"
                     R"([[[{},{}],[{},{}],[{},{}],[{},{}],[{},{}]]]}}}})",
                     properties, x, y, x + side, y, x + side, y + side, x, y + side, x, y);
}
std::string collection(const std::vector<std::string>& features, const std::string& members = "") {
  return fmt::format(R"({{"type":"FeatureCollection",{}"features":[{}]}})", members, fmt::join(features, ","));
}
std::string crs(const std::string& name) {
  return R"("crs":{"type":"name","properties":{"name":")" + name + R"("}},)";
}
std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

TEST_F(FloeFile, LongitudeAndLatitudeAreRefusedOnceWithWhatToDo) {
  const std::string degrees = collection({floe(15.61, 78.201, 0.002), floe(15.62, 78.203, 0.004)});
  const std::string found = problems(degrees);
  EXPECT_EQ(lines_in(found), 1U) << found;
  EXPECT_HAS(found, "floes.geojson:1:1: ", "longitude and latitude", "2e-05 m²",
             R"("origin": {"latitude_deg": 78.203, "longitude_deg": 15.616} in the scene)");
  for (const std::string& large : {collection({floe(-150, 71, 3), floe(-140, 71, 3)}),  // 60 000 km²
                                   collection({floe(-65, -70, 0.5)}), collection({floe(12, 1, 0.5)})})
    EXPECT_HAS(problems(large), "longitude and latitude") << large;
}

TEST_F(FloeFile, ACrsDecidesWhereThereIsOne) {
  for (const char* name : {"urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326", "urn:ogc:def:crs:EPSG::4269",
                           "http://www.opengis.net/def/crs/OGC/1.3/CRS84", "WGS84"}) {
    const std::string found = problems(collection({floe(0, 0, 8)}, crs(name)));
    EXPECT_HAS(found, "longitude and latitude (") << name;
    EXPECT_HAS(found, "no origin") << name;
    EXPECT_EQ(lines_in(found), 1U) << found;
  }
  for (const char* name : {"urn:ogc:def:crs:EPSG::3413", "EPSG:32633"})
    EXPECT_EQ(problems(collection({floe(15, 78, 0.2)}, crs(name))), "") << name;
  for (const std::string name : {"EPSG:99999", "+proj=nonsense", "metres of the ice tank"}) {
    const std::string found = problems(collection({floe(15, 78, 0.2)}, crs(name)));
    EXPECT_HAS(found, "PROJ knows no coordinate system \"" + name + "\", allowed: EPSG:n");
  }
  EXPECT_NE(problems(R"({"crs":{"type":"EPSG","properties":{"code":4326}},)" + floe(0, 0, 9).substr(1)), "");
}

/// Small scenes in metres stay as they are: a tank, floes near the origin, and files that Polynya wrote.
TEST_F(FloeFile, SmallScenesInMetresAreNotTakenForDegrees) {
  for (const std::string& metres :
       {collection({floe(0, 0, 10)}), collection({floe(1, 1, 1), floe(3, 1, 0.5)}),
        collection({floe(-170, -80, 20), floe(100, 50, 30)}), collection({floe(10, 45, 11)}),
        collection({floe(-0.2, -0.2, 0.4, R"("floe_id":1,"area_m2":0.16000000000000003)")}),
        collection({floe(200, 500, 0.1)}), collection({floe(0, -95, 0.2)})})
    EXPECT_EQ(problems(metres), "") << metres;
}

TEST_F(FloeFile, CoordinatesTooFarAwayAreNamedOnce) {
  const std::string found =
      problems(collection({floe(0, 0, 5), floe(1104312.5, -512345.25, 800), floe(1.2e6, 0, 800)}));
  EXPECT_EQ(lines_in(found), 1U) << found;
  EXPECT_HAS(found, "found [1104312.5, -512345.25], and as far in 1 more", "-1e+06 to 1e+06", R"("shift": true)");
  EXPECT_HAS(problems(collection({floe(0, 0, 5), floe(9, 0, 5), floe(1.2e6, 0, 800)})),
             "floes[0].file (its floe 2): found [1200000, 0], allowed");
  EXPECT_HAS(problems(collection({R"({"type":"Polygon","coordinates":[[[0,0],[null,0],[1,1],[0,0]]]})"})),
             "found [nan, 0], allowed: coordinates that are finite numbers");
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
      all.push_back(floe(100.0 * i, 0, side, are_of_a_run ? properties : ""));
    }
    return all;
  };
  EXPECT_EQ(problems(collection(features(100.01, true), R"("t_s":120.5,)")), "");
  EXPECT_EQ(lines_in(problems(collection(features(100.01, false)))), 5U);
  EXPECT_HAS(problems(collection(features(2000, true), R"("t_s":120.5,)")), "an overlap with")
      << "nearly all of a floe is not what was crushed";

  const LoadedScene loaded = sound(collection(features(100.01, true), R"("t_s":120.5,)"),
                                   R"(, "velocity_m_per_s": [9, 9])", R"("water": {"drift_m_per_s": [0.05, -0.25]}, )");
  const simulation::FloeSpec& fast = loaded.scene.floes.at(0);
  const simulation::FloeSpec& free = loaded.scene.floes[1];
  EXPECT_TRUE(fast.is_fast && !free.is_fast && free.has_crushed_overlaps);
  EXPECT_EQ(fast.velocity, (geometry::Vector{0.25, 0})) << "over ground";
  EXPECT_EQ(free.velocity, (geometry::Vector{0.2, 0.25})) << "relative to the water";
  EXPECT_EQ(fast.angular_velocity, 0);
  EXPECT_NEAR(free.angular_velocity, 0.0523598775598, 1e-12);
  EXPECT_EQ(free.source_floe, 11);
  expect_reads_back(loaded);
}

TEST_F(FloeFile, ASceneWithAnOriginProjectsDegrees) {
  const std::string degrees = collection({floe(15.6, 78.2, 0.001), floe(15.61, 78.2, 0.001)});
  const LoadedScene loaded = sound(degrees, "", kOrigin);
  const auto& ring = loaded.scene.floes.at(0).polygon_in_world.outer;
  EXPECT_NEAR(ring[1].x - ring[0].x, 22.8378, 1e-3);
  EXPECT_NEAR(ring[2].y - ring[1].y, 111.6468, 1e-3);
  EXPECT_EQ(loaded.files.at(0).plane.system, "WGS 84");
  EXPECT_HAS(problems(degrees, "", replaced(kOrigin, "78.2", "-75")), "in the other hemisphere");
  EXPECT_HAS(problems(collection({floe(0, 0, 10)}), R"(, "import": {"crs": "EPSG:3413"})", kOrigin),
             "import.crs in a scene that has an origin");
}

TEST_F(FloeFile, AWrongLatitudeIsAProblemOfItsFloe) {
  const std::string wrong =
      R"({"type":"Polygon","coordinates":[[[15.61,78.2],[15.612,782],[15.612,78.202],[15.61,78.2]]]})";
  for (const char* entry : {"", R"(, "import": {"repair": "non-zero"})"}) {
    for (const std::string& name : {std::string(), crs("EPSG:4326")}) {
      const std::string found = problems(collection({floe(15.6, 78.2, 0.001), wrong}, name), entry, kOrigin);
      EXPECT_EQ(lines_in(found), 1U) << found;
      EXPECT_HAS(found, "(its floe 1): found [15.612, 782], allowed: [longitude, latitude]");
    }
  }
}

TEST_F(FloeFile, PropertiesThatAreNearlyReadAreWarnedOf) {
  const std::string floes = collection({floe(0, 0, 5, R"("thickness_cm":80)"), floe(9, 0, 5, R"("thickness_m":0.4)")});
  const LoadedScene loaded = sound(floes);
  EXPECT_EQ(loaded.files.at(0).with_thickness, 1U);
  EXPECT_HAS(
      in_words(loaded.hints),
      R"(warning: floes[0].file: property "thickness_cm" of 1 floe is not read; did you mean thickness_m?)",
      R"("import": {"properties": "thickness_m=thickness_cm*0.01"} reads it; 1 of 2 floes has a thickness of its own)");
  const LoadedScene named = sound(floes, R"(, "import": {"properties": "thickness_m=thickness_cm*0.01"})");
  EXPECT_EQ(named.scene.floes.size(), 2U);
  EXPECT_HAS(problems(collection({floe(0, 0, 5, R"("thickness_m":-0.5)"), floe(9, 0, 5, R"("vx_m_per_s":"fast")")})),
             "floes[0].file (its floe 0): property thickness_m: found -0.5, allowed: a number from 0.001 to 20 [m]",
             "floes[0].file (its floe 1): property vx_m_per_s: found \"fast\"");
}

TEST_F(FloeFile, AnImportRepairsTrimsAndReports) {
  const std::string bow = R"({"type":"Polygon","coordinates":[[[60,0],[64,3],[64,0],[60,3],[60,0]]]})";
  const std::string floes = collection({floe(0, 0, 10), floe(8, 0, 4, R"("THICK":80)"), bow, floe(100, 0, 1)});
  const LoadedScene loaded =
      sound(floes, R"(, "import": {"repair": "even-odd", "min_area_m2": 2, "properties": "thickness_m=THICK*0.01"})");
  EXPECT_EQ(loaded.scene.floes.size(), 4U);
  const ImportTotals& totals = loaded.files.at(0).totals.value();
  EXPECT_EQ(totals.trimmed + totals.repaired + totals.dropped, 3U);
  EXPECT_EQ(totals.area_trimmed, 8);
  expect_reads_back(loaded);
  EXPECT_HAS(problems(floes, R"(, "import": {})"), "self-crossing", R"("repair": "non-zero")");
}

// ---- ice properties of single floes: reading, drawing from distributions, and refused input

SceneOutcome read_ice(const std::string& ice, int columns = 1, const std::string& members = "") {
  return read(fmt::format(
      R"({{{} "floes": [{{"lattice": {{"columns": {}, "rows": 1, "pitch_m": 12, "size_m": 10}}, "ice": {}}}]}})",
      members, columns, ice));
}

const fracture::Ice& ice_at(const LoadedScene& loaded, std::size_t floe) {
  return ice_of(loaded.scene, loaded.scene.floes[floe].own_ice);
}

TEST(FloeIce, KeysAndRangesAreThoseOfTheScenesIce) {
  for (const FloeProperty& property : floe_ice_properties()) {
    for (const Object* object : std::initializer_list<const Object*>{&kIceDescription, &kFloeIceDescription}) {
      const auto field = std::ranges::find(object->fields, property.key, &Field::key);
      ASSERT_NE(field, object->fields.end()) << property.key;
      EXPECT_EQ(field->unit, property.unit);
      EXPECT_EQ(field->range.low, property.low) << property.key;
      EXPECT_EQ(field->range.high, property.high) << property.key;
    }
  }
  EXPECT_EQ(kFloeIceDescription.fields.size(), kFloeIceProperties + 1) << "and the seed";
}

TEST(FloeIce, GivenIsTheirsAndTheRestTheScenes) {
  const auto loaded = checked(read_ice(R"({"thickness_m": 0.8, "flexural_strength_Pa": 6e5})", 3));
  EXPECT_EQ(loaded->scene.own_ice.size(), 1u) << "once for all three";
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(ice_at(*loaded, i).thickness, 0.8);
    EXPECT_EQ(ice_at(*loaded, i).flexural_strength, 6e5);
    EXPECT_EQ(ice_at(*loaded, i).density, 900);
  }
}

TEST(FloeIce, OfNoScatterIsTheScenes) {
  for (const char* ice : {"{}", R"({"thickness_m": 0.5})", R"({"thickness_m": {"spread": 0}})",
                          R"({"density_kg_per_m3": {"law": "constant"}})",
                          R"({"thickness_m": {"law": "uniform", "least": 0.5, "most": 0.5}})"}) {
    const auto loaded = checked(read_ice(ice, 2));
    EXPECT_TRUE(loaded->scene.own_ice.empty()) << ice;
  }
}

TEST(FloeIce, IsDrawnByItsLawAndTheSeed) {
  const std::string ice =
      R"({"thickness_m": {"spread": 0.2}, "compressive_strength_Pa": {"law": "normal", "mean": 2e6, "spread": 0.1},
          "tensile_strength_Pa": {"law": "uniform", "least": 4e5, "most": 9e5}})";
  const auto loaded = checked(read_ice(ice, 4000));
  ASSERT_EQ(loaded->ice.size(), 3u);
  for (const IceReport& report : loaded->ice) {
    EXPECT_EQ(report.measures.count, 4000u);
    EXPECT_LT(report.measures.distance, 1.63 / std::sqrt(4000.0)) << report.property;
  }
  EXPECT_NEAR(loaded->ice[0].measures.mean, 0.5, 0.01);
  EXPECT_NEAR(loaded->ice[1].measures.mean, 2e6, 2e4);
  EXPECT_GE(loaded->ice[1].measures.least, 1.4e6);
  EXPECT_LE(loaded->ice[2].measures.most, 9e5);
  const auto again = read(loaded->resolved_text);
  const auto seeded = read_ice(ice, 4000, R"("seed": 2,)");
  ASSERT_TRUE(again.has_value() && seeded.has_value());
  EXPECT_EQ(ice_at(*again, 17).thickness, ice_at(*loaded, 17).thickness);
  EXPECT_NE(ice_at(*seeded, 17).thickness, ice_at(*loaded, 17).thickness);
}

TEST_F(FloeFile, FeaturesGiveTheirIceBeforeTheEntryAndTheScene) {
  const LoadedScene loaded = sound(
      collection({floe(0, 0, 400, R"("thickness_m":0.9,"name":"a")"),
                  floe(1000, 0, 400, R"("thickness_m":null,"fracture_toughness_Pa_sqrt_m":2e5)"), floe(2000, 0, 400)}),
      R"(, "ice": {"thickness_m": 0.7, "tensile_strength_Pa": {"spread": 0.3}})");
  EXPECT_EQ(ice_at(loaded, 0).thickness, 0.9);
  EXPECT_EQ(ice_at(loaded, 1).thickness, 0.7);
  EXPECT_EQ(ice_at(loaded, 1).fracture_toughness, 2e5);
  EXPECT_EQ(ice_at(loaded, 2).fracture_toughness, 150e3);
  expect_reads_back(loaded);
}

/// The file keeps the ice of each floe. Corners far from the origin that round to one point appear once.
TEST_F(FloeFile, WhatARunWritesReadsBack) {
  const LoadedScene loaded =
      sound(collection({floe(0, 0, 400, R"("thickness_m":0.9,"density_kg_per_m3":870)"), floe(1000, 0, 400)}));
  const simulation::Simulation simulation(loaded.scene);
  std::vector<simulation::FloeState> states = simulation.floe_states();
  const geometry::Polygon in_body{{{-5, -5}, {5, -5}, {5, 0}, {5, 1e-17}, {5, 5}, {-5, 5}}, {}};
  states[1].polygon_in_body = &in_body;
  states[1].world_from_body.position = {1000, 1000};
  const LoadedScene again = sound(to_geojson(states, 0));
  EXPECT_EQ(again.scene.own_ice.size(), 1u);
  EXPECT_EQ(ice_at(again, 0).density, 870);
  EXPECT_EQ(again.scene.floes[1].own_ice, simulation::kSceneIce);
  EXPECT_EQ(again.scene.floes[1].polygon_in_world.outer.size(), 5U);
}

}  // namespace
}  // namespace polynya::io
