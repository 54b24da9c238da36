#include <chrono>

#include "temporary_folder.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "geometry/exact/measures.hpp"
#include "io/scene/scene_reader.hpp"

namespace polynya::io {
namespace {

using tests::TemporaryFolder;
using tests::write_file;

std::vector<Problem> problems_of(const std::string& text, const std::filesystem::path& folder = ".") {
  auto outcome = read_scene(text, "scene.json", folder);
  return outcome ? std::vector<Problem>{} : outcome.error();
}

std::string all_of(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) text += to_string(problem) + "\n";
  return text;
}

constexpr auto kShip =
    R"({"hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27}, "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9,
        "position_m": [-60, 0], "propulsion": {"thrust_N": 2e4}})";

TEST(Scene, TenMistakesGiveTenPlacedMessages) {
  const std::string text = R"(// ten mistakes
{
  "ice": {
    "thicknes_m": 0.5,
    "density_kg_per_m3": "900",
    "poisson_ratio": 0.5
  },
	"water": {"drift_m_per_s": [1]},  // a tab
  "fracture": {"bending": {"model": "nevle"}},
  "ships": [
    {"hull": {"length_m": 120, "entrance_angle_deg": 27}, "mass_kg": -1, "moment_of_inertia_kg_m2": 5e9,
     "propulsion": {"thrust_N": 2e4, "constant_speed_m_per_s": 1}}
  ],
  "floes": [
    {"polygon": {"outer_m": [[0, 0], [10, 10], [10, 0], [0, 10]]}},
    {"rectangle": {"corner_m": [50, 0], "size_m": 10}},
    {"rectangle": {"corner_m": [55, 0], "size_m": 10}}
  ]
})";
  struct Expected {
    int line, column;
    std::string path, found;
  };
  const std::vector<Expected> expected{
      {4, 5, "ice.thicknes_m", "an unknown key"},
      {5, 26, "ice.density_kg_per_m3", "\"900\""},
      {6, 22, "ice.poisson_ratio", "0.5"},
      {8, 29, "water.drift_m_per_s", "a list of 1"},
      {9, 37, "fracture.bending.model", "\"nevle\""},
      {11, 14, "ships[0].hull.beam_m", "nothing"},
      {11, 70, "ships[0].mass_kg", "-1"},
      {12, 20, "ships[0].propulsion", "thrust and constant speed together"},
      {15, 5, "floes[0]", "an invalid polygon: self-crossing at (5, 5), (0, 0), (10, 10)"},
      {17, 5, "floes[2]", "an overlap with floes[1], 50 m² shared"}};
  const auto problems = problems_of(text);
  ASSERT_EQ(problems.size(), expected.size()) << all_of(problems);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(problems[i].line, expected[i].line) << to_string(problems[i]);
    EXPECT_EQ(problems[i].column, expected[i].column) << to_string(problems[i]);
    EXPECT_EQ(problems[i].path, expected[i].path);
    EXPECT_EQ(problems[i].found, expected[i].found);
    EXPECT_FALSE(problems[i].allowed.empty());
    EXPECT_EQ(problems[i].file, "scene.json");
  }
  EXPECT_EQ(problems[0].suggestion, "thickness_m");
  EXPECT_EQ(problems[4].suggestion, "nevel");
  EXPECT_EQ(to_string(problems[2]),
            "scene.json:6:22: ice.poisson_ratio: found 0.5, allowed: a number ≥ 0, < 0.5");
}

