#include "program.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/scene/scene_reader.hpp"
#include "io/text/json_parser.hpp"
#include "simulation/simulation.hpp"

namespace polynya::tests {
namespace {

TEST(CommandLine, HelpLeadsWithExamples) {
  const TemporaryFolder folder;
  const Outcome help = polynya({"--help"}, {folder.path()});
  EXPECT_EQ(help.code, 0);
  EXPECT_EQ(help.out.find("Examples:"), 0U);
  for (const char* command : {"run", "validate", "schema", "init"}) {
    const Outcome of_command = polynya({command, "--help"}, {folder.path()});
    EXPECT_EQ(of_command.code, 0);
    EXPECT_NE(of_command.out.find("Examples:"), std::string::npos) << command;
    EXPECT_NE(help.out.find(command), std::string::npos);
  }
  EXPECT_EQ(polynya({"--version"}, {folder.path()}).out.find("polynya 0."), 0U);
}

TEST(CommandLine, UsageErrorsAreTwo) {
  const TemporaryFolder folder;
  const std::string scene = scene_path("two-floes");
  const std::vector<std::vector<std::string>> wrong{{},
                                                    {"fly"},
                                                    {"run"},
                                                    {"run", scene, "--no-such"},
                                                    {"run", scene, "--until", "-1"},
                                                    {"run", scene, "--until", "soon"},
                                                    {"run", scene, "--threads", "0"},
                                                    {"run", scene, "--seed", "-3"},
                                                    {"run", scene, "--progress", "loud"},
                                                    {"validate"}};
  for (const auto& words : wrong) {
    const Outcome outcome = polynya(words, {folder.path()});
    EXPECT_EQ(outcome.code, 2) << (words.empty() ? "" : words.back());
    EXPECT_TRUE(outcome.out.empty());
    EXPECT_FALSE(outcome.err.empty());
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "runs"));
}

/// Every usage error names the command, the word and what is allowed or was meant.
TEST(CommandLine, UsageErrorsNameTheCommandTheFaultAndWhatWasMeant) {
  const TemporaryFolder folder;
  struct Case {
    std::vector<std::string> words;
    std::string message;
  };
  const std::string commands =
      "commands: run, resume, validate, schema, ships, performance, init, view, channel, figures, movie, "
      "export, "
      "inspect, cut, import, "
      "database, study\n";
  for (const Case& c : std::vector<Case>{
           {{"veiw", "x"}, "polynya: no such command: veiw; did you mean view?\n" + commands},
           {{}, "polynya: a command is missing\n" + commands},
           {{"database", "biuld"},
            "polynya database: no such command: biuld; did you mean build?\ncommands: build, show, query, "
            "study\n"},
           {{"database"}, "polynya database: a command is missing\n"},
           {{"run", "a", "--unitl", "3", "b"},
            "polynya run: not expected: --unitl 3 b; did you mean --until?\npolynya run --help explains its "
            "options\n"},
           {{"run"}, "polynya run: SCENE is missing"},
           {{"run", "a", "--until"}, "polynya run: --until needs a value\n"},
           {{"cut", "x", "--disc", "0,0,1", "--keep", "all"},
            "polynya cut: --keep: \"all\" is not one of: outside, inside, both\n"},
           {{"cut", "x", "--disc", "0,0,1", "--keep", "1"},
            "polynya cut: --keep: \"1\" is not one of: outside, inside, both\n"},
           {{"cut", "x"}, "one of --disc, --crack, --line, --polygon, --ops is needed, none is given\n"},
           {{"cut", "x", "--disc", "0,0,1", "--crack", "0,0,1"}, "--ops is needed, 2 are given\n"},
           {{"channel", "x", "--format", "jsn"},
            "--format: \"jsn\" is not one of: table, csv, json; did you mean json?\n"},
           {{"figures", "x", "--load", "most"},
            "--load: \"most\" is not one of: true, mean, max, ships, j-over-tau-c\n"},
           {{"inspect", "x", "--floe", "1", "--format", "dxf"},
            "--format: \"dxf\" is not one of: wkt, geojson, svg\n"},
           {{"run", "x", "--progress", "loud"},
            "--progress: \"loud\" is not one of: auto, bar, json, none\n"},
           {{"database", "build", "--fluid", "0"},
            "--fluid: \"0\" is not one of: winkler, local-mass, potential, free-surface\n"},
           {{"database", "study", "fluids"},
            "\"fluids\" is not one of: fluid, couple, accuracy; did you mean fluid?\n"}}) {
    const Outcome outcome = polynya(c.words, {folder.path()});
    EXPECT_EQ(outcome.code, 2) << c.message;
    EXPECT_NE(outcome.err.find(c.message), std::string::npos) << outcome.err << "\nwanted: " << c.message;
  }
}

/// CLI11's range accepts nan, and a checkpoint every nan seconds is none.
TEST(CommandLine, EveryNumberMustBeFinite) {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> options{{"run", "--until"},
                                                      {"run", "--checkpoint-every"},
                                                      {"run", "--checkpoint-every-wall"},
                                                      {"resume", "--checkpoint-every"},
                                                      {"resume", "--checkpoint-every-wall"},
                                                      {"view", "--from"},
                                                      {"view", "--until"},
                                                      {"view", "--limit"},
                                                      {"channel", "--at"},
                                                      {"channel", "--spacing"},
                                                      {"channel", "--reach"},
                                                      {"figures", "--at"},
                                                      {"export", "--at"},
                                                      {"inspect", "--at"},
                                                      {"cut", "--sagitta"}};
  for (const auto& option : options) {
    for (const char* word : {"nan", "-inf"}) {
      const Outcome outcome = polynya({option[0], "nowhere", option[1], word}, {folder.path()});
      EXPECT_EQ(outcome.code, 2) << option[0] << ' ' << option[1] << ' ' << word;
      EXPECT_NE(outcome.err.find(option[1] + ": "), std::string::npos) << outcome.err;
    }
  }
}

TEST(CommandLine, AWrongSceneIsThreeAndWritesNothing) {
  const TemporaryFolder folder;
  write_file(folder / "wrong.json",
             R"({"ice": {"thicknes_m": 1}, "time": {"step_s": 0}, "floes": [{"rectangle": {"size_m": 3}}]})");
  for (const auto& words :
       std::vector<std::vector<std::string>>{{"validate", "wrong.json"}, {"run", "wrong.json"}}) {
    const Outcome outcome = polynya(words, {folder.path()});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_TRUE(outcome.out.empty());
    EXPECT_FALSE(std::filesystem::exists(folder / "runs"));
  }
  const std::string err = polynya({"run", "wrong.json"}, {folder.path()}).err;
  EXPECT_NE(err.find("wrong.json:1:10: ice.thicknes_m: "), std::string::npos) << err;
  EXPECT_NE(err.find("did you mean \"thickness_m\"?"), std::string::npos);
  EXPECT_NE(err.find("wrong.json:1:47: time.step_s: found 0"), std::string::npos) << err;
  EXPECT_NE(err.find("3 problems in wrong.json"), std::string::npos);
}

TEST(CommandLine, ASceneThatCannotBeReadIsFive) {
  const TemporaryFolder folder;
  for (const std::string& file :
       {std::string("missing.json"), folder.path().string(), std::string("/dev/zero")}) {
    for (const char* command : {"run", "validate"}) {
      const Outcome outcome = polynya({command, file}, {folder.path()});
      EXPECT_EQ(outcome.code, 5);
      EXPECT_NE(outcome.err.find(file + ": "), std::string::npos) << outcome.err;
      EXPECT_FALSE(std::filesystem::exists(folder / "runs"));
    }
  }
}

/// Problems as JSON: the same places, paths and words as on stderr; none are an empty array.
TEST(CommandLine, ProblemsAreJsonOnRequest) {
  const TemporaryFolder folder;
  write_file(folder / "wrong.json",
             "{\"ice\": {\"thicknes_m\": 1},\n \"time\": {\"step_s\": 0},\n \"name\": \"a \\\"b\\\"\"}");
  const Outcome text = polynya({"validate", "wrong.json"}, {folder.path()});
  const Outcome outcome = polynya({"validate", "wrong.json", "--json"}, {folder.path()});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.err, "");
  const io::JsonDocument problems = io::parse_json(outcome.out);
  ASSERT_TRUE(problems.faults.empty()) << outcome.out;
  ASSERT_EQ(problems.root.items().size(), 3U) << outcome.out;
  for (const io::JsonValue& problem : problems.root.items()) {
    const auto member = [&](const char* key) { return problem.find(key); };
    EXPECT_EQ(member("severity")->text(), "error");
    const std::string line =
        fmt::format("{}:{}:{}: {}: {}\n", member("file")->text(), member("line")->number(),
                    member("column")->number(), member("path")->text(), member("message")->text());
    EXPECT_NE(text.err.find(line), std::string::npos) << line << text.err;
  }
  EXPECT_EQ(problems.root.items()[1].find("line")->number(), 2);
  EXPECT_EQ(problems.root.items()[1].find("path")->text(), "time.step_s");
  const Outcome sound = polynya({"validate", scene_path("two-floes"), "--json"}, {folder.path()});
  EXPECT_EQ(sound.code, 0);
  EXPECT_EQ(sound.out, "[]\n");
  const Outcome missing = polynya({"validate", "missing.json", "--json"}, {folder.path()});
  EXPECT_EQ(missing.code, 5);
  EXPECT_TRUE(io::parse_json(missing.out).root.items().at(0).find("line")->is_null()) << missing.out;
  EXPECT_EQ(polynya({"validate", "wrong.json", "--json", "--resolved"}, {folder.path()}).code, 2);
}

