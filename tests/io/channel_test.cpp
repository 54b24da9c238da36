#include <algorithm>
#include <cmath>

#include "scene_text.hpp"

#include "geometry/exact/measures.hpp"
#include "simulation/field/brash_layer.hpp"

namespace polynya::io {
namespace {

using namespace tests;

/// A channel 36 m wide and 400 m long, with 1 m of brash whose pores take 20 %.
std::string channel(const std::string& members = "") {
  return with(R"({"channel": {"centreline_m": [[-100, 0], [300, 0]], "width_m": 36, "thickness_m": 1,
    "sizes": {"mean_m": 2, "spread": 0.3}, "fast_ice_thickness_m": 0.8}})",
              members.empty() ? "" : "\"channel\": {" + members + "}");
}

/// Sums over the pieces of a scene, and over its fast ice.
struct Sums {
  double volume = 0;       ///< volume of the pieces [m³]
  double area = 0;         ///< area of the pieces [m²]
  double fast_volume = 0;  ///< volume of the fast ice [m³]
};

Sums sums_of(const simulation::Scene& scene) {
  Sums sums;
  for (const simulation::FloeSpec& floe : scene.floes) {
    const double area = geometry::measure(floe.polygon_in_world).area;
    const double volume = area * ice_of(scene, floe.own_ice).thickness;
    (floe.is_fast ? sums.fast_volume : sums.volume) += volume;
    if (!floe.is_fast) sums.area += area;
  }
  return sums;
}

LoadedScene load_channel(const std::string& members = "", const std::string& more = "\"seed\": 1") {
  return load(scene({list("floes", {channel(members)}), more}));
}

TEST(Channel, HoldsTheIceOfItsBrash) {
  for (const char* members : {"", R"("cover": 0.6)", R"("cover": 0.9, "porosity": 0.3)"}) {
    const LoadedScene loaded = load_channel(members);
    const double porosity = std::string(members).find("porosity") == std::string::npos ? 0.2 : 0.3;
    const double asked = 36 * 400 * (1 - porosity);
    const Sums sums = sums_of(loaded.scene);
    EXPECT_NEAR(sums.volume / asked, 1, 1e-9) << members << ": uniform brash has the volume to rounding";
    EXPECT_NEAR(sums.fast_volume, 2 * 30 * 400 * 0.8, 1e-6);
    ASSERT_TRUE(loaded.fields.at(0).brash);
    EXPECT_NEAR(loaded.fields[0].brash->volume, sums.volume, 1e-6);
    EXPECT_NEAR(loaded.fields[0].brash->asked_volume, asked, 1e-6);
  }
}

/// The cover varies from place to place, so that a sloping profile has its volume within one percent.
TEST(Channel, IsThickerAtItsSidesAsItIsAsked) {
  const LoadedScene loaded = load_channel(R"("side_thickness_m": 1.8, "cover": 0.75)");
  const Sums sums = sums_of(loaded.scene);
  EXPECT_NEAR(sums.volume / (36 * 400 * 0.8 * 1.4), 1, 0.01);
  for (const simulation::FloeSpec& floe : loaded.scene.floes) {
    if (floe.is_fast) continue;
    const double y = std::abs(geometry::measure(floe.polygon_in_world).centroid.y);
    EXPECT_NEAR(ice_of(loaded.scene, floe.own_ice).thickness, (1 + 0.8 * y / 18) * 0.8 / 0.75, 1e-9);
  }
}

TEST(Channel, FollowsABentLine) {
  const LoadedScene loaded = load_channel(R"("centreline_m": [[0, 0], [100, 0], [180, 60]], "fast_ice_width_m": 10)");
  const Sums sums = sums_of(loaded.scene);
  EXPECT_NEAR(sums.volume / (36 * 200 * 0.8), 1, 1e-9) << "mitres leave the area of a strip";
  EXPECT_NEAR(sums.fast_volume, 2 * 10 * 200 * 0.8, 1e-6);
}

TEST(Channel, KeepsAShipClearThatStartsInIt) {
  const std::string in_it = list("ships", {ship(R"("position_m": [100, 0])")});
  const LoadedScene loaded = load_channel("", in_it);
  const double hull = geometry::measure({loaded.scene.ships[0].hull.waterline, {}}).area;
  EXPECT_NEAR(sums_of(loaded.scene).volume / ((36 * 400 - hull) * 0.8), 1, 1e-6);
  EXPECT_HAS(in_words(read(scene({list("floes", {channel(R"("width_m": 20)")}), in_it})).error()),
             "found an overlap with ships[0]");
}

TEST(Channel, HasNoFastIceWhereItIsNotAsked) {
  EXPECT_EQ(sums_of(load_channel(R"("fast_ice_width_m": 0)").scene).fast_volume, 0);
  load_channel(R"("fast_ice_width_m": 0)", R"("contact": {"law": "impulse"})");
  EXPECT_HAS(in_words(read(scene({list("floes", {channel()}), R"("contact": {"law": "impulse"})"})).error()),
             "floes[0].channel.fast_ice_width_m");
}

/// A frozen layer breaks as ice of its thickness and is pushed down as the layer and the brash.
TEST(Channel, ConsolidatedBrashHasTheBuoyancyOfAllItsIce) {
  const LoadedScene loaded = load_channel(R"("sizes": null, "consolidated_thickness_m": 0.2, "side_thickness_m": 1.2)");
  ASSERT_EQ(loaded.scene.floes.size(), 3U);
  const simulation::FloeSpec& plate = loaded.scene.floes[0];
  const fracture::Ice& ice = ice_of(loaded.scene, plate.own_ice);
  EXPECT_TRUE(plate.is_fast);
  EXPECT_NEAR(geometry::measure(plate.polygon_in_world).area, 36 * 400, 1e-9);
  EXPECT_EQ(ice.thickness, 0.2);
  const double water = loaded.scene.water.water.density;
  EXPECT_NEAR((water - ice.density) * 0.2, (water - loaded.scene.ice.density) * (0.2 + 0.8 * 1.1), 1e-9);
}

TEST(Channel, BrashOfTheDefaultCoverHasPiecesAsThickAsItself) {
  const simulation::BrashLayer layer{.width = 30, .thickness = 1.2, .side_thickness = 1.5, .porosity = 0.3};
  EXPECT_DOUBLE_EQ(layer.piece_thickness(0, 0.7), 1.2);
  EXPECT_DOUBLE_EQ(layer.piece_thickness(15, 0.7), 1.5);
  EXPECT_DOUBLE_EQ(layer.piece_thickness(99, 0.7), 1.5);
}

}  // namespace
}  // namespace polynya::io