TEST(Scene, WhatNoFieldAloneCanTell) {
  struct Case {
    std::string text, path, found;
  };
  const std::string ship = kShip;
  for (
      const Case& c : std::vector<Case>{
          {R"({"ice": {"density_kg_per_m3": 1050}, "floes": [{"rectangle": {"corner_m": [0, 0], "size_m": 1}}]})",
           "ice.density_kg_per_m3", "sinks"},
          {R"({"time": {"step_s": 0.9}, "water": {"drift_m_per_s": [1, 1]}, "floes": [{"rectangle": {"corner_m": [0, 0], "size_m": 1}}]})",
           "time.step_s", "1.27 m in one step"},
          {R"({"water": {"shear": {"rate_per_s": 0.01}}, "floes": [{"rectangle": {"corner_m": [0, 0], "size_m": 1}}, {"polygon": {"outer_m": [[-60, -20], [-10, -20], [-10, 20], [-60, 999999]]}}]})",
           "floes[1]", "a rim that moves at"},
          {R"({"water": {"shear": {"rate_per_s": 0.01}}, "floes": [{"rectangle": {"corner_m": [0, 40000], "size_m": 1}}]})",
           "time.step_s", "0.005: floes[0] moves 2 m in one step at 400 m/s"},
          {R"({"floes": [{"rectangle": {"corner_m": [0, 0], "size_m": 200}, "angular_velocity_deg_per_s": 100}]})",
           "time.step_s", "0.005: floes[0] moves 1.23 m in one step at 247 m/s"},
          {R"({"ice": {"thickness_m": 5e-324}, "floes": [{"rectangle": {"corner_m": [0, 0], "size_m": 1}}]})",
           "ice.thickness_m", "5e-324"},
          {R"({"time": {"step_s": 0.9}, "ships": [{"mass_kg": 1e3, "moment_of_inertia_kg_m2": 1e4, "propulsion": {"thrust_N": 2e3}, "hull": {"length_m": 40, "beam_m": 8, "entrance_angle_deg": 27}}]})",
           "time.step_s", "1.62 m in one step at 1.8 m/s"},
          {R"({"time": {"step_s": 1e-5, "until_s": 1e6}, "ships": [)" + ship + "]}", "time.until_s",
           "1e+11 steps"},
          {R"({"time": {"until_s": 0.001}, "ships": [)" + ship + "]}", "time.until_s", "less than one step"},
          {R"({"ships": [)" + ship + R"(], "floes": [{"rectangle": {"corner_m": [-70, 0], "size_m": 5}}]})",
           "floes[0]", "an overlap with ships[0], 25 m² shared"},
          {R"({"ships": [)" + ship + "," + ship + "]}", "ships[1]", "an overlap with ships[0]"},
          {R"({"floes": [{"lattice": {"columns": 2, "rows": 2, "pitch_m": 10, "size_m": [10, 11]}}]})",
           "floes[0].lattice.size_m", "more than the pitch"},
          {R"({"floes": [{"lattice": {"columns": 100000, "rows": 100000, "pitch_m": 10, "size_m": 5}}]})",
           "floes[0]", "floes in all"},
          {"{}", "", "neither ships nor floes"},
          {"[]", "", "a list of 0"},
          {"{\"floes\": 3}", "floes", "3"},
          {R"({"floes": [{"velocity_m_per_s": [0, 0]}]})", "floes[0]", "none of them"},
          {R"({"floes": [{"polygon": {"outer_m": [[0, 0], [1, 1], [2, 2]]}}]})", "floes[0]", "zero-area"},
          {R"({"floes": [{"polygon": {"outer_m": [[0, 0], [1e-4, 0], [0, 1e-4]]}}]})", "floes[0]",
           "a floe of 5e-09 m²"},
          {R"({"ice": {"thickness_m": 0}, "floes": []})", "ice.thickness_m", "0"},
          {R"({"ice": {"thickness_m": 1e308}, "floes": []})", "ice.thickness_m", "1e+308"}}) {
    const auto problems = problems_of(c.text);
    ASSERT_FALSE(problems.empty()) << c.text;
    EXPECT_EQ(problems.front().path, c.path) << all_of(problems);
    EXPECT_NE(problems.front().found.find(c.found), std::string::npos) << all_of(problems);
  }
}

TEST(Scene, ShipAtConstantSpeedStartsAtIt) {
  std::string text = std::string("{\"ships\": [") + kShip + "]}";
  const auto swap = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  swap(R"("thrust_N": 2e4)", R"("constant_speed_m_per_s": 1.5)");
  const auto loaded = read_scene(text, "a.json", ".");
  ASSERT_TRUE(loaded.has_value());
  EXPECT_EQ(loaded->scene.ships[0].speed, 1.5);
  EXPECT_EQ(loaded->scene.ships[0].name, "ship-1");
  swap(R"("mass_kg")", R"("speed_m_per_s": 1, "mass_kg")");
  EXPECT_EQ(problems_of(text).front().path, "ships[0].speed_m_per_s");
}

