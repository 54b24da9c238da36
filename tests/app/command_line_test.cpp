// The commands around scenes: validate, run --set, init, schema; problems and hints in the terminal and as
// JSON.
#include "program.hpp"
#include <fmt/format.h>

#include "io/scene/scene_reader.hpp"
#include "io/text/json_parser.hpp"
#include "simulation/simulation.hpp"

namespace polynya::tests {
namespace {

class CommandLine : public testing::Test {
 protected:
  Outcome call(const Words& words) const { return polynya(words, folder); }
  Outcome piped(const Words& words, const std::string& input) const {
    return polynya(words, Start{.folder = folder.path(), .input = folder / input});
  }
  TemporaryFolder folder;
};

TEST_F(CommandLine, AWrongSceneIsThreeAndWritesNothing) {
  write_file(folder / "wrong.json",
             R"({"ice": {"thicknes_m": 1}, "time": {"step_s": 0}, "floes": [{"rectangle": {"size_m": 3}}]})");
  write_file(folder / "wrong-in-lines.json", "{\"floes\": [\n}");
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
  write_file(folder / "wrong.json",
             "{\"ice\": {\"thicknes_m\": 1},\n \"time\": {\"step_s\": 0},\n \"name\": \"a \\\"b\\\"\"}");
  const Outcome text = call("validate wrong.json"), outcome = call("validate wrong.json --json");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.err, "");
  const io::JsonDocument problems = io::parse_json(outcome.out);
  ASSERT_TRUE(problems.faults.empty()) << outcome.out;
  ASSERT_EQ(problems.root.items().size(), 3U) << outcome.out;
  for (const io::JsonValue& problem : problems.root.items()) {
    const auto member = [&](const char* key) { return problem.find(key); };
    EXPECT_EQ(member("severity")->text(), "error");
    EXPECT_HAS(text.err, fmt::format("{}:{}:{}: {}: {}\n", member("file")->text(), member("line")->number(),
                                     member("column")->number(), member("path")->text(), member("message")->text()));
  }
  EXPECT_EQ(problems.root.items()[1].find("line")->number(), 2);
  EXPECT_EQ(problems.root.items()[1].find("path")->text(), "time.step_s");
  EXPECT_EQ(expect_code(0, call("validate scenes/two-floes.json --json")).out, "[]\n");
  const Outcome missing = expect_code(5, call("validate missing.json --json"));
  EXPECT_TRUE(io::parse_json(missing.out).root.items().at(0).find("line")->is_null()) << missing.out;
}

TEST_F(CommandLine, HintsChangeNoExitCode) {
  write_file(folder / "light.json", R"({"time": {"until_s": 0.1}, "ships": [
    {"hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27},
     "mass_kg": 1e4, "moment_of_inertia_kg_m2": 5e9, "propulsion": {"thrust_N": 0}}],
    "floes": []})");
  for (const char* command : {"validate light.json", "run light.json"}) {
    EXPECT_HAS(expect_code(0, call(command)).err,
               "light.json:3:17: warning: ships[0].mass_kg: 1e+04 kg for a hull of 120 × 24 m",
               "light.json:4:14: hint: floes: there is no ice");
  }
  const Outcome json = expect_code(0, call("validate light.json --json"));
  EXPECT_EQ(json.err, "");
  const io::JsonDocument hints = io::parse_json(json.out);
  ASSERT_EQ(hints.root.items().size(), 2U) << json.out;
  EXPECT_EQ(hints.root.items()[0].find("severity")->text(), "warning");
  EXPECT_EQ(hints.root.items()[1].find("severity")->text(), "hint");
}

/// A scene from stdin is the scene: the same hash, and floe files from the working folder.
TEST_F(CommandLine, ASceneComesFromStdin) {
  write_file(folder / "floes.geojson", R"({"type": "Polygon", "coordinates": [[[0,0],[10,0],[10,10],[0,10],[0,0]]]})");
  write_file(folder / "scene.json",
             R"({"name": "piped", "time": {"until_s": 0.1}, "floes": [{"file": "floes.geojson"}]})");
  const std::string valid = call("validate scene.json").out;
  EXPECT_EQ(piped("validate -", "scene.json").out, "stdin" + valid.substr(valid.find(':')));
  const Outcome run = expect_code(0, piped("run - --progress none", "scene.json"));
  EXPECT_TRUE(std::filesystem::exists(folder / "runs/piped/scene.json"));
}

/// Nothing but ice acts on a ship, so the first scene a user runs must not accelerate through open water.
TEST_F(CommandLine, InitWritesAValidSceneWhoseShipDoesNotRunAway) {
  EXPECT_EQ(call("init new.json").code, 0);
  EXPECT_EQ(call("init").out, read_file(folder / "new.json"));
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

TEST_F(CommandLine, SchemaAndResolvedSceneAreJson) {
  const Outcome schema = call("schema"), resolved = call("validate scenes/level-plate.json --resolved");
  EXPECT_EQ(schema.code + resolved.code, 0);
  EXPECT_TRUE(io::parse_json(schema.out).faults.empty());
  EXPECT_TRUE(io::read_scene(resolved.out, "resolved.json", ".").has_value());
}

TEST_F(CommandLine, SetPutsValuesByTheirPaths) {
  const Outcome run = expect_code(0, call("run scenes/two-floes.json --set time.until_s=1 --set name=short --no-map"));
  EXPECT_HAS(read_file(folder / "runs/short/scene.json"), "\"until_s\": 1");
  EXPECT_FALSE(std::filesystem::exists(folder / "runs/short/final.svg"));
  EXPECT_LACKS(run.out, "picture");
}

TEST_F(CommandLine, CasesAreReportedEachWithItsPlaceAndCounted) {
  const std::string thin = "{\"ice.thickness_m\": 0.4}\n";
  write_file(folder / "cases.ndjson", thin + "{\"ice.thickness_m\": -1}\n{\"floes[0].rectangle.corner_m\": [10, 0]}\n");
  const Words validate = "validate scenes/two-floes.json --cases cases.ndjson";
  EXPECT_HAS(expect_code(3, call(validate)).err, "cases.ndjson:2:21: ice.thickness_m: found -1",
             "cases.ndjson:3: " + scene_path("two-floes"), "2 of 3 cases are refused");
  const Outcome json = expect_code(3, call(validate + "--json"));
  EXPECT_BEGINS(json.out, "{\"line\": 2, \"problems\": [{");
  EXPECT_EQ(std::ranges::count(json.out, '\n'), 2);
  write_file(folder / "cases.ndjson", thin + "{}\n");
  EXPECT_EQ(call(validate).out, "cases.ndjson: 2 cases, all valid\n");
}

}  // namespace
}  // namespace polynya::tests
