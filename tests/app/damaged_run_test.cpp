#include <algorithm>
#include <functional>

#include "../io/scene_text.hpp"
#include "interrupted_run.hpp"
#include <gtest/gtest.h>

#include "io/run/records.hpp"
#include "io/run/run_reader.hpp"
#include "io/run/summary.hpp"
#include "io/scene/scene_file.hpp"
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
    // Every shape is stored whole, so that no other line needs the vertices of a damaged one.
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
  /// Checks that every command ends with exit status 5 and names the place.
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

/// Some rings can be read but bound no valid area. The check reports them, and every other command states which floes
/// it leaves out.
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

/// Two floes meet after about five seconds and stop each other. A ship meets no floe.
const std::string kScene = scene({R"("time": {"step_s": 0.01, "until_s": 15}, "record": {"frames_interval_s": 1})",
                                  list("ships", {ship(R"("position_m": [0, 900], "propulsion": {"thrust_N": 0})")}),
                                  list("floes", {square(500, 0, 40, R"("velocity_m_per_s": [1, 0])"),
                                                 square(550, 0, 40, R"("velocity_m_per_s": [-1, 0])")})});

/// Adds a false momentum to the accounts, 2e-7 of the momentum of the floes. It is within 1e-6 of the turnover while
/// they move, even without the momentum at the start. After they have stopped each other, only the water's part of the
/// turnover is left.
void miskeep(Simulation& simulation) {
  auto& sums = const_cast<simulation::World&>(simulation.world()).accounts.audit;
  sums.initial_momentum.y += 2e-7 * sums.initial_momenta;
  sums.initial_momenta = 0;
}

class BrokenAudit : public testing::Test {
 protected:
  /// Leaves a run that its own program stopped after 4 s, with the given accounts in its checkpoint.
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
    EXPECT_GT(dump->steps, 400) << "after the stop";
    auto simulation = checked(Simulation::resumed(scene->scene, dump->state));
    EXPECT_TRUE(simulation->audit().is_closed());
    simulation->step();
    EXPECT_FALSE(simulation->audit().is_closed());
    const Outcome repeated = expect_code(4, resume("--from-failure"));
    EXPECT_HAS(repeated.out, "now         the balances of energy or momentum do not close\nreproduced\n");
    EXPECT_EQ(resume("--from-failure").out, repeated.out);
  }

  const TemporaryFolder folder_;
  const Start start_{folder_.path()};
};

TEST_F(BrokenAudit, IsToldAtTheEndAndDumpedAndRepeated) {
  stop_run();
  EXPECT_HAS(expect_code(0, resume()).err, "THE AUDIT IS BROKEN: energy is off by ",
             "polynya resume run --from-failure");
  const auto summary = io::parse_json(read_file(folder_ / "run/summary.json"));
  EXPECT_FALSE(summary.root.find("audit_closed")->boolean());
  expect_reproduced();
}

TEST_F(BrokenAudit, StopsARunThatIsCheckedAtEveryStep) {
  stop_run();
  EXPECT_HAS(expect_code(4, resume("--check")).err, "stopped at ", ": the balances of energy or momentum do not close");
  expect_reproduced();
}

// ---- each account that does not close has a warning at the end of a run

/// Plants an entry that is wrong by a share of the account's scale, and sums up the run as its end does.
io::RunSummary summary_with(const std::filesystem::path& folder, double share,
                            const std::function<void(simulation::Accounts&, double, const simulation::Audit&)>& plant) {
  write_file(folder / "scene.json", kScene);
  const auto scene = checked(io::read_scene_file(folder / "scene.json"));
  Simulation simulation(scene->scene);
  auto writer = checked(io::RunWriter::create(folder / fmt::format("run{:g}", share), false, *scene));
  for (int i = 0; i < 10; ++i) simulation.step();
  plant(const_cast<simulation::World&>(simulation.world()).accounts, share, simulation.audit());
  return io::summarise(simulation, *writer, "", 1);
}

TEST(BrokenAccount, HasAWarningAtTwiceItsToleranceAndNoneAtHalf) {
  using simulation::Accounts;
  using simulation::Audit;
  struct Case {
    const char* warning;
    double tolerance;
    std::function<void(Accounts&, double, const Audit&)> plant;
  };
  const Case cases[] = {
      {"THE AUDIT IS BROKEN", 1e-6,
       [](Accounts& a, double share, const Audit& now) { a.audit.energy.friction += share * now.turnover; }},
      {"THE AUDIT IS BROKEN", 1e-6,
       [](Accounts& a, double share, const Audit& now) { a.audit.momentum.water.x += share * now.momentum_turnover; }},
      {"THE LEDGER IS BROKEN", 1e-9,
       [](Accounts& a, double share, const Audit&) { a.areas.brash += share * a.areas.initial; }},
      {"THE LEDGER IS BROKEN", 1e-9,
       [](Accounts& a, double share, const Audit&) { a.masses.brash += share * a.masses.initial; }}};
  for (const Case& each : cases) {
    const TemporaryFolder folder;
    for (const double factor : {0.0, 0.5, 2.0}) {
      const io::RunSummary summary = summary_with(folder.path(), factor * each.tolerance, each.plant);
      EXPECT_EQ(summary.accounts_close(), factor < 1) << each.warning << factor;
      EXPECT_EQ(std::ranges::count_if(summary.warnings,
                                      [&](const std::string& words) { return words.starts_with(each.warning); }),
                factor < 1 ? 0 : 1);
    }
  }
}

}  // namespace
}  // namespace polynya::tests