TEST(Scene, RingsMayRunEitherWayAndBeClosed) {
  const auto area = [](const std::string& outer, const std::string& holes) {
    const auto loaded =
        read_scene(R"({"floes": [{"polygon": {"outer_m": )" + outer + R"(, "holes_m": )" + holes + "}}]}",
                   "a.json", ".");
    return loaded ? geometry::measure(loaded->scene.floes[0].polygon_in_world).area : -1;
  };
  EXPECT_EQ(area("[[0,0],[10,0],[10,10],[0,10]]", "[[[2,2],[2,4],[4,4],[4,2]]]"), 96);
  EXPECT_EQ(area("[[0,10],[10,10],[10,0],[0,0],[0,10]]", "[[[2,2],[4,2],[4,4],[2,4],[2,2]]]"), 96);
}

TEST(Scene, FloesFromGeojsonStayInTheScenesFolder) {
  const TemporaryFolder folder;
  write_file(folder / "scenes/floes/a.geojson", R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [[[0,0],[10,0],[10,10],[0,10],[0,0]]]}},
    {"type": "Feature", "geometry": {"type": "MultiPolygon", "coordinates": [[[[20,0],[20,5],[25,5],[25,0],[20,0]]],[[[30,0],[35,0,7],[35,5],[30,0]]]]}}]})");
  write_file(folder / "outside.geojson",
             R"({"type": "Polygon", "coordinates": [[[0,0],[10,0],[10,10],[0,10],[0,0]]]})");
  std::filesystem::create_symlink(folder / "outside.geojson", folder / "scenes/link.geojson");
  const auto read = [&](const std::string& file) {
    write_file(folder / "scenes/s.json",
               R"({"floes": [{"file": ")" + file + R"(", "velocity_m_per_s": [0.1, 0]}]})");
    return read_scene_file(folder / "scenes/s.json");
  };
  const auto loaded = read("floes/a.geojson");
  ASSERT_TRUE(loaded.has_value()) << all_of(loaded.error());
  ASSERT_EQ(loaded->scene.floes.size(), 3U);
  EXPECT_EQ(loaded->scene.floes[1].velocity.x, 0.1);
  EXPECT_EQ(geometry::measure(loaded->scene.floes[1].polygon_in_world).area, 25);
  // The resolved scene needs no other file.
  const auto again = read_scene(loaded->resolved_text, "again.json", "/nowhere");
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->scene.floes[2].polygon_in_world, loaded->scene.floes[2].polygon_in_world);
  for (const char* file : {"../outside.geojson", "link.geojson", "/etc/passwd", "floes", "missing.geojson",
                           "", "../scenes/../outside.geojson"}) {
    const auto outcome = read(file);
    ASSERT_FALSE(outcome.has_value()) << file;
    EXPECT_EQ(outcome.error().front().path, "floes[0].file") << all_of(outcome.error());
  }
}

TEST(Scene, AWrongFloeInAFileIsToldInThatFile) {
  const TemporaryFolder folder;
  write_file(folder / "f.geojson",
             "{\"type\": \"MultiPolygon\", \"coordinates\": [\n[[[0,0],[10,0],[10,10],[0,0]]],\n "
             "[[[0,0],[10,10],[10,0],[0,10],[0,0]]]]}");
  write_file(folder / "s.json", R"({"floes": [{"file": "f.geojson"}]})");
  const auto outcome = read_scene_file(folder / "s.json");
  ASSERT_FALSE(outcome.has_value());
  EXPECT_EQ(outcome.error().front().file, (folder / "f.geojson").string());
  EXPECT_EQ(outcome.error().front().line, 3);
  EXPECT_EQ(outcome.error().front().column, 2);
}

TEST(Scene, AMissingFileIsAProblem) {
  const auto outcome = read_scene_file("/no/such/scene.json");
  ASSERT_FALSE(outcome.has_value());
  EXPECT_EQ(to_string(outcome.error().front()).substr(0, 41), "/no/such/scene.json: found no such file, ");
}

