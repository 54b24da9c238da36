// A run whose account of energy does not close says so, leaves the state before the step after which it does
// not, and that step can be had again.

#include "../io/scene_text.hpp"
#include "program.hpp"
#include <gtest/gtest.h>

#include "io/run/checkpoint.hpp"
#include "io/run/run_folder.hpp"
#include "io/run/run_writer.hpp"
#include "simulation/simulation.hpp"
#include "simulation/world/world.hpp"

namespace polynya::tests {
namespace {

using simulation::Simulation;

/// A ship that thrust alone has brought to ½ m v² = (F t)² / 2 m = 5e4 J/s² · t², and a floe that nobody
/// meets.
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
    const auto scene = checked(io::read_scene_file(folder_ / "scene.json"));
    Simulation simulation(scene->scene);
    auto writer = checked(io::RunWriter::create(folder_ / "run", false, *scene));
    for (int step = 0; step < 400; ++step) {
      writer->record(simulation.journal());
      if (step % 100 == 0) writer->frame(simulation);
      simulation.step();
    }
    writer->record(simulation.journal());
    writer->frame(simulation);
    miskeep(simulation);
    ASSERT_TRUE(simulation.audit().is_closed());
    io::Checkpoint checkpoint;
    checkpoint.course_hash = scene->course_hash;
    checkpoint.steps = simulation.steps();
    checkpoint.progress = writer->sync().value();
    checkpoint.state = simulation.state();
    checkpoint.state_hash = simulation.state_hash();
    ASSERT_TRUE(io::write_checkpoint(folder_ / "run", checkpoint).has_value());
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
  const Outcome resumed = expect_code(0, resume());
  EXPECT_HAS(resumed.err, "THE AUDIT IS BROKEN: energy is off by 6.00e+00 J");
  EXPECT_HAS(resumed.err, "polynya resume run --from-failure");
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
