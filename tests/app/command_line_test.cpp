#include "program.hpp"
#include <gtest/gtest.h>

#include "io/json_parser.hpp"
#include "io/scene_reader.hpp"
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
  const std::string told = polynya({"run", "wrong.json"}, {folder.path()}).err;
  EXPECT_NE(told.find("wrong.json:1:10: ice.thicknes_m: "), std::string::npos) << told;
  EXPECT_NE(told.find("did you mean \"thickness_m\"?"), std::string::npos);
  EXPECT_NE(told.find("wrong.json:1:47: time.step_s: found 0"), std::string::npos) << told;
  EXPECT_NE(told.find("3 problems in wrong.json"), std::string::npos);
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