TEST(CommandLine, HintsStandInTheTerminalAndChangeNoExitCode) {
  const TemporaryFolder folder;
  write_file(folder / "light.json", R"({"time": {"until_s": 0.1}, "ships": [
    {"hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27},
     "mass_kg": 1e4, "moment_of_inertia_kg_m2": 5e9, "propulsion": {"thrust_N": 0}}],
    "floes": []})");
  const std::string warning = "light.json:3:17: warning: ships[0].mass_kg: 1e+04 kg for a hull of 120 × 24 m";
  for (const auto& words :
       std::vector<std::vector<std::string>>{{"validate", "light.json"}, {"run", "light.json"}}) {
    const Outcome outcome = polynya(words, {folder.path()});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find(warning), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("light.json:4:14: hint: floes: there is no ice"), std::string::npos)
        << outcome.err;
  }
  const Outcome json = polynya({"validate", "light.json", "--json"}, {folder.path()});
  EXPECT_EQ(json.code, 0);
  EXPECT_EQ(json.err, "");
  const io::JsonDocument hints = io::parse_json(json.out);
  ASSERT_EQ(hints.root.items().size(), 2U) << json.out;
  EXPECT_EQ(hints.root.items()[0].find("severity")->text(), "warning");
  EXPECT_EQ(hints.root.items()[1].find("severity")->text(), "hint");
}

