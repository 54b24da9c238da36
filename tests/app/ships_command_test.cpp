// What `ships` prints: the list, a ship with its sources, both as JSON; and the ship of a file.
#include "program.hpp"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/scene/scene_reader.hpp"
#include "io/scene/ship_presets.hpp"

namespace polynya::tests {
namespace {

TEST(ShipsCommand, PrintsTheListAsJsonOfEachShipAsItPrintsThat) {
  const TemporaryFolder folder;
  const Outcome table = polynya("ships", folder), list = polynya("ships --json", folder);
  ASSERT_EQ(table.code + list.code, 0) << list.err;
  const auto ships = nlohmann::json::parse(list.out);
  ASSERT_EQ(ships.size(), io::ship_presets().size());
  for (const auto& ship : ships) {
    const std::string name = ship.at("name");
    EXPECT_HAS(table.out, "\n" + name + " ");
    EXPECT_GT(ship.at("ship").at("hull").size(), 0u) << name;
    EXPECT_EQ(nlohmann::json::parse(polynya({"ships", name, "--json"}, folder).out), ship);
  }
}

constexpr const char* kWrongShips[] = {
    R"({"hull": {"length_m": 121.2, "beam_m": 25.0, "entrance_angle_deg": 30, "draught_m": 8.92, )"
    R"("block_coefficient": 0.58},
 "mass_kg": 16.5e6,
 "propulsion": {"engine": {"power_MW": 22.4, "propellers": 2, "diameter_m": 4.87, "open_water_speed_m_per_s": 9.0}}})",
    R"({"ship": "araoon"})",
    R"({"ship": "polaris", "hull": {"draught_m": -8.9}, "propulsion": {"engine": {"power_MW": "22.4"}}})",
    R"({"ship": "polaris", "hull": 0, "pilot": {"hold_headin": {}}})",
    R"({"ship": "polaris", "propulsion": {"engine": {"open_water_speed_m_per_s": Infinity}}})",
    R"({"ship": "polaris", "propulsion": {"engine": {"open_water_speed_m_per_s": 1e999}}})",
    R"({"ship": "polaris", "mass_kg": NaN})",
    R"({"ship": "polaris", "mass_kg": 1, "mass_kg": 2})",
    R"({"ship": "polaris",})",
    R"({"ship": "polaris", "mooring": {"break_load_N": 1)",
    "[1]",
    ""};

/// A ship of a file is read by the code that reads a scene's: the same problems at the same places.
TEST(ShipsCommand, AShipOfAFileHasTheProblemsThatItHasInAScene) {
  const TemporaryFolder folder;
  for (const std::string text : kWrongShips) {
    const auto scene = io::read_scene("{\"ships\": [\n" + text + "\n]}", "ship.json", ".");
    ASSERT_FALSE(scene) << text;
    std::string expected;
    for (io::Problem problem : scene.error()) {
      --problem.line;
      const std::string prefix = "ships[0]";
      if (problem.path.starts_with(prefix)) problem.path.erase(0, prefix.size() + (problem.path.size() > 8));
      expected += to_string(problem) + "\n";
    }
    write_file(folder / "ship.json", text);
    const Outcome refused = expect_code(3, polynya("ships ship.json --json", folder));
    EXPECT_TRUE(refused.out.empty()) << refused.out;
    if (text.ends_with('}') || text.ends_with(']')) {
      EXPECT_EQ(refused.err.substr(0, expected.size()), expected) << text;
    }
    EXPECT_TRUE(refused.err.starts_with("ship.json:1:") || refused.err.starts_with("ship.json:3:")) << refused.err;
  }
}

TEST(ShipsCommand, AShipOfAFileIsPrintedAsItsSceneResolvesIt) {
  const TemporaryFolder folder;
  const std::string text = R"({"ship": "polaris", // as scenes have it
    "hull": {"draught_m": 8.5}})";
  write_file(folder / "deeper.json", text);
  const Outcome printed = expect_code(0, polynya("ships deeper.json --json", folder));
  const auto ship = nlohmann::json::parse(printed.out);
  const auto scene = checked(io::read_scene("{\"ships\": [" + text + "]}", "scene.json", "."));
  EXPECT_EQ(ship.at("ship"), nlohmann::json::parse(scene->resolved_text).at("ships").at(0));
  EXPECT_EQ(ship.at("title"), "deeper");
  EXPECT_EQ(ship.at("engine").at("bollard_pull_N"), 2.1e6);
  EXPECT_EQ(ship.at("reported").size(), 2u);
  const Outcome list = polynya("ships deeper.json", folder);
  EXPECT_HAS(list.out, "hull.draught_m                                         8.5  given\n",
             "hull.beam_m                                             24  polaris\n",
             "hull.submersion_speed_factor                   \"lindqvist\"  default\n");
}

TEST(ShipsCommand, WhatIsNoShipOrNoneForPerformanceIsRefusedWithItsPlace) {
  const TemporaryFolder folder;
  write_file(folder / "scene.json", R"({"ships": []})");
  write_file(folder / "outline.json", R"({"name": "x", "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9,
    "hull": {"waterline_m": [[60, 0], [30, 12], [-60, 12], [-60, -12], [30, -12]]},
    "propulsion": {"thrust_N": 1e6}, "mooring": {}})");
  EXPECT_EQ(polynya("ships outline.json", folder).code, 0);
  const Words outline = "ships outline.json --for-performance";
  expect_refusals({{outline, 3, "outline.json:2:29: hull.waterline_m: "},
                   {outline, 3, "outline.json:2:13: hull.draught_m: "},
                   {outline, 3, "outline.json:3:19: propulsion.engine: "},
                   {outline, 3, "outline.json:3:49: mooring: "},
                   {"ships sawamura2017 --for-performance", 3, "sawamura2017: "},
                   {"ships titanic", 2, "no ship \"titanic\"; there are"},
                   {"ships araoon --json", 2, "no ship \"araoon\"; did you mean araon?"},
                   {"ships nofile.json", 5, "polynya: nofile.json: no such file\n"},
                   {"ships scene.json", 3, "scene.json:1:1: found a scene, with its \"ships\""}},
                  {folder.path()});
}

}  // namespace
}  // namespace polynya::tests
