// The commands around scenes: validate, run --set, init, schema; problems and hints in the terminal and as JSON.
#include "program.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/scene/scene_file.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/scene/ship_presets.hpp"
#include "simulation/simulation.hpp"

namespace polynya::tests {
namespace {

class CommandLine : public InFolder {
 protected:
  Outcome piped(const Words& words, const std::string& input) const {
    return polynya(words, Start{.folder = folder.path(), .input = folder / input});
  }
};
using ShipsCommand = InFolder;

/// Returns the JSON that a command printed.
nlohmann::json printed(const Outcome& outcome) {
  const auto json = nlohmann::json::parse(outcome.out, nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << outcome.out;
  return json;
}

TEST_F(CommandLine, AWrongSceneIsThreeAndWritesNothing) {
  write("wrong.json", R"({"ice": {"thicknes_m": 1}, "time": {"step_s": 0}, "floes": [{"rectangle": {"size_m": 3}}]})");
  write("wrong-in-lines.json", "{\"floes\": [\n}");
  for (const char* command : {"validate wrong.json", "run wrong.json"}) {
    expect_refusals({{command, 3, "wrong.json:1:10: ice.thicknes_m: "}}, {folder.path()});
    EXPECT_HAS(call(command).err, "did you mean \"thickness_m\"?", "wrong.json:1:47: time.step_s: found 0",
               "3 problems in wrong.json");
  }
  EXPECT_BEGINS(expect_code(3, piped("run -", "wrong-in-lines.json")).err, "stdin:2:1: found '}'");
  const std::string set = "--set ice.thickness_m=no";
  EXPECT_BEGINS(expect_code(3, call("run scenes/two-floes.json " + set)).err, set + ": ice.thickness_m: found \"no\"");
  EXPECT_FALSE(std::filesystem::exists(folder / "runs"));
}

TEST_F(CommandLine, ProblemsAreJsonOnRequest) {
  write("wrong.json", "{\"ice\": {\"thicknes_m\": 1},\n \"time\": {\"step_s\": 0},\n \"name\": \"a \\\"b\\\"\"}");
  const Outcome text = call("validate wrong.json"), outcome = expect_code(3, call("validate wrong.json --json"));
  EXPECT_EQ(outcome.err, "");
  const auto problems = printed(outcome);
  ASSERT_EQ(problems.size(), 3U) << outcome.out;
  for (const auto& problem : problems) {
    const auto text_at = [&](const char* key) { return problem.at(key).get<std::string>(); };
    EXPECT_EQ(problem.at("severity"), "error");
    EXPECT_HAS(text.err, fmt::format("{}:{}:{}: {}: {}\n", text_at("file"), problem.at("line").get<int>(),
                                     problem.at("column").get<int>(), text_at("path"), text_at("message")));
  }
  EXPECT_EQ(problems[1].at("line"), 2);
  EXPECT_EQ(problems[1].at("path"), "time.step_s");
  EXPECT_EQ(done("validate scenes/two-floes.json --json").out, "[]\n");
  EXPECT_TRUE(printed(expect_code(5, call("validate missing.json --json"))).at(0).at("line").is_null());
}

TEST_F(CommandLine, HintsChangeNoExitCode) {
  write("light.json", R"({"time": {"until_s": 0.1}, "ships": [
    {"hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27},
     "mass_kg": 1e4, "moment_of_inertia_kg_m2": 5e9, "propulsion": {"thrust_N": 0}}],
    "floes": []})");
  for (const char* command : {"validate light.json", "run light.json"}) {
    EXPECT_HAS(done(command).err, "light.json:3:17: warning: ships[0].mass_kg: 1e+04 kg for a hull of 120 × 24 m",
               "light.json:4:14: hint: floes: there is no ice");
  }
  const Outcome json = done("validate light.json --json");
  EXPECT_EQ(json.err, "");
  const auto hints = printed(json);
  ASSERT_EQ(hints.size(), 2U) << json.out;
  EXPECT_EQ(hints[0].at("severity"), "warning");
  EXPECT_EQ(hints[1].at("severity"), "hint");
}

/// A scene from stdin is the scene: the same hash, and floe files from the working folder.
TEST_F(CommandLine, ASceneComesFromStdin) {
  write("floes.geojson", R"({"type": "Polygon", "coordinates": [[[0,0],[10,0],[10,10],[0,10],[0,0]]]})");
  write("scene.json", R"({"name": "piped", "time": {"until_s": 0.1}, "floes": [{"file": "floes.geojson"}]})");
  const std::string valid = call("validate scene.json").out;
  EXPECT_EQ(piped("validate -", "scene.json").out, "stdin" + valid.substr(valid.find(':')));
  expect_code(0, piped("run - --progress none", "scene.json"));
  EXPECT_TRUE(std::filesystem::exists(folder / "runs/piped/scene.json"));
}

/// Only ice acts on a ship by default, so the first scene of a user must not let the ship accelerate through open
/// water.
TEST_F(CommandLine, InitWritesAValidSceneWhoseShipDoesNotRunAway) {
  done("init new.json");
  EXPECT_EQ(call("init").out, read("new.json"));
  const auto scene = checked(io::read_scene_file(folder / "new.json"));
  simulation::Simulation simulation(scene->scene);
  double fastest = 0;
  while (simulation.time() < scene->scene.time.until) {
    simulation.step();
    simulation.journal().clear();
    fastest = std::max(fastest, length(simulation.ship_states().front().velocity));
  }
  EXPECT_GT(simulation.counts().bends, 0);
  EXPECT_LE(fastest, 2.0);
}

TEST_F(CommandLine, SetPutsValuesByTheirPaths) {
  const Outcome run = done("run scenes/two-floes.json --set time.until_s=1 --set name=short --no-map");
  EXPECT_HAS(read("runs/short/scene.json"), "\"until_s\": 1");
  EXPECT_FALSE(std::filesystem::exists(folder / "runs/short/final.svg"));
  EXPECT_LACKS(run.out, "picture");
}

TEST_F(CommandLine, CasesAreReportedEachWithItsPlaceAndCounted) {
  const std::string thin = "{\"ice.thickness_m\": 0.4}\n";
  write("cases.ndjson", thin + "{\"ice.thickness_m\": -1}\n{\"floes[0].rectangle.corner_m\": [10, 0]}\n");
  const Words validate = "validate scenes/two-floes.json --cases cases.ndjson";
  EXPECT_HAS(expect_code(3, call(validate)).err, "cases.ndjson:2:21: ice.thickness_m: found -1",
             "cases.ndjson:3: " + scene_path("two-floes"), "2 of 3 cases are refused");
  const Outcome json = expect_code(3, call(validate + "--json"));
  EXPECT_BEGINS(json.out, "{\"line\": 2, \"problems\": [{");
  EXPECT_EQ(std::ranges::count(json.out, '\n'), 2);
  write("cases.ndjson", thin + "{}\n");
  EXPECT_EQ(call(validate).out, "cases.ndjson: 2 cases, all valid\n");
}

// ---- ships: the list, a ship with its sources, both as JSON; and the ship of a file

TEST_F(ShipsCommand, PrintsTheListAsJsonOfEachShipAsItPrintsThat) {
  const Outcome table = done("ships");
  const auto ships = printed(done("ships --json"));
  ASSERT_EQ(ships.size(), io::ship_presets().size());
  for (const auto& ship : ships) {
    const std::string name = ship.at("name");
    EXPECT_HAS(table.out, "\n" + name + " ");
    EXPECT_GT(ship.at("ship").at("hull").size(), 0u) << name;
    EXPECT_EQ(printed(done({"ships", name, "--json"})), ship);
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
TEST_F(ShipsCommand, AShipOfAFileHasTheProblemsThatItHasInAScene) {
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
    write("ship.json", text);
    const Outcome refused = expect_code(3, call("ships ship.json --json"));
    EXPECT_TRUE(refused.out.empty()) << refused.out;
    if (text.ends_with('}') || text.ends_with(']')) {
      EXPECT_EQ(refused.err.substr(0, expected.size()), expected) << text;
    }
    EXPECT_TRUE(refused.err.starts_with("ship.json:1:") || refused.err.starts_with("ship.json:3:")) << refused.err;
  }
}

TEST_F(ShipsCommand, AShipOfAFileIsPrintedAsItsSceneResolvesIt) {
  const std::string text = R"({"ship": "polaris", // as scenes have it
    "hull": {"draught_m": 8.5}})";
  write("deeper.json", text);
  const auto ship = printed(done("ships deeper.json --json"));
  const auto scene = checked(io::read_scene("{\"ships\": [" + text + "]}", "scene.json", "."));
  EXPECT_EQ(ship.at("ship"), nlohmann::json::parse(scene->resolved_text).at("ships").at(0));
  EXPECT_EQ(ship.at("title"), "deeper");
  EXPECT_EQ(ship.at("engine").at("bollard_pull_N"), 2.1e6);
  EXPECT_EQ(ship.at("reported").size(), 2u);
  EXPECT_HAS(call("ships deeper.json").out, "hull.draught_m                                         8.5  given\n",
             "hull.beam_m                                             24  polaris\n",
             "hull.submersion_speed_factor                   \"lindqvist\"  default\n");
}