TEST(Scene, OverridesTakeTheScenesPlace) {
  const auto loaded =
      read_scene(R"({"time": {"until_s": 5}, "floes": [{"rectangle": {"corner_m": [0, 0], "size_m": 1}}]})",
                 "a b é.json", ".", {.until = 7.5, .seed = 12});
  ASSERT_TRUE(loaded.has_value());
  EXPECT_EQ(loaded->scene.time.until, 7.5);
  EXPECT_EQ(loaded->scene.seed, 12U);
  EXPECT_NE(loaded->resolved_text.find("\"until_s\": 7.5"), std::string::npos);
  EXPECT_EQ(loaded->scene.name, "a-b---");
}

/// The scene.json of a run is the resolved scene: whatever is read must fit into what can be read again.
TEST(Scene, OneThatCouldNotBeReadBackIsRefused) {
  const TemporaryFolder folder;
  write_file(folder / "f.geojson",
             R"({"type": "Polygon", "coordinates": [[[0,0],[1000,0],[0,1000],[0,0]]]})");
  const std::string text = R"({"floes": [{"file": "f.geojson"}]})";
  const auto resolved = read_scene(text, "s.json", folder.path());
  ASSERT_TRUE(resolved.has_value());
  const std::size_t length = resolved->resolved_text.size();
  EXPECT_GT(length, text.size());
  const auto fits = read_scene(text, "s.json", folder.path(), {}, length);
  ASSERT_TRUE(fits.has_value());
  EXPECT_TRUE(read_scene(fits->resolved_text, "scene.json", ".", {}, length).has_value());
  const auto refused = read_scene(text, "s.json", folder.path(), {}, length - 1);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(to_string(refused.error().front()).find("s.json:1:1: found " + std::to_string(length) + " bytes"),
            0U)
      << to_string(refused.error().front());
  EXPECT_GE(kLongestScene, 2 * kLongestFloesFile);
}

TEST(Scene, ALargeLatticeIsReadWhole) {
  const auto loaded =
      read_scene(R"({"floes": [{"lattice": {"columns": 400, "rows": 250, "pitch_m": 10, "size_m": 10}}]})",
                 "a.json", ".");
  ASSERT_TRUE(loaded.has_value());
  EXPECT_EQ(loaded->scene.floes.size(), 100'000U);
}

class ShippedScene : public testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, IsValid) {
  const auto path = std::filesystem::path(POLYNYA_SOURCE_DIR) / "scenes" / (GetParam() + ".json");
  const auto loaded = read_scene_file(path);
  ASSERT_TRUE(loaded.has_value()) << all_of(loaded.error());
  EXPECT_EQ(loaded->scene.name, GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const auto& entry : std::filesystem::directory_iterator(
                                    std::string(POLYNYA_SOURCE_DIR) + "/scenes")) {
                             if (entry.path().extension() == ".json")
                               names.push_back(entry.path().stem().string());
                           }
                           std::ranges::sort(names);
                           return names;
                         }()),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

/// The paper's counts and concentrations (docs/paper-comparison.md).
TEST(PaperScenes, HoldThePapersIce) {
  struct Case {
    const char* name;
    std::size_t small;
    double size, concentration, tolerance;
  };
  for (const Case& c : {Case{"fig4a", 110, 15, 0.53, 0.005}, Case{"fig6a", 225, 10, 0.55, 0.005},
                        Case{"fig6b", 64, 20, 0.55, 0.005}}) {
    const auto loaded =
        read_scene_file(std::string(POLYNYA_SOURCE_DIR) + "/scenes/sawamura2017-" + c.name + ".json");
    ASSERT_TRUE(loaded.has_value());
    const auto& floes = loaded->scene.floes;
    ASSERT_EQ(floes.size(), c.small + 21 + 2);
    geometry::Box box = geometry::bounding_box(floes.front().polygon_in_world.outer);
    double area = 0;
    for (std::size_t i = 0; i < c.small; ++i) {
      EXPECT_NEAR(geometry::measure(floes[i].polygon_in_world).area, c.size * c.size, 1e-9);
      const auto other = geometry::bounding_box(floes[i].polygon_in_world.outer);
      box.high = {std::max(box.high.x, other.high.x), std::max(box.high.y, other.high.y)};
    }
    const double margin = 2 * box.low.x;  // half a gap stands around the lattice
    const double lattice_area = (box.high.x - box.low.x + margin) * (box.high.y - box.low.y + margin);
    EXPECT_NEAR(static_cast<double>(c.small) * c.size * c.size / lattice_area, c.concentration, c.tolerance);
    for (const auto& floe : floes) {
      area += geometry::measure(floe.polygon_in_world).area;
      const auto outline = geometry::bounding_box(floe.polygon_in_world.outer);
      EXPECT_GE(outline.low.x, 0);
      EXPECT_GE(outline.low.y, 0);
      EXPECT_LE(outline.high.x, 560);  // the lattice of 20 m floes is 10 m longer than the others
      EXPECT_LE(outline.high.y, 300);
    }
    EXPECT_NEAR(area / (550.0 * 300.0), 0.62, 0.014);
  }
}

