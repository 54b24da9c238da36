// Ice of floes in scenes and floe files: what it reads as, what it is drawn from, and what is refused.
#include "scene_text.hpp"
#include "temporary_folder.hpp"

#include "io/import/floe_properties.hpp"
#include "io/run/records.hpp"
#include "io/scene/scene_input.hpp"
#include "simulation/simulation.hpp"

namespace polynya::io {
namespace {

using tests::TemporaryFolder;
using tests::write_file;

SceneOutcome read_ice(const std::string& ice, int columns = 1, const std::string& members = "") {
  return read_scene(
      fmt::format(
          R"({{{} "floes": [{{"lattice": {{"columns": {}, "rows": 1, "pitch_m": 12, "size_m": 10}}, "ice": {}}}]}})",
          members, columns, ice),
      "scene.json", ".");
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
  const auto loaded = tests::checked(read_ice(R"({"thickness_m": 0.8, "flexural_strength_Pa": 6e5})", 3));
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
    const auto loaded = tests::checked(read_ice(ice, 2));
    EXPECT_TRUE(loaded->scene.own_ice.empty()) << ice;
  }
}

TEST(FloeIce, IsDrawnByItsLawAndTheSeed) {
  const std::string ice =
      R"({"thickness_m": {"spread": 0.2}, "compressive_strength_Pa": {"law": "normal", "mean": 2e6, "spread": 0.1},
          "tensile_strength_Pa": {"law": "uniform", "least": 4e5, "most": 9e5}})";
  const auto loaded = tests::checked(read_ice(ice, 4000));
  ASSERT_EQ(loaded->ice.size(), 3u);
  for (const IceReport& report : loaded->ice) {
    EXPECT_EQ(report.measures.count, 4000u);
    EXPECT_LT(report.measures.distance, 1.63 / std::sqrt(4000.0)) << report.property;
  }
  EXPECT_NEAR(loaded->ice[0].measures.mean, 0.5, 0.01);
  EXPECT_NEAR(loaded->ice[1].measures.mean, 2e6, 2e4);
  EXPECT_GE(loaded->ice[1].measures.least, 1.4e6);
  EXPECT_LE(loaded->ice[2].measures.most, 9e5);
  const auto again = read_scene(loaded->resolved_text, "scene.json", ".");
  const auto seeded = read_ice(ice, 4000, R"("seed": 2,)");
  ASSERT_TRUE(again.has_value() && seeded.has_value());
  EXPECT_EQ(ice_at(*again, 17).thickness, ice_at(*loaded, 17).thickness);
  EXPECT_NE(ice_at(*seeded, 17).thickness, ice_at(*loaded, 17).thickness);
}

std::string feature(double x, const std::string& properties) {
  return fmt::format(R"({{"type":"Feature","properties":{{{}}},"geometry":{{"type":"Polygon","coordinates":)"
                     R"([[[{},0],[{},0],[{},500],[{},500],[{},0]]]}}}})",
                     properties, x, x + 400, x + 400, x, x);
}

class FloeIceFile : public testing::Test {
 protected:
  SceneOutcome read_file(const std::string& features, const std::string& members = "") const {
    write_file(folder / "floes.geojson", R"({"type":"FeatureCollection","features":[)" + features + "]}");
    return read_scene(fmt::format(R"({{"floes": [{{"file": "floes.geojson"{}}}]}})", members), "scene.json",
                      folder.path());
  }
  TemporaryFolder folder;
};

TEST_F(FloeIceFile, FeaturesGiveTheirsBeforeTheEntryAndTheScene) {
  const auto loaded = tests::checked(
      read_file(feature(0, R"("thickness_m":0.9,"name":"a")") + "," +
                    feature(1000, R"("thickness_m":null,"fracture_toughness_Pa_sqrt_m":2e5)") + "," + feature(2000, ""),
                R"(, "ice": {"thickness_m": 0.7, "tensile_strength_Pa": {"spread": 0.3}})"));
  EXPECT_EQ(ice_at(*loaded, 0).thickness, 0.9);
  EXPECT_EQ(ice_at(*loaded, 1).thickness, 0.7);
  EXPECT_EQ(ice_at(*loaded, 1).fracture_toughness, 2e5);
  EXPECT_EQ(ice_at(*loaded, 2).fracture_toughness, 150e3);
  tests::expect_reads_back(*loaded);
}

TEST_F(FloeIceFile, OfTheWrongTypeOrSignAreRefusedAtTheirPlace) {
  for (const char* wrong : {R"("0.5")", "-0.5", "true", "50"}) {
    const auto outcome = read_file(feature(0, "") + ",\n" + feature(1000, fmt::format(R"("thickness_m":{})", wrong)));
    ASSERT_FALSE(outcome.has_value()) << wrong;
    const std::string text = to_string(outcome.error().front());
    EXPECT_HAS(text, "floes.geojson:2:");
    EXPECT_HAS(text, "(its floe 1): property thickness_m: found ");
    EXPECT_HAS(text, "a number from 0.001 to 20 [m]");
  }
}

TEST_F(FloeIceFile, WhatARunWritesReadsBack) {
  const auto loaded =
      tests::checked(read_file(feature(0, R"("thickness_m":0.9,"density_kg_per_m3":870)") + "," + feature(1000, "")));
  const simulation::Simulation simulation(loaded->scene);
  write_file(folder / "again.geojson", to_geojson(simulation.floe_states(), 0));
  const auto again =
      tests::checked(read_scene(R"({"floes": [{"file": "again.geojson"}]})", "scene.json", folder.path()));
  EXPECT_EQ(again->scene.own_ice.size(), 1u);
  EXPECT_EQ(ice_at(*again, 0).density, 870);
  EXPECT_EQ(again->scene.floes[1].own_ice, simulation::kSceneIce);
}

TEST_F(FloeIceFile, CornersThatRoundToOnePointFarFromTheOriginAreWrittenOnce) {
  const auto loaded = tests::checked(read_file(feature(1000, "")));
  const simulation::Simulation simulation(loaded->scene);
  std::vector<simulation::FloeState> states = simulation.floe_states();
  const geometry::Polygon in_body{{{-5, -5}, {5, -5}, {5, 0}, {5, 1e-17}, {5, 5}, {-5, 5}}, {}};
  states[0].polygon_in_body = &in_body;
  states[0].world_from_body.position = {1000, 1000};
  write_file(folder / "again.geojson", to_geojson(states, 0));
  const auto again =
      tests::checked(read_scene(R"({"floes": [{"file": "again.geojson"}]})", "scene.json", folder.path()));
  EXPECT_EQ(again->scene.floes[0].polygon_in_world.outer.size(), 5U);
}

}  // namespace
}  // namespace polynya::io