TEST_F(ShipsCommand, EverythingThatPerformanceLacksIsNamedAtOnce) {
  const std::vector<std::string> all{"hull.length_m: found nothing", "hull.beam_m: found nothing",
                                     "hull.draught_m: found nothing", "hull.block_coefficient: found nothing",
                                     "propulsion.engine.power_MW: found nothing"};
  for (const char* text : {"{}", R"({"hull": {}, "propulsion": {}})", R"({"propulsion": {"engine": {}}})"}) {
    write("lacking.json", text);
    const Outcome outcome = expect_code(3, call("ships lacking.json --for-performance"));
    for (const std::string& line : all) EXPECT_HAS(outcome.err, line);
    EXPECT_HAS(outcome.err, "5 problems in lacking.json");
  }
  write("lacking.json", R"({"hull": {"beam_m": 20, "draught_m": -1}, "mooring": {}, "propulsion": {"engine": {}}})");
  const std::string found = call("ships lacking.json --for-performance").err;
  for (const std::string& line : all)
    EXPECT_EQ(found.find(line) != std::string::npos,
              !line.starts_with("hull.beam") && !line.starts_with("hull.draught"))
        << line;
  EXPECT_HAS(found, "hull.draught_m: found -1", "mooring: found a mooring");
  write("lacking.json", "[]");
  EXPECT_HAS(call("ships lacking.json --for-performance").err, "1 problem in lacking.json");
}