TEST(Scene, AFieldTellsHowItCameOut) {
  const auto loaded = read_scene(R"({
    "ships": [{"hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27}, "mass_kg": 1e7,
               "moment_of_inertia_kg_m2": 5e9, "position_m": [100, 100], "propulsion": {"thrust_N": 2e4}}],
    "structures": [{"radius_m": 20, "position_m": [300, 100]}],
    "floes": [{"rectangle": {"corner_m": [-50, 0], "size_m": 10}},
              {"field": {"corner_m": [0, 0], "extent_m": [400, 200], "floe_size_m": 10, "concentration": 0.8}}]
  })",
                                 "scene.json", ".");
  ASSERT_TRUE(loaded) << all_of(
      loaded.error());  // no floe in the ship or the structure, no two over one another
  ASSERT_EQ(loaded->fields.size(), 1u);
  EXPECT_EQ(loaded->fields[0].group, 1u);
  const auto& outcome = loaded->fields[0].outcome;
  EXPECT_EQ(static_cast<std::size_t>(outcome.count) + 1, loaded->scene.floes.size());
  EXPECT_GT(outcome.left_out, 30);
  EXPECT_DOUBLE_EQ(outcome.region_area, 8e4);
  double area = 0;
  for (std::size_t i = 1; i < loaded->scene.floes.size(); ++i)
    area += geometry::measure(loaded->scene.floes[i].polygon_in_world).area;
  EXPECT_NEAR(area, outcome.floe_area, 1e-6);
}

TEST(Scene, AFieldFollowsTheScenesSeedAndItsOwn) {
  const auto first_corner = [](int scene_seed, int field_seed) {
    const auto loaded = read_scene(fmt::format(R"({{"seed": {}, "floes": [{{"field": {{"corner_m": [0, 0],
      "extent_m": 100, "floe_size_m": 10, "concentration": 0.5, "seed": {}}}}}]}})",
                                               scene_seed, field_seed),
                                   "s", ".");
    return loaded->scene.floes.front().polygon_in_world.outer.front();
  };
  EXPECT_EQ(first_corner(1, 0), first_corner(1, 0));
  EXPECT_NE(first_corner(1, 0), first_corner(2, 0));
  EXPECT_NE(first_corner(1, 0), first_corner(1, 1));
}

