// Values on the command line, many cases at once, and what studies need of the program.
#include <algorithm>
#include <cstdlib>

#include "program.hpp"
#include <gtest/gtest.h>

namespace polynya::tests {
namespace {

TEST(SetCommand, RunTakesValuesByTheirPaths) {
  const TemporaryFolder folder;
  const Outcome run =
      polynya({"run", scene_path("two-floes"), "--set", "time.until_s=1", "--set", "name=short", "--no-map"},
              {folder.path()});
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string scene = read_file(folder / "runs/short/scene.json");
  EXPECT_NE(scene.find("\"until_s\": 1"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "runs/short/final.svg"));
  EXPECT_EQ(run.out.find("picture"), std::string::npos);
}

TEST(SetCommand, RefusesWhatIsNoValueAndWhatTheSceneDoesNotAllow) {
  const TemporaryFolder folder;
  EXPECT_EQ(polynya({"run", scene_path("two-floes"), "--set", "seed"}, {folder.path()}).code, 2);
  const Outcome wrong =
      polynya({"run", scene_path("two-floes"), "--set", "ice.thickness_m=no"}, {folder.path()});
  EXPECT_EQ(wrong.code, 3);
  EXPECT_EQ(wrong.err.find("--set ice.thickness_m=no: ice.thickness_m: found \"no\""), 0U) << wrong.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "runs"));
}

TEST(ValidateCases, ReportsEveryCaseWithItsPlaceAndCountsThem) {
  const TemporaryFolder folder;
  write_file(
      folder / "cases.ndjson",
      "{\"ice.thickness_m\": 0.4}\n{\"ice.thickness_m\": -1}\n{\"floes[0].rectangle.corner_m\": [10, 0]}\n");
  const Outcome text =
      polynya({"validate", scene_path("two-floes"), "--cases", "cases.ndjson"}, {folder.path()});
  EXPECT_EQ(text.code, 3);
  EXPECT_NE(text.err.find("cases.ndjson:2:21: ice.thickness_m: found -1"), std::string::npos) << text.err;
  EXPECT_NE(text.err.find("cases.ndjson:3: " + scene_path("two-floes")), std::string::npos) << text.err;
  EXPECT_NE(text.err.find("2 of 3 cases are refused"), std::string::npos) << text.err;
  const Outcome json =
      polynya({"validate", scene_path("two-floes"), "--cases", "cases.ndjson", "--json"}, {folder.path()});
  EXPECT_EQ(json.code, 3);
  EXPECT_EQ(json.out.find("{\"line\": 2, \"problems\": [{"), 0U) << json.out;
  EXPECT_EQ(std::ranges::count(json.out, '\n'), 2);
  write_file(folder / "cases.ndjson", "{\"ice.thickness_m\": 0.4}\n{}\n");
  EXPECT_EQ(polynya({"validate", scene_path("two-floes"), "--cases", "cases.ndjson"}, {folder.path()}).out,
            "cases.ndjson: 2 cases, all valid\n");
}

/// What starts Python says so where it cannot.
TEST(StudyCommand, NamesThePythonThatIsMissing) {
  const TemporaryFolder folder;
  setenv("POLYNYA_PYTHON", "/no/such/python3", 1);
  const Outcome outcome = polynya({"study", "gather", "x"}, {folder.path()});
  unsetenv("POLYNYA_PYTHON");
  EXPECT_EQ(outcome.code, 5);
  EXPECT_NE(outcome.err.find(
                "/no/such/python3: No such file or directory; this command needs Python: ./setup.sh python"),
            std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace polynya::tests