/// A scene from stdin is the scene: the same hash, floe files from the working folder, its problems "stdin".
TEST(CommandLine, ASceneComesFromStdin) {
  const TemporaryFolder folder;
  write_file(folder / "floes.geojson",
             R"({"type": "Polygon", "coordinates": [[[0,0],[10,0],[10,10],[0,10],[0,0]]]})");
  write_file(folder / "scene.json",
             R"({"name": "piped", "time": {"until_s": 0.1}, "floes": [{"file": "floes.geojson"}]})");
  write_file(folder / "wrong.json", "{\"floes\": [\n}");
  const Start piped{folder.path(), RLIM_INFINITY, folder / "scene.json"};
  const std::string valid = polynya({"validate", "scene.json"}, {folder.path()}).out;
  const std::string from_stdin = polynya({"validate", "-"}, piped).out;
  EXPECT_EQ(from_stdin, "stdin" + valid.substr(valid.find(':')));
  const Outcome run = polynya({"run", "-", "--progress", "none"}, piped);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "runs/piped/scene.json"));
  const Outcome wrong = polynya({"run", "-"}, {folder.path(), RLIM_INFINITY, folder / "wrong.json"});
  EXPECT_EQ(wrong.code, 3);
  EXPECT_EQ(wrong.err.find("stdin:2:1: found '}'"), 0U) << wrong.err;
}

TEST(CommandLine, InitWritesASceneThatIsValid) {
  const TemporaryFolder folder;
  EXPECT_EQ(polynya({"init", "new.json"}, {folder.path()}).code, 0);
  const Outcome valid = polynya({"validate", "new.json"}, {folder.path()});
  EXPECT_EQ(valid.code, 0) << valid.err;
  const std::string kept = read_file(folder / "new.json");
  EXPECT_EQ(polynya({"init", "new.json"}, {folder.path()}).code, 5);
  EXPECT_EQ(read_file(folder / "new.json"), kept);
  EXPECT_EQ(polynya({"init"}, {folder.path()}).out, kept);
}

/// Nothing but ice acts on a ship, so the first scene a user runs must not accelerate through open water.
TEST(CommandLine, TheShipOfInitsSceneDoesNotRunAway) {
  const TemporaryFolder folder;
  ASSERT_EQ(polynya({"init", "new.json"}, {folder.path()}).code, 0);
  const auto scene = io::read_scene_file(folder / "new.json");
  ASSERT_TRUE(scene.has_value());
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

TEST(CommandLine, SchemaAndResolvedSceneAreJson) {
  const TemporaryFolder folder;
  const Outcome schema = polynya({"schema"}, {folder.path()});
  EXPECT_EQ(schema.code, 0);
  EXPECT_TRUE(io::parse_json(schema.out).faults.empty());
  const Outcome resolved = polynya({"validate", scene_path("level-plate"), "--resolved"}, {folder.path()});
  EXPECT_EQ(resolved.code, 0);
  EXPECT_TRUE(io::read_scene(resolved.out, "resolved.json", ".").has_value());
}

}  // namespace
}  // namespace polynya::tests
