#include "../io/scene_text.hpp"
#include "interrupted_run.hpp"
#include <gtest/gtest.h>

#include "io/run/records.hpp"
#include "io/run/run_reader.hpp"
#include "simulation/world/world.hpp"

namespace polynya::tests {
namespace {

using simulation::Simulation;

const std::vector<Words> kReading{"inspect damaged",
                                  "inspect damaged --check",
                                  "inspect damaged --fsd",
                                  "inspect damaged --floe 0 --format geojson",
                                  "view damaged",
                                  "channel damaged",
                                  "export damaged --vtk vtk",
                                  "export damaged --geojson layers"};

class DamagedRun : public InSharedFolder {
 protected:
  static void SetUpTestSuite() {
    folder.emplace();
    write_file(folder->path() / "tiny.json", kTinyScene);
    ASSERT_EQ(call("run tiny.json --out damaged").code, 0);
    // Every shape whole: no other line then needs the vertices of one that is damaged.
    const auto run = checked(io::read_run(folder->path() / "damaged"));
    floes.clear();
    for (const io::RunFloe& floe : run->floes)
      io::append_birth(floes, {floe.birth, *run->shape(floe.birth.floe)}, nullptr);
    write_file(file(), floes);
  }
  static Outcome call(const Words& words) { return polynya(words, without_converter(*folder)); }
  static std::filesystem::path file() { return folder->path() / "damaged/floes.ndjson"; }
  /// Writes other rings to the first floe, a plate.
  static void damage(const std::string& ring, const std::string& holes = "") {
    const std::size_t start = floes.find("\"ring_m\":"), end = floes.find('\n');
    std::string text = floes;
    text.replace(start, end - start, R"("ring_m":)" + ring + R"(,"holes_m":[)" + holes + "]}");
    write_file(file(), text);
  }
  /// Every command ends with 5 and that place.
  static void expect_named(const char* place) {
    for (const Words& words : kReading) EXPECT_HAS(expect_code(5, call(words)).err, place);
  }
  static inline std::string floes;
};

TEST_F(DamagedRun, ARingOfTooFewPointsIsNamedWithItsLineByEveryCommand) {
  const char* square = "[[0,0],[9,0],[9,9],[0,9]]";
  for (const auto& [ring, hole] : std::vector<std::pair<std::string, std::string>>{{"[]", ""},
                                                                                   {"[[0,0]]", ""},
                                                                                   {"[[0,0],[1,1]]", ""},
                                                                                   {"[[0,0],[1,0],[1,1e999]]", ""},
                                                                                   {square, "[]"},
                                                                                   {square, "[[1,1],[2,2]]"}}) {
    damage(ring, hole);
    expect_named("damaged/floes.ndjson:1: ");
  }
}

TEST_F(DamagedRun, ADamagedSummaryIsNamedWithItsPlace) {
  write_file(file(), floes);
  const auto summary = folder->path() / "damaged/summary.json";
  const std::string whole = read_file(summary);
  write_file(summary, replaced(whole, "\"steps\": ", "\"steps\": j"));
  expect_named("damaged/summary.json:9:12: ");
  write_file(summary, whole);
}

/// Rings that can be read but bound no valid area: the check finds them, and everything else says what it leaves out.
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
    std::string text = floes;
    const std::size_t start = text.find("\"area_m2\":") + 10;
    text.replace(start, text.find(',', start) - start, area);
    write_file(file(), text);
    EXPECT_HAS(expect_code(0, call("inspect damaged --fsd --at 0")).out, "left out: 1 floe whose");
  }
}

// ---- a run whose account of energy does not close says so, leaves the state before, and repeats it

/// A ship that thrust alone has brought to ½ m v² = (F t)² / 2 m = 5e4 J/s² · t², and a floe that nobody meets.
const std::string kScene = scene({R"("time": {"step_s": 0.01, "until_s": 10}, "record": {"frames_interval_s": 1})",
                                  list("ships", {ship(R"("position_m": [0, 0], "propulsion": {"thrust_N": 1e6})")}),
                                  list("floes", {square(500, -30, 40)})});

/// Books 4 MJ of kinetic energy that was never there, but for 6 J, and as much that thrust never took out. At
/// first those 6 J are lost in a turnover of 7.2 MJ. Thrust goes on and brings it down by what it gives,
/// below 6 MJ when it has given 2 MJ, at t = √40 s: from then on the accounts are off by more than 1e-6.
void miskeep(Simulation& simulation) {
  auto& sums = const_cast<simulation::World&>(simulation.world()).accounts.audit;
  sums.energy.thrust -= 4e6;
  sums.initial_energy += 4e6 - 6;
}

class BrokenAudit : public testing::Test {
 protected:
  /// Leaves a run that was stopped after 4 s, by its own program, with such books in its checkpoint.
  void stop_run() {
    write_file(folder_ / "scene.json", kScene);
    leave_run(folder_ / "scene.json", folder_ / "run", 400, {400}, 100, [](Simulation& simulation) {
      miskeep(simulation);
      ASSERT_TRUE(simulation.audit().is_closed());
    });
  }
  Outcome resume(Words more = {}) { return polynya(Words{"resume", "run"} + more, start_); }
  /// The dump has the last state whose accounts close, and polynya gets the next one, the same each time.
  void expect_reproduced() {
    const auto scene = io::read_scene_file(folder_ / "run/scene.json");
    const auto dump = checked(io::read_checkpoint_file(folder_ / "run" / io::run_file::kFailure, scene->course_hash));
    EXPECT_EQ(dump->steps, 632) << "√40 s = 632.5 steps";
    auto simulation = checked(Simulation::resumed(scene->scene, dump->state));
    EXPECT_TRUE(simulation->audit().is_closed());
    simulation->step();
    EXPECT_FALSE(simulation->audit().is_closed());
    const Outcome repeated = expect_code(4, resume("--from-failure"));
    EXPECT_HAS(repeated.out, "now         the accounts of energy or momentum do not close\nreproduced\n");
    EXPECT_EQ(resume("--from-failure").out, repeated.out);
  }

  const TemporaryFolder folder_;
  const Start start_{folder_.path()};
};

TEST_F(BrokenAudit, IsToldAtTheEndAndDumpedAndRepeated) {
  stop_run();
  EXPECT_HAS(expect_code(0, resume()).err, "THE AUDIT IS BROKEN: energy is off by 6.00e+00 J",
             "polynya resume run --from-failure");
  const auto summary = io::parse_json(read_file(folder_ / "run/summary.json"));
  EXPECT_FALSE(summary.root.find("audit_closed")->boolean());
  expect_reproduced();
}

TEST_F(BrokenAudit, StopsARunThatIsCheckedAtEveryStep) {
  stop_run();
  EXPECT_HAS(expect_code(4, resume("--check")).err,
             "stopped at 6.33 s: the accounts of energy or momentum do not close");
  expect_reproduced();
}

}  // namespace
}  // namespace polynya::tests