/// A particular that is estimated from others is not asked for beside them, so that no two hints refer to each other.
TEST_F(ShipsCommand, WhatPerformanceAsksForEndsWithOneParticular) {
  const std::string ship = R"("hull": {"length_m": 95, "beam_m": 20, "draught_m": 6.5)";
  const auto with = [&](const std::string& of_hull, const std::string& of_engine, const std::string& of_ship) {
    write("ours.json",
          "{" + of_ship + ship + of_hull + R"(}, "propulsion": {"engine": {"power_MW": 9)" + of_engine + "}}}");
    return call("ships ours.json --for-performance");
  };
  const Outcome refused = expect_code(3, with("", "", ""));
  EXPECT_HAS(refused.err, "hull.block_coefficient: found nothing, allowed: one of three particulars", "mass_kg",
             "open_water_speed_m_per_s (> 0, ≤ 30 m/s)", "1 problem in ours.json");
  EXPECT_EQ(with(R"(, "block_coefficient": 0.62)", "", "").code, 0);
  EXPECT_EQ(with("", R"(, "open_water_speed_m_per_s": 8)", "").code, 0);
  EXPECT_EQ(with("", "", R"("mass_kg": 7e6, )").code, 0);
  // A mass that does not fit the dimensions leaves nothing to estimate from.
  EXPECT_HAS(expect_code(3, with("", "", R"("mass_kg": 7e4, )")).err, "mass_kg: found 70000");
}

TEST_F(ShipsCommand, WhatIsNotStatedIsEstimatedByAFormulaThatIsNamed) {
  write("sparse.json", R"({"hull": {"length_m": 84, "beam_m": 20, "draught_m": 7, "block_coefficient": 0.62},
    "propulsion": {"engine": {"power_MW": 9, "propellers": 2}}})");
  expect_code(3, call("ships sparse.json"));  // a scene needs it stated
  const std::string text = call("ships sparse.json --for-performance").out;
  EXPECT_HAS(text, "propulsion.engine.propeller_diameter_m                4.55  estimated\n",
             "hull.stem_angle_deg                                     30  default\n", "[Holtrop1984]",
             "hull.length_m                                           84  given\n");
  const auto json = printed(done("ships sparse.json --for-performance --json"));
  EXPECT_EQ(json.at("from").at("propulsion.engine.open_water_speed_m_per_s"), "estimated");
  EXPECT_EQ(json.at("from").at("hull.length_m"), "given");
  EXPECT_EQ(json.at("estimated").size(), 3u) << "speed, entrance angle, diameter";
  const double speed = json.at("ship").at("propulsion").at("engine").at("open_water_speed_m_per_s");
  EXPECT_GT(speed, 7);
  EXPECT_LT(speed, 9);
  write("sparse.json", R"({"mass_kg": 7e6, "hull": {"length_m": 84, "beam_m": 20, "draught_m": 7},
    "propulsion": {"engine": {"bollard_pull_kN": 1000, "open_water_speed_m_per_s": 8}}})");
  const auto by_mass = printed(done("ships sparse.json --for-performance --json"));
  EXPECT_NEAR(by_mass.at("ship").at("hull").at("block_coefficient").get<double>(), 7e6 / (1000 * 84 * 20 * 7), 5e-4);
}

TEST_F(ShipsCommand, WhatIsNoShipOrNoneForPerformanceIsRefusedWithItsPlace) {
  write("scene.json", R"({"ships": []})");
  write("outline.json", R"({"name": "x", "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9,
    "hull": {"waterline_m": [[60, 0], [30, 12], [-60, 12], [-60, -12], [30, -12]]},
    "propulsion": {"thrust_N": 1e6}, "mooring": {}})");
  done("ships outline.json");
  const Words outline = "ships outline.json --for-performance";
  expect_refusals({{outline, 3, "outline.json:2:29: hull.waterline_m: "},
                   {outline, 3, "outline.json:2:13: hull.draught_m: "},
                   {outline, 3, "outline.json:3:19: propulsion.engine: "},
                   {outline, 3, "outline.json:3:49: mooring: "},
                   {"ships sawamura2017 --for-performance", 3, "sawamura2017: "},
                   {"ships titanic", 2, "no preset and no file is named \"titanic\"; presets: "},
                   {"ships araoon --json", 2, "no preset and no file is named \"araoon\"; did you mean araon?"},
                   {"ships nofile.json", 5, "polynya: nofile.json: no such file\n"},
                   {"ships scene.json", 3, "scene.json:1:1: found a scene, with its \"ships\""}},
                  {folder.path()});
}

}  // namespace
}  // namespace polynya::tests