TEST(Scene, FieldsAndStructuresHaveTheirOwnMistakes) {
  struct Case {
    std::string text, path, found;
  };
  const auto field = [](const std::string& more) {
    return R"({"floes": [{"field": {"corner_m": [0, 0], "extent_m": 100, "floe_size_m": 10, )" + more +
           "}}]}";
  };
  for (
      const Case& c : std::vector<Case>{
          {field(R"("concentration": 0.95, "gap_m": 3)"), "floes[0].field.concentration", "0.95"},
          {field(R"("concentration": 0.005)"), "floes[0].field", "less than one floe"},
          {field(R"("concentration": 0)"), "floes[0].field.concentration", "0"},
          {field(R"("concentration": 0.5, "most_corners": 2)"), "floes[0].field.most_corners", "2"},
          {field(R"("concentration": 0.5, "keep_clear_m": [[[0, 0], [9, 9], [9, 0], [0, 9]]])"),
           "floes[0].field.keep_clear_m[0]", "self-crossing"},
          {R"({"floes": [{"field": {"corner_m": [0, 0], "extent_m": 1e6, "floe_size_m": 1, "concentration": 0.5}}]})",
           "floes[0].field", "floes in all"},
          {R"({"floes": [{"field": {"outline_m": [[0, 0], [90, 90], [90, 0], [0, 90]], "floe_size_m": 10,
               "concentration": 0.5}}]})",
           "floes[0].field.outline_m", "self-crossing"},
          {R"({"structures": [{"radius_m": 5}], "floes": [{"rectangle": {"corner_m": [0, 0], "size_m": 9}}]})",
           "floes[0]", "an overlap with structures[0]"},
          {R"({"structures": [{"waterline_m": [[0, 0], [9, 9], [9, 0], [0, 9]]}]})",
           "structures[0].waterline_m", "an invalid waterline"},
          {R"({"structures": [{"radius_m": 5}, {"radius_m": 5, "position_m": [50, 0], "name": "structure-1"}]})",
           "structures[1].name", "a second time"},
          {R"({"structures": [{"radius_m": 5, "waterline_m": [[0, 0], [1, 0], [0, 1]]}]})", "structures[0]",
           "together"},
          {R"({"water": {"shear": {"rate_per_s": 0.5}}, "floes": [{"rectangle": {"corner_m": [0, 9000], "size_m": 9}}]})",
           "floes[0]", "moves at 4504 m/s"}}) {
    const auto problems = problems_of(c.text);
    ASSERT_FALSE(problems.empty()) << c.text;
    EXPECT_EQ(problems.front().path, c.path) << all_of(problems);
    EXPECT_NE(problems.front().found.find(c.found), std::string::npos) << all_of(problems);
    EXPECT_GT(problems.front().line, 0);
  }
}

TEST(Scene, AMissingHullNamesTheKeysItNeedsAndThePresets) {
  const std::string text = all_of(problems_of(R"({"ships": [{"propulsion": {"thrust_N": 1}}]})"));
  for (const char* words :
       {"length_m and beam_m and entrance_angle_deg, or waterline_m", "a preset", "reference"})
    EXPECT_NE(text.find(words), std::string::npos) << text;
}

TEST(Scene, ALongKeyIsShortenedBetweenTwoCharacters) {
  std::string key;
  for (int i = 0; i < 50'000; ++i) key += "é";
  const auto problems = problems_of("{\"" + key + "\": 1}");
  ASSERT_FALSE(problems.empty());
  EXPECT_LT(to_string(problems[0]).size(), 1000U);
  EXPECT_LT(to_json_text({problems[0]}).size(), 1000U);
  EXPECT_NE(to_string(problems[0]).find("éé…: found an unknown key"), std::string::npos);
}

/// A field of ice takes long to make: what is wrong without it is reported before, and what is wrong with the
/// ice after that.
TEST(Scene, WhatNeedsNoIceIsCheckedBeforeAFieldIsMade) {
  const std::string field =
      R"({"floes": [{"field": {"corner_m": [-100, -100], "extent_m": [200, 200],
      "concentration": 0.7, "floe_size_m": 20}},
      {"rectangle": {"corner_m": [0, 50], "size_m": 30}}], "ships": [)" +
      std::string(kShip);
  const std::string ice = all_of(problems_of(field + "]}"));
  EXPECT_NE(ice.find("an overlap with floes[0]"), std::string::npos) << ice;
  const std::string both = all_of(problems_of(field + R"(], "time": {"until_s": 0.001}})"));
  EXPECT_NE(both.find("less than one step"), std::string::npos) << both;
  EXPECT_EQ(both.find("an overlap"), std::string::npos) << both;
}

TEST(Words, ANumberAgreesWithWhatItCounts) {
  EXPECT_EQ(counted(1, "split"), "1 split");
  EXPECT_EQ(counted(0U, "split"), "0 splits");
  EXPECT_EQ(counted(2, "push", "pushes"), "2 pushes");
}

}  // namespace
}  // namespace polynya::io
