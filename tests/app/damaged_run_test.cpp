#include "program.hpp"
#include <gtest/gtest.h>

#include "io/run/records.hpp"
#include "io/run/run_reader.hpp"

namespace polynya::tests {
namespace {

const std::vector<Words> kReading{"inspect damaged",
                                  "inspect damaged --check",
                                  "inspect damaged --fsd",
                                  "inspect damaged --floe 0 --format geojson",
                                  "view damaged",
                                  "channel damaged",
                                  "export damaged --vtk vtk",
                                  "export damaged --geojson layers"};

class DamagedRun : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new TemporaryFolder;
    write_file(folder->path() / "tiny.json", kTinyScene);
    ASSERT_EQ(call("run tiny.json --out damaged").code, 0);
    // Every shape whole: no other line then needs the vertices of one that is damaged.
    const auto run = checked(io::read_run(folder->path() / "damaged"));
    floes = new std::string;
    for (const io::RunFloe& floe : run->floes)
      io::append_birth(*floes, {floe.birth, *run->shape(floe.birth.floe)}, nullptr);
    write_file(file(), *floes);
  }
  static void TearDownTestSuite() {
    delete floes;
    delete folder;
  }
  /// Without rsvg-convert, which takes seconds.
  static Outcome call(const Words& words) {
    return polynya(words, Start{.folder = folder->path(), .arrange_streams = [] { setenv("PATH", "/", 1); }});
  }
  static std::filesystem::path file() { return folder->path() / "damaged/floes.ndjson"; }
  /// Writes other rings to the first floe, a plate.
  static void damage(const std::string& ring, const std::string& holes = "") {
    const std::size_t start = floes->find("\"ring_m\":");
    const std::size_t end = floes->find('\n');
    std::string text = *floes;
    text.replace(start, end - start, R"("ring_m":)" + ring + R"(,"holes_m":[)" + holes + "]}");
    write_file(file(), text);
  }
  static inline TemporaryFolder* folder = nullptr;
  static inline std::string* floes = nullptr;
};

TEST_F(DamagedRun, ARingOfTooFewPointsIsNamedWithItsLineByEveryCommand) {
  const char* square = "[[0,0],[9,0],[9,9],[0,9]]";
  const std::vector<std::pair<std::string, std::string>> rings{
      {"[]", ""},     {"[[0,0]]", ""},          {"[[0,0],[1,1]]", ""}, {"[[0,0],[1,0],[1,1e999]]", ""},
      {square, "[]"}, {square, "[[1,1],[2,2]]"}};
  for (const auto& [ring, hole] : rings) {
    damage(ring, hole);
    for (const auto& words : kReading) {
      EXPECT_HAS(expect_code(5, call(words)).err, "damaged/floes.ndjson:1: ");
    }
  }
}

TEST_F(DamagedRun, ADamagedSummaryIsNamedWithItsPlace) {
  write_file(file(), *floes);
  const auto summary = folder->path() / "damaged/summary.json";
  const std::string whole = read_file(summary);
  std::string text = whole;
  text.insert(text.find("\"steps\": ") + 9, "j");
  write_file(summary, text);
  for (const auto& words : kReading) {
    EXPECT_HAS(expect_code(5, call(words)).err, "damaged/summary.json:9:12: ");
  }
  write_file(summary, whole);
}

/// Rings that can be read but bound no valid area: the check finds them, and everything else says what it
/// leaves out.
TEST_F(DamagedRun, ARingThatIsNotValidCrashesNoCommand) {
  for (const char* ring : {"[[0,0],[1,0],[2,0]]", "[[1,1],[1,1],[1,1]]", "[[0,0],[4,4],[4,0],[0,4]]",
                           "[[0,0],[9,0],[4,0],[4,9]]", "[[0,0],[1e300,0],[0,1e300]]", "[[0,0],[0,9],[9,9],[9,0]]"}) {
    damage(ring);
    for (const auto& words : kReading) {
      const Outcome outcome = call(words);
      EXPECT_GE(outcome.code, 0) << words.front() << ' ' << words.back() << ring;
      if (words.back() == "--check") {
        EXPECT_EQ(outcome.code, 4) << outcome.out;
        EXPECT_HAS(outcome.out, "floe 0: ");
      }
    }
  }
  damage("[[0,0],[1,0],[2,0]]");
  EXPECT_HAS(expect_code(0, call("export damaged --vtk vtk")).err, "note: 1 floe without triangles");
}

TEST_F(DamagedRun, ASizeDistributionLeavesOutAreasThatAreNone) {
  for (const char* area : {"0", "-1", "1e-310"}) {
    std::string text = *floes;
    const std::size_t start = text.find("\"area_m2\":") + 10;
    text.replace(start, text.find(',', start) - start, area);
    write_file(file(), text);
    EXPECT_HAS(expect_code(0, call("inspect damaged --fsd --at 0")).out, "left out: 1 floe whose");
  }
}

}  // namespace
}  // namespace polynya::tests
